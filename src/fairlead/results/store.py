"""The file `series.nc`: recorded signals over time in the NetCDF-4 layout, written with h5py.

The file has one dimension, `time` [s]. Time repeats at an event: the row with `side` -1 holds the
values on its left, the row with `side` +1 those on its right; `side` is 0 everywhere else.

    up to `MOST_VARIABLES` signals    one variable per signal, under the name of the signal
    more                              one matrix `values(time, signal)`, with the text variables
                                      `signal`, `units` and `long_name` along its second dimension

Readers of NetCDF spend a time on each variable that grows with the number of variables (h5netcdf
1.8 opens 500 in 3 s and 2000 in 40 s), hence the limit. They also look through all variables for
the length of an unlimited dimension (250 signals: 44 s), hence the bounded `MOST_ROWS`.

A killed run leaves a readable file. Blocks are written and flushed in one go, so that between two
flushes HDF5 has nothing to write, and chunks are not compressed, so that within a chunk nothing
but data and lengths change on the disk. The earliest file format is used: newer ones mark a file
as open for writing, and most readers refuse a file that still has the mark.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fairlead.results.signal import Signal

if TYPE_CHECKING:
    import h5py

MOST_VARIABLES = 500
MOST_ROWS = 2**40
ROWS_IN_CHUNK = 1024
BYTES_IN_MATRIX_CHUNK = 2**20
TIME, SIDE, MATRIX = "time", "side", "values"
SIDE_MEANING = "-1 left of an event, +1 right of it, 0 elsewhere"
FORMAT = "fairlead-series-1"


class SeriesWriter:
    """Writes blocks of rows to a new `series.nc`; every block is on the disk when `write` returns."""

    def __init__(self, path: Path, signals: tuple[Signal, ...]) -> None:
        import h5py

        # No lock: a notebook may look at the file while the run goes on.
        self._file = h5py.File(path, "w", libver=("earliest", "v110"), locking=False)
        self._file.attrs["Conventions"] = "CF-1.8"
        self._file.attrs["format"] = FORMAT
        self._time = _new_time(self._file)
        self._side = _Columns(self._file, (Signal(SIDE, "1", SIDE_MEANING),), self._time, "i1")
        layout = _Columns if len(signals) <= MOST_VARIABLES else _Matrix
        self._values = layout(self._file, signals, self._time)
        self._rows = 0
        self._file.flush()

    def write(self, t: NDArray[np.float64], values: NDArray[np.float64], side: NDArray[np.int8]) -> None:
        """Append `t` (k,) [s], `values` (k, m) and `side` (k,), and flush them to the disk.

        Raises OSError when the disk does not take them.
        """
        first, last = self._rows, self._rows + len(t)
        self._values.write(first, values)
        self._side.write(first, side[:, None])
        self._time.resize((last,))
        self._time[first:] = t
        self._file.flush()
        self._rows = last

    def close(self) -> None:
        """Close the file; writing after that is an error."""
        self._file.close()


class _Columns:
    """One variable per signal, through the low-level interface of h5py, which is 3 times as fast."""

    def __init__(
        self, file: h5py.File, signals: tuple[Signal, ...], time: h5py.Dataset, kind: str = "f8"
    ) -> None:
        from h5py import h5d, h5ds, h5p, h5s, h5t

        number = h5t.py_create(np.dtype(kind))
        creation = h5p.create(h5p.DATASET_CREATE)
        creation.set_chunk((ROWS_IN_CHUNK,))
        if kind == "f8":
            creation.set_fill_value(np.array(np.nan))
        empty = h5s.create_simple((0,), (MOST_ROWS,))
        self._columns = []
        for position, signal in enumerate(signals):
            column = h5d.create(file.id, variable_name(signal.name).encode(), number, empty, creation)
            h5ds.attach_scale(column, time.id, 0)
            _describe(column, signal)
            _set_number(column, "position", position)
            self._columns.append(column)

    def write(self, first: int, values: NDArray[Any]) -> None:
        """Append values (k, m) below row `first`; the two selections serve all columns."""
        from h5py import h5s

        rows = len(values)
        in_memory = h5s.create_simple((rows,))
        in_file = h5s.create_simple((first + rows,), (MOST_ROWS,))
        in_file.select_hyperslab((first,), (rows,))
        for column, numbers in zip(self._columns, np.ascontiguousarray(values.T), strict=True):
            column.set_extent((first + rows,))
            column.write(in_memory, in_file, numbers)


class _Matrix:
    """All signals in one variable."""

    def __init__(self, file: h5py.File, signals: tuple[Signal, ...], time: h5py.Dataset) -> None:
        count = len(signals)
        names = _new_texts(file, "signal", [signal.name for signal in signals])
        names.make_scale("signal")
        _new_texts(file, "units", [signal.unit for signal in signals]).dims[0].attach_scale(names)
        _new_texts(file, "long_name", [signal.description for signal in signals]).dims[0].attach_scale(names)
        chunk = (max(1, BYTES_IN_MATRIX_CHUNK // (8 * count)), count)
        self._values = file.create_dataset(
            MATRIX, (0, count), "f8", maxshape=(MOST_ROWS, count), chunks=chunk, fillvalue=np.nan
        )
        self._values.dims[0].attach_scale(time)
        self._values.dims[1].attach_scale(names)

    def write(self, first: int, values: NDArray[Any]) -> None:
        """Append values (k, m) below row `first`."""
        self._values.resize(first + len(values), axis=0)
        self._values[first:] = values


def variable_name(signal: str) -> str:
    """Return the variable of a signal: its own name, but for the slash and the name of the dimension."""
    name = signal.replace("%", "%25").replace("/", "%2F")
    return f"%{name}" if signal == TIME or signal.startswith(".") else name


def _new_time(file: h5py.File) -> h5py.Dataset:
    time = file.create_dataset(
        TIME, (0,), "f8", maxshape=(MOST_ROWS,), chunks=(ROWS_IN_CHUNK,), fillvalue=np.nan
    )
    time.make_scale(TIME)
    _describe(time.id, Signal(TIME, "s", "time; an event's time occurs twice"))
    return time


def _new_texts(file: h5py.File, name: str, texts: list[str]) -> h5py.Dataset:
    import h5py

    return file.create_dataset(name, data=np.array(texts, dtype=object), dtype=h5py.string_dtype())


def _describe(variable: Any, signal: Signal) -> None:
    _set_text(variable, "units", signal.unit)
    _set_text(variable, "long_name", signal.description or signal.name)
    _set_text(variable, "signal", signal.name)


def _set_text(variable: Any, name: str, text: str) -> None:
    from h5py import h5a, h5s, h5t

    content = text.encode() or b"\0"
    kind = h5t.C_S1.copy()
    kind.set_size(len(content))
    kind.set_cset(h5t.CSET_UTF8)
    attribute = h5a.create(variable, name.encode(), kind, h5s.create(h5s.SCALAR))
    attribute.write(np.array(content), mtype=kind)


def _set_number(variable: Any, name: str, number: int) -> None:
    from h5py import h5a, h5s, h5t

    attribute = h5a.create(variable, name.encode(), h5t.NATIVE_INT32, h5s.create(h5s.SCALAR))
    attribute.write(np.array(number, "i4"))
