"""The loop of the stepping engine, compiled once for all problems; phases and statuses as in loop.py.

START    point = (start, y0); at_time; settle it (staged)
while point.t < stop:
    TRY      h = propose(point)                        # clipped to land on time events
             zones and end of the step together        # the active set, theta_step.py
             if they do not settle: halve h; TRY again
             if the error is too large: shrink h; TRY again
    RECORD   grid points of the step
    ARRIVE   point = end of the step; zone changes go to the log, at its end
             if time event: at_time, and SETTLE if anything changed
    SETTLE   as `rodas` does
"""

from __future__ import annotations

from fairlead.integrate.arrival import arrive, settle_here, start
from fairlead.integrate.codes import ARRIVE, BUFFER_FULL, GO_ON, PAUSED, RECORD, SETTLE, TRY, WAKE
from fairlead.integrate.foreign import compiled, copy, indices, memory_at, reals
from fairlead.integrate.loop import ready, record, settle_anew
from fairlead.integrate.settling import log_changes
from fairlead.integrate.stepping_trial import attempt_stepping, begin_history, remember_slope


def advance_stepping(address, attempts):
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
            status = attempt_stepping(m)
        elif m.phase == RECORD:
            status = record(m)
        elif m.phase == ARRIVE:
            status = arrive_with_zones(m)
        elif m.phase == WAKE:
            status = settle_anew(m)
        elif m.phase == SETTLE:
            status = settle_here(m)
            if status == GO_ON and m.phase == TRY:
                begin_history(m)
        else:
            status = start(m)
        if status != GO_ON:
            return status


@compiled
def arrive_with_zones(m):
    """Log the zones the step changed, then arrive at its end."""
    if m.rows + 4 > m.row_capacity:
        return BUFFER_FULL
    switched = m.passes > 0
    if switched:
        m.t = m.t_piece
        copy(indices(m.at_zones_at_start, m.n_zones), indices(m.at_zones_before, m.n_zones))
        m.n_fired = 0
        m.passes = 0
        log_changes(m)
    copy(reals(m.at_g, m.n_guards), reals(m.at_g_early, m.n_guards))
    if m.samples == 1 and m.landing == 1 and m.t_piece >= m.t_next and m.t_piece < m.stop:
        m.crossed = 1  # settled before the sample is taken: forces are those of the middle of the step until then
        m.n_fired = 0
    status = arrive(m, False)
    if m.phase == TRY:
        remember_slope(m)
    return status
