"""What the loop works on: the whole problem, or the part of it that moves.

A problem that can say what is at rest (`subsystem`, facts.py) is cut down to what moves, with a margin, when that is
much less. The whole is reactivated when a contact at the boundary of the part lets go. Steps, switches and error
control are those of the whole, for what rests has no error. When to look goes by steps counted, never by a clock, so
that two runs do the same.
"""

from __future__ import annotations

import ctypes
from typing import Any, NamedTuple

import numpy as np

from fairlead.integrate.codes import SETTLE_WHOLE, TRY
from fairlead.integrate.counters import COUNTS
from fairlead.integrate.engines import engine_of
from fairlead.integrate.memory.arena import Memory, State
from fairlead.integrate.prepare import NEVER_LOOK, new_plan, planned, prepare
from fairlead.integrate.problem import EVENT, Bytes, Instance, Problem, Run
from fairlead.integrate.rodas.tableau import Tableau

LEAST = 400
"""Unknowns of a problem that is worth looking at."""
LOOK_COST, LOOK_BASE = 30_000, 5
"""A cut costs as much as so many steps of a problem of one unknown, and so many of its own."""
MOST = 0.5
"""Share of the unknowns that a part may have; more is not worth it."""
MARGIN = 12
"""Equations between what moves and the boundary of the first part."""
WORTH = 4
"""A part that served for as many steps as this many cuts cost was worth it."""
FEWER, SURELY_FEWER = 0.6, 0.85
"""A part is cut anew when that leaves this share of it; and where what is left out can only come back over the
boundary."""
WAIT_AGAIN = 2
"""Steps of the whole after the boundary of such a part has changed, if it had been worth it."""
FILL = ctypes.CFUNCTYPE(None, ctypes.c_int64, ctypes.c_void_p)
BLOCKED = 1e300

CARRIED = (
    "phase", "crossed", "inconsistent_start", "judged", "landing", "retried", "reinitialised", "quadratures_off",
    "grid_next", "stalls", "total_events", "stop_asked", "failed", "localising", "locates", "damps", "always_locates",
    "locates_for", "support_accelerates", "t", "h", "h_wanted", "h_next",
    "error", "last_error",
    "cut_at", "dropped", "most_moved", "t_piece", "t_land", "t_next", "t_row", "t_release", "t_last_switch",
    "theta_raise", "gap", "gap_before", "t_cut", "t_kink", "growth", "t_growth", "swing_step", "allowed",
    "allowed_before", "block_steps", "trying", "over", "overrun_how", "overrun_at", "t_overrun",
    *COUNTS,
)  # fmt: skip
"""Single values that say where a run is; what else there is belongs to a problem, or is made anew in every step."""
BY_UNKNOWN = ("y", "holds", "rested", "rejections_by_unknown", "lost", "not_given_back", "joined", "first_joined")
SLOPES = ("slope", "curvature", "mean_slope", "slope_before", "slope_earlier", "mean_before")
BY_GUARD = ("g", "g_before", "g_end", "continuous")
BY_MACHINE = (
    "zones", "last_toggle", "held_for", "blocked_until", "streak", "chatters", "switches_by_machine",
    "released", "released_by",
)  # fmt: skip


OWN = ("_pause", "_margin", "_since", "_seen", "_switched")
"""What an ActiveSubsystem itself knows of a run."""


class SavedPart(NamedTuple):
    """The part a run worked on, and where it was."""

    part: Any
    memory: Memory
    state: State
    remembered: Any


class SubsystemState(NamedTuple):
    """Where a run was: the whole, the part in force, and what the looks at it have shown."""

    whole: State
    remembered: Any
    part: SavedPart | None
    own: dict[str, Any]
    looked: Any


class ActiveSubsystem:
    """The problem and the memory the loop works on, and the whole that they stand for."""

    def __init__(self, problem: Problem, run: Run, tableau: Tableau) -> None:
        """Begin with the whole."""
        self._run, self._tableau, self._engine = run, tableau, engine_of(run)
        self.memory, self.problem = prepare(
            problem, planned(problem, self._engine.plans_contacts), run, tableau,
            lambda piece: problem.instance(run, piece),
        )
        self.whole, self.whole_problem = self.memory, self.problem
        self.part: Any = None
        n = len(problem.initial)
        able = self._engine.works_on_parts and n >= LEAST and not run.real_time  # a cut takes as long as many steps
        self.subsystem: Any = self.problem.subsystem if able else None
        self._cost = LOOK_COST // max(n, 1) + LOOK_BASE
        self._pause, self._margin, self._since = self._cost, MARGIN, 0
        self._seen: Any = None
        self._switched = np.zeros(len(problem.zones), dtype=np.int64)
        able = self.subsystem is not None and self.subsystem.possible
        able = able and bool(problem.callbacks.get("outputs"))  # else unknowns are recorded, and a part has fewer
        self.whole.number["restrict_at"] = self._cost if able else NEVER_LOOK

    def restrict(self) -> None:
        """See whether less would do; where it would have done since the last look, take less."""
        steps, number = int(self.memory.number["steps"]), self.whole.number
        self._prolong()
        switched = self.whole.array["switches_by_machine"].copy()
        blocked = number["t_release"] < BLOCKED  # a machine that is kept from switching is not at rest
        t, y = float(self.whole.number["t"]), self.whole.array["y"]
        found = None if blocked else self.subsystem.moving(t, y, self._margin, MOST, self.part)
        sure = found is not None and found.sure
        if self.part is not None:
            share = SURELY_FEWER if sure else FEWER
            fewer = found is not None and np.count_nonzero(found.kept) < share * len(self.part.unknowns)
            self.memory.number["restrict_at"] = steps + 2 * (steps - self._since) + self._cost
            if fewer and (sure or self._served(switched, self.part)):
                self._enter(found, steps)
        elif sure or (found is not None and self._served(switched, self._seen)):
            self._enter(found, steps)
        else:
            number["restrict_at"] = steps + self._pause
            self._pause *= 2
        self._seen, self._switched = found, switched

    def _served(self, switched: np.ndarray, some: Any) -> bool:
        """True if nothing switched since the last look but what moved then."""
        if some is None:
            return False
        outside = switched != self._switched
        outside[some.machines] = False
        return not outside.any()

    def reactivate(self) -> None:
        """Go on with the whole, at the point where the boundary changed."""
        settled = bool(self.memory.number["boundary_switched"])
        steps, sure = int(self.memory.number["steps"]), self.part.sure
        self._prolong()
        self.memory, self.problem, self.part, self._seen = self.whole, self.whole_problem, None, None
        self._make_fresh(self.whole)
        worth = steps - self._since >= WORTH * self._cost
        wait = (WAIT_AGAIN if sure else self._cost) if worth else self._pause
        self.whole.number["restrict_at"] = steps + wait
        self._pause = self._cost if worth else 2 * self._pause
        self._margin = MARGIN if worth else 2 * self._margin
        self.whole.number["phase"] = SETTLE_WHOLE if settled else TRY

    def finish(self) -> Memory:
        """The memory of the whole, as it is now."""
        self._prolong()
        return self.whole

    def events(self, count: int) -> np.ndarray:
        """The zone changes in the buffer, by machines and guards of the whole."""
        events = np.empty(count, EVENT)
        for name in EVENT.names or ():
            events[name] = self.memory.array[f"event_{name}"][:count]
        if self.part is not None:
            for name, of_whole in (("machine", self.part.machines), ("guard", self.part.guards)):
                given = events[name] >= 0
                events[name][given] = of_whole[events[name][given]]
        return events

    def _enter(self, moving: Any, steps: int) -> None:
        """Work on what moves from now on."""
        part = self.subsystem.part(float(self.whole.number["t"]), self.whole.array["y"], moving)
        if part is None:
            self.memory.number["restrict_at"], self._pause = steps + self._pause, 2 * self._pause
            return
        memory, part = self._memory_of(part)
        for names, places in self._places(part):
            for name in names:
                if name != "zones":
                    memory.array[name][:] = self.whole.array[name][places]
        for name in CARRIED:
            memory.number[name] = self.whole.number[name]
        memory.array["boundary"][:] = part.boundary
        memory.number["is_part"], memory.number["restrict_at"] = 1, steps + WORTH * self._cost
        self._make_fresh(memory)
        FILL(part.problem.callbacks["mass"])(part.problem.context, memory.array["mass"].ctypes.data)
        self.memory, self.problem, self.part, self._since = memory, part.problem, part, steps

    def _memory_of(self, part: Any) -> tuple[Memory, Any]:
        """Memory to work on a part, and the part at work in it, for the whole that is at work here."""
        made = part

        def place(piece: Bytes) -> Instance:
            nonlocal made
            made = part.placed(piece, self.whole_problem)
            return made.problem

        plan = new_plan(part.problem, self._engine.plans_contacts)
        return prepare(part.problem, plan, self._run, self._tableau, place)[0], made

    def save(self) -> SubsystemState:
        """Where the run is, between two steps."""
        part = None
        if self.part is not None:
            part = SavedPart(self.part, self.memory, self.memory.save(), self.part.problem.remembered())
        mine = {name: getattr(self, name) for name in OWN}
        looked = None if self.subsystem is None else self.subsystem.looked
        return SubsystemState(self.whole.save(), self.whole_problem.remembered(), part, mine, looked)

    def restore(self, state: SubsystemState) -> None:
        """Go to where this run was, or another one of the same problem and settings."""
        self.whole.restore(state.whole)
        self.whole_problem.remind(state.remembered)
        vars(self).update(state.own)
        if self.subsystem is not None:
            self.subsystem.looked = state.looked
        self.memory, self.problem, self.part = self.whole, self.whole_problem, None
        if state.part is not None:
            self.part, self.memory = state.part.part, state.part.memory
            if self.part.whole is not self.whole_problem:  # of another run
                self.memory, self.part = self._memory_of(self.part)
            self.memory.restore(state.part.state)
            self.problem = self.part.problem
            self.problem.remind(state.part.remembered)

    def _prolong(self) -> None:
        """Give the whole what the part has become; what rests is as it was."""
        if self.part is None:
            return
        for name in SLOPES:
            self.whole.array[name][:] = 0.0
        for names, places in self._places(self.part):
            for name in names:
                self.whole.array[name][places] = self.memory.array[name]
        for name in CARRIED:
            self.whole.number[name] = self.memory.number[name]
        self.part.prolong(float(self.whole.number["t"]), self.whole.array["y"])
        for name in SLOPES:
            self.part.carry(self.whole.array[name])

    @staticmethod
    def _places(part: Any) -> tuple[tuple[tuple[str, ...], np.ndarray], ...]:
        return (BY_UNKNOWN + SLOPES, part.unknowns), (BY_GUARD, part.guards), (BY_MACHINE, part.machines)

    @staticmethod
    def _make_fresh(memory: Memory) -> None:
        """Nothing that was evaluated for another memory holds in this one."""
        for name in ("jacobian_fresh", "linearised", "reduced_valid", "factored_h", "boundary_switched", "rows",
                     "events"):  # fmt: skip
            memory.number[name] = 0
