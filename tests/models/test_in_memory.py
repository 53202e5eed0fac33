"""`run(out=None)` touches no disk, and its result is the one that a folder would hold."""

import json
import os
import sys

import numpy as np
import pytest

import fairlead
from fairlead.analysis.margins.margins import margins
from fairlead.errors import FairleadError, UsageError
from fairlead.report import page
from fairlead.results import MemoryRun, Signal

SHORT = {"run.stop": "0.6 s"}  # it lets go at 0.5 s
FOLDER_ALONE = ("files", "id", "locked", "started", "ended", "wall_time", "compile_time", "solve_time")


@pytest.fixture(scope="module")
def model():
    made = fairlead.load("belt", set=SHORT)
    made.run(out=None)  # whatever is compiled and cached is there now
    return made


def heard(action):
    """What an action opens for writing, makes or removes, in a copy of this process: who listens does so for good."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        found = []

        def hear(event, arguments):
            writes = event == "open" and isinstance(arguments[2], int) and arguments[2] & (os.O_WRONLY | os.O_RDWR)
            if writes or event in ("os.mkdir", "os.rename", "os.remove", "os.rmdir", "tempfile.mkdtemp"):
                found.append((event, str(arguments[0])))

        sys.addaudithook(hear)
        try:
            action()
            os.write(writer, json.dumps(found[:20]).encode())
        finally:
            os._exit(0)  # the copy must not go on with the tests
    os.close(writer)
    with os.fdopen(reader, encoding="utf-8") as said:
        text = said.read()
    os.waitpid(child, 0)
    return [tuple(one) for one in json.loads(text)]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs processes that are copies of this one")
def test_nothing_is_opened_for_writing_made_or_removed(model, tmp_path):
    assert heard(lambda: model.run(out=None)) == []
    assert ("os.mkdir", str(tmp_path / "run")) in heard(lambda: model.run(out=tmp_path / "run"))


def test_rows_events_and_record_are_those_of_a_folder(model, tmp_path):
    kept, written = model.run(out=None), model.run(out=tmp_path / "run")
    assert np.array_equal(kept.columns(), written.columns(), equal_nan=True)
    assert np.array_equal(kept.t, written.t)
    assert np.array_equal(kept.side, written.side)
    assert kept.signals == written.signals
    assert kept.events == written.events
    assert len(kept.events) > 0
    one, other = ({k: v for k, v in r.run.items() if k not in FOLDER_ALONE} for r in (kept, written))
    one["counters"], other["counters"] = {}, {}
    assert one == other


@pytest.mark.slow
def test_what_reads_a_result_reads_this_one(model):
    result = model.run(out=None)
    assert result.path is None
    assert result.status == "finished"
    assert result.to_xarray(["block.x"])["block.x"].attrs["units"] == "m"
    assert list(result.to_pandas(["block.x"]).columns) == ["block.x"]
    assert result.at("block.x", 0.25) == pytest.approx(np.interp(0.25, result.t, result["block.x"]))
    assert len(result.events_table()) == len(result.events)
    assert "memory" in repr(result)
    assert "memory" in result._repr_html_()
    assert margins(result) == []
    with pytest.raises(FairleadError, match="nothing was not recorded in memory"):
        result["nothing"]


def test_margins_of_a_route_are_those_of_a_folder(tmp_path):
    model = fairlead.load("capstan", set={"run.stop": "0.2 s"})
    assert repr(margins(model.run(out=None))) == repr(margins(model.run(out=tmp_path / "run")))


def test_a_report_wants_a_folder_and_says_so(model):
    with pytest.raises(UsageError, match=r"stayed in memory.*\n.*out=FOLDER"):
        page.write(model.run(out=None))


def test_a_run_without_out_writes_its_results_beside_the_caller(model, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert model.run().path == (tmp_path / "results" / "belt").relative_to(tmp_path)
    assert (tmp_path / "results" / "belt" / "series.nc").exists()


def test_what_is_kept_in_memory_is_checked_as_what_is_written():
    signals = [Signal("a", "N")]
    with pytest.raises(FairleadError, match="under the same name"):
        MemoryRun(signals * 2, {})
    with MemoryRun(signals, {}) as run:
        run.append([0.0, 1.0], [[1.0], [2.0]], [0, 0])
        with pytest.raises(FairleadError, match="backwards"):
            run.append([0.5], [[3.0]], [0])
        with pytest.raises(FairleadError, match="has not finished"):
            run.result()
    assert run.result()["a"].tolist() == [1.0, 2.0]
    with pytest.raises(FairleadError, match="in memory is finished already"):
        run.finish("finished", {})
