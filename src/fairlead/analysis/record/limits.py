"""Limits of a netlist: which recorded signals leave the range they were given.

    limits: {"line.hose[*].tension": {above: -160 N}}       the signal must stay above -160 N
"""

from __future__ import annotations

import contextlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.record.extremes import Extremes
from fairlead.analysis.record.suggestion import suggest
from fairlead.errors import Fault, ModelError, did_you_mean, listing, shown
from fairlead.netlist.limits import MOST_FAULTS
from fairlead.netlist.netlist import Value
from fairlead.patterns import picked
from fairlead.quantities import QuantityError, si
from fairlead.system.arrays.recording import OutputSignal

SENSES = {"above": -1.0, "below": +1.0}


@dataclass
class Limit:
    """One bound on some recorded columns: sense * (value - bound) must not become positive."""

    text: str
    columns: NDArray[np.int64]
    names: Sequence[str]
    sense: float
    bound: float
    unit: str
    pattern: str = ""
    worst: float = -np.inf
    nearest: tuple[str, float, float] | None = None  # (signal, value, t) of the worst

    @property
    def broken(self) -> str:
        """The worst in a sentence, if it broke the limit."""
        if self.nearest is None or self.worst <= 0:
            return ""
        name, value, t = self.nearest
        return f"{name} = {value:.6g} {self.unit} at t = {t:.6g} s, allowed: {self.text}"

    def take(self, extremes: Extremes) -> None:
        """Take the extremes of all recorded signals."""
        highest = self.sense > 0
        values = (extremes.highest if highest else extremes.lowest)[self.columns]
        times = (extremes.t_highest if highest else extremes.t_lowest)[self.columns]
        beyond = self.sense * (values - self.bound)
        j = int(beyond.argmax())
        if np.isfinite(beyond[j]):
            self.worst = float(beyond[j])
            self.nearest = self.names[j], float(values[j]), float(times[j])


@dataclass
class Limits:
    """All limits of a run."""

    limits: list[Limit] = field(default_factory=list)

    def take(self, extremes: Extremes) -> None:
        """Take the extremes of all recorded signals, at the end of a run."""
        for limit in self.limits:
            limit.take(extremes)

    def plain(self) -> list[dict[str, object]]:
        """As `run.json` keeps them, with what came nearest so far, so that `fairlead margins` can tell it."""
        names = ("signal", "sense", "bound", "unit", "text", "nearest")
        told = ((one.pattern, one.sense, one.bound, one.unit, one.text, one.nearest) for one in self.limits)
        return [dict(zip(names, each, strict=True)) for each in told]

    def broken(self) -> list[str]:
        """A sentence for every limit that was broken, at its worst."""
        return [limit.broken for limit in self.limits if limit.broken]


def read_limits(given: Mapping[str, Value], recorded: Sequence[OutputSignal]) -> Limits:
    """Bind the limits of a netlist to recorded columns. Raises ModelError."""
    found, faults = Limits(), list[Fault]()
    column = {signal.name: k for k, signal in enumerate(recorded)}
    for pattern, value in given.items():
        if len(faults) > MOST_FAULTS:
            break
        bounded = [recorded[column[name]] for name in picked(column, pattern)]
        if fault := _unfit(pattern, value, bounded, recorded):
            faults.append(fault)
            continue
        columns = np.array([column[one.name] for one in bounded])
        before = len(found.limits)
        for word, bound in value.entries.items():
            number = _bound(pattern, word, bound, bounded[0].unit)
            if isinstance(number, Fault):
                faults.append(number)
                continue
            text, names = f"{word} {bound.plain()}", [one.name for one in bounded]
            found.limits.append(Limit(text, columns, names, SENSES[word], number, bounded[0].unit, pattern=pattern))
        faults += _empty(pattern, value, found.limits[before:])
    if faults:
        raise ModelError(faults)
    return found


def _unfit(
    pattern: str, value: Value, bounded: Sequence[OutputSignal], recorded: Sequence[OutputSignal]
) -> Fault | None:
    """Why an entry limits nothing: no such signal, signals of several units, or no bound."""
    if not bounded:
        near, way_out = suggest(pattern, [signal.name for signal in recorded])
        return Fault(value.named_at, f"limits.{pattern}: no signal has this name. {near}".rstrip(), way_out)
    by_unit = {one.unit: one.name for one in reversed(bounded)}
    if len(by_unit) > 1:
        signals = listing([f"{name} [{unit}]" for unit, name in by_unit.items()])
        return Fault(value.named_at, f"limits.{pattern} means signals of several units: {signals}",
                     "Write an entry for each unit.")  # fmt: skip
    if not value.entries:
        given = "" if value.content is None else f" = {shown(value.plain())}"
        sample = _sample(value, bounded[0].unit)
        side = "above" if sample.startswith("-") else "below"  # a bound below zero is more often the least
        way_out = f"Write it as {{{side}: {sample}}}, with above, below or both."
        return Fault(value.where, f"limits.{pattern}{given} has no bound: a limit is above or below", way_out)
    return None


def _empty(pattern: str, value: Value, limits: Sequence[Limit]) -> list[Fault]:
    """An entry whose bounds leave nothing between them."""
    by_word = {one.text.split()[0]: one for one in limits}
    if len(by_word) < len(SENSES) or by_word["above"].bound < by_word["below"].bound:
        return []
    what = f"limits.{pattern} allows nothing: {by_word['above'].text} and {by_word['below'].text}"
    return [Fault(value.where, what, "Swap the two numbers, or give each its own: above is the lower one.")]


def _sample(value: Value, unit: str) -> str:
    """What was given, where it is a value of the signal; else a value that would be."""
    given = value.content
    if isinstance(given, str | int | float) and not isinstance(given, bool):
        with contextlib.suppress(QuantityError):
            si(given, unit)
            return str(given)
    return f"1 {unit}"


def _bound(pattern: str, word: str, bound: Value, unit: str) -> float | Fault:
    if word not in SENSES:
        what = f"limits.{pattern}.{word}: a limit is above or below. {did_you_mean(word, SENSES)}"
        return Fault(bound.named_at, what.rstrip(), f"Write {listing(SENSES)}.")
    try:
        return si(bound.plain(), unit)
    except QuantityError as error:
        return Fault(bound.where, f"limits.{pattern}.{word} = {error.what}.", error.allowed)
