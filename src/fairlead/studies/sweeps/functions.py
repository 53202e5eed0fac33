"""A figure that is a Python function in a file of the user; its text travels to other processes and machines."""

from __future__ import annotations

import functools
import linecache
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fairlead.errors import UsageError


@dataclass(frozen=True)
class FromFile:
    """The function `name` of a file with this text."""

    file: str
    name: str
    text: str

    @classmethod
    def of(cls, file: Path, name: str) -> FromFile:
        """Read the file and run it once. Raises UsageError if it has no such function, or fails."""
        if not file.is_file():
            raise UsageError(f"{file}: there is no such file with a function for a figure")
        made = cls(str(file), name, file.read_text(encoding="utf-8", errors="replace"))
        try:
            found = _function(made.file, made.name, made.text)
        except Exception as error:  # noqa: BLE001 - the user's own code
            raise UsageError(f"{file} cannot be run: {type(error).__name__}: {error}") from None
        if not callable(found):
            raise UsageError(f"{file} has no function {name}")
        return made

    @property
    def label(self) -> str:
        """What the key of a case counts: another text, another figure."""
        return f"{Path(self.file).name}:{self.name} {self.text}"

    def __call__(self, result: Any) -> float:
        """The figure of a result."""
        found: float = _function(self.file, self.name, self.text)(result)
        return found


@functools.lru_cache(maxsize=64)
def _function(file: str, name: str, text: str) -> Callable[[Any], float]:
    space: dict[str, Any] = {"__name__": Path(file).stem, "__file__": file}
    linecache.cache[file] = (len(text), None, text.splitlines(keepends=True), file)
    exec(compile(text, file, "exec"), space)
    found: Callable[[Any], float] = space.get(name)  # type: ignore[assignment]
    return found
