"""Sensitivity: what a scene makes of a start that is off by one weight, and until when it can be foretold.

Each unknown is moved at the start, this way or that, by its error weight at the accuracy a. D(t) is the largest
difference from the run that was not moved, so far, of four such runs. Past the
horizon, where 30 D is a third of the size of a signal, nobody can tell where it is, and no comparison is made.

It says how large an error the accuracy allows; it cannot see an error. It does not know errors that arise later in a
way that no change of the start makes.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any
from unittest import mock

import numpy as np

from fairlead.integrate.parts import ActiveSubsystem
from tests.scenes.observed import Observed, observed
from tests.scenes.oracles.agreement import FACTOR, Compared, away

MOVES = range(1, 5)
LOST = 1 / 3
"""Share of the size of a signal that an error may have before nothing is known of it."""


def sensitivity(model: Any, plain: Compared, accuracy: float) -> tuple[np.ndarray, float]:
    """D over sizes (g, n), and the horizon [s]; inf if there is none."""
    grown = np.zeros_like(plain.values)
    for seed in MOVES:
        with moved(accuracy / plain.run.accuracy, seed):
            other = observed(model, plain.run.accuracy)
        if other.status != "finished":
            grown = np.maximum(grown, _until_it_ended(plain, other))
            continue
        grown = np.maximum(grown, away(plain, Compared(other)))
    grown = np.maximum.accumulate(grown, axis=0)
    lost = (FACTOR * grown > LOST).any(axis=1)
    return grown, float(plain.grid[lost.argmax()]) if lost.any() else np.inf


@contextlib.contextmanager
def moved(weights: float, seed: int) -> Iterator[None]:
    """Runs begin with each unknown moved this way or that by so many of its error weights."""
    begin = ActiveSubsystem.__init__

    def begin_moved(self: ActiveSubsystem, *given: Any) -> None:
        begin(self, *given)
        y, absolute, relative, cap = (self.whole.array[name] for name in ("y", "absolute", "relative", "cap"))
        weight = np.minimum(absolute + relative * np.abs(y), cap)
        y += weights * np.random.default_rng(seed).choice((-1.0, 1.0), len(y)) * weight

    with mock.patch.object(ActiveSubsystem, "__init__", begin_moved):
        yield


def _until_it_ended(plain: Compared, other: Observed) -> np.ndarray:
    """Differences from a run that ended early, and no bound after that; none from one that did not begin.

    A start that keeps relations of positions no longer keeps them when it is moved.
    """
    if len(other.t) < 2:
        return np.zeros_like(plain.values)
    late = plain.grid >= other.t[-1]
    early = Compared(other)
    early.values = np.column_stack([np.interp(plain.grid, early.grid, column) for column in early.values.T])
    early.grid = plain.grid
    return np.where(late[:, None], np.inf, away(plain, early))
