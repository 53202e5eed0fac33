"""A rope inside a hose: the rope carries tension and cannot push (physics section 8, item 15)."""

import numpy as np
import pytest

SIDE_BY_SIDE = """
    parameters: {pull: 100 N, swing: 0 N}
    components:
      anchor: {type: Ground}
      hose: {type: Hose, axial_stiffness: 8 kN, length: 0.25 m, damping: 60 N*s/m}
      core: {type: Core, axial_stiffness: 500 kN, length: 0.25 m, damping: 60 N*s/m}
      connector: {type: Mass, mass: 1 kg, position: 0.25 m}
      pull:
        type: ForceSource
        force: {ramp: {to: "{pull}", over: 0.1 s}, sine: {amplitude: "{swing}", frequency: 3 Hz}}
    connections:
      - [anchor.flange, hose.a, core.a]
      - [connector.flange, hose.b, core.b, pull.flange]
    run: {stop: 3 s, accuracy: 1e-8}
"""


@pytest.mark.parametrize("push", [1.0, 100.0])
def test_a_push_is_all_in_the_hose(simulate, push: float) -> None:
    result = simulate(SIDE_BY_SIDE, pull=f"{-push} N")
    # It starts exactly at its length, on the border; from the first push on it is slack, and its tension not small
    # but zero.
    slack = result["core.slack"] == 1
    assert result.t[slack][0] < 1e-3
    assert np.all(result["core.tension"][result.t > result.events[0].t] == 0.0)
    assert slack.sum() >= len(slack) - 3
    # The hose takes all of it; the swing of the connector has died out at (c/2m) 3 s = 90 time constants.
    assert result["hose.tension"][-1] == pytest.approx(-push, rel=1e-9)


def test_a_pull_is_shared_by_stiffness(simulate) -> None:
    result = simulate(SIDE_BY_SIDE, pull="100 N")
    assert result["core.tension"][-1] == pytest.approx(100 * 500 / 508, rel=1e-9)
    assert result["hose.tension"][-1] == pytest.approx(100 * 8 / 508, rel=1e-9)


def test_shaken_to_and_fro_the_core_never_pushes(simulate) -> None:
    result = simulate(SIDE_BY_SIDE, pull="0 N", swing="100 N")
    slack = result["core.slack"] == 1
    assert {e.zone_to for e in result.events} == {"taut", "closing", "loose"}
    assert result.run["energy"]["closure"] < 1e-7  # what is left of the stretch when it closes goes to the damping
    assert result["core.tension"].min() >= -1e-7  # the guard's rounding, at the switch itself
    assert np.all(result["core.tension"][slack] == 0.0)
    assert slack.any()
    assert not slack.all()


def test_slack_in_a_cable_is_taken_up_before_it_pulls(simulate) -> None:
    """A tether 10 mm too long: its end flies 10 mm free of force, then feels the spring."""
    result = simulate("""
        components:
          anchor: {type: Ground}
          line: {type: Tether, stiffness: 1e4 N/m, length: 10 mm}
          bob: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0.1 m/s}
        connections: [[anchor.flange, line.a], [bob.flange, line.b]]
        run: {stop: 1 s, accuracy: 1e-9}
    """)
    taut, slack = result.events[0].t, result.events[1].t
    assert taut == pytest.approx(0.1, rel=1e-9)  # 10 mm at 0.1 m/s
    assert slack - taut == pytest.approx(np.pi / 100, rel=1e-7)  # half a swing of w = sqrt(k/m) = 100 rad/s
    assert result["bob.v"][-1] == pytest.approx(-0.1, rel=1e-7)
