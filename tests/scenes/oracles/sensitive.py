"""Sensitivity: what a scene makes of a start that is off by one weight, and until when it can be foretold.

Each unknown is moved at the start, this way or that, by its error weight at the accuracy a (as tests/invariance does
by rounding). D(t) is the largest difference from the run that was not moved, so far, of four such runs. Past the
horizon, where 30 D is a third of the size of a signal, nobody can tell where it is, and no comparison is made.

It says how large an error the accuracy allows; it cannot see an error. It does not know errors that arise later in a
way that no change of the start makes.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from tests.invariance.worker import moved
from tests.scenes.observed import observed
from tests.scenes.oracles.agreement import FACTOR, Compared, away

MOVES = range(1, 5)
LOST = 1 / 3
"""Share of the size of a signal that an error may have before nothing is known of it."""


def sensitivity(model: Any, plain: Compared, accuracy: float) -> tuple[np.ndarray, float]:
    """D over sizes (g, n), and the horizon [s]; inf if there is none."""
    grown = np.zeros_like(plain.values)
    for seed in MOVES:
        with moved(accuracy, seed):
            other = observed(model, plain.run.accuracy)
        if other.status != "finished":
            late = plain.grid >= (other.t[-1] if len(other.t) else 0.0)
            grown[late] = np.inf
            if not len(other.t) or late.all():
                continue
            early = Compared(other)
            early.values = np.array([np.interp(plain.grid, early.grid, column) for column in early.values.T]).T
            early.grid = plain.grid
            grown = np.maximum(grown, np.where(late[:, None], np.inf, away(plain, early)))
            continue
        grown = np.maximum(grown, away(plain, Compared(other)))
    grown = np.maximum.accumulate(grown, axis=0)
    lost = (FACTOR * grown > LOST).any(axis=1)
    return grown, float(plain.grid[lost.argmax()]) if lost.any() else np.inf
