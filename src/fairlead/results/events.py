"""The file `events.csv`: every zone change of a run, in order."""

from __future__ import annotations

import csv
import io
import math
import re
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from fairlead.errors import shown
from fairlead.results.damage import DamagedResultsError, reading
from fairlead.results.placing import create

EVENT_FILE = "events.csv"
PIECE = re.compile(r"\w+ \d+")
"""Zones that are the pieces of a table (`curvature 3`, `force 1`): innards, not what a reader looks for."""
HEADER = ("t [s]", "component", "from", "to", "guard")


class Event(NamedTuple):
    """One zone change: time [s], component, zone before, zone after, and the guard that fired."""

    t: float
    component: str
    zone_from: str
    zone_to: str
    guard: str


AT_ONCE = 1e-8
"""Share of a run within which a change and the way back count as none: no motion of the scene is that fast."""


def lasting(events: Iterable[Event], span: float) -> list[Event]:
    """The changes that last, of a run of `span` [s]: without zones that a part leaves again at once.

    At an instant a contact may go through several zones until one fits; a dwell that ends may do the same. Of those the
    last one counts, at the time of the first, and none where it is the one from before.
    """
    kept = dict[str, list[Event]]()
    for event in events:
        known = kept.setdefault(event.component, [])
        first = event
        while known and event.t - known[-1].t <= AT_ONCE * span:
            first = known.pop()
        if event.zone_to != first.zone_from:
            known.append(first._replace(zone_to=event.zone_to, guard=event.guard))
    return sorted((one for each in kept.values() for one in each), key=lambda one: one.t)


class EventWriter:
    """Appends events to a new `events.csv`; only whole lines ever reach the file."""

    def __init__(self, path: Path) -> None:
        self._file = create(path)
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
        """Flush and close the file, if that is not done."""
        if not self._file.closed:
            self.flush()
            self._file.close()


def read_events(path: Path) -> list[Event]:
    """Return the events of a file; a last line that a kill cut short is left out.

    Raises DamagedResultsError, which names the line, for a file that no run has written.
    """
    with reading(path):
        text = path.read_bytes().decode("utf-8")
        lines = csv.reader(io.StringIO(text[: text.rfind("\n") + 1], newline=""), strict=True)
        if next(lines, None) != list(HEADER):
            raise DamagedResultsError(path, f"line 1: it is not the head of a file of events, {','.join(HEADER)}.")
        events: list[Event] = []
        try:
            for row in lines:
                events.append(_event(path, lines.line_num, row))
        except csv.Error as error:
            raise DamagedResultsError(path, f"line {lines.line_num}: {error}.") from error
    return events


def _event(path: Path, line: int, row: list[str]) -> Event:
    """Return one line as an event."""
    if len(row) != len(HEADER):
        raise DamagedResultsError(path, f"line {line} has {len(row)} columns; there are {len(HEADER)} of them.")
    try:
        t = float(row[0])
    except ValueError:
        raise DamagedResultsError(path, f"line {line}: the time {shown(row[0])} is no number.") from None
    if not math.isfinite(t):
        raise DamagedResultsError(path, f"line {line}: {shown(row[0])} is no time.")
    return Event(t, *row[1:])
