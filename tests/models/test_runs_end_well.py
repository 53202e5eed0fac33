"""However a run ends, what it computed is on the disk and the exit code says what happened.

These tests start `fairlead run` as a user does, in a process of its own, and end it in every way it can
end: at its stop, by a budget, by Ctrl-C, by `kill -9`, by a broken limit, by a number that is not one.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import fairlead
from fairlead.errors import UsageError
from fairlead.results import Result

# A belt that runs for a day of simulated time in short steps, for minutes: long enough to be stopped in the middle.
ENDLESS = """
    schema: 1
    name: endless
    parameters: {stiction: 1.0}
    components:
      wall: {type: Ground}
      spring: {type: Spring, stiffness: 100 N/m}
      block: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0.2 m/s}
      belt: {type: MotionSource, velocity: 0.2 m/s}
      pad: {type: Contact, normal_force: 10 N, curve: {curve: coulomb, stiction: "{stiction}", coulomb: 0.6}}
    connections: [[wall.flange, spring.a], [spring.b, block.flange, pad.b], [belt.flange, pad.a]]
    friction: {method: hold}
    run: {stop: 86400 s, accuracy: 1e-6, max_step: 1 ms}
    record: {every: 20 ms}
"""

NOT_A_NUMBER = '''
    """A spring of a law that has no value beyond one metre."""

    from fairlead.component import Component, Law, Translational, sqrt


    class RootSpring(Component):
        """Tension sqrt(1 - x): pushes its end towards where the root is of a negative number."""

        flange = Translational("the end")

        def law(p, flange):
            """No value for x > 1."""
            return Law(flange=-10 * sqrt(1 - flange.x) - 1)
'''


@pytest.fixture
def netlist(tmp_path: Path) -> Path:
    """The endless belt as a file."""
    path = tmp_path / "endless.yaml"
    path.write_text(textwrap.dedent(ENDLESS), encoding="utf-8")
    return path


@pytest.fixture
def start(tmp_path: Path) -> Iterator[Callable[..., subprocess.Popen[str]]]:
    """start(netlist, *options) -> a running `fairlead run`; what still runs at the end of the test is ended."""
    running = []

    def begin(netlist: Path | str, *options: str) -> subprocess.Popen[str]:
        command = [sys.executable, "-m", "fairlead", "run", str(netlist), "--out", str(tmp_path / "run"), *options]
        running.append(subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True))
        return running[-1]

    yield begin
    for process in running:
        if process.poll() is None:
            process.kill()
        process.communicate()


FEW = 10  # zone changes


def finish(process: subprocess.Popen[str]) -> tuple[int, str, str]:
    """Exit code and what was said."""
    out, err = process.communicate(timeout=600)
    return process.returncode, out, err


def wait_until_recorded(process: subprocess.Popen[str], path: Path, rows: int) -> None:
    """Until a reader finds so many rows, and zone changes, in a directory that is still being written."""
    until = time.monotonic() + 600
    while time.monotonic() < until:
        assert process.poll() is None, process.communicate()
        try:
            result = Result.open(path)
            if len(result.t) >= rows and len(result.events) > FEW:  # they reach the disk after the rows
                return
        except UsageError:
            pass  # nothing there yet
        time.sleep(0.02)
    pytest.fail("nothing was recorded")


def check_whole(result: Any, least: int) -> None:
    """Rows in order, all finite, and zone changes that belong to them."""
    assert len(result.t) >= least
    assert np.diff(result.t).min() >= 0
    assert np.isfinite(result.columns()).all()
    times = np.array([e.t for e in result.events])
    assert len(times) > FEW
    assert (np.diff(times) >= 0).all()


@pytest.mark.slow
def test_kill_9_leaves_a_directory_that_can_be_read(start, netlist, tmp_path) -> None:
    process = start(netlist)
    wait_until_recorded(process, tmp_path / "run", rows=500)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    result = Result.open(tmp_path / "run")
    check_whole(result, 500)
    assert result.status == "killed"
    assert result.t[-1] < 86400


def test_ctrl_c_keeps_what_was_computed_and_exits_with_130(start, netlist, tmp_path) -> None:
    process = start(netlist)
    wait_until_recorded(process, tmp_path / "run", rows=500)
    process.send_signal(signal.SIGINT)
    code, _, err = finish(process)
    assert code == 130
    assert "Traceback" not in err
    result = Result.open(tmp_path / "run")
    check_whole(result, 500)
    assert result.status == "interrupted"
    # Not a row is lost. The last one is the last point of the grid before the end, or lies in the step that was just
    # being recorded, which is no longer than a stick of 0.4 s.
    assert np.diff(result.t).max() < 0.02 + 1e-9
    assert -0.02 <= result.t[-1] - result.run["end_time"] < 0.4


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="Windows ends a process without asking it")
def test_sigterm_ends_the_process_when_run_json_says_so_and_all_is_kept(start, netlist, tmp_path) -> None:
    process = start(netlist)
    wait_until_recorded(process, tmp_path / "run", rows=500)
    process.send_signal(signal.SIGTERM)
    code, _, err = finish(process)
    assert code == -signal.SIGTERM  # as any process that SIGTERM has ended
    assert "Traceback" not in err
    result = Result.open(tmp_path / "run")
    check_whole(result, 500)
    assert result.run["status"] == "interrupted"  # as it is written, not what a reader makes of a process that is gone
    assert "ended by SIGTERM; " in result.run["sentence"]
    assert np.diff(result.t).max() < 0.02 + 1e-9
    assert result.run["energy"]["closure"] < 1e-3


@pytest.mark.skipif(os.name != "posix", reason="Windows ends a process without asking it")
@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP"])
def test_a_signal_before_the_first_block_leaves_a_run_that_is_said_to_have_been_ended(tmp_path, netlist, name) -> None:
    script = """
import os, signal, sys, fairlead, fairlead.running
signal.signal(getattr(signal, sys.argv[3]), signal.SIG_DFL)  # under nohup SIGHUP is ignored, in all that is started
integrate = fairlead.running.integrate
def terminated(*given):
    os.kill(os.getpid(), getattr(signal, sys.argv[3]))
    return integrate(*given)
fairlead.running.integrate = terminated
fairlead.load(sys.argv[1]).run(out=sys.argv[2])
"""
    command = [sys.executable, "-c", script, str(netlist), str(tmp_path / "run"), name]
    assert subprocess.run(command, capture_output=True, timeout=600).returncode == -getattr(signal, name)
    result = Result.open(tmp_path / "run")
    assert result.run["status"] == "interrupted"
    assert len(result.t) == 0


@pytest.mark.skipif(os.name != "posix", reason="Windows ends a process without asking it")
@pytest.mark.parametrize(("name", "code"), [("SIGINT", 130), ("SIGTERM", -signal.SIGTERM), ("SIGHUP", -1)])
@pytest.mark.parametrize("at", ["SeriesWriter.write", "SeriesWriter.close", "EventWriter.close"])
def test_a_signal_while_the_last_rows_are_written_waits_until_the_files_are_closed(tmp_path, netlist, name, code, at):
    """It lost the rows of a run that was over, and run.json said that the run had failed."""
    script = """
import os, signal, sys, fairlead
from fairlead.results import recorder
signal.signal(getattr(signal, sys.argv[3]), signal.SIG_DFL if sys.argv[3] != "SIGINT" else signal.default_int_handler)
kind, method = sys.argv[4].split(".")
kind, sent = getattr(recorder, kind), []
plain = getattr(kind, method)
def pressed(*given):
    if not sent:
        sent.append(os.kill(os.getpid(), getattr(signal, sys.argv[3])))
    return plain(*given)
setattr(kind, method, pressed)
try:
    fairlead.load(sys.argv[1]).run(out=sys.argv[2], stop=10.0)
except KeyboardInterrupt:
    sys.exit(130)
"""
    command = [sys.executable, "-c", script, str(netlist), str(tmp_path / "run"), name, at]
    assert subprocess.run(command, capture_output=True, timeout=600).returncode == code
    result = Result.open(tmp_path / "run")
    assert result.status == "finished"
    assert "Reached t = 10 s" in result.run["sentence"]
    assert result.t[-1] == 10.0


@pytest.mark.slow
@pytest.mark.parametrize(
    ("budget", "word"), [("run.max_steps=20000", "20000 steps"), ("run.max_events=40", "40 events")]
)
def test_a_budget_ends_the_run_and_keeps_it(start, netlist, tmp_path, budget: str, word: str) -> None:
    code, _, err = finish(start(netlist, "--set", budget))
    assert code == 4
    assert word in err
    result = Result.open(tmp_path / "run")
    check_whole(result, 500)
    assert result.status == "budget"


def test_a_budget_of_wall_time_ends_the_run_and_keeps_it(start, netlist, tmp_path) -> None:
    """How far it comes depends on the machine: those rows are the first ones of a run of just that length."""
    code, _, err = finish(start(netlist, "--set", "run.max_wall=0.2 s"))
    assert code == 4
    assert "0.2 s" in err
    result = Result.open(tmp_path / "run")
    assert result.status == "budget"
    assert result.run["steps"] > 0
    whole = fairlead.load(netlist).run(out=None, stop=result.run["end_time"] + 1.0)
    rows = len(result.t)
    assert rows > 0
    assert result.columns().tolist() == whole.columns()[:rows].tolist()
    assert list(result.events) == list(whole.events)[: len(result.events)]


@pytest.mark.slow
def test_a_broken_limit_is_named_and_exits_with_5(start, netlist, tmp_path) -> None:
    netlist.write_text(netlist.read_text() + "limits: {block.x: {below: 90 mm}}\n")
    code, _, err = finish(start(netlist, "--set", "run.stop=2 s"))
    assert code == 5
    assert "block.x" in err
    assert "90 mm" in err
    # It is a verdict on the result, not on the run, which is complete.
    assert Result.open(tmp_path / "run").status == "finished"


def test_set_changes_a_parameter_and_a_setting(start, netlist, tmp_path) -> None:
    settings = ("stiction=0.8", "run.stop=2 s", "belt.velocity=0.1 m/s")
    code, _, err = finish(start(netlist, *(word for text in settings for word in ("--set", text))))
    assert code == 0, err
    result = Result.open(tmp_path / "run")
    assert result.t[-1] == 2.0
    # The block starts with the 0.2 m/s of the netlist on a belt of half that: it slips ahead, is caught, and sticks
    # until the spring pulls with 0.8 x 10 N.
    broke = next(e for e in result.events if e.guard == "breaks_backward" and e.t > 0.1)
    assert result.at("spring.tension", broke.t) == pytest.approx(8.0, abs=1e-6)


def test_a_number_that_is_none_names_its_culprit(start, tmp_path) -> None:
    library = tmp_path / "root_spring.py"
    library.write_text(textwrap.dedent(NOT_A_NUMBER), encoding="utf-8")
    netlist = tmp_path / "nan.yaml"
    netlist.write_text(
        textwrap.dedent("""
        schema: 1
        name: nan
        components:
          cart: {type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}
          other: {type: Mass, mass: 1 kg}
          spring: {type: RootSpring}
          force: {type: ForceSource, force: 1 N}
        connections: [[cart.flange, spring.flange], [other.flange, force.flange]]
        run: {stop: 10 s, accuracy: 1e-6}
    """)
    )
    code, _, err = finish(start(netlist, "--library", str(library)))
    assert code == 3
    assert "cart" in err
    assert "other" not in err
    assert "Traceback" not in err
    result = Result.open(tmp_path / "run")
    assert result.status == "failed"
    assert result["cart.x"].max() <= 1.0
    # 1 N and more pushes the cart; it comes close to where the law ends, and no further.
    assert result["cart.x"].max() > 0.99
    assert np.isfinite(result.columns()).all()


@pytest.mark.slow
def test_a_finished_run_is_not_overwritten_without_being_told(start, netlist, tmp_path) -> None:
    assert finish(start(netlist, "--set", "run.stop=1 s"))[0] == 0
    before = (tmp_path / "run" / "events.csv").read_bytes()
    code, _, err = finish(start(netlist, "--set", "run.stop=2 s"))
    assert code == 2
    assert "--force" in err
    assert (tmp_path / "run" / "events.csv").read_bytes() == before
    assert finish(start(netlist, "--set", "run.stop=2 s", "--force"))[0] == 0
    assert Result.open(tmp_path / "run").t[-1] == 2.0
