"""The file `events.csv`: every zone change of a run, in order."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

EVENT_FILE = "events.csv"
HEADER = ("t [s]", "component", "from", "to", "guard")


class Event(NamedTuple):
    """One zone change: time [s], component, zone before, zone after, and the guard that fired."""

    t: float
    component: str
    zone_from: str
    zone_to: str
    guard: str


class EventWriter:
    """Appends events to a new `events.csv`; only whole lines ever reach the file."""

    def __init__(self, path: Path) -> None:
        self._file = path.open("wb")
        self._lines = io.StringIO(newline="")
        self._csv = csv.writer(self._lines, lineterminator="\n")
        self._csv.writerow(HEADER)
        self.flush()

    def append(self, events: Iterable[Event]) -> None:
        """Add events; they wait in memory for `flush`."""
        self._csv.writerows((repr(float(event.t)), *event[1:]) for event in events)

    def flush(self) -> None:
        """Write what waits, in one go."""
        waiting = self._lines.getvalue()
        if waiting:
            self._file.write(waiting.encode())
            self._file.flush()
            self._lines.seek(0)
            self._lines.truncate()

    def close(self) -> None:
        """Flush and close the file."""
        self.flush()
        self._file.close()


def read_events(path: Path) -> list[Event]:
    """Return the events of a file; a last line that a kill cut short is left out."""
    if not path.exists():
        return []
    with path.open(encoding="utf-8", newline="") as file:
        text = file.read()
    whole = text[: text.rfind("\n") + 1]
    rows = list(csv.reader(io.StringIO(whole, newline="")))[1:]
    return [Event(float(row[0]), *row[1:]) for row in rows]
