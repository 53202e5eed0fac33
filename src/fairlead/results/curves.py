"""The value of a signal between recorded rows: on the curve of the step, or through neighbours on a grid.

1. A step whose dense output is no straight line has rows inside it (side 2). The curve goes through all rows of the
   step, so that it is the dense output itself where a signal is an unknown, and close to it where it follows from some.
2. A run on a grid (`record.every`) has no rows of steps. There the cubic through four neighbouring rows is taken where
   nothing switches between them and their third difference is small against their second ones; no further than the two
   rows, where it does not turn between them. Next to an event its row there is the last of the four, however near.
3. Else a straight line, and never anything across the two rows of an event.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.distinct import distinct

BEFORE, ORDINARY, AFTER, INSIDE = -1, 0, 1, 2
"""What a row of a file is: just before an event or just after it, neither, or inside a step (`Result.side`)."""
SMOOTH = 0.5
"""Largest third difference of rows that are on a smooth curve, in their second ones; or fourth, in their third."""
EVEN = 1e-6

Floats = NDArray[np.float64]
Places = NDArray[np.intp]


def basis(share: Floats, nodes: Floats) -> Floats:
    """[k, n]: weights of values at `nodes` [k, n] or [n] in the polynomial through them, at `share` [k] (Lagrange)."""
    nodes = np.broadcast_to(nodes, (len(share), np.shape(nodes)[-1]))
    keep = ~np.eye(nodes.shape[1], dtype=bool)
    above = np.where(keep, (share[:, None] - nodes)[:, None, :], 1.0).prod(axis=2)
    below = np.where(keep, nodes[:, :, None] - nodes[:, None, :], 1.0).prod(axis=2)
    return np.asarray(above / below)


@dataclass(frozen=True)
class Curves:
    """Recorded times [n] and sides [n]; times of switches [m], None for a run that is not on a grid."""

    t: Floats
    side: NDArray[np.int8]
    switches: Floats | None = None

    def before(self, values: Floats, at: Floats) -> Floats:
        """The values at `at`; where a recorded time is hit, its first row counts."""
        right = np.searchsorted(self.t, at, side="left")
        return self._between(values, np.maximum(right - 1, 0), right, at)

    def after(self, values: Floats, at: Floats) -> Floats:
        """The values at `at`; where a recorded time is hit, its last row counts."""
        left = np.searchsorted(self.t, at, side="right") - 1
        return self._between(values, left, np.minimum(left + 1, len(self.t) - 1), at)

    def _between(self, values: Floats, left: Places, right: Places, at: Floats) -> Floats:
        """Between rows `left` and `right`; a row that is hit gives its own value."""
        t = self.t
        width = np.where(t[right] > t[left], t[right] - t[left], 1.0)
        share = np.clip((at - t[left]) / width, 0.0, 1.0)
        found = np.array((1 - share) * values[left] + share * values[right], ndmin=1)
        inner = np.flatnonzero(np.atleast_1d((share > 0.0) & (share < 1.0)))
        if len(inner):
            left, at = np.atleast_1d(left)[inner], np.atleast_1d(at)[inner]
            for which, first, count in self._curves(values, left):
                rows = first[:, None] + np.arange(count)
                begin, length = t[rows[:, :1]], t[rows[:, -1:]] - t[rows[:, :1]]
                nodes = (t[rows] - begin) / length
                weights = basis((at[which] - begin[:, 0]) / length[:, 0], nodes)
                curve = (weights * values[rows]).sum(axis=1)
                low, high = self._bounds(values, rows, left[which])
                found[inner[which]] = np.clip(curve, low, high)
        return found.reshape(np.shape(share))

    def _bounds(self, values: Floats, rows: Places, left: Places) -> tuple[Floats, Floats]:
        """What a curve through `rows` [k, n] does not go beyond right of row `left` [k].

        Where all rows are equal, their value; on a grid the two rows there, unless those beside them say that the curve
        turns between them: a corner that no row has met would be rounded off to beyond the limit it stands for.
        """
        least, most = values[rows].min(axis=1), values[rows].max(axis=1)
        equal = least == most
        low, high = np.where(equal, least, -np.inf), np.where(equal, most, np.inf)
        if self.switches is not None:
            last = len(values) - 1
            before, one, other, after = (values[np.clip(left + k, 0, last)] for k in (-1, 0, 1, 2))
            begin, end = self._slopes(left, before, one, other, after)
            straight = begin * end >= 0.0
            low = np.where(straight, np.minimum(one, other), low)
            high = np.where(straight, np.maximum(one, other), high)
        return low, high

    def _slopes(
        self, left: Places, before: Floats, one: Floats, other: Floats, after: Floats
    ) -> tuple[Floats, Floats]:
        """How the signal goes into and out of the interval right of rows `left`; at an event, as it does inside."""
        last = len(self.t) - 1
        gaps = [self.t[np.clip(left + k + 1, 0, last)] - self.t[np.clip(left + k, 0, last)] for k in (-1, 0, 1)]
        h0, h1, h2 = (np.where(gap > 0.0, gap, 1.0) for gap in gaps)
        here, bent_before = (other - one) / h1, (other - one) / h1 - (one - before) / h0
        bent_after = (after - other) / h2 - here
        opens, closes = self.side[left] == AFTER, self.side[np.clip(left + 1, 0, last)] == BEFORE
        return (np.where(opens, here - bent_after * h1 / (h1 + h2), one - before),
                np.where(closes, here + bent_before * h1 / (h0 + h1), after - other))  # fmt: skip

    def _curves(self, values: Floats, left: Places) -> list[tuple[Places, Places, int]]:
        """Which of the places right of rows `left` are on a curve, the first row of each, and how many rows it has."""
        ends = np.flatnonzero(self.side != INSIDE)
        step = np.searchsorted(ends, left, side="right") - 1
        known = (step >= 0) & (step + 1 < len(ends))
        first = np.where(known, ends[np.clip(step, 0, None)], 0)
        count = np.where(known, ends[np.clip(step + 1, 0, len(ends) - 1)] - first + 1, 2)
        curves = [(which := np.flatnonzero(count == n), first[which], int(n)) for n in distinct(count) if n > 2]
        if self.switches is not None:
            taken = np.zeros(len(left), dtype=bool)
            for back in (1, 0, 2):  # the four rows round it; where something switches there, those to one side
                fits = self._smooth(values, left - back)
                if back != 1:
                    fits |= self._smooth_to_an_event(values, left - back, opening=back == 0)
                which = np.flatnonzero(~taken & fits)
                taken[which] = True
                curves.append((which, left[which] - back, 4))
        return curves

    def _smooth(self, values: Floats, first: Places) -> NDArray[np.bool_]:
        """Whether the four rows from `first` on lie on one smooth curve, by themselves or with their neighbours."""
        inside = (first >= 0) & (first + 4 <= len(self.t))
        if self.switches is None or not inside.any():
            return np.zeros(len(first), dtype=bool)
        rows = np.where(inside, first, 0)[:, None] + np.arange(4)
        second = np.abs(np.diff(values[rows], n=2, axis=1)).max(axis=1)
        third = np.abs(np.diff(values[rows], n=3, axis=1))[:, 0]
        return np.asarray(inside & self._plain(rows) & ((third <= SMOOTH * second) | self._steady(values, first)))

    def _steady(self, values: Floats, first: Places) -> NDArray[np.bool_]:
        """Whether the third differences of the four rows and one to each side agree: where a curve has no bend."""
        inside = (first >= 1) & (first + 5 <= len(self.t))
        if not inside.any():
            return inside
        rows = np.where(inside, first, 1)[:, None] + np.arange(-1, 5)
        third, fourth = (np.abs(np.diff(values[rows], n=n, axis=1)).max(axis=1) for n in (3, 4))
        return np.asarray(inside & self._plain(rows) & (fourth <= SMOOTH * third))

    def _smooth_to_an_event(self, values: Floats, first: Places, *, opening: bool) -> NDArray[np.bool_]:
        """The same of four rows the first of which (`opening`), or the last, is one of an event, between two of a grid.

        Differences are divided ones, in the width of the grid: 2 f[t1, t2, t3] h^2 and 6 f[t0, t1, t2, t3] h^3.
        """
        inside = (first >= 0) & (first + 4 <= len(self.t))
        if self.switches is None or not inside.any():
            return np.zeros(len(first), dtype=bool)
        rows = np.where(inside, first, 0)[:, None] + np.arange(4)
        event, side = (0, AFTER) if opening else (3, BEFORE)
        on_grid = [k for k in range(4) if k != event]
        fits = inside & (self.side[rows[:, event]] == side) & (self.side[rows[:, on_grid]] == ORDINARY).all(axis=1)
        gaps = np.diff(self.t[rows], axis=1)
        short, even, h = gaps[:, 0 if opening else 2], gaps[:, 2 if opening else 0], gaps[:, 1]
        fits &= (h > 0.0) & (np.abs(even - h) <= EVEN * h) & (short > 0.0) & (short <= (1.0 + EVEN) * h)
        begin = np.searchsorted(self.switches, self.t[rows[:, 0]], "right")
        fits &= begin == np.searchsorted(self.switches, self.t[rows[:, 3]], "left")
        if not fits.any():
            return np.asarray(fits)
        width = np.where(gaps > 0.0, gaps, 1.0) / np.where(h > 0.0, h, 1.0)[:, None]
        slopes = np.diff(values[rows], axis=1) / width
        second = 2.0 * np.diff(slopes, axis=1) / (width[:, :-1] + width[:, 1:])
        third = 3.0 * np.abs(np.diff(second, axis=1)[:, 0]) / width.sum(axis=1)
        return np.asarray(fits & (third <= SMOOTH * np.abs(second).max(axis=1)))

    def _plain(self, rows: Places) -> NDArray[np.bool_]:
        """Whether rows are as far apart as the grid says, and nothing switches between them."""
        if self.switches is None:
            return np.zeros(len(rows), dtype=bool)
        gaps = np.diff(self.t[rows], axis=1)
        even = (np.abs(gaps - gaps[:, 1:2]) <= EVEN * gaps[:, 1:2]).all(axis=1) & (gaps[:, 1] > 0.0)
        begin = np.searchsorted(self.switches, self.t[rows[:, 0]], "right")
        end = np.searchsorted(self.switches, self.t[rows[:, -1]], "left")
        return np.asarray(even & (begin == end) & (self.side[rows] == ORDINARY).all(axis=1))
