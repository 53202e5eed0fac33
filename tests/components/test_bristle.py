"""The seeded bristle against the averages of its own random law, and against what a spring of bonds must do."""

import numpy as np
import pytest
from fairlead.components.friction.bristle import level_of, stretch_of

from fairlead.errors import ModelError

DRIVEN = """
    parameters: {seed: 3, level: 0.3, stop: 1 s}
    components:
      ground: {type: Ground}
      pad:
        type: Contact
        method: bristle
        normal_force: 10 N
        seed: "{seed}"
        curve: {curve: coulomb, stiction: 0.5, coulomb: "{level}"}
      move: {type: MotionSource, position: {table: {t: [0, 1, 2], y: [0, 4 mm, 0 mm]}}}
    connections: [[ground.flange, pad.a], [pad.b, move.flange]]
    run: {stop: "{stop}", accuracy: 1e-6}
"""
PRESLIDING = 2e-5


def mean(result, begin, end):
    """Mean friction over a time in which the slip is steady."""
    t = np.linspace(begin, end, 100_001)
    return float(np.interp(t, result.t, result["pad.friction"]).mean())


def test_the_published_ratio_of_bonds_goes_with_the_published_stretch():
    """F_c/F_s = (1 - rho^2/3)/(2 - rho); rho = 0.442 for 0.6."""
    assert stretch_of(0.6) == pytest.approx((0.0, 0.442), abs=5e-4)
    rng = np.random.default_rng(0)
    for level in (0.3, 0.5, 0.6, 2 / 3, 0.8, 0.95):
        low, high = stretch_of(level)
        assert level_of(low, high) == pytest.approx(level, rel=1e-12)
        u = rng.uniform(low, high, 1_000_000)
        assert (1 - u**2).mean() / (2 * (1 - u).mean()) == pytest.approx(level, rel=2e-3)  # a million draws


@pytest.mark.parametrize(("level", "seed"), [(0.3, 3), (0.4, 4)])
def test_friction_rises_to_stiction_and_settles_at_the_mean_of_the_random_law(simulate, level: float, seed: int):
    result = simulate(DRIVEN, level=level, seed=seed)
    first = result.t < PRESLIDING / 4e-3 * 0.999
    np.testing.assert_allclose(result["pad.friction"][first], 5.0 * 4e-3 * result.t[first] / PRESLIDING, rtol=1e-6)
    assert result["pad.friction"].max() == pytest.approx(5.0, rel=1e-6)  # all bonds at once, the first time
    # 25 bonds, some 200 stretches each: the mean is met within about a half per cent.
    assert mean(result, 0.2, 1.0) == pytest.approx(10 * level, rel=0.015)


def test_a_seed_decides_where_bonds_form(simulate):
    one, same, other = (simulate(DRIVEN, seed=seed, stop="0.2 s") for seed in (3, 3, 4))
    np.testing.assert_array_equal(one["pad.friction"], same["pad.friction"])
    assert len(one.events) != len(other.events) or one.events[-1].t != other.events[-1].t


@pytest.mark.slow
def test_friction_turns_with_the_slip_and_never_gives_more_than_it_took(simulate):
    result = simulate(DRIVEN, stop="2 s")
    assert mean(result, 1.1, 2.0) == pytest.approx(-3.0, rel=0.015)
    # Passive: of what was put in, no more comes back than bent bonds hold, and they hold something positive.
    stored = 5.0 / PRESLIDING * result["pad.deflection"] ** 2 / 2  # at least that, by the mean of the squares
    assert (result["energy.dissipated"] >= stored - 1e-12).all()


def test_slip_beyond_the_last_site_ends_the_run_with_the_reason(scene, tmp_path):
    result = scene(DRIVEN, **{"pad.travel": "1 mm"}).run(out=tmp_path / "run", check=False)
    assert result.status == "failed"
    assert 0.9e-3 < result["move.x"][-1] < 1.1e-3
    assert "no sites beyond `travel`" in result.run["sentence"]


def test_a_curve_that_falls_too_far_for_bonds_is_refused(scene):
    with pytest.raises(ModelError, match=r"friction falls to 0\.2 of stiction in sliding, which bonds cannot"):
        scene(DRIVEN, level=0.1).check()


def test_slip_beyond_the_travel_is_named_and_not_taken_for_a_division_by_zero(scene):
    text = DRIVEN.replace("normal_force: 10 N", "normal_force: 10 N, travel: 0.1 mm".replace(", ", "\n        "))
    run = scene(text, stop="0.1 s").run(out=None, check=False).run
    assert run["status"] == "failed"
    assert "pad moved beyond the range in which its law has values" in run["sentence"]
    assert "no sites beyond `travel` of slip; give it more" in run["sentence"]
    assert "divides by zero" not in run["sentence"]
    assert run["culprits"] == ["pad"]
