"""The largest and the smallest value of every signal over a run, from the dense output of all steps.

Looked at are all rows an engine hands over: the ends of steps, both sides of events and rows inside steps. Where the
best of them lies in a step, or at an end of one, that has rows inside, the curve through these rows is searched: of the
rows of an event, the step that ends there and the one that starts. Where steps are too short for that, a parabola
through three ends is. So an extreme between two rows is found, whatever is recorded.

Its time is the first at which the signal is there but for rounding (`results/plateau.py`).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.record.event_rows import AFTER, BEFORE, Rows
from fairlead.analysis.record.step_rows import Integers, curved_steps
from fairlead.results.curves import basis
from fairlead.results.plateau import tolerance

POINTS = np.linspace(0.0, 1.0, 33)
TURNS = 2
"""Of Newton's method: a parabola is within a few hundredths of the distance of POINTS, and each turn squares that."""
STRETCH, SHORT = 64, 16
"""Rows of which the best one is searched round, and the same of at most FEW signals: a motion may have a peak in each.
Of two peaks in one stretch the higher may have its rows farther from its top."""
FEW = 32
MOST_AT_ONCE = 2048
"""Places whose rows are laid side by side in memory: a megabyte of them."""
MARGIN = 0.1
"""Steps are searched of which a row comes as near to the largest value so far, in the range of the signal so far."""
AGREE = 0.25
"""Share of the largest second difference by which three may differ that are of one smooth curve."""
ON_CURVE = 0.5
"""Share of the largest second difference that a fourth may have on a curve: of a sine it is 0.15 for a quarter of its
period in a step, 0.6 for half of one. And by which neighbouring second differences of a curve may differ."""
Floats = NDArray[np.float64]
Taken = Callable[[Integers, Integers], Floats]


@dataclass
class Extremes:
    """Lowest and highest values of signals so far, and when."""

    signals: int
    lowest: Floats = field(init=False)
    t_lowest: Floats = field(init=False)
    highest: Floats = field(init=False)
    t_highest: Floats = field(init=False)
    _timed: Floats = field(init=False)
    """Highest values, and those of the negatives, of which the times are told."""

    def __post_init__(self) -> None:
        """Nothing seen yet."""
        self.lowest, self.highest = np.full(self.signals, np.inf), np.full(self.signals, -np.inf)
        self.t_lowest, self.t_highest = np.full(self.signals, np.nan), np.full(self.signals, np.nan)
        self._timed = np.full(2 * self.signals, -np.inf)

    def watch(self, rows: Rows) -> None:
        """Take rows of whole steps."""
        if not len(rows.t) or not self.signals:
            return
        steps = [which for inside in (1, 3) if len(which := curved_steps(rows.side, inside))]
        before = np.concatenate([self.highest, -self.lowest])
        length = SHORT if self.signals <= FEW else STRETCH
        best, when = _highest(rows, rows.values[:, : self.signals], steps, before, length)
        self.highest = np.maximum(self.highest, best[: self.signals])
        self.lowest = np.minimum(self.lowest, -best[self.signals :])
        later = best > self._timed + np.tile(tolerance(self.highest, self.lowest), 2)
        self._timed[later] = best[later]
        top, bottom = later[: self.signals], later[self.signals :]
        self.t_highest[top], self.t_lowest[bottom] = when[: self.signals][top], when[self.signals :][bottom]

    def plain(self, names: Sequence[str]) -> dict[str, list[float]]:
        """For run.json: [lowest, when, highest, when] of the first signals, by name."""
        columns = np.stack([self.lowest, self.t_lowest, self.highest, self.t_highest], axis=1)[: len(names)]
        rows = zip(names, columns, strict=True)
        return {name: row.tolist() for name, row in rows if np.isfinite(row).all()}


def _highest(rows: Rows, values: Floats, steps: list[Integers], before: Floats, length: int) -> tuple[Floats, Floats]:
    """The highest value of each signal, and of its negative, in these rows, and when: where it is above `before`.

    `values` is [rows, signals]. Every stretch of `length` rows tells its highest value; where that comes near to the
    highest so far, the row it is in is looked up and searched round. The negative of a signal is one more signal here,
    since a call costs more than a column.
    """
    signals = values.shape[1]
    best = np.concatenate([_of_stretches(np.fmax, values, length), -_of_stretches(np.fmin, values, length)])
    best[np.isnan(best)] = -np.inf
    near = _tolerances(best, before)
    signal, stretch = np.nonzero(_near(best, before))
    least = (np.maximum(before, best.max(axis=1)) - near)[signal]  # what is below this is not the highest
    column, sign = signal % signals, np.where(signal < signals, 1.0, -1.0)

    def taken(of: Integers, at: Integers) -> Floats:
        """The places `of`: what they look at in these rows [of, rows]."""
        return np.asarray(sign[of, None] * values[at, column[of, None]])

    row, value = _first_best(values, column, sign, stretch, length, near[signal])
    t = rows.t[row]
    first, last = np.searchsorted(rows.t, t, side="left"), np.searchsorted(rows.t, t, side="right") - 1
    for which in steps:
        within = np.searchsorted(which[:, 0], last, side="right") - 1
        ending = np.searchsorted(which[:, 0], first, side="left") - 1
        ends_here = (first <= which[ending, -1]) & (which[ending, -1] <= last)
        for step, found in ((within, last <= which[within, -1]), (ending, ends_here)):
            of = np.flatnonzero((step >= 0) & found)
            at = which[step[of]]
            seen = taken(of, at)
            near_top = may_reach(seen, least[of])
            of, at, seen = of[near_top], at[near_top], seen[near_top]
            if len(of):
                peak, share = peak_of_curves(seen)
                if at.shape[1] == 3:
                    peak[_bends_alone(rows, taken, of, at)] = -np.inf
                t0, t1 = rows.t[at[:, 0]], rows.t[at[:, -1]]
                _raise_to(value, t, near[signal], of, peak, t0 + share * (t1 - t0))
    _raise_to(value, t, near[signal], *peak_of_neighbours(rows, taken, row))
    when = np.full(best.shape, np.nan)
    best[signal, stretch], when[signal, stretch] = value, t
    top = best.max(axis=1)
    place = ((best >= (top - near)[:, None]) & ~np.isnan(when)).argmax(axis=1)
    return top, when[np.arange(len(best)), place]


def _tolerances(best: Floats, before: Floats) -> Floats:
    """How near to the highest a value of a signal has to be to count as it."""
    top = np.maximum(before, best.max(axis=1, initial=-np.inf))
    return np.asarray(tolerance(top, -np.roll(top, len(top) // 2)))


def _of_stretches(best_of: np.ufunc, values: Floats, length: int) -> Floats:
    """[signals, stretches]: the best of each stretch of rows; NaN is none. Rows are read as they lie in memory."""
    rows, signals = values.shape
    whole = rows - rows % length
    found = best_of.reduce(values[:whole].reshape(-1, length, signals), axis=1)
    if whole < rows:
        found = np.concatenate([found, best_of.reduce(values[whole:], axis=0)[None]])
    return np.asarray(found.T)


def _first_best(
    values: Floats, column: Integers, sign: Floats, stretch: Integers, length: int, near: Floats
) -> tuple[Integers, Floats]:
    """Of places that look at a column in a stretch, with a sign: the first row at the highest value, and that value.

    The rows of a stretch are a slice of the values; to gather them one by one took twice as long.
    """
    whole = len(values) // length
    rest, stretches = values[whole * length :], values[: whole * length].reshape(whole, length, values.shape[1])
    first, highest = np.empty(len(stretch), dtype=np.int64), np.empty(len(stretch))
    for begin in range(0, len(stretch), MOST_AT_ONCE):
        some = slice(begin, begin + MOST_AT_ONCE)
        inside = stretch[some] < whole
        seen = np.full((len(inside), length), np.nan)
        seen[inside] = stretches[stretch[some][inside], :, column[some][inside]]
        seen[~inside, : len(rest)] = rest[:, column[some][~inside]].T
        seen *= sign[some, None]
        seen[np.isnan(seen)] = -np.inf
        highest[some] = seen.max(axis=1)
        first[some] = (seen >= (highest[some] - near[some])[:, None]).argmax(axis=1)
    return length * stretch + first, highest


def _near(best: Floats, before: Floats) -> NDArray[np.bool_]:
    """[2 signals, stretches]: whether a stretch comes near to the highest so far, in the range of the signal so far."""
    so_far = np.empty_like(best)
    so_far[:, 0] = before
    for k in range(1, best.shape[1]):  # few stretches of many signals: accumulate goes along the other way, much slower
        np.fmax(so_far[:, k - 1], best[:, k - 1], out=so_far[:, k])
    least = -np.roll(so_far, len(before) // 2, axis=0)
    with np.errstate(invalid="ignore"):
        return np.asarray((best > so_far - MARGIN * (so_far - least)) | ~np.isfinite(so_far))


def _raise_to(best: Floats, when: Floats, near: Floats, of: Integers, value: Floats, t: Floats) -> None:
    """Take values of the places `of` that are above the best, and their times if they are so by more than rounding."""
    higher, later = value > best[of], value > best[of] + near[of]
    best[of[higher]], when[of[later]] = value[higher], t[later]


def _bends_alone(rows: Rows, taken: Taken, of: Integers, at: Integers) -> NDArray[np.bool_]:
    """Of steps with one row inside [k, 3]: whether the parabola bends otherwise than its neighbours on either side do.

    Then it leads through a jump and would overshoot it. A step without neighbours is believed.
    """
    wide = np.concatenate([at[:, :1] - 1, at, at[:, -1:] + 1], axis=1)
    seen = np.clip(wide, 0, len(rows.t) - 1)
    gaps, v = np.diff(rows.t[seen], axis=1), taken(of, seen)
    with np.errstate(divide="ignore", invalid="ignore"):
        slopes = np.diff(v, axis=1) / gaps
        bends = np.diff(slopes, axis=1) / (gaps[:, 1:] + gaps[:, :-1])
        alike = np.abs(bends[:, ::2] - bends[:, 1:2]) <= ON_CURVE * np.abs(bends[:, 1:2])
    known = gaps[:, ::3] > 0.0  # nothing before the first row, nor on the other side of an event
    return np.asarray(known.any(axis=1) & ~(alike & known).any(axis=1))


def peak_of_neighbours(rows: Rows, taken: Taken, row: Integers) -> tuple[Integers, Floats, Floats]:
    """Of ends of short steps: the peaks of parabolas through highest rows and their neighbours; of which, and when.

    Only where five rows lie on one: where their three second differences agree.
    """
    inner = np.flatnonzero((row >= 2) & (row + 2 < len(rows.t)))
    at = row[inner][:, None] + np.arange(-2, 3)
    t, sides = rows.t[at], rows.side[at]
    gaps = t[:, 1:] - t[:, :-1]
    plain = (gaps > 0.0).all(axis=1) & ~((sides == BEFORE) | (sides == AFTER)).any(axis=1)
    inner, at, t, gaps = inner[plain], at[plain], t[plain], gaps[plain]
    if not len(inner):
        return inner, np.empty(0), np.empty(0)
    v = taken(inner, at)
    slopes = (v[:, 1:] - v[:, :-1]) / gaps
    bends = (slopes[:, 1:] - slopes[:, :-1]) / (gaps[:, :-1] + gaps[:, 1:])
    spread = bends.max(axis=1) - bends.min(axis=1)
    agree = (spread <= AGREE * np.abs(bends).max(axis=1)) & (bends[:, 1] < 0.0)
    inner, t, v, gaps, slopes, bend = (x[agree] for x in (inner, t, v, gaps, slopes, bends[:, 1]))
    slope = (slopes[:, 1] * gaps[:, 2] + slopes[:, 2] * gaps[:, 1]) / (gaps[:, 1] + gaps[:, 2])
    shift = np.clip(-slope / (2.0 * bend), -gaps[:, 1], gaps[:, 2])
    return inner, v[:, 2] + shift * (slope + bend * shift), t[:, 2] + shift


def may_reach(v: Floats, least: Floats) -> NDArray[np.bool_]:
    """Where a curve through evenly spaced values [k, n] may reach `least` [k]; always where a value is no number.

    It is above the highest value by the difference to the lowest times the sum of the negative weights at most.
    """
    with np.errstate(invalid="ignore"):
        top = v.max(axis=1)
        return np.asarray(~(top + _overshoot(v.shape[1]) * (top - v.min(axis=1)) < least))


@cache
def _overshoot(n: int) -> float:
    """The largest sum of the negative weights of a curve through n evenly spaced values, with a little to spare."""
    weights = basis(np.linspace(0.0, 1.0, 1001), np.linspace(0.0, 1.0, n))
    return 1.01 * float(-np.minimum(weights, 0.0).sum(axis=1).min())


def peak_of_curves(v: Floats) -> tuple[Floats, Floats]:
    """Of curves through evenly spaced values [k, n]: the highest value of each, and after which share of the way.

    The highest of the values themselves where no curve goes through them: one through both ends of a jump overshoots.
    """
    value, share = _top_of_curves(v)
    jumps, best = _jumps(v), v.argmax(axis=1)
    return np.where(jumps, v.max(axis=1), value), np.where(jumps, best / (v.shape[1] - 1), share)


def _jumps(v: Floats) -> NDArray[np.bool_]:
    """Where a fourth difference of five values is not small beside their second ones, as it is on a curve."""
    if v.shape[1] < 5:
        return np.zeros(len(v), dtype=bool)
    second = v[:, 2:] - 2.0 * v[:, 1:-1] + v[:, :-2]
    fourth = second[:, 2:] - 2.0 * second[:, 1:-1] + second[:, :-2]
    return np.asarray(np.abs(fourth).max(axis=1) > ON_CURVE * np.abs(second).max(axis=1))


def _top_of_curves(v: Floats) -> tuple[Floats, Floats]:
    """The highest value of each curve and its place: near the best of POINTS, also of those at the ends.

    From the top of the parabola through three of POINTS on, TURNS steps of Newton's method on the slope.
    """
    at_points, powers = _evenly_spaced(v.shape[1])
    above = v - v[:, :1]  # its first value: what is constant stays what it is
    found = above @ at_points
    place = found.argmax(axis=1)
    middle = np.clip(place, 1, len(POINTS) - 2)
    k = np.arange(len(v))
    left, centre, right = found[k, middle - 1], found[k, middle], found[k, middle + 1]
    best, share = found[k, place], POINTS[place]
    coefficients = above @ powers
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        guess = POINTS[middle] + POINTS[1] * 0.5 * (left - right) / (left - 2.0 * centre + right)
        for _ in range(1 + TURNS):
            value, slope, bend = _taylor(coefficients, guess)
            inside = (np.abs(guess - POINTS[place]) <= POINTS[1]) & (guess >= 0.0) & (guess <= 1.0)
            higher = inside & (value > best)
            best, share = np.where(higher, value, best), np.where(higher, guess, share)
            guess = guess - slope / bend
    return best + v[:, 0], share


def _taylor(coefficients: Floats, share: Floats) -> tuple[Floats, Floats, Floats]:
    """Of polynomials [k, n], powers rising: value, first and second derivative at `share` [k]."""
    value, slope, half_bend = (np.zeros(len(share)) for _ in range(3))
    for n in range(coefficients.shape[1] - 1, -1, -1):
        half_bend = half_bend * share + slope
        slope = slope * share + value
        value = value * share + coefficients[:, n]
    return value, slope, 2.0 * half_bend


@cache
def _evenly_spaced(n: int) -> tuple[Floats, Floats]:
    """Of n evenly spaced values, the weights [n, points] at POINTS, and those [n, n] of the powers of the share."""
    nodes = np.linspace(0.0, 1.0, n)
    powers: Floats = np.linalg.inv(np.vander(nodes, increasing=True)).astype(np.float64)
    return basis(POINTS, nodes).T, powers.T
