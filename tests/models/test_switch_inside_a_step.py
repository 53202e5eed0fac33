"""What `stepping` makes of a switch inside a step, and of the forces that a controller samples: closed forms."""

import math

import numpy as np
import pytest

import fairlead
from fairlead.integrate import Run, integrate

REVERSED = """
components:
  block: {type: Mass, mass: 1 kg, velocity: -0.1 m/s}
  floor: {type: Ground}
  pad: {type: Contact, normal_force: 1 N, curve: 1.0, method: hold}
  pull: {type: ForceSource, force: 2 N}
connections:
  - [pull.flange, block.flange, pad.b]
  - [pad.a, floor.flange]
run: {stop: 1 s, engine: stepping}
record: {every: 10 ms, signals: [block.x, block.v]}
"""
STOPPED = """
components:
  block: {type: Mass, mass: 1 kg, velocity: 1 m/s}
  wall: {type: Ground}
  buffer: {type: EndStop, upper: 0.1 m, stiffness: 1e4 N/m, damping: 0 s/m}
connections:
  - [wall.flange, buffer.a]
  - [buffer.b, block.flange]
run: {stop: 0.2 s, engine: stepping}
record: {every: 1 ms, signals: [block.x, block.v]}
"""
MEASURED = """
components:
  block: {type: Mass, mass: 1 kg}
  floor: {type: Ground}
  pad: {type: Contact, normal_force: 100 N, curve: 1.0, method: hold}
  pull: {type: ForceSource, force: {ramp: {to: 20 N, over: 1 s}}}
  gauge: {type: SampledSensor, period: 50 ms}
connections:
  - [pull.flange, block.flange, pad.b]
  - [pad.a, floor.flange]
  - [pad.friction, gauge.value]
run: {stop: 1 s, engine: stepping}
record: {every: 10 ms, signals: [gauge.signal]}
"""


@pytest.mark.parametrize("accuracy", ["1e-3", "1e-4", "1e-5", "1e-6"])
def test_a_block_that_is_turned_round_against_friction(simulate, accuracy):
    """It slows down by 3 m/s^2 until 1/30 s, and is then pulled on by 2 N - 1 N: no switch may round that to a step."""
    result = simulate(REVERSED.replace("stop: 1 s", f"stop: 1 s, accuracy: {accuracy}"))
    turn = 0.1 / 3
    assert result["block.v"][-1] == pytest.approx(1 - turn, abs=1e-6)
    t = result.t
    want = np.where(t < turn, -0.1 * t + 1.5 * t**2, -0.1 * turn + 1.5 * turn**2 + 0.5 * (t - turn) ** 2)
    assert np.abs(result["block.x"] - want)[t >= turn].max() < 1e-2 * float(accuracy)


@pytest.mark.parametrize("accuracy", ["1e-4", "1e-5", "1e-6"])
def test_a_block_that_a_spring_throws_back(simulate, accuracy):
    """Half a period of sqrt(k/m) = 100/s on the stop, then back with the speed it came with."""
    result = simulate(STOPPED.replace("stop: 0.2 s", f"stop: 0.2 s, accuracy: {accuracy}"))
    left = 0.1 + math.pi / 100
    assert result["block.x"][-1] == pytest.approx(0.1 - (0.2 - left), abs=2 * float(accuracy))  # 200 weights
    assert result["block.v"][-1] == pytest.approx(-1, abs=10 * float(accuracy))


def test_a_controller_samples_the_force_of_that_instant(simulate):
    """The force that holds a block under a ramp of 20 N/s; its mean over a step of 20 ms is 0.2 N less."""
    result = simulate(MEASURED)
    at = np.arange(0.075, 1.0, 0.05)
    told = result["gauge.signal"][np.searchsorted(result.t, at) - 1]
    np.testing.assert_allclose(told, 20 * (at - 0.025), atol=1e-9)


def test_switches_at_the_start_of_a_step_do_not_hold_up_a_run():
    """At 1.18 s of this run a step that ends at a switch is followed by one that meets another at once."""
    system = fairlead.load("slack_start", set={"friction.method": "hold"}).system
    outcome = integrate(system, Run(stop=1.25, every=0.01, engine="stepping", max_steps=10_000))
    assert outcome.ok, outcome.sentence
