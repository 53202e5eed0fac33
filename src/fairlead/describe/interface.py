"""What a user connects and sets: ports, parameters with unit, range and default, inputs and outputs."""

from __future__ import annotations

import dataclasses
import inspect
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from fairlead.component.declaration import Declaration
from fairlead.component.declare import Input, Output, State, Unknown
from fairlead.component.given import (
    REQUIRED,
    Block,
    Choice,
    Count,
    Entries,
    File,
    Matrix,
    Name,
    Parameter,
    Part,
    Stations,
    Table,
    Text,
    Waveform,
)  # fmt: skip
from fairlead.component.waveforms import TERMS
from fairlead.describe.columns import columns, heading, wrapped
from fairlead.errors import listing

NAMED = ("ports", "parameters", "inputs", "outputs", "states", "unknowns", "derived")


def interface(has: Declaration) -> Iterator[str]:
    """All sections; those that are empty are left out."""
    if has.ports:
        yield from heading("ports")
        yield from columns(
            (name, port.domain.name, _variables(port.domain), port.doc) for name, port in has.ports.items()
        )
    if has.parameters:
        yield from heading("parameters")
        yield from parameter_rows(has.parameters)
    if has.derived:
        yield from heading("numbers that follow from them")
        yield from derived_rows(has)
    yield from _signals("inputs", has.inputs)
    yield from _signals("outputs", has.outputs)
    yield from _signals("states", has.states)
    yield from _signals("unknowns", has.unknowns)


def connections(has: Declaration) -> Iterator[str]:
    """Ports, inputs and outputs: what a netlist joins."""
    if has.ports:
        yield from heading("ports")
        yield from columns(
            (name, port.domain.name, _variables(port.domain), port.doc) for name, port in has.ports.items()
        )
    yield from _signals("inputs", has.inputs)
    yield from _signals("outputs", has.outputs)


def shared(all_: Iterable[Declaration]) -> Declaration:
    """What several declarations have in common, by name."""
    first, *others = all_
    kept: dict[str, Any] = {
        field: {n: d for n, d in getattr(first, field).items() if all(n in getattr(o, field) for o in others)}
        for field in NAMED
    }
    return Declaration(**kept)


def beyond(has: Declaration, base: Declaration) -> Declaration:
    """What a declaration adds to another."""
    added: dict[str, Any] = {
        field: {n: d for n, d in getattr(has, field).items() if n not in getattr(base, field)} for field in NAMED
    }
    return dataclasses.replace(has, **added)


def first_line(thing: Any) -> str:
    """First line of a docstring."""
    return (inspect.getdoc(thing) or "").partition("\n")[0]


def parameter_rows(parameters: Mapping[str, Any], indent: int = 2) -> list[str]:
    """A line for every parameter, and for those of blocks below them."""
    lines = columns(parameter_cells(parameters), indent)
    said = about_waveforms(parameters)
    return [*lines, "", *wrapped(" " * indent + said, indent)] if said else lines


def parameter_cells(parameters: Mapping[str, Any], nested: str = "  ") -> list[tuple[str, str, str, str]]:
    """Name, what is allowed, default and sentence of every parameter; those of a block begin with `nested`."""
    rows = []
    for name, declared in parameters.items():
        rows.append((name, _allowed(declared), _default(declared), declared.doc))
        if isinstance(declared, Block):
            rows += [(f"{nested}{n}", _allowed(d), _default(d), d.doc) for n, d in declared.parameters.items()]
    return rows


def about_waveforms(parameters: Mapping[str, Any]) -> str:
    """What may stand for a parameter that varies in time; empty where there is none."""
    if not any(isinstance(declared, Waveform) for declared in parameters.values()):
        return ""
    return f"In time: a number, or a map of terms that add up: {listing(TERMS)} (docs/netlist.md)."


def derived_rows(has: Declaration, indent: int = 2) -> list[str]:
    """Numbers computed from the parameters, each with its sentence."""
    shown = {name: derived for name, derived in has.derived.items() if not name.startswith("_")}
    return columns(((name, first_line(derived.function)) for name, derived in shown.items()), indent)


def _variables(domain: Any) -> str:
    """`x [m], v [m/s]; force [N]`."""
    if not domain.across:
        return ""
    across = ", ".join(f"{name} [{unit}]" for name, unit in domain.across)
    return f"{across}; {domain.through[0]} [{domain.through[1]}]"


def _allowed(declared: Any) -> str:
    """Unit and range of a number, the words of a choice, what a part must be."""
    if isinstance(declared, Parameter):
        bounds = ((">", declared.above), (">=", declared.least), ("<", declared.below), ("<=", declared.most))
        limits = " and ".join(f"{sign} {bound:g}" for sign, bound in bounds if bound is not None)
        unit = f"unit of {declared.like}" if declared.like else declared.unit
        return f"[{unit}] {limits}".rstrip()
    if isinstance(declared, Choice):
        return " | ".join(declared.options)
    if isinstance(declared, Count):
        return f"whole number, {declared.least} to {declared.most}"
    if isinstance(declared, Name):
        return "name"
    if isinstance(declared, File):
        return f"file{declared.ending and f' (*{declared.ending})'}"
    if isinstance(declared, Entries):
        return "map"
    if isinstance(declared, Text | Matrix):
        return "text" if isinstance(declared, Text) else "matrix: a list of rows"
    if isinstance(declared, Part):
        return f"{declared.family.__name__}, see below"
    if isinstance(declared, Stations):
        return f"list of {declared.family.__name__}, see below"
    if isinstance(declared, Table):
        return f"table [{declared.x}] -> [{declared.y}]"
    return f"[{declared.unit}] in time" if isinstance(declared, Waveform) else "a map of"


def _default(declared: Any) -> str:
    default = getattr(declared, "default", None)
    if isinstance(declared, Block) and default is REQUIRED:
        return "required" if any(d.default is REQUIRED for d in declared.parameters.values()) else ""
    if default is REQUIRED or isinstance(declared, Stations):
        return "required"
    if default is None or default == ():
        return "may be left out"
    return f"= {default:g}" if isinstance(default, float) else f"= {default}"


def _signals(title: str, signals: Mapping[str, Input | Output | State | Unknown]) -> Iterator[str]:
    if signals:
        yield from heading(title)
        yield from columns((n, f"[{d.unit}]", " ".join([d.doc, _unconnected(d)]).strip()) for n, d in signals.items())


def _unconnected(declared: Any) -> str:
    if not isinstance(declared, Input):
        return ""
    if declared.default is None:
        return "Must be connected."
    value = declared.default if isinstance(declared.default, str) else f"{declared.default:g}"
    return f"{value} when nothing is connected."
