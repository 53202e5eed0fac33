"""Event mode of FMI 3.0 co-simulation, in the process of the FMU: discrete states, time events, and clocks.

One visit at the time t, with the FMU in event mode:

    1. clocks that are due are made active, and inputs are set
    2. output clocks are asked whether they tick, and outputs of active clocks are read
    3. updateDiscreteStates; 2 and 3 again as long as it wants an update; then it says when the next time event is
    4. clocks are asked for their next tick
"""

from __future__ import annotations

import ctypes
import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from fmpy.fmi3 import fmi3Float64, fmi3ValueReference

MOST_UPDATES = 1000
"""Event iterations of one instant; a model that settles needs a few."""
NOT_YET_KNOWN, UNCHANGED = 0, 1  # fmi3IntervalQualifier
Reach = Callable[[set[int]], None]


class Told(Exception):
    """What the FMU did wrong or asks for, in a sentence without its end."""


class Clock(NamedTuple):
    """A time-based clock, with interval and shift [s] where they are known before the start."""

    name: str
    reference: int
    timing: str
    interval: float | None
    shift: float

    @property
    def periodic(self) -> bool:
        """Whether its ticks have one distance."""
        return self.timing not in ("changing", "countdown")


@dataclass
class Agenda:
    """What is to come, and what has been counted; goes with the state of the FMU."""

    time_event: float | None = None
    first: dict[int, float] = field(default_factory=dict)  # tick of a periodic clock
    interval: dict[int, float] = field(default_factory=dict)
    done: dict[int, int] = field(default_factory=dict)  # ticks of a periodic clock so far
    due: dict[int, float] = field(default_factory=dict)  # next tick of a clock; none while it is not known
    counts: dict[int, int] = field(default_factory=dict)  # ticks of output clocks

    def next(self) -> float:
        """When the next time event or tick is; infinity for never."""
        return min([*self.due.values(), math.inf if self.time_event is None else self.time_event])

    def before(self, time: float) -> int | None:
        """A clock that ticks before `time`."""
        return next((one for one, due in self.due.items() if due < time), None)


class Events:
    """Visits to event mode, of an FMU that has one."""

    def __init__(
        self, fmu: Any, clocks: Iterable[list[Any]], watched: list[list[Any]], intervals: list[list[Any]]
    ) -> None:
        """Of an instance; `watched` are output clocks, `intervals` those that the netlist gives to clocks."""
        self.fmu, self.given = fmu, dict(intervals)
        self.watched: dict[int, set[int]] = {one: set(only_with) for one, only_with in watched}
        self.clocks = [Clock(*one) for one in clocks]

    def name(self, reference: int) -> str:
        """The clock behind a reference."""
        return next(clock.name for clock in self.clocks if clock.reference == reference)

    def initialise(self, begin: float) -> Agenda:
        """When clocks tick first, asked in initialisation mode. Raises Told."""
        agenda = Agenda(counts=dict.fromkeys(self.watched, 0))
        for clock in self.clocks:
            interval, shift = self.given.get(clock.reference, clock.interval), clock.shift
            if clock.reference in self.given:
                self.fmu.setIntervalDecimal(_references(clock), (fmi3Float64 * 1)(interval))
            if clock.interval is None:
                interval = self._asked(clock)
                shift = self._shift(clock) if clock.periodic else interval or 0.0
            if clock.periodic:
                assert interval is not None
                agenda.first[clock.reference], agenda.interval[clock.reference] = begin + shift, interval
                agenda.done[clock.reference] = 0
            if interval is not None:
                agenda.due[clock.reference] = begin + shift
        return agenda

    def visit(self, agenda: Agenda, at: float, late: float, triggered: set[int], give: Reach, take: Reach) -> None:
        """Handle what is due at `at` and up to `late` after it, and `triggered` clocks that tick. Raises Told."""
        timed = {reference for reference, due in agenda.due.items() if due <= at + late}
        active = timed | triggered
        if active:
            self.fmu.setClock(sorted(active), [True] * len(active))
        give(active)
        for _ in range(MOST_UPDATES):
            active = self._with_ticking(agenda, active)
            if active:
                take(active)
            again, end, _, _, defined, when = self.fmu.updateDiscreteStates()
            if end:
                raise Told(f"it asks to end the simulation at {at:.9g} s")
            agenda.time_event = when if defined else None
            active = set()
            if not again:
                break
        else:
            raise Told(f"its discrete states do not settle at {at:.9g} s in {MOST_UPDATES} updates")
        if defined and math.isnan(when):
            raise Told(f"it names nan as the time of its next event, at {at:.9g} s")
        self._reschedule(agenda, at, timed)

    def _with_ticking(self, agenda: Agenda, active: set[int]) -> set[int]:
        """Active clocks and output clocks that tick now; each is asked once, which also ends its tick.

        An output clock may itself be clocked, and is then asked only while one of those clocks is active.
        """
        left = dict(self.watched)
        while asked := [one for one, only_with in left.items() if not only_with or only_with & active]:
            ticking = {one for one, on in zip(asked, self.fmu.getClock(asked), strict=True) if on}
            for one in ticking:
                agenda.counts[one] += 1
            active = active | ticking
            left = {one: only_with for one, only_with in left.items() if one not in asked}
        return active

    def _reschedule(self, agenda: Agenda, at: float, ticked: set[int]) -> None:
        """Next ticks of clocks. Raises Told."""
        for clock in self.clocks:
            one = clock.reference
            if clock.periodic and one in ticked:
                agenda.done[one] += 1
                agenda.due[one] = agenda.first[one] + agenda.done[one] * agenda.interval[one]
            elif clock.timing == "countdown" or (clock.timing == "changing" and one in ticked):
                if one in ticked:
                    del agenda.due[one]
                interval = self._asked(clock, unless_unchanged=one in agenda.due)
                if interval is not None:
                    agenda.due[one] = at + interval

    def _asked(self, clock: Clock, *, unless_unchanged: bool = False) -> float | None:
        """The interval that the FMU gives; None where it knows none yet, or no other. Raises Told."""
        intervals, qualifiers = (fmi3Float64 * 1)(), (ctypes.c_int * 1)()
        self.fmu.getIntervalDecimal(_references(clock), intervals, qualifiers)
        if clock.timing == "countdown" and qualifiers[0] == NOT_YET_KNOWN:
            return None
        if unless_unchanged and qualifiers[0] == UNCHANGED:
            return None
        interval = float(intervals[0])
        if not math.isfinite(interval) or interval < 0 or (clock.periodic and interval == 0):
            raise Told(f"it gives the clock {clock.name} an interval of {interval:g} s")
        return interval

    def _shift(self, clock: Clock) -> float:
        """The time to the first tick that the FMU gives. Raises Told."""
        shifts = (fmi3Float64 * 1)()
        self.fmu.getShiftDecimal(_references(clock), shifts)
        if not math.isfinite(shifts[0]) or shifts[0] < 0:
            raise Told(f"it gives the clock {clock.name} a shift of {shifts[0]:g} s")
        return float(shifts[0])


def _references(clock: Clock) -> Any:
    return (fmi3ValueReference * 1)(clock.reference)
