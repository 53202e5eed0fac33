"""Which directories a new run may use, and what it removes from them."""

from __future__ import annotations

from pathlib import Path

import fairlead.results.run_file as run_file
from fairlead.errors import UsageError
from fairlead.results.events import EVENT_FILE
from fairlead.results.store import SERIES_FILE, TEMPORARY

REPLACEABLE = (run_file.KILLED, "failed")
OWN_FILES = (SERIES_FILE, TEMPORARY, EVENT_FILE, "report.html")
FIGURE_MARK = b"Software\0fairlead"
WAY_OUT = "Choose another directory with --out, or replace it with --force."


def claim(path: Path, force: bool) -> None:
    """Create `path`, or clear an earlier run from it; raise UsageError when that would lose something."""
    if path.exists() and not path.is_dir():
        raise UsageError(f"{path} is a file, not a directory.\n    Choose another place for the results.")
    if not force:
        _refuse_what_would_be_lost(path)
    path.mkdir(parents=True, exist_ok=True)
    for file in [path / name for name in OWN_FILES] + [png for png in path.glob("*.png") if _is_figure(png)]:
        file.unlink(missing_ok=True)


def _refuse_what_would_be_lost(path: Path) -> None:
    record = run_file.read(path)
    if record is None:
        if path.is_dir() and any(path.iterdir()):
            raise UsageError(f"{path} is not empty and holds no run of fairlead.\n    {WAY_OUT}")
        return
    status = run_file.status(record)
    if status == run_file.RUNNING:
        raise UsageError(f"{path} is being written by process {record.get('process')}.\n    {WAY_OUT}")
    if status not in REPLACEABLE:
        when = record.get("ended", record.get("started", ""))
        raise UsageError(f"{path} holds a run that was {_told(status)} at {when}.\n    {WAY_OUT}")


def _told(status: str) -> str:
    return {"budget": "stopped by a budget"}.get(status, status)


def _is_figure(png: Path) -> bool:
    """Return whether fairlead drew this picture; a user's own picture stays."""
    with png.open("rb") as file:
        return FIGURE_MARK in file.read(1024)
