"""Matrices as a user writes them: [[0, 1], [-4, -0.5]], a row [1, 0], or a number for one by one."""

from __future__ import annotations

from typing import Any

from fairlead.component.tables import TableError, si_at

MOST_ROWS = 50
FORM = "Write a list of rows, such as [[0, 1], [-4, -0.5]]; a list is one row, a number one by one."


def read_matrix(value: Any) -> tuple[tuple[float, ...], ...]:
    """Rows of numbers in SI, all of one length. Raises TableError with what is wrong, and where."""
    if not isinstance(value, list | tuple):
        return ((si_at(value, "1"),),)
    rows = value if any(isinstance(row, list | tuple) for row in value) else [value]
    if not rows or not all(isinstance(row, list | tuple) and row for row in rows):
        raise TableError("this is not a matrix", FORM)
    if max(len(rows), *map(len, rows)) > MOST_ROWS:
        raise TableError(f"a matrix has at most {MOST_ROWS} rows and columns")
    for k, row in enumerate(rows):
        if len(row) != len(rows[0]):
            raise TableError(f" has {len(row)} numbers, and the first row {len(rows[0])}", FORM, (k,))
    inside = rows is value
    return tuple(
        tuple(si_at(one, "1", *((k, j) if inside else (j,))) for j, one in enumerate(row)) for k, row in enumerate(rows)
    )


def matrix_schema() -> dict[str, Any]:
    """JSON Schema of a matrix."""
    number = {"type": ["number", "string"]}
    row = {"type": "array", "items": number, "minItems": 1}
    return {"anyOf": [number, row, {"type": "array", "items": row, "minItems": 1}]}
