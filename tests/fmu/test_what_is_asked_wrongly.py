"""What is asked of an FMU or a library and means nothing is told; what somebody edited is not written over."""

import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.errors import RunWarning, UsageError
from fairlead.fmu import export, export_library
from fairlead.fmu.library import _is_edited
from tests.fmu.exported import PUSHED, model, needs_compiler

PULLED = """
components:
  push: {type: ForceSource, force: {ramp: {to: 3 N, over: 2 s}, sine: [{amplitude: 1 N, frequency: 2 Hz}]}}
  block: {type: Mass, mass: 2 kg, velocity: 0.1 m/s}
connections: [[push.flange, block.flange]]
run: {stop: 1 s, engine: rodas}
"""
OF_TIME = "it says at which times something happens"


def test_a_version_of_the_standard_is_not_taken_for_a_library(tmp_path):
    answer = CliRunner().invoke(app, ["fmu", "library", "belt", "--fmi", "2", "-o", str(tmp_path / "belt")])
    assert answer.exit_code != 0
    assert isinstance(answer.exception, UsageError) or "--fmi 2 is of an FMU" in answer.output
    assert "--fmi 2 is of an FMU, and a library has no version" in f"{answer.exception}{answer.output}"
    assert not (tmp_path / "belt").exists()


def test_an_example_that_was_edited_stays(tmp_path):
    needs_compiler()
    pushed = model(tmp_path, "pushed", PUSHED)
    folder = export_library(pushed, tmp_path / "pushed")
    example = folder / "example.c"
    assert not _is_edited(example, "that of another model")
    assert not _is_edited(folder / "none.c", "")
    edited = example.read_text().replace("int main", "/* mine */\nint main")
    example.write_text(edited)
    with pytest.warns(RunWarning, match=r"example\.c is not as it was written, and stays"):
        export_library(pushed, folder)
    assert example.read_text() == edited


def test_the_largest_of_several_signals_gets_a_name_in_the_netlist(tmp_path):
    with pytest.raises(UsageError) as told:
        export(fairlead.load("belt"), tmp_path / "no.fmu", outputs=["max(pad.*)"])
    assert 'interface: {outputs: {NAME: {of: "max(pad.*)"}}}' in str(told.value)


@pytest.mark.slow
def test_numbers_of_quantities_in_time_are_tuned_by_name(tmp_path):
    """In Python and in a library; what says when something happens stays as it is there, and that is told."""
    needs_compiler()
    pulled = model(tmp_path, "pulled", PULLED)
    names = ["push.force.ramp.to", "push.force.sine.0.amplitude"]
    run = pulled.start(tunable=[*names, "push.force.ramp.over"])
    told = {one.name: (one.start, one.unit) for one in run.variables}
    assert told == {names[0]: (3.0, "N"), names[1]: (1.0, "N"), "push.force.ramp.over": (2.0, "s")}
    header = (export_library(pulled, tmp_path / "pulled", outputs=["block.v"], tunable=names) / "pulled.h").read_text()
    assert "push.force.ramp.to [N]; 3 until it is set" in header
    with pytest.raises(UsageError, match=f"over cannot be set in the FMU: {OF_TIME}"):
        export_library(pulled, tmp_path / "no", outputs=["block.v"], tunable=["push.force.ramp.over"])
    with pytest.raises(UsageError, match=r"Did you mean push\.force\.ramp\.to"):
        export_library(pulled, tmp_path / "no", outputs=["block.v"], tunable=["push.force.ramp.too"])


def test_what_says_how_a_run_begins_is_set_until_it_advances_also_after_something_was_read(tmp_path):
    """As an FMU takes it in its initialisation: the block begins with the other speed and mass."""
    pulled = model(tmp_path, "pulled", PULLED)
    run, other = (pulled.start(tunable=["block.velocity", "block.mass"]) for _ in range(2))
    assert run.get("block.v") == 0.1
    for one in (run, other):
        one.set("block.velocity", 0.3)
        one.set("block.mass", 4.0)
    assert run.get("block.v") == 0.3
    run.advance(0.5)
    other.advance(0.5)
    assert (run.get("block.v"), run.get("block.x")) == (other.get("block.v"), other.get("block.x"))
    with pytest.raises(UsageError, match=r"block\.velocity says how a run begins"):
        run.set("block.velocity", 0.2)
