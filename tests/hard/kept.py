"""Attempts kept in a file, a line each, so that an interrupted round goes on where it stopped.

An attempt counts only at the commit it was made at, so that a page never mixes the rows of several.
"""

from __future__ import annotations

import functools
import json
import subprocess
from pathlib import Path

from fairlead.analysis.cost.kept_runs import key_of
from tests.hard.attempt import Attempt
from tests.hard.play import SCENES
from tests.hard.registry import Row

HERE = Path(__file__).parent
DECIDES = ("src", "components", "models", "tests/hard/cases", "tests/hard/play.py", "tests/hard/invariants.py")
"""Folders and files of the project that decide what comes of a row."""


class Kept:
    """Attempts by row; one of another commit, or whose content has changed since, is as good as none."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._lines: dict[tuple[str, str, str], Attempt] = {}
        if path.exists():
            for line in path.read_text(encoding="utf-8").splitlines():
                self._remember(Attempt(**json.loads(line)))

    def get(self, row: Row) -> Attempt | None:
        """The attempt at a row as it is now."""
        found = self._lines.get((row.case.name, row.engine, row.treatment))
        current = found is not None and (found.version, found.commit) == (version(row), commit())
        return found if current else None

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


@functools.cache
def commit() -> str:
    """The last commit that changed what decides a row; with `-changed` when files differ from it.

    A commit of pages or of other tests alone leaves it as it is. `unknown` outside a git checkout.
    """
    found = _git("log", "-1", "--format=%h", "--", *DECIDES)
    return (found + "-changed" * bool(_git("status", "--porcelain", "--", *DECIDES))) or "unknown"


def _git(*words: str) -> str:
    try:
        done = subprocess.run(["git", *words], cwd=HERE.parents[1], capture_output=True, text=True, check=False)
    except OSError:
        return ""
    return done.stdout.strip()
