"""`export`: a model made into the file of an FMU, stage by stage."""

from __future__ import annotations

import importlib.metadata
import os
import pathlib
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Unpack

from fairlead.arguments import Arguments
from fairlead.fmu.archive import packed, write
from fairlead.fmu.compiler import linked
from fairlead.fmu.description import About, description, identifier
from fairlead.fmu.made import Asked, Made, asked_of, made_of, own_version, sources
from fairlead.fmu.platforms import Platform, platforms_of, refuse_without_folder
from fairlead.fmu.refusals import refuse_version
from fairlead.fmu.universal import universal

if TYPE_CHECKING:
    from fairlead.model import Model
    from fairlead.netlist.keywords import RunKeywords

LICENCE = "The engine of fairlead: MIT (documentation/licenses/license.txt). The model: as its author says."


def export(
    model: Model, file: str | os.PathLike[str] | None = None, *, version: int = 3, inputs: Iterable[str] = (),
    outputs: Iterable[str] = (), tunable: Iterable[str] = (), platforms: Iterable[str] = (),
    **settings: Unpack[RunKeywords],
) -> pathlib.Path:  # fmt: skip
    """Write a model as a co-simulation FMU, and return the file.

    Inputs and outputs are those of the netlist's `interface` block, and signal inputs and signals named by `inputs`
    and `outputs` (patterns with * and ?) under their names inside. Parameters of the block and of `tunable` can be set
    while it runs, where what follows them does so by a law (tuned.py). `version` of the standard is 3 or 2, `settings`
    are those of `Model.run`. It is for Linux on x86-64, or for all the `platforms` that are named, such as
    "aarch64-linux" and "x86_64-windows" (platforms.py). Without `file` it is the name of the model in this folder. An
    FMU of the same model has the same bytes.

    Raises ModelError as `Model.start` does, and UsageError for what cannot go along, without a C compiler, and where
    the file cannot be written.
    """
    given = Arguments("export")
    given.model(model)
    given.path("file", file, none="None for the name of the model")
    given.texts("inputs", inputs, '"valve.command"')
    given.texts("outputs", outputs, '"spring.force"')
    given.texts("tunable", tunable, '"pad.normal_force"')
    given.texts("platforms", platforms, '"aarch64-linux"')
    given.refuse()
    refuse_version(version)
    targets = platforms_of(platforms)
    if version == 2:
        refuse_without_folder(targets)
    asked = asked_of(model, inputs, outputs, tunable, settings, "export", [one.name for one in targets])
    name = identifier(model.netlist.name)
    target = pathlib.Path(f"{name}.fmu" if file is None else file)
    write(target, _made(asked, name, version))
    return target


def _made(asked: Asked, name: str, version: int) -> bytes:
    """The bytes of the FMU."""
    made = made_of(asked)
    about = _about(asked, name, made.token)
    return packed({
        "modelDescription.xml": description(about, made.variables, made.tuned, version),
        **_libraries(asked.platforms, made, name, version),
        "documentation/licenses/license.txt": _licence(),
    })  # fmt: skip


def _libraries(platforms: Iterable[Platform], made: Made, name: str, version: int) -> Mapping[str, bytes]:
    """The libraries by their places in the FMU."""
    found: dict[str, list[bytes]] = {}
    for one in platforms:
        files = sources(made, name, ("wrapper.h", "wrapper.c", f"fmi{version}.c"), one)
        place = f"binaries/{one.name if version == 3 else one.folder}/{name}.{one.ending}"
        found.setdefault(place, []).append(linked(files, name, one)[one.file(name)])
    return {place: universal(libraries) for place, libraries in found.items()}


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
