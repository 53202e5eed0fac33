"""What Tab offers: models, types, names for --set, signals; nothing where nothing can be read."""

import os
import subprocess
import sys
from types import SimpleNamespace

import pytest

from fairlead.cli import completion

SCENE = """schema: 1
parameters: {mu: 0.3, speed: 1 m/s}
components:
  floor: {type: Ground}
  block: {type: Mass, mass: 1 kg}
  pad: {type: Contact, normal_force: 1 N, curve: "{mu}"}
connections: [[floor.flange, pad.a], [pad.b, block.flange]]
run: {stop: 1 s}
limits: {pad.slip: {below: 1 m/s}}
"""


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.yaml").write_text(SCENE)
    (tmp_path / "scenes").mkdir()
    return tmp_path


def typed(*words):
    """What click knows of a command of which these words have been typed."""
    return SimpleNamespace(params={"netlist": None}, args=list(words))


def test_models_files_and_folders_are_offered():
    assert completion.netlists("bel") == ["belt"]
    assert completion.netlists("min") == ["mine.yaml"]
    assert completion.netlists("sce") == ["scenes/"]
    assert completion.netlists("single_parts/wo") == ["single_parts/worm"]


def test_types_are_offered():
    assert completion.subjects("PiC") == ["PiController"]
    assert completion.subjects("typ") == ["types"]


def test_names_for_set_are_those_of_the_netlist():
    assert completion.settings(typed("mine.yaml"), "m") == ["mu="]
    assert completion.settings(typed("mine.yaml"), "pad.m") == ["pad.method="]
    assert "block.mass=" in completion.settings(typed("mine.yaml"), "block.")
    assert completion.settings(typed("--json", "mine.yaml"), "run.sto") == ["run.stop="]
    assert completion.settings(typed("mine.yaml"), "limits.pad.slip.a") == ["limits.pad.slip.above="]


def test_signals_are_offered():
    assert completion.signals(typed("mine.yaml"), "block.") == ["block.x", "block.v"]


def test_what_cannot_be_read_offers_nothing(folder):
    (folder / "broken.yaml").write_text("{")
    assert completion.settings(typed("nothing.yaml"), "m") == []
    assert completion.settings(typed("broken.yaml"), "m") == []
    assert completion.signals(typed(), "m") == []


@pytest.mark.slow
def test_a_shell_is_offered_the_same():
    words = "fairlead check mine.yaml --set m"
    given = {**os.environ, "_FAIRLEAD_COMPLETE": "complete_bash", "COMP_WORDS": words, "COMP_CWORD": "4"}
    code = "from fairlead.cli import main; main()"
    done = subprocess.run([sys.executable, "-c", code], env=given, capture_output=True, text=True, check=False)
    assert done.stdout.split() == ["mu="]


def test_parameters_are_offered_without_an_equals_sign_also_behind_a_comma():
    ctx = typed("mine.yaml")
    assert completion.parameters(ctx, "m") == ["mu"]
    assert completion.parameters(ctx, "mu,pad.nor") == ["mu,pad.normal_force"]
    assert not any(name.startswith(("run.", "limits.")) for name in completion.parameters(ctx, ""))
