"""What an impact may do, worked out from masses and places alone; it knows nothing of how fairlead finds it.

    M (v+ - v-) = G' P,   P >= 0 on stops that touch,  G v+ >= 0,  P . G v+ = 0         an impact without rebound
    |P_t| <= mu P_n, against the slip that is left                                     friction under an impulse

Without friction these are the conditions of the smallest change of speed, in the kinetic norm, that keeps stops from
going into each other, which has one solution (J. J. Moreau, Unilateral contact and dry friction, 1988, section 7).
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import linprog

from tests.scenes.blows import FLOOR, WALL, Blow

TOUCHES, NEAR = 1e-11, 1e-7
"""Gap [m] below which a stop takes part, and below which it may or may not: a microsecond later it does."""
SURE = 1e-9
"""Speed [m/s] by which an impact may miss its conditions without another choice being looked at."""
STILL = 1e-5
"""Slip [m/s] that counts as none."""


@dataclass
class Impact:
    """Speeds before and after an instant, and what touches then."""

    t: float
    before: dict[str, float]
    after: dict[str, float]
    gaps: dict[str, float]

    def gained(self, mass: dict[str, float]) -> float:
        """Change of kinetic energy [J]."""
        return sum(m * (self.after[name] ** 2 - self.before[name] ** 2) / 2 for name, m in mass.items())


def impacts(scene: Blow, result: Any) -> Iterator[Impact]:
    """All instants of a run at which a speed jumps."""
    names = [*scene.mass, *([WALL] if f" {WALL}: " in scene.text else [])]
    t, side = result.t, result.side
    v = {name: result[f"{name}.v"] for name in names}
    x = {name: result[f"{name}.x"] for name in names}
    for k in np.flatnonzero(side == 1):
        before, after = ({name: float(v[name][j]) for name in names} for j in (k - 1, k))
        if max(abs(after[name] - before[name]) for name in names) > 1e-6:
            at = {FLOOR: 0.0, **{name: float(x[name][k]) for name in names}}
            gaps = {s.name: at[s.b] - at[s.a] - s.length for s in scene.stops}
            yield Impact(float(t[k]), before, after, gaps)


def defect(scene: Blow, impact: Impact) -> float:
    """How far an impact is from what the laws allow [m/s]: speed into a stop, or a change that nothing causes.

    Each of the stops that are near may take part or not: of two that close within a nanosecond the first may be alone.
    """
    near = [s.name for s in scene.stops if TOUCHES <= impact.gaps[s.name] < NEAR]
    some = (set(one) for count in range(len(near) + 1) for one in itertools.combinations(near, count))
    least = np.inf
    for beside in some:
        least = min(least, _defect(scene, impact, beside))
        if least < SURE:
            break
    return float(least)


def _defect(scene: Blow, impact: Impact, beside: set[str]) -> float:
    touching = [s for s in scene.stops if impact.gaps[s.name] < TOUCHES or s.name in beside]
    speed = {FLOOR: 0.0, **impact.after}
    slip = [speed[s.b] - speed[s.a] for s in touching]
    into = max([0.0, *(-value for value in slip)])
    bodies = list(scene.mass)
    rows = [_row(bodies, s.a, s.b) for s in touching] + [_row(bodies, a, b) for a, b in scene.links]
    bounds: list[Any] = [(0, 0 if value > STILL else None) for value in slip] + [(None, None)] * len(scene.links)
    above = []
    for body, stop, mu in scene.rubs:
        rows.append(_row(bodies, FLOOR, body))
        bounds.append((None, None))
        limit = [mu * (s.name == stop) for s in touching]
        above += [([-value for value in limit], len(rows) - 1, sign) for sign in (1.0, -1.0)]
        if abs(speed[body]) > STILL:  # it slides on: friction is mu P_n against it, no less
            above.append((limit, len(rows) - 1, float(np.sign(speed[body]))))
    change = np.array([scene.mass[name] * (impact.after[name] - impact.before[name]) for name in bodies])
    given = np.array(rows, dtype=float).reshape(-1, len(bodies))
    return max(into, _unexplained(given, bounds, above, change, min(scene.mass.values())))


def _row(bodies: list[str], a: str, b: str) -> list[float]:
    return [float(name == b) - float(name == a) for name in bodies]


def _unexplained(rows: Any, bounds: list[Any], above: list[Any], change: Any, mass: float) -> float:
    """The least sum of momentum [as speed of `mass`] that no impulses within their bounds give."""
    n, m = rows.shape[1], len(rows)
    cost = np.concatenate([np.zeros(m), np.ones(2 * n)])
    equal = np.hstack([rows.T, np.eye(n), -np.eye(n)])
    under = np.zeros((len(above), m + 2 * n))
    for k, (normal, place, sign) in enumerate(above):
        under[k, : len(normal)] = normal
        under[k, place] = sign
    done = linprog(cost, under if len(above) else None, np.zeros(len(above)) if len(above) else None, equal, change,
                   [*bounds, *[(0, None)] * (2 * n)])  # fmt: skip
    return float(done.fun) / mass
