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
import time
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple, NoReturn

import numpy as np

from fairlead.analysis.record.ends import Ends, Limit
from fairlead.analysis.record.suggestion import suggest
from fairlead.analysis.record.unsettled import with_way_out
from fairlead.analysis.record.zone_changes import ZoneChanges
from fairlead.arguments import Arguments, keywords_told
from fairlead.engine import engine_settings, refused
from fairlead.errors import ModelError, NoCopyError, SteppingError, UsageError, did_you_mean, listing, shown
from fairlead.integrate.codes import TRY
from fairlead.integrate.engines import engine_of
from fairlead.integrate.memory.arena import Memory
from fairlead.integrate.prepare import NEVER_LOOK
from fairlead.integrate.problem import Block, Status
from fairlead.integrate.run import check
from fairlead.integrate.sentences import culprits_of, sentence_of
from fairlead.integrate.underway import Underway
from fairlead.outer import Read, find_inputs, find_outputs, set_already
from fairlead.quantities import QuantityError, computable, si
from fairlead.renamed import now_called
from fairlead.running import failed, failure_of, not_allowed, open_at
from fairlead.saved_state import Elsewhere, Maker, Standing, State, brought_back, fitting
from fairlead.system.compiled.asking import call
from fairlead.system.compiled.opened import opened
from fairlead.system.compiled.system import EVERYTHING
from fairlead.tuning import Tunable, differs, gone_on

if TYPE_CHECKING:
    from fairlead.integrate.engine import Engine
    from fairlead.netlist.netlist import Netlist
    from fairlead.netlist.settings import RunSettings
    from fairlead.system.compiled.system import Instance, System

NO_GRID = 1e300
"""A grid of rows with nothing but its first point: rows are read by `get`."""
NEAR_END = 1e-9
"""Share of the end of the span, or of the span, that no goal may be nearer to: a run lands on its end a bit early."""


class Change(NamedTuple):
    """A zone change."""

    t: float
    component: str
    before: str
    after: str
    guard: str


class Stepping:
    """A run that is advanced, set and read from outside. `Model.start` makes it; it stands settled at its start."""

    def __init__(self, netlist: Netlist, settings: RunSettings, system: System, inputs: Iterable[str],
                 record: Sequence[str] = EVERYTHING, tunable: Tunable | None = None) -> None:  # fmt: skip
        """Begin; nothing is evaluated yet. Raises ModelError for inputs and outputs that do not exist.

        What can be read: signals whose names fit a pattern in `record`.
        """
        self._inside = {} if tunable is None else tunable.inside
        self.tunable = tuple(self._inside)
        """Names of parameters that can be set."""
        self.changes: list[Change] = []
        """Zone changes in the last `advance`, in order."""
        self._of, self._named = system, ZoneChanges(system)
        recorded = system.recording(record).recorded
        self._ends = Ends.of(system, recorded)
        self._inputs, faults = find_inputs(netlist, system, inputs)
        self._columns, outputs, more = find_outputs(netlist, recorded)
        more += set_already(self._inputs, {} if tunable is None else tunable.inside)
        if faults + more:
            raise ModelError(faults + more)
        self.outputs = tuple(one.name for one in outputs)
        """Names of outputs of the `interface` block; every other signal can be read as well."""
        parameters = () if tunable is None else tunable.variables
        self.variables = (*(one.seen for one in self._inputs.values()), *outputs, *parameters)
        """Inputs, outputs and tunable parameters with unit, start value, nominal size and description."""
        if (fault := refused(settings, system) or not_allowed(system)) is not None:
            raise UsageError(f"{fault.what} {fault.way_out}")
        asked = engine_settings(netlist, settings, system, list(record))
        if why := engine_of(asked).not_saved:
            raise UsageError(f"{why}; a run that is stepped from outside takes rodas or stepping.")
        asked = dataclasses.replace(asked, every=NO_GRID, between=False)
        own = opened(system, [one.free for one in self._inputs.values()])
        check(own, asked)
        self._span = asked.stop - asked.start
        self._maker = Maker(system, asked, {name: one.free for name, one in self._inputs.items()}, tunable)
        self._now = self._next = Standing(Underway(own, asked, self._take), tunable, own)
        self._told(self._memory)
        self._values: np.ndarray | None = None
        self._begun = self._advanced = False
        for name, one in self._inputs.items():
            if one.seen.start is not None and one.seen.start != one.free.value:
                self.set(name, one.seen.start)

    @property
    def t(self) -> float:
        """The time that the run has reached [s]."""
        return float(self._memory.number["t"])

    @property
    def overruns(self) -> int:
        """With `real_time`: steps so far that met the bound on their work, or were taken again."""
        return int(self._memory.number["overruns"])

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of what can be set."""
        return tuple(self._inputs)

    def set(self, name: str, value: float | str) -> None:
        """Set an input or a tunable parameter, from here on; a number in SI, or a text with its unit.

        Raises UsageError for a name that is neither, and for a value that does not fit; ModelError for a parameter's.
        """
        if isinstance(name, str) and name in self.tunable:
            self._tune(name, value)
            return
        if not isinstance(name, str) or name not in self._inputs:
            near = did_you_mean(name, self._inputs)
            known = f"Inputs are {listing(self._inputs)}." if self._inputs else "The scene has none (`interface`)."
            of_start = f"A parameter is named at the start: model.start(tunable=[{shown(repr(name))}])."
            known += f" Tunable are {listing(self.tunable)}." if self.tunable else f" {of_start}"
            raise UsageError(f"set: there is no input {shown(str(name))}. {near} {known}".replace("  ", " "))
        try:
            number = computable(value, self._inputs[name].seen.unit)
        except QuantityError as error:
            raise UsageError(f"set: {name} = {error.what}. {error.allowed}") from None
        if not math.isfinite(number):
            raise UsageError(f"set: {name} = {value} is not a finite number.")
        own = self._instance.memory
        own["set_values"][list(self._inputs).index(name)] = number
        own["set_due"][0] = 1

    def _tune(self, name: str, value: float | str) -> None:
        """Have the model with another value of a parameter; the run goes over to it as it goes on."""
        assert self._next.tunable is not None, "there are none to set"
        changed = self._next.tunable.with_value(name, value, begun=self._advanced, t=self.t)
        self._begun = self._begun and self._advanced  # what was only read begins once more
        if self._begun and not differs(self._next.tunable.model.system, changed.model.system):
            self._next = self._next._replace(tunable=changed)  # a value that stays is no event
            return
        own = opened(changed.model.system, [one.free for one in self._inputs.values()])
        self._next = Standing(self._now.going, changed, own)

    def _go_over(self) -> None:
        """Go on with the values of parameters that were set."""
        if self._next.own is not self._now.own:
            going = gone_on(self._now.going, self._now.own, self._next.own, self.t, self._span, begun=self._begun)
            going.active.memory.number["overruns"] = self._memory.number["overruns"]
            self._now = self._next = self._next._replace(going=going)
            self._values = None
            self._told(self._memory)

    def _told(self, memory: Memory) -> None:
        """Tell a run that has just been made how it is used."""
        memory.number["restrict_at"] = NEVER_LOOK
        if not self._going.run.real_time:
            memory.number["samples"] = 1  # forces are those of the point, not of the step before it
        memory.spread()

    def get(self, name: str) -> float:
        """A signal where the run is, in SI. Raises UsageError for a name that no signal has."""
        self._begin()
        name = now_called(name, self._columns) or name if isinstance(name, str) else name
        if not isinstance(name, str):
            raise UsageError(f"get: name = {shown(name)} is not the name of a signal, which is a text; one at a time.")
        if name not in self._columns:
            near, way_out = suggest(str(name), list(self._columns))
            raise UsageError(f"get: no signal has the name {shown(str(name))}. {near} {way_out}".rstrip())
        values = self._recorded()
        take, columns = self._columns[name]
        return (max if take == "max" else min)(float(values[k]) for k in columns)

    def _recorded(self) -> np.ndarray:
        """What could be recorded where the run is."""
        if self._values is None:
            self._values = np.zeros(self._instance.n_outputs)
            call(self._instance, "outputs", self.t, self._memory.array["y"], self._values)
        return self._values

    @keywords_told
    def advance(self, t: float | str, *, until_change: bool = False) -> float:
        """Go on to `t` [s] and return the time reached: `t`, or with `until_change` that of a zone change before.

        The `stop` of the netlist is no end here. Raises SteppingError where the run fails; it stays where it got to.
        Raises UsageError for a time before that reached. `max_wall` bounds every call by itself: call again to go on.
        """
        if until_change is not True and until_change is not False:
            asked = Arguments("advance")
            asked.yes_or_no("until_change", until_change)
            asked.refuse()
        goal = self._time(t)
        self.changes = []
        self._go_over()
        self._begin()
        self._advanced = True
        if goal == self.t:
            self._take_over()
            return goal
        number = self._memory.number
        if goal >= number["stop"] - NEAR_END * max(abs(number["stop"]), number["stop"] - number["start"]):
            # the span is a scale of times, and its end no event
            number["stop"] = number["start"] + 2.0 * (goal - number["start"])
        self._values = None
        self._take_over()
        known, begun = len(self.changes), time.perf_counter()
        self._end_without_law()
        while self.t < goal and not (until_change and len(self.changes) > known):
            self._step(goal)
            self._end_without_law()
            if self.t < goal and self._late(begun):
                self._going.status = Status.MAX_WALL
                raise SteppingError(*self._ended())
        return self.t

    def standing(self) -> tuple[float, np.ndarray, Instance]:
        """Where the run is: time [s], a copy of the unknowns, and its equations with their zones."""
        self._begin()
        return self.t, self._memory.array["y"].copy(), self._instance

    def save(self) -> State:
        """Where the run is, with what was set."""
        self._begin()
        following = self._next._replace(going=self._going)
        return State(self.t, self._going.save(), self._maker, following, self._now)

    def restore(self, state: State | Elsewhere) -> None:
        """Go to where this run was, or another one of the same model with the same settings.

        A state that was pickled is taken too, where it was saved by the same fairlead. Raises UsageError for others.
        """
        if isinstance(state, Elsewhere):
            state = brought_back(state, self._maker, self._take)
        elif not isinstance(state, State):
            what = f"a {type(state).__name__}"
            raise UsageError(f"restore: {what} is not of a run of this model. Take what `save` of such a run gave.")
        fitting(state, self._maker)
        self._begun, self._values, self.changes = True, None, []
        self._advanced = True
        if state.now.own is not self._now.own:  # with other values of parameters
            self._now = state.now._replace(going=state.now.going.beside(self._take))
            self._told(self._memory)
        tunable = state.next.tunable and state.next.tunable._replace(inside=self._inside)
        self._next = state.next._replace(going=self._going, tunable=tunable)
        self._going.restore(state.saved)

    @property
    def _going(self) -> Underway:
        return self._now.going

    @property
    def _memory(self) -> Memory:
        return self._going.active.memory

    @property
    def _instance(self) -> Instance:
        return self._going.active.problem  # type: ignore[return-value]

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
            self._go_over()
            self._begun = True
            while self.t == self._memory.number["start"] and self._memory.number["phase"] != TRY:
                self._enter(0)
            self.changes = []

    def _late(self, begun: float) -> bool:
        """True beyond the budget of wall time, which every `advance` has to itself: between two the master works."""
        most = self._going.run.max_wall
        return most is not None and time.perf_counter() - begun > most

    def _take_over(self) -> None:
        """Settle on what was set."""
        self._settle()
        while self._instance.memory["set_due"][0]:
            self._values = None
            self._step(self.t)
        self._settle()

    def _settle(self) -> None:
        """Settle where the run is, if that is due: a settlement asks anew when the next time event is."""
        while self._memory.number["phase"] != TRY:
            self._enter(0)

    def _step(self, goal: float) -> None:
        """One trial step that does not go beyond `goal`, of a run that is settled."""
        number = self._memory.number
        due = float(number["t_next"])
        number["t_next"] = min(due, goal)
        try:
            self._enter(1)
        finally:
            if number["t_next"] == goal and goal < due:
                number["t_next"] = due

    def _end_without_law(self) -> None:
        """Raise SteppingError where no law says what follows."""
        if self._ends.any:
            self._values = None
            if said := self._ends.at(self.t, self._recorded()):
                raise SteppingError(said, self.t)

    def _enter(self, attempts: int) -> None:
        self._going.go_on(attempts)
        if not self._going.served or failed(self._instance):
            raise SteppingError(*self._ended())

    def _ended(self) -> tuple[str, float]:
        """Why the run ended, and when."""
        active, status = self._going.active, self._going.status
        if said := failure_of(active.problem, status, self.t):
            return said, self.t
        culprits = culprits_of(status, active.memory, active.problem)
        if said := open_at(active.problem, status, culprits, self.t):
            return said, self.t
        said = sentence_of(status, active.memory, active.problem, self._going.run, culprits)
        if status == Status.NOT_SETTLED:
            said = with_way_out(said, self._of, self._going.engine.name, culprits)
        return said, self.t

    def _take(self, block: Block) -> None:
        self.changes += [Change(*row) for row in self._named.of(block.events)]

    def __reduce_ex__(self, protocol: object) -> NoReturn:
        """A run is not copied: its memory is used by compiled code. Raises NoCopyError."""
        way_out = "Keep where it is: state = run.save(). A state pickles, and restore(state) of another run takes it."
        raise NoCopyError(f"A run that is stepped cannot be copied or pickled.\n    {way_out}")

    def __repr__(self) -> str:
        return f"<Stepping at t = {self.t:.9g} s: inputs {listing(self._inputs) or 'none'}>"


class LaidOpen(NamedTuple):
    """What a run is made of, for who makes a copy that goes on elsewhere (fmu/)."""

    memory: Memory
    problem: Instance
    engine: Engine
    columns: Mapping[str, Read]
    """Where among the recorded values a signal or an output is, by name."""
    limits: Sequence[Limit]
    """Of recorded values: where a run ends."""


def laid_open(run: Stepping) -> LaidOpen:
    """What a run is made of."""
    return LaidOpen(run._memory, run._instance, run._going.engine, run._columns, list(run._ends.limits()))
