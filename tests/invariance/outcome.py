"""What came out of a run, as plain numbers, and in what two runs of one scene differ."""

from __future__ import annotations

import itertools
import pathlib
import pickle
from collections import defaultdict
from dataclasses import dataclass
from typing import Any

import numpy as np

MEASURED = ("time", "wall", "seconds")
"""Counters with these words in their names are times of the clock."""

STEPS = 0.02
"""Share by which counts of steps may differ when the order of sums does."""

LITTLE = 1e-9
"""Of whatever unit: where all is less, nothing moves."""

INSTANT = 2e-6
"""Of the span: two of the dwells for which a contact that toggles is kept in its zone. Shorter stays do not count."""

SHARE = 0.1
"""Of the accuracy: what the order of sums may change of a signal."""


@dataclass(frozen=True)
class Outcome:
    """One run: how it ended, recorded rows (k,) and values (k, signals), zone changes, counters."""

    status: str
    t: np.ndarray
    side: np.ndarray
    names: tuple[str, ...]
    units: tuple[str, ...]
    values: np.ndarray
    events: tuple[tuple[float, str, str, str, str], ...]
    counters: dict[str, int]

    def renamed(self, back: Any) -> Outcome:
        """The same with `back` applied to every name."""
        events = tuple((t, back(who), *rest) for t, who, *rest in self.events)
        return Outcome(self.status, self.t, self.side, tuple(map(back, self.names)), self.units, self.values,
                       events, self.counters)  # fmt: skip

    @property
    def order(self) -> np.ndarray:
        """Columns in the alphabetical order of their names."""
        return np.argsort(np.array(self.names))


def of_result(result: Any) -> Outcome:
    """What a finished run has written."""
    names = tuple(signal.name for signal in result.signals)
    values = result.columns()  # all at once: one by one takes minutes of a long line
    counters = {
        name: count for name, count in result.run["counters"].items()
        if isinstance(count, int) and not any(word in name for word in MEASURED)
    }  # fmt: skip
    return Outcome(result.status, result.t, result.side, names, tuple(result.unit(name) for name in names), values,
                   tuple(tuple(event) for event in result.events), counters)  # fmt: skip


def read(file: pathlib.Path) -> Outcome:
    """An outcome that a worker has kept."""
    return Outcome(**pickle.loads(file.read_bytes()))  # written by a worker of ours


def write(file: pathlib.Path, outcome: Outcome) -> None:
    """Keep an outcome."""
    file.write_bytes(pickle.dumps(vars(outcome)))


def unlike(one: Outcome, other: Outcome) -> list[str]:
    """In what two runs differ that should be equal bit by bit: rows, values, zone changes, counters."""
    said = []
    if one.status != other.status:
        said.append(f"{one.status} or {other.status}")
    if [e[1:] for e in one.events] != [e[1:] for e in other.events]:
        said.append(f"zone changes: {first_difference(one.events, other.events)}")
    elif one.events != other.events:
        said.append(f"times of zone changes by {max(abs(a[0] - b[0]) for a, b in zip(one.events, other.events)):.2g} s")
    if one.t.tobytes() != other.t.tobytes() or one.side.tobytes() != other.side.tobytes():
        said.append(f"recorded rows: {len(one.t)} or {len(other.t)}")
    elif sorted(one.names) != sorted(other.names):
        said.append("names of signals")
    elif one.values[:, one.order].tobytes() != other.values[:, other.order].tobytes():
        said.append(f"values by up to {worst(one, other)[0]:.2g} of the largest of their unit ({worst(one, other)[1]})")
    counts = [f"{name} {one.counters[name]} or {other.counters.get(name)}" for name in one.counters
              if one.counters[name] != other.counters.get(name)]  # fmt: skip
    return said + ([f"counters: {', '.join(counts)}"] if counts else [])


def first_difference(one: Any, other: Any) -> str:
    """The first zone change in which two lists differ."""
    for k, (a, b) in enumerate(zip(one, other)):
        if a[1:] != b[1:]:
            return f"number {k} is {a[1]} {a[2]} -> {a[3]} at {a[0]:.9g} s or {b[1]} {b[2]} -> {b[3]} at {b[0]:.9g} s"
    return f"{len(one)} or {len(other)}"


def sequences(outcome: Outcome) -> dict[str, list[tuple[float, str]]]:
    """The zones in which each contact spends time, and when it enters them.

    Where several zones are tried at one instant until none changes any more, the last counts.
    """
    found: dict[str, list[tuple[float, str]]] = defaultdict(list)
    instant = INSTANT * float(outcome.t[-1] - outcome.t[0])
    for t, who, before, after, _ in outcome.events:
        entered = found[who] or [(-np.inf, before)]
        if t - entered[-1][0] <= instant:
            entered.pop()
        found[who] = entered if entered and entered[-1][1] == after else [*entered, (t, after)]
    return {who: entered for who, entered in found.items() if len(entered) > 1}


def worst(one: Outcome, other: Outcome) -> tuple[float, str]:
    """The largest difference of a signal over the largest value of its unit, and which signal it is."""
    apart, _ = _differences(one, other)
    if not apart.size:
        return 0.0, ""
    most = apart.max(axis=0)
    return float(most.max()), str(np.array(one.names)[one.order][most.argmax()])


def _differences(one: Outcome, other: Outcome) -> tuple[np.ndarray, np.ndarray]:
    """By row and signal (k, signals), over the largest value of the unit; and the times of the rows.

    Rows at events stand at times of their own; a row of the grid has one time in both.
    """
    grid = np.intersect1d(one.t[one.side == 0], other.t[other.side == 0])
    if not len(grid) or not one.names:
        return np.zeros((0, 0)), grid
    units = np.array(one.units)[one.order]
    a, b = (x.values[np.searchsorted(x.t, grid)][:, x.order] for x in (one, other))
    sizes = {unit: np.abs(a[:, units == unit]).max() for unit in set(units)}
    size = np.array([max(sizes[unit], LITTLE) for unit in units])
    return np.nan_to_num(np.abs(a - b) / size), grid


def apart(one: Outcome, other: Outcome, accuracy: float) -> list[str]:
    """In what two runs differ more than the order of sums explains.

    Each contact goes through the same zones, at times within the accuracy of the span; counts of steps are within 2 %,
    or two steps; signals are within a tenth of the accuracy.
    """
    said = []
    a, b = sequences(one), sequences(other)
    for who in sorted(a.keys() | b.keys()):
        zones, others = ([zone for _, zone in found.get(who, [])] for found in (a, b))
        if zones != others:
            said.append(f"{who} goes through {len(zones)} or {len(others)} zones, or other ones")
    for name in ("steps", "partial_steps"):
        x, y = one.counters.get(name, 0), other.counters.get(name, 0)
        if abs(x - y) > max(2, STEPS * max(x, y)):
            said.append(f"{name} {x} or {y}")
    size, where = worst(one, other)
    if size > SHARE * accuracy:
        said.append(f"{where} by {size:.2g} of the largest of its unit, at accuracy {accuracy:g}")
    times = ((x, y) for who in a if not said for (x, _), (y, _) in zip(a[who][1:], b[who][1:]))
    late = max((abs(x - y) for x, y in times), default=0.0)
    return said + ([f"zone changes by {late:.2g} s"] if late > accuracy * one.t[-1] else [])


def parted(one: Outcome, other: Outcome, accuracy: float) -> float:
    """When two runs first differ by more than the bounds: a signal, a zone, or the time of a zone change [s]."""
    first = np.inf
    size, t = _differences(one, other)
    if len(t) and (size > SHARE * accuracy).any():
        first = float(t[(size > SHARE * accuracy).any(axis=1).argmax()])
    a, b = sequences(one), sequences(other)
    late = accuracy * one.t[-1]
    for who in a.keys() | b.keys():
        mine, theirs = a.get(who, [])[1:], b.get(who, [])[1:]
        for x, y in itertools.zip_longest(mine, theirs, fillvalue=(np.inf, "")):
            if x[1] != y[1] or abs(x[0] - y[0]) > late:
                first = min(first, x[0], y[0])
                break
    return first


def until(outcome: Outcome, t: float) -> Outcome:
    """What was recorded before t; counters are of the whole run and left out."""
    rows = outcome.t < t
    events = tuple(event for event in outcome.events if event[0] < t)
    return Outcome(outcome.status, outcome.t[rows], outcome.side[rows], outcome.names, outcome.units,
                   outcome.values[rows], events, {})  # fmt: skip
