"""Reads `series.nc`, of a finished run, of one that goes on, or of one that was killed."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fairlead.results.signal import Signal
from fairlead.results.store import MATRIX, SIDE, TIME, variable_name

if TYPE_CHECKING:
    import h5py


class SeriesReader:
    """The recorded signals of one file, which is open only while something is being read."""

    def __init__(self, path: Path) -> None:
        self.path = path
        with self._open() as file:
            self._is_matrix = "units" in file and "signal" in file
            self.signals = _matrix_signals(file) if self._is_matrix else _column_signals(file)
            self.rows = self._whole_rows(file)
        self._column = {signal.name: index for index, signal in enumerate(self.signals)}

    def time(self) -> NDArray[np.float64]:
        """Return the recorded times (n,) [s]; an event's time occurs twice."""
        with self._open() as file:
            times: NDArray[np.float64] = file[TIME][: self.rows]
            return times

    def side(self) -> NDArray[np.int8]:
        """Return -1 left of an event, +1 right of it, 0 elsewhere (n,)."""
        with self._open() as file:
            sides: NDArray[np.int8] = file[SIDE][: self.rows]
            return sides

    def values(self, names: list[str]) -> NDArray[np.float64]:
        """Return the values (n, len(names)) of signals that the file has."""
        with self._open() as file:
            if self._is_matrix:
                return self._matrix_columns(file, names)
            columns = np.empty((self.rows, len(names)), order="F")
            for index, name in enumerate(names):
                columns[:, index] = file[variable_name(name)][: self.rows]
            return columns

    def _matrix_columns(self, file: h5py.File, names: list[str]) -> NDArray[np.float64]:
        wanted = [self._column[name] for name in names]
        columns: NDArray[np.float64]
        if len(wanted) == 1:
            columns = file[MATRIX][: self.rows, wanted[0]][:, None]
        else:  # Reading all and picking in memory beats a scattered selection in the file.
            columns = file[MATRIX][: self.rows][:, wanted]
        return columns

    def _whole_rows(self, file: h5py.File) -> int:
        """Return how many rows all variables have; a kill within a flush leaves more of some."""
        names = [MATRIX] if self._is_matrix else [variable_name(signal.name) for signal in self.signals]
        rows = min(len(file[name]) for name in (TIME, SIDE, *names))
        unwritten = np.flatnonzero(np.isnan(file[TIME][:rows]))
        return int(unwritten[0]) if unwritten.size else rows

    def _open(self) -> h5py.File:
        import h5py

        return h5py.File(self.path, "r", locking=False)


def _column_signals(file: h5py.File) -> tuple[Signal, ...]:
    """Return the signals in the order in which they were declared; HDF5 lists them by name."""
    found = {}
    for name, variable in file.items():
        if name not in (TIME, SIDE):
            texts = (variable.attrs[key].decode() for key in ("signal", "units", "long_name"))
            found[int(variable.attrs["position"])] = Signal(*texts)
    return tuple(found[position] for position in sorted(found))


def _matrix_signals(file: h5py.File) -> tuple[Signal, ...]:
    rows = zip(*(file[name].asstr()[:] for name in ("signal", "units", "long_name")), strict=True)
    return tuple(Signal(*row) for row in rows)
