"""Observed order of convergence at fixed steps: smooth, index 1, across switches."""

from __future__ import annotations

import numpy as np
import pytest

from fairlead.integrate import Run, integrate
from fairlead.integrate.rodas.tableau import RODAS3P, RODAS5P, TABLEAUS, Tableau, _checked
from tests.integrate import problems


def observed_order(make, stop, steps, method, measure):
    """Slope of log error over log h by least squares."""
    errors = []
    for count in steps:
        problem, exact = make()
        outcome = integrate(problem, Run(stop=stop, fixed_step=stop / count, method=method))
        assert outcome.ok, outcome.sentence
        errors.append(np.abs(measure(outcome.y) - measure(exact(stop))).max())
    return np.polyfit(np.log(1 / np.array(steps)), np.log(errors), 1)[0], errors


ORDERS = [("rodas5p", 5, (24, 32, 48, 64)), ("rodas3p", 3, (32, 48, 64, 96))]
# A slope fitted over a factor of three in h is within 0.4 of the order it tends to.
SLACK = 0.4


@pytest.mark.parametrize(("method", "order", "steps"), ORDERS)
def test_a_smooth_nonautonomous_ode_is_solved_at_the_order_of_the_method(method, order, steps):
    slope, errors = observed_order(problems.nonlinear_ode, 2.0, steps, method, lambda y: y)
    assert slope > order - SLACK, errors


@pytest.mark.parametrize(("method", "order", "steps"), ORDERS)
@pytest.mark.parametrize("component", [0, 1])
def test_an_index_one_dae_is_solved_at_the_order_of_the_method(method, order, steps, component):
    slope, errors = observed_order(problems.index_one_dae, 2.0, steps, method, lambda y: y[component])
    assert slope > order - SLACK, errors


@pytest.mark.parametrize(
    ("method", "order", "steps"), [("rodas5p", 5, (24, 32, 48, 64)), ("rodas3p", 3, (64, 96, 128))]
)
def test_the_order_stays_across_switches_located_on_a_speed(method, order, steps):
    slope, errors = observed_order(problems.coulomb_oscillator, 6.0, steps, method, lambda y: y)
    assert slope > order - SLACK, errors


def test_the_order_is_at_least_four_across_a_breakaway_located_on_a_multiplier():
    def make():
        problem, exact, _ = problems.pulled_block()
        return problem, lambda t: np.array([exact(t)])

    slope, errors = observed_order(make, 2.0, (10, 14, 20, 28), "rodas5p", lambda y: y[:1])
    assert slope > 4 - SLACK, errors


@pytest.mark.parametrize(("method", "order"), [("rodas5p", 4), ("rodas3p", 3)])
def test_the_dense_output_has_its_order_between_steps(method, order):
    errors = []
    counts = (6, 9, 12, 18)
    for count in counts:
        problem, exact = problems.nonlinear_ode()
        outcome = integrate(problem, Run(stop=2.0, fixed_step=2.0 / count, every=0.05, method=method))
        truth = np.array([exact(t) for t in outcome.times])
        errors.append(np.abs(outcome.values - truth).max())
    slope = np.polyfit(np.log(1 / np.array(counts)), np.log(errors), 1)[0]
    assert slope > order - SLACK, errors


@pytest.mark.parametrize("tableau", [RODAS5P, RODAS3P])
def test_a_tableau_with_one_wrong_digit_is_refused_at_import(tableau):
    wrong = tableau.C.copy()
    wrong[2, 0] += 1e-6
    fields = {name: getattr(tableau, name) for name in Tableau.__dataclass_fields__}
    with pytest.raises(ArithmeticError, match="order condition"):
        _checked(Tableau(**(fields | {"C": wrong})))


@pytest.mark.parametrize("tableau", list(TABLEAUS.values()), ids=list(TABLEAUS))
def test_the_last_stage_looks_at_the_end_of_the_step(tableau):
    assert tableau.c[-1] == pytest.approx(1.0, abs=1e-13)
    assert tableau.d[-1] == pytest.approx(0.0, abs=1e-13)
