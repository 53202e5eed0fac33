"""The hard cases, but for those that tests/hard/known.py leaves to `make hard`, which plays all.

A row that is known to fail must fail: one that comes through has to leave the list.
"""

from __future__ import annotations

import pytest

from tests.hard.attempt import attempt
from tests.hard.known import known_failure, left_out
from tests.hard.registry import Row, rows

PATIENCE = 40.0
"""Times the budget of a row, which is for the machine of docs/stability.md, and alone: here it ends what hangs."""


def parameter(row: Row):
    reason = known_failure(row.case.name, row.engine, row.treatment)
    marks = [pytest.mark.xfail(strict=True, reason=reason)] if reason else []
    return pytest.param(row, id=row.name.replace(" ", "_"), marks=marks)


@pytest.mark.parametrize("row", [parameter(row) for row in rows() if not left_out(row)])
def test_hard_case(row: Row) -> None:
    done = attempt(row, PATIENCE)
    assert done.verdict == "ok", f"{done.verdict}: {done.reason}"
