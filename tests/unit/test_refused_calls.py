"""Calls from Python that cannot be meant are told by call, argument, value and way out, never by a traceback."""

import pathlib

import numpy as np
import pytest

import fairlead
from fairlead.cases import Cases
from fairlead.errors import FairleadError

PEAK = {"peak": "peak(block.x)"}


@pytest.fixture(scope="module")
def model():
    return fairlead.load("belt", set={"run.stop": 1.0})


@pytest.fixture(scope="module")
def result(model):
    return model.run(out=None)


@pytest.fixture(scope="module")
def cases(model):
    return Cases(model, PEAK)


@pytest.fixture(scope="module")
def stepping(model):
    return model.start()


def told(call, *given):
    """What is said of a call."""
    with pytest.raises(FairleadError) as caught:
        call(*given)
    return " ".join(str(caught.value).split())


@pytest.mark.parametrize(
    ("asked", "says"),
    [
        ({"zones": "held"}, 'modes: zones = held is not a map Write it as {"pad": "held"}.'),
        ({"zones": {"pad": None}}, "modes: zones[pad] = None is not the name of a zone Write it as"),
        ({"zones": {3: "held"}}, "modes: zones = 3 is not a name, which is a text"),
        ({"acting": 3, "out": 4}, 'modes: acting = 3 is not a text Write it as "block". modes: out = 4'),
        ({"frequencies": (1, 10)}, "modes: frequencies = (1, 10) is given alone A response needs acting"),
        ({"frequencies": 3, "acting": "block", "out": "block.x"}, "modes: frequencies = 3 are not two numbers"),
        ({"change": 1.5}, "modes: change = 1.5 is not a whole number Give a whole number, 0 or more."),
        ({"change": "all"}, "modes: change = all is not a whole number"),
        ({"change": True}, "modes: change = True is not a whole number"),
        ({"change": -1}, "modes: change = -1 is below 0"),
        ({"chang": 1}, "modes: there is no argument chang. Did you mean change? Arguments are model, at"),
    ],
)
def test_modes_refuses_them(model, asked, says):
    assert says in told(lambda: fairlead.modes(model, **asked))


@pytest.mark.parametrize("study", [fairlead.modes, fairlead.sensitivity, Cases])
@pytest.mark.parametrize("given", ["belt", None, 3, "a Result"])
def test_a_study_refuses_what_is_no_model(result, study, given):
    said = told(study, result if given == "a Result" else given)
    assert f"{study.__name__}: model = " in said
    assert "is not a Model" in said
    assert "fairlead.load" in said


@pytest.mark.parametrize(
    ("of", "to", "more", "says"),
    [
        (3, None, {}, 'sensitivity: of = 3 is neither a text nor a list Write it as ["peak(block.x)"].'),
        ([3], None, {}, "sensitivity: of = 3 is not a text"),
        ({3: "peak(block.x)"}, None, {}, "sensitivity: of = 3 is not a name, which is a text"),
        ("peak(block.x)", 3, {}, "sensitivity: to = 3 is neither a text nor a list"),
        ("peak(block.x)", [None], {}, "sensitivity: to = None is not a text"),
        ("peak(block.x)", {"block.mass": [1]}, {}, "sensitivity: to[block.mass] = [1] is no size of changes"),
        ("peak(block.x)", "block.mass", {"told": 3}, "sensitivity: told = 3 is not a function Give a"),
        ("peak(block.x)", "block.mass", {"max_steps": "x"}, "sensitivity: max_steps = x is not a whole number"),
        ("peak(block.x)", "block.mass", {"max_steps": 0}, "sensitivity: max_steps = 0 is below 1"),
        ("peak(block.x)", "block.mass", {"max_step": 9}, "sensitivity: there is no argument max_step. Did you"),
    ],
)  # fmt: skip
def test_sensitivity_refuses_them(model, of, to, more, says):
    assert says in told(lambda: fairlead.sensitivity(model, of, to, **more))


@pytest.mark.parametrize(
    ("figures", "more", "says"),
    [
        ("peak(block.x)", {}, 'Cases: figures = peak(block.x) is not a map Write it as {"peak": "peak(block.x)"}.'),
        (["peak(block.x)"], {}, "Cases: figures = ['peak(block.x)'] is not a map"),
        ({3: "peak(block.x)"}, {}, "Cases: figures = 3 is not a name, which is a text"),
        ({"peak": 3}, {}, "Cases: figures[peak] = 3 is neither a text nor a function"),
        (PEAK, {"max_steps": "many"}, "Cases: max_steps = many is not a whole number"),
        (PEAK, {"max_steps": -1}, "Cases: max_steps = -1 is below 1"),
        (PEAK, {"max_steps": 2.5}, "Cases: max_steps = 2.5 is not a whole number"),
        (PEAK, {"max_step": 10}, "Cases: there is no argument max_step. Did you mean max_steps? Arguments are"),
    ],
)  # fmt: skip
def test_cases_refuses_them(model, figures, more, says):
    assert says in told(lambda: Cases(model, figures, **more))


@pytest.mark.parametrize("values", [None, [1], "pad.normal_force=3", 3])
def test_values_of_a_case_that_are_no_map_are_refused(cases, values):
    for call in (cases.row, cases.check):
        assert f"Cases.{call.__name__}: values = {values} is not a map" in told(call, values)


@pytest.mark.parametrize(
    ("values", "says"),
    [
        ({"pad.normal_force": None}, "values[pad.normal_force] = None is neither a text nor a number Give a value"),
        ({"pad.normal_force": np.array([9.0, 10.0])}, "is neither a text nor a number Give one value; for several"),
        ({"pad.normal_force": pathlib.Path("x")}, "is neither a text nor a number"),
        ({3: 4}, "values = 3 is no name of a parameter or a setting"),
        ({3: 4, "block.mass": 2}, "values = 3 is no name of a parameter or a setting"),
        ({"block.mas": 2}, "values: block.mas: Mass has no parameter mas. Did you mean mass?"),
        ({"blok.mass": 2}, "values: blok.mass: there is no component or block blok Did you mean block?"),
    ],
)
def test_a_value_that_no_model_has_makes_a_refused_row(cases, values, says):
    row = cases.row(values)
    assert row.status == "refused"
    assert says in row.sentence


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda m: m.beside(None), 'Model.beside: values = None is not a map Write it as {"run.stop"'),
        (lambda m: m.beside({"block.mas": 2}), "Did you mean mass?"),
        (lambda m: m.with_values({"block.mass": 1}, **{"block.mass": 2}), "values = block.mass is given twice"),
        (lambda m: m.with_values(mu=0.5), "Model.with_values: mu: there is no parameter mu"),
        (lambda m: m.with_values({"blok.mass": 1}), "Model.with_values: blok.mass: there is no component"),
        (lambda m: m.beside({"blok.mass": 1}), "Model.beside: blok.mass: there is no component"),
        (lambda m: m.run("5 s"), "Model.run: out = 5 s is a time, not a folder The end of a run is stop='5 s'."),
        (lambda m: fairlead.run("belt", out="10 ms"), "run: out = 10 ms is a time, not a folder"),
        (lambda m: m.run(method="hold"), "run.method = hold is a treatment of friction, not a method of the engine"),
        (lambda m: m.run(method="hold"), "load(..., set={\"friction.method\": 'hold'})"),
        (lambda m: m.run(record=["*"]), "run has no key record It is a block of the netlist"),
        (lambda m: m.run(stop=-1), "run.stop = -1 s is not after start = 0 s Give a stop above the start"),
        (lambda m: m.run(start=5, stop=1), "run.stop = 1 s is not after start = 5 s Give a stop above the start"),
        (lambda m: m.start(stopp=3), "Model.start: run has no key stopp Did you mean stop?"),
        (lambda m: m.start(inptus=["x"]), "Model.start: run has no key inptus Did you mean inputs?"),
        (lambda m: m.run(proffile=True), "Model.run: run has no key proffile Did you mean profile?"),
        (lambda m: fairlead.run("belt", stopp=3), "run: run has no key stopp"),
        (lambda m: fairlead.run(3, out=None), "run: path = 3 is not a path"),
        (lambda m: fairlead.run("belt", {"block.mass": None}, out=None), "run: set[block.mass] = None is neither"),
        (lambda m: m.start(inputs=[3]), "Model.start: inputs = 3 is not a name"),
        (lambda m: m.start(tunable=[None]), "Model.start: tunable = None is not a name"),
        (lambda m: fairlead.load("belt", sets={}), "load: there is no argument sets. Did you mean set?"),
        (lambda m: fairlead.json_schema("parts.py"), "json_schema: libraries = parts.py is not a list"),
        (lambda m: fairlead.json_schema(3), "json_schema: libraries = 3 is not a list"),
        (lambda m: fairlead.describe_type(None), 'describe_type: name = None is not a text Write it as describe_type'),
    ],
)  # fmt: skip
def test_a_model_and_its_makers_refuse_them(model, call, says, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    said = told(call, model)
    assert says in said
    assert "--set" not in said
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("call", ["to_pandas", "to_xarray", "columns", "elements", "plot"])
def test_what_is_no_name_of_signals_is_told_with_how_to_write_it(result, call):
    said = told(getattr(result, call), 3)
    assert "3 is n" in said
    assert "a text" in said


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda r: r.to_csv("x.csv", 3), "names = 3 is neither a text nor a list of texts."),
        (lambda r: r.to_csv("x.csv", []), "Result.to_csv: names = [] is given alone Leave it out to have all signals."),
        (lambda r: r.to_csv("x.csv", side="right"), "Result.to_csv: there is no argument side."),
        (lambda r: r.to_pandas(name="block.x"), "Result.to_pandas: there is no argument name. Did you mean names?"),
        (lambda r: r.match(None), "match: pattern = nothing is not a text."),
        (lambda r: r.plot("block.x", file="nodir/x.png"), "nodir/x.png cannot be written: there is no folder nodir"),
        (lambda r: r.to_csv("nodir/x.csv"), "path = nodir/x.csv cannot be written: there is no folder nodir Make the"),
        (lambda r: r.to_excel("nodir/x.xlsx"), "path = nodir/x.xlsx cannot be written: there is no folder nodir"),
        (lambda r: r.to_csv("."), "Result.to_csv: path = . is a folder Give the name of a file in it."),
        (lambda r: r.plot("block.x", size=3), "Result.plot: there is no argument size. Arguments are title, between"),
        (lambda r: r.plot("block.x", titel="x"), "there is no argument titel. Did you mean title?"),
        (lambda r: r.plot("block.x", between=(5, 6)), "between = (5, 6) has nothing to show The run was recorded"),
        (lambda r: r.at("block.x", None), "t = nothing is no time: give a number of seconds"),
        (lambda r: r.at("block.x", "0.5 kg"), "t = 0.5 kg is no time: 0.5 kg is a mass, not a time."),
        (lambda r: r.at("block.x", True), "t = true is no time: give a number of seconds"),
        (lambda r: r.at("block.x", np.True_), "t = True is no time: give a number of seconds"),
        (lambda r: r.at("block.x", [0.5, True]), "t = a list of 2 is no time: give a number of seconds"),
        (lambda r: r.at("block.x", np.array([True])), "is no time: give a number of seconds, or an array of them"),
        (lambda r: r.at("block.x", np.timedelta64(500, "ms")), "is no time: give a number of seconds"),
        (lambda r: r.at("block.x", 1j), "is no time: give a number of seconds"),
        (lambda r: r.at("block.x", ["0.5 s", "1 kg"]), "t = 1 kg is no time: 1 kg is a mass, not a time."),
        (lambda r: r.events[True], "True is no number; rows are 0 to"),
        (lambda r: r.energy[True], "True is no number; rows are 0 to"),
        (lambda r: r.events[1000], "1000: rows are 0 to"),
        (lambda r: r.events["zone"], "zone: the columns are t, component, zone_from"),
        (lambda r: r.energy["stord"], "stord: the columns are entry, energy. Did you mean stored?"),
        (lambda r: r.energy["stored"], "stored is a row: [2] gives it."),
        (lambda r: r.energy[100], "100: rows are 0 to"),
        (lambda r: r.energy[None], "nothing: the columns are entry, energy."),
        (lambda r: r.animation(height=-3), "Result.animation: height = -3 is below 1"),
        (lambda r: r.animation(height="big"), "Result.animation: height = big is not a whole number"),
    ],
)  # fmt: skip
def test_a_result_refuses_them_and_writes_nothing(result, call, says, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert says in told(call, result)
    assert not list(tmp_path.iterdir())


def test_a_mode_that_there_is_not_is_told_by_number(model):
    assert told(lambda: fairlead.modes(model, zones={"pad": "sliding"})[5]) == "5: modes are 0 to 0"
    assert told(lambda: fairlead.modes(model)[5]) == "5: there are no modes"


def test_errors_of_tables_are_those_of_python_as_well(result):
    with pytest.raises(KeyError, match="the columns are"):
        result.energy["stord"]
    with pytest.raises(IndexError, match="rows are"):
        result.events[1000]


def test_zone_changes_give_columns_by_name_as_tables_do(result):
    assert result.events["t"] == [one.t for one in result.events]
    assert result.events[:1] == [result.events[0]]
    assert result.events[-1] is list(result.events)[-1]


def test_a_time_with_its_unit_is_taken(result):
    assert result.at("block.x", "500 ms") == result.at("block.x", 0.5)
    assert result.at("block.x", ["500 ms", "0.5 s"]).tolist() == result.at("block.x", [0.5, 0.5]).tolist()
    assert result.at("block.x", 1) == result.at("block.x", np.int32(1)) == result.at("block.x", np.float32(1))


def test_a_case_whose_value_does_not_fit_is_told_as_of_its_call(cases):
    assert told(lambda: cases.result({"block.mass": True})).startswith("Cases.result: block.mass = true is not a mass")


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda s: s.get(["speed"]), "get: name = a list of 1 is not the name of a signal, which is a text"),
        (lambda s: s.set(["speed"], 1), "set: there is no input"),
        (lambda s: s.advance(0.1, until_change="yes"), "advance: until_change = yes is neither True nor False"),
        (lambda s: s.advance(0.1, until_chang=True), "there is no argument until_chang. Did you mean until_change?"),
    ],
)
def test_a_run_that_is_stepped_refuses_them_and_stays(stepping, call, says):
    assert says in told(call, stepping)
    assert stepping.t == 0


@pytest.mark.parametrize("out", ["5", "2026", "5 N", "s", "run 5 s"])
def test_other_names_of_folders_are_taken(model, out, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    model.run(out, stop=0.01)
    assert [one.name for one in tmp_path.iterdir()] == [out]


def test_two_frequencies_may_be_an_array(model):
    found = fairlead.modes(model, acting="block", out="block.x", frequencies=np.array([1.0, 9.0]))
    assert found.response.frequencies[-1] == pytest.approx(9.0)


@pytest.mark.slow
def test_names_may_come_from_an_iterator(model):
    assert len(fairlead.sensitivity(model, (one for one in ["end(block.x)"]), iter(["block.mass"])).rows) == 1


def test_a_remark_on_the_grid_looks_at_the_run_that_is_made():
    model = fairlead.load("belt", set={"record.every": "0.2 s", "run.stop": "0.1 s", "run.max_steps": 100})
    assert not any("longer than the run" in one for one in model.run(out=None, stop=0.3, check=False).remarks)
    assert any("longer than the run of 0.05 s" in one for one in _quietly(model, stop=0.05).remarks)


def _quietly(model, **settings):
    with pytest.warns(fairlead.RunWarning, match="longer than the run"):
        return model.run(out=None, check=False, **settings)


def test_ida_writes_nothing_to_the_stdout_of_the_process(capfd):
    pytest.importorskip("sksundae", reason="pip install 'fairlead[ida]'")
    fairlead.load("belt", set={"run.stop": 1.0, "run.engine": "ida"}).run(out=None)
    assert "".join(capfd.readouterr()) == ""
