"""A run in real time (`Run.real_time`): steps as long as frames of a clock, each with work that is bounded.

    frame k        from start + (k - 1) `fixed_step` to start + k `fixed_step`. A step ends with it; one that a time
                   event ends before it is followed by one for the rest
    solves         `most_solves` at most. If zones still switch then, the step is taken in the zones of its start, which
                   has as many solves again; the next one judges the same guards. If its equations are not solved then,
                   it ends with what the last solve has left
    taken again    what has no such end: no good pivots, a matrix that is singular, a number that is none, a law that
                   jumps. It is halved three times at most, then the run ends

Each is an overrun, counted once a step. Settled is in full: at the start, and at a time event that changes something.
No clock is read here: who keeps time with one is fairlead/pacing.py.
"""

from __future__ import annotations

from math import floor

from fairlead.integrate.codes import CAPPED, CYCLES, DIVERGES, DONE, EVEN, REPEATED, UNSETTLED, UNSOLVED
from fairlead.integrate.events.pace import propose
from fairlead.integrate.memory.foreign import compiled, indices
from fairlead.integrate.stepping.step_error import end_is_finite
from fairlead.integrate.stepping.theta_step import add_quadratures, give_back_zones, take_theta_step

MOST_HALVINGS = 3
"""Halvings of a step that has no end to go on with."""


@compiled
def propose_frame(run, point, rule):
    """The next trial step: to the end of the frame, or to what comes before."""
    if rule.trying == 1:
        note_overrun(point, rule, REPEATED, -1)
    begins_at_frame = rule.failed == 0 and rule.localising == 0
    frame_end = end_of_frame(run, point)
    if begins_at_frame:
        run.h_next = whole_frame(run, frame_end - point.t)
    h = propose(run, point)
    if begins_at_frame and run.landing == 0 and h == run.h_next:
        run.t_land, run.landing = frame_end, 1
    return whole_frame(run, h)


@compiled
def end_of_frame(run, point):
    """The end of the frame that the point is in, or begins."""
    return run.start + (floor((point.t - run.start) / run.fixed_step + EVEN) + 1.0) * run.fixed_step


@compiled
def whole_frame(run, h):
    """The length `h`, or that of a frame if it is one but for rounding: another would ask for other factors."""
    return run.fixed_step if abs(h - run.fixed_step) <= EVEN * run.fixed_step else h


@compiled
def end_in_time(m, h, status):
    """What a trial step comes to: one that is not solved in time ends otherwise, where that end is a number."""
    point, rule, guards = m.point, m.stepping.rule, m.events.guards
    rule.trying = 1
    if status not in (CAPPED, DIVERGES, CYCLES):
        return status
    if guards.n_fired > 0:
        note_overrun(point, rule, UNSETTLED, indices(guards.at_fired, guards.n_guards)[0])
        status = keep_zones(m, h)
        if status not in (CAPPED, DIVERGES):
            return status
    else:
        note_overrun(point, rule, UNSOLVED, point.worst)
    if not end_is_finite(point):
        return DIVERGES
    add_quadratures(m.problem, point, rule, h)
    return DONE


@compiled
def keep_zones(m, h):
    """Take the step in the zones of its start, implicit (theta = 1): those that were met on the way lead anywhere."""
    rule = m.stepping.rule
    give_back_zones(m.events.guards, m.stepping)
    rule.theta_now, rule.frozen = 1.0, 1
    status = take_theta_step(m, h)
    rule.frozen = 0
    return status


@compiled
def note_overrun(point, rule, how, at):
    """Count the step in hand, once; of the first it is kept when and why."""
    if rule.over == 0:
        rule.over = 1
        rule.overruns += 1
        if rule.overruns == 1:
            rule.t_overrun, rule.overrun_how, rule.overrun_at = point.t, how, at


@compiled
def is_too_late(run, rule):
    """True if a step of a run in real time was halved often enough."""
    return rule.most_solves > 0 and run.retried > MOST_HALVINGS
