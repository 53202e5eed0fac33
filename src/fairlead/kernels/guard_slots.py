"""Which guards of a class share a slot: those that bound a held force, those that lead on in a table, and others.

A slot has one tolerance, one inertia and one role for all zones of its class. The force of a contact is looked ahead
for by half the time that a slip is (settling.py) and taken from the equations at an instant (arrival.py); a slot that
is a bound on a force in one zone and a slip in another would be read as a slip in both. A guard that leads to the next
piece of a table is asked at other speeds in an impact (impulse_zones.py). So zones leave slots out.
"""

from __future__ import annotations

from dataclasses import replace

import sympy

from fairlead.component.trace import Traced, TracedGuard, TracedZone
from fairlead.kernels import layout

Role = tuple[bool, bool]
"""Whether a guard bounds a force that holds, and whether it leads to the next piece of a table."""


def bounds_what_holds(guard: TracedGuard, zone: TracedZone) -> bool:
    """True for a guard that reads a force which holds in this zone."""
    held = {f"own:{unknown}" for unknown in zone.holds}
    return any(s.name in held for value in guard.values for s in value.free_symbols)


def latches(guard: TracedGuard, traced: Traced) -> bool:
    """True if the zone that a guard leads to remains when the guard is below zero again, as that of a relay does.

    It does not where a way out of it has the same value, reversed.
    """
    if guard.step != 0 or not guard.to:
        return False
    ways_out = [out.values for out in traced.zones[guard.to].guards]
    return not any(
        len(values) == len(guard.values) == 1 and sympy.expand(values[0] + guard.values[0]) == 0 for values in ways_out
    )


def in_slots(traced: Traced) -> Traced:
    """The class with its guards in slots of one role each; where a zone leaves one out, a guard that never fires."""
    roles: list[Role] = []
    return replace(traced, zones={name: _placed(name, zone, roles) for name, zone in traced.zones.items()})


def _placed(name: str, zone: TracedZone, roles: list[Role]) -> TracedZone:
    placed: list[TracedGuard] = []
    for guard in zone.guards:
        role = bounds_what_holds(guard, zone), guard.step != 0
        while len(placed) < len(roles) and roles[len(placed)] != role:
            placed.append(TracedGuard("", name, guard.unit, [sympy.Float(layout.NOT_IN_FORCE)]))
        roles += [role] * (len(placed) == len(roles))
        placed.append(guard)
    return replace(zone, guards=placed)
