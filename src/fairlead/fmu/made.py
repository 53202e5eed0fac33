"""What an FMU and a library of a model are both made of: the model as asked for, its memory, and its machine code."""

from __future__ import annotations

import dataclasses
import hashlib
import importlib.metadata
import importlib.resources
import uuid
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

from fairlead.engine import engine_of
from fairlead.fmu.compiler import compiler_for
from fairlead.fmu.data import data_object
from fairlead.fmu.header import header, stubs
from fairlead.fmu.image import Image, Laid, image_of, laid
from fairlead.fmu.machine_code import Code, objects
from fairlead.fmu.platforms import Platform, platforms_of
from fairlead.fmu.refusals import (
    refuse_engine,
    refuse_names,
    refuse_no_outputs,
    refuse_parts,
    refuse_platform,
    refuse_twice,
)
from fairlead.fmu.tuned import Another, Tuned, before_the_start, with_parameters
from fairlead.netlist.interface import Outer
from fairlead.outer import Variable, find_inputs, find_tunable, gathered, set_already
from fairlead.outside import LaidOpen, Stepping, laid_open
from fairlead.patterns import picked
from fairlead.tuning import moved_at_once

if TYPE_CHECKING:
    from fairlead.model import Model
    from fairlead.netlist.keywords import RunKeywords
    from fairlead.netlist.netlist import Netlist
    from fairlead.netlist.settings import RunSettings
    from fairlead.system.compiled.system import System

RUN = ("offered.h", "run.h", "run.c", "image.h", "pivots.h", "pivots.c", "tuned.h", "tuned.c")
"""C of a run, which every kind of library has."""


class Asked(NamedTuple):
    """What is to be made."""

    model: Model
    netlist: Netlist
    """That of the model, with all outputs in its interface."""
    settings: RunSettings
    inputs: Sequence[str]
    tunable: Sequence[Variable]
    """Parameters that can be set while it runs."""
    platforms: Sequence[Platform]
    """Systems that libraries are made for."""


class Made(NamedTuple):
    """A model ready to be linked."""

    opened: LaidOpen
    image: Image
    code: Code
    variables: Sequence[Variable]
    tuned: Sequence[Tuned]
    token: str


def asked_of(
    model: Model, inputs: Iterable[str], outputs: Iterable[str], tunable: Iterable[str], settings: RunKeywords,
    called: str, platforms: Iterable[str] = (),
) -> Asked:  # fmt: skip
    """What is asked for by a call, or UsageError for what this machine or a copy of the model cannot do."""
    from fairlead.netlist.keywords import with_keywords

    refuse_platform()
    targets = platforms_of(platforms)
    for one in targets:
        compiler_for(one)
    chosen = with_keywords(model.netlist.run, settings, model.netlist.parameters, called)
    refuse_engine(engine_of(chosen, model.system)[0])
    parameters, faults = find_tunable(model.netlist, model.assembly.entries, tunable)
    given, _ = find_inputs(model.netlist, model.system, inputs)
    faults += set_already(given, {one.name: one.of for one in parameters})
    refuse_names(model.system, inputs, outputs, faults)
    netlist = _with_outputs(model.netlist, model.system, outputs)
    return Asked(model, netlist, chosen, list(inputs), parameters, targets)


def _with_outputs(netlist: Netlist, system: System, outputs: Iterable[str]) -> Netlist:
    """The netlist with these signals among the outputs of its interface."""
    signals = dict.fromkeys(signal.name for signal in system.signals)
    more = {name: Outer(of=name) for pattern in outputs for name in picked(signals, pattern)}
    interface = netlist.interface.model_copy(update={"outputs": netlist.interface.outputs | more})
    return dataclasses.replace(netlist, interface=interface)


LOOKS = (0.13, 0.37, 0.61, 0.83)
"""Shares of a run at which it is asked whether a place follows a parameter; no period of anything."""


def made_of(asked: Asked) -> Made:
    """Memory and machine code of a run at its start. Raises UsageError for parts that cannot go along."""
    if not asked.netlist.interface.outputs:
        refuse_no_outputs()
    run = _run_of(asked, asked.model)
    variables = [*run.variables, *asked.tunable]
    refuse_twice([one.name for one in variables])
    opened = laid_open(run)
    refuse_parts(opened.problem)
    code = objects(opened.engine, opened.problem, asked.platforms)

    def lay(value: Mapping[str, float], moved: Collection[str]) -> Laid:
        other = laid_open(_run_of(asked, _alike(asked.model, value))) if value else opened
        return laid(other.memory, other.problem, code.numbers, moved)

    found, tuned = with_parameters(asked.tunable, lay, opened)
    moved = [_moves_at_once(asked, inside.of, one) for inside, one in zip(asked.tunable, tuned, strict=True)]
    tuned = [before_the_start(one) if moves else one for one, moves in zip(tuned, moved, strict=True)]
    image = image_of(opened.memory, opened.problem, found)
    return Made(opened, image, code, variables, tuned, _token(image, code, variables, tuned))


def _moves_at_once(asked: Asked, inside: str, parameter: Tuned) -> bool:
    """True if another value that it takes would, during the run, move at once what moves as given."""
    other = asked.model.with_values({inside: parameter.low if parameter.low < parameter.value else parameter.high})
    begin, end = asked.settings.start, asked.settings.stop
    times = (begin + share * (end - begin) for share in LOOKS)
    return any(moved_at_once(asked.model.system, other.system, t) for t in times)


def _alike(model: Model, value: Mapping[str, float]) -> Model:
    """The model with another value. Raises Another where it is not of the same structure and the same times."""
    other = model.with_values(value)
    if other.rebuilt:
        raise Another(f"the structure depends on it ({other.rebuilt.partition(': ')[2].removesuffix('.')})")
    systems = (model.system, other.system)
    times = [[table.polynomial.left.tolist() for table in one.timed_tables] for one in systems]
    periods = [one.memory["sample_period"].tolist() for one in systems]
    if times[0] != times[1] or periods[0] != periods[1]:
        raise Another("it says at which times something happens")
    return other


def _run_of(asked: Asked, model: Model) -> Stepping:
    """A run of a model of this structure, at its start."""
    record = [gathered(outer.of)[1] for outer in asked.netlist.interface.outputs.values()]
    return Stepping(asked.netlist, asked.settings, model.system, asked.inputs, record)


def sources(made: Made, identifier: str, own: Sequence[str], platform: Platform) -> Mapping[str, bytes]:
    """Files for a platform's compiler, by name: those of a run, and of the folder `c` those named `own`."""
    columns = [made.opened.columns[one.name] for one in made.variables if one.causality == "output"]
    names = {
        causality: [one.name for one in made.variables if one.causality == causality]
        for causality in ("input", "output")
    }
    text = header(made.opened, made.image, made.code, columns=columns, names=names,
                  tuned=made.tuned, token=made.token, identifier=identifier)  # fmt: skip
    folder = importlib.resources.files("fairlead.fmu") / "c"
    files = {name: (folder / name).read_bytes() for name in (*RUN, *own)}
    generated = {"model.h": text.encode(), "stubs.c": stubs(made.code).encode()}
    return {**files, **made.code.objects[platform.name], **generated, "data.o": data_object(made.image, platform)}


def _token(image: Image, code: Code, variables: Sequence[Variable], tuned: Sequence[Tuned]) -> str:
    """What tells this library from all others: a hash of all that it is made of."""
    told = (image.size, image.state, list(image.links), variables, tuned, code.functions)
    state = hashlib.sha256(repr(told).encode())
    machine_code = (part for found in code.objects.values() for part in found.values())
    for part in (*(bytes(run) for _, run in image.runs), image.shared, *machine_code):
        state.update(len(part).to_bytes(8, "little") + part)
    return f"{{{uuid.UUID(bytes=state.digest()[:16])}}}"


def own_version() -> str:
    """Of fairlead."""
    return importlib.metadata.version("fairlead")
