"""What is left to factorise when the unknowns that cost nothing are taken out: the reduced matrix.

    quadratures            nothing depends on them: found last, from the change of all others
    positions, x' = c v    m_x dx s - c dv = b_x gives dx from dv; the column of x moves into that of v:
                           W_vv = s M_vv - J_vv - J_vx c/(s m_x)

with s the factor of M: 1/(h gamma) in a step, 1 at a consistent point. The reduced matrix is planned once for a
problem (pivot order and patterns: ordering.py), laid out by columns in pivot order, every column with the list of
the entries of J and M that go into it, so that a column can be assembled alone.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from fairlead.integrate.problem import AnyPattern, Integers, Problem

FROM_JACOBIAN, FROM_MASS = -1, -2
"""Kinds of entries; zero and above: from the column of J of the position of that number."""


@dataclass(frozen=True)
class Layout:
    """Which unknowns are in the reduced matrix, and how the others hang on it."""

    reduced: Integers
    """Unknowns of the reduced matrix, ascending."""
    positions: dict[int, int]
    """Unknown of each position: the unknown it is the integral of, or -1."""
    quadratures: Integers
    """Quadratures."""


@dataclass(frozen=True)
class Entries:
    """What J and M put where: one row an entry."""

    row: Integers
    column: Integers
    source: Integers
    """Place in the values of J or of M."""
    kind: Integers


def lay_out(problem: Problem) -> Layout:
    """Sort the unknowns into reduced, positions and quadratures."""
    n = len(problem.initial)
    quadratures = np.flatnonzero(problem.quadrature)
    positions = {x: v for x, v in kinematic_rows(problem).items() if not problem.quadrature[x]}
    out = set(positions) | set(quadratures.tolist())
    # A position whose speed is itself a position, or gone, stays: dx must follow from the reduced matrix alone. Of two
    # that are each the other's rate (x' = v, v' = -x) the first counts as the position.
    for x in sorted(positions, reverse=True):
        if positions[x] in out:
            del positions[x]
            out.discard(x)
    return Layout(np.array([k for k in range(n) if k not in out], dtype=np.int64), positions, quadratures)


def reduced_entries(problem: Problem, layout: Layout) -> Entries:
    """Every entry of J and M that lands in the reduced matrix, rows and columns by unknown."""
    n = len(problem.initial)
    in_reduced = np.zeros(n, dtype=bool)
    in_reduced[layout.reduced] = True
    speed = np.arange(n)
    number = np.full(n, FROM_JACOBIAN)
    speed[layout.quadratures] = -1
    for k, (x, v) in enumerate(layout.positions.items()):
        speed[x], number[x] = v, k
    rows, columns = problem.pattern.rows, columns_of(problem.pattern)
    used = in_reduced[rows] & (speed[columns] >= 0)
    mass_rows, mass_columns = problem.mass_pattern.rows, columns_of(problem.mass_pattern)
    mass_used = in_reduced[mass_rows] & in_reduced[mass_columns]
    return Entries(
        row=np.concatenate([rows[used], mass_rows[mass_used]]),
        column=np.concatenate([speed[columns[used]], mass_columns[mass_used]]),
        source=np.concatenate([np.flatnonzero(used), np.flatnonzero(mass_used)]),
        kind=np.concatenate([number[columns[used]], np.full(int(mass_used.sum()), FROM_MASS)]),
    )


def arrays_of(problem: Problem, layout: Layout) -> dict[str, Integers]:
    """How positions and quadratures follow from the reduced matrix, by the names in memory/of_linear.py."""
    rows, columns = problem.pattern.rows, columns_of(problem.pattern)
    diagonal = _on_diagonal(problem.mass_pattern)
    place = {(i, j): p for p, (i, j) in enumerate(zip(rows.tolist(), columns.tolist(), strict=True))}
    positions = layout.positions
    of_quadrature = [np.flatnonzero(rows == q) for q in layout.quadratures.tolist()]
    entries = np.concatenate([np.zeros(0, np.int64), *of_quadrature]).astype(np.int64)
    return {
        "position": _array(positions),
        "position_speed": _array(positions.values()),
        "position_slope": _array(place.get((x, v), -1) for x, v in positions.items()),
        "position_mass": _array(diagonal[x] for x in positions),
        "quadrature_row": layout.quadratures.astype(np.int64),
        "quadrature_mass": _array(diagonal[q] for q in layout.quadratures.tolist()),
        "quadrature_starts": np.cumsum([0, *(len(found) for found in of_quadrature)]).astype(np.int64),
        "quadrature_entry": entries,
        "quadrature_column": columns[entries],
    }


def kinematic_rows(problem: Problem) -> dict[int, int]:
    """Positions and the one speed (or -1) each depends on.

    Differential, alone in their row and column of M, their own rate not depending on themselves.
    """
    pattern, mass_pattern = problem.pattern, problem.mass_pattern
    n = len(problem.initial)
    rows, columns = pattern.rows, columns_of(pattern)
    mass_rows, mass_columns = mass_pattern.rows, columns_of(mass_pattern)
    alone = np.asarray(problem.differential, dtype=bool) & (np.bincount(mass_rows, minlength=n) == 1)
    alone &= np.bincount(mass_columns, minlength=n) == 1
    alone &= np.bincount(mass_rows[mass_rows == mass_columns], minlength=n) == 1
    alone &= np.bincount(rows[rows == columns], minlength=n) == 0
    alone &= np.bincount(rows, minlength=n) <= 1
    speed = np.full(n, -1)
    single = alone[rows]
    speed[rows[single]] = columns[single]
    return {x: int(speed[x]) for x in np.flatnonzero(alone).tolist()}


def columns_of(pattern: AnyPattern) -> Integers:
    """The column of each entry."""
    return np.repeat(np.arange(len(pattern.starts) - 1, dtype=np.int64), np.diff(pattern.starts))


def _on_diagonal(pattern: AnyPattern) -> dict[int, int]:
    columns = columns_of(pattern)
    places = np.flatnonzero(pattern.rows == columns)
    return dict(zip(pattern.rows[places].tolist(), places.tolist(), strict=True))


def _array(values: Iterable[int]) -> Integers:
    return np.array(list(values), dtype=np.int64)


def starts_of(columns: Integers, n: int) -> Integers:
    """Starts of the columns of entries sorted by column."""
    return np.concatenate([[0], np.cumsum(np.bincount(columns, minlength=n))]).astype(np.int64)


def used_by(columns: Integers, sources: Integers, length: int) -> Integers:
    """The column each source goes into, -1 where it goes into none."""
    column = np.full(length, -1, dtype=np.int64)
    column[sources] = columns
    return column

