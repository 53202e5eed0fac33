"""Component types by name: the bundled library (bundled.py), plug-ins, and files given by --library."""

from __future__ import annotations

import contextlib
import functools
import hashlib
import importlib.util
import linecache
import os
import pathlib
import sys
import warnings
from collections.abc import Iterable, Mapping
from types import ModuleType
from typing import TYPE_CHECKING

from fairlead.component.base import Declared
from fairlead.component.bundled import Bundled, bundled, types_in
from fairlead.component.class_checks import source_place
from fairlead.component.library_files import all_files, beside, given_files, said_twice
from fairlead.component.members import defined_by_a_library, defined_in, hide_libraries, replaced, show
from fairlead.component.replies import is_bundled
from fairlead.errors import Fault, ModelError

if TYPE_CHECKING:
    import importlib.metadata

ENTRY_POINTS = "fairlead.components"
WRITTEN = "__written__"
"""In the module of a library: what its files were when it was loaded."""
NUMBER = "__number__"
"""In the module of a library: under which number its members of families are kept."""
NEIGHBOURS = "__neighbours__"
"""In the module of a library: the modules of its author's that it imported."""
_told: set[str] = set()
"""Which names were told to be taken by another class; once is enough."""
_loaded: dict[str, ModuleType] = {}
"""Libraries as they were loaded last, by path; those of one name in two folders do not disturb each other."""


def known_types(libraries: Iterable[str] = ()) -> Mapping[str, type[Declared]]:
    """Every type a netlist may name: bundled, from installed plug-ins, and from `libraries`.

    A plug-in that fails to import is reported with its name and left out. A library given by path
    that cannot be loaded raises ModelError, since the user asked for it.
    """
    plug_ins, libraries = _plug_ins(_installed()), tuple(libraries)
    if not plug_ins and not libraries:
        hide_libraries()
        return Bundled()
    types = dict(bundled())
    for point in plug_ins:
        try:
            mine = types_in(point.load())
        except Exception as error:  # noqa: BLE001 - any failure of foreign code must not stop the start
            warnings.warn(f"plug-in {point.name} ({point.value}) is left out: {error}", stacklevel=2)
        else:
            _tell_of_same_names(mine, types)
            types.update(mine)
    hide_libraries()
    for path in libraries:
        for module in load_libraries(path):
            mine = types_in(module)
            _tell_of_same_names(mine, types)
            for member, other in replaced(module.__dict__[NUMBER]):
                _tell(member.word, member, other)
            types.update(mine)
    return types


def _installed() -> tuple[tuple[str, int], ...]:
    """Where Python looks for packages, and when something was last installed there."""
    folders = [pathlib.Path(path or ".") for path in sys.path]
    return tuple((str(folder), folder.stat().st_mtime_ns) for folder in folders if folder.exists())


@functools.lru_cache(maxsize=1)
def _plug_ins(installed: tuple[tuple[str, int], ...]) -> tuple[importlib.metadata.EntryPoint, ...]:
    """The plug-ins among what is installed."""
    if not any(_may_have_plug_ins(pathlib.Path(folder)) for folder, _ in installed):
        return ()
    import importlib.metadata  # parses what pip knows of every package, tens of milliseconds

    return tuple(importlib.metadata.entry_points(group=ENTRY_POINTS))


def _may_have_plug_ins(folder: pathlib.Path) -> bool:
    """Whether the text of some package's entry points names the group; what is no folder (a zip) may well."""
    if not folder.is_dir():
        return True
    for entry in os.scandir(folder):
        if entry.name.endswith((".dist-info", ".egg-info")):
            with contextlib.suppress(OSError):
                if ENTRY_POINTS.encode() in pathlib.Path(entry.path, "entry_points.txt").read_bytes():
                    return True
    return False


def load_libraries(path: str) -> list[ModuleType]:
    """Import a user's Python file of components, a package of them, or all files of another folder.

    Raises ModelError when there is none or one fails.
    """
    return [_load(path, file) for file in given_files(path)]


def load_library(path: str) -> ModuleType:
    """Import a user's Python file, or a package, of components. Raises ModelError as `load_libraries` does."""
    return load_libraries(path)[0]


def _load(path: str, target: pathlib.Path) -> ModuleType:
    """Import a file; its code is run, and again if it, or a file that it imports, has been edited.

    Models that were loaded before keep their classes. Raises ModelError when it fails, with the line in the file.
    """
    bundled()  # or members that its imports bring would be taken for its own
    is_package = target.name == "__init__.py" and pathlib.Path(path).resolve() == target.parent
    name = f"fairlead_library_{target.parent.name if is_package else target.stem}"
    imported = all_files(str(target.parent if is_package else target))
    loaded, written = _loaded.get(str(target)), _written(imported)
    if loaded is not None and loaded.__dict__.get(WRITTEN) == written:
        if sys.modules.get(name) is not loaded:
            _forget(name, ())
            sys.modules[name] = loaded
        show(loaded.__dict__[NUMBER])
        return loaded
    if loaded is not None or name in sys.modules:  # edited, or of another folder
        _forget(name, written)
        before = loaded.__dict__[WRITTEN] if loaded is not None else written
        for each in [one for one, file in imported.items() if before.get(str(file)) != written[str(file)]]:
            sys.modules.pop(each, None)
    if twice := [Fault(None, f"--library {path}: {said}") for said in said_twice(target)]:
        raise ModelError(twice)
    spec = importlib.util.spec_from_file_location(name, target)
    if spec is None or spec.loader is None:
        raise ModelError((Fault(None, f"--library {path}: this is no Python file", "Give a .py file."),))
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    module.__dict__[WRITTEN] = written
    try:
        with defined_by_a_library() as module.__dict__[NUMBER], beside(target, imported) as module.__dict__[NEIGHBOURS]:
            spec.loader.exec_module(module)
    except (Exception, SystemExit) as error:  # a script that ends Python would end fairlead without a word
        del sys.modules[name]
        raise ModelError(
            (Fault(None, f"--library {path} cannot be loaded: {_place(error, target)}{error}"),)
        ) from error
    if is_package and not types_in(module) and not defined_in(module.__dict__[NUMBER]):
        way_out = f"Import its classes in {target.name}: from .parts import Spiral."
        raise ModelError((Fault(None, f"--library {path}: this package offers no component class", way_out),))
    _loaded[str(target)] = module
    show(module.__dict__[NUMBER])
    return module


def _tell_of_same_names(mine: Mapping[str, type[Declared]], types: Mapping[str, type[Declared]]) -> None:
    for name, one in mine.items():
        if name in types:
            _tell(name, one, types[name])


def _tell(name: str, one: type[Declared], other: type[Declared]) -> None:
    """Warn of a class, or a member of a family, that takes the place of another one of the same name."""
    taken, left = source_place(one), source_place(other)
    said = f"{name}: {taken} takes the place of {'the one of fairlead' if is_bundled(other) else left}"
    if taken != left and said not in _told:
        _told.add(said)
        warnings.warn(f"{said} wherever a netlist says {name}. Give it a name of its own.", stacklevel=3)


def _written(files: Mapping[str, pathlib.Path]) -> dict[str, str]:
    """SHA-256 of the text of files, by path."""
    return {str(each): hashlib.sha256(each.read_bytes()).hexdigest() for each in files.values()}


def _forget(name: str, files: Iterable[str]) -> None:
    """Let a library be read anew: Python keeps its modules, their bytecode by the second, and the text for messages."""
    for each in [one for one in sys.modules if one == name or one.startswith(f"{name}.")]:
        del sys.modules[each]
    for file in files:
        pathlib.Path(importlib.util.cache_from_source(file)).unlink(missing_ok=True)
        linecache.cache.pop(file, None)


def _place(error: BaseException, file: pathlib.Path) -> str:
    """'file:line: ' of the deepest frame in the user's own file."""
    lines, trace = [], error.__traceback__
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == str(file):
            lines.append(trace.tb_lineno)
        trace = trace.tb_next
    return f"{file.name}:{lines[-1]}: " if lines else ""
