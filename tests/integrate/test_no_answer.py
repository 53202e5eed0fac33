"""Zones in which no force solves the equations: what is known without forces leads to the zones that have one."""

from __future__ import annotations

import pytest

from fairlead.integrate import Run, integrate
from fairlead.integrate.textbook import textbook

ENGINES = ["rodas", "stepping", "ida"]


def creeping(speed, wrong=3.0):
    """v' = -x, with x = 2 in zone 1, and 1 + (v + x)^2 = 0 in zones 0 and 2, of which the last is left for nothing."""
    calls = []

    def rhs(t, y, z, f):
        f[0] = -y[1]
        f[1] = y[1] - 2.0 if z[0] == 1 else 1.0 + (y[0] + y[1]) ** 2

    def jacobian(t, y, z, J, ft):
        J[0, 1] = -1.0
        J[1, 0], J[1, 1] = (0.0, 1.0) if z[0] == 1 else (2.0 * (y[0] + y[1]), 2.0 * (y[0] + y[1]))

    def guards(t, y, z, g):
        calls.append((int(z[0]), float(y[1])))
        g[0] = -1.0 if z[0] == 1 else y[0] - 1.0 if z[0] == 0 else -1.0

    def switch(t, y, z, fired):
        z[0] = 1 if y[0] < wrong else 2

    one = {"zones": [0], "guard_machine": [0], "algebraic": [1]}
    return textbook([speed, 0.25], rhs, jacobian, guards=guards, switch=switch, **one), calls


@pytest.mark.parametrize("engine", ENGINES)
def test_a_zone_of_the_speed_is_found_without_forces(engine):
    problem, calls = creeping(2.0)
    outcome = integrate(problem, Run(stop=0.25, engine=engine))
    assert outcome.ok, outcome.sentence
    assert outcome.y[0] == pytest.approx(2.0 - 0.5, rel=1e-6)
    assert outcome.events["t"].tolist() == [0.0]
    assert calls[0] == (0, 0.25)  # with the force of the start, not one that Newton has tried


@pytest.mark.parametrize("engine", ENGINES)
def test_where_the_speed_says_nothing_the_run_ends(engine):
    outcome = integrate(creeping(0.5)[0], Run(stop=0.25, engine=engine))
    assert not outcome.ok
    assert "no consistent values" in outcome.sentence


@pytest.mark.parametrize("engine", ENGINES)
def test_zones_that_lead_from_one_without_an_answer_to_the_next_end_as_such(engine):
    outcome = integrate(creeping(4.0)[0], Run(stop=0.25, engine=engine))
    assert not outcome.ok
    assert "no consistent values" in outcome.sentence
