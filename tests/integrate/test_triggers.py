"""The trigger rule and its edges, by guards that are plain functions of time."""

from __future__ import annotations

import numpy as np
import pytest

from fairlead.integrate import Run, Status, integrate
from fairlead.integrate.textbook import textbook
from tests.integrate.problems import clock, coulomb_oscillator, falling_ball

# Crossings are located to rounding of y = t, a sum of stages with coefficients up to 150: some hundred ulps.
TO_ROUNDING = 1e-13


def firings(guard, stop=2.0, **settings):
    outcome = integrate(clock(guard), Run(stop=stop, **settings))
    assert outcome.ok, outcome.sentence
    return outcome.events["t"]


def test_a_guard_that_rises_through_zero_fires_once_at_the_crossing():
    assert firings(lambda t, z: t - 0.7 if z == 0 else -1) == pytest.approx([0.7], abs=TO_ROUNDING)


def test_the_accepted_point_is_the_right_hand_end_where_the_guard_is_not_negative():
    outcome = integrate(clock(lambda t, z: t**3 - 0.3 if z == 0 else -1), Run(stop=2.0))
    at_event = outcome.values[outcome.sides == 1, 0]
    assert len(at_event) == 1
    assert 0 <= at_event[0] ** 3 - 0.3 < TO_ROUNDING


def test_a_guard_at_zero_at_the_start_that_falls_does_not_fire():
    assert len(firings(lambda t, z: -t)) == 0


def test_a_guard_at_zero_at_the_start_that_rises_fires_there():
    assert firings(lambda t, z: t if z == 0 else -1) == pytest.approx([0.0], abs=TO_ROUNDING)


def test_a_guard_positive_at_the_start_fires_there():
    assert firings(lambda t, z: 0.3 - t if z == 0 else -1) == pytest.approx([0.0], abs=TO_ROUNDING)


def test_a_guard_that_touches_zero_from_below_may_fire_but_only_at_the_touch():
    times = firings(lambda t, z: -((t - 1) ** 2) if z == 0 else -1)
    assert len(times) <= 1
    assert all(abs(t - 1) < 1e-6 for t in times)  # within rounding of a parabola


def test_a_guard_that_stays_just_below_zero_does_not_fire():
    assert len(firings(lambda t, z: -((t - 1) ** 2) - 1e-6)) == 0


def test_a_double_crossing_inside_one_step_is_found():
    def guard(t, z):
        return 0.01 - (t - 1) ** 2 if z == 0 else -1

    outcome = integrate(clock(guard), Run(stop=2.0, fixed_step=2.0))
    assert outcome.events["t"] == pytest.approx([0.9], abs=TO_ROUNDING)
    assert outcome.counters.steps == 2


def test_a_guard_that_leaves_zero_downwards_and_returns_within_the_step_is_found():
    def guard(t, z):
        return -t * (1.5 - t) if z == 0 else -1

    outcome = integrate(clock(guard), Run(stop=2.0, fixed_step=2.0))
    assert outcome.events["t"] == pytest.approx([1.5], abs=TO_ROUNDING)


def test_of_two_crossings_in_a_step_the_earlier_is_taken_first():
    def rhs(t, y, z, f):
        f[0] = 1.0

    def guards(t, y, z, g):
        g[0] = y[0] - 0.6 if z[0] == 0 else -1.0
        g[1] = 1e6 * (y[0] - 0.4) if z[1] == 0 else -1.0

    def switch(t, y, z, fired):
        for k in fired:
            z[k] = 1

    two = {"zones": [0, 0], "guard_machine": [0, 1]}
    problem = textbook([0.0], rhs, lambda *_: None, guards=guards, switch=switch, **two)
    outcome = integrate(problem, Run(stop=1.0, fixed_step=1.0))
    assert outcome.events["machine"].tolist() == [1, 0]
    assert outcome.events["t"] == pytest.approx([0.4, 0.6], abs=TO_ROUNDING)


def test_guards_that_cross_at_the_same_instant_fire_together_in_one_pass():
    def rhs(t, y, z, f):
        f[0] = 1.0

    calls = []

    def guards(t, y, z, g):
        for k in range(3):
            g[k] = (y[0] - 0.5) * (k + 1) if z[k] == 0 else -1.0

    def switch(t, y, z, fired):
        calls.append(sorted(int(k) for k in fired))
        for k in fired:
            z[k] = 1

    three = {"zones": [0] * 3, "guard_machine": [0, 1, 2]}
    problem = textbook([0.0], rhs, lambda *_: None, guards=guards, switch=switch, **three)
    outcome = integrate(problem, Run(stop=1.0))
    assert calls == [[0, 1, 2]]
    assert outcome.events["position"].tolist() == [0, 0, 0]


def test_zones_never_change_within_a_step():
    during = []
    zones_at_rhs = []

    def rhs(t, y, z, f):
        f[0], f[1] = y[1], -4 * y[0] - (0.5 if z[0] == 1 else -0.5)
        zones_at_rhs.append((t, int(z[0])))

    def jacobian(t, y, z, J, ft):
        J[0, 1], J[1, 0] = 1.0, -4.0
        during.append(len(zones_at_rhs))

    def guards(t, y, z, g):
        g[0] = -y[1] if z[0] == 1 else y[1]

    def switch(t, y, z, fired):
        z[0] = 2 if z[0] == 1 else 1

    observed = textbook([2.0, 0.0], rhs, jacobian, guards=guards, switch=switch, zones=[2], guard_machine=[0])
    outcome = integrate(observed, Run(stop=6.0))
    assert outcome.ok, outcome.sentence
    assert outcome.counters.switches == 3
    for begin, end in zip(during, [*during[1:], len(zones_at_rhs)], strict=True):
        assert len({zone for _, zone in zones_at_rhs[begin:end]}) <= 1


def test_no_guard_is_positive_beyond_its_tolerance_at_an_accepted_point():
    problem, _ = coulomb_oscillator(absolute=1e-7, relative=0.0, guard_tolerance=1e-8)
    outcome = integrate(problem, Run(stop=6.0))
    speed = outcome.values[:, 1]
    switches = outcome.events["t"]
    for t, v, side in zip(outcome.times, speed, outcome.sides, strict=True):
        half = np.count_nonzero(switches < t) if side != 2 else np.count_nonzero(switches <= t)
        guard = v if half % 2 == 0 else -v
        assert guard <= 1e-8


def test_the_switch_times_of_a_reversing_block_are_those_of_the_closed_form():
    problem, exact = coulomb_oscillator(absolute=1e-10, relative=1e-10)
    outcome = integrate(problem, Run(stop=6.0))
    np.testing.assert_allclose(outcome.events["t"], np.pi / 2 * np.arange(1, 4), rtol=1e-8)
    np.testing.assert_allclose(outcome.y, exact(6.0), atol=1e-8)


def test_each_event_restarts_the_integration_exactly_once():
    problem, _ = coulomb_oscillator()
    outcome = integrate(problem, Run(stop=6.0))
    assert outcome.counters.located == len(outcome.events) == 3
    assert np.count_nonzero(outcome.sides == 1) == np.count_nonzero(outcome.sides == 2) == 3


def test_a_guard_found_positive_without_having_crossed_is_settled_from_the_start_of_the_step():
    # Within tolerance at the start and flat there, so that no slope tells; positive later.
    def guard(t, z):
        return 1e-12 + (t**4 if z == 0 else -1)

    outcome = integrate(clock(guard, guard_tolerance=1e-9), Run(stop=1.0))
    assert outcome.ok, outcome.sentence
    assert outcome.counters.rejected_inconsistent == 1
    assert outcome.events["t"].tolist() == [0.0]


def test_a_jump_of_the_state_at_a_switch_bounces_a_ball_at_the_times_of_the_closed_form():
    # g = 2, height 1: first impact at t = 1 with speed 2; flights last 2 e^n v/g.
    outcome = integrate(falling_ball(restitution=0.5), Run(stop=2.8))
    assert outcome.ok, outcome.sentence
    impacts = 1 + 2 * np.cumsum([0.0, 0.5, 0.25, 0.125])
    np.testing.assert_allclose(outcome.events["t"], impacts[: len(outcome.events)], atol=1e-13)
    assert len(outcome.events) == 4


@pytest.mark.parametrize("stop", [5.0, 5e6])
def test_a_ball_that_bounces_ever_faster_is_named_and_does_not_hang_the_run(stop):
    # It has no zone to rest in, so past the accumulation point t = 3 no zone is consistent: the run must
    # say so, or finish, but neither step for ever nor pass the floor in silence.
    outcome = integrate(falling_ball(restitution=0.5), Run(stop=stop, max_events=10_000))
    assert outcome.chattering == ("floor",)
    assert outcome.status == Status.NOT_SETTLED
    assert outcome.t == pytest.approx(3.0, abs=1e-3)
    assert len(outcome.events) > 20
