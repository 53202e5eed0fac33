"""Remarks on values that can be computed with and are hardly meant: far outside what such a quantity ever is.

    mine.yaml:11:40: route.wheel.friction = 35 (`mu` of the scene) is far outside what it usually is, 0 to 2.

Who declares a parameter says what is usual (`Parameter(usual=...)`); for other ones the unit does, widely. Times are
held against the time that the run takes. Only what stands in the netlist is remarked, and what a class doubts itself
(`doubts` of answers.py).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from fairlead.component.assembly import Assembly
from fairlead.component.given import Parameter, Part, Stations, Waveform
from fairlead.component.parameters import said_of
from fairlead.component.values import Values, Wave
from fairlead.errors import Fault, Location, shown
from fairlead.netlist.netlist import Netlist, Value

BY_UNIT = {
    "m": 1e6, "m/s": 1e4, "rad/s": 1e6, "kg": 1e9, "N": 1e10, "N*m": 1e10, "Pa": 1e10, "kg*m^2": 1e12, "V": 1e6,
    "A": 1e6,
}  # fmt: skip
"""The most that quantities of a unit ever are in machines that move [SI]."""
FAR = 1e30
"""The most that any quantity is, of a unit that is not in the list, and one over the least that a size is [SI]."""
STRETCHED = 0.3
"""Strain of a line at the start from which on its stiffness or its tension is hardly meant; ropes break before."""


def unusual(assembly: Assembly) -> Iterator[Fault]:
    """Values of the netlist far outside what is usual, times that the run does not reach, and what classes doubt."""
    netlist = assembly.netlist
    for name, values in assembly.entries.items():
        if name not in assembly.stand_ins:
            entry, doubts = netlist.components[name], values.type.answers.doubts
            yield from _in(name, values, entry.parameters, netlist)
            yield from said_of(doubts(values) if doubts else (), entry.parameters, name, entry.where)
    for path, line in assembly.lines.items():
        yield from _stretched(path, line.line, netlist)


def _in(path: str, values: Values, written: Mapping[str, Value], netlist: Netlist) -> Iterator[Fault]:
    """What is odd in a component, or in a part of one."""
    periods = values.type.declaration.periods
    for name, declared in values.type.declaration.parameters.items():
        node, value = written.get(name), values.given.get(name)
        if node is None:
            continue
        where = f"{path}.{name}"
        if isinstance(declared, Parameter):
            yield from _number(where, declared, value, node)
            if name in periods:
                yield from _period(where, value, node, netlist)
        elif isinstance(declared, Part) and isinstance(value, Values):
            yield from _part(where, value, node, netlist)
        elif isinstance(declared, Stations) and isinstance(node.content, list):
            for k, (one, inner) in enumerate(zip(_listed(value), node.content, strict=False)):
                yield from _in(f"{where}[{k}]", one, inner.entries, netlist)
        elif isinstance(declared, Waveform) and isinstance(value, Wave):
            yield from _late(where, value, node, netlist)


def _listed(value: Any) -> list[Values]:
    return value if isinstance(value, list) else []


def _part(where: str, value: Values, node: Value, netlist: Netlist) -> Iterator[Fault]:
    """A part of a law; a bare number stands for one of its parameters."""
    if isinstance(node.content, dict):
        yield from _in(where, value, node.entries, netlist)
        return
    _, name = getattr(value.type, "bare", None) or ("", "")
    declared = value.type.declaration.parameters.get(name)
    if isinstance(declared, Parameter):
        yield from _number(where, declared, value.given.get(name), node)


def _number(where: str, declared: Parameter, value: Any, node: Value) -> Iterator[Fault]:
    if not isinstance(value, float | int) or isinstance(value, bool):
        return
    tiny = 1 / FAR if declared.above == 0 else 0.0
    least, most = declared.usual or (tiny, BY_UNIT.get(declared.unit, FAR))
    if value == 0 or least <= abs(value) <= most:
        return
    unit = "" if declared.unit == "1" else f" {declared.unit}"
    range_ = f"{least:g} to {most:g}{unit}" if declared.usual or abs(value) < least else f"up to {most:g}{unit}"
    what = f"{where} = {shown(node.plain())}{_from(node)} is far outside of what it usually is, {range_}."
    yield Fault(node.where, what, _meant(float(value), most, declared.unit))


def _from(node: Value) -> str:
    """The scene parameter a value comes from."""
    inside = node.written.strip().strip("{}").strip()
    return f" (parameter {inside})" if inside.isidentifier() else f" ({shown(node.written)})" if node.written else ""


def _meant(value: float, most: float, unit: str) -> str:
    """What may have been meant."""
    if unit == "1" and value > most:
        return f"Per cent are written {value:g} %, which is {value / 100:g}."
    if unit == "m" and value > most:
        return f"A bare number is in m; are {value:g} mm meant?"
    return "Is the unit meant? A bare number is in SI."


def _period(where: str, value: Any, node: Value, netlist: Netlist) -> Iterator[Fault]:
    lasts = netlist.run.stop - netlist.run.start
    if isinstance(value, float | int) and value > lasts:
        what = f"{where} = {value:g} s is longer than the run of {lasts:g} s, so nothing is ever sampled again."
        yield Fault(node.where, what, "Is ms meant? Give a shorter period, or a longer run.")


def _late(where: str, wave: Wave, node: Value, netlist: Netlist) -> Iterator[Fault]:
    """A quantity in time of which nothing happens before the run is over."""
    stop = netlist.run.stop
    begins = wave.borders[0] if wave.borders else -np.inf
    swings = wave.sine.amplitude != 0 or any(swing.polynomial.rows[0, 3:].any() for swing in wave.swings)
    if not swings and np.all(wave.polynomial.rows[0, 4:] == 0) and begins > stop:
        place = _of_time(node) or node.where
        what = f"{where} changes first at {begins:g} s, and the run ends at run.stop = {stop:g} s."
        yield Fault(place, what, "Let it begin earlier, or the run end later.")


def _of_time(node: Value) -> Location | None:
    """Where the time stands at which a step or a ramp begins."""
    for inner in _maps(node):
        for word in ("at", "start"):
            if word in inner.entries:
                return inner.entries[word].where
    return None


def _maps(node: Value) -> Iterator[Value]:
    """The terms of a quantity in time; several of a kind stand in a list."""
    for inner in node.entries.values():
        yield from inner.content if isinstance(inner.content, list) else (inner,)


def _stretched(path: str, line: Any, netlist: Netlist) -> Iterator[Fault]:
    """A line whose tension at the start stretches it more than any line bears."""
    if not hasattr(line, "stiffnesses"):
        return
    stiffness, tension = sum(line.stiffnesses), float(line.tension)
    if stiffness <= 0 or not tension > STRETCHED * stiffness:
        return
    entry = netlist.components.get(path)
    node = entry.parameters.get("tension") if entry is not None else None
    what = (
        f"{path}.tension = {tension:g} N stretches it by {100 * tension / stiffness:.3g} % of its length, "
        f"with a stiffness of {stiffness:g} N."
    )
    where = node.where if node is not None else entry.where if entry is not None else Location(str(netlist.name))
    yield Fault(where, what, "Lower the tension, or raise the stiffness, EA of the line.")


