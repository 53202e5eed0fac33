"""What a case is known by: a hash over everything that decides its row.

Those are the bytes of the netlist and of every file that it names, its values, the library files with all that they
import of their author's, the version and the code of fairlead, the figures and the budget. The order of values does
not count.
"""

from __future__ import annotations

import hashlib
import importlib.metadata
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from fairlead.analysis.cost.kept_runs import code_digest
from fairlead.component.library_files import all_files
from fairlead.netlist.netlist import Value

if TYPE_CHECKING:
    from fairlead.model import Model

FORMAT = "fairlead-case-1"
LENGTH = 24
"""Hexadecimal digits of a key: of 1e9 cases two share one with a probability of 6e-12."""


def scene_digest(model: Model, asked: Iterable[object]) -> str:
    """What all cases of a model share; `asked` is whatever else decides a row, as figures and budgets."""
    state = hashlib.sha256(f"{FORMAT}\0{importlib.metadata.version('fairlead')}\0{code_digest()}\0".encode())
    state.update(model.sources.digest(model.overrides).encode())
    for file in named_files(model):
        state.update(file.read_bytes())
    for library in model.libraries:
        state.update(b"\0".join(file.read_bytes() for file in all_files(library).values()))
    for part in asked:
        state.update(f"{part!r}\0".encode())
    return state.hexdigest()


def key_of(scene: str, values: Mapping[str, float | str]) -> str:
    """The key of one case of a scene."""
    said = "\0".join(f"{name}={values[name]}" for name in sorted(values, key=str))
    return hashlib.sha256(f"{scene}\0{said}".encode("utf-8", "surrogatepass")).hexdigest()[:LENGTH]


def named_files(model: Model) -> list[Path]:
    """Files with tables that the netlist names (`{file: data.csv}`) and that are there, each once."""
    folder = model.sources.folder
    names = dict.fromkeys(_names(model.sources.tree)) if model.sources.tree is not None else {}
    found = ((folder / name).resolve() for name in names)
    return [file for file in found if file.is_relative_to(folder) and file.is_file()]


def _names(value: Value) -> Iterator[str]:
    if isinstance(value.content, dict):
        for name, one in value.content.items():
            if name == "file" and isinstance(one.content, str):
                yield one.content
            yield from _names(one)
    elif isinstance(value.content, list):
        for one in value.content:
            yield from _names(one)
