"""Sweeps: designs against what they are defined by, and the table through crashes and kills."""

import contextlib
import itertools
import math
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import fairlead
from fairlead.cases import Cases
from fairlead.errors import FairleadError, ModelError, UsageError
from fairlead.studies.sweeps.breach import breach
from fairlead.studies.sweeps.design import MOST_CASES, Design, Sample
from fairlead.studies.sweeps.distributions import read_distribution
from fairlead.studies.sweeps.farm import AHEAD, Farm
from fairlead.studies.sweeps.plan import is_sweep_file, read_plan
from fairlead.studies.sweeps.ranges import RangeError, read_range
from fairlead.studies.sweeps.sweep import sweep
from tests.studies.jobs import GATE, LONG, crash_at_three, job, square

arrow = pytest.importorskip("pyarrow", reason="pyarrow is not installed; pip install 'fairlead[sweep]'")
from fairlead.studies.sweeps import table as tables  # noqa: E402

ROOT = Path(__file__).parents[2]
TIMES = ["seconds", "loop", "host"]


def plain(frame):
    """A table without what differs from run to run."""
    return frame.sort_values("key").drop(columns=TIMES).reset_index(drop=True)


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("0.2:0.35:0.05", ["0.2", "0.25", "0.3", "0.35"]),
        ("8:9:0.5 N", ["8 N", "8.5 N", "9 N"]),
        ("3:1:-1", ["3", "2", "1"]),
        ("0:1:0.3", ["0", "0.3", "0.6", "0.9"]),
        ("hold, binding", ["hold", "binding"]),
        ("lin(0 m, 1, 5)", ["0 m", "0.25 m", "0.5 m", "0.75 m", "1 m"]),
        ("log(1e-2, 1, 3)", ["0.01", "0.1", "1"]),
    ],
)
def test_ranges_are_worked_out_in_decimals(text, values) -> None:
    assert read_range(text) == values


@pytest.mark.parametrize(
    "text", ["1:2:0", "2:1:0.1", "1:2:1e-9", "a,,b", "lin(1, 1, 3)", "log(0, 1, 3)", "1 N:2 m:1", ""]
)
def test_a_range_without_values_is_refused(text) -> None:
    with pytest.raises(RangeError):
        read_range(text)


def test_a_grid_has_all_combinations_and_the_last_name_varies_fastest() -> None:
    cases = list(Design(grid={"a": ["1", "2"], "b": ["x", "y", "z"]}).cases())
    assert [tuple(one.values()) for one in cases] == [(a, b) for a in "12" for b in "xyz"]


def test_too_many_cases_are_counted_and_not_made() -> None:
    many = [str(k) for k in range(1000)]
    with pytest.raises(UsageError, match="1e\\+09 cases"):
        Design(grid={"a": many, "b": many, "c": many}).refuse()
    assert MOST_CASES < 10**9


def test_samples_have_the_distributions_they_are_asked_for() -> None:
    over = {"a": read_distribution("normal(3 N, 0.5)"), "b": read_distribution("uniform(1, 2)")}
    for kind in ("latin_hypercube", "sobol", "monte_carlo"):
        columns = Sample(kind, 512, over, seed=3).columns()
        a = np.array([float(text.removesuffix(" N")) for text in columns["a"]])
        b = np.array([float(text) for text in columns["b"]])
        assert abs(a.mean() - 3) < 4 * 0.5 / math.sqrt(512)  # four standard errors of independent points
        assert abs(a.std() - 0.5) < 4 * 0.5 / math.sqrt(2 * 512)
        assert abs(b.mean() - 1.5) < 4 * math.sqrt(1 / 12 / 512)
        assert b.min() > 1
        assert b.max() < 2


def test_a_latin_hypercube_has_one_point_in_each_slice() -> None:
    columns = Sample("latin_hypercube", 50, {"a": read_distribution("uniform(0, 50)")}).columns()
    assert sorted(math.floor(float(text)) for text in columns["a"]) == list(range(50))


def test_monte_carlo_has_the_rank_correlation_that_was_asked_for() -> None:
    from scipy.stats import spearmanr

    over = {name: read_distribution("lognormal(1, 0.5)") for name in ("a", "b")}
    columns = Sample("monte_carlo", 4000, over, 1, {("a", "b"): 0.6}).columns()
    found = spearmanr([float(text) for text in columns["a"]], [float(text) for text in columns["b"]]).statistic
    assert abs(found - 0.6) < 4 * (1 - 0.6**2) / math.sqrt(4000)


@pytest.mark.slow
@pytest.mark.parametrize("loads", [10, pytest.param(100, marks=pytest.mark.slow)])
def test_cases_of_the_belt_by_two_processes_are_those_of_a_loop(tmp_path, loads) -> None:
    model = fairlead.load("belt", set={"run.stop": "1.2 s", "run.accuracy": "1e-5"})
    cases = Cases(model, {"peak": "peak(block.x)", "end": "end(block.x)"})
    design = Design(grid={"pad.normal_force": read_range(f"lin(8 N, 12 N, {loads})"), "block.mass": ["1 kg", "1.5 kg"]})
    table, standing = sweep(cases, design, tmp_path, processes=2)
    frame = table.frame()
    assert (standing.done, len(frame), set(frame["status"])) == (2 * loads, 2 * loads, {"finished"})
    for number in (0, loads // 2 + 1, 2 * loads - 1):
        values = list(design.cases())[number]
        row = cases.row(values)
        assert frame["peak"][number] == row.figures["peak"]
        assert frame["end"][number] == row.figures["end"]
        assert frame["key"][number] == row.key
    # It lets go at 0.01 m for each N of stiction, 0.004 m before the middle of its swing, at the speed of the belt.
    heavy = frame[frame["block.mass"] == 1.5]
    expected = 0.006 * heavy["pad.normal_force"] + np.hypot(
        0.004 * heavy["pad.normal_force"], 0.2 * math.sqrt(1.5 / 100)
    )
    np.testing.assert_allclose(heavy["peak"], expected, rtol=1e-4)


@pytest.mark.slow
def test_a_case_that_ends_its_process_costs_one_row(tmp_path) -> None:
    table, _ = sweep(job(crash_at_three), Design(grid={"x": [str(k) for k in range(12)]}), tmp_path, processes=2)
    frame = table.frame()
    assert len(frame) == 12
    assert frame["case"][frame["status"] == "killed"].tolist() == [3]
    assert "exit code 11" in frame["sentence"][3]
    others = frame[frame["case"] != 3]
    assert (others["y"] == others["x"] ** 2).all()


def test_short_cases_are_handed_out_many_at_a_time_and_a_crash_among_them_costs_one_row(tmp_path) -> None:
    crew = Farm(job(crash_at_three), 2)
    assert crew.ahead == AHEAD  # nothing is known of them yet
    design = Design(grid={"x": [str(k) for k in range(200, 0, -1)]})
    frame = sweep(crew.job, design, tmp_path, computers=lambda _: crew)[0].frame()
    assert crew.ahead > 4 * AHEAD
    assert frame["x"][frame["status"] == "killed"].tolist() == [3]
    assert (len(frame), len(frame["key"].unique())) == (200, 200)


@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGKILL")
def test_a_sweep_that_is_killed_and_typed_again_has_the_table_of_one_run(tmp_path) -> None:
    _kill_and_resume(tmp_path, kills=1, count=60)


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="Windows has no SIGKILL")
def test_a_sweep_that_is_killed_five_times_has_the_table_of_one_run(tmp_path) -> None:
    _kill_and_resume(tmp_path, kills=5, count=400)


def _kill_and_resume(tmp_path, kills, count) -> None:
    """Killed at any instant of what follows a row that is new; a gate keeps each sweep from ending before that."""
    whole = Design(grid={"x": [str(k) for k in range(count)]})
    expected = sweep(job(square), whole, tmp_path / "whole", processes=0)[0].frame()
    folder, rows = tmp_path / "killed", 0
    for turn in range(1, kills + 1):
        command = [sys.executable, "-m", "tests.studies.sweep_to_kill", str(folder), str(count)]
        gate = {GATE: str(turn * count // (kills + 1))}
        going = subprocess.Popen(command, cwd=ROOT, env=os.environ | gate, stdout=subprocess.DEVNULL,
                                 stderr=subprocess.PIPE, start_new_session=True)  # fmt: skip
        try:
            rows = _when_longer(folder, rows, going)
        finally:
            going.send_signal(signal.SIGKILL)
            with contextlib.suppress(ProcessLookupError):
                os.killpg(going.pid, signal.SIGKILL)  # its workers, which would end when they find nobody to answer
            going.communicate(timeout=LONG)
        assert 0 < rows <= turn * count // (kills + 1)  # each time there is more, and never all
    table, standing = sweep(job(square), whole, folder, processes=2)
    assert rows <= standing.reused < count
    assert plain(table.frame()).equals(plain(expected))


def _when_longer(folder, rows, going) -> int:
    """How many rows a table has, as soon as it has more than `rows`; a process writes it."""
    until = time.monotonic() + LONG
    while time.monotonic() < until:
        assert going.poll() is None, going.stderr.read().decode()
        if (folder / tables.FILE).exists() and (now := tables.read(folder)[0].num_rows) > rows:
            return now
        time.sleep(0.01)
    raise AssertionError(f"no row came in {LONG:g} s")


@pytest.mark.slow
def test_a_table_that_is_replaced_while_it_is_read_is_one_of_the_two(tmp_path) -> None:
    place = tmp_path / "read"
    place.mkdir()
    tables_of = {}
    for count in (3, 60):
        sweep(job(square), Design(grid={"x": [str(k) for k in range(count)]}), tmp_path / str(count), processes=0)
        tables_of[count] = (tmp_path / str(count) / tables.FILE).read_bytes()
    (place / tables.FILE).write_bytes(tables_of[3])
    done = threading.Event()

    def replace() -> None:
        """As a sweep does it: a file of its own, and then its name."""
        for count in itertools.cycle((60, 3)):
            (place / tables.PART).write_bytes(tables_of[count])
            with contextlib.suppress(PermissionError):  # Windows keeps a file that is being read
                (place / tables.PART).replace(place / tables.FILE)
            if done.is_set():
                return

    running = threading.Thread(target=replace)
    running.start()
    try:
        found = [tables.read(place)[0].num_rows for _ in range(300)]
    finally:
        done.set()
        running.join()
    assert set(found) <= {3, 60}


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("model: belt\ngird: {mu: [1, 2]}\n", "s.yaml:2:1: a sweep file has no key gird\n    Did you mean grid?"),
        ("model: belt\nvary: {mu: [1, 2]}\n", "s.yaml:2:1: a sweep file has no key vary\n    It is called grid here."),
        ("modle: belt\ngrid: {mu: [1, 2]}\n", "s.yaml:1:1: a sweep file has no key modle\n    Did you mean model?"),
        ("model: belt\nsample: {kind: sobol, sampels: 4, over: {a: 'uniform(1, 2)'}}\n",
         "s.yaml:2:23: sample has no key sampels\n    Did you mean samples?"),
    ],
)  # fmt: skip
def test_a_misspelt_key_is_told_as_one_of_a_sweep_file(text, says, tmp_path) -> None:
    file = tmp_path / "s.yaml"
    file.write_text(text)
    assert is_sweep_file(str(file))
    with pytest.raises(ModelError) as caught:
        read_plan(str(file))
    assert says in str(caught.value)


def test_a_case_that_stands_twice_is_computed_once(tmp_path) -> None:
    table, standing = sweep(job(square), Design(listed=[{"x": "2"}, {"x": "3"}, {"x": "2"}]), tmp_path, processes=0)
    assert standing.done == 2
    assert table.frame()["y"].tolist() == [4.0, 9.0, 4.0]
    assert sweep(job(square), Design(listed=[{"x": "2"}, {"x": "3"}, {"x": "2"}]), tmp_path, processes=0)[1].done == 0


def test_a_design_that_grows_computes_what_is_new(tmp_path) -> None:
    sweep(job(square), Design(grid={"x": ["1", "2"]}), tmp_path, processes=0)
    table, standing = sweep(job(square), Design(grid={"x": ["1", "2", "3"]}), tmp_path, processes=0)
    assert (standing.reused, standing.done) == (2, 1)
    assert table.frame()["y"].tolist() == [1.0, 4.0, 9.0]


def test_the_table_of_another_sweep_is_not_replaced(tmp_path) -> None:
    sweep(job(square), Design(grid={"x": ["1"]}), tmp_path, processes=0)
    before = (tmp_path / tables.FILE).read_bytes()
    with pytest.raises(UsageError, match="--out"):
        sweep(job(crash_at_three), Design(grid={"x": ["1"]}), tmp_path, processes=0)
    with pytest.raises(UsageError, match="other parameters"):
        sweep(job(square), Design(grid={"x": ["1"], "z": ["1"]}), tmp_path, processes=0)
    assert (tmp_path / tables.FILE).read_bytes() == before


def test_a_full_disk_is_a_sentence_and_what_was_written_stays(tmp_path, monkeypatch) -> None:
    sweep(job(square), Design(grid={"x": ["1", "2"]}), tmp_path, processes=0)

    def full(*_, **__):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(arrow.parquet, "write_table", full)
    with pytest.raises(FairleadError, match="No space left"):
        sweep(job(square), Design(grid={"x": ["1", "2", "3"]}), tmp_path, processes=0)
    monkeypatch.undo()
    assert tables.read(tmp_path)[0].num_rows == 2
    assert not (tmp_path / tables.PART).exists()
    assert sweep(job(square), Design(grid={"x": ["1", "2", "3"]}), tmp_path, processes=0)[1].reused == 2


def test_unknown_names_and_wrong_dimensions_are_refused_before_anything_runs(tmp_path) -> None:
    cases = Cases(fairlead.load("belt"), {"end": "end(block.x)"})
    for grid, word in (({"mu": ["1"]}, "mu"), ({"pad.normal_force": ["1 N", "2 m"]}, "length")):
        with pytest.raises(ModelError, match=word):
            sweep(cases, Design(grid=grid), tmp_path, processes=0)
    assert not list(tmp_path.iterdir())


def test_the_interval_of_a_probability_is_that_of_the_binomial_law() -> None:
    import pandas

    frame = pandas.DataFrame({"status": ["finished"] * 20, "limits_broken": [0] * 20})
    assert breach(frame).high == pytest.approx(1 - 0.025 ** (1 / 20))  # none in n: 1 - (alpha / 2)^(1/n)
    frame.loc[:4, "status"] = "failed"
    assert breach(frame).unknown == 5
    assert breach(frame).low == 0
    assert breach(frame).high > 0.25
