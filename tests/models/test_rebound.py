"""Rebound by Moreau's law: balls that bounce, chains of balls, several impacts at once, and what is refused.

Closed forms: a ball from height h over a wall with coefficient e hits it at t0 = sqrt(2 h/g) and then after 2 e^k t0;
two balls exchange (1 + e)/2 of their relative speed; the energy lost in an impact is (1 - e^2)/2 m_red dv^2.
"""

import itertools
import math

import numpy as np
import pytest

from tests.scenes.blows import blow
from tests.scenes.impulses import impacts

ENGINES = ("rodas", "ida")
G = 9.81


def ball(restitution, stop="2 s", accuracy="1e-6"):
    return f"""
    components:
      ball: {{type: Mass, mass: 2 kg, position: 1 m, velocity: 0 m/s}}
      weight: {{type: ForceSource, force: {-2 * G} N}}
      floor: {{type: Ground}}
      bounce: {{type: RigidStop, restitution: {restitution}}}
    connections:
      - [ball.flange, weight.flange, bounce.b]
      - [floor.flange, bounce.a]
    run: {{stop: {stop}, accuracy: {accuracy}}}
    record: {{signals: ["*"]}}
    """


def hits(result, component):
    return [event.t for event in result.events if event.component == component and event.zone_to == "touching"]


@pytest.mark.parametrize("engine", ENGINES)
def test_a_ball_bounces_in_times_that_shrink_geometrically(simulate, engine) -> None:
    e, first = 0.8, math.sqrt(2 / G)
    result = simulate(ball(e), **{"run.engine": engine})
    expected = first * (1 + 2 * np.cumsum([0.0, *(e**k for k in range(1, 5))]))
    assert hits(result, "bounce")[:4] == pytest.approx(expected[:4][expected[:4] < 2.0], abs=1e-5)
    assert result.run["energy"]["closure"] < 1e-6


def test_a_ball_comes_to_rest_at_the_sum_of_the_series(simulate) -> None:
    """All bounces are over at t0 (1 + e)/(1 - e); then it lies, and all its energy is lost at the stop."""
    e, first = 0.5, math.sqrt(2 / G)
    result = simulate(ball(e))
    assert hits(result, "bounce")[-1] == pytest.approx(first * (1 + e) / (1 - e), abs=1e-5)
    assert result["ball.v"][-1] == pytest.approx(0.0, abs=1e-9)
    assert result["ball.x"][-1] == pytest.approx(0.0, abs=1e-8)
    assert result["bounce.force"][-1] == pytest.approx(2 * G, rel=1e-6)
    assert result.run["lost"]["bounce"] == pytest.approx(2 * G, rel=1e-5)


@pytest.mark.parametrize("engine", ENGINES)
def test_without_loss_a_ball_bounces_for_ever(simulate, engine) -> None:
    result = simulate(ball(1, stop="20 s"), **{"run.engine": engine})
    first = math.sqrt(2 / G)
    assert hits(result, "bounce") == pytest.approx([first * (1 + 2 * k) for k in range(22)], abs=1e-4)
    assert result.run["lost"] == {} or result.run["lost"]["bounce"] == pytest.approx(0.0, abs=1e-9)


def chain(masses, places, speeds, restitution, stop="1 s"):
    names = [f"ball{i}" for i in range(len(masses))]
    parts = [f"{n}: {{type: Mass, mass: {m} kg, position: {x} m, velocity: {v} m/s}}"
             for n, m, x, v in zip(names, masses, places, speeds, strict=True)]  # fmt: skip
    given = restitution if isinstance(restitution, list) else [restitution] * (len(names) - 1)
    parts += [f"stop{i}: {{type: RigidStop, restitution: {e}}}" for i, e in enumerate(given)]
    joins = [port for i, (a, b) in enumerate(itertools.pairwise(names))
             for port in (f"[{a}.flange, stop{i}.a]", f"[{b}.flange, stop{i}.b]")]  # fmt: skip
    lines = ["components:", *("  " + part for part in parts), "connections:", *("  - " + join for join in joins)]
    return "\n".join([*lines, f"run: {{stop: {stop}, accuracy: 1e-6}}", 'record: {signals: ["*"]}']) + "\n"


@pytest.mark.parametrize("engine", ENGINES)
def test_a_blow_runs_through_a_row_of_equal_balls_with_gaps(simulate, engine) -> None:
    """Newton's cradle: with gaps each impact is one of two, and the last ball leaves with the speed of the first."""
    text = chain([1] * 5, [0, 0.1, 0.2, 0.3, 0.4], [2, 0, 0, 0, 0], 1)
    result = simulate(text, **{"run.engine": engine})
    assert [result[f"ball{i}.v"][-1] for i in range(5)] == pytest.approx([0, 0, 0, 0, 2], abs=1e-7)
    assert result.run["energy"]["closure"] < 1e-9


@pytest.mark.parametrize("e", [0.0, 0.3, 1.0])
def test_two_unequal_balls_part_at_e_times_the_speed(simulate, e) -> None:
    result = simulate(chain([1, 3], [0, 1], [4, -2], e, stop="0.5 s"))
    one, two = (result[f"ball{i}.v"][-1] for i in range(2))
    assert two - one == pytest.approx(e * 6, abs=1e-7)
    assert one + 3 * two == pytest.approx(4 - 6, abs=1e-7)
    assert result.run["energy"]["dissipated"] == pytest.approx((1 - e**2) / 2 * 0.75 * 36, abs=1e-6)


@pytest.mark.parametrize("engine", ENGINES)
def test_three_balls_that_meet_at_once_keep_their_energy(simulate, engine) -> None:
    """Two of 1 kg run from both sides into one of 2 kg at rest: mirrored, so each goes back as it came."""
    result = simulate(chain([1, 2, 1], [-0.5, 0, 0.5], [3, 0, -3], 1, stop="0.4 s"), **{"run.engine": engine})
    assert [result[f"ball{i}.v"][-1] for i in range(3)] == pytest.approx([-3, 0, 3], abs=1e-7)


def test_balls_that_touch_take_a_blow_together(simulate) -> None:
    """By Moreau's law the struck pair, which touched, goes on as one: v+ = v- + 2 dV, dV of three that stick."""
    result = simulate(chain([1, 1, 1], [0, 0.5, 0.5], [3, 0, 0], 1, stop="0.5 s"))
    assert [result[f"ball{i}.v"][-1] for i in range(3)] == pytest.approx([-1, 2, 2], abs=1e-7)


def test_the_least_coefficient_of_one_impact_counts(simulate) -> None:
    result = simulate(chain([1, 2, 1], [-0.5, 0, 0.5], [3, 0, -3], [1, 0.5], stop="0.4 s"))
    assert [result[f"ball{i}.v"][-1] for i in range(3)] == pytest.approx([-1.5, 0, 1.5], abs=1e-7)


def test_impacts_that_nothing_joins_keep_their_own_coefficients(simulate) -> None:
    """The same instant, two pairs apart: a mirror in which one pair has no loss and the other no rebound."""
    text = chain([1, 1, 1, 1], [0, 0.5, 9, 9.5], [1, -1, 1, -1], [1, 1, 0], stop="0.5 s")
    result = simulate(text)
    assert [result[f"ball{i}.v"][-1] for i in range(4)] == pytest.approx([-1, 1, 0, 0], abs=1e-7)


def test_a_wall_that_moves_throws_back_faster(simulate) -> None:
    """1 kg at 10 m/s meets a wall that comes at 4 m/s: it leaves at -4 - e 14, and the wall gives what is missing."""
    text = """
    components:
      one: {type: Mass, mass: 1 kg, position: -7 m, velocity: 10 m/s}
      wall: {type: MotionSource, velocity: -4 m/s, origin: 0 m}
      stop: {type: RigidStop, restitution: 0.5}
    connections: [[one.flange, stop.a], [wall.flange, stop.b]]
    run: {stop: 1 s, accuracy: 1e-6}
    record: {signals: ["*"]}
    """
    result = simulate(text)
    assert result["one.v"][-1] == pytest.approx(-4 - 0.5 * 14, abs=1e-7)
    energy = result.run["energy"]
    assert energy["dissipated"] == pytest.approx(0.75 / 2 * 14**2, rel=1e-9)
    assert energy["supplied"] == pytest.approx(1.5 * 14 * 4, rel=1e-9)


def test_rebound_with_friction_under_the_same_impulse_is_refused(scene, tmp_path) -> None:
    text = """
    components:
      into: {type: Mass, mass: 1 kg, position: -1 m, velocity: 5 m/s}
      along: {type: Mass, mass: 1 kg, position: 0 m, velocity: 2 m/s}
      wall: {type: Ground}
      side: {type: Ground}
      stop: {type: RigidStop, restitution: 0.5}
      rub: {type: Contact, curve: 0.3}
    connections:
      - [into.flange, stop.a]
      - [wall.flange, stop.b]
      - [side.flange, rub.a]
      - [along.flange, rub.b]
      - [stop.force, rub.normal]
    run: {stop: 0.3 s, accuracy: 1e-6}
    record: {signals: ["*"]}
    """
    result = scene(text).run(out=tmp_path / "run", check=False)
    assert result.status == "failed"
    assert "stop rebounds while friction takes part" in result.run["sentence"]


@pytest.mark.parametrize("seed", [0, 1, 2, 3, 4, 7, 8, 9, 10, 11])
def test_no_impact_of_a_random_scene_creates_energy(seed, scene, tmp_path) -> None:
    """Stops that rebound in scenes of random blows, rings and doubled stops among them."""
    made = blow(seed)
    text = made.text.replace("type: RigidStop,", "type: RigidStop, restitution: 0.6,").partition("components:")
    result = scene(text[1] + text[2], **{"run.engine": "rodas", "run.accuracy": "1e-6"}).run(out=tmp_path / "run")
    assert result.status == "finished", result.run["sentence"]
    assert max((impact.gained(made.mass) for impact in impacts(made, result)), default=0.0) < 1e-9
    assert (result.run["energy"]["closure"] or 0.0) < 1e-5
