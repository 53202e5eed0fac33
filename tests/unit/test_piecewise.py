"""Piecewise polynomials: tables, quantities in time, their integrals, slopes and sums."""

import math
import pathlib

import numpy as np
import pytest

from fairlead.component import piecewise
from fairlead.component.given import Table, Waveform
from fairlead.component.piecewise import constant, linear_table, monotone_cubic_table, pieces
from fairlead.component.tables import read_table
from fairlead.component.wave import added
from fairlead.component.waveforms import read_waveform
from fairlead.kernels import layout

HERE = pathlib.Path()
X, Y = [0.0, 1.0, 2.5, 3.0], [1.0, 3.0, 3.0, -1.0]
STEPS = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]
RISING = [0.0, 0.1, 0.1, 2.0, 2.01, 5.0]  # flat, steep, flat again: a spline would overshoot


def wave(text, unit="N"):
    return read_waveform(text, Waveform(unit), HERE)


def test_a_linear_table_goes_through_its_points_on_straight_lines():
    table, x = linear_table(X, Y), np.linspace(0, 3, 61)
    np.testing.assert_allclose([table(at) for at in x], np.interp(x, X, Y), rtol=1e-14)


@pytest.mark.parametrize("make", [linear_table, monotone_cubic_table])
def test_beyond_its_ends_a_table_is_constant(make):
    table = make(X, Y)
    assert [table(at) for at in (-1e9, -1e-9, 3 + 1e-9, 1e9)] == pytest.approx([1.0, 1.0, -1.0, -1.0])
    assert table.derivative()(-5.0) == table.derivative()(5.0) == 0.0


def test_at_a_border_the_right_piece_holds():
    step = pieces([1.0], [[0.0], [2.0]])
    assert (step(1.0 - 1e-12), step(1.0), step.piece_at(1.0)) == (0.0, 2.0, 1)


def test_a_monotone_cubic_keeps_the_shape_of_its_points():
    """Rising points give a rising curve, a flat stretch stays flat: nowhere beyond the points (Fritsch 1984)."""
    table = monotone_cubic_table(STEPS, RISING)
    values = np.array([table(at) for at in np.linspace(0, 5, 1001)])
    assert np.all(np.diff(values) >= -1e-15)
    assert [table(at) for at in STEPS] == pytest.approx(RISING, abs=1e-14)
    np.testing.assert_allclose([table(at) for at in np.linspace(1, 2, 11)], 0.1, rtol=1e-13)


def test_a_monotone_cubic_has_no_kink_at_its_points():
    slope = monotone_cubic_table(STEPS, RISING).derivative()
    for inner in STEPS[1:-1]:
        assert slope(inner - 1e-9) == pytest.approx(slope(inner), abs=1e-6)


@pytest.mark.parametrize("start", [-1.0, 0.3, 2.7, 4.0])
def test_an_integral_vanishes_at_its_start_and_has_the_table_as_its_slope(start):
    table = linear_table(X, Y)
    whole = table.integral(start)
    assert whole(start) == pytest.approx(0.0, abs=1e-14)
    for at in (-0.5, 0.2, 1.7, 2.9, 3.5):
        grid = np.unique([start, at, *np.clip(X, min(start, at), max(start, at))])
        area = np.trapezoid([table(x) for x in grid], grid)  # exact between the points
        assert whole(at) == pytest.approx(area if at > start else -area, abs=1e-13)
        assert whole.derivative()(at) == pytest.approx(table(at), rel=1e-14)


def test_an_integral_is_continuous_at_every_border():
    whole = pieces([0.0, 1.0], [[2.0], [1.0, 4.0], [-3.0, 0.0, 6.0]]).integral(0.5)
    for border in (0.0, 1.0):
        assert whole(border - 1e-12) == pytest.approx(whole(border), abs=1e-10)


def test_a_piece_of_degree_four_cannot_be_integrated():
    with pytest.raises(ValueError, match="degree four"):
        pieces([], [[0.0, 0.0, 0.0, 0.0, 1.0]]).integral(0.0)


def test_a_sum_has_the_borders_of_both_and_the_values_of_both():
    one, two = linear_table(X, Y), monotone_cubic_table([-1.0, 0.5, 2.5], [0.0, 1.0, 5.0])
    both = added(one, two)
    assert sorted(both.rows[1:, 0]) == sorted({*X, -1.0, 0.5, 2.5})
    for at in np.linspace(-2, 4, 121):
        assert both(at) == pytest.approx(one(at) + two(at), rel=1e-12, abs=1e-12)


def test_nothing_added_is_the_other():
    table = linear_table(X, Y)
    assert added(constant(0.0), table) is table


WAVES = {
    "ramp": ({"ramp": {"to": "3 N", "over": "2 s", "from": "1 N", "start": "1 s"}}, {0.5: 1, 2: 2, 3: 3, 9: 3}),
    "step": ({"step": {"to": "3 N", "at": "1 s"}}, {0.999: 0, 1: 3, 2: 3}),
    "drift": ({"drift": {"rate": "0.5 N/s", "start": "1 s"}}, {0: 0, 1: 0, 3: 1}),
    "sine": (
        {"sine": {"amplitude": "2 N", "frequency": "0.25 Hz", "phase": "90 deg", "offset": "1 N"}},
        {0: 3, 1: 1, 2: -1, 0.5: 1 + math.sqrt(2)},
    ),
    "trapezoid": (
        {"trapezoid": {"to": "3 N", "start": "1 s", "rise": "1 s", "stay": "2 s", "fall": "0.5 s"}},
        {0: 0, 1.5: 1.5, 2: 3, 3.9: 3, 4.25: 1.5, 5: 0},
    ),
    "table": ({"table": [["0 s", "1 kN"], ["2 s", "3 kN"]]}, {-1: 1e3, 1: 2e3, 5: 3e3}),
    "a sum": ({"constant": "1 N", "step": {"to": "2 N", "at": "1 s"}, "drift": {"rate": "1 N/s"}}, {0: 1, 2: 5}),
    "a bare number": (4.5, {0: 4.5, 7: 4.5}),
}  # fmt: skip


@pytest.mark.parametrize("name", WAVES)
def test_a_quantity_in_time_has_its_values(name):
    text, values = WAVES[name]
    made = wave(text)
    assert [made(t) for t in values] == pytest.approx(list(values.values()), abs=1e-12)


def test_a_trapezoid_that_rises_at_once_jumps():
    made = wave({"trapezoid": {"to": 3.0, "rise": 0.0, "stay": 1.0, "fall": 0.0}})
    assert [made(t) for t in (-0.1, 0.0, 0.9, 1.0)] == [0.0, 3.0, 3.0, 0.0]


def test_a_table_in_a_file_is_read_past_its_heading(tmp_path):
    (tmp_path / "curve.csv").write_text("slip, coefficient\n# measured\n0, 0.4\n0.1, 0.3\n")
    table = read_table({"file": "curve.csv"}, Table("m/s", "1"), tmp_path)
    assert table(0.05) == pytest.approx(0.35)


def test_a_table_jumps_at_a_border_only_and_by_the_difference_of_its_pieces():
    """Left of 1 it is 2 (x - 1), about its right border, and right of it 3 + (x - 1)."""
    step = pieces([1.0], [[0.0, 2.0], [3.0, 1.0]])
    assert (step.jump_at(1.0), step.jump_at(1.0 + 1e-12), step.jump_at(-1e300)) == (3.0, 0.0, 0.0)
    assert not step.is_continuous
    assert step.borders == [1.0]


def test_kernels_read_rows_as_tables_write_them():
    """Compiled code has numbers of its own for them (kernels/layout.py)."""
    assert (layout.STRIDE, layout.RIGHT) == (piecewise.STRIDE, piecewise.RIGHT)
