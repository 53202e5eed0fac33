"""Held contacts that contradict each other: which one lets go, by the limit of stiff contacts.

A block with the load F lies on the ground and rubs on what moves as given. Where that passes zero speed, or starts,
both contacts are without slip, and ground and belt move apart. The ground never has to hold more than F and what the
belt can rub: where its stiction is above that, the block never moves. Where the ground can hold less than F and the
sliding friction of the belt, the block goes with the belt, as long as that can take it along.
"""

from __future__ import annotations

import numpy as np
import pytest

ENGINES = ("rodas", "stepping", "ida")
LOAD, MASS = 15.0, 1.0
GROUND, BELT = 18.8, 5.6
"""Sliding friction; the stiction of the ground is half as much again, that of the belt a third more."""

MOTIONS = {
    "turns": "{type: MotionSource, velocity: {ramp: {from: {v} m/s, to: -{v} m/s, start: 0.1 s, over: 1 s}}}",
    "turns at once": "{type: MotionSource, velocity: {ramp: {from: {v} m/s, to: -{v} m/s, start: 0.1 s, over: 20 ms}}}",
    "swings": "{type: MotionSource, velocity: {sine: {amplitude: {v} m/s, frequency: 1.3 Hz, phase: 0.4 rad}}}",
    "as a place": "{type: MotionSource, position: {sine: {amplitude: 0.03 m, frequency: 1.3 Hz, phase: 0.4 rad}}}",
    "starts": "{type: MotionSource, velocity: {ramp: {from: 0 m/s, to: -{v} m/s, start: 0.3 s, over: 0.2 s}}}",
    "starts against": "{type: MotionSource, velocity: {ramp: {from: 0 m/s, to: {v} m/s, start: 0.3 s, over: 0.2 s}}}",
}
SCENE = """
    components:
      floor: {{type: Ground}}
      {block}: {{type: Mass, mass: {mass} kg}}
      belt: {motion}
      {ground}: {{type: Contact, curve: {{curve: coulomb, coulomb: 1.0, stiction: {stiction}}}, normal_force: {held} N}}
      {rub}: {{type: Contact, curve: {{curve: coulomb, coulomb: 1.0, stiction: 1.33}}, normal_force: {rubs} N}}
      load: {{type: ForceSource, force: -{load} N}}
    connections:
      - [floor.flange, {ground}.a]
      - [{block}.flange, {ground}.b, {rub}.b, load.flange]
      - [belt.flange, {rub}.a]
    friction: {{method: {method}}}
    run: {{stop: {stop} s, accuracy: 1e-6}}
"""
NAMES = {"block": "m", "ground": "ground", "rub": "rub"}


def scene(motion: str, size: float = 1.0, names=NAMES, method: str = "hold", stop: float = 1.2, **given: float) -> str:
    forces = {"mass": MASS, "load": LOAD, "held": GROUND, "rubs": BELT} | given
    stiction = forces.pop("stiction", 1.5)
    text = MOTIONS[motion].replace("{v}", "0.2")
    scaled = {name: size * value for name, value in forces.items()}
    return SCENE.format(**scaled, **names, motion=text, method=method, stop=stop, stiction=stiction)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("method", ["hold", "karnopp"])
@pytest.mark.parametrize("motion", MOTIONS)
def test_what_the_ground_can_hold_stays(simulate, motion, method, engine):
    result = simulate(scene(motion, method=method), **{"run.engine": engine})
    assert np.abs(result["m.x"]).max() < 1e-8
    assert np.abs(result["rub.friction"]).max() > 0.9 * BELT  # and the belt did rub
    assert np.abs(result["ground.friction"]).max() < 1.5 * GROUND


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("load", [15.0, 18.0, 20.0])
def test_also_where_the_load_is_beyond_what_the_belt_holds_or_the_ground_slides_with(simulate, load, engine):
    result = simulate(scene("turns", load=load), **{"run.engine": engine})
    assert np.abs(result["m.x"]).max() < 1e-8


@pytest.mark.parametrize("engine", ENGINES)
def test_what_the_ground_cannot_hold_goes_with_the_belt(simulate, engine):
    """Ground 18.8 N at one level, load 15 N, belt 5.6 N: together they pull with 20.6 N, and the belt holds 7.4 N."""
    result = simulate(scene("turns", stiction=1.0, stop=1.0), **{"run.engine": engine})
    assert result["m.v"][-1] == pytest.approx(result["belt.v"][-1], abs=1e-9)
    assert result["m.x"][-1] == pytest.approx(-0.4 * 0.4**2 / 2, rel=1e-5)  # from 0.6 s on, at 0.4 m/s^2


OTHERS = ({"block": "z", "ground": "b", "rub": "a"}, {"block": "a", "ground": "y", "rub": "z"})


@pytest.mark.parametrize("names", OTHERS)
@pytest.mark.parametrize("size", [1e-4, 1e4])
def test_neither_names_nor_size_decide(simulate, names, size):
    result = simulate(scene("turns", size=size, names=names))
    assert np.abs(result[f"{names['block']}.x"]).max() < 1e-8


RING = """
    components:
      floor: {type: Ground}
      one: {type: Mass, mass: 1 kg}
      two: {type: Mass, mass: 2 kg}
      belt: {type: MotionSource, velocity: {sine: {amplitude: 0.2 m/s, frequency: 1.3 Hz, phase: 0.4 rad}}}
      under: {type: Contact, curve: 0.5, normal_force: 20 N}
      below: {type: Contact, curve: 0.4, normal_force: 20 N}
      between: {type: Contact, curve: 0.3, normal_force: 10 N}
      rub: {type: Contact, curve: 0.5, normal_force: 12 N}
      load: {type: ForceSource, force: -6 N}
    connections:
      - [floor.flange, under.a, below.a]
      - [one.flange, under.b, between.a, load.flange]
      - [two.flange, below.b, between.b, rub.b]
      - [belt.flange, rub.a]
    run: {stop: 2 s, accuracy: 1e-6}
"""


@pytest.mark.parametrize("engine", ENGINES)
def test_a_ring_with_one_level_of_friction_settles_where_a_belt_turns_round(simulate, engine):
    """One holds 10 N and carries at most 6 + 3; two holds 8 N and carries at most 6 + 3 less what one can: 6 of 8."""
    result = simulate(RING, **{"run.engine": engine})
    assert np.abs(result["one.x"]).max() < 1e-8
    assert np.abs(result["two.x"]).max() < 1e-8


SHAFT = """
    components:
      shaft: {type: Inertia, moment: 0.1 kg*m^2}
      brake: {type: Brake, curve: {curve: coulomb, coulomb: 0.3, stiction: 0.45}, normal_force: 60 N, radius: 0.1 m}
      clutch: {type: Clutch, curve: {curve: coulomb, coulomb: 0.3, stiction: 0.35}, normal_force: 20 N, radius: 0.1 m}
      load: {type: TorqueSource, torque: -1.5 N*m}
      motor: {type: SpeedSource, speed: {ramp: {from: 2 rad/s, to: -2 rad/s, start: 0.1 s, over: 1 s}}}
    connections:
      - [shaft.shaft, brake.shaft, clutch.a, load.shaft]
      - [clutch.b, motor.shaft]
    run: {stop: 1.2 s, accuracy: 1e-6}
"""


@pytest.mark.parametrize("engine", ENGINES)
def test_a_brake_holds_against_a_clutch_whose_other_side_turns_round(simulate, engine):
    result = simulate(SHAFT, **{"run.engine": engine})
    assert np.abs(result["shaft.angle"]).max() < 1e-8


def test_many_blocks_beside_one_belt_stay_too(simulate):
    """More than 40 machines: `stepping` would take switches inside its steps, but for what this is about."""
    parts, joints = ["floor: {type: Ground}", "belt: " + MOTIONS["turns"].replace("{v}", "0.2")], []
    ground, belt = ["floor.flange"], ["belt.flange"]
    for k in range(25):
        parts += [
            f"m{k}: {{type: Mass, mass: 1 kg}}",
            f"g{k}: {{type: Contact, curve: {{curve: coulomb, coulomb: 1, stiction: 1.5}}, normal_force: {GROUND} N}}",
            f"r{k}: {{type: Contact, curve: {{curve: coulomb, coulomb: 1, stiction: 1.33}}, normal_force: {BELT} N}}",
            f"l{k}: {{type: ForceSource, force: -{LOAD} N}}",
        ]
        ground.append(f"g{k}.a")
        belt.append(f"r{k}.a")
        joints.append(f"[m{k}.flange, g{k}.b, r{k}.b, l{k}.flange]")
    lines = ["components:", *(f"  {one}" for one in parts), "connections:"]
    lines += [f"  - [{', '.join(ends)}]" for ends in (ground, belt)] + [f"  - {one}" for one in joints]
    text = "\n".join([*lines, "run: {stop: 1.2 s, accuracy: 1e-6, engine: stepping}"])
    result = simulate(text)
    assert max(np.abs(result[f"m{k}.x"]).max() for k in range(25)) < 1e-8
