"""Which zones a run can come to: from the zone in which it begins, along guards that rise.

A guard leads from its zone to another if it rises at an instant at which no guard written before it leads elsewhere.
Where the zones found by following guards from random instants leave some out, instants of all sizes are searched for
the guards that would lead there. They need not belong to any motion: what is not even found so, nothing leads to.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np

from fairlead.component.base import Declared
from fairlead.component.given import Choice, Parameter
from fairlead.component.keys import key
from fairlead.component.trace import TracedGuard
from fairlead.kernels import layout
from fairlead.testing.rig import traced_zones
from fairlead.testing.settled import in_pieces
from fairlead.testing.world import AT_ZERO, STEP, Instant, World

WORLDS, DRAWS, CLIMBS = 12, 60, 240  # instances searched for a guard, instants of each, tries to raise it from the best
SIZES = (-2.0, 8.0)  # powers of ten by which what is drawn is made larger
BEYOND = (-9.0, 0.0)  # powers of ten of the share by which a try goes beyond where a guard is zero
STEPS = (-6.0, 1.0)  # powers of ten of the share by which a try changes a quantity


def begins(world: World) -> str:
    """The zone in which it begins, unless a guard says otherwise."""
    begin = world.kind.answers.begins_in
    return begin(world.of) if begin else world.structure.zones[0]


def reached(begin: Iterable[str], led: Iterable[tuple[str, str]]) -> set[str]:
    """Zones that can be come to along steps from zone to zone."""
    found, steps = set(begin), list(led)
    while more := {there for here, there in steps if here in found and there not in found}:
        found |= more
    return found


def all_reached(
    make: Callable[[], World], rng: np.random.Generator, begin: set[str], led: set[tuple[str, str]]
) -> set[str]:
    """Zones that can be come to, with those that guards could lead to at instants of any size."""
    world = make()
    has, led = world.kind.declaration, set(led)
    here = {guard["name"] for guards in world.structure.guards.values() for guard in guards}
    led |= {(zone, one.to) for name, one in has.guards.items() if name not in here for zone in one.zones}  # off here
    led |= {(zone, guard.to) for zone, guard in _guards(world) if _is_sampled(guard)}
    if _is_optional(world.kind):  # a guard may be a constant on purpose
        led |= {(zone, guard.to) for zone, guard in _guards(world) if _is_fixed(guard)}
    searched: set[tuple[str, str]] = set()
    while True:
        found = reached(begin, led)
        wanted = {step for step in _steps(world) if step[0] in found and step[1] not in found} - searched
        if not wanted:
            return found
        searched |= wanted
        led |= _possible(make, rng, wanted)


def _steps(world: World) -> Iterator[tuple[str, str]]:
    """From which zone to which there is a guard."""
    for zone, guards in world.structure.guards.items():
        yield from ((zone, _to(world, guard)) for guard in guards if guard["machine"] == 0 and guard["to"] >= 0)


def _to(world: World, guard: dict[str, Any]) -> str:
    return world.structure.zones[guard["to"]]


def _is_optional(kind: type[Declared]) -> bool:
    """Whether it has other forms, by what may be left out or chosen."""
    given = kind.declaration.parameters.values()
    left_out = any(isinstance(one, Choice) or (isinstance(one, Parameter) and one.default is None) for one in given)
    return left_out or bool(kind.declaration.effects)


def _guards(world: World) -> Iterator[tuple[str, TracedGuard]]:
    """The zone of every guard that leads to another zone, and the guard."""
    for zone, traced in traced_zones(world.rig.variant).items():
        yield from ((zone, guard) for guard in traced.guards if guard.to)


def left_by_samples(world: World) -> set[str]:
    """Zones out of which a sample leads, so that what is drawn may never stay there."""
    return {zone for zone, guard in _guards(world) if _is_sampled(guard)}


def _is_sampled(guard: TracedGuard) -> bool:
    """Whether it reads what changes at sample times only, which is not drawn."""
    return any(key(s.name).is_discrete for value in guard.values for s in value.free_symbols)


def _is_fixed(guard: TracedGuard) -> bool:
    return all(key(s.name).is_fixed for value in guard.values for s in value.free_symbols)


def idle_guards(
    make: Callable[[], World], rng: np.random.Generator, seen: set[tuple[str, str]]
) -> list[tuple[str, str]]:
    """(zone, guard) of guards that read what moves and are at no instant of any size above zero."""
    world = make()
    asked = [one for one in _guards(world) if not _is_fixed(one[1]) and not _is_sampled(one[1])]
    left = {(zone, guard.name) for zone, guard in asked} - seen
    return sorted(left - _found(make, rng, left, lambda step: _of_guard(*step))) if left else []


def _possible(
    make: Callable[[], World], rng: np.random.Generator, wanted: set[tuple[str, str]]
) -> set[tuple[str, str]]:
    """Those of the steps from zone to zone that a guard would take at some instant."""
    return _found(make, rng, wanted, lambda step: _of_step(*step))


Look = Callable[[World, Instant], tuple[complex, bool]]
"""How high a guard is at an instant, and whether it is as wanted."""


def _found(
    make: Callable[[], World],
    rng: np.random.Generator,
    wanted: set[tuple[str, str]],
    look: Callable[[tuple[str, str]], Look],
) -> set[tuple[str, str]]:
    found: set[tuple[str, str]] = set()
    for _ in range(WORLDS):
        world = make()
        found |= {one for one in sorted(wanted - found) if _is_met(world, one[0], look(one), rng)}
        if found == wanted:
            break
    return found


def _is_met(world: World, zone: str, look: Look, rng: np.random.Generator) -> bool:
    """Whether an instant of any size is found that is as wanted: drawn, or climbed to from the highest that was."""
    best: tuple[float, Instant | None] = (-np.inf, None)
    number = world.structure.zones.index(zone)
    for k in range(DRAWS + CLIMBS):
        if k < DRAWS or best[1] is None:
            drawn = in_pieces(world, _of_any_size(world, rng), rng)
            at = drawn.but((number, *drawn.zones[1:]))
        else:
            at = best[1]
        try:
            if at is best[1]:
                at = _climbed(world, at, look, rng) if k % 2 else _near(at, 10 ** rng.uniform(*STEPS), rng)
            height, met = look(world, at)
        except (ArithmeticError, ValueError):  # too large for an exponential, a root of less than nothing
            continue
        if met:
            return True
        best = max(best, (height.real, at), key=lambda one: one[0])
    return False


def _of_step(zone: str, to: str) -> Look:
    """The highest guard that leads there, and whether one has risen and none before it that leads elsewhere."""

    def look(world: World, at: Instant) -> tuple[complex, bool]:
        height, taken = complex(-np.inf), False
        for guard, value in zip(world.structure.guards[zone], world.ask(layout.GUARD, at), strict=False):
            if guard["machine"] != 0 or not np.isfinite(value):
                continue
            if _to(world, guard) == to:
                if value.real > AT_ZERO and not taken:
                    return value, True
                height = max(height, value, key=lambda one: one.real)
            taken = taken or value.real > 0
        return height, False

    return look


def _of_guard(zone: str, name: str) -> Look:
    """How high a guard is, and whether it has risen."""

    def look(world: World, at: Instant) -> tuple[complex, bool]:
        place = [guard["name"] for guard in world.structure.guards[zone]].index(name)
        value = world.ask(layout.GUARD, at)[place]
        return (value, bool(value.real > AT_ZERO)) if np.isfinite(value) else (complex(-np.inf), False)

    return look


def _of_any_size(world: World, rng: np.random.Generator) -> Instant:
    """A random instant in which every quantity is of another size, forces and accelerations too."""
    at = world.draw(rng, alone=bool(rng.integers(2)))
    values = dict(at.values)
    common = 10 ** rng.uniform(*SIZES)
    for one, value in values.items():
        if key(one).part in ("a", "A", "U"):
            value = float(rng.normal())
        values[one] = value * (common if rng.integers(2) else 10 ** rng.uniform(*SIZES))
        if one.startswith("in:") and rng.integers(3) == 0:
            values[one] = float(rng.integers(2))
    return at.having(values)


def _climbed(world: World, at: Instant, look: Look, rng: np.random.Generator) -> Instant:
    """An instant at which the guard is just above zero, if it goes on as it rises here along one of its quantities."""
    one = world.structure.inputs[rng.integers(len(world.structure.inputs))]
    height, _ = look(world, at.shifted({one: 1.0}, STEP * 1j))
    slope = height.imag / STEP
    beyond = 1 + 10 ** rng.uniform(*BEYOND)
    return at.having(at.values | {one: at.values[one] - beyond * height.real / slope}) if slope else at


def _near(at: Instant, step: float, rng: np.random.Generator) -> Instant:
    """An instant close to another, in some of its quantities."""
    keys = [one for one in at.values if rng.integers(3) == 0]
    return at.having({**at.values, **{one: at.values[one] * (1 + step * rng.normal()) for one in keys}})


def other_parameters(world: World) -> str:
    """What to do if a guard was not seen to rise."""
    given = f"contract({world.kind.__name__}, name=...) or asked_with"
    return f"Give parameters at which it does, {given}, or say why in exempt"


def unled(world: World, left: set[str], begin: set[str]) -> str:
    """Which zones guards do not lead to, as far as is known, and what to do."""
    guards = world.kind.declaration.guards
    first = f"from zone {' or '.join(sorted(begin))}, in which it begins"
    nowhere = left - {one.to for one in guards.values()}
    leading = {name: one.to for name, one in guards.items() if one.to in left and set(one.zones) - left}
    if nowhere or not leading:
        return f"no guard leads to zone {', '.join(sorted(nowhere or left))} {first}"
    names, zones = ", ".join(sorted(leading)), ", ".join(sorted(set(leading.values())))
    return (
        f"no guard leads to zone {zones} {first}: {names} did not rise at any instant of a wide search, or not without "
        f"another guard that comes first. {other_parameters(world)}"
    )


def not_met(world: World, unmet: set[str], instants: int) -> str:
    """Zones that were not found, and what to do."""
    return (
        f"no motion was found that leads to zone {', '.join(sorted(unmet))} and stays there. The search of "
        f"{instants} random instants has ended, which does not say that there is none: give "
        f"parameters at which the zone is met, contract({world.kind.__name__}, name=...) or asked_with, or say "
        "why in exempt"
    )
