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
