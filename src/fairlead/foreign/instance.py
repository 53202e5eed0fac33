"""An FMU that is loaded, in the process of its own: brought from one communication point to the next.

A step ends at the communication point. If the FMU comes back early, or has a time event or the tick of a clock before
that point, it is brought there, its events are handled (events.py), and the step goes on from there. Events at the
point itself are handled with the inputs of that point.
"""

from __future__ import annotations

import copy
import zipfile
from dataclasses import dataclass, field
from typing import Any

from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

from fairlead.foreign.events import Agenda, Events, Told
from fairlead.foreign.groups import Calls, Named, grouped
from fairlead.foreign.underway import Underway

FLOATS = ("Real", "Float64", "Float32")
DISCARD, REACHED, TERMINATED = 2, 2, 3  # fmi2Status and fmi2StatusKind, FMI 2.0.4, sections 2.1.3 and 4.2.3
AT_ONE_TIME = 1e-9
"""Part of a communication step within which two times are one: far above what sums of steps round off."""
MOST_VISITS = 1000  # to event mode while time stands still
MOST_NUDGES = 6  # beyond a time event that the FMU does not see yet
SHORTEST = 2.0**-20  # of a communication step, that a step is cut to when the FMU discards it


@dataclass
class Where:
    """How far it is; goes with the state of the FMU."""

    at: float | None = None
    inputs: list[Any] = field(default_factory=list)
    outputs: list[Any] = field(default_factory=list)
    agenda: Agenda = field(default_factory=Agenda)


class ToldCalls:
    """An FMU of FMPy whose calls are told; FMPy knows the version by the name of the class."""

    underway: Underway | None = None

    def _call(self, name: str, *given: Any) -> Any:
        if self.underway is None:
            return super()._call(name, *given)  # type: ignore[misc]
        with self.underway.call(name):
            return super()._call(name, *given)  # type: ignore[misc]


class FMU2Told(ToldCalls, FMU2Slave):
    """Of version 2."""


class FMU3Told(ToldCalls, FMU3Slave):
    """Of version 3."""


class Instance:
    """An FMU of version 2 or 3 that is loaded; begins with the first step."""

    def __init__(self, asked: dict[str, Any], underway: Underway | None = None) -> None:
        """Unpack, load and instantiate it, and set what is to be set before the start; `underway` is told each call."""
        with zipfile.ZipFile(asked["file"]) as archive:
            archive.extractall(asked["folder"])  # it takes .. and leading slashes out of names
        self.version, self.splits = asked["version"], bool(asked["splits"])
        self.step_length, self.close = asked["period"], AT_ONE_TIME * asked["period"]
        given = {"guid": asked["token"], "unzipDirectory": asked["folder"], "modelIdentifier": asked["identifier"],
                 "instanceName": asked["name"]}  # fmt: skip
        self.states: dict[int, Any] = {}
        self.number = 0
        self.past = bool(asked["keeps_state"])  # it may be set back to a time before
        self.fmu: Any = (FMU2Told if self.version == 2 else FMU3Told)(**given)
        self.fmu.underway = underway
        with_events = {"eventModeUsed": bool(asked["events"]), "earlyReturnAllowed": self.splits}
        self.fmu.instantiate(**(with_events if self.version == 3 else {}))
        self.calls = Calls(self.fmu, self.version)
        self.inputs, self.outputs = grouped(asked["inputs"]), grouped(asked["outputs"])
        self.signals: dict[str, Named] = {side: asked[side] for side in ("inputs", "outputs")}
        self.where = Where(outputs=[None] * len(asked["outputs"]))
        self.events: Events | None = None
        if asked["events"]:
            self.events = Events(self.fmu, asked["clocks"], asked["watched"], asked.get("intervals", []))
        if structure := asked.get("structure"):
            self.fmu.enterConfigurationMode()
            for one in structure:
                self.calls.start(*one)
            self.fmu.exitConfigurationMode()
        for one in asked.get("starts", []):
            self.calls.start(*one)

    def step(self, to: float, inputs: list[Any]) -> dict[str, Any]:
        """Bring it to `to`, give it the inputs, and take its outputs. Raises Told."""
        where = self.where
        if where.at is None:
            self._start(to, inputs)
        else:
            pending = self._advance(where.at, to)
            changed = inputs != where.inputs
            risen = {reference for now, before, (kind, reference, *_) in
                     zip(inputs, where.inputs, self.signals["inputs"], strict=True)
                     if kind == "Clock" and now > before}  # fmt: skip
            where.inputs = inputs
            if self.events is None:
                self._give(set(), unclocked=True)
            elif pending or changed or self._due():
                self.fmu.enterEventMode()
                self._settle(risen, unclocked=True)
        self._take(set(), unclocked=True)
        return {"outputs": [self._number(number, value) for number, value in enumerate(where.outputs)]}

    def _start(self, begin: float, inputs: list[Any]) -> None:
        """Initialise at `begin`."""
        where = self.where
        where.at, where.inputs = begin, inputs
        if self.version == 2:
            self.fmu.setupExperiment(startTime=begin)
            self.fmu.enterInitializationMode()
        else:
            self.fmu.enterInitializationMode(startTime=begin)
        every = {clock for group in [*self.inputs, *self.outputs] for clock in group.clocks}
        self._give(every, unclocked=True)
        if self.events is not None:
            self._take(every, unclocked=False)
            where.agenda = self.events.initialise(begin)
        self.fmu.exitInitializationMode()
        if self.events is not None:
            self._settle(set(), unclocked=False)  # event mode is where initialisation ends

    def _advance(self, at: float, to: float) -> bool:
        """Go on from `at` to `to`, through all events before it. Returns whether there is one at `to`. Raises Told."""
        pending, visits = False, 0
        if not self.splits and (clock := self.where.agenda.before(to - self.close)) is not None:
            raise Told(f"its clock {self.events.name(clock) if self.events else clock} ticks at "
                       f"{self.where.agenda.due[clock]:.9g} s, between two communication points, and its steps have "
                       "one length. Give a period that fits")  # fmt: skip
        while to - at > self.close:
            goal = min(to, self.where.agenda.next()) if self.splits else to
            pending = self._do_step(at, to if to - goal <= self.close else goal)
            assert self.where.at is not None
            visits = 0 if self.where.at - at > self.close else visits + 1
            if visits > MOST_VISITS:
                raise Told(f"it comes back from doStep at {at:.9g} s again and again, without going on")
            at = self.where.at
            if to - at > self.close and self.events is not None and (pending or self._due()):
                self.fmu.enterEventMode()
                self._settle(set(), unclocked=False)
                at = self.where.at
        return pending

    def _due(self) -> bool:
        """Whether a time event or a tick is due."""
        assert self.where.at is not None
        return self.where.agenda.next() <= self.where.at + self.close

    def _settle(self, triggered: set[int], *, unclocked: bool) -> None:
        """Handle all that is due at this time, in event mode, which it is in, and leave that. Raises Told.

        An FMU may see its time event only a rounding error after the time that it named: then it is brought a little
        further, as the standard allows (FMI 3.0, nextEventTime); where no step may be split, up to the next point.
        """
        where = self.where
        assert where.at is not None
        named = self._visit(triggered, unclocked=unclocked)
        for again in range(MOST_VISITS):
            if not self._due():
                return
            if named is not None and where.agenda.time_event == named:
                if not self.splits:
                    return
                if again > MOST_NUDGES:
                    raise Told(f"it names {named:.9g} s as the time of its next event, and has none there")
                self._do_step(where.at, where.at + self.close * 2.0**again)
            self.fmu.enterEventMode()
            named = self._visit(set(), unclocked=False)
        raise Told(f"its events at {where.at:.9g} s do not come to an end")

    def _visit(self, triggered: set[int], *, unclocked: bool) -> float | None:
        """Visit event mode, which it is in, and leave it. Returns the time event it was due for. Raises Told."""
        where = self.where
        assert self.events is not None
        assert where.at is not None
        named = where.agenda.time_event
        due = named is not None and named <= where.at + self.close
        self.events.visit(
            where.agenda, where.at, self.close, triggered,
            lambda active: self._give(active, unclocked=unclocked), lambda active: self._take(active, unclocked=False),
        )  # fmt: skip
        self.fmu.enterStepMode()
        return named if due else None

    def _do_step(self, at: float, goal: float) -> bool:
        """One doStep, shorter where it is discarded. Returns whether the FMU has an event where it is. Raises Told."""
        step = goal - at
        while True:
            kept = self.fmu.getFMUState() if self.version == 2 and self.past and self.splits else None
            try:
                said = self.fmu.doStep(at, step, not self.past)
                break
            except FMICallException as error:
                if error.status != DISCARD:
                    raise
                step = self._shorter(at, step, kept)
            finally:
                if kept is not None:
                    self.fmu.freeFMUState(kept)
        event, end, early, reached = said or (False, False, False, 0.0)
        goal = at + step if step < goal - at else goal
        if end:
            raise Told(f"it asks to end the simulation at {reached if early else goal:.9g} s")
        if early and not self.splits:
            raise Told(f"it came back early, at {reached:.9g} s, and nobody allowed it")
        if early and not at - self.close <= reached <= goal + self.close:
            raise Told(f"it came back at {reached:.9g} s from a step from {at:.9g} s to {goal:.9g} s")
        self.where.at = reached if early else goal
        return bool(event)

    def _shorter(self, at: float, step: float, kept: Any) -> float:
        """The length to try after a step was discarded. Raises Told where there is none."""
        shorter = step / 2
        if self.version == 2:
            reached = self._status(self.fmu.getRealStatus, REACHED)
            inside = reached is not None and self.close < reached - at < step - self.close
            if self._status(self.fmu.getBooleanStatus, TERMINATED):
                ended = reached if inside else at + step
                raise Told(f"it asks to end the simulation at {ended:.9g} s")
            if kept is None:
                why = "its state cannot be kept" if self.splits else "its steps have one length"
                raise Told(f"it discards the step from {at:.9g} s to {at + step:.9g} s, and {why}, so it does no "
                           "shorter one. Give another period")  # fmt: skip
            self.fmu.setFMUState(kept)
            shorter = reached - at if inside else shorter
        if shorter < SHORTEST * self.step_length or not self.splits:
            raise Told(f"it discards the step from {at:.9g} s to {at + step:.9g} s. Look at its inputs, or give "
                       "another period")  # fmt: skip
        return shorter

    def _status(self, call: Any, what: int) -> Any:
        """What an FMU of version 2 says of a step that it discarded; None where it cannot."""
        try:
            return call(what)
        except FMICallException:
            return None

    def _give(self, active: set[int], *, unclocked: bool) -> None:
        """Set inputs of active clocks, and those that have none."""
        for group in self.inputs:
            if group.clocks & active or (unclocked and not group.clocks):
                group.give(self.calls, self.where.inputs)

    def _take(self, active: set[int], *, unclocked: bool) -> None:
        """Get outputs of active clocks, and those that have none; the number of ticks is always there."""
        where = self.where
        for group in self.outputs:
            if group.clocks & active or (unclocked and not group.clocks):
                group.take(self.calls, where.outputs)
        for number, (kind, reference, *_) in enumerate(self.signals["outputs"]):
            if kind == "Clock":
                where.outputs[number] = where.agenda.counts.get(reference, 0)

    def _number(self, number: int, value: Any) -> float:
        """An output as a signal. Raises Told where that has other digits."""
        found, kind = float(value), self.signals["outputs"][number][0]
        if kind not in FLOATS and int(found) != int(value):
            raise Told(f"a {kind} output is {value}, which no signal holds exactly")
        return found

    def save(self) -> dict[str, Any]:
        """Keep where it is, under a number."""
        self.number += 1
        self.states[self.number] = self.fmu.getFMUState(), copy.deepcopy(self.where)
        return {"token": self.number}

    def load(self, token: int) -> dict[str, Any]:
        """Go to where it was."""
        state, where = self.states[token]
        self.fmu.setFMUState(state)
        self.where = copy.deepcopy(where)
        return {}

    def free(self, token: int) -> dict[str, Any]:
        """Forget where it was."""
        self.fmu.freeFMUState(self.states.pop(token)[0])
        return {}
