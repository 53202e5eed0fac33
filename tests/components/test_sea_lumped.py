"""Drag of the sea that is lumped at the end of a line: of all line in the water, and of no more."""

import math

import numpy as np
import pytest

DIAMETER, DENSITY, SPEED = 0.085, 1025.0, 4.0
EACH = 0.5 * DENSITY * 0.003 * math.pi * DIAMETER  # drag per metre and speed squared [kg/m^2]


def held(sea, length, start=1.0, motion="0 m/s", stop=6, mass="1 kg/m"):
    """A rope in the sea, held or moved at its inboard end."""
    return f"""
        components:
          rope:
            {{type: Cable, mass: {mass}, stiffness: 200 kN, damping_ratio: 0.3, diameter: 85 mm, length: {length} m,
             element: 0.5 m, start: {start} m, tension: 100 N}}
          route: {{type: Route, stations: [{{type: Sea, start: 5 m, speed: {SPEED} m/s, tail: 100 N{sea}}}]}}
          haul: {{type: MotionSource, velocity: {motion}}}
        connections: [[rope.path, route.path], [haul.flange, rope.inboard]]
        run: {{stop: {stop} s}}
        record: {{every: 10 ms}}
    """


def test_modelled_line_in_the_sea_counts_in_the_lumped_form(simulate):
    """6 m of the line lie in the water: at the haul the pull is that of the distributed form."""
    want = 100 + EACH * 6 * SPEED**2
    for form in ("", ", form: lumped"):
        assert -simulate(held(form, 10))["haul.force"][-1] == pytest.approx(want, rel=1e-4)


def test_modelled_line_in_the_sea_and_line_behind_it_add_up(simulate):
    """With 2 m modelled and 4 m behind."""
    result = simulate(held(", form: lumped, beyond: 4 m", 6))
    assert -result["haul.force"][-1] == pytest.approx(100 + EACH * 6 * SPEED**2, rel=1e-4)
    length = 4 + result["rope.node[12].x"][-1] - 5  # 6 m and the stretch of what is held
    assert result["rope.tail.drag"][-1] == pytest.approx(EACH * length * SPEED**2, rel=1e-6)


def test_line_hauled_out_of_the_sea_has_no_drag_and_never_one_that_pushes(simulate):
    """The end lies 0.5 m in the water and is hauled in by 1 m with 0.5 m/s; it leaves after 1 s."""
    motion = "{trapezoid: {to: -0.5 m/s, rise: 1 ms, stay: 2 s, fall: 1 ms}}"
    result = simulate(held(", form: lumped", 4.5, motion=motion, stop=3))
    assert result["rope.tail.drag"].min() >= 0.0
    assert result["rope.tail.drag"][-1] == 0.0
    assert -result["haul.force"][-1] == pytest.approx(100, rel=1e-3)
    (out,) = [event.t for event in result.events if event.component == "rope.tail" and event.t > 0]
    assert out == pytest.approx(1.0, abs=5e-3)  # it stretches by 0.5 mm for each 20 N


def test_line_paid_out_from_the_deck_has_drag_from_where_the_sea_begins(simulate):
    """The end starts 0.5 m inboard of the water and stops 1 m outboard of where it begins."""
    motion = "{trapezoid: {to: 0.5 m/s, rise: 1 ms, stay: 3 s, fall: 1 ms}}"
    result = simulate(held(", form: lumped", 3.5, motion=motion, stop=5))
    place = result["rope.node[7].x"]
    length = np.clip(place - 5, 0, None)
    flow = SPEED - result["rope.node[7].v"]
    np.testing.assert_allclose(result["rope.tail.drag"], EACH * length * flow**2, atol=1e-3)
    assert length[-1] == pytest.approx(1.0, abs=5e-3)


def test_line_behind_the_end_is_accelerated_with_it(simulate):
    """Without drag the haul takes (m' L + m' beyond) a and the tail."""
    motion = "{ramp: {to: -2 m/s, over: 4 s}}"
    sea = ", drag_coefficient: 0, form: lumped, beyond: 30 m"
    result = simulate(held(sea, 4, motion=motion, stop=4, mass="2 kg/m"))
    late = (result.t > 3) & (result.t < 3.9)
    assert -result["haul.force"][late].mean() == pytest.approx(100 + 2 * (4 + 30) * 0.5, rel=2e-3)
