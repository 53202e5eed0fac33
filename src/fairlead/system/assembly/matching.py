"""A maximum matching of the columns of a matrix with its rows, by where entries are, and what it leaves over.

    rows_of[j]     the rows in which column j has an entry; an entry (j, j) is taken first

A column left over, with all that alternating paths lead to from it, is an underdetermined part: k columns that fewer
than k rows contain (Dulmage and Mendelsohn 1958).
"""

from __future__ import annotations


def unmatched(rows_of: list[set[int]]) -> list[set[int]]:
    """The underdetermined parts, disjoint; none where every column has a row of its own."""
    row_of = {column: column for column, rows in enumerate(rows_of) if column in rows}
    column_of = dict(row_of)
    parts: list[set[int]] = []
    for column in range(len(rows_of)):
        reached = set() if column in row_of else _augment(column, rows_of, row_of, column_of)
        if reached:
            joined = [part for part in parts if part & reached]
            parts = [part for part in parts if not part & reached] + [reached.union(*joined)]
    return parts


def _augment(column: int, rows_of: list[set[int]], row_of: dict[int, int], column_of: dict[int, int]) -> set[int]:
    """Match one more column along an alternating path (breadth first), or return the columns it could reach."""
    came_from: dict[int, int] = {}  # row -> the column it was reached from
    reached, queue = {column}, [column]
    for current in queue:
        for row in rows_of[current] - came_from.keys():
            came_from[row] = current
            if row not in column_of:
                _flip(row, column, came_from, row_of, column_of)
                return set()
            if column_of[row] not in reached:
                reached.add(column_of[row])
                queue.append(column_of[row])
    return reached


def _flip(row: int, column: int, came_from: dict[int, int], row_of: dict[int, int], column_of: dict[int, int]) -> None:
    """Give every column on the path back to `column` the row it was reached through."""
    while True:
        owner = came_from[row]
        before = row_of.get(owner)
        row_of[owner], column_of[row] = row, owner
        if owner == column or before is None:
            return
        row = before
