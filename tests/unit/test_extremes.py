"""Highest and lowest values in rows of steps, however many are searched at once: against a closed form."""

import numpy as np
import pytest

import fairlead.analysis.record.extremes as extremes_module
from fairlead.analysis.record.event_rows import Rows
from fairlead.analysis.record.extremes import Extremes, may_reach, peak_of_curves
from fairlead.analysis.record.step_rows import INSIDE, LEAST_ROWS, MOST_ROWS, MOST_VALUES, Batches
from fairlead.results.plateau import first_row

PEAK = 1700.3 * np.pi


def swing(t):
    """A swing with one highest and one lowest value, its negative, and one that does not move; NaN now and then."""
    one = np.cos(t - PEAK) * np.exp(-(((t - PEAK) / 20.0) ** 2))
    broken = np.where(np.arange(len(t)) % 97 == 5, np.nan, one)
    return np.stack([one, -one, np.full(len(t), 0.1), broken], axis=1)


def steps_of(inside):
    """Rows of 8000 steps of 1 s, with so many rows inside."""
    t = np.linspace(0.0, 8000.0, 8000 * (inside + 1) + 1)
    side = np.where(np.arange(len(t)) % (inside + 1), INSIDE, 0).astype(np.int8)
    return Rows(t, swing(t), side)


@pytest.mark.parametrize("inside", [1, 3])
def test_the_highest_of_thousands_of_peaks_is_found_in_whatever_batch_it_lies(inside):
    """A curve through rows h apart is off by h^3/(9 sqrt 3) (three rows, h = 0.5) or 0.03 h^5 (five, h = 0.25)."""
    rows, batches, extremes = steps_of(inside), Batches(4), Extremes(4)
    searched = 0
    for k in range(0, len(rows.t), 1009):
        for batch in batches.take(rows.where(slice(k, k + 1009))):
            assert MOST_ROWS < len(batch.t) <= MOST_ROWS + 2 + inside
            extremes.watch(batch)
            searched += 1
    extremes.watch(batches.rest())
    assert searched > 5
    off = 3e-5 if inside == 3 else 8e-3
    assert extremes.highest[0] == pytest.approx(1.0, abs=off)
    assert extremes.t_highest[0] == pytest.approx(PEAK, abs=0.2)
    assert extremes.lowest[0] == pytest.approx(-1.0, abs=off + 0.03)  # half a swing later the other way
    np.testing.assert_array_equal(extremes.highest[1], -extremes.lowest[0])
    np.testing.assert_array_equal(extremes.lowest[1], -extremes.highest[0])
    assert extremes.highest[2] == extremes.lowest[2] == 0.1
    assert extremes.highest[3] >= np.nanmax(rows.values[:, 3])
    assert extremes.highest[3] <= 1.0 + off


def test_batches_of_many_signals_have_fewer_rows():
    assert Batches(1).length == MOST_ROWS
    assert Batches(MOST_VALUES // 100).length == 100
    assert Batches(10**9).length == LEAST_ROWS


def test_only_the_stretches_near_to_the_best_so_far_are_looked_up(monkeypatch):
    """A hundred signals rest; one was at 0 and rises, so that each stretch of it is above all before."""
    looked = []

    def counted(values, column, sign, stretch, length, near):
        looked.append(len(stretch))
        return first_best(values, column, sign, stretch, length, near)

    first_best = extremes_module._first_best
    monkeypatch.setattr(extremes_module, "_first_best", counted)
    extremes = Extremes(101)
    rows = 10 * extremes_module.STRETCH
    rise = np.linspace(1.0, 2.0, rows)
    for last in (0.0 * rise, rise):
        values = np.concatenate([np.full((rows, 100), 7.0), last[:, None]], axis=1)
        extremes.watch(Rows(np.linspace(0.0, 1.0, rows), values, np.zeros(rows, dtype=np.int8)))
    assert looked[1] == 10
    assert (extremes.highest[100], extremes.t_highest[100], extremes.lowest[100]) == (2.0, 1.0, 0.0)


@pytest.mark.parametrize("nodes", [3, 5])
def test_a_top_anywhere_in_a_step_is_found_to_rounding(nodes):
    """1 - (s - p)^2 + 0.3 (s - p)^3 has its top 1 at s = p, close to either end as well; three rows know no cube."""
    place = np.concatenate([np.linspace(0.0, 1.0, 101), [1e-3, 1e-5, 1 - 1e-3, 1 - 1e-5]])[:, None]
    away = np.linspace(0.0, 1.0, nodes) - place
    value, share = peak_of_curves(1.0 - away**2 + (0.3 * away**3 if nodes == 5 else 0.0))
    np.testing.assert_allclose(value, 1.0, atol=1e-14)
    np.testing.assert_allclose(share, place[:, 0], atol=1e-6)


def test_of_two_peaks_close_to_each_other_the_higher_one_is_found():
    """cos(2 pi t/5) + 0.002 t, steps of 1 s: rows may lie at the lower top and beside the higher one."""
    t = np.linspace(0.0, 9.0, 37)
    phase = 2 * np.pi / 5
    for begin in np.linspace(0.0, 5.0, 41):
        fine = np.linspace(0.0, 9.0, 90001)
        values, exact = (np.cos(phase * (s + begin)) + 0.002 * s for s in (t, fine))
        extremes = Extremes(1)
        side = np.where(np.arange(len(t)) % 4, INSIDE, 0).astype(np.int8)
        extremes.watch(Rows(t, values[:, None], side))
        assert extremes.highest[0] == pytest.approx(exact.max(), abs=2e-4)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("rounding", [0, 1e-15, 1e-13])
def test_an_extreme_that_lasts_is_told_when_it_begins_whatever_rounding_does(sense, rounding):
    """A ramp to 1 in 3 s that stays there for 100 s and grows by its last digits; and one that starts there."""
    rows, batches, extremes = steps_of(1), Batches(2), Extremes(2)
    t = rows.t[rows.t <= 103.0]
    noise = rounding * t / 100.0
    falls = 1.0 - np.maximum(t - 50.0, 0.0) / 53.0
    values = np.stack([np.minimum(t / 3.0, 1.0) + noise, falls + noise], axis=1)
    whole = Rows(t, sense * values, rows.side[: len(t)])
    for k in range(0, len(t), 37):
        for batch in batches.take(whole.where(slice(k, k + 37))):
            extremes.watch(batch)
    extremes.watch(batches.rest())
    value, when = (extremes.highest, extremes.t_highest) if sense > 0 else (-extremes.lowest, extremes.t_lowest)
    assert value == pytest.approx([1.0, 1.0], abs=3 * rounding)
    assert when == pytest.approx([3.0, 0.0], abs=1e-6)


def test_rows_alone_tell_the_first_of_equal_values():
    values = np.array([np.nan, 0.0, 1.0, 1.0 + 1e-15, 0.5, 1.0 + 2e-15, 0.0 - 1e-16])
    assert first_row(values, least=False) == 2
    assert first_row(values, least=True) == 1
    assert first_row(np.array([3.0, 3.0 + 1e-9]), least=False) == 1  # two numbers that differ


@pytest.mark.parametrize("nodes", [3, 5])
def test_a_curve_that_is_not_searched_stays_below(nodes):
    values = np.random.default_rng(nodes).normal(size=(3000, nodes)) * 10.0 ** np.linspace(-3, 3, 3000)[:, None]
    curves = np.polynomial.polynomial.polyfit(np.linspace(0, 1, nodes), values.T, nodes - 1)
    tops = np.polynomial.polynomial.polyval(np.linspace(0, 1, 401), curves).max(axis=1)
    least = tops - 1e-9 * np.abs(tops)
    assert may_reach(values, least).all()
    far = values.max(axis=1) + 2.0 * np.ptp(values, axis=1)
    assert not may_reach(values, far).any()


def test_a_value_that_is_no_number_is_searched():
    assert may_reach(np.array([[0.0, np.nan, 0.0]]), np.array([1.0])).all()
