"""Step sizes of the stepping engine: kept as long as they serve.

The error of a step in which a contact is caught or lets go is another than that of the next. Steps that follow it have
a new length every time, so new factors, and many are repeated: a chain of 1000 blocks at accuracy 1e-6 took 7033
steps of 4057 lengths, and 1017 were repeated; it is 4172 and 64. What counts for the motion as a whole is their mean
length: a chain of 100 reaches an error of 1e-4 with steps of one length in the time it takes with the best others. So

    allowed     the shortest of what the last steps allowed: those of this block of steps, and of the one before
    next        the last, unless what is allowed is shorter, or LONGER times as long
"""

from __future__ import annotations

from math import inf

from fairlead.integrate.memory.foreign import compiled
from fairlead.integrate.point.controller import SAFETY, SHRINK_LIMIT
from fairlead.integrate.point.even_steps import COARSE, rounded

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
def keep_step(run, rule, h, repeated):
    """Into `h_next` the step after an accepted one of length h; right after a repeated one it does not grow."""
    if rule.block_steps == BLOCK:
        rule.allowed_before, rule.allowed, rule.block_steps = rule.allowed, inf, 0
    rule.block_steps += 1
    now = rounded(SAFETY * h * max(run.error, NO_ERROR) ** -run.error_exponent, COARSE)
    if run.error > SEEN:
        rule.allowed = min(rule.allowed, now)
    allowed = min(now, min(rule.allowed, rule.allowed_before))
    last = max(h, run.h_wanted)  # a step clipped to a time event says nothing about the next
    if allowed < SAFETY * last:
        run.h_next = max(allowed, SHRINK_LIMIT * last)
    elif allowed > LONGER * last and not repeated:
        run.h_next = min(allowed, MOST_GROWTH * last)
    else:
        run.h_next = last


@compiled
def forget_steps(rule):
    """After a settlement: what was allowed before says nothing."""
    rule.allowed, rule.allowed_before, rule.block_steps = inf, inf, 0


@compiled
def note_rejection(run, rule):
    """The step that follows a rejection is the longest for a while."""
    rule.allowed = min(rule.allowed, run.h_next)
