"""What is narrow beside a step is not stepped over: conditions that hold together for a moment, peaks of a formula.

Each condition is wide and each formula smooth, but what they make is over within a small part of a step that nothing
else shortens. Oracles are closed forms.
"""

from __future__ import annotations

from collections.abc import Callable
from math import cos, erf, exp, log, pi, sin, sqrt

import pytest
from scipy.integrate import quad
from scipy.optimize import brentq

EVERY = pytest.mark.parametrize(
    ("engine", "accuracy"), [("rodas", 1e-3), ("rodas", 1e-7), ("stepping", 1e-4), ("ida", 1e-3), ("ida", 1e-6)]
)
WIDTH = 0.01

GATE = """
components:
  a: {{type: SignalSource, value: {a}}}
  b: {{type: SignalSource, value: {b}}}
  gate: {{type: LogicGate, gate: {gate}, level: 0.5}}
  meter: {{type: Integrator}}
connections: [[a.signal, gate.a], [b.signal, gate.b], [gate.{told}, meter.value]]
run: {{stop: 10 s}}
"""
RAMP = "{{constant: {at_0}, drift: {{rate: {rate} 1/s}}}}"
UP, DOWN = RAMP.format(at_0=0, rate=0.1), RAMP.format(at_0=1, rate=-0.1)
UP_LATER, DOWN_LATER = RAMP.format(at_0=-0.1 * WIDTH, rate=0.1), RAMP.format(at_0=1 + 0.1 * WIDTH, rate=-0.1)
BARRIERS = ["x > 5 and x < 5.02", "v > 1 and x < 5.02 and x > 5", "x > 99 or x > 5 and x < 5.02"]


@EVERY
@pytest.mark.parametrize(
    ("gate", "a", "b", "told"),
    [("and", UP, DOWN_LATER, "signal"), ("and", DOWN_LATER, UP, "signal"), ("xor", UP, UP_LATER, "signal"),
     ("or", DOWN, UP_LATER, "inverse")],
)  # fmt: skip
def test_a_gate_sees_signals_that_are_on_together_for_a_moment(simulate, gate, a, b, told, engine, accuracy):
    """One crosses its level after 5 s, the other 10 ms later."""
    result = simulate(GATE.format(gate=gate, a=a, b=b, told=told), **{"run.engine": engine, "run.accuracy": accuracy})
    assert result.at("meter.signal", 10.0) == pytest.approx(WIDTH, rel=1e-6)


BARRIER = """
components:
  car: {{type: Mass, mass: 1 kg, velocity: 2 m/s}}
  seen: {{type: MotionSensor}}
  machine:
    type: StateMachine
    states: {{free: {{pull: 0}}, brake: {{pull: -20}}}}
    transitions: {{free: {{brake: "{brake}"}}, brake: {{free: "v < 0.5"}}}}
  force: {{type: ForceActuator}}
connections:
  - [car.flange, seen.flange, force.flange]
  - [seen.x, machine.x]
  - [seen.v, machine.v]
  - [machine.pull, force.force]
run: {{stop: 10 s}}
"""


@EVERY
@pytest.mark.parametrize("brake", BARRIERS)
def test_a_state_machine_sees_conditions_that_hold_together_for_a_moment(simulate, brake, engine, accuracy):
    """The car is braked from 2 m/s to 0.5 m/s where it passes the barrier."""
    result = simulate(BARRIER.format(brake=brake), **{"run.engine": engine, "run.accuracy": accuracy})
    assert result.at("car.v", 10.0) == pytest.approx(0.5, abs=1e-5)


HILL = """
components:
  car: {{type: Mass, mass: 1 kg, velocity: 1 m/s}}
  seen: {{type: MotionSensor}}
  hill: {{type: SignalFunction, expression: "{force}"}}
  force: {{type: ForceActuator}}
connections:
  - [car.flange, seen.flange, force.flange]
  - [seen.x, hill.x]
  - [hill.signal, force.force]
run: {{stop: 10 s}}
"""
PEAKS = {
    "5*exp(-((x-5)/0.05)**2)": 5 * 0.05 * sqrt(pi),
    "3/(1 + ((x-5)/0.02)**2)**2": 3 * 0.02 * pi / 2,
    "2*(1/(1 + exp((4-x)/0.01)) - 1/(1 + exp((4.1-x)/0.01)))": 2 * 0.1,
    "4*exp(-(x-5)*(x-5)/0.0025)": 4 * 0.05 * sqrt(pi),
}
"""A force over the place, and its integral."""


@EVERY
@pytest.mark.parametrize("force", PEAKS)
def test_a_mass_feels_a_force_that_it_runs_over_quickly(simulate, force, engine, accuracy):
    """m v^2/2 grows by the integral of the force."""
    result = simulate(HILL.format(force=force), **{"run.engine": engine, "run.accuracy": accuracy})
    assert result.at("car.v", 10.0) == pytest.approx(sqrt(1 + 2 * PEAKS[force]), rel=max(20 * accuracy, 1e-5))


@EVERY
def test_a_mass_is_thrown_back_by_a_hill_that_is_too_high(simulate, engine, accuracy):
    """It comes to rest within the hill and leaves it as fast as it came."""
    text = HILL.format(force="-20*exp(-((x-5)/0.05)**2)")
    result = simulate(text, **{"run.engine": engine, "run.accuracy": accuracy})
    assert result.at("car.v", 10.0) == pytest.approx(-1.0, rel=max(20 * accuracy, 1e-5))


LOCKS = """
components:
  rotor: {{type: Inertia, moment: 1 kg*m^2, speed: 1 rad/s}}
  seen: {{type: RotationSensor}}
  locks: {{type: SignalFunction, expression: "{torque}"}}
  motor: {{type: TorqueActuator}}
connections:
  - [rotor.shaft, seen.shaft, motor.shaft]
  - [seen.angle, locks.x]
  - [locks.signal, motor.torque]
run: {{stop: 10 s}}
"""
TEETH: dict[str, Callable[[float], float]] = {
    "-20*exp(-((sin(x/2-1)/0.02)**2))": lambda x: 20 * exp(-((sin(x / 2 - 1) / 0.02) ** 2)),
    "-20*exp((cos(x-2)-1)/0.0008)": lambda x: 20 * exp((cos(x - 2) - 1) / 0.0008),
    "-20/(1+(sin(x/2-1)/0.02)**4)": lambda x: 20 / (1 + (sin(x / 2 - 1) / 0.02) ** 4),
}
"""A torque that resists near 2 rad and every turn from there, by its formula and in Python."""


@EVERY
@pytest.mark.parametrize("torque", TEETH)
def test_a_shaft_is_thrown_back_by_one_tooth_and_on_by_the_next(simulate, torque, engine, accuracy):
    """It turns back from the tooth at 2 rad, and passes that at 2 rad - 2 pi in the direction of the torque."""
    result = simulate(LOCKS.format(torque=torque), **{"run.engine": engine, "run.accuracy": accuracy})
    end = float(result.at("rotor.angle", 10.0))
    assert end < 2 - 2 * pi
    work, _ = quad(TEETH[torque], end, 0.0, points=[2 - 2 * pi], limit=500)
    assert result.at("rotor.speed", 10.0) == pytest.approx(-sqrt(1 + 2 * work), rel=max(20 * accuracy, 1e-5))


HELD = """
components:
  clock: {{type: SignalSource, value: {{drift: {{rate: 1 1/s}}}}}}
  peak: {{type: SignalFunction, expression: "8*exp(-((s-600)/{width})**2)"}}
  pull: {{type: ForceActuator}}
  block: {{type: Mass, mass: 1 kg}}
  floor: {{type: Ground}}
  pad: {{type: Contact, normal_force: 10 N, curve: 0.5}}
connections:
  - [clock.signal, peak.s]
  - [peak.signal, pull.force]
  - [pull.flange, block.flange, pad.b]
  - [floor.flange, pad.a]
run: {{stop: 1000 s}}
"""


def slid(width: float) -> float:
    """How far the block slides [m]: v = integral of 8 exp(-s^2) - 5, from 8 exp(-s^2) = 5 until v is zero again."""
    begin = -sqrt(log(8 / 5))

    def speed(s: float) -> float:
        return 4 * sqrt(pi) * (erf(s) - erf(begin)) - 5 * (s - begin)

    way, _ = quad(speed, begin, brentq(speed, 0.0, 5.0))
    return float(way) * width**2


@EVERY
@pytest.mark.parametrize("width", [1.0, 0.2])
def test_a_held_block_lets_go_for_a_pull_that_is_short_beside_its_rest(simulate, width, engine, accuracy):
    result = simulate(HELD.format(width=width), **{"run.engine": engine, "run.accuracy": accuracy})
    assert result.at("block.x", 1000.0) == pytest.approx(slid(width), rel=max(20 * accuracy, 1e-5), abs=10 * accuracy)
