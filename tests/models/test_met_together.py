"""Stops that take one blow together are told, where one after the other they would end elsewhere.

What an impulse joins gives it back together (Moreau). With dV the change of speed that brings all stops of the blow to
rest, v+ = v + (1 + e) dV. Balls with gaps pass it on one by one: u = (m v + M w)/(m + M) is the speed that two have in
common, and each leaves with (1 + e) u - e v.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from types import SimpleNamespace

import numpy as np
import pytest

from fairlead.analysis.record.met_together import met_together
from tests.conftest import Scene

ENGINES = pytest.mark.parametrize("engine", ["rodas", "ida"])
MASSES = [(1.0, 1.0, 1.0), (1.0, 0.3, 2.0), (2.0, 1.0, 0.5, 1.5, 0.7)]


def row(masses: Sequence[float], speeds: Sequence[float], gaps: Sequence[float], e: float, stop: float) -> str:
    """Balls in a row with gaps between them."""
    places = np.concatenate([[0.0], np.cumsum(gaps)]).tolist()
    balls = [f"  b{k}: {{type: Mass, mass: {m!r} kg, position: {x!r} m, velocity: {v!r} m/s}}"
             for k, (m, v, x) in enumerate(zip(masses, speeds, places, strict=True))]  # fmt: skip
    stops = [f"  s{k}: {{type: RigidStop, restitution: {e!r}}}" for k in range(len(gaps))]
    joins = [f"  - [b{k}.flange, s{k}.a]\n  - [s{k}.b, b{k + 1}.flange]" for k in range(len(gaps))]
    run = f"run: {{stop: {stop} s, accuracy: 1e-5}}"
    return "\n".join(["components:", *balls, *stops, "connections:", *joins, run])


def one_by_one(masses: Sequence[float], speeds: Sequence[float], e: float, pairs: Sequence[int]) -> list[float]:
    """Speeds after meetings of ball k with ball k + 1, in this order."""
    v = list(speeds)
    for k in pairs:
        common = (masses[k] * v[k] + masses[k + 1] * v[k + 1]) / (masses[k] + masses[k + 1])
        v[k], v[k + 1] = (1 + e) * common - e * v[k], (1 + e) * common - e * v[k + 1]
    return v


def all_at_once(masses: Sequence[float], speeds: Sequence[float], e: float) -> list[float]:
    """Speeds after a blow that all take together."""
    common = np.dot(masses, speeds) / np.sum(masses)
    return [float((1 + e) * common - e * v) for v in speeds]


def told(result) -> list[str]:
    """What the run remarks of blows."""
    return [said for said in result.run["remarks"] if "took a blow together" in said]


def ends(result) -> list[float]:
    """The last speeds."""
    return [float(result[f"b{k}.v"][-1]) for k in itertools.takewhile(lambda k: f"b{k}.v" in result, itertools.count())]


@ENGINES
@pytest.mark.parametrize("e", [0.4, 1.0])
@pytest.mark.parametrize("masses", MASSES)
def test_a_row_of_balls_that_touch_takes_a_blow_together_and_says_so(
    simulate: Scene, engine: str, masses: tuple[float, ...], e: float
) -> None:
    speeds, gaps = [1.0] + [0.0] * (len(masses) - 1), [0.05] + [0.0] * (len(masses) - 2)
    result = simulate(row(masses, speeds, gaps, e, 0.06), **{"run.engine": engine})
    at_rest_but_one = all_at_once(masses, speeds, e)
    common = np.dot(masses, speeds) / np.sum(masses)
    assert ends(result)[0] == pytest.approx(at_rest_but_one[0], abs=1e-9)
    assert ends(result)[1:] == pytest.approx([(1 + e) * common] * (len(masses) - 1), abs=1e-9)
    apart = one_by_one(masses, speeds, e, range(len(masses) - 1))
    assert np.abs(np.subtract(apart, ends(result))).max() > 0.05
    (said,) = told(result)
    assert said.startswith("t = 0.05 s: ")
    found = result.run["met_together"]
    assert {one["stop"] for one in found["first"]} == {f"s{k}" for k in range(len(gaps))}
    assert all(one["t"] == pytest.approx(0.05) and one["times"] == 1 for one in found["first"])


@ENGINES
@pytest.mark.parametrize("e", [0.4, 1.0])
@pytest.mark.parametrize("masses", MASSES)
def test_one_with_gaps_passes_it_on_and_says_nothing(
    simulate: Scene, engine: str, masses: tuple[float, ...], e: float
) -> None:
    n = len(masses)
    speeds, gaps, t = [1.0] + [0.0] * (n - 1), [0.05] + [1e-3] * (n - 2), 0.0
    v = list(speeds)
    for k, gap in enumerate(gaps):
        t += gap / v[k]
        v = one_by_one(masses, v, e, [k])
    result = simulate(row(masses, speeds, gaps, e, t + 1e-5), **{"run.engine": engine})
    met = [event for event in result.events if event.zone_to == "touching"]
    if [event.component for event in met] == [f"s{k}" for k in range(n - 1)]:
        assert ends(result) == pytest.approx(v, abs=1e-9)
    assert not told(result)
    assert result.run["met_together"] == {"count": 0, "first": []}


@ENGINES
@pytest.mark.parametrize("e", [0.3, 0.8])
def test_balls_that_come_from_both_sides_at_once_are_told_and_in_either_order_end_elsewhere(
    simulate: Scene, engine: str, e: float
) -> None:
    masses, speeds = (1.0, 2.0, 1.0), [1.0, 0.0, -1.0]
    result = simulate(row(masses, speeds, [0.25, 0.25], e, 0.2501), **{"run.engine": engine})
    assert ends(result) == pytest.approx([-e, 0.0, e], abs=1e-9)
    for order in ([0, 1], [1, 0]):
        assert np.abs(np.subtract(one_by_one(masses, speeds, e, order), ends(result))).max() > 0.05
    assert len(told(result)) == 1
    apart = simulate(row(masses, speeds, [0.25, 0.2505], e, 0.2504), **{"run.engine": engine})
    assert ends(apart) == pytest.approx(one_by_one(masses, speeds, e, [0, 1]), abs=1e-9)
    assert not told(apart)


@ENGINES
def test_a_ball_between_two_walls_and_two_stops_between_the_same_bodies_have_no_order(
    simulate: Scene, engine: str
) -> None:
    text = """
    components:
      wall: {type: Ground}
      ball: {type: Mass, mass: 1 kg, position: 0.1 m, velocity: 1 m/s}
      left: {type: RigidStop, restitution: 0.9}
      also: {type: RigidStop, restitution: 0.9}
      right: {type: RigidStop, length: -0.2 m, restitution: 0.9}
    connections:
      - [wall.flange, left.a]
      - [left.b, ball.flange]
      - [wall.flange, also.a]
      - [also.b, ball.flange]
      - [ball.flange, right.a]
      - [right.b, wall.flange]
    run: {stop: 1 s}
    """
    result = simulate(text, **{"run.engine": engine})
    assert sum(event.component == "left" and event.zone_to == "touching" for event in result.events) == 2
    assert result["ball.v"][-1] == pytest.approx(0.9**4, abs=1e-6)
    assert not told(result)


@ENGINES
@pytest.mark.parametrize(("accuracy", "together"), [(1e-4, True), (1e-6, False)])
def test_a_rebound_too_slow_to_count_leaves_a_row_that_takes_the_next_blow_together(
    simulate: Scene, engine: str, accuracy: float, together: bool
) -> None:
    """Two balls meet at 0.2 mm/s, a fifth of which they give back where that counts; then comes the third."""
    e, masses = 0.2, (1.0, 1.0, 1.0)
    text = row(masses, [1.0, 0.0, -2e-4], [1.0, 1e-4], e, 1.0005)
    result = simulate(text, **{"run.engine": engine, "run.accuracy": accuracy})
    met = one_by_one(masses, [1.0, 0.0, -2e-4], 0.0 if together else e, [1])
    if together:
        common = sum(met) / 3
        after = [(1 + e) * common - e * met[0], *[(1 + e) * common - e * v for v in met[1:]]]
        after[1] = after[2] = (sum(met) - after[0]) / 2
        assert ends(result) == pytest.approx(after, abs=1e-8)
    else:
        assert ends(result) == pytest.approx(one_by_one(masses, met, e, [0, 1, 0]), abs=1e-8)
    assert bool(told(result)) == together


@pytest.mark.parametrize(("first", "told_of"), [
    ([0.1, 0.1, 0.0, 0.5], ["one", "two", "late"]), ([0.1, 0.1, 0.1, 0.0], ["one", "two", "beside"]),
    ([0.0, 0.1, 0.1, 0.0], []), ([0.0, 0.1, 0.1, 0.5], ["late"]),
])  # fmt: skip
def test_a_stop_that_joins_one_which_was_told_before_is_told_too_and_two_between_the_same_bodies_are_not(
    first: list[float], told_of: list[str]
) -> None:
    """Stops by row: between bodies 0 and 1, 1 and 2, once more 1 and 2, and 2 and 3."""
    between, names = [(0, 1), (1, 2), (1, 2), (2, 3)], ["one", "two", "beside", "late"]
    entries = sorted((body, 4 + row) for row, pair in enumerate(between) for body in pair)
    starts = np.searchsorted([column for column, _ in entries], np.arange(9))
    system = SimpleNamespace(
        n=8, mass_pattern=SimpleNamespace(starts=starts, rows=np.array([row for _, row in entries])),
        numbering=SimpleNamespace(unknowns=[SimpleNamespace(name=f"{one}.force") for one in [*4 * [""], *names]]),
    )  # fmt: skip
    at = np.array([0.0] * 4 + first)
    found = met_together(system, np.where(at > 0.0, 1.0, 0.0), at)
    assert {one["stop"] for one in found["first"]} == set(told_of)
    assert found["count"] == len(told_of)
