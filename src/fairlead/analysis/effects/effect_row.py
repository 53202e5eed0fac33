"""One switch of a scene, judged: how large the system is with it, what it saves and changes, and a sentence."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from fairlead.analysis.cost.choice import percent
from fairlead.analysis.cost.deviation import OutputError
from fairlead.analysis.cost.timed_run import Timed
from fairlead.analysis.effects.changes import MEASURES, Change, Floors, Worst, worst_of
from fairlead.analysis.effects.switches import Switch

NEGLIGIBLE, NOTICEABLE = 1e-3, 1e-2  # relative change: can be left out, must be kept
WORTH = 0.1  # share of the time that is worth a change of the model


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
        return cls(system.n, len(system.pattern.rows), len(system.zones), system.n_guards, len(system.blocks))


@dataclass(frozen=True)
class Row:
    """One switch: the system and the run with it, and how far they are from the scene as it is.

    `changes` are those after the start, `starting` those in it; `floors` what the error of the runs may be.
    """

    switch: Switch
    timed: Timed
    size: Size | None = None
    saved: float | None = None  # share of the time
    changes: Sequence[Change] = ()
    floors: Floors = field(default_factory=dict)
    starting: Sequence[Change] = ()
    floors_starting: Floors = field(default_factory=dict)
    begin: float = 0.0  # s, where the start ends

    @property
    def worst(self) -> Worst | None:
        """The worst of end, rms and peak of all outputs after the start; None when nothing changes."""
        found = worst_of(self.changes, self.floors)
        return found if found is not None and found.value > 0 else None

    @property
    def worst_starting(self) -> Worst | None:
        """The same in the start, where that is more than after it."""
        found = worst_of(self.starting, self.floors_starting)
        return found if found is not None and found.value > (self.change or 0.0) else None

    @property
    def most(self) -> OutputError | None:
        """The output that changes most, in its unit; None when none does."""
        return self.worst.change.error if self.worst is not None else None

    @property
    def change(self) -> float | None:
        """Relative change of that output; None when it was not measured."""
        if not self.timed.finished:
            return None
        return self.worst.value if self.worst is not None else 0.0

    @property
    def measurable(self) -> bool:
        """Whether the time is another one by more than it scatters."""
        return self.saved is not None and abs(self.saved) > self.timed.scatter

    @property
    def gain(self) -> float:
        """Time saved for each part of change; what lines are sorted by."""
        if self.change is None or self.saved is None:
            return -math.inf
        return (self.saved if self.measurable else 0.0) / max(self.change, 1e-9)

    @property
    def sentence(self) -> str:
        """The advice."""
        if self.change is None:
            return f"{self.switch.label}: {self.timed.reason or self.timed.status}"
        return f"{self.switch.label}: {self._facts()}{self._verdict()}"

    def _facts(self) -> str:
        assert self.change is not None
        assert self.saved is not None
        what = "changes no output by more than the error of the run itself"
        if self.worst is not None:
            what = f"changes {_told(self.worst)}"
        what += self._in_the_start()
        if not self.measurable:
            return f"{what} and takes the same time; "
        return f"{what} and {'saves' if self.saved >= 0 else 'costs'} {100 * abs(self.saved):.0f} % of the time; "

    def _in_the_start(self) -> str:
        """What it changes before that, where it is more and can be noticed."""
        found = self.worst_starting
        if found is None or found.value <= NOTICEABLE:
            return ""
        return f" (before t = {self.begin:g} s {_told(found)})"

    def _verdict(self) -> str:
        assert self.change is not None
        assert self.saved is not None
        settings = " ".join(f"--set {name}={value}" for name, value in self.switch.settings.items())
        if self.change > NOTICEABLE:
            has = {"on": "leaves it out", "off": "has it"}.get(self.switch.then, f"has {self.switch.now}")
            return f"it matters, and the scene {has}."
        if self.saved <= WORTH or not self.measurable:
            return "not worth a change."
        if self._in_the_start():
            return f"worth it where the start does not count: {settings}"
        if self.change <= NEGLIGIBLE:
            return f"worth it: {settings}"
        return f"worth it where that is exact enough: {settings}"


def _told(found: Worst) -> str:
    return f"{found.change.name} by {percent(found.value)} {MEASURES[found.measure]}"
