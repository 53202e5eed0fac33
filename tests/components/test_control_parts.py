"""Parts that every loop needs, against closed forms: forces by signal, given speeds, sums, PI and PID."""

import numpy as np
import pytest

POSITION = """
components:
  wanted: {{type: SignalSource, value: 1}}
  control: {{type: Pid, gain: 100, derivative_time: 0.2 s, filter_time: 0.1 ms, period: {period}}}
  drive: {{type: ForceActuator}}
  block: {{type: Mass, mass: 1 kg}}
  eye: {{type: MotionSensor}}
connections:
  - [drive.flange, block.flange, eye.flange]
  - [wanted.signal, control.reference]
  - [eye.x, control.measured]
  - [control.command, drive.force]
effects: {{sampling: "{sampling}"}}
run: {{stop: 0.6 s, accuracy: 1e-6}}
record: {{signals: [block.x], every: 10 ms}}
"""


@pytest.mark.parametrize(("sampling", "period", "within"), [("off", "1 ms", 2e-3), ("on", "0.5 ms", 2e-2)])
def test_a_pd_controller_moves_a_mass_as_a_critically_damped_spring(simulate, sampling, period, within):
    """x'' = 100 (1 - x) - 20 x':  x = 1 - (1 + 10 t) exp(-10 t), but for the filter and the samples."""
    result = simulate(POSITION.format(period=period, sampling=sampling))
    exact = 1 - (1 + 10 * result.t) * np.exp(-10 * result.t)
    assert result["block.x"] == pytest.approx(exact, abs=within)


SPEED = """
components:
  wanted: {type: SignalSource, value: 1}
  control: {type: PiController, gain: 2, integral_time: 1 s, low: -10, high: 10}
  drive: {type: TorqueActuator}
  rotor: {type: Inertia, moment: 1 kg*m^2}
connections:
  - [drive.shaft, rotor.shaft]
  - [wanted.signal, control.reference]
  - [rotor.speed, control.measured]
  - [control.command, drive.torque]
effects: {sampling: off}
run: {stop: 4 s, accuracy: 1e-7}
record: {signals: [rotor.speed, control.command], every: 50 ms}
"""


def test_a_pi_controller_without_sampling_is_ideal(simulate):
    """w' = 2 (1 - w) + 2 int (1 - w):  w = 1 - exp(-t) (cos t - sin t), and the command is 2 from the first instant."""
    result = simulate(SPEED)
    exact = 1 - np.exp(-result.t) * (np.cos(result.t) - np.sin(result.t))
    assert result["rotor.speed"] == pytest.approx(exact, abs=1e-5)
    assert result["control.command"][0] == pytest.approx(2.0)


@pytest.mark.parametrize("sampling", ["off", "on"])
def test_a_pi_controller_has_no_limits_that_nobody_gave(simulate, sampling):
    """What cannot be moved leaves the error at 5: the command is 2*5 + 2*5 t, and 1 at most where that is told."""
    text = SPEED.replace("1 kg*m^2", "1e9 kg*m^2").replace("value: 1}", "value: 5}")
    text = text.replace("sampling: off", f"sampling: {sampling}")
    free = simulate(text.replace(", low: -10, high: 10", ""))
    assert free.at("control.command", 2.0) == pytest.approx(30, abs=0.11)  # a sample of 10 ms late
    assert simulate(text.replace("low: -10, high: 10", "high: 1")).at("control.command", 2.0) == pytest.approx(1)


def test_a_smoothed_command_lags_behind_as_it_says(simulate):
    """The command follows with smoothing T: after T, 1 - 1/e of the way where nothing else moves."""
    text = SPEED.replace("high: 10}", "high: 10, smoothing: 0.1 s}").replace("1 kg*m^2", "1e6 kg*m^2")
    text = text.replace("integral_time: 1 s", "integral_time: 1e6 s")
    result = simulate(text)
    assert result.at("control.command", 0.1) == pytest.approx(2 * (1 - np.exp(-1)), rel=1e-3)


def test_a_shaft_of_given_speed_tells_the_torque_that_takes(simulate):
    """0 to 3 rad/s in 1 s with 2 kg m^2: 6 N m, and 1.5 rad."""
    result = simulate("""
components:
  source: {type: SpeedSource, speed: {ramp: {to: 3 rad/s, over: 1 s}}}
  rotor: {type: Inertia, moment: 2 kg*m^2}
connections: [[source.shaft, rotor.shaft]]
run: {stop: 2 s}
record: {signals: [source.*, rotor.angle], every: 100 ms}
""")
    assert result.at("source.torque", 0.55) == pytest.approx(6.0)
    assert result.at("source.torque", 1.55) == pytest.approx(0.0, abs=1e-9)
    assert result.at("source.angle", 1.0) == pytest.approx(1.5)
    assert result.at("rotor.angle", 2.0) == pytest.approx(4.5)


def test_a_sum_adds_what_is_connected(simulate):
    result = simulate("""
components:
  one: {type: SignalSource, value: 3}
  two: {type: SignalSource, value: {ramp: {to: 2, over: 1 s}}}
  both: {type: Sum, gain_b: -2, offset: 0.5}
  block: {type: Mass, mass: 1 kg}
  drive: {type: ForceActuator}
connections: [[one.signal, both.a], [two.signal, both.b], [both.signal, drive.force], [drive.flange, block.flange]]
run: {stop: 2 s}
record: {signals: [both.signal, block.v], every: 100 ms}
""")
    assert result.at("both.signal", 0.5) == pytest.approx(3 - 2 * 1.0 + 0.5)
    assert result.at("both.signal", 2.0) == pytest.approx(-0.5)


def test_a_limited_command_winds_nothing_up(simulate):
    """A mass that is out of reach for 2 s keeps the integral where the limit is: it turns within a tracking time."""
    limits = "low: -0.1, high: 0.1, tracking_time: 0.1 s"
    text = SPEED.replace("PiController", "Pid").replace("low: -10, high: 10", limits)
    text = text.replace("value: 1}", "value: {step: {from: 1, to: -1, at: 2 s}}}")
    result = simulate(text)
    assert result.at("control.command", 1.9) == pytest.approx(0.1)
    assert result.at("control.command", 2.2) == pytest.approx(-0.1)
