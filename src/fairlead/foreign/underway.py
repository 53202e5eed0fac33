"""Which call of an FMU is under way, in memory that the process of the FMU and the one that asks share.

So a call is known in which that process ends, or from which it does not come back. The memory is a small file: what is
written there outlives who wrote it.
"""

from __future__ import annotations

import contextlib
import mmap
import pathlib
from collections.abc import Iterator

SIZE = 64  # bytes; no call of FMI 2 or 3 has a longer name


def make(file: pathlib.Path) -> None:
    """Make the memory: no call is under way."""
    file.write_bytes(bytes(SIZE))


def read(file: pathlib.Path) -> str:
    """The call that is under way as the standard names it, such as doStep; "" where there is none."""
    try:
        name = file.read_bytes()[:SIZE].rstrip(b"\0").decode("ascii", "replace")
    except OSError:
        return ""
    name = name.removeprefix("fmi2").removeprefix("fmi3")
    return name[:1].lower() + name[1:]


class Underway:
    """Writes down each call."""

    def __init__(self, file: str) -> None:
        """In memory that is made already."""
        with pathlib.Path(file).open("r+b") as opened:
            self._memory = mmap.mmap(opened.fileno(), SIZE)

    @contextlib.contextmanager
    def call(self, name: str) -> Iterator[None]:
        """While a call of this name is under way."""
        self._memory[:] = name.encode()[:SIZE].ljust(SIZE, b"\0")
        try:
            yield
        finally:
            self._memory[:] = bytes(SIZE)
