"""What has a step of `stepping` taken again, and with which length; or settled at its start; or with other pivots.

    an error above one              shorter, by the error                         `reject_error`
    not solved, or zones cycle      half of it, or the same without predictions   `halve_unsolved`
    no good pivots                  half of it, or with other pivots              `halve_or_replan`
    a law that jumps                up to the jump, by event localisation         `localise_jump`, `end_at_switch`
                                    a settlement where it jumps at the start      `settle_jump`
    a relay that switches at once   a settlement at the start, then steps that
                                    end at the next switch                        `find_latch_ahead`
    a switch whose impulse counts   up to the switch                              `find_switch_passed`, `end_at_switch`

All but the pivots and the settlement end in `take_again` (events/given_up.py), which alone sets the length of what
follows; `repeat` gives back the zones of the start before. Not here is what steps that end at every switch share with
`rodas`: the piece up to a switch as a step of its own (one_step.take_piece), and the rule of inconsistent starts
(given_up.settle_inconsistent_start).
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import CYCLES, GO_ON, NOT_SETTLED, REPLAN, SINGULAR, SINGULAR_MATRIX, STEP_FLOOR
from fairlead.integrate.events.chatter import still_for
from fairlead.integrate.events.given_up import TOO_LONG, settle_at_start, take_again
from fairlead.integrate.events.pace import not_finite_here
from fairlead.integrate.memory.foreign import compiled, indices
from fairlead.integrate.point.controller import smallest_step, step_after_rejection
from fairlead.integrate.stepping.frames import is_too_late
from fairlead.integrate.stepping.history import note_rejection
from fairlead.integrate.stepping.jump_at_end import keep_at_limit, keep_due
from fairlead.integrate.stepping.passed_over import find_passed_guard
from fairlead.integrate.stepping.switch_inside import AT_ONCE, find_missed_impulse, latch_switched
from fairlead.integrate.stepping.theta_step import give_back_zones

HALVINGS = 3
"""Halvings of a step whose iteration met a matrix without good pivots, before others are asked for: mostly it had
gone astray, and pivots good for such a matrix fail for those that are met otherwise. The first guess of the end is off
by h^2 y''/2, so after three halvings it is 64 times nearer: what still meets such a matrix did not go astray."""
TRIES = 4
"""Tries after which a step is no longer cut at the instant that is told for a switch: one that ends at a jump, in the
zones of its start, is accepted as it is; others are halved. (What ends at an impulse that is missed counts all that was
repeated in a row for being too long.) The line through two middles misses the instant, and each try leaves of the miss
a quarter of the share by which the rate of the load changes on the way there. Four tries come within AT_PLACE where
that share is below 0.7."""
AT_PLACE = 1e-3
"""Share of a step by which it may end beside the instant of a jump. Of what it misses there, s J h/m, no more is left
than of its equations (residual.SOLVED)."""
BEGINNING = 1e-9
"""Share of the run at which a jump counts as one where the step begins, if nothing moves by then."""
SETTLED_AHEAD = 2
"""Settlements until switches are inside steps again: that just before a relay switches, and that where it does."""
THETA_RISE, THETA_FALL, THETA_LEAST = 0.05, 0.9, 1e-3
"""theta rises by this when the zones of a step cycle; what it rose shrinks by this factor with every accepted one,
and is nothing from the last on."""


@compiled
def repeat(run, guards, stepping, length, why):
    """Have the step taken again from its start, in the zones it had there, `length` long."""
    give_back_zones(guards, stepping)
    return take_again(run, length, why)


@compiled
def blame(run, point):
    """Count the unknown whose error has the step taken again."""
    if point.worst >= 0:
        indices(run.at_rejections_by_unknown, point.n)[point.worst] += 1


@compiled
def reject_error(m, h):
    """Repeat a step whose error is too large, by the error; a fixed one ends the run."""
    run, point = m.run, m.point
    if isfinite(run.error):
        run.rejected_error += 1
        blame(run, point)
    else:
        run.rejected_nan += 1
    repeat(run, m.events.guards, m.stepping, step_after_rejection(run, h), TOO_LONG)
    if run.adaptive == 0:
        return not_finite_here(m.problem, run, point, STEP_FLOOR)
    note_rejection(run, m.stepping.rule)
    return GO_ON if run.h_next >= smallest_step(run, point) else STEP_FLOOR


@compiled
def halve_unsolved(m, h, status):
    """Halve a step whose zones cycle or whose iteration fails; end the run at the step floor."""
    run, point, rule = m.run, m.point, m.stepping.rule
    count_unsolved(run, status)
    if status == CYCLES and m.stepping.contacts.expecting == 1:
        rule.failed += 1  # the same step again, without guessing
        return repeat(run, m.events.guards, m.stepping, h, TOO_LONG)
    rule.failed = rule.failed + 2 if run.adaptive == 1 else 2 * max(rule.failed, 1)  # halves to go, if fixed
    if status == CYCLES:
        rule.theta_raise = min(rule.theta_raise + THETA_RISE, 0.5)
    repeat(run, m.events.guards, m.stepping, 0.5 * h, TOO_LONG)
    if run.h_next >= smallest_step(run, point) and not is_too_late(run, rule):
        return GO_ON
    if status == CYCLES:
        return NOT_SETTLED
    return not_finite_here(m.problem, run, point, SINGULAR_MATRIX if status == SINGULAR else STEP_FLOOR)


@compiled
def count_unsolved(run, status):
    """Count a step that was not solved, by its cause."""
    if status == CYCLES:
        run.rejected_cycling += 1
    elif status == SINGULAR:
        run.rejected_singular += 1
    else:
        run.rejected_diverged += 1


@compiled
def halve_or_replan(m, h):
    """After a matrix without good pivots: a shorter step if it was met midway, else, or in vain, other pivots."""
    rule = m.stepping.rule
    if rule.midway == 1 and (rule.replanned == 1 or m.run.retried < HALVINGS):
        rule.replanned = 0
        return halve_unsolved(m, h, SINGULAR)
    give_back_zones(m.events.guards, m.stepping)
    return REPLAN


@compiled
def jump_at_start(run, point, rule):
    """True if a law jumps where the step begins: no step could end there."""
    return rule.t_cut <= end_of_start(run, point)


@compiled
def end_of_start(run, point):
    """The instant up to which a jump is one where the step begins."""
    early = min(BEGINNING * (run.stop - run.start), still_for(point))
    return point.t + max(early, smallest_step(run, point))


@compiled
def due_at_start(m, h):
    """True if a law jumps where the step begins; its guards are left in `fired`, without those due later in the step.

    Where zones have switched in the step, its end is that of zones that were given up, and may be anywhere: by such a
    line a body at 0.05 m/s has come to rest after 1e-8 s. So only what is at its limit at the start is due there, and
    the step is halved, as long as it is longer than what counts as its start. A step of fixed length is settled, since
    in real time its work is bounded.
    """
    run, point, guards, rule = m.run, m.point, m.events.guards, m.stepping.rule
    if not jump_at_start(run, point, rule):
        return False
    if m.events.settling.passes == 0:
        keep_due(point, guards, m.stepping.contacts, rule, h, end_of_start(run, point))
        return True
    if point.t + 0.5 * h <= end_of_start(run, point) or run.adaptive == 0:
        return True
    keep_at_limit(guards)
    rule.t_cut = point.t + 0.5 * h
    return guards.n_fired > 0


@compiled
def settle_jump(m):
    """Settle at the start of the step, on the guards in `fired` where laws jump."""
    guards, fire = m.events.guards, m.events.guards.n_fired
    give_back_zones(guards, m.stepping)
    guards.n_fired = fire
    m.run.rejected_switch += 1
    m.stepping.rule.localising = 0
    return settle_at_start(m)


@compiled
def localise_jump(point, guards, settling, stepping, h):
    """True if the step ends where a law jumps; it has the zones of its start then. Else `t_cut` is where it should."""
    rule = stepping.rule
    often = rule.localising >= TRIES
    if settling.passes > 0:
        if often:
            rule.t_cut = point.t + 0.5 * h
    elif often or (rule.localising > 0 and abs(rule.t_cut - point.t - h) <= AT_PLACE * h):
        give_back_zones(guards, stepping)
        return True
    rule.localising += 1
    return False


@compiled
def find_switch_passed(m, h):
    """True if the step passes a switch that counts, and has to end there, at `t_cut`; a fixed one never has."""
    run, point = m.run, m.point
    if run.adaptive == 0:
        return False
    if m.stepping.contacts.n_switched > 0 and find_missed_impulse(m, h):
        if run.retried >= TRIES:
            m.stepping.rule.t_cut = point.t + 0.5 * h
        return True
    return find_passed_guard(m, h)


@compiled
def find_latch_ahead(run, guards, stepping):
    """True if a relay or the like switches just ahead: the start is settled, and steps end at the next switch."""
    near = 1.0 if run.retried >= TRIES else AT_ONCE  # what reads a mean may be due before the start, and never near
    if run.adaptive == 0 or not latch_switched(stepping.contacts, near):
        return False
    run.rejected_switch += 1
    give_back_zones(guards, stepping)
    stepping.rule.locates_for = SETTLED_AHEAD
    return True


@compiled
def end_at_switch(run, guards, stepping, length, why):
    """Repeat a step so that it ends at a switch, at `t_cut`: all cuts of steps with switches inside come here."""
    run.rejected_switch += 1
    return repeat(run, guards, stepping, length, why)
