"""A sample of the hard cases: all cheap rows on the engines that matter most, of the others some, always the same.

`make hard` plays all of them and writes docs/stability.md.
"""

from __future__ import annotations

import random

import pytest

from tests.hard.attempt import attempt
from tests.hard.known import known_failure
from tests.hard.registry import Row, rows

SEED, SHARE = 6, {"fair": 0.1, "slow": 0.0}


def sample() -> list[Row]:
    """Cheap rows all, of the others a share by a fixed seed."""
    draw = random.Random(SEED)
    return [row for row in rows() if draw.random() < SHARE.get(row.case.cost, 1.0)]


def parameter(row: Row):
    reason = known_failure(row.case.name, row.engine, row.treatment)
    marks = [pytest.mark.xfail(strict=True, reason=reason)] if reason else []
    return pytest.param(row, id=row.name.replace(" ", "_"), marks=marks)


@pytest.mark.parametrize("row", [parameter(row) for row in sample()])
def test_hard_case(row: Row) -> None:
    done = attempt(row)
    assert done.verdict == "ok", f"{done.verdict}: {done.reason}"
