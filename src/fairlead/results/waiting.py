"""Rows that wait to be written: few in memory, more in a file without a name, which needs no layout.

To lay out `series.nc` costs as much as to write thousands of rows, and to give back the room that was too much as much
again. So a run that is over soon lays it out once, at its end; what it recorded until then waits here.
"""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import IO

import numpy as np

from fairlead.results.sink import Block

MOST_BYTES_IN_MEMORY = 2**22


class Waiting:
    """Blocks of rows, given back in order. In `folder` the file is made, once one is needed."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._in_memory: list[Block] = []
        self._file: IO[bytes] | None = None
        self._in_file: list[tuple[int, int, int]] = []
        """Where each portion begins, its rows and signals."""

    def add(self, block: Block) -> None:
        """Keep one more block."""
        self._in_memory.append(block)

    @property
    def memory_is_full(self) -> bool:
        """Whether memory holds as much as it should."""
        return sum(values.nbytes for _, values, _ in self._in_memory) > MOST_BYTES_IN_MEMORY

    @property
    def rows(self) -> int:
        """How many rows wait."""
        return sum(rows for _, rows, _ in self._in_file) + sum(len(t) for t, _, _ in self._in_memory)

    def set_aside(self) -> None:
        """Put what memory holds into the file, as one portion. Raises OSError when the disk is full."""
        if self._file is None:
            self._file = tempfile.TemporaryFile(dir=self._folder)  # noqa: SIM115 - it lives until all is given back
        start = self._file.seek(0, os.SEEK_END)
        t, values, side = _joined(self._in_memory)
        for part in (t, values, side):
            self._file.write(part.data)
        self._in_file.append((start, *values.shape))
        self._in_memory = []

    def give_back(self) -> Iterator[Block]:
        """All rows in order, in portions of about what memory should hold.

        A portion waits until the next is asked for: one that could not be written is given back again.
        """
        while self._file is not None:
            yield _portion(self._file, *self._in_file[0])
            del self._in_file[0]
            if not self._in_file:
                self._file.close()
                self._file = None
        if self._in_memory:
            yield _joined(self._in_memory)
            self._in_memory = []


def _portion(file: IO[bytes], start: int, rows: int, signals: int) -> Block:
    file.seek(start)
    t, values, side = (file.read(size) for size in (8 * rows, 8 * rows * signals, rows))
    return np.frombuffer(t), np.frombuffer(values).reshape(rows, signals), np.frombuffer(side, "i1")


def _joined(blocks: list[Block]) -> Block:
    t, values, side = (np.concatenate(parts) for parts in zip(*blocks, strict=True))
    return t, values, side
