"""Which files a library consists of: those it is given as, and those of its author's that they import.

A file may import its neighbours, the files in the same folder, as a script may. Python itself looks in the folder of a
script alone, so `beside` has it look there while a library is loaded.
"""

from __future__ import annotations

import functools
import importlib.machinery
import pathlib
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from types import ModuleType
from typing import Any

from fairlead.errors import Fault, ModelError

INSTALLED = ("site-packages", "dist-packages")
"""Folders whose code is known by its version; the code of an author's lies elsewhere."""


def given_files(path: str) -> list[pathlib.Path]:
    """What a library is loaded from: a file, the `__init__.py` of a package, or all files of another folder."""
    file = pathlib.Path(path).resolve()
    if not file.is_dir():
        found = [file] if file.is_file() else []
    elif (file / "__init__.py").is_file():
        found = [file / "__init__.py"]
    else:
        found = sorted(one for one in file.glob("*.py") if not one.name.startswith(("_", ".", "test_")))
    if not found:
        said = "there is no Python file in this folder" if file.is_dir() else "there is no such file"
        raise ModelError((Fault(None, f"--library {path}: {said}", "Give a .py file, or a folder of such."),))
    return found


def all_files(path: str) -> dict[str, pathlib.Path]:
    """All files of an author's that decide what a library is, by the names under which they are imported."""
    try:
        given = given_files(path)
    except ModelError:  # told by whoever loads it
        return {}
    if given[0].name == "__init__.py":
        given = sorted(given[0].parent.rglob("*.py"))
    found: dict[str, pathlib.Path] = {}
    left = [(str(file), file) for file in given]
    while left:
        name, file = left.pop()
        if file not in found.values():
            found[name] = file
            left += _imported(file, pathlib.Path(path).resolve())
    return found


def said_twice(file: pathlib.Path) -> Iterator[str]:
    """Names that a class body defines twice, or classes that a file does: the last would count, and nobody be told."""
    import ast

    try:
        tree = ast.parse(file.read_bytes())
    except (SyntaxError, ValueError):  # told by whoever loads it
        return
    bodies: list[tuple[str, Sequence[ast.stmt]]] = [("", [one for one in tree.body if isinstance(one, ast.ClassDef)])]
    bodies += [(f"{one.name}: ", one.body) for one in ast.walk(tree) if isinstance(one, ast.ClassDef)]
    for of, body in bodies:
        lines: dict[str, int] = {}
        for node in body:
            for name in _defined_by(node):
                if name in lines:
                    both = f"is defined here and in line {lines[name]}; one of them is lost"
                    yield f"{file}:{node.lineno}: {of}{name} {both}"
                lines[name] = node.lineno


def _defined_by(node: Any) -> list[str]:
    """Names that a statement declares; not what goes on with what a name had, such as a setter or a sum."""
    import ast

    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        goes_on = {one.id for each in node.decorator_list for one in ast.walk(each) if isinstance(one, ast.Name)}
        return [node.name] if not {node.name, "overload"} & goes_on else []
    if isinstance(node, ast.Assign) and isinstance(node.value, ast.Call | ast.Tuple | ast.GeneratorExp):
        read = {one.id for one in ast.walk(node.value) if isinstance(one, ast.Name)}
        names = [one.id for each in node.targets for one in ast.walk(each) if isinstance(one, ast.Name)]
        return [name for name in names if name not in read]
    return []


@contextmanager
def beside(file: pathlib.Path, imported: dict[str, pathlib.Path]) -> Iterator[dict[str, ModuleType]]:
    """Meanwhile, imports find the neighbours of a file first; afterwards `sys.modules` knows none of them.

    So libraries in two folders may have neighbours of one name. Gives the neighbours, filled at the end.
    """
    folder, neighbours = file.parent, dict[str, ModuleType]()
    mine = {name.partition(".")[0] for name, one in imported.items() if one.is_relative_to(folder)}
    aside = _taken_out(mine)
    finder = _Beside(folder)
    sys.meta_path.insert(0, finder)
    try:
        yield neighbours
    finally:
        sys.meta_path.remove(finder)
        neighbours.update(_taken_out(mine))
        sys.modules.update(aside)


def _taken_out(roots: set[str]) -> dict[str, ModuleType]:
    """Modules, and all within them, that Python no longer knows."""
    return {name: sys.modules.pop(name) for name in [*sys.modules] if name.partition(".")[0] in roots}


class _Beside:
    """Finds modules in a folder; not those that Python has, nor folders that are no packages."""

    def __init__(self, folder: pathlib.Path) -> None:
        self.folder = str(folder)

    def find_spec(self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None) -> Any:
        """As the finders of Python do."""
        if path is not None or _is_known(name):
            return None
        spec = importlib.machinery.PathFinder.find_spec(name, [self.folder])
        return spec if spec is not None and spec.origin is not None else None


def _is_known(name: str) -> bool:
    return name.partition(".")[0] in {*sys.stdlib_module_names, "fairlead"}


def _imported(file: pathlib.Path, library: pathlib.Path) -> Iterator[tuple[str, pathlib.Path]]:
    """Files of an author's that a file imports."""
    own = library if library.is_dir() else library.parent
    others = [pathlib.Path(one or ".").resolve() for one in sys.path]
    for level, name in _names(file.read_bytes()):
        if level:
            above = file.parents[level - 1] if level <= len(file.parents) else file.parent
            yield from ((str(one), one) for _, one in _files_of(above, name))
        elif not _is_known(name):
            folders = (one for one in (own, *others) if not set(INSTALLED) & set(one.parts))
            yield from next(filter(None, (list(_files_of(folder, name)) for folder in folders)), [])


def _files_of(folder: pathlib.Path, name: str) -> Iterator[tuple[str, pathlib.Path]]:
    """The files that `import name` runs, when the first of its words is in a folder."""
    words = name.split(".")
    for k in range(1, len(words) + 1):
        at = folder.joinpath(*words[:k])
        for one in (at / "__init__.py", at.parent / f"{at.name}.py"):
            if one.is_file():
                yield ".".join(words[:k]), one


@functools.lru_cache(maxsize=256)
def _names(text: bytes) -> list[tuple[int, str]]:
    """(dots before it, name) of what a file imports, anywhere in it; of `from a import b` a and a.b."""
    import ast

    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):  # told by whoever loads it
        return []
    found = list[tuple[int, str]]()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found += [(0, one.name) for one in node.names]
        elif isinstance(node, ast.ImportFrom):
            of = node.module or ""
            found += [(node.level, f"{of}.{one.name}".strip(".")) for one in node.names]
    return found
