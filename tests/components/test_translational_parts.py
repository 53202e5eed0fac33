"""The translational parts of models/single_parts against closed forms of their scenes."""

import pathlib

import numpy as np
import pytest

import fairlead

SCENES = pathlib.Path(__file__).parents[2] / "models" / "single_parts"
G = 9.80665


def run(name, **settings):
    """A scene, with other values by their dotted names."""
    result = fairlead.load(SCENES / f"{name}.yaml", set={"run.accuracy": "1e-6", **settings}).run(out=None)
    assert result.ok
    assert result.run["energy"]["closure"] is None or result.run["energy"]["closure"] < 1e-4
    return result


@pytest.mark.slow
def test_a_lever_lifts_where_its_force_is_that_of_the_weight():
    """98 N on the short arm take 24.5 N on the long one; the pivot carries both."""
    result = run("lever")
    table = result.switches().to_pandas()
    leaves = float(table["first"][(table["component"] == "rests") & (table["zone_to"] == "free")].min())
    assert leaves * 80 == pytest.approx(24.5, rel=0.02)  # inertia of grip and pivot while the hand presses on
    lifts = (40 * 4 - 98) / (10 + 16 * 1)  # steadily, for the mass of the grip counts 16 times
    assert (result.at("stone.v", 1.0) - result.at("stone.v", 0.8)) / 0.2 == pytest.approx(lifts, rel=1e-3)


@pytest.mark.slow
def test_a_body_sinks_to_its_terminal_speed():
    result = run("drag")
    terminal = np.sqrt(200 / 20)
    assert np.allclose(result["body.v"], terminal * np.tanh(200 * result.t / 50 / terminal), rtol=1e-4, atol=1e-4)


@pytest.mark.slow
def test_a_spring_with_a_knee_swings_with_the_period_of_its_pieces():
    """Two straight pieces: a quarter of a period is a turn of each stiffness between its ends."""
    result = run("table_spring")
    soft, hard, knee, top = 100.0, 300.0, 0.1, 0.18
    energy = soft * knee**2 / 2 + (10 * (top - knee) + hard * (top - knee) ** 2 / 2)
    fast = np.sqrt(2 * energy)  # at no stretch, with a mass of 1 kg
    inside = np.arcsin(knee * np.sqrt(soft) / fast) / np.sqrt(soft)
    centre = knee - 10 / hard  # where the straight line of the hard piece meets no tension
    beyond = np.arccos((knee - centre) / (top - centre)) / np.sqrt(hard)
    signs = np.flatnonzero(np.diff(np.sign(result["mass.x"])))
    crossings = [np.interp(0, sorted(result["mass.x"][k : k + 2]), result.t[k : k + 2][:: 1 if result["mass.x"][k] < 0
                 else -1]) for k in signs]  # fmt: skip
    assert np.diff(crossings) == pytest.approx(2 * (inside + beyond), rel=1e-4)


@pytest.mark.parametrize(("angle", "stays"), [(10, True), (20, False), (-20, False)])
def test_a_sledge_comes_to_rest_or_slides_back(angle, stays):
    result = run("mass_on_slope", **{"sledge.angle": f"{angle} deg"})
    a = np.radians(angle)
    if angle > 0:
        stops = 5 / (G * (np.sin(a) + 0.2 * np.cos(a)))
        height = 5 * stops / 2
        back = 0 if stays else G * (np.sin(a) - 0.2 * np.cos(a)) * (3 - stops) ** 2 / 2
        assert result["sledge.x"][-1] == pytest.approx(height - back, rel=1e-4)
    else:
        assert result["sledge.v"][-1] == pytest.approx(5 + 3 * G * (np.sin(-a) - 0.2 * np.cos(a)), rel=1e-4)
    assert stays == (abs(result["sledge.v"][-1]) < 1e-9)
