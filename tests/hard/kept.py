"""Attempts kept in a file, a line each, so that an interrupted round goes on where it stopped."""

from __future__ import annotations

import json
from pathlib import Path

from fairlead.analysis.kept_runs import key_of
from tests.hard.attempt import Attempt
from tests.hard.play import SCENES
from tests.hard.registry import Row

HERE = Path(__file__).parent


class Kept:
    """Attempts by row; one whose content has changed since is as good as none."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._lines: dict[tuple[str, str, str], Attempt] = {}
        if path.exists():
            for line in path.read_text(encoding="utf-8").splitlines():
                self._remember(Attempt(**json.loads(line)))

    def get(self, row: Row) -> Attempt | None:
        """The attempt at a row as it is now."""
        found = self.last(row)
        return found if found is not None and found.version == version(row) else None

    def last(self, row: Row) -> Attempt | None:
        """The last attempt at a row, whatever has changed since."""
        return self._lines.get((row.case.name, row.engine, row.treatment))

    def put(self, attempt: Attempt) -> None:
        """Add a line at once."""
        self.path.parent.mkdir(parents=True, exist_ok=True)
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(attempt.plain()) + "\n")
        self._remember(attempt)

    def _remember(self, attempt: Attempt) -> None:
        self._lines[attempt.case, attempt.engine, attempt.treatment] = attempt


def version(row: Row) -> str:
    """A key of all that decides a row: its scenes and oracle, what every run must keep, fairlead, the machine."""
    shared = [(HERE / name).read_text(encoding="utf-8") for name in ("play.py", "invariants.py")]
    files = [file.read_text(encoding="utf-8") for file in sorted(SCENES.glob("*.yaml")) if file.stem in row.case.source]
    return key_of(row.name, [row.case.source, str(dict(row.case.arguments)), *shared, *files])[:16]
