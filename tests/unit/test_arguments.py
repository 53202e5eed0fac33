"""Arguments of Python calls that cannot be meant are refused by name, all of a call at once."""

import numpy as np
import pytest

import fairlead
from fairlead.analysis.cost.compare import compare
from fairlead.analysis.cost.cost import cost
from fairlead.analysis.effects.effects import effects
from fairlead.errors import FairleadError, ModelError, UsageError


@pytest.fixture(scope="module")
def model():
    return fairlead.load("block_and_spring", set={"run.stop": 0.1})


@pytest.fixture(scope="module")
def result(model):
    return model.run(out=None)


def load(settings):
    return fairlead.load("belt", settings)


def never(*_, **__):
    raise AssertionError("nothing may be run")


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"out": 3}, "Model.run: out = 3 is not a path\n    Give a text or a pathlib.Path, or None to keep"),
        ({"out": True}, "Model.run: out = True is not a path"),
        ({"out": ""}, "Model.run: out = '' is not a path"),
        ({"out": ["a"]}, "Model.run: out = ['a'] is not a path"),
        ({"out": "a\0b"}, r"Model.run: out = 'a\x00b' is not a path: it has the character NUL"),
        ({"progress": 3}, "Model.run: progress = 3 is not a function\n    Give a function of the fraction done"),
        ({"progress": lambda share: None}, "Model.run: progress = <lambda> does not take 3 arguments"),
        ({"progress": True}, "Model.run: progress = True is not a function"),
        ({"force": "no"}, "Model.run: force = no is neither True nor False"),
        ({"profile": 1}, "Model.run: profile = 1 is neither True nor False"),
        ({"check": None}, "Model.run: check = None is neither True nor False"),
        ({"max_wall": -1}, "Model.run: run.max_wall = -1 is not above 0"),
        ({"max_steps": -5}, "Model.run: run.max_steps = -5"),
        ({"max_events": 0}, "Model.run: run.max_events = 0"),
    ],
)
def test_a_run_refuses_them_and_writes_nothing(model, arguments, says, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ModelError) as caught:
        model.run(**arguments)
    assert str(caught.value).startswith(says)
    assert not list(tmp_path.iterdir())


def test_a_run_tells_arguments_and_settings_at_once(model):
    with pytest.raises(ModelError) as caught:
        model.run(out=3, force="yes", acuracy=1e-2)
    assert len(caught.value.faults) == 3


@pytest.mark.parametrize("study", [cost, effects])
@pytest.mark.parametrize(
    ("budget", "says"),
    [
        (-1, "budget = -1 is not above 0"),
        (0, "budget = 0 is not above 0"),
        (float("nan"), "budget = nan"),
        ("soon", "budget = soon is not a quantity"),
        ("3 N", "budget = 3 N"),
        (None, "budget = nothing is not a"),
    ],
)
def test_a_study_refuses_a_budget_that_is_none(study, budget, says):
    with pytest.raises(ModelError) as caught:
        study(never, budget=budget)
    assert str(caught.value).startswith(f"{study.__name__}: {says}")


def test_compare_refuses_a_time_that_is_none_and_a_place_that_is_none():
    with pytest.raises(ModelError) as caught:
        compare(never, {"pad.method": ["hold"]}, max_wall=-1, out=3)
    assert [fault.what for fault in caught.value.faults] == ["out = 3 is not a path", "max_wall = -1 is not above 0"]


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: fairlead.load(3), "load: path = 3 is not a path"),
        (lambda: fairlead.load("belt", set=["mu=3"]), "load: set = ['mu=3'] is not a map"),
        (lambda: fairlead.load("belt", set={3: "x"}), "load: set = 3 is no name"),
        (lambda: fairlead.load("belt", set={"run.stop": None}), "load: set[run.stop] = None is neither a text nor"),
        (lambda: fairlead.load("belt", libraries="parts.py"), "load: libraries = parts.py is not a list"),
        (lambda: fairlead.load("belt", libraries=[3]), "load: libraries = 3 is not a path"),
    ],
)
def test_load_refuses_them(call, says):
    with pytest.raises(ModelError) as caught:
        call()
    assert str(caught.value).startswith(says)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda m: m.with_values(mu=[1]), "Model.with_values: values[mu] = [1] is neither a text nor a number"),
        (lambda m: m.statics("fast"), "Model.statics: speed = fast is not a quantity"),
        (lambda m: m.statics("3 N"), "Model.statics: speed = 3 N"),
        (lambda m: m.statics(-0.1), "Model.statics: speed = -0.1 is not above 0"),
        (lambda m: m.graph("dto"), "Model.graph: format = dto is not known\n    Did you mean dot? Allowed are mermaid"),
        (lambda m: m.describe("sytem"), "Model.describe: stage = sytem is not known\n    Did you mean system?"),
    ],
)
def test_a_model_refuses_them(model, call, says):
    with pytest.raises(ModelError) as caught:
        call(model)
    assert str(caught.value).startswith(says)


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda r: type(r).open(3), "Result.open: path = 3 is not a path"),
        (lambda r: r[3], "3 is not the name of a signal"),
        (lambda r: r.at("block.x", "now"), "t = now is no time"),
        (lambda r: r.to_pandas(["block.y"]), "block.y was not recorded"),
        (lambda r: r.to_pandas("*.y"), r"\*.y was not recorded"),
        (lambda r: r.to_xarray([None]), "nothing is not the name of a signal"),
    ],
)
def test_a_result_refuses_them(result, call, says):
    with pytest.raises(FairleadError, match=says):
        call(result)


def test_numbers_and_switches_are_taken_as_well_as_texts():
    assert fairlead.load("belt", set={"run.stop": 2, "pad.normal_force": 12.5}).netlist.run.stop == 2.0
    switched = fairlead.load("winch_drive", set={"effects.compressibility": False}).netlist.effects
    assert switched["compressibility"].plain() is False


def test_names_may_be_patterns_and_a_single_one(result):
    assert list(result.to_pandas("block.x").columns) == ["block.x"]
    assert list(result.to_pandas("block.*").columns) == result.match("block.*")
    assert list(result.to_xarray(["block.x", "block.*"])) == result.match("block.*")
    assert result.columns("block.x").shape == (len(result.t), 1)


def test_load_tells_what_check_would_where_an_override_or_a_library_is_wrong(tmp_path):
    """Everything at once: the misspelt parameter, the library that is not there."""
    for given in ({"set": {"mue": "0.4"}}, {"libraries": ["nothing.py"]}):
        with pytest.raises(ModelError, match=r"mue|nothing\.py"):
            fairlead.load("single_bend", **given)


@pytest.mark.parametrize("value", [np.float64(12.0), np.int64(12), np.float32(12.0), np.array(12.0)])
def test_numbers_of_numpy_are_numbers(value):
    model = fairlead.load("belt", set={"pad.normal_force": value})
    assert model.netlist.components["pad"].parameters["normal_force"].plain() in (12, 12.0)
    fairlead.load("block_and_spring").run(out=None, stop=np.float64(0.01), check=np.bool_(True))


def test_new_values_are_keywords_or_a_dict():
    model = fairlead.load("belt")
    one, other = model.with_values({"pad.normal_force": 12}), model.with_values(**{"pad.normal_force": 12})
    assert one.netlist.digest == other.netlist.digest != model.netlist.digest


def test_a_speed_is_a_quantity():
    model = fairlead.load("capstan")
    one, other = model.statics("50 cm/s")[0], model.statics(0.5)[0]
    assert one.moving[0].speed == other.moving[0].speed == 0.5


def test_a_progress_that_takes_anything_is_taken(model):
    told = []
    model.run(out=None, progress=lambda *given: told.append(given))
    assert told
    with pytest.raises(UsageError, match="no line on a route"):
        model.statics()


@pytest.mark.parametrize("path", ["a\0b", 3, None])
def test_what_is_no_path_is_not_opened(path):
    with pytest.raises(fairlead.UsageError, match="is not a path"):
        fairlead.Result.open(path)
