"""What is remembered from step to step: slopes, through how many steps a row has held, the length that served.

Step sizes are kept as long as they serve. The error of a step in which a contact is captured or lets go is another than
that of the next. Steps that follow it have a new length every time, so new factors, and many are repeated: a chain of
1000 blocks at accuracy 1e-6 took 7033 steps of 4057 lengths, and 1017 were repeated; it is 4172 and 64. What counts for
the motion as a whole is their mean length: a chain of 100 reaches an error of 1e-4 with steps of one length in the time
it takes with the best others. So

    allowed     the shortest of what the last steps allowed: those of this block of steps, and of the one before
    next        the last, unless what is allowed is shorter, or LONGER times as long
"""

from __future__ import annotations

from math import inf

from fairlead.integrate.memory.foreign import compiled, copy, indices, reals
from fairlead.integrate.point.controller import SAFETY, SHRINK_LIMIT
from fairlead.integrate.point.even_steps import COARSE, rounded
from fairlead.integrate.stepping.limit_violation import HELD_THROUGH
from fairlead.integrate.stepping.row_cache import forget_jacobian, forget_rows

BLOCK = 5
"""Steps of a block: what a step allowed is remembered for as many to twice as many."""
LONGER = 1.3
"""A step that may grow by less than this is kept, and the factors of its matrix with it."""
MOST_GROWTH = 2.0
"""Longer than this times the last no step is, whatever is allowed."""
SEEN = 1e-2
"""A step with less error than this was short for another reason, as to end at a switch; it is not remembered."""
NO_ERROR = 1e-10
"""An error below this allows what this allows."""


@compiled
def choose_next_step(run, rule, h, repeated):
    """The length of the step after an accepted one of length h. Right after a repeated step it does not grow."""
    if rule.block_steps == BLOCK:
        rule.allowed_before, rule.allowed, rule.block_steps = rule.allowed, inf, 0
    rule.block_steps += 1
    now = rounded(SAFETY * h * max(run.error, NO_ERROR) ** -run.error_exponent, COARSE)
    if run.error > SEEN:
        rule.allowed = min(rule.allowed, now)
    allowed = min(now, min(rule.allowed, rule.allowed_before))
    last = max(h, run.h_wanted)  # a step clipped to a time event says nothing about the next
    if allowed < SAFETY * last:
        return max(allowed, SHRINK_LIMIT * last)
    if allowed > LONGER * last and not repeated:
        return min(allowed, MOST_GROWTH * last)
    return last


@compiled
def forget_steps(rule):
    """After a settlement: what was allowed before says nothing."""
    rule.allowed, rule.allowed_before, rule.block_steps = inf, inf, 0


@compiled
def note_rejection(run, rule):
    """The step that follows a rejection is the longest for a while."""
    rule.allowed = min(rule.allowed, run.h_next)


@compiled
def remember_slope(run, stepping):
    """After an accepted step: its slope becomes the one before."""
    rule = stepping.rule
    copy(reals(rule.at_slope_before, rule.n), reals(rule.at_slope_earlier, rule.n))
    copy(reals(rule.at_mean_slope, rule.n), reals(rule.at_slope_before, rule.n))
    rule.gap_before = rule.gap + 0.5 * run.h
    rule.gap = 0.5 * run.h
    count_rest(stepping)


@compiled
def count_rest(stepping):
    """After an accepted step: through how many each row has held."""
    exchange = stepping.exchange
    rested, holds = indices(stepping.contacts.at_rested, exchange.n), indices(exchange.at_holds, exchange.n)
    for k in range(exchange.n):
        rested[k] = rested[k] + 1 if holds[k] == 1 else 0


@compiled
def begin_history(run, point, stepping):
    """After a settlement: the slopes before are those of the consistent point, now and a little earlier."""
    rule, n = stepping.rule, point.n
    slope, curvature = reals(point.at_slope, n), reals(point.at_curvature, n)
    before, earlier = reals(rule.at_slope_before, n), reals(rule.at_slope_earlier, n)
    differential = indices(point.at_differential, n)
    forget_jacobian(rule)
    forget_rows(stepping.exchange)
    rule.failed = 0
    begin_rest(stepping.contacts)
    forget_steps(rule)
    rule.gap = 0.0
    rule.gap_before = min(run.h_next, run.max_step)
    for k in range(n):
        before[k] = slope[k] if differential[k] == 1 else curvature[k]
        earlier[k] = before[k] - rule.gap_before * curvature[k] if differential[k] == 1 else 0.0


@compiled
def begin_rest(contacts):
    """After a settlement the slopes of all forces are known."""
    rested = indices(contacts.at_rested, contacts.n)
    for k in range(contacts.n):
        rested[k] = HELD_THROUGH
