"""The method `stepping`, as the loop takes it.

    attempt  zones and end of the step together        # the active set, theta_step.py
             if they do not settle: halve h; TRY again
             if the error is too large: shrink h; TRY again
    arrive   zone changes go to the log, at the end of the step
    settled  the slopes before are those of the settled point
"""

from __future__ import annotations

from fairlead.integrate.arrival import arrive
from fairlead.integrate.codes import BUFFER_FULL, TRY
from fairlead.integrate.foreign import compiled, copy, indices, reals
from fairlead.integrate.loop import Method
from fairlead.integrate.settling import log_changes
from fairlead.integrate.stepping_trial import attempt_stepping, begin_history, remember_slope


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


@compiled
def begin_again(m):
    """After a settlement nothing is known of the steps before."""
    begin_history(m)


METHOD = Method(attempt_stepping, arrive_with_zones, begin_again)
