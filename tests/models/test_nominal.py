"""What counts as 1: sizes that contacts say themselves, and sizes that a netlist gives by signal pattern."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fairlead.errors import ModelError

STICTION, NORMAL, FORCE, DAMPING = 0.5, 10.0, 4.0, 2e-3
STRAIGHT = """
components:
  ground: {{type: Ground}}
  block: {{type: Mass, mass: 1 kg}}
  pad: {{type: Contact, normal_force: 10 N, curve: 0.5}}
  push: {{type: ForceSource, force: {{sine: {{amplitude: 4 N, frequency: 0.2 Hz}}}}}}
connections: [[ground.flange, pad.a], [pad.b, block.flange, push.flange]]
friction: {{method: lugre, presliding: {presliding} m}}
run: {{stop: 10 s}}
record: {{signals: [block.x], every: 10 ms}}
"""
TURNING = """
components:
  wheel: {{type: Inertia, moment: 0.01 kg*m^2}}
  brake: {{type: Brake, radius: 0.1 m, normal_force: 10 N, curve: 0.5}}
  push: {{type: TorqueSource, torque: {{sine: {{amplitude: 0.4 N*m, frequency: 0.2 Hz}}}}}}
connections: [[wheel.shaft, brake.shaft, push.shaft]]
friction: {{method: lugre, presliding: {presliding} m}}
run: {{stop: 10 s}}
record: {{signals: [wheel.angle], every: 10 ms}}
"""


def presliding_of_lugre(presliding, times):
    """The equations of LuGre with one coefficient and a block of 1 kg, by a method of another library.

    In units of the presliding way g and of g w, with w = sqrt(s0/m).
    """
    w = math.sqrt(NORMAL * STICTION / presliding)

    def rates(t, y):
        _, v, z = y
        dz = w * (v - abs(v) * z)
        return [w * v, w * (FORCE / (NORMAL * STICTION) * math.sin(0.4 * math.pi * t) - z - DAMPING * dz), dz]

    return presliding * solve_ivp(rates, (0, times[-1]), [0, 0, 0], "LSODA", times, rtol=1e-8, atol=1e-9).y[0]


@pytest.mark.parametrize(
    ("text", "signal", "radius", "presliding"),
    [(STRAIGHT, "block.x", 1.0, 2e-5), (STRAIGHT, "block.x", 1.0, 2e-7), (STRAIGHT, "block.x", 1.0, 2e-2),
     (TURNING, "wheel.angle", 0.1, 2e-5)],
    ids=["20 um", "0.2 um", "20 mm", "a brake"],
)  # fmt: skip
def test_presliding_is_as_accurate_as_the_run_whatever_its_size(scene, text, signal, radius, presliding):
    """A slow force below stiction, at the accuracy of a netlist that says nothing; relative to the way it makes."""
    result = scene(text.format(presliding=presliding)).run(out=None)
    expected = presliding_of_lugre(presliding, result.t)
    error = np.abs(radius * np.asarray(result[signal]) - expected).max() / np.ptp(expected)
    assert error < 1e-4


def nominal_of(model):
    system = model.system
    return dict(zip((one.name for one in system.numbering.unknowns), system.scales.nominal.tolist(), strict=True))


@pytest.mark.slow
def test_contacts_say_what_is_small(scene):
    """Presliding for positions and bristles, the speed of a curve for speeds, both where it slides."""
    text = STRAIGHT.format(presliding=3e-6)
    sizes = nominal_of(scene(text))
    assert (sizes["block.x"], sizes["pad.z"], sizes["block.v"]) == (3e-6, 3e-6, 0.1)
    curve = "{curve: stribeck, stiction: 0.5, coulomb: 0.4, velocity: 2 mm/s}"
    assert nominal_of(scene(text.replace("curve: 0.5", f"curve: {curve}")))["block.v"] == 2e-3
    turning = nominal_of(scene(TURNING.format(presliding=3e-6)))
    assert turning["wheel.angle"] == pytest.approx(3e-5)
    assert nominal_of(scene(text.replace("lugre, presliding: 3e-06 m", "hold")))["block.x"] == 1e-2
    model = scene("parameters: {small: 3 um}\n" + text.replace("presliding: 3e-06 m", 'presliding: "{small}"'))
    changed = model.with_values(small="5 um")
    assert (nominal_of(changed)["block.x"], nominal_of(changed)["pad.z"]) == pytest.approx((5e-6, 5e-6))


def test_a_netlist_says_what_is_small(scene):
    """By pattern; that with more letters counts, and of names that move as one the least size."""
    text = STRAIGHT.format(presliding=3e-6)
    given = 'nominal: {"block.x": 1 um, "*.x": 7 mm, "*.v": 1 mm/s, pad.z: 2 um}\n'
    sizes = nominal_of(scene(text + given))
    assert (sizes["block.x"], sizes["block.v"], sizes["pad.z"]) == (1e-6, 1e-3, 2e-6)
    assert nominal_of(scene(text + 'nominal: {"*.x": 7 mm}\n'))["block.x"] == 7e-3  # who says it knows better
    gear = nominal_of(scene(TURNING.format(presliding=3e-6) + "nominal: {brake.contact.b.x: 1 um}\n"))
    assert gear["wheel.angle"] == pytest.approx(1e-5)  # at a radius of 0.1 m
    weights = scene(text + given).system.scales.weights(1e-3).absolute
    assert weights.min() == pytest.approx(1e-9)
    assert scene("parameters: {small: 1 um}\n" + text + 'nominal: {block.x: "{small}"}\n', small="4 um").check() == []


REFUSED = {
    "nominal: {blok.x: 1 um}": "nominal.blok.x: no unknown has this name. Did you mean block.x?",
    "nominal: {pad.slip: 1 um/s}": "nominal.pad.slip is an output, which follows from the unknowns.",
    "nominal: {block.x: 1 N}": "nominal.block.x = 1 N is a force, not a length.",
    "nominal: {block.x: 0 m}": "nominal.block.x = 0 m is no size.",
    'nominal: {"block.*": 1 um}': "nominal.block.* = 1 um is a length, not a speed.",
    'nominal: {"bloc?.x": 1 um, "?lock.x": 2 um}': "contradicts nominal.bloc?.x, and both fit block.x",
    "nominal: {ground.flange.x: 1 um}": "nominal.ground.flange.x: this motion is prescribed by ground.",
}


@pytest.mark.parametrize("given", REFUSED)
def test_what_has_no_size_is_told_with_its_line(scene, given):
    with pytest.raises(ModelError) as told:
        scene(STRAIGHT.format(presliding=3e-6) + given + "\n").system  # noqa: B018 - making it is what refuses
    assert REFUSED[given] in str(told.value)
    assert "scene0.yaml:" in str(told.value)
