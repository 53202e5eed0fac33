"""The netlist as it is being edited, and the file it came from, which changes only when somebody says so."""

from __future__ import annotations

import hashlib
import shutil

from fairlead.errors import UsageError
from fairlead.netlist.files import bundled_models, display, find, named_by_folder, read_text
from fairlead.results.placing import placing

MARK = b"\xef\xbb\xbf"
"""A file in UTF-8 may begin with this; it stays."""


class Draft:
    """A netlist by path or by the name of a bundled model. Raises ModelError when it cannot be read as a text."""

    def __init__(self, name: str) -> None:
        self.file = find(name)
        text, data = read_text(self.file)
        self.text = text.replace("\r\n", "\n")
        self._marked, self._crlf = data.startswith(MARK), "\r\n" in text
        self._seen = _digest(data)

    @property
    def shown(self) -> str:
        """What messages call the file."""
        return display(self.file)

    @property
    def refusal(self) -> str:
        """Why the file is not to be saved, or ""."""
        if self.file.resolve() in {one.resolve() for one in (bundled_models() | named_by_folder()).values()}:
            return f"{self.file.stem} is a bundled model, which is not changed. Copy its text into a file of your own."
        return ""

    def save(self, text: str) -> None:
        """Put the text into the file in one go. Raises UsageError when it is not to be, or has changed meanwhile."""
        if self.refusal:
            raise UsageError(self.refusal)
        target = self.file.resolve()  # a link stays one
        try:
            now = _digest(target.read_bytes())
        except OSError as error:
            raise UsageError(f"{self.shown} cannot be read any more: {error.strerror}. Nothing was saved.") from error
        if now != self._seen:
            raise UsageError(
                f"{self.shown} was changed by another program since it was read here. Nothing was saved.\n"
                "    Copy your text, and start `fairlead view` again."
            )
        data = (text.replace("\n", "\r\n") if self._crlf else text).encode()
        data = MARK + data if self._marked else data
        try:
            with placing(target) as part:
                part.write_bytes(data)
                shutil.copymode(target, part)
        except OSError as error:
            raise UsageError(f"{self.shown} cannot be written: {error.strerror}. Nothing was saved.") from error
        self.text, self._seen = text, _digest(data)


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
