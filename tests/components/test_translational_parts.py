"""The translational parts of models/single_parts against closed forms of their scenes."""

import pathlib

import numpy as np
import pytest
from scipy.integrate import solve_ivp

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


def test_a_flange_goes_where_and_as_signals_tell():
    result = run("motion_by_signal")
    t, lag = 0.08, 0.02
    ramp = 3 * (t - 2 * lag + np.exp(-t / lag) * (2 * lag + t))
    assert result.at("table.x", t) == pytest.approx(ramp, rel=1e-5)
    assert result.at("belt.x", 1.0) == pytest.approx(2 * (1 - 0.05 * (1 - np.exp(-20))), rel=1e-6)
    assert result.at("belt.force", 0.1) == pytest.approx(2 * 2 / 0.05 * np.exp(-2), rel=1e-5)
    assert result.at("shaker.x", 1.0) == pytest.approx(8 / (2 * np.pi), rel=1e-6)
    assert result["parcel.x"][-1] == pytest.approx(0.3, abs=1e-4)


def rebound(speed, mass, stiffness, damping):
    """Speed at which a mass leaves an ElasticGap without weight, piece by piece."""

    def until(law, x, v, ends):
        ends.terminal = True
        said = solve_ivp(lambda t, y: (y[1], -law(*y) / mass), (0, 1), (x, v), events=ends, rtol=1e-10, atol=1e-13)
        return said.y[:, -1]

    x, v = 0.0, speed
    if damping > 0:
        x, v = until(lambda x, v: 2 * stiffness * x, x, v, lambda t, y: damping * y[1] - stiffness * y[0])
    x, v = until(lambda x, v: stiffness * x + damping * v, x, v, lambda t, y: stiffness * y[0] + damping * y[1])
    return -v  # it opens: nothing acts any more


@pytest.mark.parametrize("damping", [40, *(pytest.param(d, marks=pytest.mark.slow) for d in (5, 150))])
def test_a_ball_leaves_an_elastic_gap_with_the_speed_of_its_pieces(damping):
    result = run("elastic_gap", **{"bump.damping": f"{damping} N*s/m", "weight.force": "0 N",
                                   "ball.velocity": "-2 m/s"})  # fmt: skip
    assert result["ball.v"][-1] == pytest.approx(rebound(2, 0.5, 2e4, damping), rel=1e-5)
    assert result["bump.force"].min() >= 0


@pytest.mark.slow
def test_a_pin_crosses_its_play_before_it_drives():
    """Half the play ahead the pin meets; where it turns the slide, without inertia to speak of, stays."""
    result = run("elastic_gap")
    table = result.switches().to_pandas()
    meets = float(table["first"][(table["component"] == "pin") & (table["zone_to"] == "drive")].min())
    assert 0.01 * np.sin(2 * np.pi * meets) == pytest.approx(0.002, rel=1e-5)
    assert result.at("slide.x", 0.3) == pytest.approx(0.008, rel=5e-3)


@pytest.mark.parametrize("stops", ["rigid", pytest.param("elastic", marks=pytest.mark.slow)])
def test_a_slide_gives_back_its_share_at_a_stop_and_comes_to_rest_by_friction(simulate, stops):
    """v^2 falls by 2 F s/m on the way; a rigid stop gives back its share, an elastic one without damping all."""
    result = simulate(f"""
        components:
          slide: {{type: MassWithStops, mass: 2 kg, upper: 0.1 m, sliding: 4 N, stops: {stops}, restitution: 0.5,
                  damping: 0, stiffness: 1e10 N/m, position: 0, velocity: 1 m/s}}
          free: {{type: ForceSource, force: 0 N}}
        connections: [[slide.flange, free.flange]]
        run: {{stop: 1 s, accuracy: 1e-6}}
    """)
    back = (0.25 if stops == "rigid" else 1) * (1 - 2 * 4 * 0.1 / 2)
    way = min(back / (2 * 4 / 2), 0.1)
    again = max(back - 2 * 4 * 0.1 / 2, 0) * (1 if stops == "elastic" else 0.25)  # it comes to the other stop
    assert result["slide.x"][-1] == pytest.approx(0.1 - way + again / 4, rel=2e-3)
    assert result["slide.v"][-1] == pytest.approx(0, abs=1e-9)


@pytest.mark.slow
def test_a_slide_that_is_driven_to_and_fro_stays_between_its_stops():
    result = run("mass_with_stops")
    assert np.abs(result["slide.x"]).max() <= 0.01 + 1e-9
    assert np.abs(result["slide.friction"]).max() <= 4 + 5 * np.abs(result["slide.v"]).max()
    assert (result["slide.v"] == 0).any()
