"""How long the next step is to be, and what becomes of one that is accepted: the same for all methods."""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import ARRIVE, GO_ON, MAX_EVENTS, MAX_STEPS, NOT_FINITE, RECORD
from fairlead.integrate.controller import step_after_acceptance
from fairlead.integrate.foreign import compiled, copy, field_at, reals
from fairlead.integrate.growth import short_of_growth
from fairlead.integrate.interpolant import interpolate
from fairlead.integrate.meters import meter_piece

DOUBT = 0.1
"""How much shorter a step is tried when a guard that falls by the slopes at the point, where the zones were just
settled, does not in the step: the interpolant of a long step is rough at its start. To settle there again
would change nothing, and the next step be as long."""
INSTANT = 1e-13
"""Share of the time, or of the span, below which two time events are one: in a step as short matrices are rounding."""


@compiled
def over_budget(m):
    """GO_ON, or which budget is used up."""
    if m.steps >= m.max_steps:
        return MAX_STEPS
    return MAX_EVENTS if m.total_events >= m.max_events else GO_ON


@compiled
def propose(m):
    """The next step size: what control wants, clipped to land on the next time event or the stop."""
    m.t_land = min(m.stop, min(m.t_next, m.t_release))
    rest = m.t_land - m.t
    h = short_of_growth(m, min(m.h_next, m.max_step))
    m.h_wanted = h
    m.landing = 0
    if h >= rest * (0.99 if m.adaptive == 1 else 1.0 - 1e-9):
        m.landing = 1
        return rest
    if m.adaptive == 1 and h > 0.5 * rest:
        return 0.5 * rest
    return h


@compiled
def is_instant(m, h):
    """True if the next time event is this very instant but for rounding: nothing moves until then."""
    if m.landing == 0 or m.t_land >= m.stop or h > INSTANT * max(abs(m.t), m.stop - m.start):
        return False
    m.crossed = 0
    m.t_piece = m.t_land
    copy(reals(m.at_y, m.n), reals(m.at_y_piece, m.n))
    copy(reals(m.at_y, m.n), reals(m.at_y_end, m.n))
    copy(reals(m.at_g, m.n_guards), reals(m.at_g_end, m.n_guards))
    m.phase = ARRIVE
    return True


@compiled
def smallest_step(m):
    """The step floor here: what was set, but not below what t can resolve."""
    return max(m.step_floor, 4e-15 * abs(m.t))


@compiled
def not_finite_here(m, otherwise):
    """NOT_FINITE, with the unknown in `worst`, if f is not finite here or a step later; else `otherwise`.

    The trial itself does not tell whose law it was: one nan spreads to all unknowns in the first solve.
    """
    for fraction in range(2):
        field_at(m.call_rhs, (m.context, m.t + fraction * m.h, m.at_y, m.at_f))
        f = reals(m.at_f, m.n)
        for k in range(m.n):
            if not isfinite(f[k]):
                m.worst = k
                return NOT_FINITE
    return otherwise


@compiled
def accept(m, h, crossed):
    """Set the piece of the trial that is accepted: up to the crossing, or to the end."""
    m.steps += 1
    m.partial_steps += m.narrowed
    if m.adaptive == 1:
        m.h_next = step_after_acceptance(m, h)
        if h < m.h_wanted:
            m.h_next = max(m.h_next, m.h_wanted)
    m.last_error = max(m.error, 1e-4)
    m.retried = 0
    m.mended = 0
    m.crossed = 1 if crossed else 0
    if crossed and m.theta < 1.0:
        m.t_piece = m.t + m.theta * h
        if m.landing == 1 and m.t_land - m.t_piece < smallest_step(m):
            m.t_piece = m.t_land  # no step could cover what would be left
        else:
            m.landing = 0
        interpolate(m, m.theta, m.at_y_piece)
        if m.meters_off == 1:
            meter_piece(m, h)
    else:
        m.t_piece = m.t_land if m.landing == 1 else m.t + h
        copy(reals(m.at_y_end, m.n), reals(m.at_y_piece, m.n))
        if m.meters_off == 1:
            m.theta = 1.0
            meter_piece(m, h)
    m.phase = RECORD
