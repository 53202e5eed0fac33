"""Stiff problems; those with a published solution are in test_published.py."""

from __future__ import annotations

import numpy as np
import pytest

from fairlead.integrate import Run, integrate
from fairlead.integrate.textbook import textbook


def test_a_linear_problem_of_rate_1e9_takes_no_more_steps_than_its_slow_part_needs():
    def rhs(t, y, z, f):
        f[0] = -1e9 * (y[0] - np.cos(t)) - np.sin(t)

    def jacobian(t, y, z, J, ft):
        J[0, 0] = -1e9
        ft[0] = -1e9 * np.sin(t) - np.cos(t)

    outcome = integrate(textbook([1.0], rhs, jacobian, absolute=1e-6, relative=0.0), Run(stop=10.0))
    assert outcome.y[0] == pytest.approx(np.cos(10.0), abs=1e-5)
    assert outcome.counters.steps < 150  # a non-stiff method would need more than 1e9


def test_work_done_on_a_body_that_is_bound_stiffly_adds_up_over_long_steps():
    """v' = k (u - v), u = U sin wt: the integral of k (u - v) u is U^2 k w^2/(k^2 + w^2) t/2 in whole periods.

    Each swing moves U^2/2 to and fro, and 400 times less stays; the steps are 5000 times longer than 1/k.
    """
    U, w, k = 0.4, 4 * np.pi, 6e5

    def rhs(t, y, z, f):
        force = k * (U * np.sin(w * t) - y[0])
        f[0], f[1] = force, force * U * np.sin(w * t)

    def jacobian(t, y, z, J, ft):
        u, rate = U * np.sin(w * t), U * w * np.cos(w * t)
        J[0, 0], J[1, 0] = -k, -k * u
        ft[0], ft[1] = k * rate, k * rate * u + k * (u - y[0]) * rate

    start = -U * k * w / (k**2 + w**2)
    problem = textbook(
        [start, 0.0], rhs, jacobian, quadrature=[1], absolute=[1e-7, 1e-6], relative=0.0, cap=[3e-8, np.inf]
    )
    outcome = integrate(problem, Run(stop=10.0))
    assert outcome.counters.steps < 2000
    work = U**2 * k * w**2 / (k**2 + w**2) * 10 / 2
    assert outcome.y[1] == pytest.approx(work, abs=1e-6 * U**2 / 2)
