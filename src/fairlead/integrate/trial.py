"""One trial step: proposed, taken, and rejected, given up for a settlement, or accepted up to a crossing."""

from __future__ import annotations

from math import inf, isfinite

from fairlead.integrate.codes import (
    ARRIVE,
    BEFORE,
    GO_ON,
    MAX_EVENTS,
    MAX_STEPS,
    NOT_FINITE,
    RECORD,
    REPLAN,
    SETTLE,
    SINGULAR_MATRIX,
    STEP_FLOOR,
)
from fairlead.integrate.controller import (
    estimate_error,
    step_after_acceptance,
    step_after_rejection,
    weighted_norm,
)
from fairlead.integrate.crossing import COMPANION, CROSSING, first_crossing
from fairlead.integrate.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.growth import short_of_growth
from fairlead.integrate.interpolant import interpolate, prepare_interpolant
from fairlead.integrate.linear import INACCURATE, SINGULAR
from fairlead.integrate.meters import judge_meters, meter_piece
from fairlead.integrate.position import way_back
from fairlead.integrate.record import write_row
from fairlead.integrate.release import remember
from fairlead.integrate.rosenbrock import defect, midpoint_defect, take_step
from fairlead.integrate.rows_between import find_stiff
from fairlead.integrate.settling import all_fall, begin_settling

DOUBT = 0.1
"""How much shorter a step is tried when a guard that falls by the slopes at the point, where the zones were just
settled, does not in the step: the interpolant of a long step is rough at its start. To settle there again
would change nothing, and the next step be as long."""

INSTANT = 1e-13
"""Share of the time, or of the span, below which two time events are one: in a step as short matrices are rounding."""

ROUGH = 10.0
"""Error weights by which the dense output may be off the equations where a step is cut at a crossing."""
MOST_KEPT = 0.8
"""Share of a step that is taken again at most."""

STUBBORN = 6
"""Rejections in a row that call for `mend_point`."""


@compiled
def attempt(m):
    """One trial step: rejected, given up for a settlement at its start, or accepted up to `t_piece`."""
    spent = over_budget(m)
    if spent != GO_ON:
        return spent
    h = propose(m)
    if is_instant(m, h):
        return GO_ON
    m.h = h
    status = take_step(m, h)
    if status == INACCURATE:
        return REPLAN
    if status == SINGULAR:
        m.error = inf
    else:
        m.error = estimate_error(m)
        judge_meters(m)
    if m.error <= 1.0 or m.adaptive == 0:
        prepare_interpolant(m)
        if m.n_watched > 0 and m.adaptive == 1:
            midpoint_defect(m, h)
            m.error = max(m.error, weighted_norm(m, m.at_error_vector))
        if m.n_moves > 0 and m.adaptive == 1:
            m.error = max(m.error, way_back(m, h))
    if not isfinite(m.error) or (m.adaptive == 1 and m.error > 1.0):
        return reject(m, h, status)
    found = first_crossing(m, h)
    if m.n_balanced > 0 and m.judged == 1 and turns_at_limit(m, h):
        m.n_fired = 0
        m.h_next = DOUBT * h
        m.retried += 1
        return GO_ON
    if found == COMPANION:
        m.rejected_companion += 1
        if m.judged == 1 and m.adaptive == 1 and DOUBT * h >= smallest_step(m) and all_fall(m):
            m.n_fired = 0
            m.h_next = DOUBT * h
            m.retried += 1
            return GO_ON
        m.companion = 1
        write_row(m, m.t, m.at_y, BEFORE)
        remember(m)
        begin_settling(m)
        m.phase = SETTLE
        return GO_ON
    if found == CROSSING and m.theta < 1.0 and m.adaptive == 1 and cut_too_rough(m, h):
        return GO_ON
    m.any_stiff = find_stiff(m, h)
    accept(m, h, found == CROSSING)
    return GO_ON


@compiled
def cut_too_rough(m, h):
    """True if the piece up to a crossing is to be taken as a step of its own, which `h_next` then is."""
    if min(m.theta, MOST_KEPT) * h < smallest_step(m) or not rough(m, h):
        return False
    m.n_fired = 0
    m.h_next = min(m.theta, MOST_KEPT) * h
    return True


@compiled
def rough(m, h):
    """True if the dense output does not satisfy the equations at `theta`, where the step is to be cut.

    The error of a step is that of its end. A law may change much between the last stage before a crossing and the one
    after it, as friction does that rises while a contact comes to rest: beyond rest the law in force is mirrored, so
    all stages may lie beside the rise, and the piece of the step up to rest misses it.
    """
    defect(m, h, m.theta)
    if weighted_norm(m, m.at_error_vector) <= ROUGH:
        return False
    m.rejected_switch += 1
    m.retried += 1
    return True


@compiled
def turns_at_limit(m, h):
    """True if guards fired that were at their limits where zones were settled, and all are below at the end.

    The load of a spring that turns in the hand at the limit of its contact leaves it with no slope, and the interpolant
    of a long step is rougher than that. Of a shorter one it is not: the load goes with the square of the step.
    """
    ng = m.n_guards
    g, end, tolerance = reals(m.at_g, ng), reals(m.at_g_end, ng), reals(m.at_guard_tolerance, ng)
    fired, turns = indices(m.at_fired, ng), m.n_fired > 0 and m.adaptive == 1 and DOUBT * h >= m.dwell
    for k in range(m.n_fired):
        i = fired[k]
        turns = turns and abs(g[i]) <= tolerance[i] and end[i] < 0.0
    return turns


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
def reject(m, h, status):
    """Shrink the step, and say whom it is due to; end the run at the step floor."""
    indices(m.at_rejections_by_unknown, m.n)[m.worst] += 1
    if status == SINGULAR:
        m.rejected_singular += 1
    elif isfinite(m.error):
        m.rejected_error += 1
    else:
        m.rejected_nan += 1
    m.h_next = step_after_rejection(m, h)
    m.retried += 1
    if m.retried == STUBBORN and m.n_algebraic > 0 and m.mended == 0 and status != SINGULAR:
        mend_point(m)
        return GO_ON
    if m.adaptive == 1 and m.h_next >= smallest_step(m):
        return GO_ON
    if status == SINGULAR:
        return not_finite_here(m, SINGULAR_MATRIX)
    return STEP_FLOOR if isfinite(m.error) else not_finite_here(m, NOT_FINITE)


@compiled
def mend_point(m):
    """Make the point consistent by a settlement that fires nothing, once until the next accepted step.

    An algebraic unknown at the end of a step is right within the error of the step. Where it amplifies the
    others that may be many weights: the next step then begins with a jump that no shorter step makes smaller.
    """
    m.mended = 1
    m.companion = 1
    m.n_fired = 0
    write_row(m, m.t, m.at_y, BEFORE)
    remember(m)
    begin_settling(m)
    m.phase = SETTLE


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
