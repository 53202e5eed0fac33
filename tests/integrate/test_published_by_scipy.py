"""The published solutions themselves, by a solver that is not ours: scipy's Radau at tight tolerance.

A slip in writing a problem down, or in copying a digit, would else only show as an engine that is too bad.
"""

from __future__ import annotations

import ctypes

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import newton

from tests.integrate import published

DOUBLES, WHOLE = ctypes.POINTER(ctypes.c_double), ctypes.POINTER(ctypes.c_int64)


def laws(problem):
    """f(t, y) and J(t, y) of a problem without zones, through its own callbacks."""
    n = len(problem.initial)
    rhs = ctypes.CFUNCTYPE(None, WHOLE, ctypes.c_double, DOUBLES, DOUBLES)(problem.callbacks["rhs"])
    jacobian = ctypes.CFUNCTYPE(None, WHOLE, ctypes.c_double, DOUBLES, DOUBLES, DOUBLES)(problem.callbacks["jacobian"])

    def at(array):
        return array.ctypes.data_as(DOUBLES)

    def f(t, y):
        y, out = np.ascontiguousarray(y), np.zeros(n)
        rhs(None, t, at(y), at(out))
        return out

    def J(t, y):
        y, out, rate = np.ascontiguousarray(y), np.zeros(n * n), np.zeros(n)
        jacobian(None, t, at(y), at(out), at(rate))
        return out.reshape(n, n).T

    return f, J


def radau(f, start, stop, accuracy, absolute, J=None, **settings):
    done = solve_ivp(f, (0.0, stop), start, "Radau", rtol=accuracy, atol=absolute, jac=J, **settings)
    assert done.success, done.message
    return done.y[:, -1]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["robertson", "hires", "pollution", "van_der_pol"])
def test_radau_reaches_the_published_solution(name):
    case = getattr(published, name)(1e-9)
    f, J = laws(case.problem)
    y = radau(f, case.problem.initial, case.stop, 1e-9, case.problem.absolute, J, first_step=case.first_step or 1e-6)
    assert case.error(y) < 1e-6


@pytest.mark.slow
def test_radau_reaches_the_solution_of_akzo_nobel_with_its_equilibrium_put_in():
    case = published.akzo_nobel(1e-10)
    f, _ = laws(case.problem)

    def whole(y):
        return np.append(y, 115.83 * y[0] * y[3])

    y = radau(lambda t, y: f(t, whole(y))[:5], case.problem.initial[:5], case.stop, 1e-10, 1e-13)
    assert case.error(whole(y)) < 1e-8


@pytest.mark.slow
def test_radau_reaches_the_solution_of_the_transistor_amplifier_with_its_nodes_solved_for():
    """The sum of both rows of a capacitor is free of its rate: it gives the voltage of its first node."""
    case = published.transistor_amplifier(1e-8)
    f, _ = laws(case.problem)
    algebraic, states = [0, 3, 6], [1, 2, 4, 5, 7]
    capacity = np.array([1e-6, -2e-6, 3e-6, -4e-6, 5e-6])
    last = case.problem.initial.copy()

    def nodes(t, states_now):
        y = last.copy()
        y[states] = states_now
        for k in algebraic:

            def current_left(v, k=k):
                y[k] = v
                return f(t, y)[k : k + 2].sum()

            y[k] = newton(current_left, y[k], tol=1e-13)
        last[:] = y
        return y

    def rate(t, states_now):
        found = f(t, nodes(t, states_now))
        return np.array([found[0], found[2], found[3], found[5], found[6]]) / capacity

    y = radau(rate, case.problem.initial[states], case.stop, 1e-5, 1e-6)
    assert case.error(nodes(case.stop, y)) < 1e-3


@pytest.mark.slow
def test_radau_goes_the_first_steps_of_the_ring_modulator_with_rodas():
    """Its whole way takes Radau minutes: compared is the first fiftieth, in which all diodes have conducted."""
    from fairlead.integrate import Run, integrate

    case, stop = published.ring_modulator(1e-9), 2e-5
    f, J = laws(case.problem)
    y = radau(f, case.problem.initial, stop, 1e-7, 1e-7 * case.scale, J)
    ours = integrate(case.problem, Run(stop=stop)).y
    assert np.max(np.abs(y - ours) / (np.abs(y) + case.scale)) < 1e-5
