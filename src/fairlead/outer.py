"""What a run that is stepped from outside can be set and asked: signals by their outer names, and mistakes in these.

    find_inputs(netlist, system, more)     inputs of the `interface` block and those named in `Model.start`
    find_outputs(netlist, signals)         columns of all names that can be read
    find_tunable(netlist, entries, more)   parameters of the `interface` block and those named in `Model.start`
    interface_faults(netlist, system)      all mistakes in the block

Numbers pass the border in SI. A unit says what a plain number of the model is; it cannot rescale.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple

from fairlead.analysis.record.suggestion import suggest
from fairlead.component.numbers import numbers, numbers_in_time
from fairlead.errors import Fault, Location, did_you_mean, listing, shown
from fairlead.netlist.interface import Interface, Outer, OuterInput
from fairlead.patterns import picked
from fairlead.quantities import QuantityError, fits, parse_unit, si
from fairlead.renamed import now_called
from fairlead.system.compiled.opened import FreeInput, free_inputs

if TYPE_CHECKING:
    from fairlead.component.values import Values
    from fairlead.netlist.netlist import Netlist
    from fairlead.system.arrays.recording import OutputSignal
    from fairlead.system.compiled.system import System


NO_INTERFACE = Interface()


class Variable(NamedTuple):
    """An input, an output or a parameter as a program outside sees it; numbers are in SI."""

    name: str
    causality: Literal["input", "output", "parameter"]
    of: str
    """The signal or the parameter inside."""
    unit: str
    """Its SI unit, `1` for a plain number."""
    description: str
    start: float | None
    """Of an input or a parameter the value until it is set; None for an output."""
    nominal: float
    """A usual size, above zero; 1 where the netlist gives none."""


class Read(NamedTuple):
    """What is read by a name: the largest or the smallest of some recorded values, mostly of one."""

    take: str
    """`max` or `min`."""
    columns: tuple[int, ...]


def gathered(of: str) -> tuple[str, str]:
    """`max` or `min` and the pattern of `max(line.hose[*].compressed)`; of a signal "" and its name."""
    fits = re.fullmatch(r"\s*(max|min)\s*\(\s*(.+?)\s*\)\s*", of)
    return (fits[1], fits[2]) if fits else ("", of)


class Found(NamedTuple):
    """An input that can be set."""

    free: FreeInput
    seen: Variable


def interface_faults(netlist: Netlist, entries: Mapping[str, Values], system: System) -> list[Fault]:
    """Mistakes in the `interface` block: inputs that cannot be set, outputs that nothing gives, units, numbers."""
    if netlist.interface == NO_INTERFACE:
        return []
    faults = find_inputs(netlist, system, ())[1] + find_outputs(netlist, system.signals)[2]
    return faults + find_tunable(netlist, entries, ())[1] + _twice(netlist)


def _twice(netlist: Netlist) -> list[Fault]:
    """Tunable parameters under the name of an input or an output."""
    interface = netlist.interface
    taken = dict.fromkeys(interface.outputs, "output") | dict.fromkeys(interface.inputs, "input")
    return [
        Fault(_place(netlist, "tunable", name), f"interface.tunable.{name}: an {taken[name]} has this name already.",
              "Give one of them another.")
        for name in interface.tunable if name in taken
    ]  # fmt: skip


def find_tunable(
    netlist: Netlist, entries: Mapping[str, Values], more: Iterable[str]
) -> tuple[tuple[Variable, ...], list[Fault]]:
    """Parameters by outer name, and what is wrong with others; `entries` are the components by name."""
    known = numbers(netlist, entries) | numbers_in_time(netlist, entries)
    given = netlist.interface.tunable | {name: Outer(of=name) for name in more}
    faults, found = list[Fault](), list[Variable]()
    for name, outer in given.items():
        what = f"interface.tunable.{name}" if name in netlist.interface.tunable else f"tunable {name}"
        place = _place(netlist, "tunable", name)
        if outer.of not in known:
            near = did_you_mean(outer.of, known)
            what = f"{what}: there is no parameter {shown(outer.of)} that is a number. {near}".rstrip()
            faults.append(Fault(place, what, f"There are {listing(known)}." if known else "This model has none."))
            continue
        value, unit = known[outer.of]
        variable, wrong = _variable(name, "parameter", outer, unit or "1", what, place)
        found.append(variable._replace(start=value))
        faults += wrong
    return tuple(found), faults


def find_inputs(netlist: Netlist, system: System, more: Iterable[str]) -> tuple[dict[str, Found], list[Fault]]:
    """Inputs by outer name; and what is wrong with others."""
    free = {name: one for one in free_inputs(system) for name in one.names}
    given = netlist.interface.inputs | {name: OuterInput(of=name) for name in more}
    faults, found, taken = [], {}, dict[tuple[int, int, int], str]()
    for name, outer in given.items():
        what, place = f"interface.inputs.{name}", _place(netlist, "inputs", name)
        one = free.get(outer.of)
        if one is None:
            faults.append(Fault(place, *_not_free(what, outer.of, list(free), system)))
        elif one.place in taken:
            faults.append(Fault(place, f"{what}: {outer.of} is {taken[one.place]} already.", "Give it one name."))
        else:
            taken[one.place] = name
            seen, wrong = _variable(name, "input", outer, one.declared.unit, what, place)
            faults += wrong
            found[name] = Found(one, seen._replace(start=one.value) if seen.start is None else seen)
    return found, faults


def find_outputs(
    netlist: Netlist, signals: Sequence[OutputSignal]
) -> tuple[dict[str, Read], tuple[Variable, ...], list[Fault]]:
    """What is read by all names that can be, outputs of the netlist, and what is wrong with these."""
    units = {signal.name: signal.unit for signal in signals}
    columns = {name: k for k, name in enumerate(units)}
    found = {name: Read("max", (k,)) for name, k in columns.items()}
    seen, faults = list[Variable](), list[Fault]()
    for name, outer in netlist.interface.outputs.items():
        what, place = f"interface.outputs.{name}", _place(netlist, "outputs", name)
        take, pattern = gathered(outer.of)
        of = picked(columns, pattern) if take else [now_called(pattern, columns) or pattern]
        if not of or of[0] not in columns:
            near, way_out = suggest(pattern, list(units))
            faults.append(Fault(place, f"{what}: no signal has the name {shown(pattern)}. {near}".rstrip(), way_out))
            continue
        if several := sorted({units[one] for one in of} - {units[of[0]]}):
            told = f"{what}: {shown(outer.of)} is of signals in {listing([units[of[0]], *several])}."
            faults.append(Fault(place, told, "Name signals of one unit."))
        found[name] = Read(take or "max", tuple(columns[one] for one in of))
        variable, wrong = _variable(name, "output", outer, units[of[0]], what, place)
        seen.append(variable)
        faults += wrong
    return found, tuple(seen), faults


def set_already(inputs: Mapping[str, Found], parameters: Mapping[str, str]) -> list[Fault]:
    """Parameters (outer name: inside) that are the start of an input: both would say what it is."""
    starts = {
        f"{free.rpartition('.')[0]}.start": name
        for name, one in inputs.items() for free in one.free.names if free.endswith(".value")
    }  # fmt: skip
    return [
        Fault(None, f"tunable {name}: {of} is what the input {starts[of]} is until it is set.", "Set the input.")
        for name, of in parameters.items() if of in starts
    ]  # fmt: skip


def _variable(
    name: str, causality: Literal["input", "output", "parameter"], outer: Outer, inside: str, what: str,
    place: Location | None,
) -> tuple[Variable, list[Fault]]:
    """How a signal of the unit `inside` is seen, and what does not fit."""
    unit, faults = _unit(outer.unit, inside, what, place)
    numbers: dict[str, float] = {}
    asked: Mapping[str, float | str | None] = {"start": getattr(outer, "start", None), "nominal": outer.nominal}
    for key, value in asked.items():
        if value is None:
            continue
        try:
            numbers[key] = si(value, unit)
        except QuantityError as error:
            faults.append(Fault(place, f"{what}.{key}: {error.what}.", error.allowed))
    if numbers.get("nominal", 1.0) <= 0:
        given = outer.nominal if isinstance(outer.nominal, str) else f"{outer.nominal:g}"
        faults.append(Fault(place, f"{what}.nominal = {given} is not above zero.", "Give a usual size of it."))
    nominal = numbers.get("nominal", 1.0)
    return Variable(name, causality, outer.of, unit, outer.description, numbers.get("start"), nominal), faults


def _unit(given: str, inside: str, what: str, place: Location | None) -> tuple[str, list[Fault]]:
    """The unit outside: that of the signal, or of a plain number what is given."""
    if not given:
        return inside, []
    try:
        unit, own = parse_unit(given), parse_unit(inside)
    except QuantityError as error:
        return inside, [Fault(place, f"{what}.unit: {error.what}.", error.allowed)]
    if inside != "1" and not fits(unit.dimension, own.dimension):
        return inside, [Fault(place, f"{what}.unit: {given} is no unit of a signal in {inside}.", f"Give {inside}.")]
    if unit.factor != 1.0:
        way_out = "Numbers are in SI outside too; a text such as '2 kN' brings its unit along."
        return inside, [Fault(place, f"{what}.unit: {given} is {unit.factor:g} of the SI unit.", way_out)]
    return given if inside == "1" else inside, []


def _place(netlist: Netlist, side: str, name: str) -> Location | None:
    """Where an entry of the `interface` block stands; of an argument of `Model.start`, that."""
    block = netlist.written.get("interface", {}).get(side)
    return block.entries[name].where if block is not None and name in block.entries else Location("Model.start")


def _not_free(what: str, signal: str, free: Collection[str], system: System) -> tuple[str, str]:
    """What is wrong with a signal that is no free input, and the way out."""
    if any(str(ref) == signal for ref in system.flat.sources):
        return f"{what}: {signal} is connected to a signal already.", "Take the connection away, or set what feeds it."
    if not free:
        return f"{what}: this model has no input that is free.", "Add a SignalInput, and connect its signal."
    near = did_you_mean(signal, free)
    return f"{what}: {shown(signal)} is no input that is free. {near}".rstrip(), f"Free inputs are {listing(free)}."
