"""One block, one contact: stopping, resting on a slope, being carried, sliding on a hump.

The simplest answers of dry friction (physics section 8, items 5 to 8), asked of both ways to treat sticking.
"""

import numpy as np
import pytest

from tests.reference.carried import CarriedBlock
from tests.reference.hump import Hump
from tests.reference.incline import InclinedBlock
from tests.reference.stopping import StoppingBlock

GRAVITY, MASS = 9.81, 2.0  # m/s^2, kg
BOTH = pytest.mark.parametrize("method", ["hold", "binding"])

THROWN = """
    parameters: {method: hold}
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 2 kg, position: 0 m, velocity: 0.3 m/s}
      pad: {type: Contact, method: "{method}", normal_force: "{2*9.81} N", curve: 0.35}
    connections: [[ground.flange, pad.a], [pad.b, block.flange]]
    run: {stop: 1 s, accuracy: 1e-6}
"""

SLOPE = """
    parameters: {method: hold, angle: 0.3 rad}
    components:
      ground: {type: Ground}
      block: {type: Mass, mass: 2 kg, position: 0 m}
      weight: {type: ForceSource, force: "{2*9.81*sin(angle)} N"}
      pad:
        type: Contact
        method: "{method}"
        normal_force: "{2*9.81*cos(angle)} N"
        curve: {curve: coulomb, stiction: 0.40, coulomb: 0.35}
    connections: [[ground.flange, pad.a], [pad.b, block.flange, weight.flange]]
    run: {stop: 2 s, accuracy: 1e-6}
"""

CARRIED = """
    parameters: {method: hold}
    components:
      belt: {type: MotionSource, velocity: 0.3 m/s}
      block: {type: Mass, mass: 2 kg, position: 0 m, velocity: 0 m/s}
      pad: {type: Contact, method: "{method}", normal_force: "{2*9.81} N", curve: 0.35}
    connections: [[belt.flange, pad.a], [pad.b, block.flange]]
    run: {stop: 1 s, accuracy: 1e-6}
"""


@BOTH
def test_a_thrown_block_stops_where_it_must_and_stays(simulate, method: str) -> None:
    exact, result = StoppingBlock(speed=0.3, friction=0.35), simulate(THROWN, method=method)
    assert result["block.x"][-1] == pytest.approx(exact.stopping_distance, rel=1e-4)
    assert abs(result["block.v"][-1]) < 1e-9
    stop = next(e.t for e in result.events if e.zone_to in ("held", "ramp_forward") and e.t > 0)
    assert stop == pytest.approx(exact.stopping_time, rel=2e-3)  # binding catches it at v_n, 0.4 mm/s of 0.3 m/s


def test_held_exactly_it_stops_to_rounding(simulate) -> None:
    exact, result = StoppingBlock(speed=0.3, friction=0.35), simulate(THROWN)
    assert result["block.x"][-1] == pytest.approx(exact.stopping_distance, rel=1e-9)
    assert result.events[-1].t == pytest.approx(exact.stopping_time, rel=1e-9)
    assert result["pad.friction"][-1] == pytest.approx(0.0, abs=1e-9)  # nothing pulls, so nothing needs to hold


@BOTH
@pytest.mark.parametrize("nearly", [1e-3, 1e-6])
def test_a_block_holds_up_to_the_angle_of_friction(simulate, method: str, nearly: float) -> None:
    angle = float(np.arctan(0.40)) * (1 - nearly)
    assert InclinedBlock(angle).holds
    result = simulate(SLOPE, method=method, angle=f"{angle!r} rad")
    assert not [e for e in result.events if "slide" in e.zone_to or e.zone_to == "forward"]
    crept = {"hold": 1e-12, "binding": 1e-4 * 2.0}[method]  # m; binding creeps for 2 s, at most as fast as its creep
    assert abs(result["block.x"][-1]) <= crept


@BOTH
@pytest.mark.parametrize("nearly", [1e-3, 1e-6])
def test_a_block_slides_beyond_the_angle_of_friction(simulate, method: str, nearly: float) -> None:
    angle = float(np.arctan(0.40)) * (1 + nearly)
    exact, result = InclinedBlock(angle), simulate(SLOPE, method=method, angle=f"{angle!r} rad")
    assert not exact.holds
    np.testing.assert_allclose(result["block.x"], exact.position(result.t), rtol=1e-6, atol=1e-9)


def test_mass_does_not_decide_whether_a_block_holds(simulate) -> None:
    """Weight pulls and weight presses: only the angle counts."""
    for mass in (0.02, 2000.0):
        text = SLOPE.replace("2 kg", f"{mass} kg").replace("2*9.81", f"{mass}*9.81")
        for factor, zones in ((1 - 1e-3, 0), (1 + 1e-3, 1)):
            angle = float(np.arctan(0.40)) * factor
            assert len([e for e in simulate(text, angle=f"{angle!r} rad").events if e.t > 0]) <= zones
            result = simulate(text, angle=f"{angle!r} rad")
            assert (result["block.x"][-1] > 0.1) == bool(zones)


@BOTH
def test_a_block_put_on_a_belt_slides_and_then_rides_along(simulate, method: str) -> None:
    exact, result = CarriedBlock(belt=0.3, friction=0.35), simulate(CARRIED, method=method)
    caught = [e.t for e in result.events if e.zone_to in ("held", "ramp_backward")][-1]
    # Binding catches the block when it is within v_n = 0.4 mm/s of the belt, earlier by v_n/(mu g) = 0.12 ms.
    early = {"hold": 0.0, "binding": 4e-4 / (0.35 * GRAVITY)}[method]
    assert caught + early == pytest.approx(exact.capture_time, rel=1e-4)
    later = result.t > exact.capture_time + 0.01
    np.testing.assert_allclose(result["block.v"][later], 0.3, rtol=1e-4)
    np.testing.assert_allclose(result["block.x"][later], exact.position(result.t[later]), rtol=1e-4)


@BOTH
def test_a_belt_that_starts_with_a_jerk_slips_under_the_block(simulate, method: str) -> None:
    """Friction is finite: however the contact held before, the block gains speed at mu g and no faster."""
    text = CARRIED.replace("velocity: 0.3 m/s", "velocity: {step: {to: 0.3 m/s, at: 0.5 s}}")
    exact, result = CarriedBlock(belt=0.3, friction=0.35), simulate(text, method=method)
    assert result.at("block.v", 0.5, side="right") == pytest.approx(0.0, abs=1e-9)
    after = result.t > 0.5
    np.testing.assert_allclose(result["block.v"][after], exact.velocity(result.t[after] - 0.5), atol=1e-4 * 0.3)
    assert result["block.x"][-1] == pytest.approx(float(exact.position(0.5)), rel=1e-4)


def test_a_block_keeps_the_speed_it_is_given_at_the_start(simulate) -> None:
    """A contact tries to hold first; a block that is faster than the belt at the start must not be stopped by that."""
    result = simulate(THROWN)
    assert result["block.v"][0] == 0.3
    start = result.events[0]
    assert (start.t, start.zone_to, start.guard) == (0.0, "forward", "torn_forward")


def test_half_of_what_the_belt_gives_becomes_heat(simulate) -> None:
    exact, result = CarriedBlock(belt=0.3, friction=0.35), simulate(CARRIED)
    assert result.run["energy"]["dissipated"] == pytest.approx(exact.heat(MASS), rel=1e-6)
    assert result.run["energy"]["supplied"] == pytest.approx(2 * exact.heat(MASS), rel=1e-6)


# A hump whose peak is at 0.1 m/s: the curve rises up to it and falls beyond (physics section 8, item 5). The
# block starts where steady sliding would keep it, a little disturbed.
HUMP = Hump(at_rest=0.38, peak=0.42, peak_speed=0.10, at_speed=0.30)
NORMAL, FREQUENCY = 100.0, float(np.sqrt(1e3 / 1.0))  # N, rad/s
ON_A_HUMP = """
    parameters: {speed: 0.05 m/s, damping: 2 N*s/m, start: 0 m, disturbance: 1 mm/s, method: hold}
    components:
      wall: {type: Ground}
      spring: {type: SpringDamper, stiffness: 1e3 N/m, damping: "{damping}"}
      block: {type: Mass, mass: 1 kg, position: "{start}", velocity: "{disturbance}"}
      belt: {type: MotionSource, velocity: "{speed}"}
      pad:
        type: Contact
        method: "{method}"
        normal_force: 100 N
        curve: {curve: hump, stiction: 0.38, peak: 0.42, peak_velocity: 0.10 m/s, coulomb: 0.30}
    connections: [[wall.flange, spring.a], [spring.b, block.flange, pad.b], [belt.flange, pad.a]]
    run: {stop: 4 s, accuracy: 1e-8}
    record: {every: 1 ms}
"""


def steady_position(speed: float) -> float:
    """Where the spring balances friction [m]."""
    return NORMAL * float(HUMP.coefficient(speed)) / 1e3


def slide(simulate, speed: float, damping: float, **more):
    """A run from the disturbed steady state."""
    start = f"{steady_position(speed)!r} m"
    return simulate(ON_A_HUMP, speed=f"{speed} m/s", damping=f"{damping} N*s/m", start=start, **more)


@BOTH
@pytest.mark.parametrize("speed", [0.01, 0.05])
def test_on_the_rising_branch_sliding_is_steady(simulate, speed: float, method: str) -> None:
    assert HUMP.slides_steadily(speed, NORMAL, damping=2.0)
    result = slide(simulate, speed, 2.0, method=method)
    assert not [e for e in result.events if e.t > 0]  # it slides all the time
    # The disturbance decays at (c + N mu')/2m = 18 1/s or more at both speeds; nothing of it is left after 4 s.
    assert np.abs(result["block.v"][result.t > 3.0]).max() < 1e-7


@BOTH
def test_on_the_falling_branch_it_grows_into_stick_slip(simulate, method: str) -> None:
    assert not HUMP.slides_steadily(0.15, NORMAL, damping=2.0)
    result = slide(simulate, 0.15, 2.0, method=method)
    sticks = [e.t for e in result.events if e.zone_to in ("held", "ramp_backward") and e.t > 0]
    assert len(sticks) > 5
    later = np.array(sticks)[np.array(sticks) > 2.0]
    assert np.ptp(np.diff(later)) < 0.05 * np.diff(later).mean()  # a cycle that repeats


@pytest.mark.parametrize("share", [0.8, 1.2])
def test_damping_above_the_fall_of_the_curve_keeps_sliding_steady(simulate, share: float) -> None:
    """A small disturbance grows at the rate of the linearised motion, (N |mu'| - c)/2m."""
    fall = -NORMAL * float(HUMP.slope(0.15))
    result = slide(simulate, 0.15, share * fall, disturbance="1e-5 m/s", **{"run.stop": "0.8 s"})
    swing = np.hypot(result["block.v"], FREQUENCY * (result["block.x"] - steady_position(0.15)))
    measured = np.polyfit(result.t, np.log(swing), 1)[0]
    # The swing itself wobbles twice a cycle by c/w, a tenth; over four cycles the fit averages it to a percent.
    assert measured == pytest.approx((1 - share) * fall / 2.0, rel=0.03)
    assert HUMP.slides_steadily(0.15, NORMAL, share * fall) == (measured < 0)
