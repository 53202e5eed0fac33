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
BETWEEN_STOPS = """
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 1 kg, velocity: 1.2 m/s}
  load: {type: Mass, mass: 0.3 kg}
  stops: {type: EndStop, lower: -50 mm, upper: 100 mm, stiffness: 2e5 N/m, damping: 0.3 s/m}
  under: {type: Contact, normal_force: 10 N, curve: 0.05, method: hold}
  upon: {type: Contact, normal_force: 3 N, curve: 0.4, method: hold}
connections:
  - [floor.flange, under.a, stops.a]
  - [under.b, block.flange, stops.b, upon.a]
  - [upon.b, load.flange]
run: {stop: 2 s, engine: stepping}
record: {every: 10 ms, signals: [block.x]}
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


SNATCHED = """
    components:
      floor: {type: Ground}
      block: {type: Mass, mass: 5 kg}
      pad: {type: Contact, normal_force: 50 N, curve: 0.25}
      rope: {type: Tether, stiffness: 2e5 N/m, length: 0.1 m}
      hand: {type: MotionSource, velocity: {sine: {amplitude: 1 m/s, frequency: FREQUENCY}}}
    connections:
      - [floor.flange, pad.a]
      - [block.flange, pad.b, rope.a]
      - [rope.b, hand.flange]
    run: {stop: 0.6 s, engine: ENGINE, accuracy: ACCURACY}
    record: {signals: [block.x, block.v, rope.tension]}
"""


@pytest.mark.parametrize("frequency", ["1.3 Hz", "1.225 Hz", "2.3 Hz"])
def test_a_rope_that_is_snatched_while_all_else_rests_is_seen(simulate, frequency):
    """A long step may begin and end with a slack rope; one in which it comes taut must not push."""
    scene = SNATCHED.replace("FREQUENCY", frequency)
    exact = simulate(scene.replace("ENGINE", "rodas").replace("ACCURACY", "1e-7"))
    found = simulate(scene.replace("ENGINE", "stepping").replace("ACCURACY", "1e-4"))
    assert found["block.x"][-1] == pytest.approx(exact["block.x"][-1], rel=2e-2)
    assert found["block.v"].min() > -1e-6


def test_time_events_apart_by_a_rounding_are_one(simulate):
    """A ramp ends at 0.2 + 0.5 s, the sample 140 of 5 ms lies one unit in the last place after it."""
    scene = """
        components:
          floor: {type: Ground}
          block: {type: Mass, mass: 4 kg}
          pad: {type: Contact, normal_force: 40 N, curve: 0.3}
          spring: {type: Spring, stiffness: 2e4 N/m}
          act: {type: TorqueActuator}
          rack: {type: Rack, radius: 0.1 m}
          ref: {type: SignalSource, value: {ramp: {to: 1, start: 0.2 s, over: 0.5 s}}}
          c: {type: PiController, gain: 0.1, integral_time: 0.05 s, period: 5 ms}
        connections:
          - [floor.flange, pad.a, spring.a]
          - [block.flange, pad.b, spring.b, rack.rack]
          - [rack.pinion, act.shaft]
          - [ref.signal, c.reference]
          - [spring.tension, c.measured]
          - [c.command, act.torque]
        run: {stop: 1 s, engine: ENGINE}
    """
    for engine in ("rodas", "stepping"):
        assert simulate(scene.replace("ENGINE", engine)).run["sentence"] == "Reached t = 1 s."


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize("frequency", [0.78, 1.0, 1.5])
def test_a_normal_force_that_swings_lets_go_though_nothing_else_moves(simulate, engine, frequency):
    """1 kg under 3 N, held by up to 0.3 N(t): it slides while N is below 10 N, and until it has come to rest again."""
    result = simulate(f"""
        components:
          floor: {{type: Ground}}
          block: {{type: Mass, mass: 1 kg}}
          pad: {{type: Contact, normal_force: 0 N, curve: 0.3}}
          press: {{type: SignalSource, value: {{sine: {{amplitude: 15, frequency: {frequency} Hz, offset: 20}}}}}}
          pull: {{type: ForceSource, force: 3 N}}
        connections:
          - [floor.flange, pad.a]
          - [block.flange, pad.b, pull.flange]
          - [press.signal, pad.normal]
        run: {{stop: 5 s, engine: {engine}}}
    """)
    x = v = 0.0
    for k in range(500_000):
        grip = 0.3 * (20 + 15 * math.sin(2 * math.pi * frequency * k * 1e-5))
        v = max(v + (3 - grip) * 1e-5, 0.0)
        x += v * 1e-5
    assert result["block.x"][-1] == pytest.approx(x, abs=1e-3)


@pytest.mark.parametrize("accuracy", ["1e-4", "1e-5"])
def test_a_stop_is_met_without_going_to_and_fro(tmp_path, accuracy):
    """A step that ended at the very place of the stop found no zones, and tried a hundred patterns of them."""
    (tmp_path / "between.yaml").write_text(f"schema: 1{BETWEEN_STOPS}", encoding="utf-8")
    system = fairlead.load(tmp_path / "between.yaml", set={"run.accuracy": accuracy}).system
    outcome = integrate(system, Run(stop=2.0, engine="stepping"))
    assert outcome.ok, outcome.sentence
    assert outcome.counters.switches > 10
    assert outcome.counters.settling_passes < 6 * outcome.counters.switches
    assert outcome.counters.unsolved == 0


@pytest.mark.slow
def test_rows_before_a_rope_comes_taut_show_it_loose(simulate):
    """In its end zone it would push, with 1 N here. With few machines no step has a switch inside."""
    bodies = range(45)
    parts = "".join(
        f"\n          body{k}: {{type: Mass, mass: 100 kg, position: {-0.02 - 0.011 * k:.3f} m, velocity: 1 m/s}}"
        f"\n          rope{k}: {{type: Tether, stiffness: 10 N/m}}"
        for k in bodies
    )
    joins = "".join(f"\n          - [rope{k}.b, body{k}.flange]" for k in bodies)
    result = simulate(f"""
        components:
          ground: {{type: Ground}}{parts}
        connections:
          - [ground.flange, {", ".join(f"rope{k}.a" for k in bodies)}]{joins}
        run: {{stop: 0.6 s, accuracy: 1e-3, engine: stepping}}
        record: {{every: 2 ms, signals: ["*"]}}
    """)
    assert len(result.events) == len(bodies)
    for k in bodies:
        tension, stretch = result[f"rope{k}.tension"], np.maximum(result[f"body{k}.x"], 0.0)
        assert tension == pytest.approx(10.0 * stretch, abs=1e-9)
