"""A part with two tables over one stroke, force and energy, has one row in `events.csv` for each corner it passes."""

import math
from pathlib import Path

import pytest

import fairlead
from fairlead.cases import Cases
from fairlead.results import Result

SPRING = Path(__file__).parents[2] / "models" / "single_parts" / "table_spring.yaml"


def passages(stop: float) -> list[float]:
    """From 0.18 m: 300 N/m beyond the knee at 0.1 m and 10 N, 100 N/m within; the mass is 1 kg."""
    outer, inner = math.sqrt(300.0), 10.0
    reach = 0.18 - (0.1 - 10.0 / 300.0)
    beyond = math.acos((10.0 / 300.0) / reach) / outer
    speed = reach * outer * math.sin(beyond * outer)
    within = 2 * math.asin(0.1 / math.hypot(0.1, speed / inner)) / inner
    found, t = [], beyond
    while t < stop:
        found += [t, t + within]
        t += within + 2 * beyond
    return [one for one in found if one < stop]


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_a_spring_over_points_has_one_row_for_each_corner(engine: str, tmp_path: Path) -> None:
    model = fairlead.load(SPRING, set={"run.engine": engine, "run.accuracy": "1e-7"})
    result = Result.open(model.run(out=tmp_path / "run").folder)
    rows = [one for one in result.events if one.t > 0]
    assert [one.t for one in rows] == pytest.approx(passages(2.0), abs=1e-5)
    assert all(one.zone_from != one.zone_to for one in result.events)
    assert {one.zone_from.split()[0] for one in result.events} == {"points"}
    assert result.run["switches"] == len(result.events)
    assert len(result.events) - len(rows) <= 3  # at the start it goes through the pieces to that of 0.18 m
    assert Cases(model, {"n": "switches(spring)"}).row({}).figures["n"] == len(result.events)


def test_a_run_that_is_stepped_tells_the_same_changes() -> None:
    run, told = fairlead.load(SPRING, set={"run.accuracy": "1e-7"}).start(), []
    for k in range(1, 20):
        run.advance(0.1 * k)
        told += [one.t for one in run.changes if one.t > 0]
    assert told == pytest.approx(passages(run.t), abs=1e-5)
