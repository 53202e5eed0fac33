"""What each effect of a scene costs and what it changes: every one switched by itself, and all of them off.

    found = effects(load)
    found.rows[0].change, found.rows[0].saved

`change` is how far the outputs go, rms over time relative to their range (`deviation.py`), the worst one counting;
`peak` is the relative change of its largest magnitude. A change below the floor, which is what a run at a tenth of
the accuracy changes, is no change. `saved` is the share of the stepping time that the switch saves, negative when it
costs more. Lines are sorted by what is gained for what is lost: the cheapest simplification first.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fairlead.analysis.choice import percent
from fairlead.analysis.cost import outputs
from fairlead.analysis.deviation import OutputError, output_errors, worst
from fairlead.analysis.kept_runs import KeptRuns, key_of
from fairlead.analysis.switches import Switch, all_off, switches
from fairlead.analysis.timed_run import Load, Timed, timed_run
from fairlead.errors import FairleadError

SHARE = 0.1  # of the budget that the scene as it is may take; a longer one is looked at over less time
SHORTEST = 0.2  # s; with less time left no run is begun
NEGLIGIBLE, NOTICEABLE = 1e-3, 1e-2  # relative change: can be left out, must be kept
WORTH = 0.1  # share of the time that is worth a change of the model
FINER = 0.1  # accuracy of the run that tells the floor
Note = Callable[[str], None]


@dataclass(frozen=True)
class Size:
    """How large a compiled system is."""

    unknowns: int
    entries: int  # in the pattern of df/dy: terms of the equations
    zones: int  # machines that switch
    guards: int
    kernels: int

    @classmethod
    def of(cls, system: Any) -> Size:
        """Count a System. Each unknown has one equation."""
        return cls(
            system.n, len(system.pattern.rows), len(system.zones), len(system.guard_tolerance), len(system.blocks)
        )


@dataclass(frozen=True)
class Row:
    """One switch: the system and the run with it, and how far they are from the scene as it is."""

    switch: Switch
    timed: Timed
    size: Size | None = None
    saved: float | None = None
    errors: list[OutputError] = field(default_factory=list)
    peak: float | None = None  # of the output that changes most
    floor: float = 0.0

    @property
    def most(self) -> OutputError | None:
        """The output that changes most; None when none does."""
        found = worst(self.errors)
        return found if found is not None and found.rms > 0 else None

    @property
    def change(self) -> float | None:
        """Relative change of that output; None when it was not measured."""
        if not self.timed.finished:
            return None
        return self.most.relative if self.most is not None else 0.0

    @property
    def gain(self) -> float:
        """Time saved for each part of change; what lines are sorted by."""
        if self.change is None or self.saved is None:
            return -math.inf
        return self.saved / max(self.change, self.floor, 1e-9)

    @property
    def sentence(self) -> str:
        """The advice."""
        if self.change is None:
            return f"{self.switch.label}: {self.timed.reason or self.timed.status}"
        return f"{self.switch.label}: {self._facts()}{self._verdict()}"

    def _facts(self) -> str:
        assert self.change is not None
        assert self.saved is not None
        what = f"changes {self.most.name} by {percent(self.change)}" if self.most is not None else "changes nothing"
        if self.most is not None and self.peak is not None:
            what += f" (its peak by {percent(self.peak)})"
        if self.change <= self.floor:
            what = f"changes no output by more than the error of the run itself, {percent(self.floor)},"
        return f"{what} and {'saves' if self.saved >= 0 else 'costs'} {100 * abs(self.saved):.0f} % of the time; "

    def _verdict(self) -> str:
        assert self.change is not None
        assert self.saved is not None
        settings = " ".join(f"--set {name}={value}" for name, value in self.switch.settings.items())
        if self.change > max(NOTICEABLE, self.floor):
            return "it matters: a change of what is modelled."
        if self.saved > WORTH and self.change <= max(NEGLIGIBLE, self.floor):
            return f"worth it: {settings}"
        return "not worth a change." if self.saved <= WORTH else f"worth it where that is exact enough: {settings}"


@dataclass
class Effects:
    """All switches of a scene. `left_out` names those that the budget or Ctrl-C did not let begin."""

    name: str
    span: tuple[float, float]
    whole: bool
    base: Timed
    size: Size
    floor: float
    rows: list[Row] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)
    interrupted: bool = False


def effects(
    load: Load, *, budget: float = 60.0, signals: Sequence[str] = ("*",), kept: KeptRuns | None = None,
    libraries: Iterable[str] = (), note: Note | None = None,
) -> Effects:  # fmt: skip
    """Switch all that a scene can switch, within `budget` seconds.

    Raises ModelError, UsageError for a wrong scene or pattern, NumericalError when the scene as it is does not run.
    """
    from fairlead.errors import NumericalError

    model = load({})
    names, units, _ = outputs(model, signals)
    runner = _Runner(load, kept or KeptRuns(None), model.netlist.digest, tuple(libraries), names)
    run = model.netlist.run
    span, whole = (run.start, run.stop), True
    note = note or (lambda _: None)
    note("the scene as it is")
    base = runner.run({}, span, SHARE * budget)
    end = time.perf_counter() + budget  # loading and compiling are not counted
    if base.status == "budget" and base.reached > run.start:
        span = (run.start, run.start + float(f"{0.9 * (base.reached - run.start):.1g}"))
        base, whole = runner.run({}, span, budget), False
    if not base.finished:
        raise NumericalError(f"{model.netlist.name} itself does not run: {base.reason or base.status}")
    found = Effects(model.netlist.name, span, whole, base, Size.of(model.system), 0.0)
    try:
        tight = runner.run({"run.accuracy": f"{max(FINER * run.accuracy, 1e-12):g}"}, span, budget)
        if tight.finished:
            off = worst(output_errors(names, units, base.values, tight.values))
            found.floor = off.relative if off is not None else 0.0
        for switch in _ordered(model):
            if end - time.perf_counter() < SHORTEST:
                found.left_out.append(switch.label)
                continue
            note(switch.label)
            before = runner.loading
            timed = runner.run(switch.settings, span, end - time.perf_counter())
            end += runner.loading - before
            found.rows.append(_row(load, switch, timed, found, names, units))
    except KeyboardInterrupt:
        found.interrupted = True
    found.rows.sort(key=lambda row: -row.gain)
    return found


def _ordered(model: Any) -> Iterator[Switch]:
    every = switches(model)
    yield from every
    together = all_off(every)
    if together is not None:
        yield together


def _row(load: Load, switch: Switch, timed: Timed, found: Effects, names: list[str], units: list[str]) -> Row:
    try:
        size = Size.of(load(switch.settings).system)
    except FairleadError:
        return Row(switch, timed)
    if not timed.finished:
        return Row(switch, timed, size)
    errors = output_errors(names, units, timed.values, found.base.values)
    most, peak = worst(errors), None
    if most is not None and most.rms > 0:
        column = names.index(most.name)
        mine, theirs = (float(np.abs(values[:, column]).max()) for values in (timed.values, found.base.values))
        peak = abs(mine - theirs) / max(mine, theirs)
    saved = 1 - timed.cpu / found.base.cpu if found.base.cpu > 0 else 0.0
    return Row(switch, timed, size, saved, errors, peak, found.floor)


@dataclass
class _Runner:
    """Runs with settings, or takes them from those kept."""

    load: Load
    kept: KeptRuns
    digest: str
    libraries: tuple[str, ...]
    names: list[str]
    loading: float = 0.0  # s spent on loading or compiling kernels

    def run(self, settings: Any, span: tuple[float, float], cap: float) -> Timed:
        key = key_of(self.digest, ("effects", sorted(settings.items()), self.names, span), self.libraries)
        timed = self.kept.get(key, cap)  # a run cut off at less than `cap` is made again
        if timed is None:
            begun = time.perf_counter()
            timed_run(self.load, {**settings, "run.max_steps": "1"}, [], span, cap)  # loads or compiles
            self.loading += time.perf_counter() - begun
            timed = timed_run(self.load, settings, self.names, span, cap)
            self.kept.put(key, timed)
        return timed
