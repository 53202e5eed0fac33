"""Which directories a new run may use, and what it removes from them.

    claimed = Claim.take(path, force)      holds the lock of the directory; what is replaced is in `earlier` by now
    claimed.clear()                        after run.json is that of the new run: files of the old one go
    claimed.release(finished)              at its end: what was replaced goes, if the run has finished

A process that is killed at any instant leaves the old results in the directory itself or in the folder `earlier` below
it (see `kept.py`), or the new ones. What a run has not written stays where it is; where it has the name of a file that
a run writes, it is in `earlier` in the end.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import fairlead.results.kept as kept
import fairlead.results.run_file as run_file
from fairlead.errors import UsageError, shown
from fairlead.results.lock import LOCK_FILE, Held, Lock
from fairlead.results.store import SERIES_FILE

FINISHED = "finished"
BROKEN_OFF = (run_file.KILLED, "failed")
"""They may have left no row, and then there is nothing to lose."""
WAY_OUT = "Choose another directory (--out, in Python out=), or replace it (--force, in Python force=True)."
END_IT = "End that process, or choose another directory (--out, in Python out=)."


class Claim:
    """A directory that this process alone writes a run into."""

    def __init__(self, path: Path, lock: Lock) -> None:
        self.path = path
        self._lock = lock

    @classmethod
    def take(cls, path: Path, force: bool) -> Claim:
        """Make `path` ready for a new run. Raises UsageError when that would lose something, OSError from the disk."""
        if path.exists() and not path.is_dir():
            raise UsageError(f"{path} is a file, not a directory.\n    Choose another place for the results.")
        if not force:
            _refuse_what_would_be_lost(path, ours=False)
        path.mkdir(parents=True, exist_ok=True)
        try:
            claim = cls(path, Lock.take(path))
        except Held:
            raise UsageError(_told_held(path)) from None
        try:
            if not force:
                _refuse_what_would_be_lost(path, ours=claim.locked)  # by now another process may have begun and ended
            kept.remove_parts(path)
            if _worth_keeping(path, ours=claim.locked):
                kept.set_aside(path)
        except BaseException:
            claim.release(finished=False)
            raise
        return claim

    @property
    def locked(self) -> bool:
        """False where the filesystem has no locks, so that the process id has to do."""
        return self._lock.supported

    def clear(self) -> None:
        """Remove the files of the run before; run.json is that of the new one already."""
        for file in kept.files_of_run(self.path):
            if file.name != run_file.RUN_FILE:
                file.unlink(missing_ok=True)

    def release(self, *, finished: bool) -> None:
        """Let the directory go; a run that has finished has replaced the earlier one for good."""
        if finished:
            kept.drop(self.path)
        self._lock.release()


def _worth_keeping(path: Path, *, ours: bool) -> bool:
    """Return whether what is to be replaced is kept until the new run has finished; of several the last that finished.

    Files of that name beside a run.json that is not ours, or cannot be read, may be somebody else's: they are kept.
    """
    record = run_file.read(path)
    if record is None:
        return bool(kept.files_of_run(path))
    status = run_file.status(path, record, ours)
    if status == run_file.RUNNING or record.get("status") == run_file.CLAIMED or not (path / SERIES_FILE).exists():
        return False
    return kept.earlier(path) is None or status == FINISHED


def _refuse_what_would_be_lost(path: Path, *, ours: bool) -> None:
    record = run_file.read(path)
    if record is None:
        if path.is_dir() and any(file.name != LOCK_FILE for file in path.iterdir()):
            raise UsageError(f"{path} is not empty and holds no run of fairlead that can be read.\n    {WAY_OUT}")
        return
    status = run_file.status(path, record, ours)
    if status == run_file.RUNNING:
        raise UsageError(_told_running(path, record))
    if status not in BROKEN_OFF or (path / SERIES_FILE).exists() or kept.earlier(path) is not None:
        raise UsageError(f"{path} holds a run that {_told(status, record)}.\n    {WAY_OUT}")


def _told_running(path: Path, record: Mapping[str, Any]) -> str:
    what = f"{path} is being written by process {record.get('process')}"
    if record.get("locked") and run_file.is_here(record):
        return f"{what}.\n    {END_IT}"
    if run_file.is_here(record):
        return f"{what}, or there is another process of that number by now.\n    {WAY_OUT}"
    return f"{what} of {shown(record.get('host'))}, unless that has ended: it cannot be seen from here.\n    {WAY_OUT}"


def _told_held(path: Path) -> str:
    record = run_file.read(path) or {}
    who = f"process {record['process']}" if record.get("process") else "another process"
    return (
        f"{path} is being written by {who}, which --force (in Python force=True) does not replace.\n    {END_IT}"
    )


def _told(status: str, record: Mapping[str, Any]) -> str:
    """How it ended, and when; of a killed one that is not known."""
    if status == run_file.KILLED:
        return f"was begun at {shown(record.get('started') or 'an unknown time')} and killed"
    when = shown(record.get("ended") or record.get("started") or "an unknown time")
    known = {"budget": "was stopped by a budget", "failed": "failed"}
    return f"{known.get(status, f'was {shown(status)}')} at {when}"
