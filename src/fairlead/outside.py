"""A run that is stepped from outside: by a controller of one's own, a master of a co-simulation, a test bench.

    run = model.start()
    run.set("reference", 0.5)
    run.advance(0.01)
    run.get("force")
    state = run.save()
    run.restore(state)

A communication point is a time event: the step before ends on it exactly. Inputs are held between two of them; what is
set takes effect where the run is, and zones settle anew on it. What rests is not left out meanwhile.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Collection, Iterable, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from fairlead.analysis.record.suggestion import suggest
from fairlead.errors import Fault, Location, ModelError, SteppingError, UsageError, did_you_mean, listing, shown
from fairlead.integrate.codes import TRY
from fairlead.integrate.engines import engine_of
from fairlead.integrate.memory.arena import Memory
from fairlead.integrate.prepare import NEVER_LOOK
from fairlead.integrate.problem import Block
from fairlead.integrate.run import check
from fairlead.integrate.sentences import culprits_of, sentence_of
from fairlead.integrate.underway import Saved, Underway
from fairlead.netlist.interface import Outer
from fairlead.quantities import QuantityError, si
from fairlead.run import engine_settings, failure_of, named_change, refused
from fairlead.system.compiled.asking import call
from fairlead.system.compiled.opened import FreeInput, free_inputs, opened
from fairlead.system.compiled.system import EVERYTHING

if TYPE_CHECKING:
    from fairlead.netlist.netlist import Netlist
    from fairlead.netlist.settings import RunSettings
    from fairlead.system.compiled.system import Instance, System

NO_GRID = 1e300
"""A grid of rows with nothing but its first point: rows are read by `get`."""


class Change(NamedTuple):
    """A zone change."""

    t: float
    component: str
    before: str
    after: str
    guard: str


class State(NamedTuple):
    """Where a run was, for `Stepping.restore`."""

    saved: Saved
    of: System


class Stepping:
    """A run that is advanced, set and read from outside. `Model.start` makes it; it stands settled at its start."""

    def __init__(self, netlist: Netlist, settings: RunSettings, system: System, inputs: Iterable[str]) -> None:
        """Begin; nothing is evaluated yet. Raises ModelError for inputs and outputs that do not exist."""
        self.changes: list[Change] = []
        """Zone changes in the last `advance`, in order."""
        self._of = system
        recorded = [signal.name for signal in system.recording(EVERYTHING).recorded]
        self._inputs, faults = _inputs(netlist, system, inputs)
        self._columns, more = _outputs(netlist, recorded)
        if faults + more:
            raise ModelError(faults + more)
        self.outputs = tuple(netlist.interface.outputs)
        """Names of outputs of the `interface` block; every other signal can be read as well."""
        if (fault := refused(settings, system)) is not None:
            raise UsageError(f"{fault.what} {fault.way_out}")
        asked = engine_settings(netlist, settings, system, list(EVERYTHING))
        if why := engine_of(asked).not_saved:
            raise UsageError(f"{why}; a run that is stepped from outside takes rodas or stepping.")
        asked = dataclasses.replace(asked, every=NO_GRID, between=False)
        own = opened(system, [one for one, _ in self._inputs.values()])
        check(own, asked)
        self._going = Underway(own, asked, self._take)
        self._memory.number["narrow_at"] = NEVER_LOOK
        self._memory.number["samples"] = 1  # forces are those of the point, not of the step before it
        self._memory.spread()
        self._values: np.ndarray | None = None
        self._begun = False

    @property
    def t(self) -> float:
        """The time that the run has reached [s]."""
        return float(self._memory.number["t"])

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of what can be set."""
        return tuple(self._inputs)

    def set(self, name: str, value: float | str) -> None:
        """Set an input, from here on; a number in the unit outside (SI where none is given), or a text with its unit.

        Raises UsageError for a name that is no input, and for a value that does not fit.
        """
        if name not in self._inputs:
            near = did_you_mean(name, self._inputs) if isinstance(name, str) else ""
            known = f"Inputs are {listing(self._inputs)}." if self._inputs else "It has none: see docs/coupling.md."
            raise UsageError(f"set: there is no input {shown(str(name))}. {near} {known}".replace("  ", " "))
        unit = self._inputs[name][1]
        try:
            number = si(value, unit)
        except QuantityError as error:
            raise UsageError(f"set: {name} = {error.what}. {error.allowed}") from None
        if not math.isfinite(number):
            raise UsageError(f"set: {name} = {value} is not a finite number.")
        own = self._instance.memory
        own["set_values"][list(self._inputs).index(name)] = number
        own["set_due"][0] = 1

    def get(self, name: str) -> float:
        """A signal where the run is, in SI. Raises UsageError for a name that no signal has."""
        self._begin()
        if name not in self._columns:
            near, way_out = suggest(str(name), list(self._columns))
            raise UsageError(f"get: no signal has the name {shown(str(name))}. {near} {way_out}".rstrip())
        if self._values is None:
            self._values = np.zeros(self._instance.n_outputs)
            call(self._instance, "outputs", self.t, self._memory.array["y"], self._values)
        return float(self._values[self._columns[name]])

    def advance(self, t: float | str, *, until_change: bool = False) -> float:
        """Go on to `t` [s] and return the time reached: `t`, or with `until_change` that of a zone change before.

        The `stop` of the netlist is no end here. Raises SteppingError where the run fails; it stays where it got to.
        Raises UsageError for a time before that reached.
        """
        goal = self._time(t)
        self.changes = []
        self._begin()
        if goal == self.t:
            self._take_over()
            return goal
        number = self._memory.number
        if goal >= number["stop"]:  # the span is a scale of times, and its end no event
            number["stop"] = number["start"] + 2.0 * (goal - number["start"])
        self._values = None
        self._take_over()
        known = len(self.changes)
        while self.t < goal and not (until_change and len(self.changes) > known):
            self._step(goal)
        return self.t

    def save(self) -> State:
        """Where the run is, with what was set."""
        self._begin()
        return State(self._going.save(), self._of)

    def restore(self, state: State) -> None:
        """Go to where this run was, or another one of the same model. Raises UsageError for one of another model."""
        if not isinstance(state, State) or state.of is not self._of:
            raise UsageError("restore: this state is not of a run of this model. Take what `save` of such a run gave.")
        self._begun, self._values, self.changes = True, None, []
        self._going.restore(state.saved)

    @property
    def _memory(self) -> Memory:
        return self._going.scope.memory

    @property
    def _instance(self) -> Instance:
        return self._going.scope.problem  # type: ignore[return-value]

    def _time(self, t: float | str) -> float:
        try:
            goal = si(t, "s")
        except QuantityError as error:
            raise UsageError(f"advance: t = {error.what}. {error.allowed}") from None
        if not (math.isfinite(goal) and goal >= self.t):
            raise UsageError(f"advance: t = {goal:.9g} s is before {self.t:.9g} s, where the run is. Go on from there.")
        return goal

    def _begin(self) -> None:
        """Settle at the start, once; what is set before holds from the start."""
        if not self._begun:
            self._begun = True
            while self.t == self._memory.number["start"] and self._memory.number["phase"] != TRY:
                self._enter(0)
            self.changes = []

    def _take_over(self) -> None:
        """Settle on what was set."""
        while self._instance.memory["set_due"][0]:
            self._values = None
            self._step(self.t)
        while self._memory.number["phase"] != TRY:
            self._enter(0)

    def _step(self, goal: float) -> None:
        """One trial step that does not go beyond `goal`."""
        number = self._memory.number
        due = float(number["t_next"])
        number["t_next"] = min(due, goal)
        try:
            self._enter(1)
        finally:
            if number["t_next"] == goal and goal < due:
                number["t_next"] = due

    def _enter(self, attempts: int) -> None:
        self._going.go_on(attempts)
        if not self._going.served:
            raise SteppingError(*self._ended())

    def _ended(self) -> tuple[str, float]:
        """Why the run ended, and when."""
        scope, status = self._going.scope, self._going.status
        if said := failure_of(scope.problem, status, self.t):
            return said, self.t
        culprits = culprits_of(status, scope.memory, scope.problem)
        return sentence_of(status, scope.memory, scope.problem, self._going.run, culprits), self.t

    def _take(self, block: Block) -> None:
        self.changes += [Change(*named_change(self._of, row)) for row in block.events]

    def __repr__(self) -> str:
        return f"<Stepping at t = {self.t:.9g} s: inputs {listing(self._inputs) or 'none'}>"


def interface_faults(netlist: Netlist, system: System) -> list[Fault]:
    """Mistakes in the `interface` block: inputs that cannot be set, and outputs that nothing gives."""
    signals = [signal.name for signal in system.signals]
    return _inputs(netlist, system, ())[1] + _outputs(netlist, signals)[1]


def _place(netlist: Netlist, side: str, name: str) -> Location | None:
    """Where an entry of the `interface` block stands; of an argument of `Model.start`, that."""
    block = netlist.written.get("interface", {}).get(side)
    return block.entries[name].where if block is not None and name in block.entries else Location("Model.start")


def _inputs(
    netlist: Netlist, system: System, more: Iterable[str]
) -> tuple[dict[str, tuple[FreeInput, str]], list[Fault]]:
    """Inputs by outer name, with their units; and what is wrong with others."""
    free = {name: one for one in free_inputs(system) for name in one.names}
    given = netlist.interface.inputs | {name: Outer(of=name) for name in more}
    faults, found, taken = [], {}, dict[tuple[int, int, int], str]()
    for name, outer in given.items():
        what, place = f"interface.inputs.{name}", _place(netlist, "inputs", name)
        one = free.get(outer.of)
        if one is None:
            faults.append(Fault(place, *_not_free(what, outer.of, list(free), system)))
        elif one.place in taken:
            faults.append(Fault(place, f"{what}: {outer.of} is {taken[one.place]} already.", "Give it one name."))
        else:
            taken[one.place] = name
            unit = outer.unit or one.declared.unit
            try:
                si(f"1 {unit}", unit if one.declared.unit == "1" else one.declared.unit)
            except QuantityError as error:
                faults.append(Fault(place, f"{what}.unit: {error.what}.", error.allowed))
            found[name] = one, unit if one.declared.unit == "1" else one.declared.unit
    return found, faults


def _not_free(what: str, signal: str, free: Collection[str], system: System) -> tuple[str, str]:
    """What is wrong with a signal that is no free input, and the way out."""
    if any(str(ref) == signal for ref in system.flat.sources):
        return f"{what}: {signal} is connected to a signal already.", "Take the connection away, or set what feeds it."
    if not free:
        return f"{what}: this model has no input that is free.", "Add a SignalInput, and connect its signal."
    near = did_you_mean(signal, free)
    return f"{what}: {shown(signal)} is no input that is free. {near}".rstrip(), f"Free inputs are {listing(free)}."


def _outputs(netlist: Netlist, signals: Sequence[str]) -> tuple[dict[str, int], list[Fault]]:
    """Columns by all names that can be read; and what is wrong with outputs of the netlist."""
    faults, columns = [], {name: k for k, name in enumerate(signals)}
    found = dict(columns)
    for name, outer in netlist.interface.outputs.items():
        if outer.of in columns:
            found[name] = columns[outer.of]
            continue
        near, way_out = suggest(outer.of, signals)
        what = f"interface.outputs.{name}: no signal has the name {shown(outer.of)}. {near}".rstrip()
        faults.append(Fault(_place(netlist, "outputs", name), what, way_out))
    return found, faults
