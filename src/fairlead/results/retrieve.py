"""Reads `series.nc`, of a finished run, of one that goes on, or of one that was killed.

The file may be damaged, or not ours at all: what it says of itself is checked when it is opened, and its times when
they are read. Whatever HDF5 makes of the rest becomes DamagedResultsError (see `damage.py`).
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import NDArray

import fairlead.results.layout as layout
from fairlead.results.curves import BEFORE, INSIDE
from fairlead.results.damage import DamagedResultsError, reading
from fairlead.results.layout import MATRIX, SIDE, TIME, open_file
from fairlead.results.signal import Signal

if TYPE_CHECKING:
    import h5py


LARGEST_COMPRESSION = 1100
"""Bytes that one byte of a file may stand for; deflate reaches 1032."""


class SeriesReader:
    """The recorded signals of one file, which is open only while something is being read."""

    def __init__(self, path: Path) -> None:
        """Look at the signals of a file. Raises DamagedResultsError."""
        self.path = path
        with reading(path), open_file(path, "r") as file:
            self.signals = layout.read_signals(file)
            self.rows = self._whole_rows(file)
            size = path.stat().st_size
        if 8 * self.rows > LARGEST_COMPRESSION * size:
            raise DamagedResultsError(path, f"it says that it holds {self.rows} rows, in {size} bytes.")
        self._position = {signal.name: index for index, signal in enumerate(self.signals)}

    @classmethod
    def of_written(cls, path: Path, signals: tuple[Signal, ...], rows: int) -> Self:
        """The reader of a file that this process has just written, which need not be asked what it holds."""
        reader = cls.__new__(cls)
        reader.path, reader.signals, reader.rows = path, signals, rows
        reader._position = {signal.name: index for index, signal in enumerate(signals)}
        return reader

    def time(self) -> NDArray[np.float64]:
        """Return the recorded times (n,) [s]; an event's time occurs twice."""
        with reading(self.path), open_file(self.path, "r") as file:
            times: NDArray[np.float64] = file[TIME][: self.rows]
        self._require_all(times, np.isfinite(times) & (np.diff(times, prepend=times[:1]) >= 0), "the time")
        return times

    def side(self) -> NDArray[np.int8]:
        """Return -1 left of an event, +1 right of it, 2 inside a step, 0 elsewhere (n,)."""
        with reading(self.path), open_file(self.path, "r") as file:
            sides: NDArray[np.int8] = file[SIDE][: self.rows]
        self._require_all(sides, (sides >= BEFORE) & (sides <= INSIDE), "the side")
        return sides

    def values(self, names: list[str]) -> NDArray[np.float64]:
        """Return the values (n, len(names)) of signals that the file has."""
        with reading(self.path), open_file(self.path, "r") as file:
            if layout.is_matrix(self.signals):
                return self._matrix_columns(file, names)
            return self._single_columns(file, names)

    def _require_all(self, values: NDArray[Any], right: NDArray[np.bool_], what: str) -> None:
        """Name the first row that is not right."""
        wrong = np.flatnonzero(~right)
        if len(values) != self.rows:
            raise DamagedResultsError(self.path, f"{what} has {len(values)} rows of {self.rows}.")
        if wrong.size:
            raise DamagedResultsError(self.path, f"row {wrong[0] + 1}: {what} is {values[wrong[0]]}, out of its order.")

    def _single_columns(self, file: h5py.File, names: list[str]) -> NDArray[np.float64]:
        """Read one variable per name through the low-level interface, which is 3 times as fast."""
        from h5py import h5d, h5s

        columns = np.empty((len(names), self.rows))
        in_memory = h5s.create_simple((self.rows,))
        for name, values in zip(names, columns, strict=True):
            column = h5d.open(file.id, layout.variable_name(name).encode())
            in_file = column.get_space()
            in_file.select_hyperslab((0,), (self.rows,))
            column.read(in_memory, in_file, values)
        return columns.T

    def _matrix_columns(self, file: h5py.File, names: list[str]) -> NDArray[np.float64]:
        wanted = [self._position[name] for name in names]
        columns: NDArray[np.float64]
        if len(wanted) == 1:
            columns = file[MATRIX][: self.rows, wanted[0]][:, None]
        else:  # Reading all and picking in memory beats a scattered selection in the file.
            columns = file[MATRIX][: self.rows][:, wanted]
        return columns

    def _whole_rows(self, file: h5py.File) -> int:
        """Return how many rows all variables have; a kill within a flush leaves more of some."""
        from h5py import h5d

        names = (TIME, SIDE, *layout.value_variables(self.signals))
        return min(h5d.open(file.id, name.encode()).shape[0] for name in names)
