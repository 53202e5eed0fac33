"""How long the next step is to be, and what becomes of one that is accepted: the same for all methods.

What control wants, `h_next`, is set in three places: after an accepted step in `end_attempts`, of one that is to be
taken again in `given_up.take_again`, and of the first after a settlement in `arrival.first_step`. The first and the
last ask the method (loop.py).
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import ARRIVE, GO_ON, MAX_EVENTS, MAX_STEPS, NOT_FINITE, RECORD
from fairlead.integrate.events.growth import shorten_for_growth
from fairlead.integrate.memory.foreign import compiled, copy, field_at, reals
from fairlead.integrate.point.controller import smallest_step, step_after_acceptance
from fairlead.integrate.point.interpolant import interpolate
from fairlead.integrate.point.quadratures import integrate_quadratures

DOUBT = 0.1
"""How much shorter a step is tried when a guard that falls by the slopes at the point, where the zones were just
settled, does not in the step: the interpolant of a long step is rough at its start. To settle there again
would change nothing, and the next step be as long."""
NEARLY_THERE = 0.99
"""Share of the way to a time event from which on a step that control wants goes all of it: no other could follow."""
INSTANT = 1e-13
"""Share of the time, or of the span, below which two time events are one: in a step as short matrices are rounding."""


@compiled
def over_budget(run, recorder):
    """GO_ON, or which budget is used up."""
    if run.steps >= run.max_steps:
        return MAX_STEPS
    return MAX_EVENTS if recorder.total_events >= run.max_events else GO_ON


@compiled
def propose(run, point):
    """The next step size: what control wants, clipped to land on the next time event or the stop."""
    run.t_land = min(run.stop, min(run.t_next, run.t_release))
    if run.stop - run.t_land <= INSTANT * max(abs(run.stop), run.stop - run.start):
        run.t_land = run.stop  # no step could cover what would be left
    rest = run.t_land - point.t
    h = shorten_for_growth(run, point, min(run.h_next, run.max_step))
    run.h_wanted = h
    run.landing = 0
    if h >= rest * (NEARLY_THERE if run.adaptive == 1 else 1.0 - 1e-9):
        run.landing = 1
        return rest
    if run.adaptive == 1 and h > 0.5 * rest:
        return 0.5 * rest
    return h


@compiled
def is_instant(run, point, h):
    """True if the next time event is this very instant but for rounding: nothing moves until then."""
    return run.landing == 1 and run.t_land < run.stop and not h > INSTANT * max(abs(point.t), run.stop - run.start)


@compiled
def arrive_at_instant(run, point, guards):
    """Arrive at a time event that is this very instant, without a step."""
    run.crossed = 0
    run.t_piece = run.t_land
    copy(reals(point.at_y, point.n), reals(point.at_y_piece, point.n))
    copy(reals(point.at_y, point.n), reals(point.at_y_end, point.n))
    copy(reals(guards.at_g, guards.n_guards), reals(guards.at_g_end, guards.n_guards))
    run.phase = ARRIVE


@compiled
def not_finite_here(problem, run, point, otherwise):
    """NOT_FINITE, with the unknown in `worst`, if f is not finite here or a step later; else `otherwise`.

    The trial itself does not tell whose law it was: one nan spreads to all unknowns in the first solve.
    """
    for fraction in range(2):
        field_at(problem.call_rhs, (problem.context, point.t + fraction * run.h, point.at_y, point.at_f))
        f = reals(point.at_f, problem.n)
        for k in range(problem.n):
            if not isfinite(f[k]):
                point.worst = k
                return NOT_FINITE
    return otherwise


@compiled
def accept(m, h, crossed):
    """Set the piece of the trial that is accepted: up to the crossing, or to the end; the loop ends its attempts."""
    run, point, recorder = m.run, m.point, m.recorder
    run.steps += 1
    run.partial_steps += run.is_part
    run.crossed = 1 if crossed else 0
    if crossed and run.cut_at < 1.0:
        run.t_piece = point.t + run.cut_at * h
        if run.landing == 1 and run.t_land - run.t_piece < smallest_step(run, point):
            run.t_piece = run.t_land  # no step could cover what would be left
        else:
            run.landing = 0
        interpolate(point, run.cut_at, point.at_y_piece)
        if recorder.quadratures_off == 1:
            integrate_quadratures(m, h)
    else:
        run.t_piece = run.t_land if run.landing == 1 else point.t + h
        copy(reals(point.at_y_end, point.n), reals(point.at_y_piece, point.n))
        if recorder.quadratures_off == 1:
            run.cut_at = 1.0
            integrate_quadratures(m, h)
    run.phase = RECORD


@compiled
def length_by_control(m):
    """The length of the step after an accepted one by PI control; one that was clipped to a time event says nothing."""
    run = m.run
    wanted = step_after_acceptance(run, run.h)
    return max(wanted, run.h_wanted) if run.h < run.h_wanted else wanted


@compiled
def end_attempts(run, length):
    """After an accepted step the next is to have this length, unless it is fixed."""
    if run.adaptive == 1:
        run.h_next = length
    run.last_error = max(run.error, 1e-4)
    run.retried = 0
    run.reinitialised = 0
