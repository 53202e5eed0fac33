"""A blow is the same late in a run, where a time is known to 1e-10 s and a place in motion to 1e-9 m."""

from __future__ import annotations

import pytest

from tests.conftest import Scene

DROPPED = """
    components:
      floor: {{type: Ground}}
      ball: {{type: Mass, mass: 1 kg, position: 1 m}}
      weight: {{type: ForceSource, force: {{step: {{to: -9.81 N, at: "{at} s"}}}}}}
      lift: {{type: ForceSource, force: {{step: {{to: 19.62 N, at: "{after} s"}}}}}}
      stop: {{type: RigidStop, restitution: 0.8}}
    connections: [[floor.flange, stop.a], [ball.flange, stop.b, weight.flange, lift.flange]]
    run: {{start: {at} s, stop: {end} s, engine: {engine}, accuracy: 1e-5}}
"""


@pytest.mark.filterwarnings("ignore")  # the last bounces come faster than the dwell
@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize("at", [10.0, 3e5, 1e6])
def test_a_ball_bounces_comes_to_rest_and_is_lifted_whenever_it_is_dropped(
    simulate: Scene, engine: str, at: float
) -> None:
    """The first bounce is 0.64 m high; lifted with g it is 4.905 m up after a second."""
    result = simulate(DROPPED.format(at=at, after=at + 8, end=at + 9, engine=engine))
    fall = (2 / 9.81) ** 0.5
    assert result.at("ball.x", at + fall * 1.8) == pytest.approx(0.64, abs=1e-6)
    assert result.at("ball.x", at + 7.9) == pytest.approx(0.0, abs=1e-8)
    assert result["ball.x"][-1] == pytest.approx(4.905, abs=1e-4)
