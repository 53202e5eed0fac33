"""Where the entries of W live, and in which order its unknowns are eliminated: planned once per run.

    1. quadratures          nothing depends on them: their column is a lone pivot, they cause no fill
    2. positions, x' = v    the pivot is 1/(h gamma), never small; eliminating them first is the same as
                            condensing them out: W_vv = M/(h gamma) - J_vv - h gamma J_vx
    3. the rest             by minimum degree on A + A', an algebraic unknown only after the differential
                            unknowns its row and column touch

The third rule is what makes one order serve every zone and every h: the diagonal of a multiplier
vanishes while its contact holds, and only the elimination of the speeds it acts on fills it in.
Pivots stay on the diagonal. Fill is computed exactly, by merging rows, so that the patterns of L and
U hold for every zone.
"""

from __future__ import annotations

import heapq
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from fairlead.integrate.protocol import AnyPattern, Integers, Pattern, Problem

DENSE_LIMIT = 12
"""Up to this many unknowns a full matrix with partial pivoting is as fast as any pattern."""
FULL_FASTER = 3.0
"""A sparse operation costs about this many of a full one: measured on a chain of 10 blocks (30 unknowns),
factorised in 4.7 microseconds full and in about 1 by its pattern."""


@dataclass(frozen=True, eq=False)
class Plan:
    """Layout of `matrix` and, when sparse, the pivot order and the patterns of the factors."""

    dense: bool
    size: int
    """Length of `matrix`."""
    jacobian_place: Integers
    mass_place: Integers
    """Where each entry of the Jacobian and mass pattern goes in `matrix`."""
    arrays: dict[str, Integers] = field(default_factory=dict)
    """Arrays of the sparse plan by their name in memory.py; empty when dense."""


def plan(problem: Problem) -> Plan:
    """The plan for a problem: full when it is small, else sparse in a good order."""
    if len(problem.initial) <= DENSE_LIMIT:
        return dense_plan(problem.pattern, problem.mass_pattern)
    order = elimination_order(problem)
    sparse = sparse_plan(problem.pattern, problem.mass_pattern, order, order)
    n = len(order)
    if FULL_FASTER * operations(sparse) > n**3 / 3 + n**2:
        return dense_plan(problem.pattern, problem.mass_pattern)
    return sparse


def operations(plan: Plan) -> int:
    """Multiplications of one sparse factorisation: each entry of U brings in one column of L."""
    length = np.diff(plan.arrays["lower_starts"])
    return int(length[plan.arrays["upper_rows"]].sum() + length.sum() + plan.size)


def dense_plan(pattern: AnyPattern, mass_pattern: AnyPattern) -> Plan:
    """A full matrix by rows."""
    n = len(pattern.starts) - 1
    return Plan(
        dense=True,
        size=n * n,
        jacobian_place=pattern.rows * n + columns_of(pattern),
        mass_place=mass_pattern.rows * n + columns_of(mass_pattern),
    )


def sparse_plan(
    pattern: AnyPattern, mass_pattern: AnyPattern, row_order: Integers, column_order: Integers
) -> Plan:
    """Columns and rows in the given pivot orders (position k: which unknown), with the fill they cause."""
    n = len(row_order)
    new_row, new_column = inverse(row_order), inverse(column_order)
    rows = np.concatenate([new_row[pattern.rows], new_row[mass_pattern.rows]])
    columns = np.concatenate([new_column[columns_of(pattern)], new_column[columns_of(mass_pattern)]])
    keys, place = np.unique(columns * n + rows, return_inverse=True)
    matrix_rows, matrix_columns = keys % n, keys // n
    n_jacobian, n_mass = len(pattern.rows), len(mass_pattern.rows)
    lower, upper = fill(matrix_rows, matrix_columns, n)
    return Plan(
        dense=False,
        size=len(keys),
        jacobian_place=place[:n_jacobian].astype(np.int64),
        mass_place=place[n_jacobian : n_jacobian + n_mass].astype(np.int64),
        arrays={
            "row_order": row_order, "column_order": column_order,
            "matrix_starts": starts_of(matrix_columns, n), "matrix_rows": matrix_rows,
            "lower_starts": lower.starts, "lower_rows": lower.rows,
            "upper_starts": upper.starts, "upper_rows": upper.rows,
        },
    )  # fmt: skip


def columns_of(pattern: AnyPattern) -> Integers:
    """The column of each entry."""
    return np.repeat(np.arange(len(pattern.starts) - 1, dtype=np.int64), np.diff(pattern.starts))


def starts_of(columns: Integers, n: int) -> Integers:
    """Starts of the columns of entries sorted by column."""
    return np.concatenate([[0], np.cumsum(np.bincount(columns, minlength=n))]).astype(np.int64)


def inverse(order: Integers) -> Integers:
    """The position of each unknown in an order."""
    position = np.empty(len(order), dtype=np.int64)
    position[order] = np.arange(len(order))
    return position


def fill(rows: Integers, columns: Integers, n: int) -> tuple[Pattern, Pattern]:
    """Patterns of L (without its diagonal) and U (without the diagonal), both by columns, ascending.

    Eliminating pivot k merges the part of row k right of the diagonal into every row with an entry in
    column k. For a pattern with little fill this is linear in the entries of the factors.
    """
    right: list[set[int]] = [set() for _ in range(n)]
    below: list[set[int]] = [set() for _ in range(n)]
    for i, j in zip(rows.tolist(), columns.tolist(), strict=True):
        if j > i:
            right[i].add(j)
        elif j < i:
            below[j].add(i)
    for k in range(n):
        row = right[k]
        if not row:
            continue
        for i in below[k]:
            for j in row:
                if j > i:
                    right[i].add(j)
                elif j < i:
                    below[j].add(i)
    upper_rows: list[list[int]] = [[] for _ in range(n)]
    for i in range(n):
        for j in right[i]:
            upper_rows[j].append(i)
    return by_columns([sorted(column) for column in below]), by_columns(upper_rows)


def by_columns(lists: Sequence[Sequence[int]]) -> Pattern:
    """A pattern from the rows of each column."""
    starts = np.concatenate([[0], np.cumsum([len(column) for column in lists])]).astype(np.int64)
    return Pattern(starts, np.array([row for column in lists for row in column], dtype=np.int64))


def elimination_order(problem: Problem) -> Integers:
    """Order of the unknowns by the three rules of the module docstring."""
    n = len(problem.initial)
    pattern, mass_pattern = problem.pattern, problem.mass_pattern
    rows = np.concatenate([pattern.rows, mass_pattern.rows])
    columns = np.concatenate([columns_of(pattern), columns_of(mass_pattern)])
    off = rows != columns
    touches: list[set[int]] = [set() for _ in range(n)]
    touched_by: list[set[int]] = [set() for _ in range(n)]
    for i, j in zip(rows[off].tolist(), columns[off].tolist(), strict=True):
        touches[i].add(j)
        touched_by[j].add(i)
    first = [k for k in range(n) if problem.quadrature[k]]
    gone = set(first)
    for k in first:
        for j in touches[k]:
            touched_by[j].discard(k)
    positions = kinematic_rows(problem, touches)
    for x in positions:
        if x not in gone:
            condense(x, touches, touched_by)
            first.append(x)
            gone.add(x)
    graph = [set() if k in gone else (touches[k] | touched_by[k]) - gone for k in range(n)]
    differential = set(np.flatnonzero(problem.differential).tolist())
    waits_for = [set() if k in differential else graph[k] & differential for k in range(n)]
    rest = [k for k in range(n) if k not in gone]
    return np.array(first + minimum_degree(graph, waits_for, rest), dtype=np.int64)


def kinematic_rows(problem: Problem, touches: Sequence[set[int]]) -> list[int]:
    """Positions: differential, alone in their row and column of M, their row depending on one speed only."""
    pattern, mass_pattern = problem.pattern, problem.mass_pattern
    n = len(problem.initial)
    mass_rows, mass_columns = mass_pattern.rows, columns_of(mass_pattern)
    in_row = np.bincount(mass_rows, minlength=n)
    in_column = np.bincount(mass_columns, minlength=n)
    on_diagonal = np.bincount(mass_rows[mass_rows == mass_columns], minlength=n)
    own_slope = np.bincount(pattern.rows[pattern.rows == columns_of(pattern)], minlength=n)
    alone = (in_row == 1) & (in_column == 1) & (on_diagonal == 1) & (own_slope == 0) & problem.differential
    return [k for k in np.flatnonzero(alone).tolist() if len(touches[k]) <= 1]


def condense(x: int, touches: list[set[int]], touched_by: list[set[int]]) -> None:
    """Eliminate position x: who depends on x now depends on the speed of x."""
    for v in touches[x]:
        touched_by[v].discard(x)
        for i in touched_by[x]:
            if i != v:
                touches[i].add(v)
                touched_by[v].add(i)
    for i in touched_by[x]:
        touches[i].discard(x)


def minimum_degree(graph: list[set[int]], waits_for: list[set[int]], unknowns: Sequence[int]) -> list[int]:
    """Eliminate the unknown of least degree (of least number among equals) that need not wait for another.

    `graph` is symmetric and is consumed. Ties by number keep the order the same on every machine.
    """
    waiting = {k: set(waits_for[k]) for k in unknowns}
    holders: dict[int, list[int]] = {}
    for k in unknowns:
        for j in waiting[k]:
            holders.setdefault(j, []).append(k)
    heap = [(len(graph[k]), k) for k in unknowns if not waiting[k]]
    heapq.heapify(heap)
    done: set[int] = set()
    order: list[int] = []
    while heap:
        degree, k = heapq.heappop(heap)
        if k in done or degree != len(graph[k]):
            continue
        done.add(k)
        order.append(k)
        neighbours = graph[k]
        for j in neighbours:
            graph[j] |= neighbours
            graph[j] -= {j, k}
            if not waiting[j]:
                heapq.heappush(heap, (len(graph[j]), j))
        graph[k] = set()
        for j in holders.get(k, ()):
            waiting[j].discard(k)
            if not waiting[j] and j not in done:
                heapq.heappush(heap, (len(graph[j]), j))
    return order
