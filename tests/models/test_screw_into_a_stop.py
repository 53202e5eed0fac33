"""What a stop holds and a contact that sticks holds as well, round a circle whose speeds agree only at rest."""

from __future__ import annotations

import math

import pytest

SCREW = """
    components:
      motor: {type: Inertia, moment: 0.01 kg*m^2, speed: 50 rad/s}
      screw: {type: LeadScrew, radius: 10 mm, lead: 10 mm, curve: 0.05}
      load: {type: Mass, mass: 20 kg}
      stop: {type: RigidStop, length: -0.02 m}
      ground: {type: Ground}
    connections:
      - [motor.shaft, screw.screw]
      - [screw.nut, load.flange, stop.a]
      - [ground.flange, stop.b]
    run: {stop: 0.5 s, accuracy: 1e-6}
"""
WORM = """
    components:
      motor: {type: Inertia, moment: 0.01 kg*m^2, speed: 50 rad/s}
      worm: {type: Worm, radius: 10 mm, lead: 10 mm, curve: 0.05, wheel_radius: 50 mm}
      wheel: {type: Inertia, moment: 0.05 kg*m^2}
      rim: {type: Rack, radius: 50 mm}
      stop: {type: RigidStop, length: -0.02 m}
      ground: {type: Ground}
    connections:
      - [motor.shaft, worm.worm]
      - [worm.wheel, wheel.shaft, rim.pinion]
      - [rim.rack, stop.a]
      - [ground.flange, stop.b]
    run: {stop: 0.5 s, accuracy: 1e-6}
"""
LEVER = """
    components:
      a: {type: Mass, mass: 1 kg, velocity: 1 m/s}
      lever: {type: Lever, ratio: -2}
      b: {type: Mass, mass: 3 kg}
      pivot: {type: Ground}
      ground: {type: Ground}
      pad: {type: Contact, normal_force: 5 N, curve: 0.4}
      stop: {type: RigidStop, length: -0.1 m}
    connections:
      - [a.flange, lever.a, stop.a]
      - [lever.b, b.flange, pad.b]
      - [lever.pivot, pivot.flange]
      - [ground.flange, stop.b, pad.a]
    friction: {method: karnopp}
    run: {stop: 0.5 s}
"""


@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize("method", ["hold", "karnopp"])
@pytest.mark.parametrize(("text", "inertia"), [
    (SCREW, 0.01 * (2 * math.pi / 0.01) ** 2 + 20),
    (WORM, 0.01 * (2 * math.pi / 0.01) ** 2 + 0.05 / 0.05**2),
], ids=["screw", "worm"])  # fmt: skip
def test_a_screw_that_runs_into_a_stop_stays_there(simulate, text, inertia, method, engine) -> None:
    """Unloaded it runs on at 50 rad/s, v = 50 lead/(2 pi), meets the stop at 0.02 m/v and loses all it had there."""
    result = simulate(text, **{"friction.method": method, "run.engine": engine})
    v = 50 * 0.01 / (2 * math.pi)
    met = next(event.t for event in result.events if event.component == "stop")
    assert met == pytest.approx(0.02 / v, abs=1e-6)
    assert sum(result.run["lost"].values()) == pytest.approx(inertia * v**2 / 2, rel=1e-4)
    assert result["motor.speed"][-1] == pytest.approx(0.0, abs=1e-6)
    assert result["motor.angle"][-1] == pytest.approx(0.02 / 0.01 * 2 * math.pi, rel=1e-6)


def test_what_is_held_twice_about_a_lever_comes_to_rest(simulate) -> None:
    """A stop at one end, a contact that sticks at the other: friction of 2 N acts as 4 N on 1 + 4 * 3 kg until then."""
    result = simulate(LEVER)
    met = next(event.t for event in result.events if event.component == "stop")
    slows = 0.4 * 5 * 2 / 13
    assert met == pytest.approx((1 - math.sqrt(1 - 2 * slows * 0.1)) / slows, rel=1e-4)
    assert result["a.x"][-1] == pytest.approx(0.1, abs=1e-6)
    assert result["b.v"][-1] == pytest.approx(0.0, abs=1e-9)
