"""Which directories a new run may use, and what it removes from them.

Results that are replaced with `force` are kept in the folder `earlier` below until the new run has finished: one that
is killed, fails or is interrupted does not cost them.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import fairlead.results.run_file as run_file
from fairlead.errors import UsageError
from fairlead.results.events import EVENT_FILE
from fairlead.results.store import SERIES_FILE, TEMPORARY

FINISHED = "finished"
REPLACEABLE = (run_file.KILLED, "failed")
OWN_FILES = (SERIES_FILE, TEMPORARY, EVENT_FILE, "report.html")
EARLIER = "earlier"
FIGURE_MARK = b"Software\0fairlead"
WAY_OUT = "Choose another directory with --out, or replace it with --force."


def claim(path: Path, force: bool) -> None:
    """Create `path`, or clear an earlier run from it; raise UsageError when that would lose something."""
    if path.exists() and not path.is_dir():
        raise UsageError(f"{path} is a file, not a directory.\n    Choose another place for the results.")
    if not force:
        _refuse_what_would_be_lost(path)
    path.mkdir(parents=True, exist_ok=True)
    _set_aside(path)
    for file in _own(path):
        file.unlink(missing_ok=True)


def earlier(path: Path) -> Path | None:
    """Where the results lie that a run in `path` was to replace, if it has not finished; a run directory itself."""
    kept = path / EARLIER
    return kept if run_file.read(kept) is not None else None


def drop_earlier(path: Path) -> None:
    """Remove the results that a run in `path` has replaced, now that it has finished."""
    kept = path / EARLIER
    if earlier(path) is None:
        return
    for file in [*_own(kept), kept / run_file.RUN_FILE]:
        file.unlink(missing_ok=True)
    if not any(kept.iterdir()):
        kept.rmdir()


def _set_aside(path: Path) -> None:
    """Keep what is to be replaced until the new run has finished; of several the last that finished."""
    record = run_file.read(path)
    status = None if record is None else run_file.status(record)
    if status is None or status in (*REPLACEABLE, run_file.RUNNING) or not (path / SERIES_FILE).exists():
        return
    if earlier(path) is not None and status != FINISHED:
        return
    drop_earlier(path)
    kept = path / EARLIER
    kept.mkdir(exist_ok=True)
    shutil.copyfile(path / run_file.RUN_FILE, kept / run_file.RUN_FILE)  # that of the new run will replace it
    for file in _own(path):
        if file.exists():
            file.replace(kept / file.name)


def _own(path: Path) -> list[Path]:
    """Files of a run that a new one removes; run.json is replaced."""
    return [path / name for name in OWN_FILES] + [png for png in path.glob("*.png") if _is_figure(png)]


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
