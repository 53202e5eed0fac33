"""The method `stepping`: a trial step proposed, taken, its error estimated (step_error.py), accepted or repeated.

    attempt  zones and end of the step together        # the active set, theta_step.py
             or, where every step ends at its switch, the end in the zones of the start
             not solved, or an error above one: a shorter step
    arrive   zone changes go to the log, at the end of the step
    settled  after a settlement the slopes before are those of the settled point

A step is repeated, in the order in which these are looked for,

    in the zones of its end (`finish_inside`)         in the zones of its start (`finish_located`)
    a matrix without good pivots                      a matrix without good pivots
    a law that jumps at a limit the step reaches      an end that is not found (by `finish_inside`)
    zones, or an end, that are not found              contacts that hold and slip at the start: that is settled
    an error above one                                an error above one
    a relay that switches right at the start:         a guard that was above zero from the start: that is settled
        that is settled, and steps end at switches    a switch inside, at which the interpolant is too rough
    a switch inside, whose impulse would be missed

repeated.py does that; the last two on the right are as of `rodas` (events/given_up.py, one_step.py). In three cases it
is no shorter step that follows: the loop finds other pivots; it takes the step with the whole problem where a machine
changes that is shared with what rests (a boundary); the start is settled, also where a law jumps there.
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import BUFFER_FULL, DONE, GO_ON, INACCURATE, JUMPS, MIDDLE, REACTIVATE, TRY
from fairlead.integrate.events.arrival import arrive
from fairlead.integrate.events.crossing import CROSSING, INCONSISTENT_START, find_first_crossing
from fairlead.integrate.events.given_apart import judge_given
from fairlead.integrate.events.given_up import TOO_FAR, TOO_LONG, settle_at_start, settle_inconsistent_start
from fairlead.integrate.events.pace import accept, arrive_at_instant, is_instant, over_budget, propose
from fairlead.integrate.loop import Method
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals
from fairlead.integrate.one_step import piece_is_rough, take_piece
from fairlead.integrate.point.controller import smallest_step
from fairlead.integrate.point.even_steps import FINE, rounded
from fairlead.integrate.point.stiff import mark_stiff
from fairlead.integrate.point.swings import judge_swings
from fairlead.integrate.stepping.dense_output import end_algebraic_speeds, hold_inside, show_inside
from fairlead.integrate.stepping.frames import end_in_time, propose_frame
from fairlead.integrate.stepping.history import begin_history, choose_next_step, remember_slope
from fairlead.integrate.stepping.jump_at_end import find_due_jump
from fairlead.integrate.stepping.located_step import CAREFUL, balance_end, holds_with_slip, remember_middle, stop_slip
from fairlead.integrate.stepping.repeated import (
    THETA_FALL,
    THETA_LEAST,
    blame,
    due_at_start,
    end_at_switch,
    find_latch_ahead,
    find_switch_passed,
    halve_or_replan,
    halve_unsolved,
    localise_jump,
    reject_error,
    settle_jump,
)
from fairlead.integrate.stepping.step_error import find_error, keep_larger
from fairlead.integrate.stepping.switch_inside import log_inside
from fairlead.integrate.stepping.theta_step import give_back_zones, take_theta_step
from fairlead.integrate.stepping.third_order import refine_end


@compiled
def attempt_stepping(m):
    """One trial step: repeated with a shorter one, or accepted to its end."""
    run, point, rule = m.run, m.point, m.stepping.rule
    spent = over_budget(run, m.recorder)
    if spent != GO_ON:
        return spent
    if run.adaptive == 0 and rule.failed == 0 and rule.localising == 0:
        run.h_next = run.fixed_step
    h = propose_frame(run, point, rule) if rule.most_solves > 0 else propose(run, point)
    rule.instant = 0
    if is_instant(run, point, h):
        arrive_at_instant(run, point, m.events.guards)
        m.events.settling.passes, rule.instant = 0, 1
        return GO_ON
    rule.theta_now = min(rule.least_theta + rule.theta_raise, 1.0)
    if point.t < rule.t_kink < point.t + h:
        h = step_over_kink(run, point, rule, h)
    run.h = h
    status = take_theta_step(m, h)
    if rule.most_solves > 0:
        status = end_in_time(m, h, status)
    if status == INACCURATE:
        return halve_or_replan(m, h)
    rule.replanned = 0
    return finish_located(m, h) if status == DONE and rule.locates == 1 else finish_inside(m, h, status)


@compiled
def finish_inside(m, h, status):
    """The rest of a step in the zones of its end, and of one of either kind that was not solved.

    It is repeated, or accepted to its end.
    """
    problem, run, point, linear, guards = m.problem, m.run, m.point, m.linear, m.events.guards
    settling, stepping, rule, exchange = m.events.settling, m.stepping, m.stepping.rule, m.stepping.exchange
    if status == JUMPS or (status == DONE and find_due_jump(m, h)):
        if due_at_start(m, h):
            return settle_jump(m)
        if not localise_jump(point, guards, settling, stepping, h):
            return end_at_switch(run, guards, stepping, min(rule.t_cut - point.t, h), TOO_FAR)
        if status == JUMPS:
            status = solve_in_zones(m, h)
            if status == INACCURATE:
                return halve_or_replan(m, h)
    if status != DONE:
        return halve_unsolved(m, h, status)
    if run.is_part == 1 and settling.passes > 0 and boundary_changed(settling, m.stepping.contacts):
        give_back_zones(guards, stepping)
        return REACTIVATE
    if rule.theta_now == MIDDLE:
        refine_end(problem, point, linear, stepping, h)
    run.error = find_error(m, h)
    judge_given(m, h)
    judge_swings(problem, run, point, h)
    if not isfinite(run.error) or (run.adaptive == 1 and run.error > 1.0):
        return reject_error(m, h)
    if find_latch_ahead(run, guards, stepping):
        return settle_at_start(m)
    if find_switch_passed(m, h):
        blame(run, point)
        return end_at_switch(run, guards, stepping, rounded(rule.t_cut - point.t, FINE), TOO_LONG)
    if exchange.algebraic_speeds == 1:
        end_algebraic_speeds(problem, point, linear, exchange, h)
    accept_step(m, h, False)
    show_inside(m)
    if rule.localising > 0:
        settle_at_end(run, guards, stepping)
    return GO_ON


@compiled
def finish_located(m, h):
    """The rest of a step in the zones of its start: judged, repeated, or accepted up to the first switch inside."""
    problem, run, point, recorder, rule = m.problem, m.run, m.point, m.recorder, m.stepping.rule
    if rule.gap == 0.0 and holds_with_slip(m):
        stop_slip(m)
        return settle_at_start(m)
    run.error = end_located(m, h)
    judge_given(m, h)
    judge_swings(problem, run, point, h)
    if not isfinite(run.error) or run.error > 1.0:
        return reject_error(m, h)
    hold_inside(m)
    found = find_first_crossing(m, h)
    if found == INCONSISTENT_START:
        return settle_inconsistent_start(m, h)
    if found == CROSSING and run.cut_at < 1.0 and piece_is_rough(m, h):
        return take_piece(m, h)
    recorder.quadratures_off = 1 if problem.n_quadratures > 0 else 0
    accept_step(m, h, found == CROSSING)
    remember_middle(point, rule, h)
    show_inside(m)
    return GO_ON


@compiled
def end_located(m, h):
    """Move the end of a step by the error of its rule, and to where laws balance; the size of its error.

    theta is 1/2 here: in the zones of the start none cycle, and no kink is stepped over.
    """
    problem, point, linear, exchange = m.problem, m.point, m.linear, m.stepping.exchange
    refine_end(problem, point, linear, m.stepping, h)
    error = find_error(m, h)
    if error <= 1.0:
        worst = point.worst
        error = keep_larger(point, error, worst, balance_end(m, h))
    if exchange.algebraic_speeds == 1:
        end_algebraic_speeds(problem, point, linear, exchange, h)
    return error


@compiled
def step_over_kink(run, point, rule, h):
    """The step over a kink that the one before ended short of: as long again behind it, and implicit (theta = 1).

    What follows a surface by a stiff law has to follow the new piece from the end of this step on. The midpoint rule
    would leave a third of the difference at its start ringing, which is nothing as a speed and much as a force.
    """
    rule.theta_now = 1.0
    over = min(2.0 * (rule.t_kink - point.t), h)
    if run.adaptive == 0 or over < smallest_step(run, point):
        return h
    if over < h:
        run.landing = 0
    return over


@compiled
def accept_step(m, h, crossed):
    """Accept the step up to its crossing or its end."""
    recorder, rule = m.recorder, m.stepping.rule
    recorder.any_stiff = mark_stiff(m.problem, m.linear.matrices, recorder, h)
    rule.failed = max(rule.failed - 1, 0)
    rule.trying, rule.over = 0, 0
    rule.theta_raise = THETA_FALL * rule.theta_raise if rule.theta_raise > THETA_LEAST else 0.0
    accept(m, h, crossed)


@compiled
def settle_at_end(run, guards, stepping):
    """Have the end of an accepted step settled, at which a law jumps."""
    run.crossed = 1
    guards.n_fired = 0
    stepping.rule.localising = 0


@compiled
def solve_in_zones(m, h):
    """Take the step that ends at a jump once more, in the zones of its start: it was given up there, not yet solved."""
    rule = m.stepping.rule
    rule.frozen = 1
    status = take_theta_step(m, h)
    rule.frozen = 0
    return status


@compiled
def boundary_changed(settling, contacts):
    """True if the step changed a machine that keeps the rest of the problem at rest."""
    zones = indices(settling.at_zones, settling.n_machines)
    before = indices(contacts.at_zones_at_start, settling.n_machines)
    boundary, found = indices(settling.at_boundary, settling.n_machines), False
    for z in range(settling.n_machines):
        found = found or (boundary[z] == 1 and zones[z] != before[z])
    return found


@compiled
def arrive_with_zones(m):
    """Log the zones the step changed, then arrive at its end."""
    problem, run, guards, settling, recorder = m.problem, m.run, m.events.guards, m.events.settling, m.recorder
    if recorder.rows + 4 > recorder.row_capacity:
        return BUFFER_FULL
    switched = settling.passes > 0
    if switched:
        log_inside(m)
    copy(reals(guards.at_g, problem.n_guards), reals(m.stepping.contacts.at_g_before, problem.n_guards))
    if problem.samples == 1 and run.landing == 1 and run.t_piece >= run.t_next and run.t_piece < run.stop:
        run.crossed = 1  # settled before the sample is taken: forces are those of the middle of the step until then
        guards.n_fired = 0
    status = arrive(m, False)  # at a cut forces are on the line between the ends; the settlement there corrects them
    if run.phase == TRY and m.stepping.rule.instant == 0:
        remember_slope(run, m.stepping)
    return status


@compiled
def begin_again(m):
    """After a settlement nothing is known of the steps before; it may be the one after which steps end at switches."""
    rule = m.stepping.rule
    rule.locates = 1 if will_locate(rule) else 0
    rule.locates_for = max(rule.locates_for - 1, 0)
    begin_history(m.run, m.point, m.stepping)


@compiled
def will_locate(rule):
    """True if steps end at every switch after the settlement that goes on."""
    return rule.always_locates == 1 or rule.locates_for > 1


@compiled
def error_of_first(m):
    """The leading error of the first step, A (h/T)^3 / 12, of which one weight or one CAREFUL-th of it is allowed."""
    return 12.0 * (1.0 / CAREFUL if will_locate(m.stepping.rule) else 1.0), 3.0


@compiled
def length_after(m):
    """How long the step after an accepted one is to be."""
    return choose_next_step(m.run, m.stepping.rule, m.run.h, m.run.retried > 0)


METHOD = Method(attempt_stepping, arrive_with_zones, begin_again, length_after, error_of_first)
