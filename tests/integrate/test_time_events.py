"""Time events and recording: landed on exactly, sampled, both sides kept."""

from __future__ import annotations

import numpy as np
import pytest

from fairlead.integrate import Run, integrate
from fairlead.integrate.textbook import textbook
from tests.integrate.problems import coulomb_oscillator


def sampled(period=0.1, rate=-1.0):
    """y' = u, u = rate * y sampled every period: y multiplies by (1 + rate period) at each sample."""
    held = {"u": 0.0, "seen": []}

    def rhs(t, y, z, f):
        f[0] = held["u"]

    def next_time(t, z):
        return period * (np.floor(t / period + 1e-9) + 1)

    def at_time(t, y, z):
        held["u"] = rate * y[0]
        held["seen"].append(t)
        return 1

    problem = textbook([1.0], rhs, lambda *_: None, next_time=next_time, at_time=at_time)
    return problem, held


def test_a_sampled_feedback_follows_its_map():
    problem, held = sampled()
    outcome = integrate(problem, Run(stop=1.0))
    assert outcome.y[0] == pytest.approx(0.9**10, rel=1e-13)
    np.testing.assert_array_equal(held["seen"], [0.0, *(0.1 * np.arange(1, 10))])
    assert outcome.counters.time_events == 9


def test_a_time_event_is_landed_on_exactly_and_both_sides_are_recorded():
    problem, _ = sampled()
    outcome = integrate(problem, Run(stop=0.35, every=0.05))
    before, after = outcome.times[outcome.sides == 1], outcome.times[outcome.sides == 2]
    assert before.tolist() == after.tolist() == [0.1 * 1, 0.1 * 2, 0.1 * 3]


def test_a_time_event_that_changes_nothing_leaves_the_run_as_it_was():
    def rhs(t, y, z, f):
        f[0] = np.cos(t)

    def jacobian(t, y, z, J, ft):
        ft[0] = -np.sin(t)

    def next_time(t, z):
        return np.floor(t + 1e-9) + 1

    quiet = textbook([0.0], rhs, jacobian, next_time=next_time, at_time=lambda t, y, z: 0)
    outcome = integrate(quiet, Run(stop=5.0, every=0.25))
    assert not outcome.sides.any()
    np.testing.assert_allclose(outcome.times, 0.25 * np.arange(21), atol=1e-12)
    np.testing.assert_allclose(outcome.values[:, 0], np.sin(outcome.times), atol=1e-5)


def test_a_crossing_at_the_very_instant_of_a_time_event_does_not_lose_either():
    seen = []

    def rhs(t, y, z, f):
        f[0] = 1.0

    def guards(t, y, z, g):
        g[0] = t - 0.5 if z[0] == 0 else -1.0

    def switch(t, y, z, fired):
        z[0] = 1

    def at_time(t, y, z):
        seen.append(t)
        return 1

    problem = textbook(
        [0.0], rhs, lambda *_: None, guards=guards, switch=switch, zones=[0], guard_machine=[0],
        next_time=lambda t, z: 0.5 if t < 0.5 else np.inf, at_time=at_time,
    )  # fmt: skip
    outcome = integrate(problem, Run(stop=1.0))
    assert outcome.events["t"].tolist() == [0.5]
    assert seen == [0.0, 0.5]


def test_the_grid_is_recorded_through_the_dense_output_and_never_across_an_event():
    problem, exact = coulomb_oscillator(absolute=1e-8, relative=1e-8)
    outcome = integrate(problem, Run(stop=6.0, every=0.01))
    ordinary = outcome.sides == 0
    np.testing.assert_allclose(outcome.times[ordinary], 0.01 * np.arange(601), atol=1e-12)
    truth = np.array([exact(t) for t in outcome.times[ordinary]])
    np.testing.assert_allclose(outcome.values[ordinary], truth, atol=1e-6)
    assert np.all(np.diff(outcome.times) >= 0)


def test_outputs_are_evaluated_in_the_zones_in_force():
    problem, _ = coulomb_oscillator(n_outputs=1, outputs=lambda t, y, z, out: out.__setitem__(0, z[0]))
    outcome = integrate(problem, Run(stop=2.0, every=0.5))
    rows = list(zip(outcome.sides.tolist(), outcome.values[:, 0].tolist(), strict=True))
    assert (1, 2.0) in rows
    assert (2, 1.0) in rows
    assert [value for side, value in rows if side == 0] == [2.0, 2.0, 2.0, 2.0, 1.0]


def test_every_accepted_step_is_recorded_when_no_grid_is_asked_for():
    problem, _ = coulomb_oscillator()
    outcome = integrate(problem, Run(stop=1.0))
    assert len(outcome.times) == outcome.counters.steps + 1
    assert outcome.times[0] == 0.0
    assert outcome.times[-1] == 1.0


def test_a_swinging_load_on_a_held_contact_is_not_stepped_over():
    # lambda = 2 sin 5 t is met by a stiffly accurate method at the end of any step: only the middle tells.
    def rhs(t, y, z, f):
        f[0], f[1] = 2 * np.sin(5 * t) - y[1], -1e3 * y[0]

    def jacobian(t, y, z, J, ft):
        J[0, 1], J[1, 0] = -1.0, -1e3
        ft[0] = 10 * np.cos(5 * t)

    def mass(z, M):
        M[0, 0] = M[1, 0] = 1.0

    def guards(t, y, z, g):
        g[0] = y[1] - 1.999 if z[0] == 0 else -1.0

    def switch(t, y, z, fired):
        z[0] = 1

    problem = textbook(
        [0.0, 0.0], rhs, jacobian, mass, guards=guards, switch=switch, zones=[0], guard_machine=[0],
        algebraic=[1],
    )  # fmt: skip
    outcome = integrate(problem, Run(stop=20.0, every=0.05))
    assert outcome.events["t"][0] == pytest.approx(np.arcsin(1.999 / 2) / 5, abs=1e-5)
    ordinary = outcome.sides == 0
    load = 2 * np.sin(5 * outcome.times[ordinary])
    np.testing.assert_allclose(outcome.values[ordinary, 1], load, atol=1e-5)
