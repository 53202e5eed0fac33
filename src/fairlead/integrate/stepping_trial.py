"""A trial step of the stepping engine: proposed, taken, its error estimated, accepted or repeated.

The error of the midpoint rule is h^3 y'''/12, and y''' comes free of charge: it is the second divided difference of
the mean slopes of this step and the two before,

    error = h^3/6 [k_n, k_n-1, k_n-2]

It is taken away before (third_order.py): what is controlled is the error of the step without that.
Controlled are all differential unknowns but speeds that have a position (x' = v). A contact that starts
or stops inside a step bends the motion there: the speed at the end of the step is then still right to
order 2, while a difference of accelerations sees a jump; the position it leads to is wrong by order
h^2 times the jump, which is what the difference of speeds says.
"""

from __future__ import annotations

from math import inf, isfinite

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
from fairlead.integrate.controller import NO_AMPLITUDE, is_straight, step_after_rejection, weigh, weighted_norm
from fairlead.integrate.curvature import bend_beyond_rounding
from fairlead.integrate.even_steps import FINE, root_of_power, rounded
from fairlead.integrate.foreign import compiled, copy, indices, reals
from fairlead.integrate.jumps import jump_is_due
from fairlead.integrate.known_rows import forget_rows
from fairlead.integrate.linear import DONE, INACCURATE, SINGULAR
from fairlead.integrate.located_step import (
    CUT,
    JUDGED,
    balance_end,
    error_of_located,
    judge_guards,
    remember_middle,
    settle_start,
    stops_little,
)
from fairlead.integrate.missed_impulse import impulse_is_missed
from fairlead.integrate.one_step import cut_too_rough
from fairlead.integrate.overload import begin_rest, count_rest, unseen_force, unseen_slip
from fairlead.integrate.pace import accept, is_instant, not_finite_here, over_budget, propose, smallest_step
from fairlead.integrate.record import rows_inside, write_row
from fairlead.integrate.release import remember
from fairlead.integrate.rows_between import end_massless, find_stiff, hold_inside, prepare_rows
from fairlead.integrate.settling import begin_settling
from fairlead.integrate.steady_steps import forget_steps, keep_step, note_rejection
from fairlead.integrate.theta_step import CYCLES, JUMPS, add_quadratures, give_back_zones, take_theta_step
from fairlead.integrate.third_order import refine_end
from fairlead.integrate.unseen_guards import guards_are_passed

STILL, HOLD_SHARE = 1e-2, 0.025
"""Where no position changes by more than this share of its weight, this share of the bend of a holding force
counts as its error: what is recorded of a force that swings while nothing moves would else be a few means."""
ROUGH = 4.0
"""Rows inside a step lie on a parabola where the motion is smooth, on the chord where its bend grows faster than this
or turns round: what is stiff rings at its steps, and a parabola through that shows motions that never were."""
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
    spent = over_budget(m)
    if spent != GO_ON:
        return spent
    if m.adaptive == 0 and m.failed == 0 and m.seeking == 0:
        m.h_next = m.fixed_step
    h = propose(m)
    if is_instant(m, h):
        m.passes = 0
        return GO_ON
    m.skip_meters = 1
    m.theta_now = min(m.least_theta + m.theta_raise, 1.0)
    if m.t < m.t_bent < m.t + h:
        h = over_kink(m, h)
    m.h = h
    status = take_theta_step(m, h)
    m.skip_meters = 0
    if status == INACCURATE:
        return find_pivots(m, h)
    m.replanned = 0
    return finish_located(m, h) if status == DONE and m.locates == 1 else finish_inside(m, h, status)


@compiled
def finish_inside(m, h, status):
    """The rest of a step that has found the zones of its end: repeated with a shorter one, or accepted to its end."""
    if status == JUMPS or (status == DONE and jump_is_due(m, h)):
        if not landed(m, h):
            return GO_ON
        m.seeking = LANDINGS
        status = DONE
        add_quadratures(m, h)  # a trial that ends at a jump was given up before
    if status != DONE:
        return repeat_shorter(m, h, status)
    if m.narrowed == 1 and m.passes > 0 and rim_changed(m):
        give_back_zones(m)
        return WIDEN
    if m.theta_now == MIDDLE:
        refine_end(m, h)
    m.error = error_of_step(m, h)
    if not isfinite(m.error) or (m.adaptive == 1 and m.error > 1.0):
        return reject_error(m, h)
    if goes_past_switch(m, h):
        return end_at_switch(m)
    if m.massless == 1:
        end_massless(m, h)
    accept_step(m, h)
    return GO_ON


@compiled
def finish_located(m, h):
    """The rest of a step in the zones of its start: judged, repeated, or accepted up to the first switch inside."""
    if m.gap == 0.0 and stops_little(m):
        settle_start(m)
        return GO_ON
    m.error = end_located(m, h)
    if not isfinite(m.error) or m.error > 1.0:
        return reject_error(m, h)
    hold_inside(m)
    verdict = judge_guards(m, h)
    if verdict == JUDGED or (verdict == CUT and m.theta < 1.0 and cut_too_rough(m, h)):
        return GO_ON
    m.any_stiff = find_stiff(m, h)
    m.failed = max(m.failed - 1, 0)
    m.meters_off = 1 if m.n_quadratures > 0 else 0
    repeated = m.retried > 0
    accept(m, h, verdict == CUT)
    keep_step(m, h, repeated)
    remember_middle(m, h)
    show_inside(m)
    return GO_ON


@compiled
def end_located(m, h):
    """Move the end of a step by the error of its rule, and to where laws balance; the size of its error."""
    refine_end(m, h)
    error = error_of_step(m, h)
    if error <= 1.0:
        error = max(error, balance_end(m, h))
    if m.massless == 1:
        end_massless(m, h)
    return error


@compiled
def show_inside(m):
    """How many rows the accepted step has inside, and what its dense output needs."""
    if m.on_grid == 1 or m.between == 1:
        m.inside, m.inside_next = rows_inside(m), 1
        prepare_rows(m)


@compiled
def over_kink(m, h):
    """The step over a kink that the one before ended short of: as long again behind it, and implicit (theta = 1).

    What follows a surface by a stiff law has to follow the new piece from the end of this step on. The midpoint rule
    would leave a third of the difference at its start ringing, which is nothing as a speed and much as a force.
    """
    m.theta_now = 1.0
    over = min(2.0 * (m.t_bent - m.t), h)
    if m.adaptive == 0 or over < smallest_step(m):
        return h
    if over < h:
        m.landing = 0
    return over


@compiled
def accept_step(m, h):
    """To the end of the step; how long the next is."""
    m.any_stiff = find_stiff(m, h)
    m.failed = max(m.failed - 1, 0)
    m.theta_raise = THETA_FALL * m.theta_raise if m.theta_raise > 1e-3 else 0.0
    repeated = m.retried > 0
    accept(m, h, False)
    if m.adaptive == 1:
        keep_step(m, h, repeated)
    show_inside(m)
    if m.seeking > 0:
        m.crossed = 1
        m.n_fired = 0
        m.seeking = 0


@compiled
def find_pivots(m, h):
    """Repeat a step that met such a matrix midway with a shorter one; have other pivots found where none will do."""
    if m.midway == 1 and (m.replanned == 1 or m.retried < HALVINGS):
        m.replanned = 0
        return repeat_shorter(m, h, SINGULAR)
    give_back_zones(m)
    return REPLAN


@compiled
def rim_changed(m):
    """True if the step changed a machine that keeps the rest of the problem at rest."""
    zones, before = indices(m.at_zones, m.n_zones), indices(m.at_zones_at_start, m.n_zones)
    rim, found = indices(m.at_rim, m.n_zones), False
    for z in range(m.n_zones):
        found = found or (rim[z] == 1 and zones[z] != before[z])
    return found


@compiled
def reject_error(m, h):
    """Repeat a step whose error is too large, and say whom it is due to."""
    give_back_zones(m)
    if isfinite(m.error):
        m.rejected_error += 1
        indices(m.at_rejections_by_unknown, m.n)[m.worst] += 1
    else:
        m.rejected_nan += 1
    m.h_next = step_after_rejection(m, h)
    note_rejection(m)
    m.retried += 1
    return GO_ON if m.h_next >= smallest_step(m) else STEP_FLOOR


@compiled
def goes_past_switch(m, h):
    """True if the step has to end at `t_switch`; a fixed one never has."""
    if m.adaptive == 0:
        return False
    if m.n_switched > 0 and impulse_is_missed(m, h):
        if m.retried >= LANDINGS:
            m.t_switch = m.t + 0.5 * h
        return True
    return guards_are_passed(m, h)


@compiled
def end_at_switch(m):
    """Repeat a step up to `t_switch`."""
    give_back_zones(m)
    m.rejected_switch += 1
    if m.worst >= 0:
        indices(m.at_rejections_by_unknown, m.n)[m.worst] += 1
    m.retried += 1
    m.h_next = rounded(m.t_switch - m.t, FINE)
    return GO_ON


@compiled
def landed(m, h):
    """True if the step ends at `t_jump` as it should; else it is repeated up to there, or settled at its start."""
    give = m.n_fired
    switched = m.passes > 0
    give_back_zones(m)
    if m.t_jump - m.t <= max(1e-9 * (m.stop - m.start), smallest_step(m)):
        m.rejected_switch += 1
        m.n_fired = give
        m.seeking = 0
        m.crossed = 1
        write_row(m, m.t, m.at_y, BEFORE)
        remember(m)
        begin_settling(m)
        m.phase = SETTLE
        return False
    if not switched and m.seeking > 0 and (m.seeking >= LANDINGS or abs(m.t_jump - m.t - h) <= 1e-3 * h):
        return True
    if switched and m.seeking >= LANDINGS:
        m.t_jump = m.t + 0.5 * h
    m.rejected_switch += 1
    m.seeking += 1
    m.h_next = min(m.t_jump - m.t, h)
    return False


@compiled
def count_unsolved(m, status):
    """Count a step that was not solved, by its cause."""
    if status == CYCLES:
        m.rejected_cycling += 1
    elif status == SINGULAR:
        m.rejected_singular += 1
    else:
        m.rejected_diverged += 1


@compiled
def repeat_shorter(m, h, status):
    """Halve a step whose zones cycle or whose iteration fails; end the run at the step floor."""
    give_back_zones(m)
    count_unsolved(m, status)
    m.retried += 1
    if status == CYCLES and m.expecting == 1:
        m.failed += 1  # the same step again, without guessing
        m.h_next = h
        return GO_ON
    m.failed += 2
    if status == CYCLES:
        m.theta_raise = min(m.theta_raise + THETA_RISE, 0.5)
    m.h_next = 0.5 * h
    if m.h_next >= smallest_step(m):
        return GO_ON
    if status == CYCLES:
        return UNSETTLED
    return not_finite_here(m, SINGULAR_MATRIX if status == SINGULAR else STEP_FLOOR)


@compiled
def error_of_step(m, h):
    """Size of the error of the step in weights; leaves `mean_slope`, and the bend of the step in `D`."""
    n = m.n
    y, y_end, slope = reals(m.at_y, n), reals(m.at_y_end, n), reals(m.at_mean_slope, n)
    before, earlier, error = reals(m.at_slope_before, n), reals(m.at_slope_earlier, n), reals(m.at_error_vector, n)
    bend, differential, controlled = reals(m.at_D, n), indices(m.at_differential, n), indices(m.at_controlled, n)
    holds, quadrature, mean = indices(m.at_holds, n), indices(m.at_quadrature, n), reals(m.at_mean_before, n)
    settled = m.locates == 0 or m.gap == 0.0
    near, far = m.gap + 0.5 * h, m.gap_before
    per_step, per_near, per_far = 1.0 / h, 1.0 / near, 1.0 / far
    third = h * h * h / 6.0 / (near + far)
    weigh(m, m.at_y_end)
    for k in range(n):
        error[k] = 0.0
        slope[k] = 0.0
        bend[k] = 0.0
        if not isfinite(y_end[k]):
            m.worst = k
            return inf - inf
        if differential[k] == 1:
            slope[k] = (y_end[k] - y[k]) * per_step
            curve, curve_before = (slope[k] - before[k]) * per_near, (before[k] - earlier[k]) * per_far
            if curve * curve_before > 0.0 and abs(curve) <= ROUGH * abs(curve_before):
                bend[k] = -0.5 * h * h * curve
            if controlled[k] == 1 or (m.locates == 1 and quadrature[k] == 0):
                error[k] = third * (curve - curve_before)
        else:
            slope[k] = (y_end[k] - (y[k] if settled else mean[k])) * per_near
    if m.locates == 1:
        return error_of_located(m, h)
    size = max(weighted_norm(m, m.at_error_vector), unseen_slip(m, h))
    if m.passes > 0:
        size = max(size, unseen_force(m, h))
    if m.passes > 0 or moves(m):
        return size
    for k in range(n):
        if holds[k] == 1:
            error[k] = HOLD_SHARE * h * (slope[k] - before[k])
    return max(size, weighted_norm(m, m.at_error_vector))


@compiled
def moves(m):
    """True if a controlled unknown changes in the step by more than STILL of its weight."""
    y, y_end, weight = reals(m.at_y, m.n), reals(m.at_y_end, m.n), reals(m.at_weight, m.n)
    controlled = indices(m.at_controlled, m.n)
    found = False
    for k in range(m.n):
        found = found or (controlled[k] == 1 and abs(y_end[k] - y[k]) > STILL * weight[k])
    return found


@compiled
def remember_slope(m):
    """After an accepted step: its slope becomes the one before."""
    copy(reals(m.at_slope_before, m.n), reals(m.at_slope_earlier, m.n))
    copy(reals(m.at_mean_slope, m.n), reals(m.at_slope_before, m.n))
    m.gap_before = m.gap + 0.5 * m.h
    m.gap = 0.5 * m.h
    count_rest(m)


@compiled
def begin_history(m):
    """After a settlement: the slopes before are those of the consistent point, now and a little earlier.

    The first step makes the error of a motion with the time scale T = |y'|/|y''| and the amplitude
    A = T |y'| equal to one weight: A (h/T)^3 / 12.
    """
    n = m.n
    slope, curvature, u = reals(m.at_slope, n), reals(m.at_curvature, n), reals(m.at_u, n)
    before, earlier = reals(m.at_slope_before, n), reals(m.at_slope_earlier, n)
    differential = indices(m.at_differential, n)
    m.linearised = 0
    forget_rows(m)
    m.failed = 0
    begin_rest(m)
    forget_steps(m)
    if m.adaptive == 1 and not (m.steps == 0 and m.first_step > 0.0):
        for k in range(n):
            u[k] = slope[k] if differential[k] == 1 else 0.0
        speed = weighted_norm(m, m.at_u)
        bend = bend_beyond_rounding(m)
        if speed * speed > NO_AMPLITUDE * bend and not is_straight(m, bend):
            scale = speed / bend
            m.h_next = min(m.h_next, root_of_power(scale * (12.0 / (speed * scale)) ** (1.0 / 3.0)))
        m.h_next = max(m.h_next, 4.0 * smallest_step(m))
    m.gap = 0.0
    m.gap_before = min(m.h_next, m.max_step)
    for k in range(n):
        before[k] = slope[k] if differential[k] == 1 else curvature[k]
        earlier[k] = before[k] - m.gap_before * curvature[k] if differential[k] == 1 else 0.0
