"""Where the entries of W live, and in which order its unknowns are eliminated: planned once for a problem.

Positions and quadratures are condensed out first (condensing.py). The rest, the reduced matrix, goes by minimum
degree on A + A', many independent unknowns a round, an algebraic unknown only after the differential
unknowns its row and column touch. That rule is what makes one order serve every zone and every h: the
diagonal of a multiplier vanishes while its contact holds, and only the elimination of the speeds it acts
on fills it in. One of its two speeds is enough for that; so a body that many contacts act on, the belt that drives
every node of a line, is not waited for: else it would join all of them with each other. Pivots stay on the diagonal
(where one vanishes for once, as under two contacts that hold the same body, replan.py chooses new ones). Fill is
computed exactly, by merging rows, so that the patterns of L and U hold for every zone.

Rounds of independent unknowns make the elimination tree of a chain as deep as the logarithm of its length
(Liu, ACM TOMS 11:141, 1985, who eliminates several unknowns at once to save time when ordering). A switch
then changes few columns of the factors, and columns of one round wait for nothing of each other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from fairlead.integrate.linear.condensing import (
    FROM_MASS,
    Entries,
    Layout,
    arrays_of,
    columns_of,
    lay_out,
    reduced_entries,
    starts_of,
    used_by,
)
from fairlead.integrate.problem import Integers, Pattern, Problem

DENSE_LIMIT = 12
"""Up to this many unknowns a full matrix with partial pivoting is as fast as any pattern."""
FULL_FASTER = 3.0
"""A sparse operation costs about this many of a full one: measured on a chain of 10 blocks (30 unknowns),
factorised in 4.7 microseconds full and in about 1 by its pattern."""
MANY = 8
"""Contacts on one body that make it one that others need not wait for."""
MORE_DEGREE = 1
"""A round takes unknowns of up to this much more than the least degree."""


@dataclass(frozen=True, eq=False)
class Plan:
    """Layout of `matrix` and, when sparse, the pivot order and the patterns of the factors."""

    dense: bool
    size: int
    """Length of `matrix`."""
    arrays: dict[str, Integers] = field(default_factory=dict)
    """Arrays of the plan by their name in memory/of_linear.py."""

    @property
    def lengths(self) -> dict[str, int]:
        """Sizes of the reduced matrix and of what follows from it, named as in of_linear.py; all zero when dense."""
        lengths = {"reduced": "row_order", "positions": "position", "quadrature_rows": "quadrature_row",
                   "quadrature_entries": "quadrature_entry", "entries": "entry_source"}  # fmt: skip
        return {f"n_{name}": len(self.arrays.get(array, ())) for name, array in lengths.items()}


def plan(problem: Problem) -> Plan:
    """The plan for a problem: full when it is small, else sparse in a good order."""
    n = len(problem.initial)
    if n <= DENSE_LIMIT:
        return dense_plan(problem)
    layout = lay_out(problem)
    entries = reduced_entries(problem, layout)
    order = elimination_order(problem, layout, entries)
    sparse = sparse_plan(problem, layout, entries, order, order)
    if FULL_FASTER * operations(sparse) > n**3 / 3 + n**2:
        return dense_plan(problem)
    return sparse


def operations(plan: Plan) -> int:
    """Multiplications of one sparse factorisation: each entry of U brings in one column of L."""
    length = np.diff(plan.arrays["lower_starts"])
    return int(length[plan.arrays["upper_rows"]].sum() + length.sum() + plan.size)


def dense_plan(problem: Problem) -> Plan:
    """A full matrix by columns."""
    n = len(problem.initial)
    pattern, mass_pattern = problem.pattern, problem.mass_pattern
    places = {
        "jacobian_place": columns_of(pattern) * n + pattern.rows,
        "mass_place": columns_of(mass_pattern) * n + mass_pattern.rows,
    }
    return Plan(dense=True, size=n * n, arrays=places)


def sparse_plan(
    problem: Problem, layout: Layout, entries: Entries, row_order: Integers, column_order: Integers
) -> Plan:
    """Core columns and rows in the given pivot orders (position k: which unknown), with the fill they cause."""
    n, reduced = len(problem.initial), len(row_order)
    rows, columns = inverse(row_order, n)[entries.row], inverse(column_order, n)[entries.column]
    sorting = np.lexsort((rows, columns))
    columns, kind, source = columns[sorting], entries.kind[sorting], entries.source[sorting]
    keys, place = np.unique(columns * reduced + rows[sorting], return_inverse=True)
    matrix_rows, matrix_columns = keys % reduced, keys // reduced
    lower, upper = fill(matrix_rows, matrix_columns, reduced)
    by_row = np.argsort(upper.rows, kind="stable")
    is_mass = kind == FROM_MASS
    column_of_jacobian = used_by(columns[~is_mass], source[~is_mass], len(problem.pattern.rows))
    followers = arrays_of(problem, layout)
    slopes, speeds = followers["position_slope"], inverse(column_order, n)[followers["position_speed"]]
    column_of_jacobian[slopes[slopes >= 0]] = speeds[slopes >= 0]
    return Plan(
        dense=False,
        size=len(keys),
        arrays=followers | {
            "row_order": row_order, "column_order": column_order,
            "matrix_starts": starts_of(matrix_columns, reduced), "matrix_rows": matrix_rows,
            "lower_starts": lower.starts, "lower_rows": lower.rows,
            "upper_starts": upper.starts, "upper_rows": upper.rows,
            "using_starts": starts_of(upper.rows, reduced), "using_columns": columns_of(upper)[by_row],
            "row_place": inverse(row_order, n)[:n],
            "entry_starts": starts_of(columns, reduced), "entry_source": source,
            "entry_place": place.astype(np.int64).reshape(-1), "entry_kind": kind,
            "jacobian_column": column_of_jacobian,
            "mass_column": used_by(columns[is_mass], source[is_mass], len(problem.mass_pattern.rows)),
        },
    )  # fmt: skip


def inverse(order: Integers, n: int) -> Integers:
    """The position of each of n unknowns in an order, -1 if it has none; the last answers for unknown -1."""
    position = np.full(n + 1, -1, dtype=np.int64)
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


def elimination_order(problem: Problem, layout: Layout, entries: Entries) -> Integers:
    """Order of the unknowns of the reduced matrix."""
    graph: dict[int, set[int]] = {k: set() for k in layout.reduced.tolist()}
    for i, j in zip(entries.row.tolist(), entries.column.tolist(), strict=True):
        if i != j:
            graph[i].add(j)
            graph[j].add(i)
    accelerations = set(problem.moves[:, 2].tolist()) - {-1}  # a multiplier acts on these where they are unknowns
    differential = set(np.flatnonzero(problem.differential).tolist())
    moving = differential | accelerations
    waits_for = {
        k: set() if k in differential else graph[k] & (differential if k in accelerations else moving) for k in graph
    }
    for k, row in dense_rows(problem).items():
        waits_for[k].discard(row)
    return np.array(minimum_degree(graph, waits_for), dtype=np.int64)


def dense_rows(problem: Problem) -> dict[int, int]:
    """Rows of contacts between a body and one that many contacts act on, each with the speed of the latter."""
    rows, columns = problem.mass_pattern.rows, columns_of(problem.mass_pattern)
    held = ~np.asarray(problem.differential, dtype=bool)[rows]
    contacts = np.bincount(columns[held], minlength=len(problem.initial))
    speeds: dict[int, list[int]] = {}
    for k, v in zip(rows[held].tolist(), columns[held].tolist(), strict=True):
        speeds.setdefault(k, []).append(v)
    busiest = {k: max(each, key=lambda v: contacts[v]) for k, each in speeds.items() if len(each) == 2}
    return {k: v for k, v in busiest.items() if contacts[v] > MANY and contacts[v] > 2 * contacts[speeds[k]].min()}


def minimum_degree(graph: dict[int, set[int]], waits_for: dict[int, set[int]]) -> list[int]:
    """Eliminate rounds of independent unknowns of least degree that need not wait for another.

    `graph` is symmetric and is consumed. Ties by number keep the order the same on every machine.
    """
    holders: dict[int, list[int]] = {}
    for k, others in waits_for.items():
        for j in others:
            holders.setdefault(j, []).append(k)
    waiting = {k: len(others) for k, others in waits_for.items()}
    free = Shelf()
    for k in graph:
        if waiting[k] == 0:
            free.put(k, len(graph[k]))
    order: list[int] = []
    while free:
        touched: set[int] = set()
        for k in free.least():
            if k in touched:
                continue
            free.take(k)
            order.append(k)
            touched |= eliminate(k, graph)
            for j in holders.get(k, ()):
                waiting[j] -= 1
        for j in touched & graph.keys():
            if waiting[j] == 0:
                free.put(j, len(graph[j]))
    return order


def eliminate(k: int, graph: dict[int, set[int]]) -> set[int]:
    """Take k out and join its neighbours with each other; who they are."""
    neighbours = graph.pop(k)
    for j in neighbours:
        graph[j] |= neighbours
        graph[j] -= {j, k}
    return neighbours


class Shelf:
    """Unknowns by their degree."""

    def __init__(self) -> None:
        self.degree: dict[int, int] = {}
        self.members: dict[int, set[int]] = {}

    def __bool__(self) -> bool:
        return bool(self.degree)

    def put(self, k: int, degree: int) -> None:
        """File k under its degree, wherever it was."""
        if k in self.degree:
            self.members[self.degree[k]].discard(k)
        self.degree[k] = degree
        self.members.setdefault(degree, set()).add(k)

    def take(self, k: int) -> None:
        """Remove k."""
        self.members[self.degree.pop(k)].discard(k)

    def least(self) -> list[int]:
        """Those of the least degree or little more, in order."""
        least = min(degree for degree, members in self.members.items() if members)
        degrees = range(least, least + MORE_DEGREE + 1)
        return [k for degree in degrees for k in sorted(self.members.get(degree, ()))]
