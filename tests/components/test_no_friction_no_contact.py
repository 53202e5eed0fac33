"""A part whose friction is zero by its parameters has no contact: no zone, no unknown, and outputs that read zero."""

import math

import numpy as np
import pytest

import fairlead

TURNED = """
    components:
      housing: {{type: Housing}}
      part: {{{part}}}
      drag: {{type: RotationalDamper, damping: 0}}
      rotor: {{type: Inertia, moment: 2 kg*m^2, speed: 10 rad/s}}
      fan: {{type: Inertia, moment: 1 kg*m^2}}
    connections: {joined}
    run: {{stop: 1 s}}
"""
PUSHED = """
    components:
      wall: {{type: Ground}}
      part: {{{part}}}
      body: {{type: Mass, mass: 2 kg, velocity: 1 m/s}}
    connections: {joined}
    run: {{stop: 1 s}}
"""
BETWEEN = "[[rotor.shaft, part.a], [part.b, fan.shaft, drag.b], [housing.shaft, drag.a]]"
HELD = "[[housing.shaft, drag.a, part.a], [part.b, drag.b, rotor.shaft, fan.shaft]]"
ROUND = "[[housing.shaft, drag.a], [part.shaft, drag.b, rotor.shaft, fan.shaft]]"
SLID = "[[wall.flange, part.a], [part.b, body.flange]]"
PARTS = {
    "SlideFriction": (PUSHED, SLID, "sliding: {} N", "force"),
    "ShaftFriction": (TURNED, HELD, "sliding: {} N*m", "torque"),
    "LoadedFriction": (TURNED, HELD, "dry: {} N*m", "torque"),
    "Clutch": (TURNED, BETWEEN, "radius: 0.1 m, normal_force: 10 N, curve: {}", "torque"),
    "Brake": (TURNED, ROUND, "radius: 0.1 m, normal_force: 10 N, curve: {}", "torque"),
    "LossyGear": (TURNED, BETWEEN, "ratio: 2, efficiency: 1, bearing: {}", "friction"),
}  # fmt: skip


def contacts(model):
    """Paths of the contacts in a model, and the unknowns that friction brings."""
    from fairlead.components.friction.contact import Contact

    paths = [one.path for one in model.flat.instances if issubclass(one.type, Contact)]
    return paths, [name for name in model.system.unknown_names if ".contact." in name or ".seal." in name]


@pytest.mark.parametrize("kind", PARTS)
def test_no_contact_is_made_where_its_force_is_zero_by_a_parameter(scene, kind):
    """With the force it is there, without it is not, and what it tells is zero."""
    text, joined, given, output = PARTS[kind]
    with_it = scene(text.format(part=f"type: {kind}, {given.format(0.5)}", joined=joined))
    assert contacts(with_it)[0]
    assert contacts(with_it)[1]
    without = scene(text.format(part=f"type: {kind}, {given.format(0)}", joined=joined))
    assert contacts(without) == ([], [])
    result = without.run(out=None)
    assert not result.events
    assert np.all(result[f"part.{output}"] == 0.0)
    energy = result.run["energy"]
    assert energy["closure"] < 1e-9


@pytest.mark.parametrize("kind", ["Cylinder", "SingleActingCylinder"])
def test_a_cylinder_without_seal_force_has_no_seal(scene, kind):
    """As it is when nothing is said; also between two given motions, where a seal would be refused."""
    ends = "[low.port, part.a, part.b]" if kind == "Cylinder" else "[low.port, part.a]"
    text = """
        components:
          wall: {type: Ground}
          low: {type: Tank}
          part: {type: KIND, bore_diameter: 50 mm, stroke: 0.3 m}
          pull: {type: MotionSource, position: {ramp: {to: 0.1, over: 1 s}}}
        connections: [[wall.flange, part.body], [pull.flange, part.rod], ENDS]
        run: {stop: 1 s}
    """.replace("KIND", kind).replace("ENDS", ends)
    model = scene(text)
    assert contacts(model) == ([], [])
    assert np.all(model.run(out=None)["part.friction"] == 0.0)
    with pytest.raises(fairlead.ModelError, match="seal lies between two prescribed motions"):
        scene(text.replace("0.3 m", "0.3 m, seal_force: 10 N")).check()


def test_a_servo_motor_without_dry_friction_turns_freely(scene):
    """Its drag alone stays: the speed falls as exp(-t viscous/inertia)."""
    text = """
        components:
          high: {type: PressureSource, pressure: 1 bar}
          low: {type: Tank}
          drive:
            {type: ServoMotorDrive, valve: {rated_flow: 1 L/min}, pressure: 1 bar,
             motor: {displacement: 1e-6 cm^3/rev, inertia: 0.1 kg*m^2, viscous: 0.2 N*m*s/rad}}
          rest: {type: SignalSource, value: 0}
          load: {type: Inertia, moment: 0.1 kg*m^2, speed: 10 rad/s}
        connections:
          - [high.port, drive.supply]
          - [low.port, drive.tank]
          - [rest.signal, drive.command]
          - [load.shaft, drive.shaft]
        run: {stop: 1 s, accuracy: 1e-6}
    """
    model = scene(text)
    assert contacts(model) == ([], [])
    assert model.run(out=None)["load.speed"][-1] == pytest.approx(10 * math.exp(-1), rel=1e-4)


def test_a_viscous_part_alone_is_there_without_a_load(simulate):
    """Of a gear train that rubs by nothing else: exp(-t viscous/moment)."""
    part = "type: LoadedFriction, dry: 0, viscous: 3 N*m*s/rad"
    result = simulate(TURNED.format(part=part, joined=HELD))
    assert result["rotor.speed"][-1] == pytest.approx(10 * math.exp(-1), rel=1e-3)


def test_a_sweep_may_begin_at_no_friction(scene):
    """The model is made anew where the contact comes."""
    text, joined, given, _ = PARTS["SlideFriction"]
    free = scene(text.format(part=f"type: SlideFriction, {given.format(0)}", joined=joined))
    rubbing = free.with_values({"part.sliding": 1.0})
    assert contacts(rubbing)[0] == ["part.contact"]
    assert free.run(out=None)["body.v"][-1] == pytest.approx(1.0, rel=1e-9)
    assert rubbing.run(out=None)["body.v"][-1] == pytest.approx(0.5, rel=1e-4)
