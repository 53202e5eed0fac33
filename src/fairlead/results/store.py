"""Writes `series.nc` so that a kill at any moment leaves a readable file.

HDF5 does not replace a file's state in one go: a flush is a sequence of writes. Replaying every
prefix of such sequences showed two kinds of flush:

    within a chunk       only data and lengths change, data first: every prefix is readable
    with a new chunk     the index points to the chunk before the file admits to be that long: a
                         kill in between (well below a millisecond) makes a variable unreadable

Hence nothing but the first kind happens to a file in place. A file is laid out with room in its
only chunk; when the room is used up, a copy with `GROWTH` times the room replaces the file by
renaming. From `LARGEST_COPY` on, copying would take too long, and a new chunk of that size is
added in place: once for so many bytes the second kind of flush is risked.

Between two flushes HDF5 has nothing to write, because blocks are written and flushed together.
Chunks are not compressed: a compressed chunk changes its place in the file with every block.
"""

from __future__ import annotations

import contextlib
import os
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import fairlead.results.layout as layout
from fairlead.results.layout import SIDE, TIME, open_file
from fairlead.results.placing import create
from fairlead.results.signal import Signal

SERIES_FILE, TEMPORARY = "series.nc", "series.nc.new"
FIRST_ROOM = 1024
GROWTH = 4
LARGEST_COPY = 2**26
BYTES_AT_ONCE = 2**22
"""Read from a file to be copied, so that a copy takes no memory to speak of."""
BYTES_OF_LAYOUT = 4096  # for each variable; measured: 2700


class SeriesWriter:
    """Writes blocks of rows to a new `series.nc`, which comes into being with the first block."""

    def __init__(self, path: Path, signals: tuple[Signal, ...]) -> None:
        self.path = path
        self._signals = signals
        self._bytes_in_row = 8 * (len(signals) + 1) + 1
        self._rows = 0
        self._room = 0  # rows in the chunks there are
        self._chunk = 0  # rows in one chunk
        self._file: Any = None

    def write(
        self,
        t: NDArray[np.float64],
        values: NDArray[np.float64],
        side: NDArray[np.int8],
        to_come: int = 0,
        last: bool = False,
    ) -> None:
        """Append `t` (k,) [s], `values` (k, m) and `side` (k,); on return they are on the disk.

        So many rows are `to_come` at once. `last` says that no others follow, so that no room is left for them. Raises
        OSError when the disk is full, OSError or RuntimeError (h5py decides) when it fails otherwise.
        """
        rows = self._rows + len(t)
        if self._file is None or (rows > self._room and self._room < self._most_room()):
            known = rows + to_come
            room = min(known if last else max(GROWTH * known, FIRST_ROOM), self._most_room())
            self._move(max(room, rows, 1), t, values, side)
        else:
            if rows > self._room:
                chunks = -(-(rows - self._room) // self._chunk)
                self._probe(chunks * self._chunk)
                self._room += chunks * self._chunk
            _append(self._file, self._signals, self._rows, t, values, side)
            self._file.flush()
        self._rows = rows

    @property
    def is_laid_out(self) -> bool:
        """Whether there is a file."""
        return self._file is not None

    @property
    def rows(self) -> int:
        """How many rows have been written."""
        return self._rows

    def close(self) -> None:
        """Close the file, without the room that was left; one that never got a block is created without rows."""
        nothing = np.empty(0), np.empty((0, len(self._signals))), np.empty(0, "i1")
        if self._file is None:
            self.write(*nothing, last=True)
        elif self._room == self._chunk and self._room > self._rows > 0:
            with contextlib.suppress(OSError):  # no place for a copy: the file is good as it is
                self._move(self._rows, *nothing)
        self._file.close()

    def _most_room(self) -> int:
        return max(1, LARGEST_COPY // self._bytes_in_row)

    def _move(self, room: int, t: NDArray[Any], values: NDArray[Any], side: NDArray[Any]) -> None:
        """Replace the file by a copy that has room for `room` rows, with the block appended."""
        temporary = self.path.with_name(TEMPORARY)
        self._probe(room)
        temporary.unlink(missing_ok=True)  # a link there is not followed
        layout.create(temporary, self._signals, room)
        with open_file(temporary, "r+") as successor:
            if self._file is not None:
                _copy(self._file, successor, self._signals, self._rows)
            _append(successor, self._signals, self._rows, t, values, side)
        if self._file is not None:
            self._file.close()
        temporary.replace(self.path)
        self._file, self._room, self._chunk = open_file(self.path, "r+"), room, room

    def _probe(self, rows: int) -> None:
        """Raise OSError when the disk has no place for so many rows more.

        HDF5 must not find out: after a write that failed it cannot close the file any more, and the
        process ends with a segmentation fault. Within the room of a chunk it needs no new place.
        """
        if not hasattr(os, "posix_fallocate"):
            return
        probe = self.path.with_name(TEMPORARY)
        with create(probe) as file:
            size = rows * self._bytes_in_row + BYTES_OF_LAYOUT * (len(self._signals) + 10)
            try:
                os.posix_fallocate(file.fileno(), 0, size)
            finally:
                probe.unlink()


def _append(
    file: Any,
    signals: tuple[Signal, ...],
    first: int,
    t: NDArray[Any],
    values: NDArray[Any],
    side: NDArray[Any],
) -> None:
    """Write a block below row `first`."""
    if not len(t):
        return
    values = np.ascontiguousarray(values if layout.is_matrix(signals) else values.T)
    columns = (values,) if layout.is_matrix(signals) else values
    for name, numbers in zip((*layout.value_variables(signals), SIDE, TIME), (*columns, side, t), strict=True):
        _write_rows(file, name, first, numbers)


def _copy(source: Any, successor: Any, signals: tuple[Signal, ...], rows: int) -> None:
    """Write the first `rows` rows of one file to another without rows: a variable that holds one signal as a whole."""
    in_row = 8 * len(signals) if layout.is_matrix(signals) else 8
    for first in range(0, rows, slab := max(1, BYTES_AT_ONCE // in_row)):
        last = min(first + slab, rows)
        for name in (*layout.value_variables(signals), SIDE, TIME):
            _write_rows(successor, name, first, _read_rows(source, name, first, last))


def _write_rows(file: Any, name: str, first: int, numbers: NDArray[Any]) -> None:
    """Write rows of a variable from row `first` on; through the low-level interface, as below."""
    from h5py import h5d

    variable = h5d.open(file.id, name.encode())
    variable.set_extent((first + len(numbers), *numbers.shape[1:]))
    variable.write(*_spaces(variable, first, numbers.shape), numbers)


def _read_rows(file: Any, name: str, first: int, last: int) -> NDArray[Any]:
    """The rows `first` to `last` of a variable; through the low-level interface, which is 5 times as fast."""
    from h5py import h5d

    variable = h5d.open(file.id, name.encode())
    numbers = np.empty((last - first, *variable.shape[1:]), variable.dtype)
    variable.read(*_spaces(variable, first, numbers.shape), numbers)
    return numbers


def _spaces(variable: Any, first: int, shape: tuple[int, ...]) -> tuple[Any, Any]:
    """A block of rows in memory, and its place from row `first` on in a variable."""
    from h5py import h5s

    there = variable.get_space()
    there.select_hyperslab((first, *(0 for _ in shape[1:])), shape)
    return h5s.create_simple(shape), there
