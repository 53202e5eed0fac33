"""Impacts: every jump of speeds is one that the laws of impact allow, worked out from masses and places alone.

It sees impulses that pull, bodies that go on into each other, momentum from nowhere, friction that takes an impulse
under a finite normal force, rebound by another share, energy gained. It cannot see an impact that was missed (bodies
that pass through each other show in laws.py as a gap below zero), nor choose where several outcomes are allowed.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from tests.scenes.blows import FLOOR, WALL, Blow
from tests.scenes.impulses import Impact, defect
from tests.scenes.observed import Observed

ALLOWED = 1e-4
"""Speed [m/s] by which an impact may miss its conditions: gaps of 1e-7 m are open or closed by rounding."""
GAINED = 1e-9
"""Energy [J] that rounding may add."""


def impulses(run: Observed, scene: Blow, restitution: float = 0.0) -> str:
    """What is wrong with an impact; nothing if all are allowed.

    With a share e all impulses of an impact grow by 1 + e (Moreau), so that of the impact without rebound is found
    back from what was shown. A rebound that would be below the weights of speeds is none, and passes as such.
    """
    for impact in jumps(run, scene):
        shares = [restitution, 0.0] if restitution else [0.0]
        worst = min(defect(scene, _without_rebound(impact, share)) for share in shares)
        if worst > ALLOWED:
            return f"impulses: the impact at {impact.t:.6g} s misses its conditions by {worst:.2g} m/s"
        if f" {WALL}: " not in scene.text and impact.gained(scene.mass) > GAINED:
            return f"impulses: the impact at {impact.t:.6g} s gains {impact.gained(scene.mass):.2g} J"
    return ""


def jumps(run: Observed, scene: Blow) -> list[Impact]:
    """All instants of a run at which a speed jumps."""
    names = [*scene.mass, *([WALL] if f" {WALL}: " in scene.text else [])]
    found = []
    for k in np.flatnonzero(run.side == 1):
        before, after = ({name: float(run.columns[f"{name}.v"][j]) for name in names} for j in (k - 1, k))
        if max(abs(after[name] - before[name]) for name in names) > 1e-6:
            at = {FLOOR: 0.0, **{name: float(run.columns[f"{name}.x"][k]) for name in names}}
            gaps = {stop.name: at[stop.b] - at[stop.a] - stop.length for stop in scene.stops}
            found.append(Impact(float(run.t[k]), before, after, gaps))
    return found


def _without_rebound(impact: Impact, share: float) -> Impact:
    after = {name: v + (impact.after[name] - v) / (1 + share) for name, v in impact.before.items()}
    return replace(impact, after=after)
