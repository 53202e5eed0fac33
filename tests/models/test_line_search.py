"""Steps whose laws bend sharply: `stepping` finds their end by taking back what a Newton move goes too far."""

import numpy as np
import pytest

import fairlead
from fairlead.integrate import Run, integrate

BLOCKS = """
    components:
      table: {type: MotionSource, position: {sine: {amplitude: 40 mm, frequency: 1.5 Hz}}}
      one: {type: Mass, mass: 1 kg}
      two: {type: Mass, mass: 2 kg}
      under_one: {type: Contact, normal_force: 10 N, curve: 0.3}
      under_two: {type: Contact, normal_force: 10 N, curve: 0.5}
      spring: {type: Spring, stiffness: 400 N/m}
    connections:
      - [table.flange, under_one.a, under_two.a]
      - [under_one.b, one.flange, spring.a]
      - [under_two.b, two.flange, spring.b]
"""
SMOOTH = pytest.mark.parametrize("method", ["tanh", "arctan", "root"])


def run(scene, method, accuracy, **settings):
    """Both positions [rows, 2], and the counters."""
    friction = f"    friction: {{method: {method}, creep: 1e-5 m/s}}\n"
    system = scene(f"{BLOCKS}{friction}    run: {{stop: 2 s, accuracy: {accuracy}}}\n").system
    outcome = integrate(system, Run(stop=2.0, every=0.01, record=["one.x", "two.x"], **settings))
    assert outcome.ok, outcome.sentence
    names = [signal.name for signal in outcome.problem.recorded]
    places = [names.index("one.x"), names.index("two.x")]
    return outcome.values[outcome.sides == 0][:, places], outcome.counters


@SMOOTH
def test_steps_far_beyond_the_width_of_a_regularised_law_are_taken_as_asked(scene, method):
    """Speeds change by 2000 widths of the law in a step. Full moves alone ended in 1900 to 4300 steps."""
    _, counters = run(scene, method, 1e-4, engine="stepping", fixed_step=5e-3)
    assert counters.unsolved <= 4
    assert counters.steps <= 404
    assert counters.solves < 7 * counters.steps  # a full move that goes astray takes tens


@SMOOTH
@pytest.mark.parametrize("accuracy", [1e-3, 1e-4])
def test_what_the_search_finds_is_the_motion_that_rodas_finds(scene, method, accuracy):
    """Slips that turn round within a step make it one of order one: errors go with the step, accuracy^(1/3)."""
    exact, _ = run(scene, method, 1e-6, engine="rodas")
    found, counters = run(scene, method, accuracy, engine="stepping")
    assert np.abs(found - exact).max() < 0.1 * accuracy ** (1 / 3)
    assert counters.unsolved < 0.02 * counters.steps


def test_a_singular_pattern_of_zones_met_inside_a_step_shortens_the_step():
    """At 45.73 s of this run the fifteenth pattern tried in a step has a singular matrix."""
    model = fairlead.load("weak_clamp")
    outcome = integrate(model.system, Run(stop=46.0, every=0.1, engine="stepping"))
    assert outcome.ok, outcome.sentence
