"""A trial step of `stepping`: proposed, taken, its error estimated (step_error.py), accepted or repeated.

What repeats one, in this order: a matrix without good pivots; a law that jumps at a limit the step reaches; zones that
do not settle; a rim of a part that changed; an error above one; a switch inside that its formula says is missed. Where
every switch is landed on (`finish_located`): an error above one; a guard that fires at the start, or at an end that was
cut too roughly.
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import (
    BEFORE,
    GO_ON,
    MIDDLE,
    REPLAN,
    SETTLE,
    SINGULAR_MATRIX,
    STEP_FLOOR,
    UNSETTLED,
    WIDEN,
)
from fairlead.integrate.events.pace import accept, is_instant, not_finite_here, over_budget, propose, smallest_step
from fairlead.integrate.events.release import remember
from fairlead.integrate.events.settling import begin_settling
from fairlead.integrate.linear.systems import DONE, INACCURATE, SINGULAR
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals
from fairlead.integrate.one_step import cut_too_rough
from fairlead.integrate.point.controller import NO_AMPLITUDE, is_straight, step_after_rejection, weighted_norm
from fairlead.integrate.point.curvature import bend_beyond_rounding
from fairlead.integrate.point.even_steps import FINE, root_of_power, rounded
from fairlead.integrate.record.between import end_massless, find_stiff, hold_inside, prepare_rows
from fairlead.integrate.record.rows import rows_inside, write_row
from fairlead.integrate.stepping.jumps import jump_is_due
from fairlead.integrate.stepping.known_rows import forget_rows
from fairlead.integrate.stepping.located_step import (
    CUT,
    JUDGED,
    balance_end,
    judge_guards,
    remember_middle,
    settle_start,
    stops_little,
)
from fairlead.integrate.stepping.missed_impulse import impulse_is_missed
from fairlead.integrate.stepping.overload import begin_rest, count_rest
from fairlead.integrate.stepping.steady_steps import forget_steps, keep_step, note_rejection
from fairlead.integrate.stepping.step_error import error_of_step
from fairlead.integrate.stepping.theta_step import CYCLES, JUMPS, add_quadratures, give_back_zones, take_theta_step
from fairlead.integrate.stepping.third_order import refine_end
from fairlead.integrate.stepping.unseen_guards import guards_are_passed

HALVINGS = 3
"""Halvings of a step whose iteration met a matrix without good pivots, before others are asked for: mostly it had
gone astray, and pivots good for such a matrix fail for those that are met otherwise."""
LANDINGS = 4
"""Tries to end a step where a law jumps, or where a switch inside it makes an error that counts."""
THETA_RISE, THETA_FALL = 0.05, 0.9
"""theta rises by this when the zones of a step cycle; what it rose shrinks by this factor with every accepted one."""


@compiled
def attempt_stepping(m):
    """One trial step: repeated with a shorter one, or accepted to its end."""
    run, point, core, rule = m.run, m.point, m.linear.core, m.stepping.rule
    spent = over_budget(run, m.recorder)
    if spent != GO_ON:
        return spent
    if run.adaptive == 0 and rule.failed == 0 and rule.seeking == 0:
        run.h_next = run.fixed_step
    h = propose(run, point)
    if is_instant(run, point, m.events.guards, h):
        m.events.settling.passes = 0
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
    """The rest of a step that has found the zones of its end: repeated with a shorter one, or accepted to its end."""
    problem, run, point, linear, guards = m.problem, m.run, m.point, m.linear, m.events.guards
    settling, stepping, rule, exchange = m.events.settling, m.stepping, m.stepping.rule, m.stepping.exchange
    if status == JUMPS or (status == DONE and jump_is_due(m, h)):
        if not landed(m, h):
            return GO_ON
        rule.seeking = LANDINGS
        status = DONE
        add_quadratures(problem, point, rule, h)  # a trial that ends at a jump was given up before
    if status != DONE:
        return repeat_shorter(m, h, status)
    if run.narrowed == 1 and settling.passes > 0 and rim_changed(settling, m.stepping.contacts):
        give_back_zones(guards, stepping)
        return WIDEN
    if rule.theta_now == MIDDLE:
        refine_end(problem, point, linear, exchange, h)
    run.error = error_of_step(m, h)
    if not isfinite(run.error) or (run.adaptive == 1 and run.error > 1.0):
        return reject_error(m, h)
    if goes_past_switch(m, h):
        return end_at_switch(run, point, guards, stepping)
    if exchange.massless == 1:
        end_massless(problem, point, linear, exchange, h)
    accept_step(m, h)
    return GO_ON


@compiled
def finish_located(m, h):
    """The rest of a step in the zones of its start: judged, repeated, or accepted up to the first switch inside."""
    problem, run, point, recorder, rule = m.problem, m.run, m.point, m.recorder, m.stepping.rule
    if rule.gap == 0.0 and stops_little(m):
        settle_start(m)
        return GO_ON
    run.error = end_located(m, h)
    if not isfinite(run.error) or run.error > 1.0:
        return reject_error(m, h)
    hold_inside(m)
    verdict = judge_guards(m, h)
    if verdict == JUDGED or (verdict == CUT and run.cut_at < 1.0 and cut_too_rough(m, h)):
        return GO_ON
    recorder.any_stiff = find_stiff(problem, m.linear.matrices, recorder, h)
    rule.failed = max(rule.failed - 1, 0)
    recorder.meters_off = 1 if problem.n_quadratures > 0 else 0
    repeated = run.retried > 0
    accept(m, h, verdict == CUT)
    keep_step(run, rule, h, repeated)
    remember_middle(point, rule, h)
    show_inside(m)
    return GO_ON


@compiled
def end_located(m, h):
    """Move the end of a step by the error of its rule, and to where laws balance; the size of its error."""
    problem, point, linear, exchange = m.problem, m.point, m.linear, m.stepping.exchange
    refine_end(problem, point, linear, exchange, h)
    error = error_of_step(m, h)
    if error <= 1.0:
        error = max(error, balance_end(m, h))
    if exchange.massless == 1:
        end_massless(problem, point, linear, exchange, h)
    return error


@compiled
def show_inside(m):
    """How many rows the accepted step has inside, and what its dense output needs."""
    recorder = m.recorder
    if recorder.on_grid == 1 or recorder.between == 1:
        recorder.inside, recorder.inside_next = rows_inside(m.run, m.point, m.events.settling, recorder), 1
        prepare_rows(m)


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
    recorder.any_stiff = find_stiff(m.problem, m.linear.matrices, recorder, h)
    rule.failed = max(rule.failed - 1, 0)
    rule.theta_raise = THETA_FALL * rule.theta_raise if rule.theta_raise > 1e-3 else 0.0
    repeated = run.retried > 0
    accept(m, h, False)
    if run.adaptive == 1:
        keep_step(run, rule, h, repeated)
    show_inside(m)
    if rule.seeking > 0:
        run.crossed = 1
        m.events.guards.n_fired = 0
        rule.seeking = 0


@compiled
def find_pivots(m, h):
    """Repeat a step that met such a matrix midway with a shorter one; have other pivots found where none will do."""
    rule = m.stepping.rule
    if rule.midway == 1 and (rule.replanned == 1 or m.run.retried < HALVINGS):
        rule.replanned = 0
        return repeat_shorter(m, h, SINGULAR)
    give_back_zones(m.events.guards, m.stepping)
    return REPLAN


@compiled
def rim_changed(settling, contacts):
    """True if the step changed a machine that keeps the rest of the problem at rest."""
    zones, before = indices(settling.at_zones, settling.n_zones), indices(contacts.at_zones_at_start, settling.n_zones)
    rim, found = indices(settling.at_rim, settling.n_zones), False
    for z in range(settling.n_zones):
        found = found or (rim[z] == 1 and zones[z] != before[z])
    return found


@compiled
def reject_error(m, h):
    """Repeat a step whose error is too large, and say whom it is due to; a fixed one ends the run."""
    run, point, stepping = m.run, m.point, m.stepping
    give_back_zones(m.events.guards, stepping)
    if isfinite(run.error):
        run.rejected_error += 1
        indices(run.at_rejections_by_unknown, point.n)[point.worst] += 1
    else:
        run.rejected_nan += 1
    if run.adaptive == 0:
        return not_finite_here(m.problem, run, point, STEP_FLOOR)
    run.h_next = step_after_rejection(run, h)
    note_rejection(run, stepping.rule)
    run.retried += 1
    return GO_ON if run.h_next >= smallest_step(run, point) else STEP_FLOOR


@compiled
def goes_past_switch(m, h):
    """True if the step has to end at `t_switch`; a fixed one never has."""
    run, point = m.run, m.point
    if run.adaptive == 0:
        return False
    if m.stepping.contacts.n_switched > 0 and impulse_is_missed(m.problem, point, m.linear.matrices, m.stepping, h):
        if run.retried >= LANDINGS:
            m.stepping.rule.t_switch = point.t + 0.5 * h
        return True
    return guards_are_passed(m, h)


@compiled
def end_at_switch(run, point, guards, stepping):
    """Repeat a step up to `t_switch`."""
    give_back_zones(guards, stepping)
    run.rejected_switch += 1
    if point.worst >= 0:
        indices(run.at_rejections_by_unknown, point.n)[point.worst] += 1
    run.retried += 1
    run.h_next = rounded(stepping.rule.t_switch - point.t, FINE)
    return GO_ON


@compiled
def landed(m, h):
    """True if the step ends at `t_jump` as it should; else it is repeated up to there, or settled at its start."""
    problem, run, point, guards, rule = m.problem, m.run, m.point, m.events.guards, m.stepping.rule
    give = guards.n_fired
    switched = m.events.settling.passes > 0
    give_back_zones(guards, m.stepping)
    if rule.t_jump - point.t <= max(1e-9 * (run.stop - run.start), smallest_step(run, point)):
        run.rejected_switch += 1
        guards.n_fired = give
        rule.seeking = 0
        run.crossed = 1
        write_row(problem, m.recorder, point.t, point.at_y, BEFORE)
        remember(problem, point, m.events.loads)
        begin_settling(problem, run, point, m.events)
        run.phase = SETTLE
        return False
    if not switched and rule.seeking > 0 and (rule.seeking >= LANDINGS or abs(rule.t_jump - point.t - h) <= 1e-3 * h):
        return True
    if switched and rule.seeking >= LANDINGS:
        rule.t_jump = point.t + 0.5 * h
    run.rejected_switch += 1
    rule.seeking += 1
    run.h_next = min(rule.t_jump - point.t, h)
    return False


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
def repeat_shorter(m, h, status):
    """Halve a step whose zones cycle or whose iteration fails; end the run at the step floor."""
    run, point, rule = m.run, m.point, m.stepping.rule
    give_back_zones(m.events.guards, m.stepping)
    count_unsolved(run, status)
    run.retried += 1
    if status == CYCLES and m.stepping.contacts.expecting == 1:
        rule.failed += 1  # the same step again, without guessing
        run.h_next = h
        return GO_ON
    rule.failed += 2
    if status == CYCLES:
        rule.theta_raise = min(rule.theta_raise + THETA_RISE, 0.5)
    run.h_next = 0.5 * h
    if run.h_next >= smallest_step(run, point):
        return GO_ON
    if status == CYCLES:
        return UNSETTLED
    return not_finite_here(m.problem, run, point, SINGULAR_MATRIX if status == SINGULAR else STEP_FLOOR)


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
def begin_history(run, point, matrices, stepping):
    """After a settlement: the slopes before are those of the consistent point, now and a little earlier.

    The first step makes the error of a motion with the time scale T = |y'|/|y''| and the amplitude
    A = T |y'| equal to one weight: A (h/T)^3 / 12.
    """
    rule = stepping.rule
    n = point.n
    slope, curvature, u = reals(point.at_slope, n), reals(point.at_curvature, n), reals(point.at_u, n)
    before, earlier = reals(rule.at_slope_before, n), reals(rule.at_slope_earlier, n)
    differential = indices(point.at_differential, n)
    rule.linearised = 0
    forget_rows(stepping.exchange)
    rule.failed = 0
    begin_rest(stepping.contacts)
    forget_steps(rule)
    if run.adaptive == 1 and not (run.steps == 0 and run.first_step > 0.0):
        for k in range(n):
            u[k] = slope[k] if differential[k] == 1 else 0.0
        speed = weighted_norm(point, point.at_u)
        bend = bend_beyond_rounding(point, matrices)
        if speed * speed > NO_AMPLITUDE * bend and not is_straight(run, bend):
            scale = speed / bend
            run.h_next = min(run.h_next, root_of_power(scale * (12.0 / (speed * scale)) ** (1.0 / 3.0)))
        run.h_next = max(run.h_next, 4.0 * smallest_step(run, point))
    rule.gap = 0.0
    rule.gap_before = min(run.h_next, run.max_step)
    for k in range(n):
        before[k] = slope[k] if differential[k] == 1 else curvature[k]
        earlier[k] = before[k] - rule.gap_before * curvature[k] if differential[k] == 1 else 0.0
