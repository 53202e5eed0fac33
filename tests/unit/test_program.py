"""Signals are eliminated from the Jacobian: a chain of them differentiates like the expression it stands for."""

import numpy as np
import pytest

from fairlead.system.assembly.program import Entries, plan
from tests.callbacks import Called, differences

STEP = 1e-6  # of values of order one: rounding and truncation of a central difference are then about 1e-10

CHAIN = """
    class Sensor(Component):
        flange = Translational("what it looks at")
        place = Output("m")
        pace = Output("m/s")
        def law(p, flange):
            return Law(flange=0, place=flange.x, pace=flange.v)

    class Bend(Component):
        exempt = {"units": "a chain of formulas"}
        one = Input("m")
        two = Input("m/s")
        gain = Parameter("1")
        value = Output("m")
        def law(p, one, two, t):
            return Law(value=p.gain * sin(one) + one * two + t**2 * two)

    class Push(Component):
        exempt = {"units": "a chain of formulas"}
        flange = Translational("what it pushes")
        order = Input("m")
        def law(p, flange, order):
            return Law(flange=-(order**2) - order * flange.v)
"""

SCENE = """
    components:
      wall: {type: Ground}
      spring: {type: Spring, stiffness: 3 N/m}
      cart: {type: Mass, mass: 2 kg}
      link: {type: Spring, stiffness: 5 N/m}
      wagon: {type: Mass, mass: 1 kg}
      look: {type: Sensor}
      first: {type: Bend, gain: 1.5}
      second: {type: Bend, gain: -0.7}
      third: {type: Bend, gain: 2}
      push: {type: Push}
    connections:
      - [wall.flange, spring.a]
      - [spring.b, cart.flange, link.a, look.flange]
      - [link.b, wagon.flange, push.flange]
      - [look.place, first.one, second.one]
      - [look.pace, first.two, second.two, third.two]
      - [first.value, third.one]
      - [third.value, push.order]
    run: {stop: 1 s}
"""


def test_a_chain_of_signals_differentiates_as_one_expression(scene, library):
    called = Called(scene(SCENE, libraries=(library(CHAIN),)).system)
    rng = np.random.default_rng(7)
    for _ in range(5):
        t, y = float(rng.uniform(0, 2)), rng.uniform(-1, 1, called.n)
        have, ft = called.jacobian(t, y)
        want = differences(lambda at, t=t: called.rhs(t, at), y, [STEP] * called.n)
        np.testing.assert_allclose(have, want, atol=1e-7)
        slope = differences(lambda at, y=y: called.rhs(float(at[0]), y), np.array([t]), [STEP])[:, 0]
        np.testing.assert_allclose(ft, slope, atol=1e-7)


def test_a_signal_that_nobody_reads_costs_nothing(scene, library):
    """`second` is connected to its inputs, and its own output to nothing: no unknown, no signal."""
    system = scene(SCENE, libraries=(library(CHAIN),)).system
    assert not [ref for ref in system.numbering.signals if ref.instance == "second"]


def test_the_chain_says_what_it_stands_for(scene, library):
    """The force on the wagon by hand."""
    called = Called(scene(SCENE, libraries=(library(CHAIN),)).system)
    names = called.system.unknown_names
    y, t = np.zeros(called.n), 1.3
    x, v, xw, vw = 0.3, -0.8, 0.1, 0.6
    for name, value in {"cart.x": x, "cart.v": v, "wagon.x": xw, "wagon.v": vw}.items():
        y[names.index(name)] = value
    first = 1.5 * np.sin(x) + x * v + t**2 * v
    third = 2 * np.sin(first) + first * v + t**2 * v
    expected = third**2 + third * vw - 5 * (xw - x)
    assert called.rhs(t, y)[names.index("wagon.v")] == pytest.approx(expected, rel=1e-13)


def product_of(program, partials):
    """Run the multiply-adds as the driver does."""
    work = np.zeros(program.length)
    work[0] = 1.0
    for (target, partial, factor), coef in zip(program.steps, program.coef, strict=True):
        work[target] += coef * partials[partial] * work[factor]
    return work[program.jacobian_at :]


def test_the_plan_follows_the_chain_rule_through_levels():
    """y0' = a s1, s1 = b s0 + c y1, s0 = d y0 + e t:  df/dy0 = a b d, df/dy1 = a c, df/dt = a b e."""
    n, signals = 2, 2
    time = n + signals + 1
    a, b, c, d, e = 2.0, 3.0, 5.0, 7.0, 11.0
    entries = Entries()
    for row, z, partial in ((2, 3, 1), (1, 2, 2), (1, 1, 3), (0, 0, 4), (0, time, 5)):
        entries.add(*(np.array([value]) for value in (row, z, partial)), np.ones(1))
    program = plan(entries, n, signals, np.array([0, 1, 2, 2]))
    found = product_of(program, np.array([1.0, a, b, c, d, e]))
    assert program.starts.tolist() == [0, 1, 2]
    assert program.rows.tolist() == [0, 0]
    assert found.tolist() == [a * b * d, a * c, a * b * e, 0.0]


def test_without_entries_the_plan_is_empty():
    program = plan(Entries(), 2, 0, np.zeros(2, dtype=np.int64))
    assert len(program.steps) == 0
    assert program.starts.tolist() == [0, 0, 0]
