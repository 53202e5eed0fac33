"""The method `stepping`, as the loop takes it.

    attempt  zones and end of the step together        # the active set, theta_step.py
             if they do not settle: halve h; TRY again
             if the error is too large: shrink h; TRY again
    arrive   zone changes go to the log, at the end of the step
    settled  the slopes before are those of the settled point
"""

from __future__ import annotations

from fairlead.integrate.codes import BUFFER_FULL, TRY
from fairlead.integrate.events.arrival import arrive
from fairlead.integrate.events.settling import log_changes
from fairlead.integrate.loop import Method
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals
from fairlead.integrate.stepping.trial import attempt_stepping, begin_history, remember_slope


@compiled
def arrive_with_zones(m):
    """Log the zones the step changed, then arrive at its end."""
    problem, run, guards, settling, recorder = m.problem, m.run, m.events.guards, m.events.settling, m.recorder
    if recorder.rows + 4 > recorder.row_capacity:
        return BUFFER_FULL
    switched = settling.passes > 0
    if switched:
        m.point.t = run.t_piece
        at_start = indices(m.stepping.contacts.at_zones_at_start, problem.n_zones)
        copy(at_start, indices(settling.at_zones_before, problem.n_zones))
        guards.n_fired = 0
        settling.passes = 0
        log_changes(m)
    copy(reals(guards.at_g, problem.n_guards), reals(guards.at_g_early, problem.n_guards))
    if problem.samples == 1 and run.landing == 1 and run.t_piece >= run.t_next and run.t_piece < run.stop:
        run.crossed = 1  # settled before the sample is taken: forces are those of the middle of the step until then
        guards.n_fired = 0
    status = arrive(m, False)
    if run.phase == TRY:
        remember_slope(run, m.stepping)
    return status


@compiled
def begin_again(m):
    """After a settlement nothing is known of the steps before."""
    begin_history(m.run, m.point, m.linear.matrices, m.stepping)


METHOD = Method(attempt_stepping, arrive_with_zones, begin_again)
