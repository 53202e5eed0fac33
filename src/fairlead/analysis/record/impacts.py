"""What impulses did in a run: start values that settling changed, and energy lost in impacts."""

from __future__ import annotations

from typing import Any

import numpy as np

from fairlead.system.compiled.system import Instance, System
from fairlead.system.numbering.tolerances import Floats

MOST_TOLD = 20
SPEEDS, ROUNDING, LEFT = ("m/s", "rad/s"), 1e-12, 1e-3
"""Units of speeds; what is given as zero but for rounding; the share of a speed below which nothing is left of it."""


def changed_starts(problem: Instance, begun: Floats) -> list[dict[str, Any]]:
    """Start values that settling changed beyond their error weight, and speeds of which it left nothing.

    By name, unit, `given` and `became`. A speed below that with which a contact lands is taken away at the start.

    `begun` are the unknowns as settled at the start, shape (n,); all zeros if the run did not get that far.
    """
    given = problem.initial
    weight = np.minimum(problem.absolute + problem.relative * np.maximum(np.abs(given), np.abs(begun)), problem.cap)
    counts = problem.differential & ~problem.quadrature & ~problem.stiff & bool(begun.any())
    speeds = np.array([one.unit in SPEEDS for one in problem.numbering.unknowns], dtype=bool)
    stopped = speeds & (np.abs(given) > ROUNDING) & (np.abs(begun) <= LEFT * np.abs(given))
    found = np.flatnonzero(counts & (stopped | (np.abs(begun - given) > weight))).tolist()
    unknowns = problem.numbering.unknowns
    return [
        {"name": unknowns[k].name, "unit": unknowns[k].unit, "given": float(given[k]), "became": float(begun[k])}
        for k in found[:MOST_TOLD]
    ]


def lost_in_impacts(system: System, lost: Floats) -> dict[str, float]:
    """Energy lost in impacts, J, by component; `lost` by row, shape (n,)."""
    made: dict[str, float] = {}
    for k in np.flatnonzero(lost).tolist():
        path = system.numbering.unknowns[k].name.rpartition(".")[0]
        made[path] = made.get(path, 0.0) + float(lost[k])
    return made
