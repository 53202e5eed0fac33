"""From the shell: large results are told with a way out, and a run that is killed costs nothing that was there."""

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from typer.testing import CliRunner

from fairlead.cli import app
from fairlead.results import Result


def test_results_of_more_than_the_limit_are_told_with_their_size_and_a_way_out(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr("fairlead.cli.run.LARGE", 1e5)
    words = ["run", "belt", "--set", "run.stop=2 s", "--out", str(tmp_path / "run"), "--force"]
    told = CliRunner().invoke(app, [*words, "--set", "record.every=1 ms"])
    assert told.exit_code == 0
    result = Result.open(tmp_path / "run")
    size = (tmp_path / "run" / "series.nc").stat().st_size
    assert f"{len(result.t)} rows of {len(result.signals)} signals" in told.stderr
    assert "note: the results take" in told.stderr
    assert 1e5 < size < 2e6
    assert "Record fewer signals (record.signals) or less often (record.every is 0.001 s)." in told.stderr
    few = CliRunner().invoke(app, [*words, "--set", "record.every=0.2 s"])
    assert "note: the results take" not in few.stderr
    assert json.loads((tmp_path / "run" / "run.json").read_text())["record_every"] == 0.2


@pytest.mark.slow
def test_what_will_be_large_is_told_before_the_run_where_a_grid_says_it_and_early_in_it_where_not(
    tmp_path: Path, monkeypatch
) -> None:
    monkeypatch.setattr("fairlead.cli.run.LARGE", 1e5)
    words = ["run", "belt", "--out", str(tmp_path / "run"), "--force"]
    told = CliRunner().invoke(app, [*words, "--set", "run.stop=2 s", "--set", "record.every=1 ms"])
    first = told.stderr.splitlines()[0]
    size = (tmp_path / "run" / "series.nc").stat().st_size
    assert first.startswith("note: the results will take about ")
    rows, signals = re.search(r"\((\d+) rows of (\d+) signals", first).groups()
    assert 8 * int(rows) * (int(signals) + 1) == pytest.approx(size, rel=0.2)
    assert "record.every is 0.001 s" in first
    monkeypatch.setattr("fairlead.cli.run.LARGE", 1e6)
    monkeypatch.setattr("fairlead.cli.growing.EARLY", 1e-9)
    monkeypatch.setattr("fairlead.results.recorder.FIRST_FLUSH", 0.0)  # of a run that takes longer than that
    every = [*words, "--set", "run.stop=2000 s", "--set", "record.every=null"]
    told = CliRunner().invoke(app, every)
    said = [line for line in told.stderr.splitlines() if "will take about" in line]
    assert len(said) == 1
    assert "at this rate" in said[0]
    assert "Give record.every a time" in said[0]


def test_where_jumps_make_the_rows_the_signals_that_jump_are_named(tmp_path: Path, monkeypatch) -> None:
    """A sensor sampled every 10 ms with a grid of 0.5 s: nearly all rows are the two sides of its samples.

    Not for what the sensor holds, whose stairs go by the clock, but for what follows it at once.
    """
    monkeypatch.setattr("fairlead.cli.run.LARGE", 1.0)
    netlist = tmp_path / "sampled.yaml"
    netlist.write_text(
        "schema: 1\nname: sampled\ncomponents:\n"
        "  wave: {type: SignalSource, value: {sine: {amplitude: 1, frequency: 1 Hz}}}\n"
        "  sensor: {type: SampledSensor, period: 10 ms}\n  double: {type: SignalGain, gain: 2}\n"
        "connections: [[wave.signal, sensor.value], [sensor.signal, double.value]]\n"
        "run: {stop: 2 s}\nrecord: {every: 0.5 s}\n"
    )
    told = CliRunner().invoke(app, ["run", str(netlist), "--out", str(tmp_path / "run")])
    assert told.exit_code == 0
    jumps = json.loads((tmp_path / "run" / "run.json").read_text())["jumps"]
    assert 150 < jumps["kept"] <= 201
    assert jumps["most"] == {"double.signal": jumps["kept"]}
    assert f"Most rows are those of {jumps['kept']} jumps; leave out what jumps most (double.signal)" in told.stderr
    netlist.write_text(netlist.read_text().replace("every: 0.5 s", "every: 0.5 s, signals: [sensor.signal]"))
    assert CliRunner().invoke(app, ["run", str(netlist), "--out", str(tmp_path / "alone")]).exit_code == 0
    assert len(Result.open(tmp_path / "alone").t) == 5


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="SIGKILL is of POSIX")
def test_a_rerun_that_is_killed_at_once_leaves_the_results_it_was_to_replace(tmp_path: Path) -> None:
    """At every single file operation: `test_results_claim.py`. Here the whole command, from the shell."""
    command = [sys.executable, "-m", "fairlead", "run", "belt", "-q", "--out", str(tmp_path / "run")]
    subprocess.run([*command, "--set", "run.stop=1 s"], check=True, timeout=600)
    with subprocess.Popen([*command, "--force", "--set", "run.stop=1e5 s"]) as process:
        deadline = time.monotonic() + 600
        try:
            while not (tmp_path / "run" / "earlier").exists():
                assert time.monotonic() < deadline
                assert process.poll() is None
                time.sleep(0.005)
        finally:
            process.send_signal(signal.SIGKILL)
    assert Result.open(tmp_path / "run" / "earlier").t[-1] == 1.0
    answer = CliRunner().invoke(app, ["margins", str(tmp_path / "run")])
    said = " ".join(answer.output.split())
    if answer.exit_code == 2:  # killed before its first rows
        assert "was to replace are in" in said
    else:  # after some, or before it had touched the results that it was to replace
        assert answer.exit_code == 0
        assert "killed" in said or "finished" in said
