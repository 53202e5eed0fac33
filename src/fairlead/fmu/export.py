"""`export`: a model made into the file of an FMU, stage by stage."""

from __future__ import annotations

import importlib.metadata
import os
import pathlib
from collections.abc import Iterable
from typing import TYPE_CHECKING, Unpack

from fairlead.arguments import Arguments
from fairlead.fmu.archive import packed, write
from fairlead.fmu.compiler import linked
from fairlead.fmu.description import About, description, identifier
from fairlead.fmu.made import Asked, asked_of, made_of, own_version, sources
from fairlead.fmu.refusals import refuse_version

if TYPE_CHECKING:
    from fairlead.model import Model
    from fairlead.netlist.keywords import RunKeywords

FOLDERS = {2: "linux64", 3: "x86_64-linux"}
"""Where the library is, by version of the standard."""
LICENCE = "The engine of fairlead: MIT (documentation/licenses/license.txt). The model: as its author says."


def export(
    model: Model, file: str | os.PathLike[str] | None = None, *, version: int = 3, inputs: Iterable[str] = (),
    outputs: Iterable[str] = (), tunable: Iterable[str] = (), **settings: Unpack[RunKeywords],
) -> pathlib.Path:  # fmt: skip
    """Write a model as a co-simulation FMU for Linux on x86-64, and return the file.

    Inputs and outputs are those of the netlist's `interface` block, and signal inputs and signals named by `inputs`
    and `outputs` (patterns with * and ?) under their names inside. Parameters of the block and of `tunable` can be set
    while it runs, where what follows them does so by a law (tuned.py). `version` of the standard is 3 or 2, `settings`
    are those of `Model.run`. Without `file` it is the name of the model in this folder. An FMU of the same model has
    the same bytes.

    Raises ModelError as `Model.start` does, and UsageError for what cannot go along, without a C compiler, and where
    the file cannot be written.
    """
    given = Arguments("export")
    given.model(model)
    given.path("file", file, none="None for the name of the model")
    given.texts("inputs", inputs, '"valve.command"')
    given.texts("outputs", outputs, '"spring.force"')
    given.texts("tunable", tunable, '"pad.normal_force"')
    given.refuse()
    refuse_version(version)
    asked = asked_of(model, inputs, outputs, tunable, settings, "export")
    name = identifier(model.netlist.name)
    target = pathlib.Path(f"{name}.fmu" if file is None else file)
    write(target, _made(asked, name, version))
    return target


def _made(asked: Asked, name: str, version: int) -> bytes:
    """The bytes of the FMU."""
    made = made_of(asked)
    about = _about(asked, name, made.token)
    library = linked(sources(made, name, ("wrapper.h", "wrapper.c", f"fmi{version}.c")))
    return packed({
        "modelDescription.xml": description(about, made.variables, made.tuned, version),
        f"binaries/{FOLDERS[version]}/{name}.so": library,
        "documentation/licenses/license.txt": _licence(),
    })  # fmt: skip


def _about(asked: Asked, name: str, token: str) -> About:
    netlist, settings = asked.netlist, asked.settings
    return About(
        name=netlist.name, identifier=name, description=netlist.description, token=token, digest=netlist.digest,
        version=own_version(), licence=LICENCE, start=settings.start, stop=settings.stop,
        accuracy=settings.accuracy,
    )  # fmt: skip


def _licence() -> bytes:
    """The text of fairlead's licence, as it was installed."""
    text = importlib.metadata.distribution("fairlead").read_text("licenses/LICENSE")
    return (text or "MIT\n").encode()
