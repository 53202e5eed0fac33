"""What `fairlead new` writes passes its checks as it is, runs, and replaces nothing."""

import runpy

import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.cli.beginnings import BEGINNINGS


def command(*words):
    answer = CliRunner().invoke(app, [*words])
    assert answer.exit_code == 0, answer.output
    return answer.output


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("kind", [kind for kind, begin in BEGINNINGS.items() if "yaml" in begin.files])
def test_a_scene_that_is_begun_has_no_mistake_and_no_remark_and_runs(kind, folder):
    command("new", kind, "my_own")
    libraries = ["my_own.py"] if (folder / "my_own.py").exists() else []
    model = fairlead.load("my_own.yaml", set={"run.stop": "0.5 s"}, libraries=libraries)
    assert [one for one in model.check() if "changes first" not in one.what] == []
    assert model.run(out=None).status == "finished"


def test_a_component_that_is_begun_keeps_the_contract():
    command("new", "component", "own_spring")
    runpy.run_path("own_spring.py", run_name="__main__")


def test_a_controller_that_is_begun_moves_the_block():
    """0.1 m are wanted, and friction of 1 N holds the block within 1 N / (200 N/m) of it."""
    command("new", "controller", "mover")
    result = fairlead.load("mover.yaml", libraries=["mover.py"]).run(out=None)
    assert result["block.x"][-1] == pytest.approx(0.1, abs=5.1e-3)


def test_a_friction_law_and_a_curve_that_are_begun_are_drawn():
    command("new", "friction", "own_law")
    command("friction", "0.4", "--method", "own_law", "--library", "own_law.py")
    command("new", "curve", "own_curve")
    said = command("friction", "{curve: own_curve, level: 0.3, growth: 0.1 s/m}", "--library", "own_curve.py")
    assert "0.3 N" in said  # 1 N presses, when nothing else is said


@pytest.mark.parametrize(("kind", "name"), [("friction", "hold"), ("curve", "stribeck"), ("component", "spring")])
def test_nothing_of_the_library_is_replaced(kind, name):
    answer = CliRunner().invoke(app, ["new", kind, name])
    assert answer.exit_code == 2
    assert "in the library already" in " ".join(answer.output.split())


def test_no_file_is_written_over(folder):
    (folder / "mine.yaml").write_text("mine")
    answer = CliRunner().invoke(app, ["new", "component", "mine"])
    assert answer.exit_code == 2
    assert (folder / "mine.yaml").read_text() == "mine"
    assert not (folder / "mine.py").exists()


def test_a_new_route_is_compared_with_statics(tmp_path, monkeypatch):
    """It is what its author looks at first: a run too short or without places says only that it was not compared."""
    monkeypatch.chdir(tmp_path)
    assert CliRunner().invoke(app, ["new", "route", "mine"]).exit_code == 0
    said = CliRunner().invoke(app, ["run", "mine.yaml"])
    assert "% at most" in said.output, said.output
