"""How files get into a run directory: new ones, never through a link that lies there.

    place(path, data)            the whole file in one go, by renaming: readers see the old or the new one
    with placing(path) as part   the same for what is written to a name: `part` lies beside `path`
    create(path)                 an empty file to write to as the run goes

Whoever put a link, or a second name of a file, in the place of `series.csv` wants its target left alone. So whatever
has the name is replaced, and what it points to stays as it is.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import BinaryIO

PART = ".part"


def place(path: Path, data: bytes | str) -> None:
    """Put a file with these contents in its place; text as UTF-8."""
    with placing(path) as part:
        part.write_bytes(data.encode() if isinstance(data, str) else data)


@contextmanager
def placing(path: Path) -> Iterator[Path]:
    """Yield an empty file beside `path`, which takes its place in the end; after an exception nothing is left.

    An error of the operating system names `path`: that of a full disk, while a file is written, names none.
    """
    part = path.with_name(f".{path.name}.{os.getpid()}{PART}")
    try:
        create(part).close()
        try:
            yield part
            part.replace(path)
        except BaseException:
            part.unlink(missing_ok=True)
            raise
    except OSError as error:
        if error.filename is None or Path(os.fsdecode(error.filename)) == part:
            error.filename = str(path)
        raise


def create(path: Path) -> BinaryIO:
    """Create a file for writing; what has its name is removed, be it a link."""
    path.unlink(missing_ok=True)
    return path.open("xb")


def is_part(file: Path) -> bool:
    """Return whether this is what a killed `placing` has left."""
    return file.name.startswith(".") and file.name.endswith(PART)
