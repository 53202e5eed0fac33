"""What cannot go into an FMU, each with a sentence and a way out."""

from __future__ import annotations

import platform
import sys
from collections.abc import Collection, Iterable

from fairlead.errors import Fault, UsageError, did_you_mean, listing, shown
from fairlead.foreign.block import ForeignBlock
from fairlead.outer import gathered
from fairlead.patterns import picked
from fairlead.system.compiled.opened import free_inputs
from fairlead.system.compiled.system import Instance, System

MACHINES = ("x86_64", "AMD64")
VERSIONS = (2, 3)


def refuse_platform() -> None:
    """Raise UsageError on a system that FMUs are not made on."""
    if not (sys.platform == "linux" and platform.machine() in MACHINES):
        raise UsageError(
            f"FMUs are made on Linux for x86-64 only, and this is {sys.platform} on {platform.machine()}.\n"
            "    Export there, with --platform for the system that the file is to run on."
        )


def refuse_engine(engine: str) -> None:
    """Raise UsageError for an engine that cannot go along."""
    if engine == "ida":
        raise UsageError(
            "run.engine: ida works with SUNDIALS, which is a library of its own and does not go into an FMU.\n"
            "    Take run.engine: rodas or stepping."
        )


def refuse_parts(own: Instance) -> None:
    """Raise UsageError for components that need Python during a run."""
    called = {controller.instance.path: controller.instance.type for controller in own.controllers}
    foreign = sorted(path for path, kind in called.items() if issubclass(kind, ForeignBlock))
    plain = sorted(called.keys() - set(foreign))
    told = []
    if plain:
        told.append(
            f"{listing(plain)}: written in plain Python, which an FMU does not have.\n"
            "    Take other bundled controllers and signals (of a SampledSensor its effect sampling: off); or leave it "
            "out, name its signals as inputs and outputs, and let the master call it (docs/coupling.md)."
        )
    if foreign:
        told.append(
            f"{listing(foreign)}: an FMU inside, whose code does not go along.\n"
            "    Leave it out, name its signals as inputs and outputs, and let the master connect both."
        )
    if told:
        raise UsageError("\n".join(told))


def refuse_names(system: System, inputs: Iterable[str], outputs: Iterable[str], parameters: Iterable[Fault]) -> None:
    """Raise UsageError for inputs that are not free, outputs that no signal has, and what is wrong with parameters."""
    free = [name for one in free_inputs(system) for name in one.names]
    signals = dict.fromkeys(signal.name for signal in system.signals)
    wrong = [_unknown("--in", name, free, "input that is free", "Free inputs") for name in inputs if name not in free]
    wrong += [
        _gathered(name) if gathered(name)[0] else _unknown("--out", name, signals, "signal", "Signals")
        for name in outputs if not picked(signals, name)
    ]  # fmt: skip
    wrong += [f"{fault.what}\n    {fault.way_out}" for fault in parameters]
    if wrong:
        raise UsageError("\n".join(wrong))


def _gathered(name: str) -> str:
    return (
        f"--out {shown(name)}: the largest or the smallest of several signals needs a name of its own.\n"
        f'    Give it one in the netlist: `interface: {{outputs: {{NAME: {{of: "{name}"}}}}}}`.'
    )


def _unknown(option: str, name: str, known: Collection[str], what: str, several: str) -> str:
    near = did_you_mean(name, known)
    way_out = f"{several} are {listing(known)}." if known else "This model has none; see docs/coupling.md."
    return f"{option} {shown(name)}: there is no {what} of that name. {near}".rstrip() + f"\n    {way_out}"


def refuse_version(version: object) -> None:
    """Raise UsageError for a version of the standard that is not made."""
    if version not in VERSIONS:
        raise UsageError(f"version = {shown(version)}: FMUs are made for version 2 or 3 of the standard.")


def refuse_no_outputs() -> None:
    """Raise UsageError: nothing can be read from the FMU."""
    raise UsageError(
        "The FMU would have no output.\n"
        "    Name outputs with --out SIGNAL, or in the block `interface` of the netlist (docs/fmu.md)."
    )


def refuse_twice(names: Collection[str]) -> None:
    """Raise UsageError for names that an input and an output have."""
    twice = sorted({name for name in names if list(names).count(name) > 1})
    if twice:
        raise UsageError(
            f"{listing(twice)}: two of the inputs, outputs and parameters have this name.\n"
            "    Name one of them otherwise in the block `interface`, or leave it out."
        )
