"""Which rows a run on a grid keeps: those of the grid, and both sides of every event at which a recorded value jumps.

    jumps     |right - left| > least (largest + LITTLE)      largest: of that value up to this very row

A kink needs no row of its own, and a long line switches thousands of times. What is kept follows from the rows before
and not from how they were handed over: a left side that ends a block waits for its right side in the next.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

BEFORE, AFTER = 1, 2  # sides of an event, as the engine numbers them
LITTLE = 1e-9  # of whatever unit: less is nothing


class Rows(NamedTuple):
    """Recorded rows: times [k], values [k, m], side of an event [k] as the engine numbers them."""

    t: NDArray[np.float64]
    values: NDArray[np.float64]
    side: NDArray[np.int8]

    def where(self, which: NDArray[np.bool_] | slice) -> Rows:
        """Some of them."""
        return Rows(self.t[which], self.values[which], self.side[which])

    def kept(self, first: int) -> Rows:
        """Those from `first` on, to be kept: copies, since a view of a few rows keeps all of them in memory."""
        return Rows(self.t[first:].copy(), self.values[first:].copy(), self.side[first:].copy())


class EventRows:
    """Takes rows block by block and gives back those to write."""

    def __init__(self, least: NDArray[np.float64]) -> None:
        """`least` [m]: share of its largest value from which a difference across an event is a jump; inf: never."""
        self.least = least
        self.largest = np.zeros(len(least))
        self.kept = 0
        """Events that have two rows."""
        self.jumps = np.zeros(len(least), dtype=np.int64)
        """By value: events at which it jumps."""
        self._waiting: Rows | None = None

    def take(self, rows: Rows) -> Rows:
        """The rows to write of these and of one that waited."""
        if self._waiting is not None:
            first, more = self._waiting, rows
            t, values = np.concatenate([first.t, more.t]), np.concatenate([first.values, more.values])
            rows = Rows(t, values, np.concatenate([first.side, more.side]))
        ends_left = len(rows.side) > 0 and rows.side[-1] == BEFORE
        self._waiting = rows.kept(-1) if ends_left else None
        if ends_left:
            rows = rows.where(slice(0, -1))
        return rows.where(self._worth_keeping(rows)) if len(rows.t) else rows

    def rest(self) -> Rows | None:
        """The row that waits, when no more will follow: the run ended at an event."""
        return self._waiting

    def _worth_keeping(self, rows: Rows) -> NDArray[np.bool_]:
        """By row; counts what jumps."""
        left = np.flatnonzero((rows.side[:-1] == BEFORE) & (rows.side[1:] == AFTER))
        apart = np.abs(rows.values[left + 1] - rows.values[left])
        jump = apart > self.least * (self.largest + LITTLE)  # at most these: the largest value so far only grows
        which = np.flatnonzero(jump.any(axis=1))
        begin = 0
        for k in which:
            self._enlarge(rows.values[begin : left[k] + 2])
            begin = left[k] + 2
            jump[k] = apart[k] > self.least * (self.largest + LITTLE)
        self._enlarge(rows.values[begin:])
        sharp = jump.any(axis=1)
        self.kept += int(np.count_nonzero(sharp))
        self.jumps += jump.sum(axis=0)
        keep = np.ones(len(rows.side), dtype=bool)
        smooth = left[~sharp]
        keep[smooth] = keep[smooth + 1] = False
        return keep

    def _enlarge(self, values: NDArray[np.float64]) -> None:
        """Take the largest value of each signal from these rows too; NaN is none."""
        if len(values):
            np.fmax(self.largest, np.fmax.reduce(values, axis=0), out=self.largest)
            np.fmax(self.largest, -np.fmin.reduce(values, axis=0), out=self.largest)
