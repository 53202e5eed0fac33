"""The method `stepping`: a trial step proposed, taken, its error estimated (step_error.py), accepted or repeated.

    attempt  zones and end of the step together        # the active set, theta_step.py
             or, where every step ends at its switch, the end in the zones of the start
             not solved, or an error above one: a shorter step
    arrive   zone changes go to the log, at the end of the step
    begin    after a settlement the slopes before are those of the settled point

A step is repeated, in the order in which these are looked for,

    in the zones of its end (`finish_inside`)         in the zones of its start (`finish_located`)
    a matrix without good pivots                      a matrix without good pivots
    a law that jumps at a limit the step reaches      an error above one
    zones, or an end, that are not found              a guard that fires at the start
    an error above one                                a switch inside, at which the end is too rough
    a switch inside, whose impulse would be missed

All but the first end in `take_again` (events/given_up.py), which alone sets the length of what follows; `repeat` gives
back the zones of the start before. Three things are not repeated here: the loop finds other pivots; it takes the step
with the whole problem where a machine changes that is shared with what rests (a rim); the start is settled where a law
jumps there, or where contacts that hold still slip.
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import (
    BUFFER_FULL,
    GO_ON,
    MIDDLE,
    REPLAN,
    SINGULAR_MATRIX,
    STEP_FLOOR,
    TRY,
    UNSETTLED,
    WIDEN,
)
from fairlead.integrate.events.arrival import arrive
from fairlead.integrate.events.given_up import TOO_FAR, TOO_LONG, settle_at_start, take_again
from fairlead.integrate.events.pace import accept, is_instant, not_finite_here, over_budget, propose, smallest_step
from fairlead.integrate.events.settling import log_changes
from fairlead.integrate.linear.systems import DONE, INACCURATE, SINGULAR
from fairlead.integrate.loop import Method
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals
from fairlead.integrate.one_step import cut_too_rough
from fairlead.integrate.point.controller import step_after_rejection
from fairlead.integrate.point.even_steps import FINE, rounded
from fairlead.integrate.point.stiff import mark_stiff
from fairlead.integrate.point.swings import judge_swings
from fairlead.integrate.stepping.dense_output import end_massless, hold_inside, show_inside
from fairlead.integrate.stepping.history import begin_history, choose_next_step, note_rejection, remember_slope
from fairlead.integrate.stepping.located_step import (
    ARRANGED,
    CUT,
    balance_end,
    judge_guards,
    remember_middle,
    stops_little,
)
from fairlead.integrate.stepping.passed_over import guards_are_passed
from fairlead.integrate.stepping.step_error import error_of_step, larger
from fairlead.integrate.stepping.switch_inside import impulse_is_missed, jump_is_due
from fairlead.integrate.stepping.theta_step import CYCLES, JUMPS, give_back_zones, take_theta_step
from fairlead.integrate.stepping.third_order import refine_end

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
THETA_RISE, THETA_FALL = 0.05, 0.9
"""theta rises by this when the zones of a step cycle; what it rose shrinks by this factor with every accepted one."""


@compiled
def attempt_stepping(m):
    """One trial step: repeated with a shorter one, or accepted to its end."""
    run, point, core, rule = m.run, m.point, m.linear.core, m.stepping.rule
    spent = over_budget(run, m.recorder)
    if spent != GO_ON:
        return spent
    if run.adaptive == 0 and rule.failed == 0 and rule.localising == 0:
        run.h_next = run.fixed_step
    h = propose(run, point)
    rule.instant = 0
    if is_instant(run, point, m.events.guards, h):
        m.events.settling.passes, rule.instant = 0, 1
        return GO_ON
    core.skip_meters = 1
    rule.theta_now = min(rule.least_theta + rule.theta_raise, 1.0)
    if point.t < rule.t_bent < point.t + h:
        h = over_kink(run, point, rule, h)
    run.h = h
    status = take_theta_step(m, h)
    core.skip_meters = 0
    if status == INACCURATE:
        return find_pivots(m, h)
    rule.replanned = 0
    return finish_located(m, h) if status == DONE and rule.locates == 1 else finish_inside(m, h, status)


@compiled
def finish_inside(m, h, status):
    """The rest of a step in the zones of its end, and of one of either kind that was not solved.

    It is repeated, or accepted to its end.
    """
    problem, run, point, linear, guards = m.problem, m.run, m.point, m.linear, m.events.guards
    settling, stepping, rule, exchange = m.events.settling, m.stepping, m.stepping.rule, m.stepping.exchange
    if status == JUMPS or (status == DONE and jump_is_due(m, h)):
        if jump_at_start(run, point, rule):
            return settle_jump(m)
        if not ends_at_jump(m, h):
            return end_at_switch(m, min(rule.t_cut - point.t, h), TOO_FAR)
        if status == JUMPS:
            status = solve_in_zones(m, h)
            if status == INACCURATE:
                return find_pivots(m, h)
    if status != DONE:
        return halve_unsolved(m, h, status)
    if run.narrowed == 1 and settling.passes > 0 and rim_changed(settling, m.stepping.contacts):
        give_back_zones(guards, stepping)
        return WIDEN
    if rule.theta_now == MIDDLE:
        refine_end(problem, point, linear, stepping, h)
    run.error = error_of_step(m, h)
    judge_swings(problem, run, point, h)
    if not isfinite(run.error) or (run.adaptive == 1 and run.error > 1.0):
        return reject_error(m, h)
    if goes_past_switch(m, h):
        blame(run, point)
        return end_at_switch(m, rounded(rule.t_cut - point.t, FINE), TOO_LONG)
    if exchange.massless == 1:
        end_massless(problem, point, linear, exchange, h)
    accept_step(m, h)
    return GO_ON


@compiled
def finish_located(m, h):
    """The rest of a step in the zones of its start: judged, repeated, or accepted up to the first switch inside."""
    problem, run, point, recorder, rule = m.problem, m.run, m.point, m.recorder, m.stepping.rule
    if rule.gap == 0.0 and stops_little(m):
        return settle_at_start(m)
    run.error = end_located(m, h)
    judge_swings(problem, run, point, h)
    if not isfinite(run.error) or run.error > 1.0:
        return reject_error(m, h)
    hold_inside(m)
    verdict = judge_guards(m, h)
    if verdict == ARRANGED or (verdict == CUT and run.cut_at < 1.0 and cut_too_rough(m, h)):
        return GO_ON
    recorder.any_stiff = mark_stiff(problem, m.linear.matrices, recorder, h)
    rule.failed = max(rule.failed - 1, 0)
    recorder.meters_off = 1 if problem.n_quadratures > 0 else 0
    repeated = run.retried > 0
    accept(m, h, verdict == CUT)
    choose_next_step(run, rule, h, repeated)
    remember_middle(point, rule, h)
    show_inside(m)
    return GO_ON


@compiled
def end_located(m, h):
    """Move the end of a step by the error of its rule, and to where laws balance; the size of its error."""
    problem, point, linear, exchange = m.problem, m.point, m.linear, m.stepping.exchange
    refine_end(problem, point, linear, m.stepping, h)
    error = error_of_step(m, h)
    if error <= 1.0:
        worst = point.worst
        error = larger(point, error, worst, balance_end(m, h))
    if exchange.massless == 1:
        end_massless(problem, point, linear, exchange, h)
    return error


@compiled
def over_kink(run, point, rule, h):
    """The step over a kink that the one before ended short of: as long again behind it, and implicit (theta = 1).

    What follows a surface by a stiff law has to follow the new piece from the end of this step on. The midpoint rule
    would leave a third of the difference at its start ringing, which is nothing as a speed and much as a force.
    """
    rule.theta_now = 1.0
    over = min(2.0 * (rule.t_bent - point.t), h)
    if run.adaptive == 0 or over < smallest_step(run, point):
        return h
    if over < h:
        run.landing = 0
    return over


@compiled
def accept_step(m, h):
    """To the end of the step; how long the next is."""
    run, recorder, rule = m.run, m.recorder, m.stepping.rule
    recorder.any_stiff = mark_stiff(m.problem, m.linear.matrices, recorder, h)
    rule.failed = max(rule.failed - 1, 0)
    rule.theta_raise = THETA_FALL * rule.theta_raise if rule.theta_raise > 1e-3 else 0.0
    repeated = run.retried > 0
    accept(m, h, False)
    if run.adaptive == 1:
        choose_next_step(run, rule, h, repeated)
    show_inside(m)
    if rule.localising > 0:
        run.crossed = 1
        m.events.guards.n_fired = 0
        rule.localising = 0


@compiled
def repeat(m, length, why):
    """Have the step taken again from its start, in the zones it had there, `length` long."""
    give_back_zones(m.events.guards, m.stepping)
    return take_again(m.run, length, why)


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
    repeat(m, step_after_rejection(run, h), TOO_LONG)
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
        return repeat(m, h, TOO_LONG)
    rule.failed = rule.failed + 2 if run.adaptive == 1 else 2 * max(rule.failed, 1)  # halves to go, if fixed
    if status == CYCLES:
        rule.theta_raise = min(rule.theta_raise + THETA_RISE, 0.5)
    repeat(m, 0.5 * h, TOO_LONG)
    if run.h_next >= smallest_step(run, point):
        return GO_ON
    if status == CYCLES:
        return UNSETTLED
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
def find_pivots(m, h):
    """After a matrix without good pivots: a shorter step if it was met midway, else, or in vain, other pivots."""
    rule = m.stepping.rule
    if rule.midway == 1 and (rule.replanned == 1 or m.run.retried < HALVINGS):
        rule.replanned = 0
        return halve_unsolved(m, h, SINGULAR)
    give_back_zones(m.events.guards, m.stepping)
    return REPLAN


@compiled
def end_at_switch(m, length, why):
    """Repeat a step so that it ends at a switch, at `t_cut`: all cuts of steps with switches inside come here."""
    m.run.rejected_switch += 1
    return repeat(m, length, why)


@compiled
def goes_past_switch(m, h):
    """True if the step has to end at `t_cut`; a fixed one never has."""
    run, point = m.run, m.point
    if run.adaptive == 0:
        return False
    if m.stepping.contacts.n_switched > 0 and impulse_is_missed(m.problem, point, m.linear.matrices, m.stepping, h):
        if run.retried >= TRIES:
            m.stepping.rule.t_cut = point.t + 0.5 * h
        return True
    return guards_are_passed(m, h)


@compiled
def jump_at_start(run, point, rule):
    """True if a law jumps where the step begins: no step could end there."""
    return rule.t_cut - point.t <= max(1e-9 * (run.stop - run.start), smallest_step(run, point))


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
def ends_at_jump(m, h):
    """True if the step ends where a law jumps, in the zones of its start; else `t_cut` says where it is to end."""
    point, rule = m.point, m.stepping.rule
    often = rule.localising >= TRIES
    if m.events.settling.passes > 0:
        if often:
            rule.t_cut = point.t + 0.5 * h
    elif often or (rule.localising > 0 and abs(rule.t_cut - point.t - h) <= AT_PLACE * h):
        give_back_zones(m.events.guards, m.stepping)
        return True
    rule.localising += 1
    return False


@compiled
def solve_in_zones(m, h):
    """Take the step that ends at a jump once more, in the zones of its start: it was given up there, not yet solved."""
    core, rule = m.linear.core, m.stepping.rule
    core.skip_meters, rule.frozen = 1, 1
    status = take_theta_step(m, h)
    core.skip_meters, rule.frozen = 0, 0
    return status


@compiled
def rim_changed(settling, contacts):
    """True if the step changed a machine that keeps the rest of the problem at rest."""
    zones, before = indices(settling.at_zones, settling.n_zones), indices(contacts.at_zones_at_start, settling.n_zones)
    rim, found = indices(settling.at_rim, settling.n_zones), False
    for z in range(settling.n_zones):
        found = found or (rim[z] == 1 and zones[z] != before[z])
    return found


@compiled
def arrive_with_zones(m):
    """Log the zones the step changed, then arrive at its end."""
    problem, run, guards, settling, recorder = m.problem, m.run, m.events.guards, m.events.settling, m.recorder
    if recorder.rows + 4 > recorder.row_capacity:
        return BUFFER_FULL
    switched = settling.passes > 0
    if switched:
        m.point.t = run.t_piece
        at_start = indices(m.stepping.contacts.at_zones_at_start, problem.n_zones)
        copy(at_start, indices(settling.at_zones_before, problem.n_zones))
        guards.n_fired = 0
        settling.passes = 0
        log_changes(m)
    copy(reals(guards.at_g, problem.n_guards), reals(guards.at_g_early, problem.n_guards))
    if problem.samples == 1 and run.landing == 1 and run.t_piece >= run.t_next and run.t_piece < run.stop:
        run.crossed = 1  # settled before the sample is taken: forces are those of the middle of the step until then
        guards.n_fired = 0
    status = arrive(m, False)  # at a cut forces are on the line between the ends; the settlement there corrects them
    if run.phase == TRY and m.stepping.rule.instant == 0:
        remember_slope(run, m.stepping)
    return status


@compiled
def begin_again(m):
    """After a settlement nothing is known of the steps before."""
    begin_history(m.run, m.point, m.linear.matrices, m.stepping)


METHOD = Method(attempt_stepping, arrive_with_zones, begin_again)
