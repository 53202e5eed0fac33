"""Of two answers of a force that friction follows the one that a stiff part has: a shaft, a rigid gear, a load."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from fairlead.integrate import Run, integrate
from fairlead.integrate.textbook import TextbookProblem, textbook

INERTIA, LOAD, RATIO, TORQUE = 0.01, 100.0, 1 / 30, 2.0
LOSS = 1 / 0.45 - 1  # of the torque carried, at the driving shaft, which turns forward


def gear(begins, pressing, back=-10.0):
    """y = w1, w2, T: J w1' = torque - T - loss |T|, D w2' = back + T/ratio, and w2 = ratio w1 for ever."""

    def rhs(t, y, z, f):
        f[0] = TORQUE - y[2] - LOSS * abs(y[2])
        f[1] = back + y[2] / RATIO
        f[2] = -1e3 * (y[1] - RATIO * y[0])

    def jacobian(t, y, z, J, ft):
        J[0, 2] = -1.0 - LOSS if y[2] > 0.0 else -1.0 + LOSS
        J[1, 2] = 1.0 / RATIO
        J[2, 0], J[2, 1] = 1e3 * RATIO, -1e3

    def mass(z, M):
        M[0, 0], M[1, 1], M[2, 0], M[2, 1] = INERTIA, LOAD, -RATIO, 1.0

    def slip(t, y, z, r):
        r[2] = -(y[1] - RATIO * y[0])
        return 1

    problem = textbook([100.0, 100.0 * RATIO, begins], rhs, jacobian, mass, slip=slip, algebraic=[2])
    kind = type("OneThatTells", (TextbookProblem,), {"pressing": np.array(pressing, dtype=np.int64).reshape(-1, 2)})
    return kind(**{field.name: getattr(problem, field.name) for field in dataclasses.fields(problem)})


def rate(side, back=-10.0):
    """w1' on the branch T > 0 (side 1) or T < 0 (-1)."""
    lost = 1 + side * LOSS
    return (TORQUE + lost * RATIO * back) / (INERTIA + lost * RATIO**2 * LOAD)


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize("begins", [0.5, -0.5, -100.0])
def test_wherever_newton_begins_the_force_grows_as_its_sides_are_pushed_together(engine, begins):
    outcome = integrate(gear(begins, [(2, 1)]), Run(stop=0.1, engine=engine))
    assert outcome.ok, outcome.sentence
    assert outcome.y[0] == pytest.approx(100.0 + 0.1 * rate(1), rel=1e-9)
    assert outcome.y[2] > 0.0


def test_who_does_not_ask_gets_the_answer_near_which_newton_begins():
    """Both are answers: this is the one that no stiff part has."""
    outcome = integrate(gear(-0.5, []), Run(stop=0.01))
    assert outcome.y[0] == pytest.approx(100.0 + 0.01 * rate(-1), rel=1e-9)
    assert outcome.y[2] < 0.0


def test_with_the_other_sign_the_other_answer_is_taken():
    outcome = integrate(gear(0.5, [(2, -1)]), Run(stop=0.01))
    assert outcome.y[0] == pytest.approx(100.0 + 0.01 * rate(-1), rel=1e-9)
