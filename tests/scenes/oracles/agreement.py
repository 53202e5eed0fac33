"""Agreement: two runs of a scene show the same places and speeds, as far as their errors allow.

    |one - other| <= 30 (a size + D)        each signal, on a grid of 200 instants

a is the looser accuracy, size the largest value of the signal, or what counts as 1, and D what the scene itself makes
of a start that is off by a (sensitive.py; 0 for a scene that is not asked). Instants within 30 a of the span beside a
switch of either run are left out, as long as they are few: a speed that jumps does so a little earlier or later.

Of two engines, or two accuracies, it sees what one of them has and the other has not: switches missed, late or of
another order, steps too rough, states that are carried over wrongly. It cannot see what both have: laws (they share
them), a wrong rule for what lets go. Of a scene and its mirror image it sees what depends on directions.
"""

from __future__ import annotations

import numpy as np

from tests.scenes.observed import Observed
from tests.scenes.steps import between

FACTOR = 30.0
GRID = 200
LEAST = 0.5
"""Share of the grid that must be left beside switches."""


class Compared:
    """A run on a grid: motions (g, n), by name."""

    def __init__(self, run: Observed, sign: float = 1.0, shown: tuple[str, ...] = ("",)) -> None:
        """`sign` -1 turns all round; `shown` are ends of the names of the signals that count."""
        self.run = run
        self.names = [name for name in run.motions() if name.endswith(shown)]
        self.grid = np.linspace(0.0, float(run.t[-1]), GRID + 1)[1:]
        values = np.column_stack([run.columns[name] for name in self.names])
        self.values = sign * between(values, run.t, run.side, self.grid)
        self.sizes = np.array([run.size(name) for name in self.names])


def away(one: Compared, other: Compared) -> np.ndarray:
    """Differences over sizes (g, n); 0 beside switches."""
    order = [other.names.index(name) if name in other.names else -1 for name in one.names]
    apart = np.abs(one.values - other.values[:, order]) / np.maximum(one.sizes, other.sizes[order])
    apart = np.where(np.array(order) < 0, 0.0, apart)
    return np.where(beside(one, other)[:, None], 0.0, apart)


def beside(one: Compared, other: Compared) -> np.ndarray:
    """Instants of the grid that are near a switch of either run; none where that were most of them."""
    near = FACTOR * max(one.run.accuracy, other.run.accuracy) * float(one.grid[-1])
    switches = np.union1d(one.run.switches, other.run.switches)
    if not len(switches):
        return np.zeros(len(one.grid), dtype=bool)
    k = np.searchsorted(switches, one.grid)
    left, right = switches[np.maximum(k - 1, 0)], switches[np.minimum(k, len(switches) - 1)]
    left_out = np.minimum(np.abs(one.grid - left), np.abs(right - one.grid)) < near
    return left_out if left_out.mean() <= 1 - LEAST else np.zeros(len(one.grid), dtype=bool)


def agreement(one: Compared, other: Compared, what: str, grown: np.ndarray | None = None,
              until: float = np.inf) -> str:  # fmt: skip
    """What two runs differ in before `until`; nothing if they agree. `grown` is D over sizes, (g, n)."""
    apart = away(one, other)
    accuracy = max(one.run.accuracy, other.run.accuracy)
    allowed = FACTOR * (accuracy + (0.0 if grown is None else grown))
    over = np.where((one.grid < until)[:, None], apart / allowed, 0.0)
    g, n = np.unravel_index(int(np.argmax(over)), over.shape)
    if over[g, n] <= 1.0:
        return ""
    return f"{what}: {one.names[n]} differs by {apart[g, n]:.2g} of its size at {one.grid[g]:.4g} s"
