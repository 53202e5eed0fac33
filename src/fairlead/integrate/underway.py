"""A run under way: entered slice by slice, served between the slices, copied and taken back.

Its state is an arena (memory/arena.py), that of the part it works on if it does (parts.py), and what callbacks in plain
Python know. `ida` keeps the past of a run in memory of SUNDIALS, which cannot be copied: it neither saves nor restores.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from fairlead.errors import UsageError
from fairlead.integrate.codes import SETTLE
from fairlead.integrate.engines import engine_of
from fairlead.integrate.linear.replan import replan
from fairlead.integrate.machine_code import compiled_loop
from fairlead.integrate.parts import ActiveSubsystem, SubsystemState
from fairlead.integrate.problem import Block, OnBlock, Problem, Run, Status
from fairlead.integrate.rodas.tableau import TABLEAUS

SLICE = 0.05
"""Seconds between two returns to Python, aimed at."""
FIRST_ATTEMPTS = 16
SERVED = (Status.PAUSED, Status.BUFFER_FULL, Status.REPLAN, Status.RESTRICT, Status.REACTIVATE)
"""Returns to Python after which the loop goes on."""


class Saved(NamedTuple):
    """Where a run was."""

    active: SubsystemState
    status: Status
    replanned_at: int


class Underway:
    """One run of a problem; `take` gets what every slice records."""

    def __init__(self, problem: Problem, run: Run, take: OnBlock) -> None:
        """Begin; nothing is evaluated yet."""
        self.run, self.take, self.problem = run, take, problem
        self.active = ActiveSubsystem(problem, run, TABLEAUS[run.method])
        self.engine = engine_of(run)
        make = self.engine.loop
        self._advance = make(self.active.problem, run, self.active.memory) if make else compiled_loop(self.engine)
        self.status, self._attempts, self._replanned_at = Status.PAUSED, FIRST_ATTEMPTS, -1
        self.wall = self.cpu = 0.0
        """Seconds spent inside the loop, and on cutting out what moves."""

    @property
    def served(self) -> bool:
        """True as long as the run goes on."""
        return self.status in SERVED

    def go_on(self, attempts: int | None = None, *, hand_over: bool = True) -> None:
        """Enter the loop for at most so many trial steps (None: some SLICE seconds), and serve what it asks for.

        Without `hand_over` the buffers are kept as long as there is room; who asks for that calls `flush`.
        """
        before = self.wall
        address, most = self.active.memory.address, self._attempts if attempts is None else attempts
        self.status = Status(self._timed(lambda: self._advance(address, most)))
        spent = self.wall - before
        number = self.active.memory.number
        if self.status == Status.REACTIVATE and number["boundary_switched"]:
            number["rows"] -= 1  # the row after the switch; the whole settles there once more
        if hand_over or self.status == Status.BUFFER_FULL:
            self.flush()
        if self.status == Status.REPLAN:
            self._replan()
        elif self.status == Status.RESTRICT:
            self._timed(self.active.restrict)
        elif self.status == Status.REACTIVATE:
            self._timed(self.active.reactivate)
        elif self.status == Status.PAUSED and attempts is None:
            self._attempts = next_attempts(self._attempts, spent)

    def _timed(self, work: Callable[[], Any]) -> Any:
        """Do some of the work of the engine, and count the time it takes; writing down what it recorded is none."""
        entered, working = time.perf_counter(), time.process_time()
        done = work()
        self.wall += time.perf_counter() - entered
        self.cpu += time.process_time() - working
        return done

    def _replan(self) -> None:
        """Other pivots; without any the equations are singular, which a settlement is told once: other zones may do."""
        number = self.active.memory.number
        again = int(number["factorisations"]) <= self._replanned_at + 1
        found = not again and replan(self.active.memory, self.active.problem)
        if number["midway"]:
            number["replanned"] = 1
        elif not found and number["phase"] == SETTLE and not again:
            number["no_pivots"] = 1
        elif not found:
            self.status = Status.SINGULAR
        self._replanned_at = int(number["factorisations"])

    def beside(self, take: OnBlock) -> Underway:
        """Another run of the same problem with the same settings, at its start."""
        return Underway(self.problem, self.run, take)

    def flush(self) -> None:
        """Hand over what the buffers hold and empty them: they are no part of what is saved."""
        number, array, run = self.active.memory.number, self.active.memory.array, self.run
        rows, n_outputs = int(number["rows"]), int(number["n_outputs"])
        events, t = self.active.events(int(number["events"])), float(number["t"])
        number["rows"] = number["events"] = 0
        self.take(
            Block(
                t=array["row_t"][:rows].copy(),
                values=array["row_values"][: rows * n_outputs].reshape(rows, n_outputs).copy(),
                side=array["row_side"][:rows].astype(np.int8),
                events=events,
                reached=t,
                fraction=min(1.0, max(0.0, (t - run.start) / (run.stop - run.start))),
            )
        )

    def save(self) -> Saved:
        """Where the run is now, between two slices. Raises UsageError for an engine that cannot be copied, as ida."""
        if why := self.engine.not_saved:
            raise UsageError(f"{why}; a run that is to be saved takes rodas or stepping.")
        return Saved(self.active.save(), self.status, self._replanned_at)

    def restore(self, saved: Saved) -> None:
        """Go to where this run was, or another one of the same problem with the same settings."""
        self.active.restore(saved.active)
        self.status, self._replanned_at = saved.status, saved.replanned_at


def next_attempts(attempts: int, spent: float) -> int:
    """Trial steps for the next slice, so that it lasts about SLICE seconds; at most eight times as many."""
    factor = SLICE / max(spent, 1e-6)
    return max(1, int(attempts * min(max(factor, 0.1), 8.0)))
