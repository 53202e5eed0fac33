"""What happens at the instant at which a speed reaches the border of a zone, as when a slip comes to rest.

There a guard is zero, and fires if it rises on: the accelerations of the bodies say so. A law of friction that cannot
rest, or lets go below what it slides with, runs in a circle at such an instant and at no random one.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from fairlead.component.keys import key
from fairlead.component.symbols import symbol
from fairlead.component.values import Variant
from fairlead.kernels import layout
from fairlead.testing.rig import traced_zones
from fairlead.testing.world import AT_ZERO, PASSES, STEP, CircleError, ContractError, Instant, World, circle_of

SHARES = (0.3, 0.7, 0.97, 1.03, 1.5, -0.7)  # of the force that resists motion: below it, above it, and back
RISES = 1e-9  # of the largest acceleration; less is rounding


def at_borders(world: World, at: Instant) -> Iterator[Instant]:
    """The instant in its zone, with an impulse on the bodies that brings a guard of their speeds to zero."""
    yield from (there for there, _ in _borders(world, at))


def under_loads(world: World, at: Instant) -> Iterator[Instant]:
    """The same with bodies that are pushed by shares of what resists them there, also in the zones that hold."""
    still = {zone for zones in world.structure.holds.values() for zone in zones} - {world.zone(at)}
    for there, slopes in _borders(world, at):
        yield there
        solved = world.solve(there)
        pushed = sum(c * solved.loads[port] / world.masses[port] for port, c in slopes.items() if port in world.bodies)
        resists = sum(c * float(np.real(solved.values[f"port:{port}:a"])) for port, c in slopes.items()) - pushed
        give = sum(slopes[port] ** 2 / world.masses[port] for port in world.bodies)
        for share in SHARES if abs(resists) > AT_ZERO else ():
            more = (-share * resists - pushed) / give
            loads = {port: load + more * slopes.get(port, 0.0) for port, load in there.loads.items()}
            yield (loaded := replace(there, loads=loads))
            yield from (world.enter(loaded, zone) for zone in sorted(still))


def _borders(world: World, at: Instant) -> Iterator[tuple[Instant, dict[str, float]]]:
    for place, slopes in _of_speeds(world, at).items():
        give = sum(slopes[port] ** 2 / world.masses[port] for port in world.bodies)
        if not give:
            continue
        value = world.ask(layout.GUARD, at)[place].real
        speeds = {f"port:{p}:v": -value * slopes[p] / world.masses[p] / give for p in world.bodies}
        there = at.having(at.values | {speed: at.values[speed] + change for speed, change in speeds.items()})
        if abs(world.ask(layout.GUARD, there)[place].real) <= AT_ZERO:
            yield there, slopes


def follow(world: World, at: Instant) -> Instant:
    """Where guards lead that have risen or are zero and rise. Raises CircleError naming the circle."""
    here, path = at, []
    for _ in range(PASSES):
        here = world.solve(here)
        path.append(world.zone(here))
        guard = _next(world, here)
        if guard is None:
            return here
        here = world.follow(here, guard)
    raise CircleError(
        f"{world.where(at)}: at this border its zones do not settle, they run in a circle: {circle_of(path)}. "
        "If it is for parameters that contradict each other, let `check` refuse them"
    )


def is_at_border(world: World, at: Instant) -> bool:
    """Whether a guard of speeds is zero there and rises on."""
    return _next(world, at) is not None


def _next(world: World, at: Instant) -> dict[str, Any] | None:
    """The first guard that has risen, or is zero and rises on."""
    values = world.ask(layout.GUARD, at)
    slopes: dict[int, dict[str, float]] | None = None
    for place, (guard, value) in enumerate(zip(world.structure.guards[world.zone(at)], values, strict=False)):
        if value.real > AT_ZERO:
            return guard
        if abs(value.real) <= AT_ZERO:
            slopes = _of_speeds(world, at) if slopes is None else slopes
            met = [c * float(np.real(at.values[f"port:{port}:a"])) for port, c in slopes.get(place, {}).items()]
            if met and sum(met) > RISES * max(1.0, *map(abs, met)):
                return guard
    return None


def _of_speeds(world: World, at: Instant) -> dict[int, dict[str, float]]:
    """The guards of the zone that read speeds and nothing else that moves, with the slope to the speed of each port."""
    places = [place for place, (zone, guard) in _speed_guards(world.rig.variant) if zone == world.zone(at)]
    found: dict[int, dict[str, float]] = {place: {} for place in places}
    for name, port in world.kind.declaration.ports.items() if places else ():
        if port.domain.mechanical:
            said = world.ask(layout.GUARD, at.shifted({f"port:{name}:v": 1.0}, STEP * 1j))
            for place in places:
                found[place][name] = float(np.imag(said[place])) / STEP
    return found


@functools.lru_cache(maxsize=64)
def _speed_guards(variant: Variant) -> tuple[tuple[int, tuple[str, str]], ...]:
    """Place and (zone, name) of guards of one value that is made of speeds and parameters."""
    found = []
    for zone, traced in traced_zones(variant).items():
        for place, guard in enumerate(traced.guards):
            read = [key(s.name) for value in guard.values for s in value.free_symbols]
            moving = [one for one in read if not one.is_fixed]
            if len(guard.values) == 1 and moving and all(one.is_speed for one in moving):
                found.append((place, (zone, guard.name)))
    return tuple(found)


def must_let_go(world: World) -> None:
    """Refuse friction that slides with a force of its own and holds any load: nothing leads out but a slip."""
    zones = traced_zones(world.rig.variant)
    for name, zone in zones.items():
        for unknown, row in zone.holds.items():
            if row.gap is not None or row.impulse == row.slip:  # it takes any impulse, and may well hold any load
                continue
            out = [guard for guard in zone.guards if guard.to]
            read = {s for guard in out for value in guard.values for s in value.free_symbols}
            if any(not key(s.name).is_fixed and s.name not in row.rates for s in read):
                continue
            given = [zones[guard.to].own[unknown] for guard in out if unknown not in zones[guard.to].holds]
            if any(force.subs(symbol(f"own:{unknown}"), 0) != 0 for force in given):
                raise ContractError(
                    f"{world.rig.variant.label} in zone {name}: it holds any load, and slides with a limited force: no "
                    f"guard of this zone reads the force {unknown}. Add one that says when it is too large"
                )
