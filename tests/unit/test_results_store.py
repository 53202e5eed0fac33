"""The series file: every layout reads back, and a kill at any moment leaves it readable."""

from __future__ import annotations

import io
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py
import numpy as np
import pytest
import xarray

from fairlead.results import Result, Signal, layout, store
from fairlead.results.retrieve import SeriesReader
from fairlead.results.store import SeriesWriter

ENDLESS_RUN = """
import sys, time
import numpy as np
from fairlead.results import RunDirectory, Signal, recorder
recorder.FLUSH_PERIOD = float(sys.argv[2])
recorder.LARGEST_SHARE_OF_FLUSHING = 1e9
signals = [Signal(f"line.core[{i}].tension", "N", "pull in the core") for i in range(20)]
run = RunDirectory.create(sys.argv[1], signals, {"name": "endless"})
rows = 0
while True:
    t = (rows + np.arange(10)) * 1e-3
    run.append(t, np.repeat(t[:, None], 20, axis=1), np.zeros(10))
    run.event(t[-1], "pad", "stuck", "forward", "slides")
    rows += 10
    time.sleep(1e-4)
"""


def signals_named(*names: str) -> tuple[Signal, ...]:
    return tuple(Signal(name, "N", f"about {name}") for name in names)


def block(first: int, rows: int, columns: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return rows whose values all equal their time, so that any shift or gap shows."""
    t = np.arange(first, first + rows, dtype=float)
    return t, np.repeat(t[:, None], columns, axis=1), np.zeros(rows, np.int8)


def readable_rows(path: Path) -> int:
    """Return how many rows fairlead reads, after checking them, and that xarray reads the file as well."""
    reader = SeriesReader(path)
    t, values = reader.time(), reader.values([signal.name for signal in reader.signals])
    np.testing.assert_array_equal(values, np.repeat(t[:, None], len(reader.signals), axis=1))
    with xarray.open_dataset(path, engine="h5netcdf") as data:
        data.load()
    return len(t)


@pytest.mark.parametrize("count", [3, layout.MOST_VARIABLES + 1])
def test_many_blocks_read_back_as_one_in_both_layouts(tmp_path: Path, count: int) -> None:
    signals = signals_named(*(f"line.core[{i}].tension" for i in range(count)))
    writer = SeriesWriter(tmp_path / "series.nc", signals)
    for first in range(0, 3000, 500):
        writer.write(*block(first, 500, count))
    writer.close()
    assert SeriesReader(tmp_path / "series.nc").signals == signals
    assert readable_rows(tmp_path / "series.nc") == 3000


def test_a_large_file_grows_in_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(store, "LARGEST_COPY", 2000)
    writer = SeriesWriter(tmp_path / "series.nc", signals_named("a", "b"))
    for first in range(0, 1000, 50):
        writer.write(*block(first, 50, 2))
    writer.close()
    assert readable_rows(tmp_path / "series.nc") == 1000


@pytest.mark.parametrize(
    "name", ["time", "side", "values", "signal", "a/b", ".hidden", "100%", "Größe.µ", "x y"]
)
def test_any_name_survives(tmp_path: Path, name: str) -> None:
    writer = SeriesWriter(tmp_path / "series.nc", signals_named("%time", name))
    writer.write(np.zeros(1), np.array([[1.0, 2.0]]), np.zeros(1, np.int8))
    writer.close()
    reader = SeriesReader(tmp_path / "series.nc")
    assert reader.signals == signals_named("%time", name)
    assert reader.values(["%time", name]).tolist() == [[1.0, 2.0]]


def test_xarray_reads_names_units_and_times_from_the_file_itself(tmp_path: Path) -> None:
    writer = SeriesWriter(tmp_path / "series.nc", signals_named("line.core[12].tension"))
    writer.write(*block(0, 5, 1))
    writer.close()
    with xarray.open_dataset(tmp_path / "series.nc", engine="h5netcdf") as data:
        tension = data["line.core[12].tension"]
        assert tension.dims == ("time",)
        assert tension.attrs["units"] == "N"
        assert data["time"].attrs["units"] == "s"
        assert tension.attrs["long_name"] == "about line.core[12].tension"
        np.testing.assert_array_equal(data["time"], np.arange(5.0))


@pytest.mark.slow
@pytest.mark.parametrize("period", ["0", "0.05"])
def test_a_killed_run_is_readable_up_to_its_last_flush(tmp_path: Path, period: str) -> None:
    path = tmp_path / "run"
    process = subprocess.Popen([sys.executable, "-c", ENDLESS_RUN, str(path), period])
    try:
        until = time.monotonic() + 600
        while not _has_an_event(path):
            assert process.poll() is None
            assert time.monotonic() < until
            time.sleep(0.01)
        time.sleep(0.3)  # it is killed at any time in what follows
    finally:
        process.send_signal(signal.SIGKILL)
        process.wait()
    assert readable_rows(path / "series.nc") > 0
    result = Result.open(path)
    assert result.status == "killed"
    assert len(result.events) > 0
    assert result.events[-1].guard == "slides"


def _has_an_event(path: Path) -> bool:
    """Whether a line of events is on the disk whole, and rows; they are written before it."""
    file = path / "events.csv"
    return file.exists() and file.read_bytes().count(b"\n") > 1


class Recorded(io.BytesIO):
    """A file in memory that remembers its contents after every write that HDF5 makes."""

    def __init__(self, content: bytes) -> None:
        super().__init__(content)
        self.states: list[bytes] = []

    def write(self, data) -> int:  # type: ignore[no-untyped-def, override]
        written = super().write(data)
        self.states.append(self.getvalue())
        return written


@pytest.mark.parametrize("count", [3, layout.MOST_VARIABLES + 1])
def test_every_prefix_of_a_flush_is_readable(tmp_path: Path, count: int) -> None:
    signals = signals_named(*(f"line.core[{i}].tension" for i in range(count)))
    writer = SeriesWriter(tmp_path / "series.nc", signals)
    writer.write(*block(0, 100, count))
    disk = Recorded((tmp_path / "series.nc").read_bytes())
    writer.close()  # leaves no room for more
    with h5py.File(disk, "r+", libver=("earliest", "v110")) as file:
        for first in (100, 200):
            store._append(file, signals, first, *block(first, 100, count))
            file.flush()
    assert len(disk.states) > 2
    for number, state in enumerate(disk.states):
        cut = tmp_path / f"cut{number}.nc"
        cut.write_bytes(state)
        assert readable_rows(cut) >= 100
    assert readable_rows(cut) == 300


@pytest.mark.parametrize("count", [3, 501])
def test_a_file_that_is_closed_keeps_no_room_for_rows_that_never_came(tmp_path: Path, count: int) -> None:
    path = tmp_path / "series.nc"
    writer = SeriesWriter(path, signals_named(*(f"line.core[{i}].tension" for i in range(count))))
    for first in range(0, 1100, 100):
        writer.write(*block(first, 100, count))
    before = path.stat().st_size
    writer.close()
    assert before > 2000 * 8 * count
    assert path.stat().st_size < 1100 * 8 * (count + 3) + 4096 * (count + 10)
    assert readable_rows(path) == 1100


def test_a_full_disk_is_told_with_a_way_out(tmp_path: Path) -> None:
    script = (
        "import resource, signal, sys\n"
        "import numpy as np\n"
        "from fairlead.errors import FairleadError\n"
        "from fairlead.results import RunDirectory, Signal\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (200_000, 200_000))\n"
        "run = RunDirectory.create(sys.argv[1], [Signal('a', 'N', '')], {})\n"
        "try:\n"
        "    for k in range(200):\n"
        "        run.append(k + np.linspace(0, 1, 1000), np.ones((1000, 1)), np.zeros(1000))\n"
        "        run.flush(at_once=True)\n"
        "except FairleadError as error:\n"
        "    print(error)\n"
    )
    done = subprocess.run(
        [sys.executable, "-c", script, str(tmp_path / "run")], capture_output=True, text=True, check=False
    )
    assert "Results cannot be written" in done.stdout
    assert "Make room" in done.stdout
    assert done.returncode == 0, done.stderr
    assert len(Result.open(tmp_path / "run")["a"]) >= 1000
