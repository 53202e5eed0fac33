"""The trial of a method of one step: taken, and rejected, given up for a settlement, or accepted up to a crossing.

A method says how it takes a step from (t, y) in frozen zones: `y_end`, and its error in `error_vector`; and how it is
interpolated: the D of interpolant.py. It leaves W of its step factorised (linear.py). All the rest is here.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf, isfinite
from typing import Any, NamedTuple

from fairlead.integrate.codes import BEFORE, GO_ON, NOT_FINITE, REPLAN, SETTLE, SINGULAR_MATRIX, STEP_FLOOR
from fairlead.integrate.controller import estimate_error, step_after_rejection, weighted_norm
from fairlead.integrate.crossing import COMPANION, CROSSING, first_crossing
from fairlead.integrate.defect import defect, midpoint_defect
from fairlead.integrate.foreign import compiled, indices, reals
from fairlead.integrate.linear import INACCURATE, SINGULAR
from fairlead.integrate.meters import judge_meters
from fairlead.integrate.pace import DOUBT, accept, is_instant, not_finite_here, over_budget, propose, smallest_step
from fairlead.integrate.position import way_back
from fairlead.integrate.record import write_row
from fairlead.integrate.release import remember
from fairlead.integrate.rows_between import find_stiff
from fairlead.integrate.settling import all_fall, begin_settling

ROUGH = 10.0
"""Error weights by which the dense output may be off the equations where a step is cut at a crossing."""
MOST_KEPT = 0.8
"""Share of a step that is taken again at most."""
STUBBORN = 6
"""Rejections in a row that call for `mend_point`."""


class OneStep(NamedTuple):
    """What a method of one step is: compiled functions."""

    take: Callable[..., Any]
    """take(m, h): `y_end` and `error_vector` of the step from the point; DONE, SINGULAR or INACCURATE (linear.py)."""
    interpolate: Callable[..., Any]
    """interpolate(m, h): the D of interpolant.py, for a step whose error is small enough."""


def trial_of(method: OneStep) -> Any:
    """attempt(m) -> status: one trial step by this method."""
    take, prepare = method

    @compiled
    def attempt(m):
        spent = over_budget(m)
        if spent != GO_ON:
            return spent
        h = propose(m)
        if is_instant(m, h):
            return GO_ON
        m.h = h
        status = take(m, h)
        if status == INACCURATE:
            return REPLAN
        judge_end(m, status)
        if m.error <= 1.0 or m.adaptive == 0:
            prepare(m, h)
            judge_inside(m, h)
        if not isfinite(m.error) or (m.adaptive == 1 and m.error > 1.0):
            return reject(m, h, status)
        return up_to_crossing(m, h)

    return attempt


@compiled
def judge_end(m, status):
    """Error of the end of the trial step."""
    m.error = inf
    if status != SINGULAR:
        m.error = estimate_error(m)
        judge_meters(m)


@compiled
def judge_inside(m, h):
    """Error of the dense output, where the end of a step does not tell."""
    if m.n_watched > 0 and m.adaptive == 1:
        midpoint_defect(m, h)
        m.error = max(m.error, weighted_norm(m, m.at_error_vector))
    if m.n_moves > 0 and m.adaptive == 1:
        m.error = max(m.error, way_back(m, h))


@compiled
def up_to_crossing(m, h):
    """Accept a step whose error is small enough, up to its first crossing; or give it up for what that shows."""
    found = first_crossing(m, h)
    if m.n_balanced > 0 and m.judged == 1 and turns_at_limit(m, h):
        return try_shorter(m, h)
    if found == COMPANION:
        m.rejected_companion += 1
        doubtful = m.judged == 1 and m.adaptive == 1 and DOUBT * h >= smallest_step(m)
        if doubtful and all_fall(m):
            return try_shorter(m, h)
        settle_at_start(m)
        return GO_ON
    if found == CROSSING and m.theta < 1.0 and m.adaptive == 1 and cut_too_rough(m, h):
        return GO_ON
    m.any_stiff = find_stiff(m, h)
    accept(m, h, found == CROSSING)
    return GO_ON


@compiled
def try_shorter(m, h):
    """Take a much shorter step: see DOUBT."""
    m.n_fired = 0
    m.h_next = DOUBT * h
    m.retried += 1
    return GO_ON


@compiled
def settle_at_start(m):
    """Settle at the point, on the guards in `fired`, before another step is tried."""
    m.companion = 1
    write_row(m, m.t, m.at_y, BEFORE)
    remember(m)
    begin_settling(m)
    m.phase = SETTLE


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
    m.n_fired = 0
    settle_at_start(m)
