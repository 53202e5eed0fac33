"""The loop of a run, one for every method, compiled once for all problems.

    START    point = (start, y0); at_time; settle it (staged)
    while point.t < stop:
        TRY      method.attempt: h = propose(point)        # clipped to land on time events
                 trial = step(point, h)                    # the minor step: zones frozen, and M and J with them;
                                                           # not so where `stepping` finds the zones of the end
                 rejected: shrink h; TRY again
                 given up: SETTLE at the point
                 accepted: up to the first crossing, or to the end; method.next_length
        RECORD   grid points of the piece
        ARRIVE   method.arrive: point = end of the piece   # the major step
                 if crossing: SETTLE on the guards that fired
                 if time event: at_time, and SETTLE if anything changed
        SETTLE   switch zones until no guard fires; the first step, by method.leading_error; method.settled; TRY

The loop returns to Python with a status when a slice is used up, a buffer is full, the planned
pivots fail, a smaller part of the problem may do or no longer does (parts.py), or the run ends, and
goes on where it was when called again: `phase` and the structs hold all there is to know.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

from fairlead.integrate.codes import (
    ARRIVE,
    BUFFER_FULL,
    FINISHED,
    GO_ON,
    PAUSED,
    REACTIVATE,
    RECORD,
    RESTRICT,
    SETTLE,
    SETTLE_WHOLE,
    SINGULAR_MATRIX,
    STEP_FLOOR,
    TRY,
)
from fairlead.integrate.events.arrival import arrive, settle_here, start
from fairlead.integrate.events.pace import end_attempts, length_by_control
from fairlead.integrate.events.release import remember
from fairlead.integrate.events.settling import begin_settling
from fairlead.integrate.memory.foreign import compiled, memory_at
from fairlead.integrate.one_step import OneStep, reinitialise, trial_of
from fairlead.integrate.record.rows import record_piece, there_is_room


@compiled
def not_bounded(m):
    """What a method says of its first step that does not bound it."""
    return 0.0, 1.0


class Method(NamedTuple):
    """What a method of integration does in the loop: compiled functions, each given the memory of the run."""

    attempt: Callable[..., Any]
    """attempt(m) -> status: one trial step; leaves the phase that follows, and `t_piece`, `y_piece` if accepted."""
    arrive: Callable[..., Any]
    """arrive(m) -> status: go on to the end of the piece."""
    settled: Callable[..., Any]
    """settled(m): after every settlement; what was known of the steps before holds no longer."""
    next_length: Callable[..., Any] = length_by_control
    """next_length(m) -> [s]: how long the step after an accepted one is to be, which was `run.h` long."""
    leading_error: Callable[..., Any] = not_bounded
    """leading_error(m) -> share, order: a first step h has the error A (h/T)^order / share, in weights, of a motion of
    amplitude A and time scale T; before `settled`. A share of 0: its first step is bounded by no such error."""


@compiled
def arrive_by_equations(m):
    """Arrive at the end of a piece; at a crossing forces are those of the equations."""
    return arrive(m, True)


@compiled
def nothing_kept(m):
    """What a method does after a settlement that knows nothing of earlier steps."""


def method_of(steps: OneStep) -> Method:
    """The method that takes such steps, and keeps nothing of them."""
    return Method(trial_of(steps), arrive_by_equations, nothing_kept)


def loop_of(method: Method) -> Callable[[int, int], int]:
    """advance(address of the structs, attempts) -> status: run on for at most so many trial steps."""
    attempt, arrive_at, settled, next_length, leading_error = method

    def advance(address, attempts):
        m = memory_at(address)
        problem, run, point, events = m.problem, m.run, m.point, m.events
        while True:
            if run.phase == TRY:
                status = ready(problem, run, point, m.recorder)
                if status != GO_ON:
                    return status
                if attempts <= 0:
                    return PAUSED
                attempts -= 1
                status = attempt(m)
                if status > FINISHED and begins_without_answer(problem, run, status):
                    reinitialise(m)
                    status = GO_ON
                if run.phase == RECORD:
                    end_attempts(run, next_length(m))
            elif run.phase == RECORD:
                status = write_piece(m)
            elif run.phase == ARRIVE:
                status = arrive_at(m)
            elif run.phase == SETTLE:
                share, order = leading_error(m)
                status = settle_here(m, share, order)
                if status == GO_ON and run.phase == TRY:
                    settled(m)
            elif run.phase == SETTLE_WHOLE:
                status = settle_anew(problem, run, point, events)
            else:
                status = start(problem, run, point, events)
            if status != GO_ON:
                return status

    return advance


@compiled
def ready(problem, run, point, recorder):
    """GO_ON before a trial step, or what has to be done first."""
    if run.boundary_switched == 1:
        return REACTIVATE
    if point.t >= run.stop:
        return FINISHED
    if not there_is_room(problem, recorder):
        return BUFFER_FULL
    return RESTRICT if run.steps >= run.restrict_at else GO_ON


@compiled
def begins_without_answer(problem, run, status):
    """True if no step succeeds since its start, not settled yet, may lie where its zones have no answer (corners.py).

    What `stepping` has of forces at the end of a step is extrapolated, beyond the corner by what it is off.
    """
    return problem.n_pressing > 0 and run.judged == 0 and status in (SINGULAR_MATRIX, STEP_FLOOR)


@compiled
def settle_anew(problem, run, point, events):
    """Settle all that there is at a point where only a part of it was."""
    events.guards.n_fired = 0
    remember(problem, point, events.loads)
    begin_settling(problem, run, point, events)
    run.phase = SETTLE
    return GO_ON


@compiled
def write_piece(m):
    """Write the grid points of the piece."""
    if not record_piece(m):
        return BUFFER_FULL
    m.run.phase = ARRIVE
    return GO_ON
