"""Rates of what a component takes in at its ports, differentiated once when its class is traced.

    d(flow)/dt = sum of d(flow)/d(input) * d(input)/dt        for every zone and port

A position changes by its speed, a state by its rate, time by 1, a signal by a signal of its own (`in:normal:rate`), an
unknown by what the row that gives it leaves; parameters stay. A speed changes by an acceleration, which no law knows:
where a flow depends on speeds, these are left out, and the zone *joins* the ports (`joins`). So does a row that holds:
its force is whatever keeps the slip at zero.

Nodes without inertia have their speeds from such rates, see algebraic_nodes.py.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import sympy

from fairlead.component.declaration import Declaration
from fairlead.component.keys import INPUT, OWN, PARAMETER, PORT, RATE, TABLE, TIME, key, rate_of
from fairlead.component.trace import TracedZone, symbol
from fairlead.kernels.break_away import parameters_as_text
from fairlead.kernels.derivative import derivative, symbols_in
from fairlead.kernels.in_floats import differs

UNIT_RATIOS = (-1, 1)


class NoRateError(Exception):
    """What varies in a way that no law tells; the text says what."""


def flow_rates(zone: TracedZone, has: Declaration) -> tuple[dict[str, sympy.Expr], dict[str, str]]:
    """By port the rate of what it takes in, where it is known; by port what hinders, where it is not."""
    rates: dict[str, sympy.Expr] = {}
    hindered: dict[str, str] = {}
    for port, flow in zone.flows.items():
        try:
            rates[port] = rate(flow, zone, has)
        except NoRateError as why:
            hindered[port] = str(why)
    return rates, hindered


def output_rates(zones: Iterable[TracedZone], names: Iterable[str], has: Declaration) -> list[dict[str, sympy.Expr]]:
    """By zone the rates of outputs, under the names that signals have; of those whose rates are known in all zones."""
    made: list[dict[str, sympy.Expr]] = [{} for _ in zones]
    for name in names:
        try:
            known = [rate(zone.outputs.get(name, sympy.S.Zero), zone, has, speeds=False) for zone in zones]
        except NoRateError:
            continue
        for of_zone, value in zip(made, known, strict=True):
            of_zone[rate_of(name)] = value
    return made


def rate(value: sympy.Expr, zone: TracedZone, has: Declaration, *, speeds: bool = True) -> sympy.Expr:
    """The rate of an expression of a zone, without what accelerations add, if it may read `speeds`.

    Raises NoRateError.
    """
    total = sympy.S.Zero
    read = (s for s in symbols_in(value) if key(s.name).kind == PORT and key(s.name).part != "x")
    if not speeds and any(read):
        raise NoRateError("a speed")
    for s in sorted(symbols_in(value), key=lambda s: s.name):
        total += derivative(value, s) * _rate_of(s, zone, has)
    return total


def _rate_of(s: sympy.Symbol, zone: TracedZone, has: Declaration) -> sympy.Expr:
    one = key(s.name)
    if one.kind in (PARAMETER, TABLE) or (one.kind == PORT and one.part != "x"):
        return sympy.S.Zero
    if one.kind == TIME:
        return sympy.S.One
    if one.kind == INPUT:
        return symbol(f"in:{one.name}:{RATE}")
    if one.kind == PORT:
        if not has.ports[one.name].domain.mechanical:
            raise NoRateError(f"the {has.ports[one.name].domain.across[0][0]} at {one.name}")
        return symbol(f"port:{one.name}:v")
    assert one.kind == OWN
    if one.name in has.states:
        return zone.own.get(one.name, sympy.S.Zero)
    if one.name in zone.holds:
        return sympy.S.Zero
    row = zone.own.get(one.name, sympy.S.Zero)
    slope = derivative(row, s)
    if slope == 0 or s in symbols_in(slope):
        raise NoRateError(f"{one.name}, which its law does not give alone")
    return -rate(row.xreplace({s: sympy.S.Zero}), zone, has) / slope


def yields(zone: TracedZone, has: Declaration) -> set[str]:
    """Ports whose flow knows a state that follows a speed: a jump there would not be one of positions alone."""
    found = set()
    for port, flow in zone.flows.items():
        states = [key(s.name).name for s in symbols_in(_resolved(flow, zone, has)) if key(s.name).kind == OWN]
        rates = (zone.own.get(name, sympy.S.Zero) for name in states if name in has.states)
        if any(key(s.name).is_speed for value in rates for s in symbols_in(value)):
            found.add(port)
    return found


def joins(zone: TracedZone, has: Declaration) -> list[dict[str, Any]]:
    """What joins the speeds of ports in a zone: rows that hold, and forces that depend on speeds.

    `weights` is what a port takes in, by port, over what another does, where these are numbers; `slope` is the text of
    what a force grows by with a speed where that is made of parameters ("1" where inputs too, as a normal force, but no
    motion), "" where it is more, "held" for a row.
    """
    found = []
    for unknown, row in zone.holds.items():
        u = symbol(f"own:{unknown}")
        weights = {port: derivative(flow, u) for port, flow in zone.flows.items()}
        ports = sorted({key(one).name for one in row.rates})
        found.append(_join(ports, {port: weights.get(port, sympy.S.Zero) for port in ports}, "held"))
    flows = {port: _resolved(flow, zone, has) for port, flow in zone.flows.items()}
    speeds = sorted({s for flow in flows.values() for s in symbols_in(flow) if key(s.name).is_speed}, key=str)
    if speeds:
        ports = sorted({key(s.name).name for s in speeds})
        slopes = [derivative(flow, s) for flow in flows.values() for s in speeds]
        read = {key(s.name) for slope in slopes for s in symbols_in(slope)}
        plain = all(one.is_fixed for one in read)
        steady = all(one.is_fixed or one.kind == INPUT for one in read)
        text = parameters_as_text(sum(sympy.Abs(slope) for slope in slopes)) if plain else "1" if steady else ""
        found.append(_join(ports, _ratios(flows, ports), text))
    return found


def _join(ports: list[str], weights: Mapping[str, sympy.Expr], slope: str) -> dict[str, Any]:
    known = all(weights[port].is_number and weights[port] != 0 for port in ports)
    return {"ports": ports, "weights": [float(weights[port]) if known else 0.0 for port in ports], "slope": slope}


def _resolved(flow: sympy.Expr, zone: TracedZone, has: Declaration) -> sympy.Expr:
    """With the unknowns that rows of this zone give put in; one that is not given alone stays."""
    for s in sorted(symbols_in(flow), key=lambda s: s.name):
        one = key(s.name)
        if one.kind == OWN and one.name in has.unknowns and one.name in zone.own and one.name not in zone.holds:
            row = zone.own[one.name]
            slope = derivative(row, s)
            if slope != 0 and s not in symbols_in(slope) and row.has(s):
                flow = flow.xreplace({s: -row.xreplace({s: sympy.S.Zero}) / slope})
    return flow


def _ratios(flows: Mapping[str, sympy.Expr], ports: list[str]) -> dict[str, sympy.Expr]:
    """What every port takes in over what the first does, if that is 1 or -1; else 0."""
    first = flows.get(ports[0], sympy.S.Zero)
    found = {}
    for port in ports:
        flow = flows.get(port, sympy.S.Zero)
        fits = [ratio for ratio in UNIT_RATIOS if first != 0 and _same(flow, ratio * first)]
        found[port] = sympy.Integer(fits[0]) if fits else sympy.S.Zero
    return found


def _same(one: sympy.Expr, other: sympy.Expr) -> bool:
    """True if two expressions are the same when they are written out."""
    return not differs(one, other) and sympy.expand(one - other) == 0
