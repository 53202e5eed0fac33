"""Friction that rises steeply as a contact comes to rest is not stepped over, whatever the accuracy.

A block of mass m slides to rest under friction N mu(v) alone. It stops after t = integral of m/(N mu(v)) dv from 0 to
the speed it begins with. Beyond rest the law in force is mirrored, so a long step may have all its stages beside the
rise, which is a thousandth of the speed wide.
"""

import itertools
import math

import numpy as np
import pytest
import scipy.integrate

MASS, NORMAL = 1.3, 10.0
SCENE = """
components:
  floor: {{type: Ground}}
  block: {{type: Mass, mass: 1.3 kg, position: 0 m, velocity: {speed} m/s}}
  pad: {{type: Contact, normal_force: 10 N, curve: {curve}}}
connections: [[floor.flange, pad.a], [pad.b, block.flange]]
run: {{stop: 2 s, accuracy: {accuracy}, engine: {engine}}}
record: {{signals: ["*"]}}
"""
CURVES = {
    "stribeck": ("{{curve: stribeck, stiction: 0.3, coulomb: 0.15, velocity: {w} m/s}}",
                 lambda v, w: 0.15 + 0.15 * math.exp(-((v / w) ** 2))),
    "tustin": ("{{curve: tustin, stiction: 0.3, coulomb: 0.15, velocity: {w} m/s}}",
               lambda v, w: 0.15 + 0.15 * math.exp(-v / w)),
    "hump": ("{{curve: hump, stiction: 0.15, peak: 0.3, peak_velocity: {w} m/s, coulomb: 0.15}}",
             lambda v, w: 0.15 + 0.15 * v / w * math.exp(1 - v / w)),
}  # fmt: skip


@pytest.mark.parametrize("curve", CURVES)
@pytest.mark.parametrize(
    "width", [3e-3, *(pytest.param(w, marks=pytest.mark.slow) for w in (0.1, 0.03, 1e-3, 1e-4, 1e-5))]
)
@pytest.mark.parametrize("speed", [-1.0, pytest.param(0.5, marks=pytest.mark.slow)])
@pytest.mark.parametrize("engine", ["rodas", "ida", "stepping"])
def test_a_block_comes_to_rest_when_its_friction_says(scene, curve, width, speed, engine):
    if engine == "ida":
        pytest.importorskip("sksundae.ida", reason="needs scikit-sundae: pip install 'fairlead[ida]'")
    text, coefficient = CURVES[curve]
    edges = [0.0, *(k * width for k in (1, 3, 10, 40) if k * width < abs(speed)), abs(speed)]
    rest = sum(scipy.integrate.quad(lambda v: MASS / (NORMAL * coefficient(v, width)), a, b, epsabs=1e-13)[0]
               for a, b in itertools.pairwise(edges))  # fmt: skip
    for accuracy in (1e-3, 1e-4, 1e-6):
        given = text.format(w=width)
        model = scene(SCENE.format(speed=speed, curve=given, accuracy=accuracy, engine=engine))
        result = model.run(out=None)
        stops = [event.t for event in result.events if event.zone_to == "held" and event.t > 0]
        assert stops == pytest.approx([rest], abs=accuracy)
        assert result["block.x"][-1] == pytest.approx(_way(coefficient, width, speed, edges), abs=accuracy)
        assert result.run["energy"]["closure"] < 10 * accuracy


def _way(coefficient, width, speed, edges):
    """Integral of m v/(N mu(v)) dv, with the sign of the speed."""
    parts = [scipy.integrate.quad(lambda v: MASS * v / (NORMAL * coefficient(v, width)), a, b, epsabs=1e-13)[0]
             for a, b in itertools.pairwise(edges)]  # fmt: skip
    return float(np.sign(speed)) * sum(parts)
