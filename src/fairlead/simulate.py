"""What a program calls first: read a netlist, run it, describe a type of component."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, Unpack

from fairlead.arguments import Arguments, keywords_told, told_of
from fairlead.errors import ModelError, UsageError
from fairlead.model import GIVEN, Model, Place, Progress

if TYPE_CHECKING:
    from fairlead.netlist.keywords import RunKeywords
    from fairlead.netlist.netlist import Netlist
    from fairlead.result import Result

OF_SIGNALS = ("initial.", "nominal.", "limits.", "record.")
"""Blocks whose entries are named after signals."""


@keywords_told
def load(path: str | os.PathLike[str], set: Mapping[str, str | float] | None = None,
         libraries: Iterable[str | os.PathLike[str]] = (), allow_fmu: bool = False) -> Model:  # fmt: skip
    """Read a netlist, by path or by the name of a bundled model. Raises ModelError with every mistake.

    `set` overrides scene parameters (`mu`) and settings (`pad.normal_force`, `run.stop`), with texts as after `--set`
    or numbers in SI, and a value that does not fit is told at once; `libraries` are Python files with component
    classes of the user, whose code is run. With `allow_fmu` runs may call the code of FMUs that the netlist names.
    """
    asked = Arguments("load")
    asked.path("path", path)
    asked.values_by_name("set", set)
    asked.texts("libraries", libraries, '"parts.py"')
    asked.yes_or_no("allow_fmu", allow_fmu)
    asked.refuse()
    return opened(path, set, libraries, allow_fmu)


def opened(path: str | os.PathLike[str], set: Mapping[str, str | float] | None,
           libraries: Iterable[str | os.PathLike[str]], allow_fmu: bool,
           draft: str | None = None) -> Model:  # fmt: skip
    """As `load`, with arguments that are sound; `draft` is the text of the netlist as an editor has it."""
    from fairlead.netlist.load import read
    from fairlead.netlist.settings_file import as_settings

    sources, faults = read(path, draft)
    if sources is None:
        raise ModelError(faults)
    given, folders = as_settings(set or {}, GIVEN), tuple(os.fspath(each) for each in libraries)
    model = Model(sources, given, folders, allow_fmu=allow_fmu)
    if model._faults or not all(map(_is_python, model.libraries)):
        model.check()
    if set and _fits_are_known_late(model.netlist, set):
        model.check()
    elif set:
        model.assembly  # noqa: B018 - a value that does not fit is told here, at the call that gives it
    return model


def run(path: str | os.PathLike[str], set: Mapping[str, str | float] | None = None,
        libraries: Iterable[str | os.PathLike[str]] = (), allow_fmu: bool = False,
        out: str | os.PathLike[str] | Place | None = Place.RESULTS, force: bool = False,
        progress: Progress | None = None, profile: bool = False, check: bool = True,
        **settings: Unpack[RunKeywords]) -> Result:  # fmt: skip
    """Read a netlist and simulate it: `load(path, set, libraries, allow_fmu).run(...)` in one call.

    `fairlead.run("belt", {"pad.normal_force": "20 N"}, stop="5 s", out=None)["block.x"]`. For more than one run of a
    model, `load` it once. `path`, `set`, `libraries` and `allow_fmu` are as in `load`; `out`, `force`, `progress`,
    `profile`, `check` and the `settings` as in `Model.run`.
    """
    if isinstance(path, Model):
        raise UsageError("run: path is a Model already. Write model.run(...).")
    with told_of("run", "load"):
        model = load(path, set, libraries, allow_fmu)
    return model._run(out, force, progress, profile, check, settings, "run")


def _is_python(library: str) -> bool:
    """Whether a library is there, as a Python file or a folder."""
    return (found := Path(library)).is_dir() or (found.suffix == ".py" and found.exists())


def _fits_are_known_late(netlist: Netlist, given: Iterable[str]) -> bool:
    """Whether a value from outside may stand at a signal, whose unit only the compiled model knows."""
    blocks = (netlist.initial, netlist.nominal, netlist.limits)
    expressions = any(value.is_worked_out for block in blocks for value in block.values())
    return expressions or any(name.startswith(OF_SIGNALS) for name in given)

@keywords_told
def describe_type(name: str, libraries: Iterable[str] = ()) -> str:
    """Ports, parameters, zones with guards, and equations of the component type `name`; a notebook shows it as a page.

    `libraries` are files with types of one's own. Raises UsageError for a type that there is not.
    """
    asked = Arguments("describe_type")
    asked.text("name", name, 'describe_type("DryContact")')
    asked.texts("libraries", libraries, '"parts.py"')
    asked.refuse()
    from fairlead.component.registry import known_types
    from fairlead.describe.page import describe
    from fairlead.describe.shown import Page

    return Page(describe(name, known_types(libraries)))


@keywords_told
def json_schema(libraries: Iterable[str] = ()) -> dict[str, Any]:
    """JSON Schema (draft-07) of netlists, from the component classes and those in the files `libraries`."""
    asked = Arguments("json_schema")
    asked.texts("libraries", libraries, '"parts.py"')
    asked.refuse()
    from fairlead.component.json_schema import json_schema as make
    from fairlead.component.registry import known_types

    return make(known_types(libraries))
