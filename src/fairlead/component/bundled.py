"""The bundled library by name: a class is imported when it is asked for, and with a family all its members.

    types = Bundled()
    types["Spring"]        imports fairlead.components.mechanics.spring and what that imports
    types["Contact"]       imports all treatments and curves as well, because any of them may be named
    list(types)            imports everything

Importing all takes a fifth of the time of a short run. Where a class stands is read off the texts of the modules: that
takes milliseconds and needs no list that could be out of date. What the texts do not tell is found by importing
everything, and so is all of it where there are no texts.
"""

from __future__ import annotations

import functools
import importlib
import pathlib
import pkgutil
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import TypeGuard

from fairlead.component.base import Component, Composite, Declared, Family
from fairlead.component.members import in_order

PACKAGE = "fairlead.components"
CLASS = re.compile(r"\nclass (\w+)(?:\(([^)]*)\))?:")  # ten times as quick as one that tries each line by ^


@dataclass(frozen=True, eq=False)
class Written:
    """What the texts of all modules say: in which a class stands, and what each class is made of, by simple names."""

    modules: tuple[str, ...] = ()
    """In the order in which all of them are imported."""
    where: dict[str, list[str]] = field(default_factory=dict)
    bases: dict[str, set[str]] = field(default_factory=dict)
    place: dict[tuple[str, str], int] = field(default_factory=dict)
    """Number of a class, told by module and name, in that order."""

    def below(self, names: Iterable[str]) -> set[str]:
        """Classes that build on these, however deep; several of one name are taken for one."""
        found = new = set(names)
        while new:
            new = {name for name, bases in self.bases.items() if name not in found and bases & found}
            found = found | new
        return found


@functools.cache
def written() -> Written | None:
    """The texts as they lie; None when a module has none."""
    known = Written(tuple(_modules()))
    for module, file in _modules().items():
        try:
            text = "\n" + file.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError):
            return None
        for name, bases in CLASS.findall(text):
            known.place[module, name] = len(known.place)
            known.where.setdefault(name, []).append(module)
            plain = (base.strip() for base in bases.split(",") if "=" not in base)
            known.bases.setdefault(name, set()).update(base.rpartition(".")[2] for base in plain)
    return known


@functools.cache
def _modules() -> dict[str, pathlib.Path]:
    """Every module of the library with its file, packages before what is in them."""
    found: dict[str, pathlib.Path] = {}

    def walk(folders: Iterable[str], prefix: str) -> None:
        for info in pkgutil.iter_modules(list(folders), prefix):
            folder = pathlib.Path(info.module_finder.path)  # type: ignore[union-attr]
            last = info.name.rpartition(".")[2]
            found[info.name] = folder / last / "__init__.py" if info.ispkg else folder / f"{last}.py"
            if info.ispkg:
                walk([str(folder / last)], info.name + ".")

    walk(importlib.import_module(PACKAGE).__path__, PACKAGE + ".")
    return found


class Bundled(Mapping[str, type[Declared]]):
    """Every type of the bundled library by its name; whoever goes through all of them imports all."""

    def __getitem__(self, name: str) -> type[Declared]:
        """The class of a type. Raises KeyError."""
        known = written()
        found = _of(known, name) if known is not None and name in known.where else None
        return found or bundled()[name]

    def __iter__(self) -> Iterator[str]:
        """All names."""
        return iter(bundled())

    def __len__(self) -> int:
        """How many types there are."""
        return len(bundled())

    def heads(self) -> list[type[Family]]:
        """The heads of families that a netlist may name."""
        known = written()
        if known is None:
            return [kind for kind in bundled().values() if _is_head(kind)]
        parts = known.below({Component.__name__, Composite.__name__})
        names = [name for name, bases in known.bases.items() if Family.__name__ in bases and bases & parts]
        kinds = (_of(known, name) for name in names)
        return [kind for kind in kinds if kind is not None and _is_head(kind)]


def _is_head(kind: type[Declared]) -> TypeGuard[type[Family]]:
    return issubclass(kind, Family) and "members" in kind.__dict__


def _of(known: Written, name: str) -> type[Declared] | None:
    """The type of that name, imported with all members of families that are there by then; None for a half-model."""
    _import(known.where[name])
    while wanted := _missing(known):
        _import(wanted)
    in_order(known.place)
    kinds = (types_in(importlib.import_module(module)).get(name) for module in reversed(known.where[name]))
    return next((kind for kind in kinds if kind is not None), None)


_imported: set[str] = set()


def _import(modules: Iterable[str]) -> None:
    for module in modules:
        importlib.import_module(module)
        _imported.add(module)


def _missing(known: Written) -> list[str]:
    """Modules with members of families whose heads exist, and that nobody has imported yet."""
    heads, kinds = set(), list(Family.__subclasses__())
    for kind in kinds:
        heads |= {kind.__name__} if _is_head(kind) else set()
        kinds += kind.__subclasses__()
    return [module for module in _modules_below(known, frozenset(heads)) if module not in _imported]


@functools.lru_cache(maxsize=8)  # asked for every name of a netlist, and heads are few and stay
def _modules_below(known: Written, heads: frozenset[str]) -> list[str]:
    """Modules with classes that build on these, in the order in which all are imported."""
    of_families = {module for name in known.below(heads) for module in known.where.get(name, ())}
    return [module for module in known.modules if module in of_families]


@functools.cache
def bundled() -> dict[str, type[Declared]]:
    """The types of the whole library; from then on its families have all their members."""
    types: dict[str, type[Declared]] = {}
    for module in _modules():
        types.update(types_in(importlib.import_module(module)))
    known = written()
    if known is not None:
        in_order(known.place)
    return types


def types_in(module: object) -> dict[str, type[Declared]]:
    """Component classes a module defines itself: leaves, composites and the heads of families."""
    if isinstance(module, type):
        return {module.__name__: module}
    found = {n: v for n, v in vars(module).items() if isinstance(v, type) and issubclass(v, Component | Composite)}
    here = getattr(module, "__name__", None)
    own = {n: v for n, v in found.items() if not n.startswith("_") and _is_type(v)}
    return {n: v for n, v in own.items() if v.__module__ == here or _is_within(v.__module__, str(here))}


def _is_within(module: str, package: str) -> bool:
    """A library that is a package offers what its `__init__.py` imports of its own modules."""
    return package.startswith("fairlead_library_") and module.startswith(f"{package}.")


def _is_type(kind: type[Declared]) -> bool:
    """True for what a netlist may name: not a half-model, and not a member of a family (its head is named)."""
    if issubclass(kind, Family) and kind.key:
        return "members" in kind.__dict__
    return "declaration" in kind.__dict__
