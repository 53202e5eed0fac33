"""A small file of settings, as `fairlead cost --write` leaves it and `fairlead run --settings` takes it.

    run.accuracy: 0.001
    run.engine: rodas
    friction.method: hold

Each line is what `--set` would be given: a scene parameter or a dotted path, and a value.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from fairlead.errors import Fault, Location, ModelError, UsageError, shown
from fairlead.netlist.limits import MOST_BYTES
from fairlead.netlist.yaml12 import read_yaml


class Setting(str):
    """The text of a setting that knows where it was written."""

    where: Location

    def __new__(cls, text: str, where: Location) -> Setting:
        """A text and its place."""
        made = super().__new__(cls, text)
        made.where = where
        return made

    def __getnewargs__(self) -> tuple[str, Location]:  # type: ignore[override]  # str has its text alone
        return str(self), self.where


def as_settings(values: Mapping[str, float | str], where: Location) -> dict[str, str]:
    """Values as a command line has them; a text that knows its place keeps it, the others were given at `where`."""
    texts = {"True": "true", "False": "false"}
    return {name: value if isinstance(value, Setting)
            else Setting(value if isinstance(value, str) else texts.get(str(value), str(value)), where)
            for name, value in values.items()}  # fmt: skip


def read_settings(path: str | os.PathLike[str]) -> dict[str, str]:
    """The settings of a file. Raises UsageError when it cannot be read, ModelError with every line that is none."""
    file = Path(path)
    try:
        data = file.read_bytes()[: MOST_BYTES + 1]
        text = data.decode("utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "it is not a text in UTF-8"
        raise UsageError(f"--settings {file}: {reason}.\n    fairlead cost MODEL --write FILE makes one.") from None
    if len(data) > MOST_BYTES:
        raise UsageError(f"--settings {file}: more than {MOST_BYTES} bytes are no settings.")
    tree, faults = read_yaml(text, str(file))
    found: dict[str, str] = {}
    if tree is not None and not isinstance(tree.content, dict):
        what = f"{shown(tree.plain())} is not a map of settings"
        faults.append(Fault(tree.where, what, "Write a name and a value in each line, such as run.accuracy: 1e-3."))
    for name, value in tree.entries.items() if tree is not None else ():
        if isinstance(value.content, dict | list):
            what = f"{name}: {shown(value.plain())} is not a value"
            faults.append(Fault(value.where, what, f"Write its path in one word, such as {name}.accuracy: 1e-3."))
        else:
            found[name] = Setting(_text(value.content), value.where)
    if faults:
        raise ModelError(faults)
    return found


def write_settings(path: str | os.PathLike[str], settings: Mapping[str, str], comment: str = "") -> Path:
    """Write settings to a file, with a comment above them."""
    file = Path(path)
    file.parent.mkdir(parents=True, exist_ok=True)
    lines = [f"# {line}".rstrip() for line in comment.splitlines()] + [f"{k}: {v}" for k, v in settings.items()]
    file.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return file


def _text(content: object) -> str:
    """As it was written; null takes a setting of another treatment away."""
    return "null" if content is None else str(content).lower() if isinstance(content, bool) else str(content)
