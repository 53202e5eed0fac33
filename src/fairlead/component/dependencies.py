"""Everything the code of a class depends on, as text to be hashed, without running or tracing it.

Followed are the functions of the class and its bases and, through the names they use, helpers, constants
and classes in any file, the user's and ours alike. A module used as `module.f` counts with its whole source, and an
author's also with what it imports.
Third-party packages count through their versions (see `native.digest`).
"""

from __future__ import annotations

import functools
import inspect
import operator
import pathlib
import sys
from collections.abc import Mapping
from types import CodeType, FunctionType, ModuleType
from typing import Any

from fairlead.component.declare import Derived, Guard, Sampled, Shared, ZoneLaw
from fairlead.component.replies import is_bundled
from fairlead.component.slips import SET_HERE
from fairlead.component.values import Variant


def dependencies(variant: Variant) -> str:
    """Text that changes whenever the traced laws of `variant` may change."""
    seen: set[int] = set()
    pieces = [repr((variant.words, variant.absent, variant.swings))]
    for base in variant.type.__mro__[:-1]:
        pieces += _of(base, seen)
    pieces += [f"{name}: {dependencies(part)}" for name, part in variant.parts]
    pieces += [] if is_bundled(variant.type) else [_looked_at(variant.type)]
    return "\n".join([*pieces, _framework()])


def _looked_at(kind: Any) -> str:
    """What a user's class declares that decides no code, and is looked at when its laws are traced: units."""
    has = kind.declaration
    units = [
        (name, (one.x, one.y) if hasattr(one, "x") else getattr(one, "unit", ""))
        for named in (has.parameters, has.inputs, has.outputs, has.states, has.unknowns, has.discrete)
        for name, one in named.items()
    ]
    return repr((units, "units" in kind.answers.exempt))


@functools.cache
def _framework() -> str:
    """Source of the files that trace laws and write kernels."""
    here = pathlib.Path(__file__).parent
    tracing = "declare given declaration dimensions answers base functions holding hold_rows keys symbols terms trace "
    tracing += "trace_readers values wave piecewise quantity author"
    files = [here / f"{name}.py" for name in tracing.split()]
    files += sorted((here.parent / "kernels").glob("*.py"))
    return "\n".join(file.read_text(encoding="utf-8") for file in files)


def _of(thing: Any, seen: set[int]) -> list[str]:
    """Text of one thing and, recursively, of what its code names."""
    if isinstance(thing, str | int | float | complex | None):  # shared by who knows whom, so never skipped as seen
        return [repr(thing)]
    if id(thing) in seen:
        return []
    seen.add(id(thing))
    inner = _wrapped(thing)
    if inner:
        return [p for one in inner for p in _of(one, seen)]
    if isinstance(thing, FunctionType):
        return _of_function(thing, seen)
    if isinstance(thing, type):
        if _third_party(thing.__module__):
            return []
        return [
            p
            for name, member in sorted(vars(thing).items())
            if _matters(name, member)
            for p in [name, *_of(member, seen)]
        ]
    if isinstance(thing, ModuleType):
        return _of_module(thing, seen)
    if isinstance(thing, Mapping):
        return [p for key, value in thing.items() for p in [repr(key), *_of(value, seen)]]
    if isinstance(thing, list | tuple):
        return [p for value in thing for p in _of(value, seen)]
    if isinstance(thing, set | frozenset):  # its order differs from process to process
        return sorted(repr(value) for value in thing)
    return [repr(thing.tolist())] if hasattr(thing, "tolist") else []


def _wrapped(thing: Any) -> list[Any]:
    """What a declaration or a wrapper of Python's holds."""
    if isinstance(thing, ZoneLaw):
        return [thing.zones, thing.law]
    if isinstance(thing, Guard):
        return [thing.zones, thing.to, thing.unit, thing.function, thing.mirrored]
    if isinstance(thing, Sampled):
        return [thing.period, thing.law]
    if isinstance(thing, functools.partial):
        return [thing.func, thing.args]
    if isinstance(thing, staticmethod | classmethod):
        return [thing.__func__]
    if isinstance(thing, property):
        return [thing.fget]
    return [thing.function] if isinstance(thing, Derived | Shared) else []


def _matters(name: str, member: Any) -> bool:
    """False for what Python notes of a class (its lines, its documentation), and the framework (its relatives)."""
    return name not in (*SET_HERE, "exempt") and (not name.startswith("__") or callable(member))


def _of_function(function: FunctionType, seen: set[int]) -> list[str]:
    if _third_party(function.__module__ or ""):
        return []
    pieces = [function.__qualname__, *_of_code(function.__code__, seen)]
    for default in (*(function.__defaults__ or ()), *(function.__kwdefaults__ or {}).values()):
        pieces += _of(default, seen)
    for name in _names(function.__code__):
        if name in function.__globals__:
            pieces += [name, *_of(function.__globals__[name], seen)]
    for cell in function.__closure__ or ():
        pieces += _of(cell.cell_contents, seen)
    return pieces


def _of_code(code: CodeType, seen: set[int]) -> list[str]:
    constants = [p for c in code.co_consts if not isinstance(c, CodeType) for p in _of(c, seen)]
    inner = [p for c in code.co_consts if isinstance(c, CodeType) for p in _of_code(c, seen)]
    return [code.co_code.hex(), *code.co_names, *code.co_varnames, *constants, *inner]


def _names(code: CodeType) -> list[str]:
    inner = [name for c in code.co_consts if isinstance(c, CodeType) for name in _names(c)]
    return [*code.co_names, *inner]


def _of_module(module: ModuleType, seen: set[int]) -> list[str]:
    """The source of a module; of an author's also what it has from others, which may have been edited instead."""
    if _third_party(module.__name__):
        return []
    text = _module_source(module)
    if module.__name__.partition(".")[0] == "fairlead":
        return [text]
    named = sorted(((n, v) for n, v in vars(module).items() if not n.startswith("__")), key=operator.itemgetter(0))
    return [text, *(p for name, value in named for p in [name, *_of(value, seen)])]


def _module_source(module: ModuleType) -> str:
    try:
        return inspect.getsource(module)
    except (OSError, TypeError):
        return module.__name__


def _third_party(module: str) -> bool:
    """True for the standard library and installed packages: their versions are in the key."""
    root = module.split(".")[0]
    if root in sys.stdlib_module_names or root == "builtins":
        return True
    loaded = sys.modules.get(root)
    file = getattr(loaded, "__file__", None) or ""
    return root != "fairlead" and "site-packages" in pathlib.PurePath(file).parts
