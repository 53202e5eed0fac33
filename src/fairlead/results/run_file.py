"""The file `run.json`: what was run, by which process, and how it went."""

from __future__ import annotations

import json
import math
import os
import platform
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import numpy as np

RUN_FILE = "run.json"
FORMAT = "fairlead-run-1"
RUNNING = "running"
KILLED = "killed"


def write(directory: Path, record: Mapping[str, Any]) -> None:
    """Replace run.json in one go: a reader sees the old or the new one, never half of it."""
    text = json.dumps(_plain(record), indent=2, ensure_ascii=False, allow_nan=False)
    temporary = directory / f".{RUN_FILE}.{os.getpid()}"
    temporary.write_text(text + "\n", encoding="utf-8")
    temporary.replace(directory / RUN_FILE)


def read(directory: Path) -> dict[str, Any] | None:
    """Return run.json as a dict, or None when there is none that can be read."""
    try:
        record = json.loads((directory / RUN_FILE).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None
    return record if isinstance(record, dict) and record.get("format") == FORMAT else None


def as_read(record: Mapping[str, Any]) -> dict[str, Any]:
    """Return what `read` would give of a record that `write` wrote."""
    plain: dict[str, Any] = _plain(record)
    return plain


def stamp() -> dict[str, Any]:
    """Return what tells this run from others: format, start, and the process that writes it."""
    return {"format": FORMAT, "started": now(), "process": os.getpid(), "host": platform.node()}


def now() -> str:
    """Return the time of day, UTC, to the second."""
    return datetime.now(UTC).isoformat(timespec="seconds")


def status(record: Mapping[str, Any]) -> str:
    """Return the status, `killed` when the process of a running run is gone."""
    written = str(record.get("status", KILLED))
    return KILLED if written == RUNNING and not _is_alive(record) else written


def _is_alive(record: Mapping[str, Any]) -> bool:
    """Return whether the writing process may still be there; on another host nobody can tell."""
    if record.get("host") != platform.node():
        return True
    process = record.get("process")
    if not isinstance(process, int) or process <= 0:
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


def _plain(value: Any) -> Any:
    """Return `value` as JSON knows it; NaN and infinity become null, which every reader accepts."""
    if isinstance(value, Mapping):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return _plain(value.tolist())
    if isinstance(value, list | tuple | set | frozenset):
        return [_plain(item) for item in value]
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    return value if value is None or isinstance(value, bool | int | str) else str(value)
