"""The command line: what it passes on, what it prints where, and how it ends.

The stages behind it are replaced by a stand-in that answers like `fairlead.load`, so these tests say
what the command line itself does; the whole way is walked in test_packaging.py and tests/models.
"""

import json
import pathlib
import warnings
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app
from fairlead.cli.summary import summary_rows
from fairlead.errors import FairleadError, Fault, Location, ModelError, NumericalError, UsageError

FINISHED = {
    "status": "finished",
    "end_time": 20.0,
    "wall_time": 0.4,
    "compile_time": 0.1,
    "solve_time": 0.02,
    "engine": "rodas5p",
    "steps": 410,
    "rejected": 12,
    "switches": 31,
    "worst_creep": {"value": 2e-9, "contact": "pad"},
    "energy": {"closure": 3e-7, "supplied": 1.5, "dissipated": 1.2, "stored_change": 0.3},
}
Command = Callable[..., Any]
BELT = Location("models/belt.yaml", 9, 6)


class StandIn:
    """A model that remembers how it was called and answers with what it was given."""

    def __init__(self, run: dict[str, Any] | None = None, raises: BaseException | None = None) -> None:
        self.outcome, self.raises = run or FINISHED, raises
        self.calls: list[tuple[Any, ...]] = []
        self.netlist = SimpleNamespace(name="belt", record=SimpleNamespace(plots=[], every=None))
        self.remarks: list[Fault] = []

    def load(self, path: str, set: dict[str, str], libraries: list[str], *, allow_fmu: bool = False) -> "StandIn":
        self.calls.append(("load", path, set, libraries))
        self.allow_fmu = allow_fmu
        return self

    def _answer(self, *call: Any) -> None:
        self.calls.append(call)
        if self.raises is not None:
            raise self.raises

    def check(self) -> list[Fault]:
        self._answer("check")
        return self.remarks

    def describe(self, stage: str) -> str:
        self._answer("describe", stage)
        return f"the output of {stage}"

    def graph(self, kind: str) -> str:
        self._answer("graph", kind)
        return f"a {kind} drawing"

    def run(self, **settings: Any) -> SimpleNamespace:
        self._answer("run", settings)
        folder = pathlib.Path("results/belt")
        return SimpleNamespace(run=self.outcome, path=folder, folder=folder)


@pytest.fixture
def command(monkeypatch: pytest.MonkeyPatch) -> Command:
    """Call `fairlead WORDS` with a stand-in behind it; gives typer's result."""

    def call(*words: str, model: StandIn | None = None) -> Any:
        monkeypatch.setattr(fairlead, "load", (model or StandIn()).load, raising=False)
        return CliRunner().invoke(app, list(words))

    return call


def test_settings_and_libraries_reach_the_loader_as_typed(command: Command) -> None:
    model = StandIn()
    settings = ("--set", "mu=0.6", "--set", "v = 2 m/s")
    command("check", "belt", *settings, "--library", "a.py", "--library", "b.py", model=model)
    libraries = ["a.py", "b.py"]
    assert model.calls[0] == ("load", "belt", {"mu": "0.6", "v": "2 m/s"}, libraries)
    assert not model.allow_fmu


@pytest.mark.parametrize("setting", ["mu", "mu=", "=0.6", ""])
def test_a_setting_without_name_or_value_is_a_usage_error(command: Command, setting: str) -> None:
    answer = command("run", "belt", "--set", setting)
    assert answer.exit_code == 2
    assert "NAME=VALUE" in answer.stderr


@pytest.mark.parametrize("given", [("--out", ""), ("--out=",), ("-o", "")])
def test_a_folder_without_a_name_is_not_the_working_folder(command: Command, given: tuple[str, ...]) -> None:
    """Left by a variable of the shell that is not set; with --force files of the working folder would be replaced."""
    model = StandIn()
    answer = command("run", "belt", "--force", *given, model=model)
    assert answer.exit_code == 2
    assert "is given no name" in answer.stderr
    assert model.calls == []


def test_setting_a_parameter_twice_is_a_usage_error(command: Command) -> None:
    assert command("run", "belt", "--set", "mu=1", "--set", "mu=2").exit_code == 2


def test_an_unknown_option_is_a_usage_error(command: Command) -> None:
    assert command("run", "belt", "--fast").exit_code == 2


def test_a_sound_netlist_ends_with_zero(command: Command) -> None:
    answer = command("check", "belt")
    assert (answer.exit_code, answer.stderr) == (0, "")
    assert "no mistakes" in answer.stdout


def test_quiet_says_nothing_when_all_is_well(command: Command) -> None:
    for verb in ("check", "run"):
        assert command(verb, "belt", "-q").output == ""


def test_remarks_of_a_sound_netlist_go_to_standard_error(command: Command) -> None:
    model = StandIn()
    model.remarks = [Fault(BELT, "spring is never stretched.")]
    answer = command("check", "belt", model=model)
    assert answer.exit_code == 0
    assert answer.stderr == "warning: models/belt.yaml:9:6: spring is never stretched.\n"


MISTAKES = ModelError(
    [Fault(BELT, "spring.c: no such port.", "Did you mean spring.b?"), Fault(None, "No ground.")]
)


def test_all_mistakes_are_told_without_a_traceback(command: Command) -> None:
    answer = command("check", "belt", model=StandIn(raises=MISTAKES))
    assert answer.exit_code == 1
    assert answer.stdout == ""
    assert answer.stderr == f"{MISTAKES}\n"


def test_json_gives_the_mistakes_with_their_places(command: Command) -> None:
    answer = command("check", "belt", "--json", model=StandIn(raises=MISTAKES))
    told = json.loads(answer.stdout)
    assert (answer.exit_code, told["ok"], len(told["faults"])) == (1, False, 2)
    assert told["faults"][0] == {
        "file": "models/belt.yaml",
        "line": 9,
        "column": 6,
        "what": "spring.c: no such port.",
        "way_out": "Did you mean spring.b?",
    }
    assert told["faults"][1]["file"] is None


@pytest.mark.parametrize(
    ("error", "code"),
    [(MISTAKES, 1), (NumericalError("NaN"), 3), (KeyboardInterrupt(), 130)],
    ids=["model", "numerical", "ctrl-c"],
)
def test_each_kind_of_failure_has_its_exit_code(command: Command, error: BaseException, code: int) -> None:
    answer = command("run", "belt", model=StandIn(raises=error))
    assert answer.exit_code == code
    assert "Traceback" not in answer.output


def test_verbose_adds_the_traceback_of_a_failure(command: Command) -> None:
    answer = command("run", "belt", "-v", model=StandIn(raises=NumericalError("NaN in block.v")))
    assert "Traceback" in answer.stderr


def test_an_unforeseen_exception_gives_lines_to_send_and_no_traceback(command: Command) -> None:
    answer = command("run", "belt", model=StandIn(raises=KeyError("lost")))
    assert answer.exit_code == 70
    assert "KeyError: 'lost'" in answer.stderr
    assert "CONTRIBUTING.md" in answer.stderr
    assert "Traceback" not in answer.stderr
    assert "Traceback" in command("run", "belt", "-v", model=StandIn(raises=KeyError("lost"))).stderr


@pytest.mark.parametrize(
    ("status", "code"),
    [("finished", 0), ("interrupted", 130), ("budget", 4), ("failed", 3)],
)
def test_the_status_of_a_kept_run_becomes_the_exit_code(command: Command, status: str, code: int) -> None:
    answer = command("run", "belt", model=StandIn(run={**FINISHED, "status": status}))
    assert answer.exit_code == code
    assert "results/belt" in answer.stdout      # what was computed is kept, and the user is told where


def test_a_broken_limit_is_named_and_ends_with_five(command: Command) -> None:
    model = StandIn(run={**FINISHED, "limits_broken": ["line.hose.tension below -160 N at 3.2 s"]})
    answer = command("run", "belt", model=model)
    assert answer.exit_code == 5
    assert "line.hose.tension" in answer.stderr


def test_the_closing_table_says_what_a_run_cost_and_how_far_to_trust_it() -> None:
    rows = dict(summary_rows(FINISHED, "results/belt"))
    assert list(rows) == [
        "end time", "wall time", "engine", "steps", "rejected", "switches",
        "worst creep", "energy closure", "results",
    ]  # fmt: skip
    assert rows["worst creep"] == "2e-09 m/s in pad"
    assert rows["energy closure"].startswith("3e-07")


def test_a_run_that_kept_little_still_gets_its_table() -> None:
    assert dict(summary_rows({"status": "failed"}, "here"))["steps"] == "not known"


def test_json_of_a_run_is_its_record_and_directory(command: Command) -> None:
    told = json.loads(command("run", "belt", "--json").stdout)
    assert told["steps"] == FINISHED["steps"]
    assert told["directory"] == str(pathlib.Path("results/belt"))


def test_options_of_a_run_reach_the_model(command: Command) -> None:
    model = StandIn()
    command("run", "belt", "--out", "there", "--force", "--profile", model=model)
    options = {"out": pathlib.Path("there"), "force": True, "profile": True, "check": False}
    name, given = model.calls[-1]
    progress = given.pop("progress")  # looks at what is written, and there is no bar behind it
    assert (name, given, progress.progress) == ("run", options, None)


def test_progress_is_not_shown_where_nobody_watches(command: Command) -> None:
    assert command("run", "belt").stderr == ""


def test_warnings_are_one_line_on_standard_error(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    model = StandIn()

    def check() -> list[Fault]:
        warnings.warn("kernel cache not used", stacklevel=1)
        return []

    monkeypatch.setattr(model, "check", check)
    assert command("check", "belt", model=model).stderr == "warning: kernel cache not used\n"


def test_describe_alone_says_what_may_follow(command: Command) -> None:
    answer = command("describe")
    assert answer.exit_code == 2
    for word in ("describe types", "describe Worm", "describe belt", "describe hold"):
        assert word in answer.output
        assert command(*word.split()).exit_code == 0


def test_describe_tells_types_from_models(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fairlead, "describe_type", lambda name, libraries: f"the type {name}", raising=False)
    assert command("describe", "Spring", "--all").stdout == "the type Spring\n"
    assert "stiffness" in command("describe", "Spring").stdout
    assert command("describe", "belt", "--stage", "system").stdout == "the output of system\n"
    assert command("describe", "Odd.yaml").stdout == "the output of flatten\n"


def test_graph_takes_its_format_from_the_ending(command: Command, tmp_path: pathlib.Path) -> None:
    assert command("graph", "belt").stdout == "a mermaid drawing\n"
    command("graph", "belt", "--out", str(tmp_path / "new" / "belt.svg"))
    assert (tmp_path / "new" / "belt.svg").read_text() == "a svg drawing"


def test_schema_is_json(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fairlead, "json_schema", lambda libraries: {"type": "object"}, raising=False)
    assert json.loads(command("schema").stdout) == {"type": "object"}


def test_doctor_names_a_cure_for_a_cache_that_cannot_be_used(
    monkeypatch: pytest.MonkeyPatch, tmp_path: pathlib.Path
) -> None:
    from fairlead.cli import health

    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("FAIRLEAD_CACHE", str(tmp_path / "file" / "folder"))
    from fairlead import native

    native._warn_once.cache_clear()
    finding = health.kernel_cache()
    assert not finding.well
    assert "FAIRLEAD_CACHE" in finding.cure


def test_doctor_ends_with_one_when_something_is_to_be_mended(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    from fairlead.cli import health

    ill = health.Finding("kernel cache", "cannot be written", "chmod 700")
    monkeypatch.setattr(health, "examine", lambda: iter([health.Finding("versions", "new"), ill]))
    answer = command("doctor")
    assert answer.exit_code == 1
    assert "cure: chmod 700" in answer.stdout
    assert json.loads(command("doctor", "--json").stdout)["findings"][1]["well"] is False
    assert "versions" not in command("doctor", "-q").stdout


def test_every_error_of_ours_has_an_exit_code_of_the_documented_ones() -> None:
    def family(kind: type[FairleadError]) -> set[type[FairleadError]]:
        return {kind}.union(*(family(child) for child in kind.__subclasses__()))

    assert {kind.exit_code for kind in family(FairleadError)} <= {1, 2, 3, 4, 5}


@pytest.mark.parametrize(
    ("closure", "warned"), [(None, False), (1e-9, False), (0.09, False), (0.9, True), (float("nan"), True)]
)
def test_a_run_whose_energy_does_not_add_up_is_not_called_well(capsys, closure, warned):
    from fairlead.cli.run import _say_what_went_wrong

    _say_what_went_wrong({"status": "finished", "energy": {"closure": closure}})
    assert ("do not trust this run" in capsys.readouterr().err) == warned


def test_warnings_of_check_are_no_faults_in_json(command: Command) -> None:
    model = StandIn()
    model.remarks = [Fault(BELT, "spring is never stretched.")]
    told = json.loads(command("check", "belt", "--json", model=model).stdout)
    assert (told["ok"], told["faults"]) == (True, [])
    assert told["warnings"] == [
        {"file": "models/belt.yaml", "line": 9, "column": 6, "what": "spring is never stretched.", "way_out": ""}
    ]
    refused = json.loads(command("check", "belt", "--json", model=StandIn(raises=MISTAKES)).stdout)
    assert refused["warnings"] == []


class Impatient:
    """Stands for a module whose import is interrupted."""

    def __init__(self, name: str) -> None:
        self.name = name

    def find_spec(self, name: str, *_: object) -> None:
        if name == self.name:
            raise KeyboardInterrupt


def test_ctrl_c_while_the_program_loads_ends_like_one_later(monkeypatch, capsys):
    import sys

    from fairlead.__main__ import main

    monkeypatch.setattr("gc.set_threshold", lambda *_: None)  # a command has the process for itself
    monkeypatch.delitem(sys.modules, "fairlead.cli")
    monkeypatch.setattr(sys, "meta_path", [Impatient("fairlead.cli"), *sys.meta_path])
    with pytest.raises(SystemExit) as caught:
        main()
    assert caught.value.code == 130
    assert capsys.readouterr().err == "interrupted\n"


def test_ctrl_c_while_a_verb_loads_ends_like_one_later(monkeypatch):
    import sys

    monkeypatch.delitem(sys.modules, "fairlead.cli.verb")
    monkeypatch.delitem(sys.modules, "fairlead.model", raising=False)
    monkeypatch.setattr(fairlead, "load", StandIn(raises=KeyboardInterrupt()).load)
    said = CliRunner().invoke(app, ["check", "belt"])
    assert (said.exit_code, said.stderr) == (130, "interrupted\n")
    monkeypatch.setattr("fairlead.cli.Verb.make_context", interrupt)
    assert CliRunner().invoke(app, ["check", "belt"]).exit_code == 130


def interrupt(*_: object, **__: object) -> None:
    raise KeyboardInterrupt


def test_the_summary_does_not_wait_for_figures(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: Any, **__: Any) -> Any:
        raise UsageError("no figure can be drawn")

    monkeypatch.setattr("fairlead.report.figures.draw", fail)
    model = StandIn()
    model.netlist.record.plots = [{"signals": ["block.x"]}]
    answer = command("run", "belt", model=model)
    assert answer.exit_code == 2
    assert "steps" in answer.stdout
    assert "no figure can be drawn" in answer.stderr
    in_one = json.loads(command("run", "belt", "--json", model=model).stdout)
    assert in_one["error"] == "no figure can be drawn"


def test_ctrl_c_while_figures_are_drawn_keeps_the_summary(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: Any, **__: Any) -> Any:
        raise KeyboardInterrupt

    monkeypatch.setattr(fairlead.cli.run, "_write_extras", interrupted)
    answer = command("run", "belt")
    assert answer.exit_code == 130
    assert "steps" in answer.stdout
    assert "the results in" in answer.stderr
