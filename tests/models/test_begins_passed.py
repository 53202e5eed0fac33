"""Rigid stops whose bodies begin within each other are named by `check` and by a run; those that touch are not."""

import re
import warnings

import pytest

from fairlead.errors import RunWarning

SAID = "begins {} within each other"


def two(x):
    """A block before another, at x, with a stop between."""
    return f"""
    components:
      one: {{type: Mass, mass: 1 kg, position: 0.1 m, velocity: 0}}
      two: {{type: Mass, mass: 1 kg, position: {x} m, velocity: 0}}
      stop: {{type: RigidStop, length: 0.3 m}}
    connections: [[one.flange, stop.a], [two.flange, stop.b]]
    run: {{stop: 0.1 s}}
    """


@pytest.mark.parametrize("engine", ["rodas", "ida"])
def test_a_stop_that_begins_passed_is_named_with_its_depth(scene, engine) -> None:
    model = scene(two(0.25), **{"run.engine": engine})
    with pytest.warns(RunWarning, match="stop: what it keeps apart " + SAID.format("0.15 m")):
        model.run(out=None)


@pytest.mark.parametrize("x", [0.4, 0.1 + 0.2 + 0.1, 0.4 - 1e-12, 7.0])
def test_what_touches_or_is_apart_is_not(scene, x) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert not scene(two(x)).run(out=None).remarks


def test_a_rope_that_begins_too_long_is_one_too(scene) -> None:
    """The other way round the same part is a rope: here it would have to be half a metre shorter."""
    text = two(1.1).replace("[one.flange, stop.a], [two.flange, stop.b]", "[one.flange, stop.b], [two.flange, stop.a]")
    with pytest.warns(RunWarning, match=SAID.format("0.5 m")):
        scene(text.replace("length: 0.3 m", "length: -0.5 m")).run(out=None)


ELASTIC = """
    components:
      one: {{type: {body}, {inertia}: 0.2, {place}: 0, {rate}: 0}}
      two: {{type: {body}, {inertia}: 0.3, {place}: {x}, {rate}: 0}}
      stop: {{{stop}}}
    connections: [[one.{end}, stop.a], [two.{end}, stop.b]]
    run: {{stop: 0.1 s, max_steps: 100000}}
    record: {{every: 1 ms}}
"""
SLIDES = {"body": "Mass", "inertia": "mass", "place": "position", "rate": "velocity", "end": "flange"}
SHAFTS = {"body": "Inertia", "inertia": "moment", "place": "angle", "rate": "speed", "end": "shaft"}
SPRUNG = [
    ("type: ElasticGap, length: 0.1 m, stiffness: 1 MN/m", SLIDES, 0.05, 0.05),
    ("type: Tether, length: 0.1 m, stiffness: 1 MN/m", SLIDES, 0.15, 0.05),
    ("type: EndStop, lower: -0.1, upper: 0.1, stiffness: 1e6, damping: 0", SLIDES, -0.15, 0.05),
    ("type: Play, play: 0.02, stiffness: 1e6, damping: 0", SLIDES, 0.05, 0.04),
    ("type: RotationalStop, lower: -1, upper: 1, stiffness: 1e6, damping: 0", SHAFTS, 1.5, 0.5),
    ("type: Backlash, play: 0.2, stiffness: 1e6, damping: 0", SHAFTS, -0.6, 0.5),
]


@pytest.mark.parametrize(("stop", "bodies", "x", "deep"), SPRUNG)
def test_an_elastic_stop_that_begins_far_in_is_named_with_the_speed_that_it_throws_at(scene, stop, bodies, x, deep):
    """The energy k d^2/2 becomes m v^2/2 of the reduced inertia 0.2*0.3/(0.2 + 0.3)."""
    thrown = deep * (1e6 / 0.12) ** 0.5
    model = scene(ELASTIC.format(stop=stop, x=x, **bodies))
    said = re.escape(f"throws what it holds to some {thrown:.2g}")
    with pytest.warns(RunWarning, match=f"stop begins {deep:.3g} .* {said}"):
        result = model.run(out=None)
    name = "v" if bodies is SLIDES else "speed"
    apart = abs(result[f"two.{name}"] - result[f"one.{name}"])
    assert max(apart) == pytest.approx(thrown, rel=0.05)


@pytest.mark.parametrize(("stop", "bodies", "x", "deep"), SPRUNG)
def test_one_that_carries_a_load_at_the_start_is_not(scene, stop, bodies, x, deep):
    """A hundredth of the way, as a buffer is pressed in: it throws at a hundredth of the speed."""
    near = x + (0.99 * deep if (stop.startswith("type: ElasticGap") or x < 0) else -0.99 * deep)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert not scene(ELASTIC.format(stop=stop, x=near, **bodies)).run(out=None).remarks
