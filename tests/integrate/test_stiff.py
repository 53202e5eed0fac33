"""Stiff problems against published values (Mazzia, Magherini: Test Set for IVP Solvers, release 2.4)."""

from __future__ import annotations

import numpy as np
import pytest

from fairlead.integrate import Run, integrate
from fairlead.integrate.textbook import textbook


def van_der_pol(epsilon=1e-6, accuracy=1e-8):
    def rhs(t, y, z, f):
        f[0], f[1] = y[1], ((1 - y[0] ** 2) * y[1] - y[0]) / epsilon

    def jacobian(t, y, z, J, ft):
        J[0, 1] = 1.0
        J[1, 0], J[1, 1] = (-2 * y[0] * y[1] - 1) / epsilon, (1 - y[0] ** 2) / epsilon

    return textbook([2.0, 0.0], rhs, jacobian, absolute=accuracy, relative=accuracy)


def robertson(accuracy, as_dae):
    def rhs(t, y, z, f):
        slow, fast, pair = 0.04 * y[0], 1e4 * y[1] * y[2], 3e7 * y[1] ** 2
        f[0], f[1], f[2] = -slow + fast, slow - fast - pair, pair
        if as_dae:
            f[2] = y[0] + y[1] + y[2] - 1

    def jacobian(t, y, z, J, ft):
        J[0, 0], J[0, 1], J[0, 2] = -0.04, 1e4 * y[2], 1e4 * y[1]
        J[1, 0], J[1, 1], J[1, 2] = 0.04, -1e4 * y[2] - 6e7 * y[1], -1e4 * y[1]
        J[2, 1] = 6e7 * y[1]
        if as_dae:
            J[2, :] = 1.0

    return textbook(
        [1.0, 0.0, 0.0], rhs, jacobian, algebraic=[2] if as_dae else [],
        absolute=[accuracy * 1e-7, accuracy * 1e-11, accuracy * 1e-7], relative=accuracy,
    )  # fmt: skip


@pytest.mark.parametrize("method", ["rodas5p", "rodas3p"])
def test_van_der_pol_with_epsilon_1e_minus_6_agrees_with_the_test_set(method):
    outcome = integrate(van_der_pol(accuracy=1e-6), Run(stop=2.0, method=method))
    assert outcome.ok, outcome.sentence
    # The global error of a stiff oscillator is some hundred tolerances at the jumps.
    np.testing.assert_allclose(outcome.y, [1.706167732170483, -0.8928097010247975], rtol=1e-3)


def test_van_der_pol_converges_to_the_test_set_as_the_accuracy_rises():
    errors = []
    for accuracy in (1e-5, 1e-7, 1e-9):
        outcome = integrate(van_der_pol(accuracy=accuracy), Run(stop=2.0))
        errors.append(abs(outcome.y[0] / 1.706167732170483 - 1))
    assert errors[2] < errors[1] < errors[0]
    assert errors[2] < 1e-7


@pytest.mark.parametrize("as_dae", [False, True], ids=["ode", "index 1"])
def test_robertson_agrees_with_the_test_set_after_1e11_seconds(as_dae):
    outcome = integrate(robertson(1e-8, as_dae), Run(stop=1e11, first_step=1e-4))
    assert outcome.ok, outcome.sentence
    reference = [0.2083340149701255e-07, 0.8333360770334713e-13, 0.9999999791665050]
    np.testing.assert_allclose(outcome.y, reference, rtol=1e-5)


def test_a_linear_problem_of_rate_1e9_takes_no_more_steps_than_its_slow_part_needs():
    def rhs(t, y, z, f):
        f[0] = -1e9 * (y[0] - np.cos(t)) - np.sin(t)

    def jacobian(t, y, z, J, ft):
        J[0, 0] = -1e9
        ft[0] = -1e9 * np.sin(t) - np.cos(t)

    outcome = integrate(textbook([1.0], rhs, jacobian, absolute=1e-6, relative=0.0), Run(stop=10.0))
    assert outcome.y[0] == pytest.approx(np.cos(10.0), abs=1e-5)
    assert outcome.counters.steps < 150  # a non-stiff method would need more than 1e9
