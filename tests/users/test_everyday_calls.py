"""What is typed without looking it up: a short option, one call, a class by its name, two names."""

import pathlib

import pytest
from typer.main import get_command
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.errors import ModelError, UsageError
from fairlead.results import UnknownSignalError

MODELS = pathlib.Path(__file__).parents[2] / "models"

OF_A_SIGNAL = {"modes", "fmu"}
"""Commands whose --out is a signal."""


def test_where_results_go_is_o_in_every_command_that_writes():
    short = {
        name: "-o" in option.opts
        for name, command in get_command(app).commands.items()
        for option in command.params
        if "--out" in option.opts and name not in OF_A_SIGNAL
    }
    assert len(short) >= 10
    assert [name for name, has in short.items() if not has] == []


@pytest.fixture(scope="module")
def result():
    return fairlead.run("belt", {"pad.normal_force": "10 N"}, stop="0.5 s", out=None)


def test_a_netlist_is_run_in_one_call_as_by_load_and_run(result):
    parted = fairlead.load("belt", set={"pad.normal_force": "10 N"}).run(stop="0.5 s", out=None)
    assert result.run["end_time"] == 0.5
    assert result["block.x"].tolist() == parted["block.x"].tolist()


def test_one_call_refuses_what_the_two_refuse():
    with pytest.raises(ModelError, match="Did you mean accuracy"):
        fairlead.run("belt", acuracy=1e-3)
    with pytest.raises(ModelError, match="Did you mean belt"):
        fairlead.run("bel")
    with pytest.raises(UsageError, match=r"is a Model already\. Write model\.run"):
        fairlead.run(fairlead.load("belt"))
    with pytest.raises((UsageError, ModelError), match="run: check = no is neither True nor False"):
        fairlead.run("belt", check="no", out=None)


@pytest.mark.parametrize(("given", "way"), [("belt", 'fairlead.load("belt")'), (MODELS / "belt.yaml", "belt.yaml\")"),
                                            (3, "fairlead.load(PATH)")])  # fmt: skip
def test_a_model_made_of_a_path_tells_the_way(given, way):
    with pytest.raises(UsageError, match=r"is no netlist that was read\. Write fairlead\.load") as caught:
        fairlead.Model(given)
    assert way in str(caught.value)


def test_names_to_plot_follow_one_another_or_stand_in_a_list(result):
    listed = [line.get_label() for axes in result.plot(["block.x", "pad.slip"]).axes for line in axes.lines]
    named = [line.get_label() for axes in result.plot("block.x", "pad.slip").axes for line in axes.lines]
    assert named == listed
    assert len(result.plot("block.x", "pad.slip").axes) == 2
    with pytest.raises(UnknownSignalError, match=r"Did you mean block\.x"):
        result.plot("pad.slip", "blok.x")
    with pytest.raises(UnknownSignalError, match="5 is not the name of a signal"):
        result.plot("pad.slip", 5)


@pytest.mark.parametrize("end", ["rope", "route"])
def test_a_misnamed_end_of_a_path_is_told_as_itself_only(tmp_path, end):
    """Neither line nor route is blamed for leading nowhere."""
    text = (MODELS / "capstan.yaml").read_text(encoding="utf-8")
    assert f"{end}.path" in text
    (tmp_path / "capstan.yaml").write_text(text.replace(f"{end}.path", f"{end}x.path"), encoding="utf-8")
    with pytest.raises(ModelError) as caught:
        fairlead.load(tmp_path / "capstan.yaml").check()
    assert [fault.what for fault in caught.value.faults] == [f"{end}x.path: there is no component {end}x"]


def test_a_line_that_is_joined_with_no_route_is_still_told(tmp_path):
    text = (MODELS / "capstan.yaml").read_text(encoding="utf-8").replace("  - [rope.path, route.path]\n", "")
    (tmp_path / "capstan.yaml").write_text(text, encoding="utf-8")
    with pytest.raises(ModelError, match=r"rope\.path is connected to nothing"):
        fairlead.load(tmp_path / "capstan.yaml").check()


def test_plot_takes_signals_by_name_and_tells_what_can_be_drawn(tmp_path):
    fairlead.run("belt", stop="0.5 s", out=tmp_path / "run")
    shell = CliRunner()
    named = shell.invoke(app, ["plot", str(tmp_path / "run"), "block.x", "pad.slip", "-o", str(tmp_path / "two.svg")])
    assert named.exit_code == 0, named.output
    assert (tmp_path / "two.svg").stat().st_size > 1000
    wrong = shell.invoke(app, ["plot", str(tmp_path / "run"), "profle"])
    assert wrong.exit_code == 2
    assert "Did you mean profile?" in " ".join(wrong.output.replace("│", " ").split())
    unknown = shell.invoke(app, ["plot", str(tmp_path / "run"), "blok.x"])
    assert "Did you mean block.x?" in f"{unknown.exception} {unknown.output}"
