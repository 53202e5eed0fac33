"""Files of a cache that are taken only when they are whole, and under the name they were written for.

    write(path, KIND, body)      under a temporary name, then renamed: readers see all of it or nothing
    read(path, KIND)             the same bytes, or BrokenSealError

A file begins with its kind, a line that says what it holds and in which format, and a SHA-256 of its name and its
body. So a file that is torn, changed, of another format, or copied over another one is refused.
"""

from __future__ import annotations

import hashlib
import pathlib
import tempfile

DIGEST_BYTES = 32


class BrokenSealError(ValueError):
    """A file that is not what was written under its name."""


def read(path: pathlib.Path, kind: bytes) -> bytes:
    """Return the body of the file. Raises BrokenSealError, and OSError when it cannot be read."""
    data = path.read_bytes()
    start = len(kind) + DIGEST_BYTES
    body = data[start:]
    if data[:start] != kind + _seal(path.name, kind, body):
        raise BrokenSealError(f"{path.name} is torn or foreign")
    return body


def write(path: pathlib.Path, kind: bytes, body: bytes) -> None:
    """Write the file in one go. Raises OSError and leaves nothing behind when the disk refuses."""
    temporary = None
    try:
        with tempfile.NamedTemporaryFile(dir=path.parent, suffix=".part", delete=False) as file:
            temporary = pathlib.Path(file.name)
            file.write(kind + _seal(path.name, kind, body) + body)
        temporary.replace(path)
    except BaseException:
        if temporary is not None:
            temporary.unlink(missing_ok=True)
        raise


def _seal(name: str, kind: bytes, body: bytes) -> bytes:
    state = hashlib.sha256()
    for part in (kind, name.encode(), body):
        state.update(len(part).to_bytes(8, "little") + part)
    return state.digest()
