"""What an FMU and a library of a model are both made of: the model as asked for, its memory, and its machine code."""

from __future__ import annotations

import dataclasses
import hashlib
import importlib.metadata
import importlib.resources
import uuid
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from fairlead.fmu.compiler import compiler
from fairlead.fmu.data import data_object
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
)
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

RUN = ("run.h", "run.c", "image.h", "pivots.h", "pivots.c")
"""C of a run, which every kind of library has."""


class Asked(NamedTuple):
    """What is to be made."""

    netlist: Netlist
    settings: RunSettings
    system: System
    inputs: Sequence[str]


class Made(NamedTuple):
    """A model ready to be linked."""

    opened: LaidOpen
    image: Image
    code: Code
    variables: Sequence[Variable]
    token: str


def asked_of(model: Model, inputs: Iterable[str], outputs: Iterable[str], settings: RunKeywords) -> Asked:
    """What is asked for, or UsageError for what this machine or a copy of the model cannot do."""
    from fairlead.netlist.keywords import with_keywords

    refuse_platform()
    compiler()
    chosen = with_keywords(model.netlist.run, settings)
    refuse_engine(engine_of(chosen, model.system)[0])
    refuse_names(model.system, inputs, outputs)
    return Asked(_with_outputs(model.netlist, model.system, outputs), chosen, model.system, list(inputs))


def _with_outputs(netlist: Netlist, system: System, outputs: Iterable[str]) -> Netlist:
    """The netlist with these signals among the outputs of its interface."""
    signals = dict.fromkeys(signal.name for signal in system.signals)
    more = {name: Outer(of=name) for pattern in outputs for name in picked(signals, pattern)}
    interface = netlist.interface.model_copy(update={"outputs": netlist.interface.outputs | more})
    return dataclasses.replace(netlist, interface=interface)


def made_of(asked: Asked) -> Made:
    """Memory and machine code of a run at its start. Raises UsageError for parts that cannot go along."""
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
    return Made(opened, image, code, run.variables, _token(image, code, run.variables))


def sources(made: Made, identifier: str, own: Sequence[str]) -> Mapping[str, bytes]:
    """Files for the compiler, by name: those of a run, and of the folder `c` those named `own`."""
    columns = [made.opened.columns[one.of] for one in made.variables if one.causality == "output"]
    names = {
        causality: [one.name for one in made.variables if one.causality == causality]
        for causality in ("input", "output")
    }
    text = header(made.opened.memory, made.opened.problem, made.image, made.code, columns=columns, names=names,
                  token=made.token, identifier=identifier)  # fmt: skip
    folder = importlib.resources.files("fairlead.fmu") / "c"
    files = {name: (folder / name).read_bytes() for name in (*RUN, *own)}
    generated = {"model.h": text.encode(), "stubs.c": stubs(made.code).encode(), "data.o": data_object(made.image)}
    return {**files, **made.code.objects, **generated}


def _token(image: Image, code: Code, variables: Sequence[Variable]) -> str:
    """What tells this library from all others: a hash of all that it is made of."""
    state = hashlib.sha256(repr((image.size, image.state, list(image.links), variables, code.functions)).encode())
    for part in (*(bytes(run) for _, run in image.runs), image.shared, *code.objects.values()):
        state.update(len(part).to_bytes(8, "little") + part)
    return f"{{{uuid.UUID(bytes=state.digest()[:16])}}}"


def own_version() -> str:
    """Of fairlead."""
    return importlib.metadata.version("fairlead")
