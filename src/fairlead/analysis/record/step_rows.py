"""Rows of whole steps: an engine hands over the rows inside a step before its end, and a buffer may end in between.

    start   inside   inside   inside   end          the end is the start of the next step

The dense output of a step goes through its rows inside, evenly spaced (integrate/record/rows.py): one of a parabola,
three of a curve of degree four.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.record.event_rows import LITTLE, Rows

ORDINARY, INSIDE, PASSED, INSIDE_PASSED, GRID = 0, 3, 4, 5, 6  # what a row is, as the engine numbers them
KEPT = 0.5
"""Share of the accuracy, of the largest value, by which a straight line, or a parabola, may be off a row left out."""

Integers = NDArray[np.int64]


MOST_VALUES = 2**18
"""Values of a batch, 4 MB, if its rows are not fewer than LEAST_ROWS."""
LEAST_ROWS, MOST_ROWS = 64, 2048


class WholeSteps:
    """Takes rows as they come and gives them back in whole steps; the first row is the last of those before."""

    def __init__(self) -> None:
        """Nothing waits."""
        self._waiting: Rows | None = None

    def take(self, rows: Rows) -> Rows | None:
        """Whole steps, or None while there are none."""
        if self._waiting is not None:
            rows = joined(self._waiting, rows)
        ends = np.flatnonzero(is_end(rows.side))
        if not len(ends):
            self._waiting = rows
            return None
        self._waiting = rows.kept(int(ends[-1]))
        return rows.where(slice(0, int(ends[-1]) + 1))

    def rest(self) -> Rows | None:
        """The rows that wait, when no more will follow."""
        return self._waiting


class Batches:
    """The same in batches that follow from the rows alone, and not from how they were handed over."""

    def __init__(self, signals: int) -> None:
        """Nothing waits."""
        self.length = min(max(MOST_VALUES // max(signals, 1), LEAST_ROWS), MOST_ROWS)
        self._waiting: list[Rows] = []
        self._many = 0

    def take(self, rows: Rows) -> Iterator[Rows]:
        """Batches that are complete."""
        self._waiting.append(rows)
        self._many += len(rows.t)
        if self._many <= self.length:
            return
        rows = joined(*self._waiting)
        ends = np.flatnonzero(is_end(rows.side))
        begin = 0
        while (next_end := int(np.searchsorted(ends, begin + self.length))) < len(ends):
            end = int(ends[next_end])
            yield rows.where(slice(begin, end + 1))
            begin = end
        self._waiting, self._many = [rows.kept(begin)], len(rows.t) - begin

    def rest(self) -> Rows | None:
        """What is no complete batch yet."""
        return joined(*self._waiting) if self._waiting else None


def is_end(side: NDArray[np.int8]) -> NDArray[np.bool_]:
    """By row: whether it is the end of a step, and no row inside one."""
    return (side != INSIDE) & (side != INSIDE_PASSED) & (side != GRID)


def curved_steps(side: NDArray[np.int8], inside: int) -> Integers:
    """[steps, inside + 2]: the rows of each step that has so many rows inside on its curve."""
    on_curve = np.flatnonzero(side != GRID)
    between = ~is_end(side[on_curve])
    ends = np.flatnonzero(~between)
    starts = ends[:-1][np.diff(ends) == inside + 1]
    return on_curve[starts[:, None] + np.arange(inside + 2)]


def joined(first: Rows, *more: Rows) -> Rows:
    """Rows and those that follow them."""
    if not more:
        return first
    return Rows(*(np.concatenate(parts) for parts in zip(first, *more, strict=True)))


class Thinning:
    """Leaves out rows inside a step where a straight line, or a parabola through the middle one, tells them."""

    def __init__(self, accuracy: float, signals: int) -> None:
        self.accuracy = accuracy
        self.largest = np.zeros(signals)

    def take(self, rows: Rows, *, first: bool) -> Rows:
        """The rows to write of whole steps; `first`: their first row was not written yet."""
        size = np.abs(rows.values)
        np.fmax(size[0], self.largest, out=size[0])
        largest = np.fmax.accumulate(size, axis=0)
        self.largest = largest[-1].copy()
        keep = np.ones(len(rows.t), dtype=bool)
        keep[0] = first
        for inside in (1, 3):
            which = curved_steps(rows.side, inside)
            if len(which):
                allowed = KEPT * self.accuracy * (largest[which[:, -1]] + LITTLE)
                leave_out(keep, which, rows.values, allowed)
        return rows.where(keep)


def leave_out(
    keep: NDArray[np.bool_], which: Integers, values: NDArray[np.float64], allowed: NDArray[np.float64]
) -> None:
    """Mark what is not needed of the rows inside the steps `which`, within errors `allowed` [steps, signals]."""
    v = values[which]  # [steps, rows, signals]
    share = np.linspace(0.0, 1.0, which.shape[1])[1:-1, None]
    start, end = v[:, :1], v[:, -1:]
    line = start + share * (end - start)
    straight = ~(np.abs(v[:, 1:-1] - line) > allowed[:, None]).any(axis=(1, 2))
    keep[which[straight, 1:-1]] = False
    if which.shape[1] == 5:
        bend = v[:, 2:3] - 0.5 * (start + end)
        parabola = line + 4.0 * share * (1.0 - share) * bend
        near = ~(np.abs(v[:, 1:-1] - parabola) > allowed[:, None]).any(axis=(1, 2)) & ~straight
        keep[which[near, 1]] = keep[which[near, 3]] = False


def on_grid(rows: Rows) -> Rows:
    """The rows that a run on a grid records: without those that only show what is between."""
    shown = rows.where((rows.side != PASSED) & (rows.side != INSIDE_PASSED))
    return shown._replace(side=np.where(shown.side == GRID, ORDINARY, shown.side).astype(np.int8))
