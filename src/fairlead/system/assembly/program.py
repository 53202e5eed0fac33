"""The list of multiply-adds that turns partial derivatives of kernels into df/dy and df/dt.

Signals are eliminated as they are inlined: with the partial derivative p of a value with respect to an
input, and the input's coefficient c,

    input is an unknown or t    work[row, column] += c p
    input is a signal s         work[row, column] += c p work[s, column]    for every column of s

Rows are treated level by level (signals by rank, reactions, equations, ledger), so that what stands on
the right is complete. All of it is planned once, with numpy; running it is one loop.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fairlead.distinct import distinct
from fairlead.kernels.layout import ADD_FROM, ADD_PARTIAL, ADD_TO

Integers = NDArray[np.int64]
Floats = NDArray[np.float64]


class Pattern(NamedTuple):
    """Where a sparse matrix has entries, by columns (CSC)."""

    starts: Integers
    rows: Integers


@dataclass
class Entries:
    """Partial derivatives before elimination: row, where the input lies in z, which partial, coefficient."""

    row: list[Integers] = field(default_factory=list)
    z: list[Integers] = field(default_factory=list)
    partial: list[Integers] = field(default_factory=list)
    coef: list[Floats] = field(default_factory=list)

    def add(self, row: Integers, z: Integers, partial: Integers, coef: Floats) -> None:
        """Append entries given as equally long vectors."""
        self.row.append(row)
        self.z.append(z)
        self.partial.append(partial)
        self.coef.append(coef)


@dataclass(frozen=True)
class Program:
    """The multiply-adds, the length of the work vector, and where the Jacobian lies in it (CSC, then df/dt)."""

    steps: Integers  # (k, 3): work, partial, work; columns as ADD_TO, ADD_PARTIAL, ADD_FROM
    coef: Floats  # (k,)
    fixed: Integers  # as steps, those whose factors never change: done once
    fixed_coef: Floats
    length: int
    jacobian_at: int
    starts: Integers
    rows: Integers
    timed: NDArray[np.bool_]  # equations that depend on time
    moving: Integers  # places of work that `steps` add to
    forces: tuple[int, int]  # how many of `steps` and of `moving` come before those of quadratures


def plan(entries: Entries, n: int, n_signals: int, level_of: Integers,
         is_fixed: NDArray[np.bool_] | None = None, quadratures: Sequence[int] = ()) -> Program:  # fmt: skip
    """Plan the elimination.

    Rows: 0 .. n_signals-1 are signals and reactions (as they lie in z behind the unknowns), then the n
    equations. `level_of` gives the level of each row. Column n stands for the time. Inputs are given
    by their place in z: below n an unknown, then the signals, and n + n_signals + 1 the time; the rest
    (zero, accelerations) has no derivative. `is_fixed` tells of every partial derivative whether it is
    one number for good; without it none is. Equations of `quadratures`, on which nothing depends, come
    last, so that they can be left out.
    """
    row, z, partial = (_joined(column) for column in (entries.row, entries.z, entries.partial))
    coef = np.concatenate([*entries.coef, np.zeros(0)])
    direct = (z < n) | (z == n + n_signals + 1)
    via = (z >= n) & (z < n + n_signals)
    column = np.where(z < n, z, n)
    steps, coefs = [], []
    support = _Support(n + 1, n_signals)
    levels = level_of[row]
    length = 1
    for level in distinct(levels[row < n_signals]) if len(row) else []:
        here = (levels == level) & (row < n_signals)
        part = support.expand(row, z - n, partial, coef, column, here & direct, here & via)
        length = support.store(part, length)
        steps.append(part.steps(support.lookup(part.row, part.column)))
        coefs.append(part.coef)
    last = row >= n_signals
    part = support.expand(row, z - n, partial, coef, column, last & direct, last & via)
    equation = part.row - n_signals
    timed = part.column == n
    keys, inverse = np.unique(part.column[~timed] * n + equation[~timed], return_inverse=True)
    place = np.empty(len(equation), np.int64)
    place[~timed] = length + inverse
    place[timed] = length + len(keys) + equation[timed]
    steps.append(part.steps(place))
    coefs.append(part.coef)
    starts = np.searchsorted(keys // max(n, 1), np.arange(n + 1))
    every, coefs_of_all = np.concatenate(steps), np.concatenate(coefs)
    depends = np.zeros(n, dtype=bool)
    depends[equation[timed]] = True
    still = _still(every, length + len(keys) + n, is_fixed)
    summed = np.zeros(length + len(keys) + n, dtype=bool)
    summed[length : length + len(keys)] = np.isin(keys % max(n, 1), quadratures)
    order = np.flatnonzero(~still)
    order = order[np.argsort(summed[every[order, ADD_TO]], kind="stable")]
    moving = distinct(every[order, ADD_TO])
    moving = moving[np.argsort(summed[moving], kind="stable")]
    forces = (int(np.count_nonzero(~summed[every[order, ADD_TO]])), int(np.count_nonzero(~summed[moving])))
    return Program(
        np.ascontiguousarray(every[order]), coefs_of_all[order],
        np.ascontiguousarray(every[still]), coefs_of_all[still], length + len(keys) + n, length,
        starts.astype(np.int64), (keys % max(n, 1)).astype(np.int64), depends, moving, forces,
    )  # fmt: skip


def _still(steps: Integers, length: int, is_fixed: NDArray[np.bool_] | None) -> NDArray[np.bool_]:
    """Which multiply-adds have factors that never change: a fixed partial, and a place only such ones add to."""
    if is_fixed is None:
        return np.zeros(len(steps), dtype=bool)
    moves = np.zeros(length, dtype=bool)
    still = is_fixed[steps[:, ADD_PARTIAL]]
    while True:
        moves[steps[~still, ADD_TO]] = True
        fewer = still & ~moves[steps[:, ADD_FROM]]
        if (fewer == still).all():
            return still
        still = fewer


def _joined(columns: list[Integers]) -> Integers:
    return np.concatenate([*columns, np.zeros(0, np.int64)])


@dataclass(frozen=True)
class _Part:
    """Terms of some rows after expansion: where they go, and what is multiplied."""

    row: Integers
    column: Integers
    partial: Integers
    factor: Integers  # position in work; 0 holds 1
    coef: Floats

    def steps(self, place: Integers) -> Integers:
        """As rows of the program."""
        return np.stack([place, self.partial, self.factor], axis=1).astype(np.int64)


class _Support:
    """Where the derivatives of the signals done so far lie in work."""

    def __init__(self, columns: int, signals: int) -> None:
        self.columns = columns
        self.keys = np.zeros(0, np.int64)  # signal * columns + column, sorted
        self.places = np.zeros(0, np.int64)
        self.signals = signals

    def expand(self, row: Integers, signal: Integers, partial: Integers, coef: Floats, column: Integers,
               direct: NDArray[np.bool_], via: NDArray[np.bool_]) -> _Part:  # fmt: skip
        """Direct terms as they are, terms through a signal once for every column of that signal."""
        first = np.searchsorted(self.keys, signal[via] * self.columns)
        count = np.searchsorted(self.keys, (signal[via] + 1) * self.columns) - first
        repeat = np.repeat(np.arange(len(first)), count)
        inner = np.repeat(first, count) + np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
        return _Part(
            np.concatenate([row[direct], row[via][repeat]]),
            np.concatenate([column[direct], self.keys[inner] % self.columns]),
            np.concatenate([partial[direct], partial[via][repeat]]),
            np.concatenate([np.zeros(direct.sum(), np.int64), self.places[inner]]),
            np.concatenate([coef[direct], coef[via][repeat]]),
        )

    def store(self, part: _Part, length: int) -> int:
        """Give every (signal, column) of the part a place; returns the new length of work."""
        keys = distinct(part.row * self.columns + part.column)
        places = length + np.arange(len(keys))
        order = np.argsort(np.concatenate([self.keys, keys]), kind="stable")
        self.keys = np.concatenate([self.keys, keys])[order]
        self.places = np.concatenate([self.places, places])[order]
        return length + len(keys)

    def lookup(self, row: Integers, column: Integers) -> Integers:
        """Places of (signal, column)."""
        return self.places[np.searchsorted(self.keys, row * self.columns + column)]
