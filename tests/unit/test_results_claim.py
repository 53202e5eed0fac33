"""Replacing results: killed at any instant, by two at once, through links, and under the number of another process."""

from __future__ import annotations

import json
import os
import platform
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

from fairlead.errors import FairleadError, UsageError
from fairlead.report import figures, page
from fairlead.results import Result, RunDirectory, Signal, lock, placing, run_file
from fairlead.results.claim import Claim

SIGNALS = (Signal("block.v", "m/s", "speed of the block"),)
KILLED = 17
OPERATIONS = ("open", "os.rename", "os.remove", "os.link", "os.mkdir", "os.rmdir", "os.symlink")
NOTES = {"notes.txt": b"mine", "photo.png": b"\x89PNG mine", "series.csv": b"my own table"}
forks = pytest.mark.skipif(not hasattr(os, "fork"), reason="needs processes that are copies of this one")
links = pytest.mark.skipif(os.name == "nt", reason="links need a privilege there")


def write(path: Path, name: str, value: float, status: str = "finished", force: bool = True) -> None:
    """A run with one row, one event and a figure."""
    run = RunDirectory.create(path, SIGNALS, {"name": name}, force=force)
    run.append([0.0], [[value]], [0])
    run.event(0.0, "pad", "stuck", name, "slides")
    run.finish(status, {})
    placing.place(path / "speed.png", b"\x89PNG Software\0fairlead")


def contents(result: Result) -> tuple[str, str, list[float], list[str]]:
    return (result.run["name"], result.status, result["block.v"].tolist(), [one.zone_to for one in result.events])


OLD = ("old", "finished", [1.0], ["old"])
NEW = ("new", "finished", [2.0], ["new"])


def prepared(path: Path) -> None:
    write(path, "old", 1.0)
    for name, data in NOTES.items():
        (path / name).write_bytes(data)


def in_a_copy_killed_at(path: Path, operation: int, action: Callable[[], None]) -> bool:
    """Do something in a copy of this process that is gone before its k-th operation on files; True if it was."""
    child = os.fork()
    if child == 0:
        count = 0

        def watch(event: str, values: tuple[object, ...]) -> None:
            nonlocal count
            if event in OPERATIONS and any(str(path) in str(value) for value in values):
                if count == operation:
                    os._exit(KILLED)
                count += 1

        sys.addaudithook(watch)
        try:
            action()
        except BaseException:  # noqa: BLE001 - the copy must not go on with the tests
            os._exit(1)
        os._exit(0)
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    assert code in (0, KILLED)
    return code == KILLED


@pytest.mark.slow
@forks
def test_a_kill_at_any_file_operation_leaves_the_old_or_the_new_results(tmp_path: Path) -> None:
    prepared(tmp_path / "prepared")
    instants = 0
    while True:
        path = shutil.copytree(tmp_path / "prepared", tmp_path / f"run{instants}")
        killed = in_a_copy_killed_at(path, instants, lambda path=path: write(path, "new", 2.0))
        found = _readable(path)
        assert OLD in found or NEW in found, (instants, found)
        assert all(one in (OLD, NEW) or one[1] == "killed" for one in found), (instants, found)
        assert {name: (path / name).read_bytes() for name in NOTES} == NOTES
        if instants % 3 == 0 or not killed:  # the next run clears away what the killed one left
            write(path, "new", 2.0)
            assert _readable(path) == [NEW]
            left = {file.name for file in path.iterdir()}
            assert left == {*NOTES, "run.json", "series.nc", "events.csv", "speed.png"}, (instants, left)
        if not killed:
            break
        instants += 1
    assert instants > 20


def _readable(path: Path) -> list[tuple[str, str, list[float], list[str]]]:
    """Every run that can be opened in a directory and below it, read to the end."""
    found = []
    for folder in (path, *sorted(path.glob("earlier*"))):
        try:
            found.append(contents(Result.open(folder)))
        except UsageError:
            continue
    return found


def test_an_earlier_result_says_that_its_run_was_replaced(tmp_path: Path) -> None:
    write(tmp_path, "old", 1.0)
    early, late = Result.open(tmp_path), Result.open(tmp_path)
    assert contents(early) == OLD
    write(tmp_path, "new", 2.0)
    assert contents(early) == OLD  # what was read stays
    assert "was replaced by another one" in repr(late)  # a prompt shows it without an error
    assert "was replaced by another one" in late._repr_html_()
    for read in (lambda: late["block.v"], lambda: late.t, lambda: late.side, lambda: late.events):
        with pytest.raises(UsageError, match="was replaced by another one, begun at"):
            read()
    (tmp_path / "run.json").unlink()
    with pytest.raises(UsageError, match="is not there any more"):
        assert late.t is None


@pytest.mark.parametrize("goes_on", [False, True])
def test_what_a_run_returns_is_its_own_when_another_takes_the_directory_at_its_end(tmp_path, monkeypatch, goes_on):
    """The other one waits for the lock, and has it as soon as it is free: there was a KeyError, from its run.json."""
    run = RunDirectory.create(tmp_path, SIGNALS, {"name": "old"})
    run.append([0.0], [[1.0]], [0])
    free = Claim.release

    def taken_at_once(claim: Claim, *, finished: bool) -> None:
        monkeypatch.setattr(Claim, "release", free)
        claim.release(finished=finished)
        if goes_on:
            others.append(RunDirectory.create(tmp_path, SIGNALS, {"name": "new"}, force=True))
        else:
            write(tmp_path, "new", 2.0)

    others: list[RunDirectory] = []
    monkeypatch.setattr(Claim, "release", taken_at_once)
    run.finish("finished", {"steps": 3})
    result = run.result()
    assert (result.run["name"], result.status, result.run["steps"]) == ("old", "finished", 3)
    for read in (lambda: result["block.v"], lambda: result.events, lambda: result.folder):
        with pytest.raises(UsageError, match="was replaced by another one, begun at"):
            read()
    for other in others:
        other.finish("finished", {})


def test_a_run_that_goes_on_has_no_result_yet(tmp_path: Path) -> None:
    run = RunDirectory.create(tmp_path, SIGNALS, {"name": "old"})
    with pytest.raises(FairleadError, match="has not finished"):
        run.result()
    run.finish("finished", {})


def test_no_files_are_made_of_a_result_in_the_directory_of_the_run_that_replaced_it(tmp_path: Path) -> None:
    write(tmp_path, "old", 1.0)
    early = Result.open(tmp_path)
    assert contents(early) == OLD  # read, so that a figure could be drawn
    write(tmp_path, "new", 2.0)
    for make in (figures.draw, page.write):
        with pytest.raises(UsageError, match="was replaced by another one"):
            make(early)
    with pytest.raises(UsageError, match="was replaced by another one"):
        early.to_csv(tmp_path / "series.csv")
    assert not (tmp_path / "series.csv").exists()
    assert not (tmp_path / "report.html").exists()


def test_a_run_that_goes_on_is_not_replaced_by_force(tmp_path: Path) -> None:
    run = RunDirectory.create(tmp_path, SIGNALS, {"name": "old"})
    told = f"is being written by process {os.getpid()}, which --force .in Python force=True. does not replace"
    with pytest.raises(UsageError, match=told):
        RunDirectory.create(tmp_path, SIGNALS, {}, force=True)
    run.append([0.0], [[1.0]], [0])
    run.finish("finished", {})
    assert Result.open(tmp_path)["block.v"].tolist() == [1.0]


def test_where_there_are_no_locks_a_run_that_lost_its_directory_says_so(tmp_path: Path, monkeypatch) -> None:
    def none(*_: object, **__: object) -> bool:
        raise OSError(37, "No locks available")

    monkeypatch.setattr(lock, "_lock", none)
    first = RunDirectory.create(tmp_path, SIGNALS, {"name": "old"})
    first.append([0.0], [[1.0]], [0])
    with pytest.raises(UsageError, match="or there is another process of that number by now"):
        RunDirectory.create(tmp_path, SIGNALS, {})
    write(tmp_path, "new", 2.0)
    with pytest.raises(UsageError, match="was replaced by another one"):
        first.flush(at_once=True)
    with pytest.raises(UsageError, match="was replaced by another one"):
        first.finish("finished", {})
    assert contents(Result.open(tmp_path)) == NEW


def left_by_a_killed_process(path: Path, **said: object) -> None:
    """What a killed run leaves: a run.json that says `running`, and the file of a lock that nobody holds."""
    write(path, "old", 1.0)
    record = run_file.load(path)
    run_file.write(path, {**record, "status": "running", **said})
    (path / lock.LOCK_FILE).touch()


def test_a_killed_run_whose_process_number_was_given_again_counts_as_killed(tmp_path: Path) -> None:
    left_by_a_killed_process(tmp_path, process=os.getpid())  # the number of a process that is there: this one
    assert Result.open(tmp_path).status == "killed"
    with pytest.raises(UsageError, match="and killed"):
        write(tmp_path, "new", 2.0, force=False)
    write(tmp_path, "new", 2.0)
    assert contents(Result.open(tmp_path)) == NEW


def test_of_a_run_on_another_machine_nobody_can_tell_and_force_replaces_it(tmp_path: Path) -> None:
    left_by_a_killed_process(tmp_path, host=f"not-{platform.node()}", boot="another")
    assert Result.open(tmp_path).status == "running"
    with pytest.raises(UsageError, match="unless that has ended: it cannot be seen from here"):
        write(tmp_path, "new", 2.0, force=False)
    write(tmp_path, "new", 2.0)
    assert contents(Result.open(tmp_path)) == NEW


def test_a_run_that_ends_while_it_is_opened_counts_as_finished(tmp_path: Path, monkeypatch) -> None:
    """Its lock is free then, and what was read of run.json is from before."""
    run = RunDirectory.create(tmp_path, SIGNALS, {"name": "old"})
    run.append([0.0], [[1.0]], [0])
    run.flush(at_once=True)
    look = lock.held

    def after_its_end(folder: Path) -> bool | None:
        monkeypatch.setattr(lock, "held", look)
        run.finish("finished", {})
        return look(folder)

    monkeypatch.setattr(lock, "held", after_its_end)
    assert Result.open(tmp_path).status == "finished"


def test_a_run_that_was_replaced_while_it_is_opened_is_said_to_have_been(tmp_path: Path, monkeypatch) -> None:
    write(tmp_path, "old", 1.0)
    old = run_file.load(tmp_path)
    others = [RunDirectory.create(tmp_path, SIGNALS, {"name": "new"}, force=True)]  # no rows yet
    with monkeypatch.context() as patched:
        patched.setattr(run_file, "load_as_it_is", lambda _: (old, "finished"))
        with pytest.raises(UsageError, match="was replaced by another one"):
            Result.open(tmp_path)
    others.pop().finish("finished", {})


@pytest.mark.skipif(os.name == "nt", reason="locks of Windows know no readers")
@pytest.mark.parametrize("writes", [False, True])
def test_a_reader_that_looks_who_writes_may_take_its_time(tmp_path: Path, monkeypatch, writes: bool) -> None:
    """Its look takes a second here, as on a machine with much else to do. One who writes is not waited for."""
    handles, now = [lock._open(tmp_path, os.O_RDWR | os.O_CREAT)], [0.0]
    assert lock._lock(handles[0], shared=not writes)

    def sleep(seconds: float) -> None:
        now[0] += seconds
        if handles and now[0] > 1.0:
            os.close(handles.pop())

    monkeypatch.setattr(lock, "clock", SimpleNamespace(monotonic=lambda: now[0], sleep=sleep))
    if writes:
        with pytest.raises(lock.Held):
            lock.Lock.take(tmp_path)
        assert now[0] == 0.0
        os.close(handles.pop())
    else:
        lock.Lock.take(tmp_path).release()
        assert now[0] > 1.0


@forks
def test_the_lock_dies_with_its_process(tmp_path: Path) -> None:
    kept: list[RunDirectory] = []
    assert in_a_copy_killed_at(
        tmp_path, 1000, lambda: (kept.append(RunDirectory.create(tmp_path, SIGNALS, {})), os._exit(KILLED))
    )
    assert run_file.status(tmp_path, run_file.load(tmp_path)) == "killed"


OURS = ("run.json", "series.nc", "series.nc.new", "events.csv", "report.html", "speed.png", lock.LOCK_FILE)


@links
@pytest.mark.parametrize("second_name", [Path.symlink_to, Path.hardlink_to])
def test_nothing_is_written_through_links(tmp_path: Path, second_name: Callable[[Path, Path], None]) -> None:
    path, elsewhere = tmp_path / "run", tmp_path / "elsewhere"
    path.mkdir()
    elsewhere.mkdir()
    for name in (*OURS, "series.csv"):
        (elsewhere / name).write_text("mine")
        second_name(path / name, elsewhere / name)
    write(path, "new", 2.0)
    Result.open(path).to_csv(path / "series.csv")
    assert contents(Result.open(path)) == NEW
    assert (path / "series.csv").read_text().startswith("time [s],side,block.v [m/s]")
    assert not any(file.is_symlink() for file in path.iterdir())
    assert {file.read_text() for file in elsewhere.iterdir()} == {"mine"}


@links
def test_a_link_to_a_lock_that_is_nowhere_makes_no_file_there(tmp_path: Path) -> None:
    (tmp_path / "run").mkdir()
    (tmp_path / "run" / lock.LOCK_FILE).symlink_to(tmp_path / "nowhere")
    write(tmp_path / "run", "new", 2.0)
    assert not (tmp_path / "nowhere").exists()


@links
def test_a_directory_that_is_a_link_is_used_as_what_it_points_to(tmp_path: Path) -> None:
    (tmp_path / "disk").mkdir()
    (tmp_path / "run").symlink_to(tmp_path / "disk")
    write(tmp_path / "run", "old", 1.0)
    write(tmp_path / "run", "new", 2.0)
    assert (tmp_path / "run").is_symlink()
    assert contents(Result.open(tmp_path / "disk")) == NEW


def test_files_of_others_that_have_our_names_are_kept(tmp_path: Path) -> None:
    """A folder that holds no run, forced: what is not ours is in `earlier` in the end, whole."""
    (tmp_path / "report.html").write_text("my report")
    (tmp_path / "run.json").write_text('{"of": "another program"}')
    write(tmp_path, "new", 2.0)
    assert (tmp_path / "earlier" / "report.html").read_text() == "my report"
    assert json.loads((tmp_path / "earlier" / "run.json").read_text()) == {"of": "another program"}
    write(tmp_path, "new", 2.0)
    assert (tmp_path / "earlier" / "report.html").exists()
    assert {file.name for file in tmp_path.glob("earlier*")} == {"earlier"}


def test_a_table_of_the_run_before_does_not_stay_beside_the_new_one(tmp_path: Path) -> None:
    write(tmp_path, "old", 1.0)
    Result.open(tmp_path).to_csv(tmp_path / "series.csv")
    write(tmp_path, "new", 2.0)
    assert not (tmp_path / "series.csv").exists()


def test_results_are_kept_where_files_have_one_name_only(tmp_path: Path, monkeypatch) -> None:
    def none(*_: object) -> None:
        raise OSError(1, "Operation not permitted")

    monkeypatch.setattr(os, "link", none)
    write(tmp_path, "old", 1.0)
    write(tmp_path, "new", 2.0, status="interrupted")
    assert contents(Result.open(tmp_path / "earlier")) == OLD
    assert Result.open(tmp_path)["block.v"].tolist() == [2.0]


def test_a_table_asked_for_elsewhere_goes_where_it_was_sent(tmp_path: Path) -> None:
    write(tmp_path / "run", "old", 1.0)
    (tmp_path / "mine.csv").write_text("")
    Result.open(tmp_path / "run").to_csv(tmp_path / "mine.csv")
    assert (tmp_path / "mine.csv").read_text().splitlines()[1] == "0.0,0,1.0"


def test_a_full_disk_in_the_middle_of_claiming_leaves_the_old_results(tmp_path: Path, monkeypatch) -> None:
    write(tmp_path, "old", 1.0)

    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(Path, "rename", full)
        with pytest.raises(Exception, match="No space left"):
            write(tmp_path, "new", 2.0)
    assert contents(Result.open(tmp_path)) == OLD
    write(tmp_path, "new", 2.0)
    assert contents(Result.open(tmp_path)) == NEW
