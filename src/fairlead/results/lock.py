"""Who writes into a run directory: a lock held by the operating system, which dies with the process.

A process id tells little: it is given to another process some time after the first has ended. So the process that
writes a run holds a lock on the file `.writing` in its directory. It is gone when the process is, however it ended.

Some network filesystems have no locks, or locks that hold on one machine only. Where none can be had, `run.json` says
so, and the process id has to do. A lock that is free counts only on the machine (and since the boot) where the run was
begun; elsewhere nobody can tell, and the run counts as going on until `--force` replaces it.
"""

from __future__ import annotations

import contextlib
import os
import time as clock
from pathlib import Path

LOCK_FILE = ".writing"
PATIENCE = 30.0 if os.name != "nt" else 0.3
"""s; a reader that looks whether somebody writes has the lock for a moment, which lasts where the machine is busy."""


class Held(Exception):
    """Another process writes here."""


class Lock:
    """The lock of one run directory. `supported` is False where the filesystem has none."""

    def __init__(self, folder: Path, handle: int | None) -> None:
        self.folder = folder
        self._handle = handle

    @property
    def supported(self) -> bool:
        """False where the filesystem has no locks."""
        return self._handle is not None

    @classmethod
    def take(cls, folder: Path) -> Lock:
        """Take the lock of an existing folder. Raises Held, and OSError when the folder cannot be written to."""
        until = clock.monotonic() + PATIENCE
        while True:
            handle = _open(folder, os.O_RDWR | os.O_CREAT)
            try:
                taken = _lock(handle, shared=False)
            except OSError:
                os.close(handle)
                return cls(folder, None)
            if taken and _is(handle, folder):
                return cls(folder, handle)
            late = clock.monotonic() > until
            free = taken or (not late and _only_read(handle))
            os.close(handle)
            if not free:
                raise Held
            clock.sleep(0.02)

    def release(self) -> None:
        """Give the lock back and remove its file; a second call does nothing."""
        if self._handle is None:
            return
        with contextlib.suppress(OSError):  # Windows does not remove an open file
            (self.folder / LOCK_FILE).unlink()
        os.close(self._handle)
        with contextlib.suppress(OSError):
            if os.name == "nt":
                (self.folder / LOCK_FILE).unlink()
        self._handle = None

    def __del__(self) -> None:
        """A run that is forgotten writes no more."""
        if getattr(self, "_handle", None) is not None:
            os.close(self._handle)  # type: ignore[arg-type]


def held(folder: Path) -> bool | None:
    """Return whether a process holds the lock of a folder; None where that cannot be found out."""
    try:
        handle = _open(folder, os.O_RDONLY)
    except FileNotFoundError:
        return False
    except OSError:
        return None
    try:
        return not _lock(handle, shared=True)
    except OSError:
        return None
    finally:
        os.close(handle)


def _open(folder: Path, how: int) -> int:
    """Open the file of the lock itself; a link in its place is not followed."""
    file = folder / LOCK_FILE
    if how & os.O_CREAT and file.is_symlink():
        file.unlink()
    return os.open(file, how | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_CLOEXEC", 0), 0o666)


def _only_read(handle: int) -> bool:
    """Return whether those that keep us from a lock may be readers; where they can be told from writers, are."""
    return os.name == "nt" or _lock(handle, shared=True)


def _is(handle: int, folder: Path) -> bool:
    """Return whether the file is still the one of the folder: whoever held it before may have removed it."""
    try:
        here = (folder / LOCK_FILE).stat(follow_symlinks=False)
    except OSError:
        return False
    return os.path.samestat(os.fstat(handle), here)


if os.name == "nt":

    def _lock(handle: int, *, shared: bool) -> bool:
        """Lock without waiting; False when another process has it. Raises OSError where there are no locks."""
        import msvcrt

        try:
            msvcrt.locking(handle, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined,unused-ignore]
        except PermissionError:
            return False
        return True

else:

    def _lock(handle: int, *, shared: bool) -> bool:
        """Lock without waiting; False when another process has it. Raises OSError where there are no locks."""
        import fcntl

        try:
            fcntl.flock(handle, (fcntl.LOCK_SH if shared else fcntl.LOCK_EX) | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True
