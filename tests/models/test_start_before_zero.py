"""When a run begins does not matter where nothing is given in time: also a run over t = 0 takes the same steps."""

from __future__ import annotations

import pytest

import fairlead

SPAN = 2.0


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_a_run_over_zero_takes_the_steps_of_one_from_zero(engine):
    belt = fairlead.load("belt")
    steps, switches = zip(*(_counted(belt, engine, start) for start in (0.0, -1.0, -SPAN, 3.0)))
    assert len(set(switches)) == 1
    assert switches[0] > 2
    assert max(steps) - min(steps) <= 1, steps  # another rounding of t


def _counted(model, engine: str, start: float) -> tuple[int, int]:
    result = model.run(out=None, start=start, stop=start + SPAN, engine=engine)
    return result.run["steps"], result.run["switches"]
