"""One step of nonsmooth time stepping: the zones are unknowns of the step (after Moreau 1988).

    rows with mass     M (y1 - y0)/h = f(t0 + theta h, u, a)
    algebraic rows                 0 = f(t0 + theta h, u, a)        u = y0 + theta (y1 - y0)
    held contacts                  0 = slip(t0 + h, y1)

y are the differential unknowns, a the algebraic ones: forces of contacts, means over the step. theta = 1/2 is the
implicit midpoint rule, of order two, which third_order.py makes one of order three that damps what is stiff;
theta above 1/2, of order one, is taken where zones cycle. A guard reads what its
law reads: slips at the end of the step, forces and their limits at the point u. So a contact that holds and one
that slides are the two branches of |force| <= limit, slip at the end = 0 or against the force: a complementarity
problem. It is solved by an active set (active_set.py): solve with the zones frozen, switch those whose guards are
violated, solve again. Smooth nonlinearity is taken up by the same iteration, which ends when no guard is violated and
the residual passes. Where f is linear as long as the zones are frozen one solve is exact, and the residual
is looked at once per factorisation.

The matrix is the W of the Rosenbrock methods with gamma = theta, for theta (y1 - y0), so that one plan of
pivots serves both engines; the row of a held contact is M/(h theta) alone. The speed of a node without mass is
algebraic, a mean over the step like a force: a contact on such a node holds that, its slip is zero at the point u.
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.active_set import begin_set, expect_fronts, follow_guards, learn_from_neighbours, violators
from fairlead.integrate.codes import MIDDLE
from fairlead.integrate.exchange import exchange_rows, give_up_guesses, solve_exchanged, watch_surfaces
from fairlead.integrate.foreign import compiled, copy, field_at, indices, jacobian_at, mass_at, reals
from fairlead.integrate.guards import evaluate_guards
from fairlead.integrate.jumps import all_continuous, find_jump, law_jumps
from fairlead.integrate.known_rows import learn_constants, learn_rows, rows_tell
from fairlead.integrate.line_search import GIVEN_UP, MOST_SEARCHED, SEARCHED, remember_move, search_line
from fairlead.integrate.linear import DONE, INACCURATE, factorise_step, solve
from fairlead.integrate.missed_impulse import forget_switches, note_switches
from fairlead.integrate.step_residual import PASSED, move_end, residual_of_step, scaled_residual, theta_point

CYCLES, DIVERGES, JUMPS, GO_ON, AFRESH = 6, 7, 8, 9, 10
SLOW = 0.01
"""A residual that shrinks by less than this in an iteration asks for a new Jacobian."""
LOOK_AT_LIMITS = 8
"""Steps from one look at whether limits vary with time to the next."""
MOST_SOLVES, MOST_LINEAR_SOLVES = 10, 3
"""Solves without a switch before the step counts as not converging; a linear one needs no more than a refinement."""


@compiled
def take_theta_step(m, h):
    """Compute `y_end` and the zones that go with it.

    Returns DONE, SINGULAR, INACCURATE, CYCLES, DIVERGES or JUMPS (a switch with a jump, at `t_jump`).
    """
    predict(m, h)
    forget_switches(m)
    begin_set(m)
    expect_fronts(m, h)
    solves, solved, previous = 0, False, 1e300
    m.guessed, m.caught_by_row, m.searched = 0, 0, 0
    while True:
        m.midway = 1 if solved or m.linear == 0 else 0
        if m.linear == 0 and solves > 0:
            search_line(m, h, previous)
        status = linearise_step(m, h)
        if status != DONE:
            return status
        if solved and m.rows_alone == 1 and m.one_by_one == 0 and rows_tell(m):
            solve_exchanged(m, h)
        else:
            verdict, previous = approach_laws(m, h, solves, previous)
            if verdict == AFRESH:
                solves = 0
                continue
            if verdict != GO_ON:
                return verdict
        solved = True
        solves += 1
        m.newly_held = 0
        if m.locates == 1:
            m.n_fired = 0
        else:
            guards_of_step(m, h)
            violators(m)
        if m.n_fired == 0:
            if m.linear == 1 and m.unchecked == 0:
                add_quadratures(m, h)
                return DONE
            continue
        solves = 0
        status = switch_zones(m, h)
        if status == CYCLES and m.guessed > 0:
            give_up_guesses(m)
        if status != GO_ON:
            return status


@compiled
def approach_laws(m, h, solves, previous):
    """Judge the residual after `solves` without a switch, solve for it: DONE, GO_ON, AFRESH or why not; its size.

    Where f is not linear `search_line` has left the residual after a solve.
    """
    m.newly_held |= m.caught_by_row
    size = previous
    if m.linear == 1:
        residual_of_step(m, h, solves > 0)
    elif solves == 0:
        residual_of_step(m, h, False)
        size = scaled_residual(m)
    if solves > 0:
        verdict, size = judge_residual(m, solves, previous)
        if verdict == DONE:
            move_quadratures(m, h)
            if m.caught_by_row == 1:
                watch_surfaces(m)
        elif m.guessed > 0:
            give_up_guesses(m)
            return AFRESH, size
        if verdict != GO_ON:
            return verdict, size
    if m.n_exchanged > 0 and m.linear == 1:
        learn_constants(m)
    solve(m, m.at_b)
    if m.linear == 0:
        remember_move(m)
    move_end(m)
    return GO_ON, size


@compiled
def switch_zones(m, h):
    """Switch the zones whose guards are violated: GO_ON, CYCLES, or JUMPS where a law jumps."""
    note_switches(m)
    if m.passes > 0:
        learn_from_neighbours(m)
    known = all_continuous(m)
    if m.passes == 0 and not known and m.gap > 0.0 and law_jumps(m, h):
        find_jump(m, h)
        return JUMPS
    if follow_guards(m, h, known):
        find_jump(m, h)
        return JUMPS
    return CYCLES if m.passes > m.max_passes else GO_ON


@compiled
def judge_residual(m, solves, previous):
    """DONE, GO_ON with another solve, or why not; and the size of the residual."""
    size = scaled_residual(m)
    if not isfinite(size):
        return DIVERGES, size
    if size <= PASSED:
        m.unchecked = 0
        if solves > 2:
            m.linearised = 0
        return DONE, size
    if m.linear == 1 and solves >= MOST_LINEAR_SOLVES:
        m.linearised = 0
        return INACCURATE, size
    if m.searched == GIVEN_UP or solves >= (MOST_SEARCHED if m.searched == SEARCHED else MOST_SOLVES):
        return DIVERGES, size
    if solves > 1 and size > SLOW * previous:
        m.linearised = 0
    return GO_ON, size


@compiled
def predict(m, h):
    """First guess of the end: on along the last slope, forces as they were."""
    y, y_end, slope = reals(m.at_y, m.n), reals(m.at_y_end, m.n), reals(m.at_slope_before, m.n)
    differential = indices(m.at_differential, m.n)
    for k in range(m.n):
        y_end[k] = y[k] + h * slope[k] if differential[k] == 1 else y[k]


@compiled
def linearise_step(m, h):
    """M, J and the factors, as far as they are not those of the zones and the step in force."""
    m.n_exchanged, m.rows_alone = 0, 0
    if m.zones_differ == 1 and m.linearised == 1:
        factorised = m.factored_h == h and m.factored_theta == m.theta_now and m.core_valid == 1
        if m.dense == 1 or not exchange_rows(m, factorised):
            m.linearised, m.n_exchanged = 0, 0
        elif factorised:
            m.factorisations += 1
            m.unchecked, m.zones_differ, m.rows_alone = 1, 0, 1
            return DONE
        else:
            m.factored_h = 0.0
    m.zones_differ = 0
    evaluated = m.linearised == 0
    if evaluated:
        evaluate_slopes(m, h)
    if m.factored_h == h and m.factored_theta == m.theta_now:
        return DONE
    m.factored_h = 0.0
    status = factorise_step(m, 1.0 / (h * m.theta_now))
    if status != DONE and not evaluated:  # rows that were exchanged are not all that a switch changes in a circle
        m.n_exchanged = 0
        evaluate_slopes(m, h)
        status = factorise_step(m, 1.0 / (h * m.theta_now))
    m.unchecked = 1
    if status == DONE:
        m.factored_h = h
        m.factored_theta = m.theta_now
    return status


@compiled
def evaluate_slopes(m, h):
    """M and J of the zones in force, at the theta point."""
    mass_at(m.call_mass, (m.context, m.at_mass))
    theta_point(m)
    jacobian_at(m.call_slopes, (m.context, m.t + m.theta_now * h, m.at_u, m.at_jacobian, m.at_ft))
    m.jacobians += 1
    find_holds(m)
    if m.dense == 0:
        learn_rows(m)
    m.linearised = 1
    m.factored_h = 0.0


@compiled
def find_holds(m):
    """Mark the rows of contacts that hold, and take J out of them: there the slip at the end is zero.

    They are the rows of algebraic unknowns in which M has an entry now. `driven` tells of a surface with
    a speed that varies, `caught` of rows that did not hold before.
    """
    caught = indices(m.at_caught, m.n)
    holds, slopes, ft = indices(m.at_holds, m.n), reals(m.at_jacobian, m.n_jacobian), reals(m.at_ft, m.n)
    entry, row = indices(m.at_hold_mass, m.n_hold_mass), indices(m.at_hold_mass_row, m.n_hold_mass)
    values = reals(m.at_mass, m.n_mass)
    column, differential = indices(m.at_hold_mass_column, m.n_hold_mass), indices(m.at_differential, m.n)
    of_massless = indices(m.at_of_massless, m.n)
    for e in range(m.n_hold_mass):
        if holds[row[e]] == 1:
            holds[row[e]] = 2
        if values[entry[e]] != 0.0 and differential[column[e]] == 0:
            of_massless[row[e]] = 1
            m.massless = 1
    m.driven = 0
    for e in range(m.n_hold_mass):
        if values[entry[e]] != 0.0:
            if holds[row[e]] == 0:
                caught[row[e]] = 1
                m.newly_held = 1
            holds[row[e]] = 1
            if ft[row[e]] != 0.0:
                m.driven = 1
    for e in range(m.n_hold_mass):
        if holds[row[e]] == 2:
            holds[row[e]] = 0
    entry, row = indices(m.at_hold_slope, m.n_hold_slope), indices(m.at_hold_slope_row, m.n_hold_slope)
    for e in range(m.n_hold_slope):
        if holds[row[e]] == 1:
            slopes[entry[e]] = 0.0


@compiled
def guards_of_step(m, h):
    """Into `g_end` every guard where its law is read: limits of forces at the theta point, others at the end.

    Of contacts on nodes without mass all are read at the theta point.

    A limit that varies (a normal force that follows a tension) would else let a contact go that, sliding, is
    held back by more than it was let go for. Where f is linear no limit varies with the unknowns; whether one varies
    with time is looked at now and then, and where zones cycle.
    """
    evaluate_guards(m, m.t + h, m.at_y_end, m.at_g_end)
    constant = m.linear == 1 and m.limits_vary == 0
    seldom = constant and m.one_by_one == 0 and (m.passes > 0 or m.steps % LOOK_AT_LIMITS != 0)
    if m.massless == 0 and (m.has_limits == 0 or seldom):
        return
    theta_point(m)
    evaluate_guards(m, m.t + m.theta_now * h, m.at_u, m.at_g_probe)
    g, at_theta, is_limit = (
        reals(m.at_g_end, m.n_guards), reals(m.at_g_probe, m.n_guards), indices(m.at_limit_guard, m.n_guards),
    )  # fmt: skip
    tolerance = reals(m.at_guard_tolerance, m.n_guards)
    for i in range(m.n_guards):
        if is_limit[i] == 1:
            if abs(g[i] - at_theta[i]) > tolerance[i]:
                m.limits_vary = 1
            g[i] = at_theta[i]
    if m.massless == 1:
        machine, rows = indices(m.at_guard_machine, m.n_guards), indices(m.at_hold_row, m.n_zones)
        of_massless = indices(m.at_of_massless, m.n)
        for i in range(m.n_guards):
            if machine[i] >= 0 and rows[machine[i]] >= 0 and of_massless[rows[machine[i]]] == 1:
                g[i] = at_theta[i]


@compiled
def add_quadratures(m, h):
    """The rise of the quadratures over the step that was taken; the iteration leaves them out."""
    if m.n_quadratures > 0 and m.theta_now != MIDDLE:
        theta_point(m)
        field_at(m.call_rhs, (m.context, m.t + m.theta_now * h, m.at_u, m.at_f))
        m.rhs += 1
        move_quadratures(m, h)


@compiled
def move_quadratures(m, h):
    """The quadratures at the end, from f at the theta point."""
    y, y_end, f = reals(m.at_y, m.n), reals(m.at_y_end, m.n), reals(m.at_f, m.n)
    quadrature = indices(m.at_quadrature, m.n)
    for k in range(m.n):
        if quadrature[k] == 1:
            y_end[k] = y[k] + h * f[k]


@compiled
def give_back_zones(m):
    """The zones of the start of the step; M and J are then not theirs."""
    copy(indices(m.at_zones_at_start, m.n_zones), indices(m.at_zones, m.n_zones))
    m.zones_differ = 1
    m.n_fired = 0
