"""Friction of a shaft given as torque over speed, against the closed forms of a rotor that it stops or holds."""

import numpy as np
import pytest

from fairlead.errors import ModelError

SCENE = """
components:
  housing: {{type: Housing}}
  rotor: {{type: Inertia, moment: 2 kg*m^2, speed: {speed}}}
  rubbing: {{type: ShaftFriction, {friction}}}
  motor: {{type: TorqueSource, torque: {torque}}}
connections: [[housing.shaft, rubbing.a], [rubbing.b, rotor.shaft, motor.shaft]]
run: {{stop: {stop}, accuracy: 1e-6}}
record: {{signals: [rotor.speed, rubbing.*]}}
"""


def scene_of(friction, speed="10 rad/s", torque="0", stop="6 s"):
    return SCENE.format(friction=friction, speed=speed, torque=torque, stop=stop)


@pytest.mark.parametrize("friction", ["sliding: 4 N*m", "points: [[0, 4 N*m], [100 rad/s, 4 N*m]]"])
@pytest.mark.parametrize("method", ["hold", "karnopp"])
def test_a_constant_torque_stops_a_rotor(simulate, friction, method):
    """2 kg m^2 at 10 rad/s against 4 N m: 5 s, at 2 rad/s^2."""
    result = simulate(scene_of(f"{friction}, method: {method}"))
    assert result.at("rotor.speed", 2.0) == pytest.approx(6.0, rel=1e-4)
    assert result.at("rubbing.slip", 2.0) == pytest.approx(6.0, rel=1e-4)
    assert result.at("rubbing.torque", 2.0) == pytest.approx(4.0, rel=1e-4)
    assert result.at("rotor.speed", 4.9) == pytest.approx(0.2, abs=1e-3)
    assert result["rotor.speed"][-1] == pytest.approx(0.0, abs=1e-6)


def test_a_rotor_at_rest_begins_at_the_breakaway_torque(simulate):
    """A torque of 1 N m/s reaches 5 N m after 5 s; then 3 N m rub."""
    ramp = "{ramp: {to: 10 N*m, over: 10 s}}"
    result = simulate(scene_of("sliding: 3 N*m, breakaway: 5 N*m", "0", ramp, "7 s"))
    begins = result.t[np.argmax(result["rotor.speed"] > 1e-6)]
    assert begins == pytest.approx(5.0, abs=0.05)
    assert result["rotor.speed"][-1] == pytest.approx((2 * 2 + 2**2 / 2) / 2, rel=1e-3)  # int of (5 + t - 3)/2 over 2 s


def test_torque_falls_over_the_speed_that_is_given_and_grows_with_viscous_friction(simulate):
    """3 + 2 exp(-(w/10)^2) + 0.5 w at w = 10 rad/s, kept by the motor to first order."""
    text = scene_of("sliding: 3 N*m, breakaway: 5 N*m, speed: 10 rad/s, viscous: 0.5 N*m*s/rad", stop="0.01 s")
    result = simulate(text)
    assert result["rubbing.torque"][0] == pytest.approx(3 + 2 * np.exp(-1) + 5, rel=1e-6)


@pytest.mark.parametrize(
    ("friction", "says"),
    [
        ("viscous: 1", "rubbing: give either sliding or points"),
        ("sliding: 4 N*m, breakaway: 3 N*m", "rubbing.breakaway: breakaway 3 N*m is below sliding = 4 N*m"),
        ("sliding: 4 N*m, speed: 1 rad/s", "rubbing.speed: speed is given without breakaway"),
        ("sliding: 4 N", "rubbing.sliding = 4 N is a force, not a torque"),
    ],
)
def test_what_contradicts_itself_is_refused(scene, friction, says):
    with pytest.raises(ModelError, match=says.replace("*", r"\*")):
        scene(scene_of(friction)).check()
