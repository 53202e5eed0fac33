"""A coasting shaft whose gear or screw rubs under load meets a stop: the blow passes the loss, at every accuracy.

While it coasts nothing is carried, so that nothing rubs; the blow is carried, and rubs as any load does. A stop at a
wall closes a circle of what may hold (the teeth, the stop, the friction), a stop at a free body does not.
"""

from __future__ import annotations

from math import pi

import pytest

ENGINES = pytest.mark.parametrize("engine", ["rodas", "ida"])
ACCURACIES = pytest.mark.parametrize("accuracy", [1e-3, 1e-4, 1e-5, 1e-6])
J, BEHIND, TRAY, BOX, SPEED, RATIO, RADIUS = 0.02, 1.0, 1.0, 50.0, 20.0, 0.1, 0.1

GEAR = """
components:
  rotor: {{type: Inertia, moment: {J} kg*m^2, speed: {speed} rad/s}}
  gear: {{type: LossyGear, ratio: {RATIO}, {loss}}}
  drum: {{type: Inertia, moment: {BEHIND} kg*m^2}}
  rack: {{type: Rack, radius: {RADIUS} m}}
  tray: {{type: Mass, mass: {TRAY} kg}}
  stop: {{type: RigidStop}}
  wall: {wall}
  motor: {{type: TorqueSource, torque: {torque} N*m}}
connections:
  - [rotor.shaft, gear.a, motor.shaft]
  - [gear.b, drum.shaft, rack.pinion]
  - [rack.rack, tray.flange, stop.a]
  - [wall.flange, stop.b]
run: {{stop: 3 s, engine: {engine}, accuracy: {accuracy}}}
"""
FREE, FIXED = "{type: Mass, mass: 50 kg, position: 0.05 m}", "{type: FixedPoint, position: 0.05 m}"
LOSSES = {"some": ("efficiency: 0.9", 0.9), "locks itself": ("efficiency: 0.4", 0.4)}


def gear(**given):
    """The scene of a gear."""
    sizes = {"J": J, "RATIO": RATIO, "BEHIND": BEHIND, "RADIUS": RADIUS, "TRAY": TRAY}
    return GEAR.format(**sizes, **given)


@ENGINES
@ACCURACIES
@pytest.mark.parametrize("loss", LOSSES)
def test_a_gear_drives_its_load_against_a_free_body(simulate, engine, accuracy, loss):
    """J dw = -P and, of what is behind the gear, J' r dw = (efficiency/r) P - R (box v)."""
    words, efficiency = LOSSES[loss]
    result = simulate(gear(loss=words, wall=FREE, torque=0, speed=SPEED, engine=engine, accuracy=accuracy))
    inner = (BEHIND + TRAY * RADIUS**2) * RATIO + J * efficiency / RATIO
    after = inner * SPEED / (inner + RADIUS * BOX * RADIUS * RATIO)
    assert result.at("rotor.speed", 3.0) == pytest.approx(after, rel=1e-6)


@ENGINES
@ACCURACIES
@pytest.mark.parametrize("loss", ["efficiency: 0.9", "efficiency: 0.4", "efficiency: 0.9, efficiency_back: 0.7",
                                  "efficiency: 0.9, bearing: 0.05 N*m"])  # fmt: skip
@pytest.mark.parametrize(("torque", "speed"), [(1, 0), (0, SPEED)], ids=["driven", "coasting"])
def test_a_gear_drives_its_load_against_a_wall(simulate, engine, accuracy, loss, torque, speed):
    """All comes to rest where the wall stands."""
    result = simulate(gear(loss=loss, wall=FIXED, torque=torque, speed=speed, engine=engine, accuracy=accuracy))
    assert abs(result.at("rotor.speed", 3.0)) < 1e-9
    assert result.at("tray.x", 3.0) == pytest.approx(0.05, abs=1e-8)


@ENGINES
@ACCURACIES
@pytest.mark.parametrize("names", ["screw nut stop box rotor", "box stop rotor nut screw"])
def test_a_screw_drives_its_nut_against_a_free_body(simulate, engine, accuracy, names):
    """J dw = -P r (tan s + mu)/(1 - mu tan s),  P = nut dv + box v: what raises a load."""
    screw, nut, stop, box, rotor = names.split()
    result = simulate(f"""
    components:
      {rotor}: {{type: Inertia, moment: 1e-3 kg*m^2, speed: 40 rad/s}}
      {screw}: {{type: LeadScrew, radius: 10 mm, lead: 10 mm, curve: 0.3, round_off: 1e-6 N}}
      {nut}: {{type: Mass, mass: 2 kg, position: 0 m}}
      {stop}: {{type: RigidStop}}
      {box}: {{type: Mass, mass: 50 kg, position: 0.02 m}}
    connections: [[{rotor}.shaft, {screw}.screw], [{screw}.nut, {nut}.flange, {stop}.a], [{stop}.b, {box}.flange]]
    run: {{stop: 1 s, engine: {engine}, accuracy: {accuracy}}}
    """)
    slope, way = 10 / (2 * pi * 10), 0.01 / (2 * pi)
    arm = 0.01 * (slope + 0.3) / (1 - 0.3 * slope)
    after = 40 * (1e-3 + arm * way * 2) / (1e-3 + arm * way * 52)
    assert result.at(f"{rotor}.speed", 1.0) == pytest.approx(after, rel=1e-5)
