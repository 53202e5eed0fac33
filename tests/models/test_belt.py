"""Stick-slip on a belt: exact times, and everything the run directory says about them.

The scene is the bundled `belt`; its closed form is `tests/reference/belt.py` (physics section 8, item 4).
"""

import csv

import numpy as np
import pytest

from tests.reference.belt import StickSlipBelt

FINE = {"run.accuracy": 1e-8, "run.stop": "41 s"}  # 50 whole cycles and a breakaway
CYCLES = 50

BELT = """
    parameters: {speed: 0.05 m/s, method: hold, creep: 1e-6 m/s}
    components:
      wall: {type: Ground}
      spring: {type: Spring, stiffness: 100 N/m}
      block: {type: Mass, mass: 1 kg, position: 0 m, velocity: "{speed}"}
      belt: {type: MotionSource, velocity: "{speed}"}
      pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: 0.5, coulomb: 0.3}}
    connections: [[wall.flange, spring.a], [spring.b, block.flange, pad.b], [belt.flange, pad.a]]
    friction: {method: "{method}"}
    run: {stop: 12 s, accuracy: 1e-8}
"""


def switches(result, zone_from: str, zone_to: str) -> np.ndarray:
    """Times [s] at which the pad went from one zone to the other."""
    return np.array([e.t for e in result.events if (e.zone_from, e.zone_to) == (zone_from, zone_to)])


def test_every_stick_and_every_slip_lasts_as_long_as_it_must(bundled) -> None:
    exact, result = StickSlipBelt(), bundled("belt", FINE)
    breaks, catches = switches(result, "held", "backward"), switches(result, "backward", "held")
    assert len(breaks) == CYCLES + 1
    assert len(catches) == CYCLES
    np.testing.assert_allclose(catches - breaks[:-1], exact.slip_time, rtol=1e-6)
    np.testing.assert_allclose(breaks[1:] - catches, exact.stick_time, rtol=1e-6)


def test_fifty_cycles_do_not_drift(bundled) -> None:
    """Errors of single switches would add up; 1e-8 of the run is what the accuracy promises."""
    exact, result = StickSlipBelt(), bundled("belt", FINE)
    np.testing.assert_allclose(switches(result, "held", "backward"), exact.breakaways(CYCLES + 1), rtol=1e-8)


def test_the_block_is_where_the_closed_form_says_at_all_times(bundled) -> None:
    exact, result = StickSlipBelt(), bundled("belt", FINE)
    smooth = result.side == 0  # at a switch itself friction has two values; see the test on both sides
    t = result.t[smooth]
    # 0.1 m of swing and 1 m/s of speed at relative 1e-8, times 50 cycles of accumulation.
    np.testing.assert_allclose(result["block.x"][smooth], exact.position(t), atol=5e-8)
    np.testing.assert_allclose(result["block.v"][smooth], exact.velocity(t), atol=5e-7)
    np.testing.assert_allclose(result["pad.friction"][smooth], -exact.friction(t), atol=1e-5)


@pytest.mark.parametrize("speed", [0.02, 0.05, 0.1])
def test_slower_belts_slip_longer_and_stick_longer(simulate, speed: float) -> None:
    exact = StickSlipBelt(speed=speed, stiction=5.0, coulomb=3.0)
    result = simulate(BELT, speed=f"{speed} m/s")
    breaks, catches = switches(result, "held", "backward"), switches(result, "backward", "held")
    np.testing.assert_allclose(np.diff(breaks), exact.period, rtol=1e-6)
    np.testing.assert_allclose(catches - breaks[: len(catches)], exact.slip_time, rtol=1e-6)
    tension = result["spring.tension"][result.t >= breaks[0]]
    inertia = speed * np.sqrt(100.0 * 1.0)
    # The spring swings past both ends of the stick by the inertia of the block; sampled at steps, so from inside.
    assert tension.max() <= 3.0 + np.hypot(2.0, inertia) + 1e-6
    assert tension.max() == pytest.approx(3.0 + np.hypot(2.0, inertia), rel=5e-3)


@pytest.mark.slow
def test_binding_comes_to_the_same_times_as_its_creep_vanishes(simulate) -> None:
    """Binding is first order in its creep: the period is short by about what the block crept in a stick."""
    exact = StickSlipBelt(speed=0.05, stiction=5.0, coulomb=3.0)
    short = []
    for creep in ("1e-5 m/s", "1e-6 m/s"):
        result = simulate(BELT.replace('method: "{method}"', 'method: binding, creep: "{creep}"'), creep=creep)
        breaks = np.array([e.t for e in result.events if e.zone_to.startswith("break")])
        short.append(abs(np.diff(breaks).mean() / exact.period - 1))
    assert short[0] < 1e-3
    assert short[0] / short[1] == pytest.approx(10, rel=0.2)


def test_every_switch_is_in_the_zone_log(bundled) -> None:
    result = bundled("belt", FINE)
    with (result.path / "events.csv").open(newline="") as file:
        header, *rows = csv.reader(file)
    assert header == ["t [s]", "component", "from", "to", "guard"]
    assert len(rows) == result.run["switches"] == 2 * CYCLES + 1
    assert {row[1] for row in rows} == {"pad"}
    assert {tuple(row[2:]) for row in rows} == {
        ("held", "backward", "breaks_backward"), ("backward", "held", "stops_backward"),
    }  # fmt: skip
    times = [float(row[0]) for row in rows]
    assert times == sorted(times)


def test_the_zone_log_and_the_signals_tell_the_same_story(bundled) -> None:
    """Between two lines of the log the zone is the one the first leads to: no switch is left out."""
    result = bundled("belt", FINE)
    times = np.array([e.t for e in result.events])
    held = np.array([True, *(e.zone_to == "held" for e in result.events)])
    smooth = result.side == 0
    expected = held[np.searchsorted(times, result.t[smooth])]
    np.testing.assert_array_equal(result["pad.bound"][smooth], expected)


def test_time_repeats_at_a_switch_with_the_values_of_both_sides(bundled) -> None:
    result = bundled("belt", FINE)
    times = [e.t for e in result.events]
    np.testing.assert_array_equal(result.t[result.side == -1], times)
    np.testing.assert_array_equal(result.t[result.side == +1], times)
    left, right = result.at("pad.friction", times[0], side="both")
    assert left == pytest.approx(-10.0, abs=1e-6)  # stiction, just reached
    assert right == pytest.approx(-6.0, abs=1e-12)  # sliding friction
    assert np.diff(result.at("block.x", times, side="both")).max() == 0.0  # nothing jumps but the force


def test_slip_is_zero_while_the_block_sticks(bundled) -> None:
    result = bundled("belt", FINE)
    assert np.abs(result["pad.slip"][result["pad.bound"] == 1]).max() < 1e-12


def test_two_runs_are_equal_to_the_last_bit(scene, tmp_path) -> None:
    for k in range(2):
        scene(BELT).run(out=tmp_path / f"again{k}")
    one, two = (tmp_path / f"again{k}" for k in range(2))
    assert (one / "events.csv").read_bytes() == (two / "events.csv").read_bytes()
    from fairlead.results import Result

    one, two = Result.open(one), Result.open(two)
    np.testing.assert_array_equal(one.t, two.t)
    np.testing.assert_array_equal(one.columns(), two.columns())
    assert one.run["counters"] == two.run["counters"]


def test_a_model_runs_twice_to_the_same_end(scene, tmp_path) -> None:
    """A run leaves nothing behind in the model it was made from."""
    model = scene(BELT)
    one, two = (model.run(out=tmp_path / f"twice{k}") for k in range(2))
    np.testing.assert_array_equal(one.columns(), two.columns())
