"""`fairlead run --profile`: counts are those of the run, components have names, and there is one suggestion."""

from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import pytest

import fairlead
from fairlead.analysis.record.profile import Times, _laws, suggestion

STEPPING = Times(compiling=0.1, stepping=1.0, wall=1.2)


def counters(**counts: int) -> SimpleNamespace:
    return SimpleNamespace(**{"steps": 1000, "located": 0, "rejected": 0, "switches": 0, **counts})


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> dict:
    return dict(fairlead.load("belt").run(out=tmp_path_factory.mktemp("belt") / "run", profile=True).run)


def test_switches_are_counted_by_component_and_by_class(run: dict) -> None:
    lines = run["profile"].splitlines()
    assert f"  {run['switches']:>8}  pad" in lines
    assert any("100 %" in line and "Hold[Coulomb]" in line for line in lines)


def test_rejected_steps_are_due_to_named_unknowns_and_add_up(tmp_path: Path) -> None:
    run = fairlead.load("block_and_spring").run(out=tmp_path / "run", profile=True).run
    assert run["rejected"] > 0
    lines = run["profile"].splitlines()
    first = lines.index("rejected steps by the unknown with the largest error:") + 1
    counts = [int(line.split()[0]) for line in lines[first:-1]]
    assert sum(counts) <= run["rejected"]
    assert all("." in line.split()[1] for line in lines[first:-1])


def test_there_is_one_suggestion(run: dict) -> None:
    assert run["profile"].count("suggestion:") == 1


def test_a_component_that_makes_most_switches_is_named() -> None:
    said = suggestion(counters(located=800, switches=800), STEPPING, {"pad": 700, "other": 100}, {})
    assert "pad makes 700 of 800" in said


def test_no_component_is_blamed_for_switches_that_all_make() -> None:
    said = suggestion(counters(located=800, switches=800), STEPPING, {f"pad_{k}": 8 for k in range(100)}, {})
    assert "switch" in said
    assert "pad" not in said


def test_many_rejected_steps_point_to_the_worst_unknown() -> None:
    assert "block.v" in suggestion(counters(rejected=900), STEPPING, {}, {"a.v": 1, "block.v": 800})


def test_a_smooth_run_is_told_what_a_looser_accuracy_brings() -> None:
    assert "accuracy" in suggestion(counters(), STEPPING, {}, {})


def test_a_short_run_is_not_told_to_change_its_physics() -> None:
    assert "compiling" in suggestion(counters(located=900, switches=900), Times(2.0, 0.1, 2.2), {"pad": 900}, {})
    assert "record" in suggestion(counters(located=900, switches=900), Times(0.1, 0.1, 3.0), {"pad": 900}, {})


def test_times_that_cannot_be_right_are_not_shown() -> None:
    assert _laws(Counter({"Mass x 1": 3.0}), 1.0) == ["laws: too short to be timed one by one"]
    assert any("25 %" in line for line in _laws(Counter({"Mass x 1": 0.25}), 1.0))


def test_a_run_without_a_profile_has_none(tmp_path: Path) -> None:
    assert "profile" not in fairlead.load("belt", set={"run.stop": "0.1"}).run(out=tmp_path / "run").run
