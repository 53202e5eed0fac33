"""The room `events`: which guards are violated at a point, what a limit is known to, and for how long nothing moves."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest

from tests.integrate.rooms import entry, fields, memory

TOLERANCE = 1e-8


@functools.cache
def violators():
    from fairlead.integrate.events.violators import fire_violators

    return entry(fire_violators, ("problem", "run", "point", "events"))


@functools.cache
def chosen():
    from fairlead.integrate.events.settling import choose

    return entry(choose, ("problem", "events"))


@functools.cache
def weighed():
    from fairlead.integrate.events.limits import weigh_limits

    return entry(weigh_limits, ("problem", "events.guards"), "i")


@functools.cache
def held_back():
    from fairlead.integrate.events.limits import goes_no_further

    return entry(goes_no_further, ("events.guards",), "i", "b")


@functools.cache
def dwell():
    from fairlead.integrate.events.chatter import dwell_here

    return entry(dwell_here, ("run", "point"), "", "d")


@functools.cache
def turned():
    from fairlead.integrate.point.swings import judge_swings

    return entry(judge_swings, ("problem", "run", "point"), "d")


@functools.cache
def follows():
    from fairlead.integrate.point.stiff import follows_within

    return entry(follows_within, ("linear.matrices",), "id", "b")


@functools.cache
def at_limit():
    from fairlead.integrate.stepping.switch_inside import load_at_limit

    return entry(load_at_limit, ("run", "events.guards", "stepping"), "i", "d")


def settled(values, slopes, inertia):
    """A point at t = 0 with guards g = value + slope x of a place x that moves at 1 m/s, and what must be kept."""
    count = len(values)
    at = memory(
        {"n": 1, "n_guards": count, "n_machines": 1, "stop": 1.0, "t_next": 9.0, "t_release": math.inf,
         "weighs_guards": int(max(inertia) > 0.0)},
        y=[0.0], y_probe=[0.0], slope=[1.0], curvature=[0.0], u=[0.0], weight=[1e-3], differential=[1], unweighed=[0],
        guard_machine=[0] * count, guard_tolerance=[TOLERANCE] * count, guard_inertia=inertia,
        latch_guard=[0] * count, blow_guard=[0] * count, limit_guard=[0] * count, bounded_row=[-1] * count,
        fired=[0] * count, **{name: np.zeros(count) for name in ("g", "g_probe", "g_later", "wrong")},
    )  # fmt: skip

    def guards(_t, y, out):
        out[:] = values + slopes * y[0]

    return at, fields(at, 1, guards=(guards, count))


def test_a_guard_above_its_tolerance_is_violated_and_one_at_zero_if_it_rises():
    """Eight guards: above, at and below zero, that rise, stand and fall."""
    values = np.array([1e-3, 1e-3, 0.0, 0.0, 0.0, 0.5 * TOLERANCE, -1e-3, 2 * TOLERANCE])
    slopes = np.array([1.0, -1.0, 1.0, 0.0, -1.0, 1.0, 1.0, -1.0])
    at, kept = settled(values, slopes, [0.0] * 8)
    violators()(at)
    assert kept
    assert at.array["fired"][: int(at.number["n_fired"])].tolist() == [0, 1, 2, 5, 7]
    np.testing.assert_array_equal(at.array["g"], values)


def test_how_wrong_a_slip_is_is_the_force_that_it_takes_to_undo_it():
    """m v/(1 ms) of a slip above its tolerance, m a of one that begins; without an inertia the guard itself."""
    inertia, slope = 3.0, 7.0
    at, kept = settled(np.array([1e-3, 0.0]), np.array([0.0, slope]), [inertia, inertia])
    violators()(at)
    assert kept
    assert at.array["wrong"][0] == pytest.approx(inertia * 1e-3 / 1e-3)
    assert at.array["wrong"][1] == pytest.approx(inertia * slope, rel=1e-6)
    plain, kept = settled(np.array([1e-3]), np.array([0.0]), [0.0])
    violators()(plain)
    assert plain.array["wrong"][0] == 1e-3


@pytest.mark.parametrize(("stage", "left"), [(0, [0, 1, 2, 3]), (1, [1, 2]), (2, [2])])
def test_of_violators_all_change_then_those_half_as_wrong_as_the_worst_then_the_worst(stage, left):
    at = memory(
        {"n_guards": 4, "n_machines": 4, "n_fired": 4, "stage": stage, "fewest": 4}, fired=[0, 1, 2, 3],
        wrong=[0.9, 1.0, 2.0, 0.1], guard_machine=[0, 1, 2, 3], guard_tolerance=[1.0] * 4, rank=[0.0] * 4,
    )  # fmt: skip
    chosen()(at)
    assert at.array["fired"][: int(at.number["n_fired"])].tolist() == left


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_a_limit_is_known_to_a_share_of_its_force_and_to_the_rounding_of_the_largest(scale):
    """1e-8 of the own force, at least 1e-14 of the largest: the same in all units."""
    forces = scale * np.array([2.0, -1e-7, 5.0])
    at = memory({"n": 3, "n_guards": 4}, limit_guard=[1, 1, 1, 0], bounded_row=[0, 1, 2, -1],
                guard_tolerance=[7.0] * 4)  # fmt: skip
    weighed()(at, forces)
    np.testing.assert_allclose(at.array["guard_tolerance"], [2e-8 * scale, 5e-14 * scale, 5e-8 * scale, 7.0])


@pytest.mark.parametrize(("below", "height", "end", "holds"), [
    (2e-3, 1e-3, -1.0, True),  # the equations have the load below its limit by more than it still rises
    (0.0, 1e-3, -1.0, False),  # they have it at the limit: it is passed
    (2e-4, 1e-3, -1.0, True),  # the dense output is off by a fifth of the height: a shorter step is to tell
    (2e-4, 1e-3, 1.0, False),  # it is passed at the end too
    (5e-5, 1e-3, -1.0, False),  # off by a twentieth: it is passed
])  # fmt: skip
def test_a_load_that_tops_out_at_its_limit_goes_no_further(below, height, end, holds):
    at = memory({"n_guards": 1}, limit_guard=[1], g=[-below], g_late=[height], g_end=[end], guard_tolerance=[1e-9])
    assert held_back()(at, 0) == holds
    at.array["limit_guard"][0] = 0
    assert not held_back()(at, 0)


def test_a_dwell_is_no_longer_than_nothing_moves_by_a_tenth_of_its_weight_unless_it_was_given():
    at = memory({"n": 3, "dwell": 1.0}, slope=[2.0, 1e9, 1e9], weight=[1e-3, 1.0, 1.0], differential=[1, 0, 1],
                unweighed=[0, 0, 1])  # fmt: skip
    assert dwell()(at) == pytest.approx(0.1 * 1e-3 / 2.0)
    at.number["dwell"] = 1e-6
    assert dwell()(at) == 1e-6
    at.number["dwell"], at.number["dwell_given"] = 1.0, 1
    assert dwell()(at) == 1.0


@pytest.mark.parametrize("order", [2.0, 3.0, 5.0])
def test_a_step_that_turns_a_sine_by_more_than_an_eighth_of_a_period_is_repeated_with_a_length_that_does_not(order):
    """Its error is (turn/(pi/4))^p, so that h error^(-1/p) turns it by an eighth; smaller turns say nothing."""
    for turn in (0.3, 1.0, 4.0):
        at = memory({"n": 1, "n_swings": 2, "adaptive": 1, "error": 0.5, "error_exponent": 1.0 / order}, y=[0.0],
                    y_end=[turn], swing=[0.0, 0.0], swing_end=[0.0, 0.0])  # fmt: skip
        kept = fields(at, 1, swings=(lambda _t, y, out: out.__setitem__(slice(None), [y[0], 7.0]), 2))
        turned()(at, 1.0)
        assert kept
        error = float(at.number["error"])
        assert error >= 0.5
        assert turn * error ** (-1.0 / order) <= math.pi / 4 * (1 + 1e-12) or error == 0.5
        assert (error > 1.0) == (turn > math.pi / 4)


def test_an_unknown_follows_its_law_where_the_step_is_a_hundred_times_its_time():
    """m v' = -c v has the time m/c."""
    inertia, damping = 2.0, 50.0
    at = memory({"n": 1}, diagonal_slope=[0], diagonal_mass=[0], mass=[inertia], jacobian=[-damping])
    assert follows()(at, 0, 101 * inertia / damping)
    assert not follows()(at, 0, 99 * inertia / damping)
    at.array["jacobian"][0] = damping
    assert not follows()(at, 0, 1e6)


@pytest.mark.parametrize("when", [0.2, 0.7, 1.5])
def test_the_log_has_a_contact_that_others_took_along_where_its_load_would_come_to_its_limit(when):
    """Load less limit is r (t - when): seen in the middles of two steps, of 0.5 and of 1 s, before this one of 1 s."""
    rate, gap, gap_before = 40.0, 0.25, 0.75
    g, earlier = (rate * (t - when) for t in (-gap, -gap - gap_before))
    at = memory({"n_guards": 2, "n_machines": 1, "gap": gap, "gap_before": gap_before, "h": 1.0}, first_guard=[0],
                guard_machine=[0, 0], limit_guard=[1, 1], g=[g, -1e9], g_before=[earlier, -1e8])  # fmt: skip
    assert at_limit()(at, 0) == pytest.approx(min(when, 1.0))
