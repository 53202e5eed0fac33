"""A pendulum, a servo and a loaded gear train have the motions and levels that follow from their formulas."""

import math

import numpy as np
import pytest

import fairlead

G = 9.80665
SWING = """schema: 1
name: swing
components:
  bob: {type: Pendulum, mass: 0.49 kg, arm: 0.1 m, moment: 0.0015 kg*m^2, hanging: 0.2 rad, angle: 0.201 rad,
        speed: 0 rad/s}
  rotor: {type: Inertia, moment: 0.0005 kg*m^2}
connections: [[bob.shaft, rotor.shaft]]
run: {stop: 5 s, accuracy: 1e-8}
record: {every: 1 ms}
"""
HELD = """schema: 1
name: held
parameters: {motor_share: 0.3, load_share: 0.1, force: 0.05}
components:
  rotor: {type: Inertia, moment: 0.01 kg*m^2, angle: 0 rad, speed: 0 rad/s}
  motor: {type: TorqueActuator}
  load: {type: TorqueActuator}
  push: {type: SignalSource, value: {ramp: {to: 1, over: 10 s}}}
  pull: {type: SignalSource, value: "{-force}"}
  case: {type: Housing}
  gears: {type: LoadedFriction, dry: 0.02 N*m, by_motor: "{motor_share}", by_load: "{load_share}"}
connections:
  - [rotor.shaft, motor.shaft, load.shaft, gears.b]
  - [case.shaft, gears.a]
  - [push.signal, motor.torque, gears.motor]
  - [pull.signal, load.torque, gears.load]
run: {stop: 5 s, accuracy: 1e-6}
record: {every: 10 ms}
"""


def run(tmp_path, text, **values):
    (tmp_path / "scene.yaml").write_text(text)
    return fairlead.load(tmp_path / "scene.yaml", set=values).run(out=None)


def test_a_small_swing_has_its_period(tmp_path) -> None:
    result = run(tmp_path, SWING)
    w = math.sqrt(0.49 * G * 0.1 / (0.002 + 0.49 * 0.01))
    expected = 0.2 + 1e-3 * np.cos(w * result.t)
    assert result["bob.angle"] == pytest.approx(expected, abs=2e-8)  # the cube of the swing over 16 shifts the phase


@pytest.mark.parametrize(("motor_share", "load_share"), [(0.3, 0.1), (0.1, 0.3), (0.2, 0.0), (0.0, 0.0)])
def test_a_motor_breaks_away_where_torques_and_losses_balance(tmp_path, motor_share, load_share) -> None:
    """Against a load L it begins where m - L = dry + by_motor m + by_load L - round_off."""
    result = run(tmp_path, HELD, motor_share=motor_share, load_share=load_share)
    begins = next(one.t for one in result.events if one.zone_to == "forward")
    corner = 1e-4 if motor_share or load_share else 0
    expected = (0.02 + 0.05 + load_share * 0.05 - corner) / (1 - motor_share)
    assert begins / 10 == pytest.approx(expected, abs=2e-6)  # the accuracy, and the square of the corner


def test_a_servo_stalls_at_the_angle_of_its_stiffness(tmp_path) -> None:
    """Held at angle 0 with the goal g, the torque is K gain g U/R, and K U/R where that is above one."""
    text = """schema: 1
name: stalled
parameters: {goal: 0.5}
components:
  case: {type: Housing}
  drive: {type: PositionServo, goal: "{goal} rad", supply: 8 V, gain: 1.5 1/rad, resistance: 4 ohm, constant: 0.4 N*m/A}
connections:
  - [case.shaft, drive.shaft]
run: {stop: 0.1 s}
record: {every: 10 ms}
"""
    assert run(tmp_path, text, goal=0.5)["drive.torque"][-1] == pytest.approx(0.4 * 0.75 * 8 / 4)
    assert run(tmp_path, text, goal=-0.9)["drive.torque"][-1] == pytest.approx(-0.4 * 8 / 4)
