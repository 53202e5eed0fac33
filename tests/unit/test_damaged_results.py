"""Damaged results: each file is told by name with its place, and what can be read is read.

A random sample is here; `python -m tests.fuzz results` plays any number.
"""

from __future__ import annotations

import json
import math
from pathlib import Path

import h5py
import pytest
from typer.testing import CliRunner

from fairlead.cli import app
from fairlead.results import Result, RunDirectory, Signal, retrieve, run_file
from fairlead.results.damage import DamagedResultsError
from tests.fuzz import results


@pytest.mark.slow
def test_a_damaged_folder_is_answered_in_words(tmp_path: Path) -> None:
    assert list(results.play(tmp_path, seed=5, count=8)) == []


@pytest.fixture
def sound(tmp_path: Path) -> Path:
    """A run whose files nothing is known of, as those of a run that was killed."""
    results.template(tmp_path / "run")
    results.as_of_a_killed_run(tmp_path / "run")
    return tmp_path / "run"


def refused(path: Path) -> str:
    """What `margins` says of a folder that it refuses, in one line."""
    answer = CliRunner().invoke(app, ["margins", str(path)])
    assert answer.exit_code == 1, answer.output
    return " ".join(answer.output.split())


def edit(path: Path, *place: str | int, value: object) -> None:
    """Put another value into run.json."""
    record = held = json.loads((path / "run.json").read_text())
    for key in place[:-1]:
        held = held[key]
    held[place[-1]] = value
    (path / "run.json").write_text(json.dumps(record))


def test_an_entry_of_run_json_is_told_by_its_path(sound: Path) -> None:
    edit(sound, "routes", 0, "nodes", value="x")
    assert f"{sound / 'run.json'}: routes.0.nodes = x: input should be a valid integer." in refused(sound)
    assert len(Result.open(sound).t) == 11  # signals are read all the same
    edit(sound, "status", value=3)
    assert "run.json: status = 3:" in refused(sound)


@pytest.mark.parametrize(("entry", "value"), [("friction", [{"path": "pad"}]), ("zones", {"pad": 3.5})])
def test_an_entry_that_a_page_cannot_use_is_no_mistake_of_fairlead_where_somebody_changed_it(tmp_path, entry, value):
    path = tmp_path / "run"
    results.template(path)
    assert not run_file.is_changed(path)
    edit(path, entry, value=value)
    assert run_file.is_changed(path)
    answer = CliRunner().invoke(app, ["report", str(path)])
    assert answer.exit_code == 1
    assert f"{path / 'run.json'}: its entries are not those that the run left (SHA-256)" in answer.output
    record = run_file.load(path)
    assert run_file.SEAL not in record
    run_file.write(path, record)  # as if a run had left it so
    assert not run_file.is_changed(path)
    assert CliRunner().invoke(app, ["report", str(path)]).exit_code == 70


def test_a_word_that_is_too_long_for_a_name_does_not_hide_what_failed(monkeypatch):
    monkeypatch.setattr("fairlead.simulate.opened", lambda *_, **__: 1 / 0)
    answer = CliRunner().invoke(app, ["check", "belt", "--set", f"mu={'1' * 5000}"])
    assert answer.exit_code == 70
    assert "ZeroDivisionError" in answer.output


def test_a_run_json_that_is_cut_off_is_not_taken_for_none(sound: Path) -> None:
    (sound / "run.json").write_bytes((sound / "run.json").read_bytes()[:100])
    assert "run.json: the file is damaged (" in refused(sound)


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("x,pad,stuck,forward,slides", "line 3: the time x is no number."),
        ("nan,pad,stuck,forward,slides", "line 3: nan is no time."),
        ("0.1,pad,stuck", "line 3 has 3 columns; there are 5 of them."),
    ],
)
def test_a_line_of_events_is_told_by_its_number_and_signals_are_read(sound: Path, line: str, told: str) -> None:
    lines = (sound / "events.csv").read_text().splitlines()
    lines[2] = line
    (sound / "events.csv").write_text("\n".join(lines) + "\n")
    result = Result.open(sound)
    with pytest.raises(DamagedResultsError, match=f"events\\.csv: {told}"):
        assert result.events is None
    assert len(result["line.outer[0].slip"]) == 11


def test_a_limit_is_not_judged_by_what_is_no_number(sound: Path) -> None:
    with h5py.File(sound / "series.nc", "r+") as file:
        file["line.core[1].tension"][4] = math.nan
    assert "series.nc: line.core[1].tension = nan at t = 0.4 s" in refused(sound)
    assert len(Result.open(sound)["line.core[0].tension"]) == 11


def test_times_out_of_order_are_told_by_their_row(sound: Path) -> None:
    with h5py.File(sound / "series.nc", "r+") as file:
        file["time"][4] = -1.0
    with pytest.raises(DamagedResultsError, match=r"series\.nc: row 5: the time is -1\.0, out of its order\."):
        assert Result.open(sound).t is None


@pytest.mark.parametrize("name", ["line.core[1].tension", "side", "time"])
def test_a_variable_that_is_missing_is_not_passed_over(sound: Path, name: str) -> None:
    with h5py.File(sound / "series.nc", "r+") as file:
        del file[name]
    assert "series.nc: the file is damaged (" in refused(sound)


@pytest.mark.parametrize("value", ["of no fixed length", [1, 2], 3.5])
def test_an_attribute_of_another_kind_is_told_and_not_read_beyond_its_room(sound: Path, value: object) -> None:
    for name in ("units", "position"):
        with h5py.File(sound / "series.nc", "r+") as file:
            file["line.core[1].tension"].attrs[name] = value
        assert "is not as a run writes it" in refused(sound)


def test_a_run_without_rows_has_no_margins(sound: Path) -> None:
    with h5py.File(sound / "series.nc", "r+") as file:
        for name in file:
            file[name].resize(0, axis=0)
    answer = CliRunner().invoke(app, ["margins", str(sound)])
    assert answer.exit_code == 0, answer.output
    assert "no row" in answer.output


def test_a_foreign_file_of_hdf5_is_told_as_such(sound: Path) -> None:
    with h5py.File(sound / "series.nc", "w") as file:
        file["time"] = [1.0]
    assert "series.nc: the file is damaged (it holds no signals of fairlead)" in refused(sound)


@pytest.mark.parametrize("place", [8, 900, -9])
def test_a_byte_that_the_run_did_not_leave_is_told_before_hdf5_sees_it(tmp_path, monkeypatch, place):
    """In the structure or in a value: HDF5 might go round in a circle, or read another number."""
    path = tmp_path / "run"
    results.template(path)
    assert len(Result.open(path).t) == 11
    data = bytearray((path / "series.nc").read_bytes())
    data[place] ^= 4
    (path / "series.nc").write_bytes(bytes(data))
    monkeypatch.setattr(retrieve, "open_file", None)
    assert "series.nc: its bytes are not those that the run left (SHA-256)." in refused(path)
    (path / "series.nc").write_bytes(bytes(data[:-1]))
    assert f"series.nc: it has {len(data) - 1} bytes; the run left {len(data)}." in refused(path)


def test_an_event_that_the_run_did_not_leave_is_told_and_signals_are_read(tmp_path):
    path = tmp_path / "run"
    results.template(path)
    text = (path / "events.csv").read_text()
    assert "0.2,pad2" in text
    (path / "events.csv").write_text(text.replace("0.2,pad2", "0.3,pad2"))
    result = Result.open(path)
    assert len(result.t) == 11
    with pytest.raises(DamagedResultsError, match=r"events\.csv: its bytes are not those"):
        assert result.events is None
    edit(path, "files", "events.csv", "bytes", value="many")
    with pytest.raises(DamagedResultsError, match=r"run\.json: files\.events\.csv\.bytes = many"):
        assert Result.open(path).events is None


def test_a_run_that_goes_on_is_read_without_a_checksum(tmp_path):
    run = RunDirectory.create(tmp_path / "run", [Signal("a", "N")], {})
    run.append([0.0, 1.0], [1.0, 2.0], [0, 0])
    run.flush(at_once=True)
    assert Result.open(tmp_path / "run")["a"].tolist() == [1.0, 2.0]
    run.append([2.0], [3.0], [0])
    run.finish("finished", {})
    assert Result.open(tmp_path / "run")["a"].tolist() == [1.0, 2.0, 3.0]
