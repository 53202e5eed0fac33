"""A method of one's own is one file: events, holds, settlements and records are those of all methods."""

from __future__ import annotations

import numpy as np
import pytest

import fairlead
from fairlead.integrate import Run, integrate
from tests.integrate.bdf2 import BDF2
from tests.integrate.problems import belt_block, index_one_dae, nonlinear_ode, pulled_block, stick_slip_times


def errors(make, tolerances):
    found = []
    for tolerance in tolerances:
        problem, exact = make(absolute=tolerance, relative=tolerance)
        outcome = integrate(problem, Run(stop=2.0, engine=BDF2))
        assert outcome.ok, outcome.sentence
        found.append(float(np.abs(outcome.y - exact(2.0)).max()))
    return found


@pytest.mark.parametrize("make", [nonlinear_ode, index_one_dae])
def test_its_error_follows_the_tolerance(make):
    coarse, fine = errors(make, [1e-4, 1e-7])
    assert coarse < 1e-2
    assert fine < 1e-4
    assert fine < 0.1 * coarse


def test_its_error_falls_with_the_square_of_the_step():
    found = []
    for h in (0.02, 0.01):
        problem, exact = nonlinear_ode()
        outcome = integrate(problem, Run(stop=2.0, engine=BDF2, fixed_step=h))
        found.append(float(np.abs(outcome.y - exact(2.0)).max()))
    assert found[0] / found[1] == pytest.approx(4.0, rel=0.2)


def test_a_block_on_a_belt_sticks_and_slips_at_the_times_of_the_closed_form():
    problem = belt_block(absolute=[1e-9, 1e-8, 1e-7], relative=1e-7)
    outcome = integrate(problem, Run(stop=5.0, engine=BDF2))
    assert outcome.ok, outcome.sentence
    first, slip, stick = stick_slip_times()
    expected = [first + (k // 2) * (slip + stick) + (k % 2) * slip for k in range(12)]
    np.testing.assert_allclose(outcome.events["t"], expected, rtol=1e-4)


def test_a_block_breaks_away_when_the_pull_reaches_stiction():
    problem, exact, breaks = pulled_block(absolute=1e-8, relative=1e-8)
    outcome = integrate(problem, Run(stop=2.0, engine=BDF2))
    np.testing.assert_allclose(outcome.events["t"], [breaks], rtol=1e-6)
    assert outcome.y[0] == pytest.approx(exact(2.0), rel=1e-3)


def test_a_model_of_the_library_runs_with_it():
    """The period of the belt of the library: 0.8 times the stiction, in seconds."""
    system = fairlead.load("belt").system
    outcome = integrate(system, Run(stop=20.0, engine=BDF2, accuracy=1e-6))
    assert outcome.ok, outcome.sentence
    rodas = integrate(system, Run(stop=20.0, accuracy=1e-8))
    assert len(outcome.events) == len(rodas.events)
    np.testing.assert_allclose(outcome.events["t"], rodas.events["t"], rtol=1e-3)
