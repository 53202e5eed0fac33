"""The run directory: which places are taken, what a finished and an unfinished run leave."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from fairlead.errors import FairleadError, UsageError
from fairlead.results import Result, RunDirectory, Signal, recorder, run_file, store, waiting
from fairlead.results.damage import DamagedResultsError

SIGNALS = (Signal("block.v", "m/s", "speed of the block"),)


def finished(path: Path, status: str = "finished") -> None:
    run = RunDirectory.create(path, SIGNALS, {"name": "first"})
    run.append([0.0], [[1.0]], [0])
    run.finish(status, {"steps": 1})


def run_that_raises(path: Path, error: BaseException) -> None:
    with RunDirectory.create(path, SIGNALS, {}) as run:
        run.append([0.0], [[1.0]], [0])
        raise error


def pretend_killed(path: Path) -> None:
    """Leave run.json as a killed process leaves it: status running, and nobody who holds the lock."""
    record = run_file.read(path)
    assert record is not None
    run_file.write(path, {**record, "status": "running"})


@pytest.mark.parametrize("status", ["finished", "interrupted", "budget", "failed"])
def test_a_run_with_results_to_keep_is_not_overwritten(tmp_path: Path, status: str) -> None:
    finished(tmp_path / "run", status)
    with pytest.raises(UsageError, match="--force"):
        RunDirectory.create(tmp_path / "run", SIGNALS, {})
    assert len(Result.open(tmp_path / "run")["block.v"]) == 1


def test_force_replaces_a_finished_run(tmp_path: Path) -> None:
    finished(tmp_path / "run")
    RunDirectory.create(tmp_path / "run", SIGNALS, {"name": "second"}, force=True).finish("finished", {})
    result = Result.open(tmp_path / "run")
    assert result.run["name"] == "second"
    assert len(result.t) == 0
    assert "steps" not in result.run


def test_a_killed_run_is_not_replaced_without_force_once_it_has_rows(tmp_path: Path) -> None:
    finished(tmp_path / "run")
    pretend_killed(tmp_path / "run")
    assert Result.open(tmp_path / "run").status == "killed"
    with pytest.raises(UsageError, match=r"was begun at .* and killed\.\n.*--force"):
        RunDirectory.create(tmp_path / "run", SIGNALS, {})
    again = RunDirectory.create(tmp_path / "run", SIGNALS, {}, force=True)
    assert len(Result.open(tmp_path / "run" / "earlier")["block.v"]) == 1
    again.finish("finished", {})


@pytest.mark.parametrize("status", ["killed", "failed"])
def test_a_run_that_broke_off_before_its_first_row_is_replaced(tmp_path: Path, status: str) -> None:
    run = RunDirectory.create(tmp_path / "run", SIGNALS, {"name": "first"})
    if status == "failed":
        run.finish("failed", {})
        (tmp_path / "run" / "series.nc").unlink(missing_ok=True)
    del run
    RunDirectory.create(tmp_path / "run", SIGNALS, {"name": "second"}).finish("finished", {})
    assert Result.open(tmp_path / "run").run["name"] == "second"


def test_results_that_a_killed_run_was_to_replace_are_not_lost_without_force(tmp_path: Path) -> None:
    finished(tmp_path / "run")
    rerun(tmp_path / "run", "killed")
    with pytest.raises(UsageError, match="--force"):
        RunDirectory.create(tmp_path / "run", SIGNALS, {})
    assert Result.open(tmp_path / "run" / "earlier").run["name"] == "first"


def test_a_run_that_goes_on_is_not_overwritten(tmp_path: Path) -> None:
    run = RunDirectory.create(tmp_path / "run", SIGNALS, {})
    with pytest.raises(UsageError, match="is being written by process"):
        RunDirectory.create(tmp_path / "run", SIGNALS, {})
    run.finish("finished", {})


def test_a_folder_of_something_else_is_not_used(tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("")
    with pytest.raises(UsageError, match="holds no run of fairlead"):
        RunDirectory.create(tmp_path, SIGNALS, {})


def test_a_file_in_the_place_of_the_directory_is_never_replaced(tmp_path: Path) -> None:
    (tmp_path / "run").write_text("mine")
    with pytest.raises(UsageError, match="is a file"):
        RunDirectory.create(tmp_path / "run", SIGNALS, {}, force=True)


def test_only_files_of_a_run_are_removed(tmp_path: Path) -> None:
    finished(tmp_path / "run")
    (tmp_path / "run" / "notes.txt").write_text("mine")
    (tmp_path / "run" / "photo.png").write_bytes(b"\x89PNG mine")
    (tmp_path / "run" / "report.html").write_text("of the earlier run")
    RunDirectory.create(tmp_path / "run", SIGNALS, {}, force=True).finish("finished", {})
    names = {file.name for file in (tmp_path / "run").iterdir()}
    assert names == {"notes.txt", "photo.png", "run.json", "series.nc", "events.csv"}


def test_run_json_has_header_status_and_summary(tmp_path: Path) -> None:
    run = RunDirectory.create(tmp_path / "run", SIGNALS, {"name": "belt", "hash": "ab"})
    assert json.loads((tmp_path / "run" / "run.json").read_text())["status"] == "running"
    run.finish("budget", {"steps": np.int64(3), "worst_creep": {"value": float("nan")}})
    record = json.loads((tmp_path / "run" / "run.json").read_text())
    assert (record["status"], record["name"], record["steps"]) == ("budget", "belt", 3)
    assert record["worst_creep"]["value"] is None  # JSON has no NaN.


def test_an_exception_ends_the_run_as_failed_and_keeps_its_rows(tmp_path: Path) -> None:
    with pytest.raises(ZeroDivisionError):
        run_that_raises(tmp_path / "run", ZeroDivisionError("at t = 0 s"))
    result = Result.open(tmp_path / "run")
    assert (result.status, result.run["error"], len(result.t)) == ("failed", "at t = 0 s", 1)


def test_an_interrupt_keeps_the_rows(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt):
        run_that_raises(tmp_path / "run", KeyboardInterrupt())
    assert Result.open(tmp_path / "run").status == "interrupted"


def test_rows_are_copied_because_the_integrator_uses_its_buffers_again(tmp_path: Path) -> None:
    t, values, side = np.zeros(1), np.ones((1, 1)), np.zeros(1, np.int8)
    with RunDirectory.create(tmp_path / "run", SIGNALS, {}) as run:
        run.append(t, values, side)
        values[:] = 7.0
    assert Result.open(tmp_path / "run")["block.v"].tolist() == [1.0]


def test_flushed_rows_are_readable_while_the_run_goes_on(tmp_path: Path) -> None:
    run = RunDirectory.create(tmp_path / "run", SIGNALS, {})
    run.append([0.0, 1.0], [[1.0], [2.0]], [0, 0])
    run.event(1.0, "pad", "stuck", "forward", "slides")
    run.flush(at_once=True)
    result = Result.open(tmp_path / "run")
    assert (result.status, result["block.v"].tolist(), len(result.events)) == ("running", [1.0, 2.0], 1)
    run.finish("finished", {})


def test_a_run_of_a_second_lays_out_its_file_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With the first rows early, the file is laid out with room for more, and once more without it at the end."""
    wall = iter(np.arange(0.0, 100.0, 0.1).tolist())
    monkeypatch.setattr(recorder.clock, "monotonic", lambda: next(wall))
    laid_out: list[Path] = []
    create = store.layout.create
    monkeypatch.setattr(store.layout, "create", lambda path, *more: (laid_out.append(path), create(path, *more)))
    run = RunDirectory.create(tmp_path / "run", SIGNALS, {})
    for k in range(12):
        run.append([float(k)], [[1.0]], [0])
    run.finish("finished", {})
    assert len(laid_out) == 1
    assert len(Result.open(tmp_path / "run").t) == 12


def test_a_short_run_that_is_too_large_for_memory_lays_out_its_file_once_too(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(waiting, "MOST_BYTES_IN_MEMORY", 100)
    laid_out: list[int] = []
    create = store.layout.create
    monkeypatch.setattr(store.layout, "create", lambda path, of, room: (laid_out.append(room), create(path, of, room)))
    run = RunDirectory.create(tmp_path / "run", SIGNALS, {})
    for k in range(0, 60, 20):
        run.append(np.arange(k, k + 20.0), np.arange(k, k + 20.0)[:, None], np.zeros(20))
    run.append([60.0], [[60.0]], [0])
    run.finish("finished", {})
    assert laid_out == [61]
    assert Result.open(tmp_path / "run")["block.v"].tolist() == list(range(61))


def test_a_block_too_large_for_memory_goes_to_the_disk_at_once_when_there_is_a_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(waiting, "MOST_BYTES_IN_MEMORY", 100)
    monkeypatch.setattr(recorder, "FLUSH_PERIOD", 1e9)
    run = RunDirectory.create(tmp_path / "run", SIGNALS, {})
    run.append([0.0], [[1.0]], [0])
    run.flush(at_once=True)
    run.append(np.arange(20.0), np.ones((20, 1)), np.zeros(20))
    assert len(Result.open(tmp_path / "run").t) == 21
    run.finish("finished", {})


@pytest.mark.parametrize("times", [[1.0, 0.5], [float("nan")]])
def test_times_that_run_backwards_are_refused(tmp_path: Path, times: list[float]) -> None:
    run = RunDirectory.create(tmp_path / "run", SIGNALS, {})
    with pytest.raises(FairleadError, match="must not run backwards"):
        run.append(times, np.zeros((len(times), 1)), np.zeros(len(times)))
    run.finish("failed", {})


def test_two_signals_of_one_name_are_refused(tmp_path: Path) -> None:
    with pytest.raises(FairleadError, match=r"same name: block\.v"):
        RunDirectory.create(tmp_path / "run", SIGNALS * 2, {})


def test_a_run_is_finished_once(tmp_path: Path) -> None:
    run = RunDirectory.create(tmp_path / "run", SIGNALS, {})
    run.finish("finished", {})
    with pytest.raises(FairleadError, match="finished already"):
        run.finish("finished", {})


def rerun(path: Path, status: str) -> None:
    """A forced second run that ends in a way, or is killed in its first second."""
    run = RunDirectory.create(path, SIGNALS, {"name": "second"}, force=True)
    if status != "killed":
        run.finish(status, {})


@pytest.mark.parametrize("status", ["killed", "failed", "interrupted", "budget"])
def test_results_are_kept_until_the_run_that_replaces_them_has_finished(tmp_path: Path, status: str) -> None:
    finished(tmp_path / "run")
    for _ in range(2):  # a second attempt does not cost them either
        rerun(tmp_path / "run", status)
        kept = Result.open(tmp_path / "run" / "earlier")
        assert (kept.status, kept.run["name"], kept["block.v"].tolist()) == ("finished", "first", [1.0])
    rerun(tmp_path / "run", "finished")
    assert not (tmp_path / "run" / "earlier").exists()
    assert Result.open(tmp_path / "run").run["name"] == "second"


def test_what_a_user_put_beside_kept_results_stays(tmp_path: Path) -> None:
    finished(tmp_path / "run")
    rerun(tmp_path / "run", "interrupted")
    (tmp_path / "run" / "earlier" / "notes.txt").write_text("mine")
    rerun(tmp_path / "run", "finished")
    assert [file.name for file in (tmp_path / "run" / "earlier").iterdir()] == ["notes.txt"]


@pytest.mark.parametrize("force", [False, True])
def test_a_run_killed_before_its_first_rows_is_told_in_a_sentence(tmp_path: Path, force: bool) -> None:
    if force:
        finished(tmp_path / "run")
    run = RunDirectory.create(tmp_path / "run", SIGNALS, {}, force=force)
    with pytest.raises(UsageError, match="has not written a row yet"):
        Result.open(tmp_path / "run")
    del run  # and with it the lock, as the end of the process would do
    with pytest.raises(UsageError) as caught:
        Result.open(tmp_path / "run")
    said = str(caught.value)
    assert "was killed before its first rows were written" in said
    assert f"to replace are in {tmp_path / 'run' / 'earlier'}." in said if force else said.endswith("Run it again.")


def test_a_damaged_series_is_told_in_a_sentence(tmp_path: Path) -> None:
    finished(tmp_path / "run")
    (tmp_path / "run" / "series.nc").write_bytes(b"\x89HDF\r\n\x1a\n and no more")
    with pytest.raises(DamagedResultsError, match=r"run/series\.nc: it has 20 bytes; .*\n.*run the netlist again\."):
        Result.open(tmp_path / "run")


def test_what_a_run_gives_is_what_its_folder_holds(tmp_path: Path) -> None:
    signals = [Signal("b.v", "m/s", "speed"), Signal("a", "N", "")]
    with RunDirectory.create(tmp_path / "run", signals, {"name": "x", "list": (1, np.float64(0.1), np.nan)}) as run:
        run.append([0.0, 1.0, 1.0], [[1.0, 2.0], [3.0, 4.0], [5.0, np.nan]], [0, -1, 1])
        run.event(1.0, "pad", "stuck", "forward", "slips")
    given, opened = run.result(), Result.open(tmp_path / "run")
    assert given.run == opened.run
    assert given.signals == opened.signals
    assert given.events == opened.events
    assert np.array_equal(given.t, opened.t)
    assert all(np.array_equal(given[name], opened[name], equal_nan=True) for name in ("b.v", "a"))
