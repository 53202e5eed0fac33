"""Arriving at a point: settle there if guards fired or a time event changed something; the step after."""

from __future__ import annotations

from fairlead.integrate.codes import (
    AFTER,
    APART,
    BEFORE,
    BUFFER_FULL,
    CHATTER,
    GIVEN_APART,
    GO_ON,
    INACCURATE,
    INCONSISTENT,
    NO_ROOM,
    NOT_CONSISTENT,
    NOT_SETTLED,
    ORDINARY,
    PASSED,
    REBOUND_RUBS,
    REPLAN,
    RUBBED,
    SAMPLE_DUE,
    SETTLE,
    SETTLING_FOR_IT,
    SINGULAR,
    SINGULAR_MATRIX,
    TOO_MANY_PASSES,
    TRY,
)
from fairlead.integrate.events.chatter import HOLD, hold_what_circles
from fairlead.integrate.events.consistent import correct_forces, keep_positions
from fairlead.integrate.events.first_sample import settle_for_sample, take_first_sample
from fairlead.integrate.events.given_apart import moves_apart
from fairlead.integrate.events.growth import watch_growth
from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.events.limits import AT_LIMIT, goes_no_further
from fairlead.integrate.events.pace import DOUBT, not_finite_here
from fairlead.integrate.events.position import off_place
from fairlead.integrate.events.release import remember
from fairlead.integrate.events.settling import begin_settling, settle
from fairlead.integrate.events.violators import distance_of_lookahead, event_is_due, move_ahead
from fairlead.integrate.memory.foreign import at_time_at, compiled, copy, indices, next_time_at, reals
from fairlead.integrate.point.controller import longest_first_step, restart, smallest_step, weigh, weighted_norm
from fairlead.integrate.point.curvature import curvature_beyond_rounding
from fairlead.integrate.record.rows import shown_end, write_row

START_ITERATIONS, SETTLE_ITERATIONS = 40, 12
"""Newton iterations allowed from the guess of a user, and from a point consistent before a switch."""


MOST_DROPPED = 4
"""Crossings in a row that a better point may undo: steps between them become short at once. That of a load that goes no
further is undone however often."""

EARLY = 4.0
"""The look ahead, in the time by which a crossing is early: after twice that time the mean load is at its limit."""
FARTHER = 100.0
"""How much farther than else that may be: a tenth of an error weight, with the curvature of the motion taken along."""


@compiled
def start(problem, run, point, events):
    """Move to the pieces in force at the start, sample, and settle there."""
    if run.first_sample == SAMPLE_DUE:
        settle_for_sample(problem, run, point, events)
    elif problem.call_at_time != 0:
        at_time_at(problem.call_at_time, (problem.context, point.t, point.at_y))
    find_next_time(problem, run, point)
    events.guards.n_fired = 0
    begin_settling(problem, run, point, events)
    events.loads.nothing_before = 1
    run.phase = SETTLE
    return GO_ON


@compiled
def arrive(m, by_equations):
    """Move to the end of the piece; settle there if guards fired or a time event changed anything.

    `by_equations`: at a crossing forces are those of the equations, in place of the interpolated ones (`judge_again`).
    Not so of `stepping`, also where it locates crossings: its settlement there makes forces consistent.
    """
    problem, run, point, linear, events, guards = m.problem, m.run, m.point, m.linear, m.events, m.events.guards
    recorder = m.recorder
    if recorder.rows + 4 > recorder.row_capacity:
        return BUFFER_FULL
    on_row = run.t_piece - recorder.t_row <= 1e-12 * max(abs(run.t_piece), recorder.every)  # a point of the grid
    recorded = recorder.on_grid == 0 or (recorder.between == 1 and not on_row)
    entered_again = point.t == run.t_piece  # for other pivots; the start of the step is gone
    time_event_now = run.landing == 1 and run.t_piece < run.stop and run.t_piece >= min(run.t_next, run.t_release)
    both_sides = run.crossed == 1 or time_event_now
    at_shown = shown_end(m) if (recorded or both_sides) and not entered_again else point.at_y_piece
    if both_sides and not entered_again:
        remember_shown(point, recorder, at_shown)
    point.t = run.t_piece
    run.judged = 0
    run.dropped = run.dropped if run.crossed == 1 else 0
    copy(reals(point.at_y_piece, problem.n), reals(point.at_y, problem.n))
    m.linear.matrices.jacobian_fresh = 0
    kept = problem.n_accelerated > 0 or off_place(problem, point) or (problem.n_balanced > 0 and run.crossed == 1)
    better = kept or (by_equations and run.crossed == 1 and asks_for_forces(problem, guards))
    if better:
        if (keep_positions(problem, point, linear) if kept else correct_forces(problem, point, linear)) == INACCURATE:
            return REPLAN
        judge_again(problem, run, point, events)
        at_shown = as_shown(m, point.at_y, True) if run.crossed == 0 else point.at_y  # else `at_limit` is written
    run.phase = TRY
    if run.crossed == 1:
        run.located += 1
        # On the interpolant a force is at its limit; the equations have it beyond by the error of the instant.
        at_limit = as_shown(m, point.at_y if problem.n_moves > 0 else point.at_y_piece, True)
        write_row(problem, recorder, point.t, at_limit, BEFORE)
        remember(problem, point, m.events.loads)
        if time_event_now:  # what is sampled at this instant is from before it
            take_time_event(problem, run, point, events)
        begin_settling(problem, run, point, events)
        run.phase = SETTLE
    elif time_event_now:
        write_row(problem, recorder, point.t, as_shown(m, point.at_y, True), BEFORE)
        if take_time_event(problem, run, point, events):
            guards.n_fired = 0
            begin_settling(problem, run, point, events)
            run.phase = SETTLE
        else:
            recorder.rows -= 1
    elif moves_apart(problem, point, linear):
        write_row(problem, recorder, point.t, as_shown(m, point.at_y, True), BEFORE)
        remember(problem, point, m.events.loads)
        guards.n_fired = 0
        begin_settling(problem, run, point, events)
        run.phase = SETTLE
    if run.phase == TRY:
        if not better:
            copy(reals(guards.at_g_end, problem.n_guards), reals(guards.at_g, problem.n_guards))
        # The stop is recorded even when it is no point of the grid.
        last = run.start + (recorder.grid_next - 1) * recorder.every
        off_grid = point.t >= run.stop and last < run.stop - 1e-9 * recorder.every
        if recorder.on_grid == 0 or off_grid:
            write_row(problem, recorder, point.t, at_shown, ORDINARY)
        elif recorded:
            write_row(problem, recorder, point.t, at_shown, PASSED)
        recorder.shown_apart = 0
    return GO_ON


@compiled
def remember_shown(point, recorder, at_shown):
    """Keep how far speeds that follow a stiff law are shown from where the interpolant has them: see balance_stiff.

    Both rows of an event are moved by it, not the motion: a speed that balances to rounding has a y'' of rounding.
    """
    recorder.shown_apart = recorder.any_stiff
    if recorder.any_stiff == 0:
        return
    shown, piece, apart = reals(at_shown, point.n), reals(point.at_y_piece, point.n), reals(recorder.at_apart, point.n)
    for k in range(point.n):
        apart[k] = shown[k] - piece[k]


@compiled
def as_shown(m, at_y, before):
    """Address of y as it is recorded at an event, `before` its switches or after them.

    Speeds that follow a stiff law are shown where they balance, but never so that a guard rises by it, nor off the one
    that fired. What has no inertia is in balance after a settlement; before, it is shown as the end of the piece is.
    """
    point, guards, recorder = m.point, m.events.guards, m.recorder
    if recorder.shown_apart == 0:
        return at_y
    n = point.n
    y, shown, apart = reals(at_y, n), reals(point.at_y_probe, n), reals(recorder.at_apart, n)
    piece, stiff = reals(point.at_y_piece, n), indices(recorder.at_is_stiff, n)
    differential = indices(point.at_differential, n)
    for k in range(n):
        shown[k] = y[k] + apart[k] if differential[k] == 1 else y[k]
    evaluate_guards(m.problem, m.run, guards, point.t, point.at_y_probe, guards.at_g_probe)
    g, tolerance = reals(guards.at_g_probe, guards.n_guards), reals(guards.at_guard_tolerance, guards.n_guards)
    rises = False
    for i in range(guards.n_guards):
        rises = rises or g[i] > tolerance[i]
    fired = indices(guards.at_fired, guards.n_guards)
    for k in range(guards.n_fired):
        rises = rises or abs(g[fired[k]]) > tolerance[fired[k]]
    for k in range(n):
        if differential[k] == 0 and stiff[k] == 1 and before:
            shown[k] = piece[k] + apart[k]
        elif rises:
            shown[k] = y[k]
    return point.at_y_probe


@compiled
def asks_for_forces(problem, guards):
    """True if a guard that fired may follow what the equations give at an instant, as the force of a held contact.

    Not the slip of a contact, nor the place in a table: those are unknowns with a past.
    """
    if problem.n_algebraic == 0:
        return False
    fired, kink = indices(guards.at_fired, problem.n_guards), indices(problem.at_kink_guard, problem.n_guards)
    inertia = reals(guards.at_guard_inertia, problem.n_guards)
    asks = False
    for k in range(guards.n_fired):
        asks = asks or (inertia[fired[k]] == 0.0 and kink[fired[k]] == 0)
    return asks


@compiled
def judge_again(problem, run, point, events):
    """Guards at the point as the equations have it, into `g`; drop the fired that are below.

    The interpolant is off what is kept, and off the forces of what holds, by the error of a step, more than a guard is
    known to. A contact that lets go by that too early, by a time tau, would be caught at once: its load is below its
    limit until then. So the settlement looks ahead by `EARLY` times tau, as far as it goes, and what is farther off is
    dropped: it fires in the next step, which begins at the better point and is as short as its guard is near. Not so in
    a corner (corners.py), where the equations may have their point on the other side. A load that goes no further is
    dropped wherever it is (limits.py).
    """
    guards, settling = events.guards, events.settling
    settling.least_lookahead = 0.0
    evaluate_guards(problem, run, guards, point.t, point.at_y, guards.at_g)
    if run.crossed == 0:
        return
    g, tolerance = reals(guards.at_g, problem.n_guards), reals(guards.at_guard_tolerance, problem.n_guards)
    fired, kept, later = indices(guards.at_fired, problem.n_guards), 0, reals(guards.at_g_probe, problem.n_guards)
    corner = indices(guards.at_in_corner, problem.n_guards)
    d, tied = 0.0, False  # whether a load turns at its limit
    if problem.n_accelerated == 0:
        d = distance_of_lookahead(run, point)
        move_ahead(point, d, d)
    evaluate_guards(problem, run, guards, point.t + d, point.at_y_probe if d > 0.0 else point.at_y, guards.at_g_probe)
    for k in range(guards.n_fired):
        i = fired[k]
        near = run.dropped >= MOST_DROPPED or corner[i] == 1 or g[i] >= -AT_LIMIT * tolerance[i]
        if not near and FARTHER * (later[i] - g[i]) >= EARLY * -g[i]:
            near = True
            settling.least_lookahead = max(settling.least_lookahead, d * EARLY * -g[i] / (later[i] - g[i]))
        tops_out = goes_no_further(guards, i)
        tied = tied or tops_out
        if near and not tops_out:
            fired[kept] = i
            kept += 1
    if kept > 0:
        guards.n_fired, run.dropped = kept, 0
    else:
        guards.n_fired, run.crossed, run.dropped = 0, 0, run.dropped + 1
        run.last_error = 0.0  # the point has moved: nothing is known of the step before
        if (problem.n_balanced > 0 or tied) and run.adaptive == 1:
            run.h_next = min(run.h_next, DOUBT * run.h)  # a load that turns at its limit leaves it with no slope


@compiled
def take_time_event(problem, run, point, events):
    """Tell the problem of its time event, release machines whose dwell is over; True if that matters."""
    changed = False
    remember(problem, point, events.loads)
    if point.t >= run.t_next:
        run.time_events += 1
        changed = at_time_at(problem.call_at_time, (problem.context, point.t, point.at_y)) != 0
        find_next_time(problem, run, point)
    if point.t >= run.t_release:
        changed = True
        blocked = reals(events.guards.at_blocked_until, problem.n_machines)
        run.t_release = 1e308
        for z in range(problem.n_machines):
            if blocked[z] > point.t:
                run.t_release = min(run.t_release, blocked[z])
    return changed


@compiled
def find_next_time(problem, run, point):
    """When the problem wants to be told next."""
    run.t_next = 1e308
    if problem.call_next_time != 0:
        run.t_next = next_time_at(problem.call_next_time, (problem.context, point.t))


@compiled
def settle_here(m, share, order):
    """Settle at the point; then any time event of this instant; then the step to begin with (`first_step`)."""
    problem, run, point, events = m.problem, m.run, m.point, m.events
    starting = run.steps == 0 and run.inconsistent_start == 0 and run.crossed == 0
    status = settle(m, START_ITERATIONS if starting else SETTLE_ITERATIONS)
    if status == INACCURATE:
        return REPLAN
    if status == NO_ROOM:
        return BUFFER_FULL
    if run.first_sample == SETTLING_FOR_IT:
        take_first_sample(problem, run, point, events)
        find_next_time(problem, run, point)
        return GO_ON
    if status == SINGULAR:
        return not_finite_here(problem, run, point, SINGULAR_MATRIX)
    if status == NOT_CONSISTENT:
        return not_finite_here(problem, run, point, INCONSISTENT)
    if status == TOO_MANY_PASSES:
        if run.on_chatter != HOLD or not hold_what_circles(m):
            return NOT_SETTLED
        begin_settling(problem, run, point, events)
        return GO_ON
    if status == RUBBED:
        return REBOUND_RUBS
    if status == APART:
        return GIVEN_APART
    if run.stop_asked == 1:
        return CHATTER
    if event_is_due(run, point):
        run.crossed = 0
        take_time_event(problem, run, point, events)
        begin_settling(problem, run, point, events)
        return GO_ON
    finish_settling(m, starting, share, order)
    return GO_ON


@compiled
def finish_settling(m, starting, share, order):
    """Choose the step after a settlement, and write the right-hand row."""
    problem, run, point, matrices, recorder = m.problem, m.run, m.point, m.linear.matrices, m.recorder
    if run.adaptive == 1:
        run.h_next = first_step(problem, run, point, matrices, starting, share, order)
        watch_growth(m)
    run.last_error = 0.0
    m.events.settling.least_lookahead = 0.0
    run.retried = 0
    m.events.loads.nothing_before = 0
    matrices.jacobian_fresh = 0
    m.linear.factors.factored_h = 0.0
    run.inconsistent_start = 0
    run.judged = 1
    run.crossed = 0
    if not starting or recorder.on_grid == 0 or recorder.grid_next == 0:
        write_row(problem, recorder, point.t, as_shown(m, point.at_y, False), ORDINARY if starting else AFTER)
    recorder.shown_apart = 0
    if starting:
        recorder.grid_next = 1
        copy(reals(point.at_y, point.n), reals(point.at_begun, point.n))
    run.phase = TRY


@compiled
def first_step(problem, run, point, matrices, starting, share, order):
    """The first step after a settlement, or what the run says at its start; `share` and `order` as in loop.Method."""
    weigh(point, point.at_y)
    keep_differential(problem, point.at_slope, point.at_u)
    speed = weighted_norm(point, point.at_u)
    curvature = curvature_beyond_rounding(point, matrices)
    keep_algebraic(problem, point.at_curvature, point.at_u)
    h = restart(run, speed, curvature, weighted_norm(point, point.at_u))
    if run.first_step > 0.0 and run.steps == 0:
        h = run.first_step if starting else h
    elif share > 0.0:
        h = min(h, longest_first_step(run, speed, curvature, share, order))
    return max(min(h, 0.1 * (run.stop - run.start)), 4.0 * smallest_step(run, point))


@compiled
def keep_algebraic(problem, at_v, at_u):
    """U = v where y_i is algebraic, else 0."""
    v, u, differential = reals(at_v, problem.n), reals(at_u, problem.n), indices(problem.at_differential, problem.n)
    for k in range(problem.n):
        u[k] = v[k] if differential[k] == 0 else 0.0


@compiled
def keep_differential(problem, at_v, at_u):
    """U = v where y_i is differential, else 0."""
    v, u, differential = reals(at_v, problem.n), reals(at_u, problem.n), indices(problem.at_differential, problem.n)
    for k in range(problem.n):
        u[k] = v[k] if differential[k] == 1 else 0.0
