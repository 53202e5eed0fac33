"""The trial of a method of one step: taken, and rejected, given up for a settlement, or accepted to a crossing.

A method says how it takes a step from (t, y) in frozen zones, and how that is interpolated. All the rest is here.
`take` sets all of `y_end`, quadratures and the forces of what holds at t + h as well, since guards read them there;
and its error in `error_vector`, zero where it knows none. A Newton iteration that fails leaves a nan there: a quarter
of the step comes next. Weights are those of the last step until `take` is done (`weigh` sets them). Row k of what holds
says dv/dt = -v/tau, so a method that does not damp multiplies a slip by -1. `factors.factored_h` is the step for which
W is factorised; a settlement sets it to zero, and defect.py and quadratures.py solve with those factors.
"""

from __future__ import annotations

from collections.abc import Callable
from math import inf, isfinite
from typing import Any, NamedTuple

from fairlead.integrate.codes import GO_ON, INACCURATE, NOT_FINITE, REPLAN, SINGULAR, SINGULAR_MATRIX, STEP_FLOOR
from fairlead.integrate.events.chatter import dwell_here
from fairlead.integrate.events.crossing import CROSSING, INCONSISTENT_START, find_first_crossing
from fairlead.integrate.events.given_apart import judge_given
from fairlead.integrate.events.given_up import (
    TOO_LONG,
    settle_at_start,
    settle_inconsistent_start,
    take_again,
    take_much_shorter,
)
from fairlead.integrate.events.pace import (
    DOUBT,
    accept,
    arrive_at_instant,
    is_instant,
    not_finite_here,
    over_budget,
    propose,
)
from fairlead.integrate.events.position import way_back
from fairlead.integrate.memory.foreign import compiled, indices, reals
from fairlead.integrate.point.controller import estimate_error, smallest_step, step_after_rejection, weighted_norm
from fairlead.integrate.point.defect import find_defect, find_midpoint_defect
from fairlead.integrate.point.faded import error_of_faded
from fairlead.integrate.point.quadratures import judge_quadratures
from fairlead.integrate.point.stiff import mark_stiff
from fairlead.integrate.point.swings import judge_swings

ROUGH = 10.0
"""Error weights by which the dense output may be off the equations where a step is cut at a crossing."""
ROUGH_AT_STOP = 0.1
"""The same where a stop is met. A body rebounds with its speed, again and again until that is some ten weights, where
it lies. Ten weights more in each flight than there were would keep it bouncing for ever."""
NEGLIGIBLE = 1e-6
"""Share of the absolute weight of a force below which it is nothing in its scene, whatever its limit: rounding of
others would else be asked of."""
MOST_KEPT = 0.8
"""Share of a step that is taken again at most."""
REINITIALISE_AFTER = 6
"""Rejections in a row that call for `reinitialise`."""


class OneStep(NamedTuple):
    """What a method of one step is: compiled functions."""

    take: Callable[..., Any]
    """take(m, h): `y_end` and `error_vector` of the step from the point; DONE, SINGULAR or INACCURATE (systems.py)."""
    prepare_interpolant: Callable[..., Any]
    """prepare_interpolant(m, h): the D of interpolant.py, for a step whose error is small enough."""


def trial_of(method: OneStep) -> Any:
    """attempt(m) -> status: one trial step by this method."""
    take, prepare = method

    @compiled
    def attempt(m):
        run, point, recorder = m.run, m.point, m.recorder
        spent = over_budget(run, recorder)
        if spent != GO_ON:
            return spent
        h = propose(run, point)
        if is_instant(run, point, h):
            arrive_at_instant(run, point, m.events.guards)
            return GO_ON
        run.h = h
        status = take(m, h)
        if status == INACCURATE:
            return REPLAN
        judge_end(m.problem, run, point, recorder, status)
        judge_given(m, h)
        if run.error <= 1.0 or run.adaptive == 0:
            prepare(m, h)
            judge_inside(m, h)
        if not isfinite(run.error) or (run.adaptive == 1 and run.error > 1.0):
            return reject(m, h, status)
        return up_to_crossing(m, h)

    return attempt


@compiled
def judge_end(problem, run, point, recorder, status):
    """Error of the end of the trial step."""
    run.error = inf
    if status != SINGULAR:
        run.error = estimate_error(point)
        judge_quadratures(run, point, recorder)
        judge_swings(problem, run, point, run.h)


@compiled
def judge_inside(m, h):
    """Error of the dense output, where the end of a step does not tell."""
    problem, run, point, linear, method = m.problem, m.run, m.point, m.linear, m.method
    if method.n_monitored > 0 and run.adaptive == 1:
        find_midpoint_defect(problem, point, linear, method, h)
        run.error = max(run.error, weighted_norm(point, point.at_error_vector))
    if problem.n_accelerated > 0 and run.adaptive == 1:
        run.error = max(run.error, way_back(problem, point, linear, h))
    if run.adaptive == 1 and run.error <= 1.0:
        run.error = max(run.error, error_of_faded(m, h))


@compiled
def up_to_crossing(m, h):
    """Accept a step whose error is small enough, up to its first crossing; or give it up for what that shows."""
    problem, run, guards, recorder = m.problem, m.run, m.events.guards, m.recorder
    found = find_first_crossing(m, h)
    if problem.n_balanced > 0 and run.judged == 1 and turns_at_limit(run, m.point, guards, h):
        return take_much_shorter(run, guards, h)
    if found == INCONSISTENT_START:
        return settle_inconsistent_start(m, h)
    if found == CROSSING and run.cut_at < 1.0 and run.adaptive == 1 and piece_is_rough(m, h):
        return take_piece(m, h)
    recorder.any_stiff = mark_stiff(problem, m.linear.matrices, recorder, h)
    accept(m, h, found == CROSSING)
    return GO_ON


@compiled
def piece_is_rough(m, h):
    """True if the piece up to a crossing misses the equations, and is long enough to be a step of its own."""
    run, point = m.run, m.point
    if length_of_piece(run, h) < smallest_step(run, point):
        return False
    if is_rough(m.problem, run, point, m.events.guards, m.linear, h):
        return True
    met = meets_stop(m.problem, m.events.guards)
    return met and not weighted_norm(point, point.at_error_vector) <= ROUGH_AT_STOP


@compiled
def take_piece(m, h):
    """Have the piece up to a crossing taken as a step of its own, which the next trial then is."""
    m.events.guards.n_fired = 0
    m.run.rejected_switch += 1
    return take_again(m.run, length_of_piece(m.run, h), TOO_LONG)


@compiled
def length_of_piece(run, h):
    """How long the piece up to a crossing is as a step of its own."""
    return min(run.cut_at, MOST_KEPT) * h


@compiled
def is_rough(problem, run, point, guards, linear, h):
    """True if the dense output does not satisfy the equations at `cut_at`, where the step is to be cut.

    The error of a step is that of its end. A law may change much between the last stage before a crossing and the one
    after it, as friction does that rises while a contact comes to rest: beyond rest the law in force is mirrored, so
    all stages may lie beside the rise, and the piece of the step up to rest misses it.
    """
    find_defect(problem, point, linear, h, run.cut_at)
    return not weighted_norm(point, point.at_error_vector) <= ROUGH or limits_are_rough(problem, point, guards)


@compiled
def meets_stop(problem, guards):
    """True if a stop that takes any impulse is met."""
    met, fired = indices(problem.at_met_guard, problem.n_met_guards), indices(guards.at_fired, guards.n_guards)
    found = False
    for i in met:
        for k in range(guards.n_fired):
            found = found or fired[k] == i
    return found


@compiled
def limits_are_rough(problem, point, guards):
    """True if a force that comes to its limit is off by more than ROUGH of its own weight there.

    The weight of a force counts what is small beside the forces of the scene as nothing. A contact that holds no more
    than that would let go at any time; so its force is asked for a share of what it is at the larger end of the step.
    """
    fired, bounded = indices(guards.at_fired, guards.n_guards), indices(problem.at_bounded_row, guards.n_guards)
    limit, n = indices(guards.at_limit_guard, guards.n_guards), point.n
    y, y_end, error = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_error_vector, n)
    absolute, relative = reals(point.at_absolute, n), reals(point.at_relative, n)
    for k in range(guards.n_fired):
        row = bounded[fired[k]]
        if limit[fired[k]] == 1 and row >= 0:
            own = max(relative[row] * max(abs(y[row]), abs(y_end[row])), NEGLIGIBLE * absolute[row])
            if abs(error[row]) > ROUGH * own:
                return True
    return False


@compiled
def turns_at_limit(run, point, guards, h):
    """True if guards fired that were at their limits where zones were settled, and all are below at the end.

    The load of a spring that turns in the hand at the limit of its contact leaves it with no slope, and the interpolant
    of a long step is rougher than that. Of a shorter one it is not: the load goes with the square of the step.
    """
    ng = guards.n_guards
    g, end, tolerance = reals(guards.at_g, ng), reals(guards.at_g_end, ng), reals(guards.at_guard_tolerance, ng)
    fired, turns = indices(guards.at_fired, ng), guards.n_fired > 0 and run.adaptive == 1
    turns = turns and DOUBT * h >= dwell_here(run, point)
    for k in range(guards.n_fired):
        i = fired[k]
        turns = turns and abs(g[i]) <= tolerance[i] and end[i] < 0.0
    return turns


@compiled
def reject(m, h, status):
    """Shrink the step, and say whom it is due to; end the run at the step floor."""
    problem, run, point = m.problem, m.run, m.point
    indices(run.at_rejections_by_unknown, problem.n)[point.worst] += 1
    if status == SINGULAR:
        run.rejected_singular += 1
    elif isfinite(run.error):
        run.rejected_error += 1
    else:
        run.rejected_nan += 1
    take_again(run, step_after_rejection(run, h), TOO_LONG)
    if run.retried == REINITIALISE_AFTER and problem.n_algebraic > 0 and run.reinitialised == 0 and status != SINGULAR:
        reinitialise(m)
        return GO_ON
    if run.adaptive == 1 and run.h_next >= smallest_step(run, point):
        return GO_ON
    if status == SINGULAR:
        return not_finite_here(problem, run, point, SINGULAR_MATRIX)
    return STEP_FLOOR if isfinite(run.error) else not_finite_here(problem, run, point, NOT_FINITE)


@compiled
def reinitialise(m):
    """Make the point consistent by a settlement that fires nothing, once until the next accepted step.

    An algebraic unknown at the end of a step is right within the error of the step. Where it amplifies the
    others that may be many weights: the next step then begins with a jump that no shorter step makes smaller.
    """
    m.run.reinitialised = 1
    m.events.guards.n_fired = 0
    settle_at_start(m)
