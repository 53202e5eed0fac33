"""Limits of a run: what the run itself kept of them, or its results, when it was killed before it could tell."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from fairlead.analysis.record.recorded_line import numbers
from fairlead.patterns import matcher
from fairlead.results import Result
from fairlead.results.plateau import first_row
from fairlead.results.run_file import RUN_FILE
from fairlead.results.run_schema import limits


@dataclass(frozen=True)
class Judged:
    """A limit and the value that came nearest to it, or went furthest beyond."""

    signal: str
    text: str
    unit: str
    bound: float
    value: float
    t: float
    broken: bool


def judged(result: Result) -> list[Judged]:
    """All limits of the netlist that the run was made with. Raises DamagedResultsError."""
    kept = limits(result.named(RUN_FILE), result.run)
    return [found for limit in kept if (found := _judge(result, limit)) is not None]


def _judge(result: Result, limit: dict[str, Any]) -> Judged | None:
    if limit.get("nearest"):  # by the run, which saw what happened between recorded rows
        name, value, t = limit["nearest"]
        broken = limit["sense"] * (value - limit["bound"]) > 0
        return Judged(name, limit["text"], limit["unit"], limit["bound"], value, t, broken)
    names = [*filter(matcher(limit["signal"]), (signal.name for signal in result.signals))]
    if not names or not len(result.t):
        return None
    values = numbers(result, names)
    beyond = limit["sense"] * (values - limit["bound"])
    _, k = np.unravel_index(int(beyond.argmax()), beyond.shape)
    row = first_row(beyond[:, k], least=False)
    value = float(values[row, k])
    broken = bool(beyond[row, k] > 0)
    return Judged(names[k], limit["text"], limit["unit"], limit["bound"], value, float(result.t[row]), broken)
