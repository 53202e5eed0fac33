"""Rigid stops whose bodies begin within each other are named by `check` and by a run; those that touch are not."""

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
