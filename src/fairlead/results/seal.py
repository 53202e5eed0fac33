"""What `run.json` says of the other files of a run when it ends: how long they are, and their SHA-256.

HDF5 believes what it reads; one wrong byte can send its library round in a circle for ever. So a file is compared with
what the run has left before it is opened. A run that goes on has no such entry yet, and one that was killed never gets
one: their files are read as they are.
"""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from fairlead.results.damage import DamagedResultsError, reading

ENTRY = "files"
WAY_OUT = (
    "Take the file from a copy if there is one, or run the netlist again. A file that was changed on purpose is read "
    f"when its entry under `{ENTRY}` is taken out of run.json."
)


def sealed(*files: Path) -> dict[str, Any]:
    """The entry for run.json about these files, each with its bytes and their SHA-256."""
    return {ENTRY: {file.name: {"bytes": file.stat().st_size, "sha256": _digest(file)} for file in files}}


def require_intact(file: Path, record: Mapping[str, Any]) -> None:
    """Raise DamagedResultsError when a file is not the one that the run of `record` has left."""
    import fairlead.results.run_schema as run_schema

    left = run_schema.files(file.with_name("run.json"), record).get(file.name)
    if left is None:
        return
    with reading(file):
        size = file.stat().st_size
        if size != left["bytes"]:
            raise DamagedResultsError(file, f"it has {size} bytes; the run left {left['bytes']}.", WAY_OUT)
        if _digest(file) != left["sha256"]:
            raise DamagedResultsError(file, "its bytes are not those that the run left (SHA-256).", WAY_OUT)


def _digest(file: Path) -> str:
    with file.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()
