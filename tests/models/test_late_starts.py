"""A motion given by its velocity alone begins where the driven body is, whenever the run starts."""

import numpy as np
import pytest

import fairlead
from tests.conftest import Scene

LATE = 10.0

PULLED = """
    components:
      block: {type: Mass, mass: 2 kg, position: 0.3 m}
      ground: {type: Ground}
      spring: {type: Spring, stiffness: 50 N/m}
      pull: {type: MotionSource, velocity: {constant: 0.1 m/s, sine: {amplitude: 0.2 m/s, frequency: 0.5 Hz}}}
    connections:
      - [block.flange, spring.b, pull.flange]
      - [ground.flange, spring.a]
    run: {start: 10 s, stop: 12 s, engine: ENGINE}
    record: {every: 10 ms, signals: [block.x, pull.x, spring.tension]}
"""
TURNED = """
    components:
      rotor: {type: Inertia, moment: 0.5 kg*m^2, angle: 0.2 rad}
      load: {type: Inertia, moment: 0.1 kg*m^2}
      spring: {type: TorsionSpring, stiffness: 3 N*m/rad, damping: 1 N*m*s/rad}
      turn: {type: SpeedSource, speed: 0.1 rad/s}
    connections:
      - [rotor.shaft, spring.b, turn.shaft]
      - [load.shaft, spring.a]
    run: {start: 10 s, stop: 12 s}
    record: {every: 10 ms, signals: [rotor.angle]}
"""


def way(t: np.ndarray) -> np.ndarray:
    """The integral of 0.1 + 0.2 sin(pi t) from 10 s on."""
    return np.asarray(0.1 * (t - LATE) + 0.2 / np.pi * (1.0 - np.cos(np.pi * t)))


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_a_driven_body_begins_where_it_is_said_to_be(simulate: Scene, engine: str) -> None:
    result = simulate(PULLED.replace("ENGINE", engine))
    np.testing.assert_allclose(result["block.x"], 0.3 + way(result.t), atol=1e-9)
    np.testing.assert_allclose(result["pull.x"], result["block.x"], atol=1e-12)


def test_so_does_a_shaft(simulate: Scene) -> None:
    result = simulate(TURNED)
    np.testing.assert_allclose(result["rotor.angle"], 0.2 + 0.1 * (result.t - LATE), atol=1e-12)


def test_a_start_given_to_run_counts_as_one_of_the_netlist(scene: Scene) -> None:
    """A model is compiled for the start of its netlist."""
    model = scene(PULLED.replace("ENGINE", "rodas"), **{"run.start": "0 s", "run.stop": "2 s"})
    at_once = model.run(out=None)
    late = model.run(out=None, start=LATE, stop="12 s")
    np.testing.assert_allclose(late["block.x"], 0.3 + way(late.t), atol=1e-9)
    stepped = model.start(start=LATE, stop=12)
    stepped.advance(11.0)
    assert stepped.get("block.x") == pytest.approx(0.3 + way(np.array(11.0)), abs=1e-9)
    np.testing.assert_array_equal(model.run(out=None)["block.x"], at_once["block.x"])


GEARED = """
    components:
      drive:
        type: SpeedSource
        speed: {constant: 0.3 rad/s, pulses: {to: 2 rad/s, every: 3 s, wide: 1 s, count: 10, start: 0.5 s}}
      rack: {type: Rack, radius: 0.2 m}
      cart: {type: Mass, mass: 2 kg, position: 0.7 m}
    connections:
      - [drive.shaft, rack.pinion]
      - [rack.rack, cart.flange]
    run: {start: 10 s, stop: 14 s}
    record: {every: 0.1 s, signals: [cart.x]}
"""
RUBBED = """
    components:
      belt: {type: MotionSource, velocity: 0.2 m/s}
      rider: {type: Mass, mass: 1 kg, position: 3 m}
      block: {type: Mass, mass: 1 kg}
      ground: {type: Ground}
      spring: {type: Spring, stiffness: 100 N/m}
      pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.6, coulomb: 0.5}}
    connections:
      - [belt.flange, pad.a, rider.flange]
      - [block.flange, pad.b, spring.b]
      - [ground.flange, spring.a]
    run: {stop: 2 s}
"""


def test_so_does_what_is_driven_through_a_rack_by_a_speed_with_jumps(simulate: Scene) -> None:
    """From 10 s on 0.3 rad/s, and 2 rad/s more until 10.5 s and from 12.5 to 13.5 s."""
    result = simulate(GEARED)
    t = result.t
    turned = 0.3 * (t - LATE) + 2.0 * (np.clip(t, LATE, 10.5) - LATE) + 2.0 * (np.clip(t, 12.5, 13.5) - 12.5)
    np.testing.assert_allclose(np.abs(result["cart.x"] - 0.7), 0.2 * turned, atol=1e-9)


def test_a_run_from_outside_that_starts_late_is_tuned_and_taken_back(scene: Scene) -> None:
    run = scene(RUBBED).start(start=5, stop=7, tunable=["pad.normal_force"])
    run.set("pad.normal_force", 5.0)
    run.advance(6.0)
    state = run.save()
    run.advance(7.0)
    block = run.get("block.x")
    assert run.get("rider.x") == pytest.approx(3.4, abs=1e-12)
    run.restore(state)
    run.advance(7.0)
    assert run.get("block.x") == block


def test_where_the_origin_is_given_a_place_that_differs_is_a_contradiction(scene: Scene) -> None:
    text = PULLED.replace("ENGINE", "rodas").replace("MotionSource,", "MotionSource, origin: 0 m,")
    with pytest.raises(fairlead.ModelError, match=r"block.*x starts at 0.3 m; pull.* starts at 1 m"):
        scene(text).check()
