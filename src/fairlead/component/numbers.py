"""Every parameter of a model that is a number, with value and unit: of the scene, of components and inside them.

They bear the names that `--set` takes: `mu`, `pad.normal_force`, `pad.curve.stiction`. Counts, words, tables and what
was left out are none; a quantity in time is one where it is constant.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator, Mapping
from typing import Any

from fairlead.component.given import Block, Parameter, Stations, Waveform
from fairlead.component.tables import TableError
from fairlead.component.values import Group, Values, Wave
from fairlead.component.waveforms import numbers_in
from fairlead.netlist.netlist import Netlist, Value
from fairlead.quantities import KINDS, QuantityError, parse_unit, split, unit_text

Told = tuple[float, str, str]
"""Value [SI], unit and description."""


def numbers(netlist: Netlist, entries: Mapping[str, Values]) -> dict[str, tuple[float, str]]:
    """Value [SI] and unit of every parameter that is a number; `entries` are the components by name."""
    found = numbers_of_scene(netlist)
    return found | {name: (value, unit) for name, (value, unit, _) in _of_components(netlist, entries)}


def told_numbers(netlist: Netlist, entries: Mapping[str, Values]) -> dict[str, tuple[str, str]]:
    """Unit and description of every parameter that is a number, or may be; those of the scene have no description."""
    found = {name: (named_unit(unit), "") for name, (_, unit) in _of_scene(netlist)}
    for name, values in entries.items():
        for inner, declared in values.type.declaration.parameters.items():
            if isinstance(declared, Parameter | Waveform):
                found[f"{name}.{inner}"] = (declared.unit, declared.doc)
    return found | {name: (unit, doc) for name, (_, unit, doc) in _of_components(netlist, entries)}


def named_unit(unit: str) -> str:
    """A unit as it is called, `N` for `m*kg/s^2`; itself where it has no name."""
    if not unit or unit in KINDS:
        return unit
    wanted = parse_unit(unit)
    alike = (one for one in KINDS if (parse_unit(one).dimension, parse_unit(one).factor) == (wanted.dimension, 1.0))
    return next(alike, unit) if wanted.factor == 1.0 else unit


def _of_components(netlist: Netlist, entries: Mapping[str, Values]) -> Iterator[tuple[str, Told]]:
    for name, values in entries.items():
        written = netlist.components[name].parameters if name in netlist.components else {}
        yield from ((f"{name}.{inner}", one) for inner, one in _of_values(values, written))


def numbers_in_time(netlist: Netlist, entries: Mapping[str, Values]) -> dict[str, tuple[float, str]]:
    """Those that stand in terms of quantities in time: `push.force.ramp.to`, `push.force.sine.0.amplitude`."""
    found = {}
    for name, values in entries.items():
        for parameter, declared in values.type.declaration.parameters.items():
            given = netlist.components[name].parameters.get(parameter) if name in netlist.components else None
            if not isinstance(declared, Waveform) or given is None:
                continue
            with contextlib.suppress(TableError, QuantityError):  # a mistake is told where it is read
                for path, number, unit in numbers_in(given.plain(), declared.unit, name, parameter):
                    found[".".join(path)] = (number, unit)
    return found


def numbers_of_scene(netlist: Netlist) -> dict[str, tuple[float, str]]:
    """Value [SI] and unit of the numbers among the parameters of the scene."""
    return dict(_of_scene(netlist))


def _of_scene(netlist: Netlist) -> Iterator[tuple[str, tuple[float, str]]]:
    for name, value in netlist.parameters.items():
        if isinstance(value.content, bool) or not isinstance(value.content, str | int | float):
            continue
        text = str(value.content)
        try:
            number, unit = split(text)
            one = parse_unit(unit) if unit else None
        except QuantityError:
            continue
        yield name, (number * (one.factor if one else 1.0), unit_text(one.dimension) if one else "")


def _of_values(values: Values, written: Mapping[str, Value]) -> Iterator[tuple[str, Told]]:
    """Those of a component, or of a part of one, that is `written` so in the netlist."""
    declared = values.type.declaration.parameters
    for name, value in values.given.items():
        yield from _of_one(name, declared.get(name), value, written.get(name))


def _of_one(name: str, declared: Any, value: Any, node: Value | None) -> Iterator[tuple[str, Told]]:
    inside = node.entries if node is not None else {}
    if isinstance(value, Values) and node is not None and not isinstance(node.content, dict):
        short = getattr(value.type, "bare", None)  # a number that stands for the part, which no path leads into
        of = value.type.declaration.parameters.get(short[1]) if short else None
        yield from _of_one(name, of, value.given.get(short[1]), None) if isinstance(of, Parameter) and short else ()
    elif isinstance(value, Values):
        yield from ((f"{name}.{inner}", one) for inner, one in _of_values(value, inside))
    elif isinstance(value, Group) and isinstance(declared, Block):
        for inner, content in vars(value).items():
            found = _of_one(inner, declared.parameters.get(inner), content, inside.get(inner))
            yield from ((f"{name}.{more}", one) for more, one in found)
    elif isinstance(declared, Stations):
        nodes = node.content if node is not None and isinstance(node.content, list) else []
        for called, station, each in zip(Stations.names(value), value, nodes, strict=False):
            yield from ((f"{name}.{called}.{inner}", one) for inner, one in _of_values(station, each.entries))
    elif isinstance(declared, Parameter) and isinstance(value, int | float) and not isinstance(value, bool):
        yield name, (float(value), declared.unit, declared.doc)
    elif isinstance(declared, Waveform) and isinstance(value, Wave) and _is_steady(value):
        yield name, (value(0.0), declared.unit, declared.doc)


def _is_steady(wave: Wave) -> bool:
    return not wave.is_swinging and wave.polynomial.never_changes
