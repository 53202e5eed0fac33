"""Friction that grows as a power of the normal force, on a line: the load on a metre of it counts, not that on a node.

On a bend of radius R, hauled against the tension T0,  dT/ds = mu q_ref (T/(R q_ref))^n, so

    T^(1 - n) = T0^(1 - n) + (1 - n) mu q_ref^(1 - n) R^-n s
"""

from __future__ import annotations

import math

import numpy as np
import pytest

MU, POWER, REFERENCE, RADIUS, HELD = 0.3, 0.8, 30.0, 1.0, 300.0

SCENE = """
components:
  rope:
    {{type: Cable, length: 12 m, element: {element} m, start: 0 m, tension: 300 N, mass: 0.2 kg/m, stiffness: 500 kN,
     damping_ratio: 0.5{more}}}
  route:
    type: Route
    stations:
      - {{type: Bend, start: 3 m, angle: 90 deg, radius: 1 m, friction: {curve}}}
  drive: {{type: MotionSource, velocity: {{ramp: {{to: -0.1 m/s, over: 0.2 s}}}}}}
  load: {{type: ForceSource, force: 300 N}}
connections: [[rope.path, route.path], [drive.flange, rope.inboard], [load.flange, rope.outboard]]
run: {{stop: 5 s, accuracy: 1e-5}}
"""
CURVE = f"{{curve: coulomb, coulomb: {MU}, load_exponent: {POWER}, load_reference: {REFERENCE} N}}"


def taken(result):
    """Force of the drive, the mean of the last three seconds: nodes that come on the bend make it swing a little."""
    from_then_on = result.t > 2.0
    return -float(np.trapezoid(result["drive.force"][from_then_on], result.t[from_then_on])) / 3.0


def hauled_round(power=POWER):
    length = math.pi / 2 * RADIUS
    grown = HELD ** (1 - power) + (1 - power) * MU * REFERENCE ** (1 - power) * RADIUS**-power * length
    return grown ** (1 / (1 - power))


@pytest.mark.parametrize(("element", "within"), [(0.2, 5e-3), (0.05, 1.5e-3)])
def test_the_mesh_does_not_matter(simulate, element, within):
    result = simulate(SCENE.format(element=element, curve=CURVE, more=""))
    assert taken(result) == pytest.approx(hauled_round(), rel=within)


def test_statics_has_the_closed_form(scene):
    table = scene(SCENE.format(element=0.1, curve=CURVE, more="")).statics().to_pandas()
    assert table["inboard"].max() == pytest.approx(hauled_round(), rel=1e-6)


def test_a_line_that_twists_has_the_same_friction(simulate):
    more = ", torsion: {stiffness: 50 N*m^2, inertia: 1e-4 kg*m}"
    result = simulate(SCENE.format(element=0.2, curve=CURVE, more=more))
    assert taken(result) == pytest.approx(hauled_round(), rel=5e-3)


def test_an_exponent_of_one_is_the_capstan(simulate):
    curve = CURVE.replace("0.8", "1")
    off = simulate(SCENE.format(element=0.2, curve=curve, more=""))
    assert taken(off) == pytest.approx(HELD * math.exp(MU * math.pi / 2), rel=5e-3)
