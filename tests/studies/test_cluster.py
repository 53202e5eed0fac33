"""A scheduler on this machine: its table is that of processes, also when workers die or the scheduler does."""

import json
import os
import shlex
import signal
import subprocess
import sys
import time
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest

import fairlead
from fairlead.cases import Cases
from fairlead.errors import FairleadError, UsageError
from fairlead.studies.sweeps.design import Design
from fairlead.studies.sweeps.sweep import sweep
from tests.studies.jobs import crash_at_three, job, square

pytest.importorskip("pyarrow", reason="pyarrow is not installed; pip install 'fairlead[cluster]'")
pytest.importorskip("distributed", reason="dask.distributed is not installed; pip install 'fairlead[cluster]'")
from distributed import Client

from fairlead.studies.sweeps.cluster import TRIES, Cluster

pytestmark = [pytest.mark.slow, pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGKILL")]
ROOT = Path(__file__).parents[2]
TIMES = ["seconds", "loop", "host"]
PATIENCE = 15.0  # s, for a process to end before its group is killed
LONG = 600.0  # s, for what takes seconds on a machine that has nothing else to do


@contextmanager
def scheduler(folder, workers, *, again=False):
    """A scheduler with so many worker processes, all there: its address, and the processes; `again`: replaced if dead.

    It chooses its port itself: one that was free a moment ago may be taken.
    """
    told = folder / "scheduler.json"
    options = ["--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", str(told)]
    quiet = {"cwd": ROOT, "stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "start_new_session": True}
    going = [subprocess.Popen([sys.executable, "-m", "distributed.cli.dask_scheduler", *options], **quiet)]
    try:
        address = written(told, going[0])
        command = [sys.executable, "-m", "distributed.cli.dask_worker", address, "--nthreads", "1", "--no-dashboard"]
        command.append("--no-nanny")
        if again:  # not by a nanny, which gives up when its worker dies before it has started
            command = ["sh", "-c", f"while true; do {shlex.join(command)}; done"]
        going += [subprocess.Popen(command, **quiet) for _ in range(workers)]
        if workers:
            with Client(address, timeout=LONG, set_as_default=False) as client:
                client.wait_for_workers(workers, timeout=LONG)
        yield address, going
    finally:
        for one in reversed(going):
            end(one)


def written(file, by):
    """The address in the file of a scheduler, when all of it is there."""
    until = time.monotonic() + LONG
    while time.monotonic() < until:
        assert by.poll() is None, f"the scheduler has ended with {by.returncode}"
        with suppress(FileNotFoundError, ValueError):
            return json.loads(file.read_text())["address"]
        time.sleep(0.02)
    raise AssertionError(f"no scheduler within {LONG:g} s")


def end(one: subprocess.Popen) -> None:
    """End a process that leads a group: politely, then with all of its group."""
    one.terminate()
    with suppress(subprocess.TimeoutExpired):
        one.wait(timeout=PATIENCE)
    with suppress(ProcessLookupError, PermissionError):  # the whole group may be gone already
        os.killpg(one.pid, signal.SIGKILL)
    one.wait(timeout=PATIENCE)


def plain(frame):
    return frame.sort_values("key").drop(columns=TIMES).reset_index(drop=True)


def at(count, do):
    """A watch of a sweep that calls `do` once, when so many cases are done."""
    called = []

    def watch(now):
        if now.done >= count and not called:
            called.append(True)
            do()

    return watch


def test_two_of_four_workers_are_killed_and_the_table_is_that_of_processes(tmp_path) -> None:
    design = Design(grid={"x": [str(k) for k in range(200)], "wait": ["0.02"]})
    expected = sweep(job(square), design, tmp_path / "here", processes=0)[0].frame()
    with scheduler(tmp_path, 4) as (address, going):
        kill = at(40, lambda: [one.send_signal(signal.SIGKILL) for one in going[1:3]])
        made = sweep(job(square), design, tmp_path / "there", computers=lambda one: Cluster(one, address), watch=kill)
        assert [one.wait(timeout=PATIENCE) for one in going[1:3]] == [-9, -9]
    assert plain(made[0].frame()).equals(plain(expected))


def test_a_model_travels_with_its_library_and_its_tables(tmp_path) -> None:
    scene = tmp_path / "scene"
    scene.mkdir()
    (scene / "push.csv").write_text("t,f\n0,0\n1,2\n")
    (scene / "parts.py").write_text(
        "from fairlead.component import Component, Law, Parameter, Translational\n"
        "class Stiff(Component):\n"
        '    """A spring:  tension = stiffness * s."""\n'
        '    a, b = Translational("one end"), Translational("the other end")\n'
        '    stiffness = Parameter("N/m", "Tension per stretch.", above=0)\n'
        "    def law(p, a, b):\n"
        "        tension = p.stiffness * (b.x - a.x)\n"
        "        return Law(a=-tension, b=+tension, stored=p.stiffness * (b.x - a.x)**2 / 2)\n"
    )
    (scene / "pushed.yaml").write_text(
        "schema: 1\nname: pushed\ncomponents:\n  wall: {type: Ground}\n  spring: {type: Stiff, stiffness: 100 N/m}\n"
        "  block: {type: Mass, mass: 1 kg}\n  push: {type: ForceSource, force: {table: {file: push.csv}}}\n"
        "connections:\n  - [wall.flange, spring.a]\n  - [spring.b, block.flange, push.flange]\nrun: {stop: 1 s}\n"
    )
    model = fairlead.load(scene / "pushed.yaml", libraries=[str(scene / "parts.py")])
    cases = Cases(model, {"end": "end(block.x)"})
    design = Design(grid={"block.mass": ["1 kg", "2 kg", "3 kg"]})
    with scheduler(tmp_path, 1) as (address, _):
        made = sweep(cases, design, tmp_path / "there", computers=lambda one: Cluster(one, address))
    expected = [cases.row(values).figures["end"] for values in design.cases()]
    assert made[0].frame()["end"].tolist() == pytest.approx(expected, abs=1e-12)


def test_a_lost_scheduler_is_a_sentence_and_the_rest_is_computed_later(tmp_path) -> None:
    design = Design(grid={"x": [str(k) for k in range(300)], "wait": ["0.02"]})
    with scheduler(tmp_path, 2) as (address, going):
        kill = at(40, lambda: going[0].send_signal(signal.SIGKILL))
        with pytest.raises(FairleadError, match="gone"):
            sweep(job(square), design, tmp_path, computers=lambda one: Cluster(one, address), watch=kill)
    table, standing = sweep(job(square), design, tmp_path, processes=0)
    assert 40 <= standing.reused < 300
    assert len(table.frame()) == 300


def test_a_case_that_kills_its_workers_is_a_row(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr("fairlead.studies.sweeps.cluster.NOBODY", LONG)  # new workers come when the machine has time
    design = Design(grid={"x": [str(k) for k in range(20)]})
    with scheduler(tmp_path, 2, again=True) as (address, _):
        made = sweep(job(crash_at_three), design, tmp_path, computers=lambda one: Cluster(one, address))
    frame = made[0].frame()
    assert frame["case"][frame["status"] == "killed"].tolist() == [3]
    assert len(frame) == 20


class Lost:
    """A task whose rows are on a worker that is gone."""

    status, chunk = "finished", [(0, {"x": 5.0})]

    def cancel(self) -> None: ...


class Nobody:
    def nthreads(self):
        return {}


@pytest.mark.parametrize("failure", [TimeoutError, type("KilledWorker", (Exception,), {})])
def test_a_case_is_blamed_only_when_it_was_alone(failure) -> None:
    cluster, task = Cluster(job(square), ""), Lost()
    cluster._client, task.result = Nobody(), raises(failure)
    for _ in range(TRIES):
        assert list(cluster._landed(task)) == []
    assert cluster._suspects
    rows = [row for _ in range(TRIES) for row in cluster._landed(task, alone=True)]
    assert [row.status for _, row in rows][-1:] == ["killed"]


def raises(failure):
    def result(timeout):
        raise failure(f"no rows after {timeout:g} s")

    return result


def test_nobody_who_answers_is_a_sentence(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr("fairlead.studies.sweeps.cluster.TIMEOUT", "1 s")
    design = Design(grid={"x": ["1"]})
    with pytest.raises(UsageError, match="nobody answers"):
        sweep(job(square), design, tmp_path, computers=lambda one: Cluster(one, "tcp://127.0.0.1:9"))
    with pytest.raises(UsageError, match="no such file"):
        sweep(job(square), design, tmp_path, computers=lambda one: Cluster(one, "scheduler.json"))


def test_a_scheduler_without_workers_is_a_sentence_after_a_while(tmp_path, monkeypatch) -> None:
    monkeypatch.setattr("fairlead.studies.sweeps.cluster.NOBODY", 3.0)
    with scheduler(tmp_path, 0) as (address, _), pytest.raises(FairleadError, match="no worker for 3 s"):
        sweep(job(square), Design(grid={"x": ["1"]}), tmp_path, computers=lambda one: Cluster(one, address))
