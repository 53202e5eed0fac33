"""`export`: a model made into the file of an FMU, stage by stage."""

from __future__ import annotations

import dataclasses
import hashlib
import importlib.metadata
import importlib.resources
import os
import pathlib
import uuid
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple, Unpack

from fairlead.arguments import Arguments
from fairlead.fmu.archive import packed, write
from fairlead.fmu.compiler import compiler, linked
from fairlead.fmu.data import data_object
from fairlead.fmu.description import About, description, identifier
from fairlead.fmu.header import header, stubs
from fairlead.fmu.image import Image, image_of
from fairlead.fmu.machine_code import Code, objects
from fairlead.fmu.refusals import (
    refuse_engine,
    refuse_names,
    refuse_no_outputs,
    refuse_parts,
    refuse_platform,
    refuse_twice,
    refuse_version,
)  # fmt: skip
from fairlead.netlist.interface import Outer
from fairlead.outer import Variable
from fairlead.outside import LaidOpen, Stepping, laid_open
from fairlead.patterns import picked
from fairlead.run import engine_of

if TYPE_CHECKING:
    from fairlead.netlist.keywords import RunKeywords
    from fairlead.netlist.netlist import Netlist
    from fairlead.netlist.settings import RunSettings
    from fairlead.simulate import Model
    from fairlead.system.compiled.system import System

FOLDERS = {2: "linux64", 3: "x86_64-linux"}
"""Where the library is, by version of the standard."""
SOURCES = ("run.h", "run.c", "image.h", "wrapper.h", "wrapper.c", "pivots.h", "pivots.c")
LICENCE = "The engine of fairlead: MIT (documentation/licenses/license.txt). The model: as its author says."


class _Asked(NamedTuple):
    """What is to be exported."""

    netlist: Netlist
    settings: RunSettings
    system: System
    inputs: Sequence[str]
    version: int


def export(model: Model, file: str | os.PathLike[str] | None = None, *, version: int = 3, inputs: Iterable[str] = (),
           outputs: Iterable[str] = (), **settings: Unpack[RunKeywords]) -> pathlib.Path:  # fmt: skip
    """Write a model as a co-simulation FMU for Linux on x86-64, and return the file.

    Inputs and outputs are those of the netlist's `interface` block, and signal inputs and signals named by `inputs`
    and `outputs` (patterns with * and ?) under their names inside. `version` of the standard is 3 or 2, `settings`
    are those of `Model.run`. Without `file` it is the name of the model in this folder. An FMU of the same model has
    the same bytes.

    Raises ModelError as `Model.start` does, and UsageError for what cannot go along, without a C compiler, and where
    the file cannot be written.
    """
    from fairlead.netlist.keywords import with_keywords

    given = Arguments("export")
    given.model(model)
    given.path("file", file, none="None for the name of the model")
    given.texts("inputs", inputs, '"valve.command"')
    given.texts("outputs", outputs, '"spring.force"')
    given.refuse()
    refuse_version(version)
    refuse_platform()
    compiler()
    chosen = with_keywords(model.netlist.run, settings)
    refuse_engine(engine_of(chosen, model.system)[0])
    refuse_names(model.system, inputs, outputs)
    asked = _Asked(_with_outputs(model.netlist, model.system, outputs), chosen, model.system, list(inputs), version)
    name = identifier(model.netlist.name)
    target = pathlib.Path(f"{name}.fmu" if file is None else file)
    write(target, _made(asked, name))
    return target


def _with_outputs(netlist: Netlist, system: System, outputs: Iterable[str]) -> Netlist:
    """The netlist with these signals among the outputs of its interface."""
    signals = dict.fromkeys(signal.name for signal in system.signals)
    more = {name: Outer(of=name) for pattern in outputs for name in picked(signals, pattern)}
    interface = netlist.interface.model_copy(update={"outputs": netlist.interface.outputs | more})
    return dataclasses.replace(netlist, interface=interface)


def _made(asked: _Asked, name: str) -> bytes:
    """The bytes of the FMU."""
    netlist = asked.netlist
    if not netlist.interface.outputs:
        refuse_no_outputs()
    record = [outer.of for outer in netlist.interface.outputs.values()]
    run = Stepping(netlist, asked.settings, asked.system, asked.inputs, record)
    refuse_twice([one.name for one in run.variables])
    opened = laid_open(run)
    refuse_parts(opened.problem)
    code = objects(opened.engine, opened.problem)
    image = image_of(opened.memory, opened.problem, code.numbers)
    about = _about(asked, name, _token(image, code, run.variables))
    library = linked(_sources(opened, image, code, run.variables, about, asked.version))
    return packed({
        "modelDescription.xml": description(about, run.variables, asked.version),
        f"binaries/{FOLDERS[asked.version]}/{name}.so": library,
        "documentation/licenses/license.txt": _licence(),
    })  # fmt: skip


def _sources(
    opened: LaidOpen, image: Image, code: Code, variables: Sequence[Variable], about: About, version: int
) -> Mapping[str, bytes]:
    """Files for the compiler, by name."""
    columns = [opened.columns[one.of] for one in variables if one.causality == "output"]
    inputs = [one.name for one in variables if one.causality == "input"]
    text = header(opened.memory, opened.problem, image, code, columns=columns, inputs=inputs, token=about.token,
                  identifier=about.identifier)  # fmt: skip
    folder = importlib.resources.files("fairlead.fmu") / "c"
    own = {name: (folder / name).read_bytes() for name in (*SOURCES, f"fmi{version}.c")}
    made = {"model.h": text.encode(), "stubs.c": stubs(code).encode(), "data.o": data_object(image)}
    return {**own, **code.objects, **made}


def _about(asked: _Asked, name: str, token: str) -> About:
    netlist, settings = asked.netlist, asked.settings
    return About(
        name=netlist.name, identifier=name, description=netlist.description, token=token, digest=netlist.digest,
        version=importlib.metadata.version("fairlead"), licence=LICENCE, start=settings.start, stop=settings.stop,
        accuracy=settings.accuracy,
    )  # fmt: skip


def _token(image: Image, code: Code, variables: Sequence[Variable]) -> str:
    """What tells this library from all others: a hash of all that it is made of."""
    state = hashlib.sha256(repr((image.size, image.state, list(image.links), variables, code.functions)).encode())
    for part in (*(bytes(run) for _, run in image.runs), image.shared, *code.objects.values()):
        state.update(len(part).to_bytes(8, "little") + part)
    return f"{{{uuid.UUID(bytes=state.digest()[:16])}}}"


def _licence() -> bytes:
    """The text of fairlead's licence, as it was installed."""
    text = importlib.metadata.distribution("fairlead").read_text("licenses/LICENSE")
    return (text or "MIT\n").encode()
