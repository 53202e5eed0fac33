"""The file `run.json`: what was run, by which process, and how it went."""

from __future__ import annotations

import functools
import hashlib
import json
import math
import os
import platform
import uuid
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

import fairlead.results.lock as lock
from fairlead.errors import FairleadError, UsageError, shown
from fairlead.results.damage import DamagedResultsError, reading
from fairlead.results.placing import place

RUN_FILE = "run.json"
FORMAT = "fairlead-run-1"
CLAIMED = "claimed"
"""Status of a run whose directory may still hold series and events of the run before; readers are told `running`."""
RUNNING = "running"
KILLED = "killed"
MOST_BYTES = 2**26
GIVE = "Give a directory that a run has left, such as results/NAME."
IDENTITY = ("id", "started", "process", "host")
SEAL = "seal"
"""The last entry of the file: SHA-256 of all before it. Readers do not see it."""


def write(directory: Path, record: Mapping[str, Any]) -> dict[str, Any]:
    """Replace run.json in one go: a reader sees the old or the new one, never half of it. Gives what `load` would."""
    plain = as_read(record)
    text = _text(plain)
    place(directory / RUN_FILE, f'{text[:-2]},\n  "{SEAL}": "{_digest(text)}"\n}}\n')
    return plain


def _text(plain: Mapping[str, Any]) -> str:
    return json.dumps(plain, indent=2, ensure_ascii=False, allow_nan=False)


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def is_changed(directory: Path) -> bool:
    """True if somebody has changed run.json since a run wrote it; False if there is none, or none says what it was."""
    try:
        record = json.loads((directory / RUN_FILE).read_text(encoding="utf-8"))
        seal = record.pop(SEAL, None)
        return seal is not None and seal != _digest(_text(record))
    except (OSError, ValueError, RecursionError, AttributeError):
        return False


def amend(directory: Path, record: Mapping[str, Any]) -> None:
    """Write what has been added to a finished run, unless another run has taken its place. Raises UsageError."""
    refuse_another(directory, record)
    write(directory, record)


def read(directory: Path) -> dict[str, Any] | None:
    """Return run.json as a dict, or None when there is none that can be read."""
    try:
        return load(directory)
    except FairleadError:
        return None


def as_read(record: Mapping[str, Any]) -> dict[str, Any]:
    """Return what `read` would give of a record that `write` wrote."""
    plain: dict[str, Any] = _plain(record)
    return plain


def _instead_of(directory: Path) -> str:
    """What to give instead of what is no folder of a run."""
    usual = Path("results") / directory.name.removesuffix(".yaml")
    if (usual / RUN_FILE).is_file():
        return f"Did you mean {usual}?"
    run = " It is a netlist: run it first." if directory.suffix in (".yaml", ".yml") and directory.is_file() else ""
    return f"{GIVE}{run}"


def load(directory: Path) -> dict[str, Any]:
    """Return run.json as a dict. Raises UsageError when there is none, DamagedResultsError when it cannot be read."""
    file = directory / RUN_FILE
    try:
        size = file.stat().st_size
    except OSError:
        told = f"{directory} holds no run of fairlead: there is no {RUN_FILE} in it."
        raise UsageError(f"{told}\n    {_instead_of(directory)}") from None
    if size > MOST_BYTES:
        raise DamagedResultsError(file, f"the file has {size} bytes, more than any run leaves ({MOST_BYTES}).")
    with reading(file):
        try:
            record = json.loads(file.read_text(encoding="utf-8"))
        except RecursionError:
            raise DamagedResultsError(file, "its entries lie too deep in one another.") from None
    if not isinstance(record, dict):
        raise DamagedResultsError(file, "it does not hold the entries of a run.")
    from fairlead.results.run_schema import check_head

    check_head(file, record)
    record.pop(SEAL, None)
    return record


def refuse_another(directory: Path, record: Mapping[str, Any]) -> None:
    """Raise UsageError when the run in a directory is not, or not any more, the one of `record`."""
    now_there = read(directory)
    if now_there is None:
        raise UsageError(f"The run in {directory} is not there any more.\n    Run it again.")
    if any(now_there.get(key) != record.get(key) for key in IDENTITY):
        begun = shown(now_there.get("started") or "an unknown time")
        raise UsageError(
            f"The run in {directory} was replaced by another one, begun at {begun}.\n"
            "    To read the new one, open the directory again. Next time give each run a directory of its own\n"
            "    (--out, in Python out=), or keep it in memory (out=None)."
        )


class Watched:
    """The run.json of one run, looked at time and again; it is read only when the file is another one."""

    def __init__(self, directory: Path, record: Mapping[str, Any]) -> None:
        self._directory = directory
        self._record = {key: record.get(key) for key in IDENTITY}
        self._seen: tuple[int, ...] = ()

    def check(self) -> None:
        """Raise UsageError when another run has taken the place of this one."""
        seen = self._look()
        if not seen or seen != self._seen:
            if not self._is_ours():
                refuse_another(self._directory, self._record)
            self._seen = seen

    def _is_ours(self) -> bool:
        """Whether the file says so, whatever else it says."""
        try:
            found = json.loads((self._directory / RUN_FILE).read_bytes())
        except (OSError, ValueError, RecursionError):
            return False
        return isinstance(found, dict) and all(found.get(key) == own for key, own in self._record.items())

    def _look(self) -> tuple[int, ...]:
        try:
            found = (self._directory / RUN_FILE).stat()
        except OSError:
            return ()
        return found.st_dev, found.st_ino, found.st_size, found.st_mtime_ns


def stamp(locked: bool = False) -> dict[str, Any]:
    """Return what tells this run from others: format, start, and the process that writes it.

    `locked`: the process holds the lock of the directory (see `lock.py`).
    """
    who = {"process": os.getpid(), "host": platform.node(), "boot": _boot(), "locked": locked}
    return {"format": FORMAT, "id": uuid.uuid4().hex, "started": now(), **who}


def now() -> str:
    """Return the time of day, UTC, to the second."""
    return datetime.now(UTC).isoformat(timespec="seconds")


def status(directory: Path, record: Mapping[str, Any], ours: bool = False) -> str:
    """Return the status, `killed` when the process of a running run is gone. `ours`: we hold its lock."""
    written = str(record.get("status", KILLED))
    if written not in (CLAIMED, RUNNING):
        return written
    return RUNNING if _is_alive(directory, record, ours) else KILLED


def load_as_it_is(directory: Path) -> tuple[dict[str, Any], str]:
    """Return run.json and the status. Raises as `load`.

    A process writes its last word before it gives back the lock. So a run whose lock was found free was killed only if
    run.json says afterwards what it said before.
    """
    record = load(directory)
    while (found := status(directory, record)) == KILLED != record.get("status"):
        again = load(directory)
        if again == record:
            break
        record = again
    return record, found


def is_here(record: Mapping[str, Any]) -> bool:
    """Return whether a run was begun on this machine, where one can tell whether it goes on."""
    return record.get("host") == platform.node() or bool(_boot() and record.get("boot") == _boot())


def _is_alive(directory: Path, record: Mapping[str, Any], ours: bool) -> bool:
    """Return whether the writing process may still be there; of one on another machine nobody can tell."""
    held = None
    if record.get("locked"):
        held = False if ours else lock.held(directory)
    if held or not is_here(record):
        return True
    return _process_exists(record.get("process")) if held is None else False


def _process_exists(process: object) -> bool:
    """Return whether there is a process of that number, perhaps another one by now."""
    if not isinstance(process, int) or not 0 < process < 2**31:
        return False
    if os.name == "nt":  # Signal 0 would end the process there.
        return True
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        return True
    return True


@functools.cache
def _boot() -> str | None:
    """What tells this start of this machine from others, where the system says so."""
    try:
        return Path("/proc/sys/kernel/random/boot_id").read_text(encoding="ascii").strip()
    except (OSError, ValueError):
        return None


def _plain(value: Any) -> Any:
    """Return `value` as JSON knows it; NaN and infinity become null, which every reader accepts."""
    kind = type(value)
    if kind is float:  # most of a record are plain numbers
        return value if math.isfinite(value) else None
    if kind is int or kind is str or kind is bool or value is None:
        return value
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.tolist())
    if isinstance(value, list | tuple | set | frozenset):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value if value is None or isinstance(value, bool | int | str) else str(value)
