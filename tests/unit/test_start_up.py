"""Starting is light: what is heavy loads when it is needed, not before."""

import json
import os
import pathlib
import subprocess
import sys

import pytest

from fairlead.cli import main

BELT = pathlib.Path(__file__).resolve().parents[2] / "models" / "belt.yaml"
HEAVY = {"numpy", "sympy", "xarray", "matplotlib", "numba", "pandas", "scipy", "pint"}


def loaded_by(statement: str) -> set[str]:
    """Modules in memory after a fresh interpreter ran `statement`."""
    script = f"""
import json, sys
try:
    {statement}
except SystemExit:
    pass
print(json.dumps(sorted(sys.modules)), file=sys.stderr)
"""
    command = [sys.executable, "-c", script]
    done = subprocess.run(command, capture_output=True, text=True, check=True, timeout=600)
    return set(json.loads(done.stderr.splitlines()[-1]))


@pytest.mark.parametrize(
    "statement",
    [
        "import fairlead",
        "import fairlead.cli; sys.argv = ['fairlead', '--help']; fairlead.cli.main()",
        "import fairlead.cli; sys.argv = ['fairlead', 'run', '--help']; fairlead.cli.main()",
    ],
    ids=["import", "help", "help-of-run"],
)
def test_starting_loads_nothing_heavy(statement: str) -> None:
    assert loaded_by(statement) & HEAVY == set()


def test_until_the_command_answers_ctrl_c_nothing_of_the_package_is_read_in() -> None:
    """It takes 50 ms; what Ctrl-C met there was told by Python, with a traceback."""
    found = loaded_by("import fairlead.__main__")
    assert {name for name in found if name.startswith("fairlead.")} == {"fairlead.__main__"}
    assert not found & {"dataclasses", "inspect", "ast"}


def test_all_names_of_the_package_are_there_when_they_are_asked_for() -> None:
    import fairlead

    assert {*fairlead.__all__} <= {*dir(fairlead)}
    assert {name for name in fairlead.__all__ if getattr(fairlead, name).__name__ != name} == set()
    assert "fairlead.errors" in loaded_by("import fairlead; fairlead.errors.RunWarning")


@pytest.mark.slow
def test_a_model_of_known_classes_runs_without_what_traces_and_compiles_them() -> None:
    run = "import fairlead; fairlead.load('belt').run(out=None, stop=0.1)"
    loaded_by(run)
    assert loaded_by(run) & {"sympy", "numba", "matplotlib"} == set()


UNUSED = {
    "networkx", "rich", "sympy", "numba", "matplotlib", "scipy", "xarray", "pandas", "numpy.ma", "numpy.polynomial",
    "fairlead.cli.sweep", "fairlead.cli.fit", "fairlead.analysis.statics", "fairlead.analysis.margins",
    "fairlead.system.active.subsystem", "fairlead.results.run_schema", "fairlead.results.table",
    "fairlead.results.export",
}  # fmt: skip
"""What a run of a scene without a line, into a folder of its own, has no use for; some are packages with many more."""


def test_a_run_from_the_shell_loads_nothing_that_it_does_without(tmp_path) -> None:
    netlist = tmp_path / "plain.yaml"
    netlist.write_text(BELT.read_text(encoding="utf-8").partition("  plots:")[0], encoding="utf-8")
    for folder in ("cold", "warm"):
        arguments = ["fairlead", "run", str(netlist), "--out", str(tmp_path / folder)]
        loaded = loaded_by(f"import fairlead.cli; sys.argv = {arguments}; fairlead.cli.main()")
    assert (tmp_path / "warm" / "run.json").exists()
    assert loaded & UNUSED == set()


@pytest.mark.parametrize(("given", "then"), [({}, "1"), ({"OPENBLAS_NUM_THREADS": "3"}, "3")], ids=["none", "some"])
def test_a_run_from_the_shell_starts_no_threads_of_linear_algebra_unless_asked_for(monkeypatch, given, then) -> None:
    environment = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"} | given
    monkeypatch.setattr(os, "environ", environment)
    monkeypatch.setattr(sys, "argv", ["fairlead", "run", "--help"])
    with pytest.raises(SystemExit):
        main()
    assert environment["OPENBLAS_NUM_THREADS"] == then
