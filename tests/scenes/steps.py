"""Rows of a run that records every step: 0, 1 or 3 of them stand inside a step and show its curve as a polynomial.

docs/integrator.md, Between rows. What is between two rows is had to the accuracy of the run by the polynomial through
the rows of the step, and its integral by the rules of Newton and Cotes: trapezoid, Simpson, Boole.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

INSIDE = 2
WEIGHTS = {2: (1 / 2, 1 / 2), 3: (1 / 6, 4 / 6, 1 / 6), 5: (7 / 90, 32 / 90, 12 / 90, 32 / 90, 7 / 90)}


def ends(side: np.ndarray) -> np.ndarray:
    """Rows that are ends of steps."""
    return np.flatnonzero(side != INSIDE)


def of_steps(side: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """For each number of rows a step may have: which steps have it, and their rows [steps, rows]."""
    at = ends(side)
    counts = np.diff(at) + 1
    for count in np.unique(counts):
        which = np.flatnonzero(counts == count)
        yield which, at[which][:, None] + np.arange(count)


def integrals(rate: np.ndarray, t: np.ndarray, side: np.ndarray) -> np.ndarray:
    """The integral of a rate over each step."""
    found = np.zeros(len(ends(side)) - 1)
    for which, rows in of_steps(side):
        if rows.shape[1] in WEIGHTS:
            found[which] = rate[rows] @ np.array(WEIGHTS[rows.shape[1]]) * (t[rows[:, -1]] - t[rows[:, 0]])
        else:
            found[which] = np.sum((rate[rows[:, 1:]] + rate[rows[:, :-1]]) / 2 * np.diff(t[rows]), axis=1)
    return found


def between(values: np.ndarray, t: np.ndarray, side: np.ndarray, grid: np.ndarray) -> np.ndarray:
    """Columns (k, n) of a run at the times of a grid, (g, n); at an instant what is right of it."""
    at = ends(side)
    step = np.clip(np.searchsorted(t[at], grid, side="right") - 1, 0, len(at) - 2)
    found = np.empty((len(grid), values.shape[1]))
    for which, rows in of_steps(side):
        here = np.flatnonzero(np.isin(step, which))
        if not len(here):
            continue
        nodes = rows[np.searchsorted(which, step[here])]
        begin, end = t[nodes[:, 0]], t[nodes[:, -1]]
        share = np.where(end > begin, (grid[here] - begin) / np.where(end > begin, end - begin, 1.0), 1.0)
        share = np.clip(share, 0.0, 1.0)
        even = np.linspace(0.0, 1.0, nodes.shape[1])
        weights = np.ones((len(here), len(even)))
        for i, a in enumerate(even):
            for b in np.delete(even, i):
                weights[:, i] *= (share - b) / (a - b)
        found[here] = np.einsum("gr,grn->gn", weights, values[nodes])
    return found
