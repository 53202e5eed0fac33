"""Laws turned into expressions: each class variant is run once with SymPy symbols.

    traced = trace(variant)
    traced.zones["taut"].flows["a"]        -> -stiffness*(b.x - a.x - length)

A law that branches on a value, reads an acceleration, or uses a function that is not smooth cannot
be frozen inside a step; it is refused with the author's file and line.
"""

from __future__ import annotations

import contextlib
import inspect
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import sympy

from fairlead.component.author import called_with
from fairlead.component.class_checks import source_place
from fairlead.component.declaration import Declaration
from fairlead.component.declare import Law
from fairlead.component.dimensions import line_of, misfits
from fairlead.component.hold_rows import (
    HoldRow,
    check_everywhere,
    position_row,
    position_side,
    put_on_ports,
    slip_row,
    slip_side,
    stop_row,
)
from fairlead.component.holding import Hold, HoldPosition
from fairlead.component.keys import PORT, key
from fairlead.component.quantity import watched
from fairlead.component.replies import is_bundled
from fairlead.component.symbols import TraceError, symbol
from fairlead.component.terms import LEDGER, terms_of
from fairlead.component.trace_readers import PortReader, Recorder
from fairlead.component.values import Variant
from fairlead.errors import shown

SMOOTH = (sympy.exp, sympy.log, sympy.sin, sympy.cos, sympy.tan, sympy.tanh, sympy.atan)  # what a kernel can compute
KINKED = (sympy.Abs, sympy.Max, sympy.Min, sympy.sign)  # so these too, in guards and in outputs that are recorded only


class Unsaid(sympy.Function):
    """A function of a part that a listing leaves open, such as `curve.coefficient`; no kernel has one."""

    is_real = True


@dataclass
class TracedGuard:
    """A guard in one zone: it fires when all `values` have risen through zero."""

    name: str
    to: str
    unit: str
    values: list[sympy.Expr]
    table: str = ""  # for the border of a table's interval: the table, and the step of its index
    step: int = 0


@dataclass
class TracedZone:
    """Everything one zone says, as expressions of the symbols in `Traced`."""

    flows: dict[str, sympy.Expr] = field(default_factory=dict)  # port -> what it takes in
    own: dict[str, sympy.Expr] = field(default_factory=dict)  # state -> rate, unknown -> what is zero
    holds: dict[str, HoldRow] = field(default_factory=dict)  # unknown -> hold row
    outputs: dict[str, sympy.Expr] = field(default_factory=dict)
    ledger: dict[str, sympy.Expr] = field(default_factory=dict)
    guards: list[TracedGuard] = field(default_factory=list)
    tables: dict[str, sympy.Expr] = field(default_factory=dict)  # table -> where it is read


@dataclass
class Traced:
    """A class variant as expressions. Symbols carry the key of what they stand for as their name."""

    variant: Variant
    zones: dict[str, TracedZone]
    tables: list[str]
    time_tables: list[str]
    sample: dict[str, sympy.Expr] = field(default_factory=dict)  # discrete variable -> its next value


def trace(variant: Variant) -> Traced:
    """Run every law and guard of a class variant with symbols. Raises TraceError."""
    foreign = [one for one in (variant, *_parts(variant)) if not is_bundled(one.type)]
    with watched() if foreign else contextlib.nullcontext():
        return _trace(variant, foreign)


def _trace(variant: Variant, foreign: list[Variant]) -> Traced:
    has = variant.type.declaration
    zones = {name: _trace_zone(variant, has, name) for name in has.zones}
    check_everywhere(((name, zone.holds) for name, zone in zones.items()), lambda: source_place(variant.type))
    for name, zone in zones.items():
        ways_in = [value for other in zones.values() for g in other.guards if g.to == name for value in g.values]
        zone.holds = {unknown: stop_row(row, ways_in) for unknown, row in zone.holds.items()}
    tables = list(dict.fromkeys(path for zone in zones.values() for path in zone.tables))
    timed = [p for p in tables if any(z.tables.get(p) == symbol("t") for z in zones.values())]
    for zone in zones.values():
        zone.guards += [guard for path in zone.tables if path not in timed for guard in _borders(path, zone)]
    if foreign:
        _check_units(variant, has, zones, foreign)
        _check_outputs(variant, has, zones)
    return Traced(variant, zones, tables, timed, _trace_sample(variant, has))


def _parts(variant: Variant) -> Iterator[Variant]:
    for _, part in variant.parts:
        yield part
        yield from _parts(part)


def _check_units(variant: Variant, has: Declaration, zones: dict[str, TracedZone], foreign: list[Variant]) -> None:
    """Refuse a law of a user's own class, or with a part of one, whose units do not go together. Raises TraceError."""
    if "units" in variant.type.answers.exempt:
        return
    for wrong in misfits(variant, zones):
        code = wrong.function.__code__
        given = _arguments(variant, has, wrong.zone, {})
        given |= {"direction": wrong.direction} if wrong.direction else {}
        files = {inspect.getsourcefile(one.type) or "" for one in foreign}
        names = code.co_varnames[: code.co_argcount]
        place = line_of(wrong.function, {name: given[name] for name in names}, variant, files)
        raise TraceError(f"{place}: {wrong.function.__qualname__}: {wrong.what}")


def _check_outputs(variant: Variant, has: Declaration, zones: dict[str, TracedZone]) -> None:
    """Refuse an output of a user's class that no law gives; what is off may take its outputs along."""
    if is_bundled(variant.type) or "off" in dict(variant.words).values():
        return
    for name in has.outputs:
        if not any(name in zone.outputs for zone in zones.values()):
            place, kind = source_place(next(iter(has.laws.values()))), variant.type.__name__
            raise TraceError(f"{place}: {kind}: no law gives the output {name!r}. Add it: Law(..., {name}=...)")


def _trace_sample(variant: Variant, has: Declaration) -> dict[str, sympy.Expr]:
    """The next values of discrete variables; they are set at sample times, so they need not be smooth."""
    for sample in has.samples.values():
        reads: dict[str, sympy.Expr] = {}
        said = called_with(sample.law, _arguments(variant, has, has.zones[0], reads))
        terms = said.terms if isinstance(said, Law) else {}
        if set(terms) != set(has.discrete) or reads:
            raise TraceError(
                f"{source_place(sample.law)}: a sampled law gives Law({', '.join(has.discrete)}) and reads no table"
            )
        return {name: _expression(value, sample.law) for name, value in terms.items()}
    return {}


def trace_function(
    variant: Variant, function: Callable[..., Any], *arguments: sympy.Expr
) -> tuple[Any, dict[str, sympy.Expr]]:
    """What a function of a class, such as a curve's `coefficient`, gives; and the tables it reads, where."""
    reads: dict[str, sympy.Expr] = {}
    function = inspect.unwrap(function)
    names = function.__code__.co_varnames
    return called_with(function, dict(zip(names, (Recorder(variant, "", reads), *arguments), strict=False))), reads


def _trace_zone(variant: Variant, has: Declaration, name: str) -> TracedZone:
    zone, law = TracedZone(), has.laws[name]
    arguments = _arguments(variant, has, name, zone.tables)
    for term, value in _terms(variant, law, arguments):
        if term in has.ports:
            zone.flows[term] = _smooth(value, law)
        elif isinstance(value, Hold | HoldPosition):
            row = zone.holds[term] = _hold_row(value, has, law)
            zone.own[term] = slip_side(row.slip) if row.gap is None else position_side(row, term)
        elif term in has.outputs:
            zone.outputs[term] = _expression(value, law)
        elif term in LEDGER:
            zone.ledger[term] = _power(value, law)
        else:
            zone.own[term] = _smooth(value, law)
    _put_on_ports(zone, variant, law)
    for name in has.outputs.keys() & has.discrete.keys():  # what a controller in plain Python holds
        zone.outputs[name] = symbol(f"p:#{name}")
    for line in LEDGER:
        method = getattr(variant.type.answers, line)
        if method is not None and line not in zone.ledger:
            zone.ledger[line] = _power(called_with(method, arguments), method)
    for label, mark in has.guards.items():
        if name in mark.zones:
            said = called_with(mark.function, arguments | ({"direction": mark.direction} if mark.direction else {}))
            if said is None and _leaves_out(variant):
                continue  # an effect that is off takes the guard with it
            if said is None or (isinstance(said, tuple) and not said):
                place = source_place(mark.function)
                raise TraceError(f"{place}: the guard {label!r} gives nothing in {name!r}; does it lack a return?")
            values = [_expression(v, mark.function) for v in (said if isinstance(said, tuple) else (said,))]
            zone.guards.append(TracedGuard(label, mark.to, mark.unit, values))
    return zone


def _leaves_out(variant: Variant) -> bool:
    """Whether something was chosen or not given that a guard may go with."""
    return is_bundled(variant.type) or any(one.words or one.absent for one in (variant, *_parts(variant)))


def _arguments(variant: Variant, has: Declaration, zone: str, reads: dict[str, sympy.Expr]) -> dict[str, Any]:
    given = {
        "p": Recorder(variant, "", reads),
        "t": symbol("t"),
        "zone": zone,
        "direction": has.zones.direction(zone),
        **{name: PortReader(name, port) for name, port in has.ports.items()},
        **{name: symbol(f"in:{name}") for name in has.inputs},
        **{name: symbol(f"own:{name}") for name in (*has.states, *has.unknowns)},
        **{name: symbol(f"p:#{name}") for name in has.discrete},
    }
    return given | {name: called_with(shared.function, given) for name, shared in has.shared.items()}


def _terms(variant: Variant, law: Callable[..., Any], arguments: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    said = called_with(law, arguments)
    try:
        yield from terms_of(variant.type, said).items()
    except TypeError as error:
        raise TraceError(f"{source_place(law)}: {variant.type.__name__}: {error}") from error


def _expression(value: Any, function: Callable[..., Any]) -> sympy.Expr:
    """What an author's function gave, when a kernel can compute it."""
    place = source_place(function)
    if isinstance(value, PortReader):
        one = f"the port {value.port!r}, which is not a number; take one of its variables, such as {value.such_as}"
        raise TraceError(f"{place}: {function.__name__} gives {one}")
    if isinstance(value, np.ndarray):
        one = f"{shown(str(value))}, an array; take one of its numbers, such as {'x[0]' if value.ndim else 'x.item()'}"
        raise TraceError(f"{place}: {function.__name__} gives {one}")
    if isinstance(value, str | bool) or not (
        isinstance(value, int | float | sympy.Expr) or hasattr(value, "__float__")
    ):
        raise TraceError(f"{place}: {function.__name__} gives {value!r}, which is not a number")
    expression = sympy.sympify(value)
    if expression.has(sympy.nan, sympy.zoo, sympy.oo):
        raise TraceError(f"{place}: {function.__name__} gives {expression}, which is not finite")
    if expression.has(sympy.I):
        raise TraceError(f"{place}: {function.__name__} gives {expression}, which is not a real number")
    for part in expression.atoms(sympy.Function, sympy.Max, sympy.Min, sympy.Piecewise):
        if not isinstance(part, (*SMOOTH, *KINKED, Unsaid)):
            raise TraceError(f"{place}: {part} cannot be compiled; use the functions of fairlead.component")
    return expression


def is_kinked(expression: sympy.Expr) -> bool:
    """True when an expression has a corner somewhere, so that its derivative is no use to a solver."""
    return bool(expression.atoms(*KINKED))


def read_in_python(has: Declaration) -> list[str]:
    """Keys of what a controller in plain Python may ask for: its inputs, and the motion of its ports."""
    ports = [f"port:{name}:{kind}" for name, port in has.ports.items() for kind in "xv"[: len(port.domain.across)]]
    return ["t", *(f"in:{name}" for name in has.inputs), *ports] if has.python else []


def _smooth(value: Any, law: Callable[..., Any]) -> sympy.Expr:
    expression = _expression(value, law)
    kinks = sorted(map(str, expression.atoms(*KINKED)))
    if kinks:
        raise TraceError(f"{source_place(law)}: {kinks[0]} is not smooth; give each branch a zone")
    return _without(expression, law, ("a", "R"), "a law must not read an acceleration or a reaction")


def _power(value: Any, law: Callable[..., Any]) -> sympy.Expr:
    """A line of the ledger; it may read a reaction, which is known by then."""
    return _without(_expression(value, law), law, ("a",), "power and energy must not read an acceleration")


def _without(expression: sympy.Expr, law: Callable[..., Any], parts: tuple[str, ...], what: str) -> sympy.Expr:
    read = sorted(one for s in expression.free_symbols if (one := key(s.name)).kind == PORT and one.part in parts)
    if read:
        said = "acceleration" if read[0].part == "a" else "reaction"
        raise TraceError(f"{source_place(law)}: {what} ({read[0].name}'s {said})")
    return expression


def _hold_row(said: Hold | HoldPosition, has: Declaration, law: Callable[..., Any]) -> HoldRow:
    if isinstance(said, HoldPosition):
        return position_row(_smooth(said.gap, law), has.ports, source_place(law))
    within = None if said.within is None else _smooth(said.within, law)
    restitution = _smooth(0 if said.restitution is None else said.restitution, law)
    return slip_row(_smooth(said.slip, law), within, restitution, source_place(law))


def _put_on_ports(zone: TracedZone, variant: Variant, law: Callable[..., Any]) -> None:
    """Let what keeps relations of positions act on the ports; the law need not speak of those."""
    kept = {unknown: row for unknown, row in zone.holds.items() if row.gap is not None}
    for unknown, row in kept.items():
        put_on_ports(zone.flows, row, unknown, source_place(law))
    left = set(variant.type.declaration.ports) - set(zone.flows)
    if kept and left and variant.type.answers.prescribes is None:
        raise TraceError(f"{source_place(law)}: the law leaves out {sorted(left)}, which its gap does not read")


def _borders(path: str, zone: TracedZone) -> list[TracedGuard]:
    """Leaving the interval of a table to the right and to the left."""
    at = zone.tables[path]
    right, left = symbol(f"T:{path}:right"), symbol(f"T:{path}:left")
    return [
        TracedGuard(f"{path} next", "", "1", [at - right], path, +1),
        TracedGuard(f"{path} previous", "", "1", [left - at], path, -1),
    ]
