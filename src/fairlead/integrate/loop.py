"""The loop of a run, compiled once for all problems.

    START    point = (start, y0); at_time; settle it (staged)
    while point.t < stop:
        TRY      h = propose(point)                        # clipped to land on time events
                 trial = step(point, h)                    # zones, M and J frozen: the minor step
                 if not accepted: shrink h; TRY again
                 crossing = first_crossing(trial)
                 if companion: settle the point at the start of the step; TRY again
        RECORD   grid points of the piece up to the crossing, or the end
        ARRIVE   point = end of the piece                  # the major step
                 if crossing: SETTLE on the guards that fired
                 if time event: at_time, and SETTLE if anything changed
        SETTLE   switch zones until no guard fires; choose the next step; TRY

The loop returns to Python with a status when a slice is used up, a buffer is full, the planned
pivots fail, a smaller part of the problem may do or no longer does (parts.py), or the run ends, and
goes on where it was when called again: `phase` and the struct hold all there is to know.
"""

from __future__ import annotations

from fairlead.integrate.arrival import arrive, settle_here, start
from fairlead.integrate.codes import (
    ARRIVE,
    BUFFER_FULL,
    FINISHED,
    GO_ON,
    NARROW,
    PAUSED,
    RECORD,
    SETTLE,
    TRY,
    WAKE,
    WIDEN,
)
from fairlead.integrate.foreign import compiled, memory_at
from fairlead.integrate.record import record_piece, there_is_room
from fairlead.integrate.release import remember
from fairlead.integrate.settling import begin_settling
from fairlead.integrate.trial import attempt


def advance(address, attempts):
    """Run on for at most `attempts` trial steps; the status to return to Python."""
    m = memory_at(address)
    while True:
        if m.phase == TRY:
            status = ready(m)
            if status != GO_ON:
                return status
            if attempts <= 0:
                return PAUSED
            attempts -= 1
            status = attempt(m)
        elif m.phase == RECORD:
            status = record(m)
        elif m.phase == ARRIVE:
            status = arrive(m, True)
        elif m.phase == SETTLE:
            status = settle_here(m)
        elif m.phase == WAKE:
            status = settle_anew(m)
        else:
            status = start(m)
        if status != GO_ON:
            return status


@compiled
def ready(m):
    """GO_ON before a trial step, or what has to be done first."""
    if m.woken == 1:
        return WIDEN
    if m.t >= m.stop:
        return FINISHED
    if not there_is_room(m):
        return BUFFER_FULL
    return NARROW if m.steps >= m.narrow_at else GO_ON


@compiled
def settle_anew(m):
    """Settle all that there is at a point where only a part of it was."""
    m.n_fired = 0
    remember(m)
    begin_settling(m)
    m.phase = SETTLE
    return GO_ON


@compiled
def record(m):
    """Write the grid points of the piece."""
    if not record_piece(m):
        return BUFFER_FULL
    m.phase = ARRIVE
    return GO_ON
