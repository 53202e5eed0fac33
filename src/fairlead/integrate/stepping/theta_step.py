"""One step of nonsmooth time stepping: the zones are unknowns of the step (after Moreau 1988).

    rows with mass     M (y1 - y0)/h = f(t0 + theta h, u, a)
    algebraic rows                 0 = f(t0 + theta h, u, a)        u = y0 + theta (y1 - y0)
    held contacts                  0 = slip(t0 + h, y1)

y are the differential unknowns, a the algebraic ones: forces of contacts, means over the step. theta = 1/2 is the
implicit midpoint rule, of order two, which third_order.py makes one of order three that damps what is stiff; theta
above 1/2, of order one, is taken where zones cycle (repeated.py), over the kink of a table (trial.step_over_kink), and
where a run asks for it (`Run.theta`). A guard reads what its law reads: slips at the end of the step, forces and their
limits at the point u. So a contact that holds and one that slides are the two branches of |force| <= limit, slip at the
end = 0 or against the force: a complementarity problem. It is solved by an active set (active_set.py): solve with the
zones frozen, switch those whose guards are violated, solve again. Smooth nonlinearity is taken up by the same
iteration, which ends when no guard is violated and the residual passes. Where f is linear as long as the zones are
frozen one solve is exact, and the residual is looked at once per factorisation. Where every switch is landed on
(`rule.locates`), the zones are those of the start of the step, and only the smooth iteration is left.

The matrix is the W of the Rosenbrock methods with gamma = theta, for theta (y1 - y0), so that one plan of pivots serves
`rodas` and `stepping`; the row of a held contact is M/(h theta), and its share of other forces where it closes a
circle. The speed of a node without mass is algebraic, a mean over the step like a force: a contact on such a node holds
that, its slip is zero at the point u.
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import AFRESH, CYCLES, DIVERGES, DONE, INACCURATE, JUMPS, MIDDLE, ONCE_MORE
from fairlead.integrate.events.guards import evaluate_guards, latches_wait
from fairlead.integrate.linear.systems import factorise_step, solve
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, jacobian_at, mass_at, reals
from fairlead.integrate.stepping.active_set import (
    begin_set,
    expect_fronts,
    fire_violators_of_step,
    follow_guards,
    learn_from_neighbours,
)
from fairlead.integrate.stepping.jump_at_end import all_continuous, find_jumping_law, find_means, place_jump
from fairlead.integrate.stepping.jump_inside import (
    doubt_captures,
    forget_jumps,
    note_fired,
    put_jumps_right,
)
from fairlead.integrate.stepping.residual import (
    GIVEN_UP,
    MOST_SEARCHED,
    SEARCHED,
    SOLVED,
    find_residual_of_step,
    find_theta_point,
    move_end,
    read_at_instant,
    read_on_chord,
    remember_move,
    scaled_residual,
    search_line,
)
from fairlead.integrate.stepping.row_cache import (
    exchange_rows,
    invalidate_assumed,
    learn_constants,
    learn_rows,
    rows_are_known,
    solve_exchanged,
    watch_surfaces,
)
from fairlead.integrate.stepping.switch_inside import forget_switches, note_switches

SLOW = 0.01
"""A residual that shrinks by less than this in an iteration asks for a new Jacobian."""
LOOK_AT_LIMITS = 8
"""Steps from one look at whether limits vary with time to the next."""
MOST_SOLVES, MOST_LINEAR_SOLVES = 10, 3
"""Solves without a switch before the step counts as not converging; a linear one needs no more than a refinement."""

NEAREST = 0.1
"""Share of a step at which a jump is told at the nearest, if others have switched before it: the line to it ends in a
pattern of zones then that is passed on the way, whose forces may be anything."""


@compiled
def take_theta_step(m, h):
    """Compute `y_end` and the zones that go with it.

    Returns DONE, SINGULAR, INACCURATE, CYCLES, DIVERGES or JUMPS (a switch with a jump, at `t_cut`).
    """
    problem, point, linear, guards, settling = m.problem, m.point, m.linear, m.events.guards, m.events.settling
    stepping, rule, exchange = m.stepping, m.stepping.rule, m.stepping.exchange
    predict(point, rule, h)
    forget_switches(m.stepping.contacts)
    forget_jumps(rule)
    begin_set(m.run, settling, stepping)
    expect_fronts(m, h)
    solves, solved, previous = 0, False, 1e300
    exchange.assumed, exchange.caught_by_row, rule.searched = 0, 0, 0
    while True:
        rule.midway = 1 if solved or problem.linear == 0 else 0
        if problem.linear == 0 and solves > 0:
            search_line(problem, point, linear, stepping, h, previous)
        status = linearise_step(problem, point, linear, stepping, h)
        if status != DONE:
            return status
        if solved and exchange.rows_alone == 1 and settling.one_by_one == 0 and rows_are_known(problem, exchange):
            solve_exchanged(problem, point, linear, stepping, h)
        else:
            verdict, previous = approach_laws(problem, point, linear, stepping, h, solves, previous)
            if verdict == AFRESH:
                solves = 0
                continue
            if verdict != ONCE_MORE:
                return verdict
        solved = True
        solves += 1
        exchange.newly_held = 0
        if rule.locates == 0:
            evaluate_guards_of_step(m, h)
            fire_violators_of_step(guards)
            doubt_captures(m, h)
            latches_wait(problem, guards)
        if rule.locates == 1 or rule.frozen == 1:
            guards.n_fired = 0
        if guards.n_fired == 0:
            if problem.linear == 1 and exchange.unchecked == 0:
                add_quadratures(problem, point, rule, h)
                return DONE
            continue
        solves = 0
        status = switch_zones(m, h)
        if status == CYCLES and exchange.assumed > 0:
            invalidate_assumed(stepping)
        if status != ONCE_MORE:
            return status


@compiled
def approach_laws(problem, point, linear, stepping, h, solves, previous):
    """Judge the residual after `solves` without a switch, solve for it: DONE, ONCE_MORE, AFRESH or why not; its size.

    Where f is not linear `search_line` has left the residual after a solve.
    """
    matrices, rule, exchange = linear.matrices, stepping.rule, stepping.exchange
    exchange.newly_held |= exchange.caught_by_row
    size = previous
    if problem.linear == 1:
        find_residual_of_step(problem, point, matrices, stepping, h, solves > 0)
    elif solves == 0:
        find_residual_of_step(problem, point, matrices, stepping, h, False)
        size = scaled_residual(point, linear)
    if solves > 0:
        verdict, size = judge_residual(problem, point, linear, stepping, solves, previous)
        if verdict == DONE:
            move_quadratures(point, h)
            if exchange.caught_by_row == 1:
                watch_surfaces(problem, point, matrices, exchange)
        elif exchange.assumed > 0:
            invalidate_assumed(stepping)
            return AFRESH, size
        if verdict != ONCE_MORE:
            return verdict, size
    if exchange.n_exchanged > 0 and problem.linear == 1:
        learn_constants(point, matrices, stepping)
    solve(linear, point.at_b)
    if problem.linear == 0:
        remember_move(point, rule)
    move_end(point, rule)
    return ONCE_MORE, size


@compiled
def switch_zones(m, h):
    """Switch the zones whose guards are violated: ONCE_MORE, CYCLES, or JUMPS where a law jumps."""
    run, point, guards, settling, rule = m.run, m.point, m.events.guards, m.events.settling, m.stepping.rule
    contacts = m.stepping.contacts
    note_switches(guards, m.stepping)
    if settling.passes > 0:
        learn_from_neighbours(run, guards, contacts)
    known = all_continuous(guards, contacts)
    if settling.passes == 0 and not known and rule.gap > 0.0 and find_jumping_law(m, h):
        find_means(m, h)
        place_jump(point, guards, contacts, rule, h)
        return JUMPS
    note_fired(guards, contacts)
    if follow_guards(m, h, known):
        copy(indices(contacts.at_zones_probed, contacts.n_machines), indices(contacts.at_zones, contacts.n_machines))
        find_means(m, h)
        place_jump(point, guards, contacts, rule, h)
        if settling.passes > 1:
            rule.t_cut = max(rule.t_cut, point.t + NEAREST * h)
        return JUMPS
    if not known:
        put_jumps_right(m, h)
    return CYCLES if settling.passes > run.max_passes else ONCE_MORE


@compiled
def judge_residual(problem, point, linear, stepping, solves, previous):
    """DONE, ONCE_MORE with another solve, or why not; and the size of the residual."""
    rule = stepping.rule
    size = scaled_residual(point, linear)
    if not isfinite(size):
        return DIVERGES, size
    if size <= SOLVED:
        stepping.exchange.unchecked = 0
        if solves > 2:
            rule.linearised = 0
        return DONE, size
    if problem.linear == 1 and solves >= MOST_LINEAR_SOLVES:
        rule.linearised = 0
        return INACCURATE, size
    if rule.searched == GIVEN_UP or solves >= (MOST_SEARCHED if rule.searched == SEARCHED else MOST_SOLVES):
        return DIVERGES, size
    if solves > 1 and size > SLOW * previous:
        rule.linearised = 0
    return ONCE_MORE, size


@compiled
def predict(point, rule, h):
    """First guess of the end: on along the last slope, forces as they were."""
    y, y_end, slope = reals(point.at_y, point.n), reals(point.at_y_end, point.n), reals(rule.at_slope_before, point.n)
    differential = indices(point.at_differential, point.n)
    for k in range(point.n):
        y_end[k] = y[k] + h * slope[k] if differential[k] == 1 else y[k]


@compiled
def linearise_step(problem, point, linear, stepping, h):
    """M, J and the factors, as far as they are not those of the zones and the step in force."""
    factors, rule, exchange = linear.factors, stepping.rule, stepping.exchange
    exchange.n_exchanged, exchange.rows_alone = 0, 0
    if exchange.zones_differ == 1 and rule.linearised == 1:
        same = factors.factored_h == h and factors.factored_theta == rule.theta_now
        factorised = same and linear.core.core_valid == 1
        if factors.dense == 1 or not exchange_rows(problem, linear, stepping, factorised):
            rule.linearised, exchange.n_exchanged = 0, 0
        elif factorised:
            factors.factorisations += 1
            exchange.unchecked, exchange.zones_differ, exchange.rows_alone = 1, 0, 1
            return DONE
        else:
            factors.factored_h = 0.0
    exchange.zones_differ = 0
    evaluated = rule.linearised == 0
    if evaluated:
        evaluate_slopes(problem, point, linear, stepping, h)
    if factors.factored_h == h and factors.factored_theta == rule.theta_now:
        return DONE
    factors.factored_h = 0.0
    status = factorise_step(linear, 1.0 / (h * rule.theta_now))
    if status != DONE and not evaluated:  # rows that were exchanged are not all that a switch changes in a circle
        exchange.n_exchanged = 0
        evaluate_slopes(problem, point, linear, stepping, h)
        status = factorise_step(linear, 1.0 / (h * rule.theta_now))
    exchange.unchecked = 1
    if status == DONE:
        factors.factored_h = h
        factors.factored_theta = rule.theta_now
    return status


@compiled
def evaluate_slopes(problem, point, linear, stepping, h):
    """M and J of the zones in force, at the theta point."""
    matrices, factors, rule = linear.matrices, linear.factors, stepping.rule
    mass_at(problem.call_mass, (problem.context, matrices.at_mass))
    find_theta_point(point, rule)
    t = point.t + rule.theta_now * h
    read_on_chord(problem, point, rule.theta_now, h)
    jacobian_at(problem.call_slopes, (problem.context, t, point.at_u, matrices.at_jacobian, point.at_ft))
    read_at_instant(problem)
    problem.jacobians += 1
    find_holds(point, matrices, stepping.exchange)
    if factors.dense == 0:
        learn_rows(problem, matrices, stepping)
    rule.linearised = 1
    factors.factored_h = 0.0


@compiled
def find_holds(point, matrices, exchange):
    """Mark the rows of contacts that hold, and take J out of them but for shares: there the slip at the end is zero.

    They are the rows of algebraic unknowns in which M has an entry now. `driven` tells of a surface with
    a speed that varies, `caught` of rows that did not hold before.
    """
    caught = indices(exchange.at_caught, point.n)
    holds, slopes = indices(exchange.at_holds, point.n), reals(matrices.at_jacobian, matrices.n_jacobian)
    ft = reals(point.at_ft, point.n)
    entry = indices(exchange.at_hold_mass, exchange.n_hold_mass)
    row = indices(exchange.at_hold_mass_row, exchange.n_hold_mass)
    values = reals(matrices.at_mass, matrices.n_mass)
    column = indices(exchange.at_hold_mass_column, exchange.n_hold_mass)
    differential = indices(point.at_differential, point.n)
    of_massless = indices(exchange.at_of_massless, point.n)
    for e in range(exchange.n_hold_mass):
        if holds[row[e]] == 1:
            holds[row[e]] = 2
        if values[entry[e]] != 0.0 and differential[column[e]] == 0:
            of_massless[row[e]] = 1
            exchange.massless = 1
    exchange.driven = 0
    for e in range(exchange.n_hold_mass):
        if values[entry[e]] != 0.0:
            if holds[row[e]] == 0:
                caught[row[e]] = 1
                exchange.newly_held = 1
            holds[row[e]] = 1
            if ft[row[e]] != 0.0:
                exchange.driven = 1
    for e in range(exchange.n_hold_mass):
        if holds[row[e]] == 2:
            holds[row[e]] = 0
    entry = indices(exchange.at_hold_slope, exchange.n_hold_slope)
    row = indices(exchange.at_hold_slope_row, exchange.n_hold_slope)
    for e in range(exchange.n_hold_slope):
        if holds[row[e]] == 1:
            slopes[entry[e]] = 0.0


@compiled
def evaluate_guards_of_step(m, h):
    """Into `g_end` every guard where its law is read: limits of forces at the theta point, others at the end.

    Of contacts on nodes without mass all are read at the theta point.

    A limit that varies (a normal force that follows a tension) would else let a contact go that, sliding, is
    held back by more than it was let go for. Where f is linear no limit varies with the unknowns; whether one varies
    with time is looked at now and then, and where zones cycle.
    """
    problem, run, point, guards, settling = m.problem, m.run, m.point, m.events.guards, m.events.settling
    rule, exchange, contacts = m.stepping.rule, m.stepping.exchange, m.stepping.contacts
    evaluate_guards(problem, run, guards, point.t + h, point.at_y_end, guards.at_g_end)
    constant = problem.linear == 1 and contacts.limits_vary == 0
    seldom = constant and settling.one_by_one == 0 and (settling.passes > 0 or run.steps % LOOK_AT_LIMITS != 0)
    if exchange.massless == 0 and (contacts.has_limits == 0 or seldom):
        return
    find_theta_point(point, rule)
    read_on_chord(problem, point, rule.theta_now, h)
    evaluate_guards(problem, run, guards, point.t + rule.theta_now * h, point.at_u, guards.at_g_probe)
    read_at_instant(problem)
    g, g_at_theta, is_limit = (
        reals(guards.at_g_end, problem.n_guards), reals(guards.at_g_probe, problem.n_guards),
        indices(contacts.at_limit_guard, problem.n_guards),
    )  # fmt: skip
    tolerance = reals(guards.at_guard_tolerance, problem.n_guards)
    for i in range(problem.n_guards):
        if is_limit[i] == 1:
            if abs(g[i] - g_at_theta[i]) > tolerance[i]:
                contacts.limits_vary = 1
            g[i] = g_at_theta[i]
    if exchange.massless == 1:
        machine = indices(problem.at_guard_machine, problem.n_guards)
        hold_row = indices(contacts.at_hold_row, problem.n_machines)
        of_massless = indices(exchange.at_of_massless, problem.n)
        for i in range(problem.n_guards):
            if machine[i] >= 0 and hold_row[machine[i]] >= 0 and of_massless[hold_row[machine[i]]] == 1:
                g[i] = g_at_theta[i]


@compiled
def add_quadratures(problem, point, rule, h):
    """The rise of the quadratures over the step that was taken; the iteration leaves them out."""
    if problem.n_quadratures > 0 and rule.theta_now != MIDDLE:
        find_theta_point(point, rule)
        read_on_chord(problem, point, rule.theta_now, h)
        field_at(problem.call_rhs, (problem.context, point.t + rule.theta_now * h, point.at_u, point.at_f))
        read_at_instant(problem)
        problem.rhs += 1
        move_quadratures(point, h)


@compiled
def move_quadratures(point, h):
    """The quadratures at the end, from f at the theta point."""
    y, y_end, f = reals(point.at_y, point.n), reals(point.at_y_end, point.n), reals(point.at_f, point.n)
    quadrature = indices(point.at_quadrature, point.n)
    for k in range(point.n):
        if quadrature[k] == 1:
            y_end[k] = y[k] + h * f[k]


@compiled
def give_back_zones(guards, stepping):
    """The zones of the start of the step; M and J are then not theirs."""
    exchange = stepping.exchange
    nz = exchange.n_machines
    copy(indices(stepping.contacts.at_zones_at_start, nz), indices(exchange.at_zones, nz))
    exchange.zones_differ = 1
    guards.n_fired = 0
