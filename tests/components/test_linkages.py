"""Linkages of models/single_parts: their places, and the energy that they do not lose."""

import pathlib

import numpy as np
import pytest

import fairlead
from fairlead.errors import ModelError

SCENES = pathlib.Path(__file__).parents[2] / "models" / "single_parts"
G = 9.80665


def run(name, **settings):
    """A scene, with other values by their dotted names."""
    result = fairlead.load(SCENES / f"{name}.yaml", set={"run.accuracy": "1e-6", **settings}).run(out=None)
    assert result.ok
    return result


@pytest.mark.slow
def test_a_cam_lifts_its_follower_and_takes_from_the_shaft_what_the_spring_gets():
    result = run("linkages")
    angle, w = result["camshaft.angle"], result["camshaft.speed"]
    place, speed = 1e-3 + 5e-3 * (1 - np.cos(angle)), 5e-3 * np.sin(angle) * w
    assert np.allclose(result["valve.x"], place, atol=1e-7)
    energy = 0.01 * w**2 / 2 + 0.2 * speed**2 / 2 + 2000 * place**2 / 2
    assert np.allclose(energy, energy[0], rtol=1e-6)


def test_two_arms_that_swing_far_lose_nothing():
    """From -1 rad over the top to where the energy is the same again: +1 + pi."""
    result = run("linkages")
    angle, w = result["beam.angle"], result["beam.speed"]
    moves = 0.5 + 5 * (0.3 * np.cos(angle)) ** 2 + (0.6 * np.cos(angle)) ** 2
    energy = moves * w**2 / 2 - 20 * 0.6 * np.sin(angle)
    assert np.allclose(energy, energy[0], atol=1e-5)
    assert np.allclose(result["lifted.x"], -0.6 * np.sin(angle), atol=1e-7)
    assert np.ptp(angle) > 2


@pytest.mark.slow
@pytest.mark.parametrize("angle", ["0.1 rad", "-0.6 rad", "0.9 rad"])
def test_a_cylinder_holds_an_arm_with_the_torque_of_its_weight_over_its_leverage(angle):
    """Virtual work: force times d(length)/d(angle), by differences, is m g l cos(angle)."""
    at = float(angle.split()[0])
    length = lambda q: np.sqrt(0.8**2 + 0.6**2 - 2 * 0.8 * 0.6 * np.cos(q + 1.5708))  # noqa: E731
    leverage = (length(at + 1e-5) - length(at - 1e-5)) / 2e-5
    needs = 200 * G * 2 * np.cos(at) / leverage
    level = 1e5 + needs / (np.pi * 0.08**2 / 4)
    result = run("arm_with_cylinder", **{
        "boom.angle": angle, "wanted.value": f"{level}", "lift.pressure": f"{level} Pa", "run.stop": "2 s",
        "length.length": f"{length(at) - 0.2} m"})  # fmt: skip
    assert np.allclose(result["boom.angle"], at, atol=2e-3)
    assert result["strut.leverage"][0] == pytest.approx(leverage, rel=1e-5)
    assert np.mean(result["lift.pressure"]) == pytest.approx(level, rel=1e-3)


def test_an_arm_without_a_length_is_refused():
    with pytest.raises(ModelError, match="radius is zero"):
        fairlead.load(SCENES / "linkages.yaml", set={"near.radius": "0 m"}).check()
