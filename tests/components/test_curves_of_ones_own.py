"""A curve of one's own needs `coefficient` alone; the rest follows from that, and mistakes in it name it."""

import re

import numpy as np
import pytest

from fairlead.errors import ModelError

CURVES = '''
from fairlead.components.friction.curve import Curve


class Saddle(Curve):
    """mu = first (1 + (v/middle)^2)."""

    first = Parameter("1", "At rest.", least=0)
    middle = Parameter("m/s", "Where it has doubled.", above=0)

    def coefficient(p, v):
        return p.first * (1 + (v / p.middle) ** 2)
'''
SCENE = """
components:
  wall: {type: Ground}
  block: {type: Mass, mass: 1 kg}
  pull: {type: ForceSource, force: {ramp: {to: 20 N, over: 2 s}}}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: saddle, first: 0.4, middle: 2 m/s}}
connections: [[wall.flange, pad.a], [pad.b, block.flange, pull.flange]]
run: {stop: 1 s}
record: {signals: [pad.friction, block.v]}
"""


def test_a_curve_that_says_no_more_than_its_coefficient_breaks_away_at_that_of_no_speed(simulate, library):
    """10 N * 0.4 = 4 N are reached by 10 N/s after 0.4 s."""
    result = simulate(SCENE, libraries=(library(CURVES),))
    moving = result.t[np.argmax(np.abs(result["block.v"]) > 1e-6)]
    assert moving == pytest.approx(0.4, abs=0.02)


def test_a_curve_without_coefficient_is_refused_with_its_line(library, scene):
    text = CURVES.replace("coefficient(p, v)", "cofactor(p, v)")
    with pytest.raises(ModelError) as caught:
        scene(SCENE, libraries=(library(text),)).check()
    assert re.search(r"classes0\.py:6: Saddle: a curve needs a method coefficient\(p, v\)", str(caught.value))


def test_a_mistake_in_a_curve_is_told_at_the_line_of_the_curve(library, scene):
    text = CURVES.replace("p.first * (1", "p.frist * (1")
    with pytest.raises(ModelError) as caught:
        scene(SCENE, libraries=(library(text),)).check()
    assert re.search(r"classes0\.py:13: Saddle\.coefficient: Saddle has no parameter 'frist'", str(caught.value))


def test_units_of_a_curve_are_looked_at_too(library, scene):
    text = CURVES.replace("(v / p.middle) ** 2", "(v + p.middle**2)")
    with pytest.raises(ModelError) as caught:
        scene(SCENE, libraries=(library(text),)).check()
    assert re.search(r"classes0\.py:13: .*terms of a sum have one unit|are added", str(caught.value))


@pytest.mark.parametrize(("middle", "range_"), [(2.0, 2.0), (0.02, 0.02)])
def test_a_curve_is_drawn_over_its_own_range(library, middle, range_):
    """It has doubled at `middle`; the drawing goes to ten times that."""
    from fairlead.analysis.characteristic import _range, _slips
    from fairlead.component.parameters import make
    from fairlead.component.registry import known_types

    contact = known_types([library(CURVES)])["Contact"].members["hold"]
    p = make(contact, curve={"curve": "saddle", "first": 0.4, "middle": middle})
    assert _range(p) == pytest.approx(range_, rel=0.1)
    assert _slips(p).max() >= 5 * range_
