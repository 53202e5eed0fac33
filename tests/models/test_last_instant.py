"""A corner of what is given one rounding before the end of a run, beside contacts in a ring: no step is that short."""

from __future__ import annotations

import pytest

import fairlead

SCENE = """
    components:
      floor: {type: Ground}
      one: {type: Mass, mass: 1.9 kg}
      two: {type: Mass, mass: 2.6 kg}
      free: {type: Mass, mass: 0.5 kg}
      under: {type: Contact, curve: 0.38, normal_force: 57 N}
      below: {type: Contact, curve: 0.41, normal_force: 15 N}
      between: {type: Contact, curve: 0.13, normal_force: 13 N}
      push: {type: ForceSource, force: {ramp: {to: 3 N, start: 0.7 s, over: 0.1 s}}}
    connections:
      - [floor.flange, under.a, below.a]
      - [one.flange, under.b, between.b]
      - [two.flange, below.b, between.a]
      - [free.flange, push.flange]
    run: {stop: 0.8 s, accuracy: 1e-6}
"""
"""0.7 + 0.1 is 0.7999999999999999."""


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_the_last_step_covers_it(simulate, engine):
    result = simulate(SCENE, **{"run.engine": engine})
    assert result.t[-1] == 0.8
    assert result["free.v"][-1] == pytest.approx(3.0 * 0.1 / 2 / 0.5, rel=1e-6)


def test_from_outside_too():
    """Ten times 0.1 s are less than 1 s by a rounding: the end of the span is no place to land on."""
    run, t = fairlead.load("belt", {"run.stop": "1 s"}).start(), 0.0
    for _ in range(10):
        t += 0.1
        assert run.advance(t) == t
    assert run.advance(t + 0.1) == t + 0.1
