"""Settings as keyword arguments of `Model.run`: quantities, and the refusals of a netlist."""

import typing

import numpy as np
import pytest

import fairlead
from fairlead.errors import ModelError
from fairlead.netlist.keywords import RunKeywords
from fairlead.netlist.settings import RunSettings


@pytest.fixture(scope="module")
def model():
    return fairlead.load("belt", set={"run.stop": "0.2 s"})


def test_keywords_are_those_of_a_netlist():
    assert list(typing.get_type_hints(RunKeywords)) == list(RunSettings.model_fields)


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("pad.normal_force", "2O N", "set: pad.normal_force = 2O N is not a quantity."),
        ("pad.normal_force", "20 m", "set: pad.normal_force = 20 m is a length, not a force."),
        ("block.mass", -1, "set: block.mass = -1 is out of range.\n    Allowed: above 0 kg."),
        ("pad.normal_forc", "20 N", "Did you mean normal_force?"),
    ],
)
def test_a_value_that_does_not_fit_is_told_when_it_is_given(name, value, says):
    with pytest.raises(ModelError) as caught:
        fairlead.load("belt", set={name: value})
    assert says in str(caught.value)


@pytest.mark.parametrize("stop", ["100 ms", 0.1, np.float64(0.1)])
def test_quantities_and_numbers_are_taken(model, stop):
    assert model.run(out=None, stop=stop).t[-1] == pytest.approx(0.1)


@pytest.mark.parametrize(
    ("settings", "says"),
    [
        ({"acuracy": 1e-2}, "Model.run: run has no key acuracy\n    Did you mean accuracy?"),
        ({"engine": "foo"}, "Model.run: run.engine = foo is not known\n    Allowed are auto, rodas, stepping, ida."),
        ({"accuracy": 0}, "Model.run: run.accuracy = 0 is below 1e-12"),
        ({"accuracy": float("nan")}, "run.accuracy = nan"),
        ({"stop": "5 m"}, "run.stop = 5 m"),
        ({"stop": "soon"}, "run.stop = soon"),
        ({"stop": None}, "run.stop"),
        ({"stop": -1}, "run.stop = -1 s is not after start = 0 s"),
        ({"max_steps": 1.5}, "run.max_steps = 1.5"),
        ({"max_step": [1]}, "run.max_step"),
    ],
)
def test_what_a_netlist_could_not_have_is_refused(model, settings, says):
    with pytest.raises(ModelError) as caught:
        model.run(out=None, **settings)
    assert says in str(caught.value)


def test_all_mistakes_are_told_at_once(model):
    with pytest.raises(ModelError) as caught:
        model.run(out=None, acuracy=1e-2, engine="foo", stop="soon")
    assert len(caught.value.faults) == 3


def test_a_setting_is_one_also_where_the_scene_has_a_parameter_of_its_name(scene):
    model = scene("""
        parameters: {method: hold, stop: 1 kg, accuracy: 20 N}
        components:
          block: {type: Mass, mass: "{stop}"}
          push: {type: ForceSource, force: "{accuracy}"}
        connections: [[push.flange, block.flange]]
        run: {stop: 1 s}
    """)
    result = model.run(out=None, method="rodas3p", stop="0.5 s", accuracy=1e-6)
    used = result.run["settings"]
    assert (used["method"], used["stop"], used["accuracy"]) == ("rodas3p", 0.5, 1e-6)
    assert result["block.v"][-1] == pytest.approx(10.0)
