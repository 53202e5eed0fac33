"""What a component takes in and how its inputs move at an instant, for the ledger of energy."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from fairlead.component.declare import THERMAL
from fairlead.component.keys import key
from fairlead.kernels import layout
from fairlead.testing.world import STEP, Instant, World

ROUNDING = 1e-9  # of the largest of several heat flows
STORED = -3  # its place among what an instance says beside its outputs


def massive(world: World) -> bool:
    """Whether it has inertia of its own, or ties that pass on that of others."""
    return bool(inertia(world)) or world.kind.answers.ties is not None


def inertia(world: World) -> Mapping[str, float]:
    """Its own mass, moment of inertia or capacity by port."""
    method = world.kind.answers.inertia
    return method(world.of) if method else {}


def rates_of(world: World, at: Instant, rng: np.random.Generator) -> dict[str, float] | None:
    """Time derivatives of all inputs: positions move, bodies accelerate, states go as the law says.

    Unknowns go as their equations say, if the energy stored reads any. None where it reads one that holds.
    """
    flows, rates = world.flows(at), {"t": 1.0}
    for name, port in world.kind.declaration.ports.items():
        if port.domain.mechanical:
            rates[f"port:{name}:x"] = at.values[f"port:{name}:v"]
            rates[f"port:{name}:v"] = at.values[f"port:{name}:a"].real
        else:
            rates[f"port:{name}:x"] = float(rng.normal())
    rates |= {f"own:{name}": flows[f"own:{name}"].real for name in world.kind.declaration.states}
    of_unknowns = _of_unknowns(world, at, rates)
    return None if of_unknowns is None else rates | of_unknowns


def _of_unknowns(world: World, at: Instant, rates: Mapping[str, float]) -> dict[str, float] | None:
    """Rates of unknowns: 0 = residual(u, s) gives  d(residual)/du du/dt = - d(residual)/ds ds/dt."""
    has, held = world.kind.declaration, world.held(at) if world.kind.declaration.unknowns else {}
    read = [name for name in has.unknowns if _derivative(world, at, {f"own:{name}": 1.0}, f"out:{STORED}") != 0.0]
    if not read:
        return {}
    told = [name for name in has.unknowns if name != world.kind.answers.bears and name not in held]
    if not set(read) <= set(told):
        return None
    known = {f"own:{name}" for name in (*held, world.kind.answers.bears)}
    targets = [f"own:{name}" for name in told]
    slopes = [[_derivative(world, at, {column: 1.0}, row) for column in targets] for row in targets]
    forced = [_derivative(world, at, rates, row) for row in targets]
    leans = any(_derivative(world, at, {one: 1.0}, row) for one in known & at.values.keys() for row in targets)
    if leans:
        return None
    try:
        return dict(zip(targets, np.linalg.solve(np.array(slopes), -np.array(forced)).tolist(), strict=True))
    except np.linalg.LinAlgError:  # a flow into a port whose potential the law keeps
        return None


def _derivative(world: World, at: Instant, rates: Mapping[str, float], what: str) -> float:
    """Of a flow or, as "out:-3", of a line of the ledger, along rates."""
    there = at.shifted(rates, STEP * 1j)
    if what.startswith("out:"):
        return float(np.imag(world.ask(layout.OUTPUT, there)[int(what[4:])])) / STEP
    return float(np.imag(world.flows(there)[what])) / STEP


def power_in(world: World, at: Instant, rates: Mapping[str, float]) -> float:
    """Flow times rate over all ports, with the inertia of the component and the reaction of a prescribed motion."""
    return sum(power_of(world, at, rates, name) for name in world.kind.declaration.ports)


def power_of(world: World, at: Instant, rates: Mapping[str, float], name: str) -> float:
    """The same of one port; heat is a power by itself, told where it is made."""
    if world.kind.declaration.ports[name].domain is THERMAL:
        return 0.0
    flows, port = world.flows(at), world.kind.declaration.ports[name]
    across = "v" if port.domain.mechanical else "x"
    flow = flows[f"port:{name}"].real if f"port:{name}" in flows else 0.0
    flow += inertia(world).get(name, 0.0) * rates[f"port:{name}:{across}"]
    if name in world.prescribed:
        flow -= at.values[f"port:{name}:R"]
    return float(flow * at.values[f"port:{name}:{across}"])


def power_met(world: World, at: Instant) -> float:
    """The largest product of a flow and a speed, the scale of rounding."""
    flows = world.flows(at)
    speeds = [abs(v) for one, v in at.values.items() if key(one).part in ("v", "x")]
    return max((abs(f) for f in flows.values()), default=0.0) * max(speeds, default=0.0)


def heat_falls(world: World, at: Instant) -> Iterator[float]:
    """Heat times the temperature it falls by, of a part that has thermal ports only and keeps all heat; else nothing.

    What the ports take in sums to zero, so it is the sum of temperature times heat, from any zero of temperature.
    """
    has, flows = world.kind.declaration, world.flows(at)
    if len(has.ports) < 2 or any(port.domain is not THERMAL for port in has.ports.values()) or has.inputs:
        return
    heats = {name: flows[f"port:{name}"].real for name in has.ports if f"port:{name}" in flows}
    most = max(map(abs, heats.values()), default=0.0)
    if most > 0 and abs(sum(heats.values())) <= ROUNDING * most:
        fall = sum(heat * at.values[f"port:{name}:x"] for name, heat in heats.items())
        if abs(fall) > ROUNDING * most:
            yield float(fall)


def at_tied_motion(world: World, at: Instant) -> Instant | None:
    """The instant with ports moving as their ties say, where the force in a tie does no work; None in another zone.

    b = ratio a + offset of positions, so speeds and accelerations have the ratio as well.
    """
    ties, ports = world.kind.answers.ties, world.kind.declaration.ports
    if ties is None or world.held(at) or not all(port.domain.mechanical for port in ports.values()):
        return None
    values, left, placed = dict(at.values), list(ties(world.of)), set[str]()
    while left:
        one = next((tie for tie in left if tie[0] in placed or tie[1] in placed), left[0])
        left.remove(one)
        a, b, ratio, offset = one
        for part in ("x", "v", "a", "U"):
            shift = offset if part == "x" else 0.0
            if b in placed and a not in placed:
                values[f"port:{a}:{part}"] = (values[f"port:{b}:{part}"] - shift) / ratio
            else:
                values[f"port:{b}:{part}"] = ratio * values[f"port:{a}:{part}"] + shift
        placed |= {a, b}
    moved = world.solve(at.having(values))
    moved = moved.having({**moved.values, **{one: v for one, v in values.items() if key(one).part in ("a", "U")}})
    return None if world.risen(moved) else moved
