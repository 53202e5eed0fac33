"""The file of an FMU: a ZIP whose bytes depend on what is in it, and on nothing else."""

from __future__ import annotations

import io
import pathlib
import tempfile
import zipfile
from collections.abc import Mapping

from fairlead.errors import UsageError

BEGINNING = (1980, 1, 1, 0, 0, 0)
"""The time that every entry bears, the earliest a ZIP can tell."""
READABLE = 0o644 << 16


def packed(files: Mapping[str, bytes]) -> bytes:
    """A ZIP of files by name, in their order."""
    room = io.BytesIO()
    with zipfile.ZipFile(room, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, BEGINNING)
            entry.compress_type, entry.external_attr, entry.create_system = zipfile.ZIP_DEFLATED, READABLE, 3
            archive.writestr(entry, content)
    return room.getvalue()


def write(file: pathlib.Path, content: bytes) -> None:
    """Write a file in one go; what stood there stays where that fails. Raises UsageError."""
    if file.is_dir():
        raise UsageError(f"{file} is a folder. Name a file with -o, as in -o {file.resolve().name or 'model'}.fmu.")
    temporary = None
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=file.parent, suffix=".part", delete=False) as part:
            temporary = pathlib.Path(part.name)
            part.write(content)
        temporary.chmod(0o644)
        temporary.replace(file)
    except OSError as error:
        if temporary is not None:
            temporary.unlink(missing_ok=True)
        raise UsageError(f"{file} cannot be written: {error.strerror or error}. Name another file with -o.") from error
