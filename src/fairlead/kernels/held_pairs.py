"""How a contact that holds takes its force from what it holds: asked for when several of them share a load."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import sympy

from fairlead.component.keys import key
from fairlead.component.trace import TracedZone, symbol
from fairlead.kernels.break_away import parameters_as_text
from fairlead.kernels.derivative import derivative


def held_pairs(zones: Iterable[TracedZone]) -> dict[str, tuple[dict[str, float], float]]:
    """Per unknown that holds: port -> coefficient of its speed in the slip, and the sense of its force.

    Only if both are numbers, the same in every zone that holds, and the force takes from every port in
    proportion to that coefficient, so that its power is force times slip: then it is known how several of
    them share a load (`redundancy.py`).
    """
    found: dict[str, list[tuple[dict[str, float], float] | None]] = {}
    for zone in zones:
        for unknown, row in zone.holds.items():
            found.setdefault(unknown, []).append(_held_pair(zone, unknown, row.rates))
    return {u: all_[0] for u, all_ in found.items() if all_[0] is not None and all(one == all_[0] for one in all_)}


def _held_pair(
    zone: TracedZone, unknown: str, rates: Mapping[str, sympy.Expr]
) -> tuple[dict[str, float], float] | None:
    speeds = {key(speed).name: rate for speed, rate in rates.items()}
    taken = {port: derivative(flow, symbol(f"own:{unknown}")) for port, flow in zone.flows.items()}
    taken = {port: value for port, value in taken.items() if value != 0}
    if taken.keys() != speeds.keys() or not all(v.is_Number for v in (*taken.values(), *speeds.values())):
        return None
    senses = {taken[port] / speed for port, speed in speeds.items()}
    if len(senses) != 1:
        return None
    return {port: float(speed) for port, speed in speeds.items()}, float(senses.pop())


def held_ratios(zones: Iterable[TracedZone]) -> dict[str, tuple[dict[str, str], float]]:
    """The same for a class whose coefficients are made of parameters, such as a lever, as texts for `number_of`.

    It holds in all of its zones, as ties do that are no contacts.
    """
    each = list(zones)
    found = {}
    for unknown in set.intersection(*({*zone.holds} for zone in each)) if each else ():
        rows = [_held_ratio(zone, unknown, zone.holds[unknown].rates) for zone in each]
        if rows[0] is not None and all(one == rows[0] for one in rows):
            found[unknown] = rows[0]
    return found


def _held_ratio(
    zone: TracedZone, unknown: str, rates: Mapping[str, sympy.Expr]
) -> tuple[dict[str, str], float] | None:
    speeds = {key(speed).name: rate for speed, rate in rates.items()}
    taken = {port: derivative(flow, symbol(f"own:{unknown}")) for port, flow in zone.flows.items()}
    taken = {port: value for port, value in taken.items() if value != 0}
    free = {key(s.name) for value in (*taken.values(), *speeds.values()) for s in value.free_symbols}
    if taken.keys() != speeds.keys() or not free or not all(one.is_fixed for one in free):
        return None
    senses = {sympy.simplify(taken[port] / speed) for port, speed in speeds.items()}
    if len(senses) != 1 or not (sense := senses.pop()).is_Number:
        return None
    return {port: parameters_as_text(speed) for port, speed in speeds.items()}, float(sense)
