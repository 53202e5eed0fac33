"""Consistent points: y' of the differential and y of the algebraic unknowns, zones frozen.

    find (y'_d, y_a) with M y' = f(t, y):   C (dy'_d, dy_a) = f - M y',
    C = columns of M where differential, of -J where algebraic

By Newton; linear problems take one iteration, and a second to know it. Impacts come first (impulse.py). Then held rows
project: at a capture C (dV, Lambda) = r with r = -v_rel on the rows that hold gives the impulse that brings them to
rest and conserves momentum; dV is added to the differential unknowns, Lambda dropped. It is of the size of rounding.

Where Newton fails, it begins once more with damped updates (`damped_newton`). A flow through an orifice that stops at
once needs them: of x/(x^2 + c^2)^(1/4) = 0 the full update leads from a large x to -x, and back.
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import DONE, NOT_CONSISTENT, SINGULAR
from fairlead.integrate.events.balance import ROUNDS, close_balance
from fairlead.integrate.events.impulse import NO_IMPACT, find_change_of_speed, resolve_impact
from fairlead.integrate.events.impulse_changes import any_support_moves, energies
from fairlead.integrate.events.position import in_units_of_light, project_positions
from fairlead.integrate.linear.products import add_mass_times, add_slopes_times
from fairlead.integrate.linear.systems import factorise_consistent, solve, solve_checked
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, jacobian_at, mass_at, reals, slip_at
from fairlead.integrate.point.controller import weigh, weighted_norm

OF_POSITIONS = 3
"""What a row takes that keeps a relation of positions: any impulse, see `Facts.takes_impulse`."""
SLIP_LEFT = 1e-6
"""Share of the slip of contacts that relations of positions may be left with: more would be an impact on the next."""
SETTLED_UPDATE = 1e-6
"""A Newton update of the algebraic unknowns below this, in units of their weights, is the last."""

REFRESHED = 3
"""Newton updates after which the weights are those of the forces found so far; most settle in two."""
LAST_DIGITS = 1e-3
"""An update below this that no longer halves is rounding: of a force of 3e5 N, 1e-11 N is."""
DAMPED_UPDATES, LEAST_FRACTION = 50, 1e-4
"""Most damped updates, and the least share of one that is tried: those of the code NLEQ1 for highly nonlinear problems
(Nowak and Weimann 1991, ZIB TR 91-10)."""


@compiled
def prepare_consistent(problem, point, linear):
    """J here, and the factors of C."""
    matrices = linear.matrices
    jacobian_at(problem.call_jacobian, (problem.context, point.t, point.at_y, matrices.at_jacobian, point.at_ft))
    problem.jacobians += 1
    matrices.jacobian_fresh = 0
    linear.factors.factored_h = 0.0
    return factorise_consistent(linear)


@compiled
def project(problem, point, linear):
    """Bring held rows to rest by the impulse that conserves momentum.

    The ledger takes it as an impact, by what it does to the speeds: the numbers by which bodies in circles share it are
    without bounds. Integrals of forces take nothing of it.

    Not where that is more than rounding or would leave a relation of positions, as where its ratio goes through zero: a
    crank in its dead centre is not stopped by what stops the slider. The force that would be needed decides.
    """
    n = problem.n
    if problem.call_slip == 0:
        return
    taken_away = reals(point.at_b, n)
    taken_away[:] = 0.0
    slip_at(problem.call_slip, (problem.context, point.t, point.at_y, point.at_b))
    all_rest = True
    for k in range(n):
        all_rest = all_rest and taken_away[k] == 0.0
    if all_rest:
        return
    if problem.n_accelerated > 0:
        copy(taken_away, reals(point.at_v, n))
    solve(linear, point.at_b)
    y, differential = reals(point.at_y, n), indices(problem.at_differential, n)
    relations = problem.n_accelerated > 0
    if relations and (find_change_of_speed(problem, point) > NO_IMPACT or hands_slip_on(problem, point)):
        return
    is_speed, dv, back = indices(problem.at_is_speed, n), reals(point.at_u, n), reals(point.at_y_probe, n)
    for k in range(n):  # of a place that would be the change of its rate
        dv[k] = taken_away[k] if differential[k] == 1 and is_speed[k] == 1 else 0.0
        back[k] = 0.0
    if problem.dissipated_at >= 0:
        gained, loss = energies(point, linear.matrices)
        y[problem.dissipated_at] += loss
        y[problem.supplied_at] += gained + loss if any_support_moves(problem, point) else 0.0
    for k in range(n):
        y[k] += dv[k]


@compiled
def hands_slip_on(problem, point):
    """True if the change of speed in u takes slip (in v) from contacts and leaves it to relations of positions."""
    n = problem.n
    y, dv, moved, slip = reals(point.at_y, n), reals(point.at_u, n), reals(point.at_y_probe, n), reals(point.at_v, n)
    takes, left = indices(problem.at_takes_impulse, n), reals(point.at_x, n)
    for k in range(n):
        moved[k] = y[k] + dv[k]
    slip_at(problem.call_slip, (problem.context, point.t, point.at_y_probe, point.at_x))
    before = taken = after = 0.0
    for k in range(n):
        if takes[k] == OF_POSITIONS:
            before = max(before, abs(slip[k]))
            after = max(after, abs(left[k]))
        else:
            taken = max(taken, abs(slip[k]))
    return after > max(before, SLIP_LEFT * taken)


@compiled
def keep_positions(problem, point, linear):
    """Bring the end of a step back to the relations of positions: positions, speeds, and what follows from them.

    Nodes without inertia are brought to where their forces balance, from where the dense output has put them.
    DONE or INACCURATE. Where relations are not independent of what holds, the end stays as it is.
    """
    status = prepare_consistent(problem, point, linear)
    if status == SINGULAR:
        return DONE
    if status == DONE and problem.n_moves > 0:
        status = project_positions(problem, point, linear)
    if status != DONE:
        return status
    if problem.n_balanced > 0:
        close_balance(problem, point, linear)
    project(problem, point, linear)
    find_residual(problem, point, linear.matrices, point.at_x)
    solve(linear, point.at_x)
    update(point, 1.0)
    if problem.n_moves > 0:
        point.projections += 1
        point.most_moved = max(point.most_moved, point.moved)
    if problem.n_accelerated == 0:
        find_slope_change(point, linear)
    return DONE


@compiled
def correct_forces(problem, point, linear):
    """Give a point of the interpolant the algebraic unknowns and y' that the equations say; DONE or INACCURATE.

    One Newton update: what is left is of second order in the error of the interpolant.
    """
    status = prepare_consistent(problem, point, linear)
    if status == SINGULAR:
        return DONE
    if status == DONE:
        find_residual(problem, point, linear.matrices, point.at_x)
        solve(linear, point.at_x)
        update(point, 1.0)
        find_slope_change(point, linear)
    return status


@compiled
def find_residual(problem, point, matrices, at_r):
    """Set r = f(t, y) - M y' at the point."""
    n = problem.n
    field_at(problem.call_rhs, (problem.context, point.t, point.at_y, point.at_f))
    problem.rhs += 1
    minus_rate, slope, r, f = reals(point.at_v, n), reals(point.at_slope, n), reals(at_r, n), reals(point.at_f, n)
    differential = indices(problem.at_differential, n)
    for k in range(n):
        minus_rate[k] = -slope[k] if differential[k] == 1 else 0.0
        r[k] = f[k]
    add_mass_times(matrices, point.at_v, at_r)
    if problem.n_light > 0:
        slip_of_light(problem, point, matrices, at_r)


@compiled
def follow_what_holds(problem, point, linear):
    """Give nodes without inertia the speed of what holds them, before impulses are asked for: they take none.

    With it go the forces that this calls for, as of a damper. What more rows hold than that one has its row in M.
    """
    r = reals(point.at_x, problem.n)
    r[:] = 0.0
    field_at(problem.call_drift, (problem.context, point.t, point.at_y, point.at_v))
    in_units_of_light(problem, linear.matrices, point.at_v, point.at_x)
    status = solve_checked(linear, point.at_x)
    if status == DONE:
        update(point, 1.0)
    return status


@compiled
def slip_of_light(problem, point, matrices, at_r):
    """Set r in rows that hold nodes without inertia: their slip is zero at once, whatever the surface does.

    Such a row, -slip/tau less the acceleration of what is given, knows the acceleration of no node whose speed is
    algebraic: zero, it would leave a slip of tau times that of the surface. In units of the row one update is exact.
    """
    field_at(problem.call_drift, (problem.context, point.t, point.at_y, point.at_v))
    in_units_of_light(problem, matrices, point.at_v, at_r)


@compiled
def make_consistent(m, iterations):
    """Make the point consistent for the zones in force, and compute its rate of change.

    Returns DONE, SINGULAR, INACCURATE, NOT_CONSISTENT or RELEASED (impulse.py).
    """
    problem = m.problem
    status = solve_point(m, iterations)
    for _ in range(ROUNDS):
        if status != DONE or problem.n_balanced == 0 or not close_balance(problem, m.point, m.linear):
            break
        status = solve_point(m, iterations)
    return status


@compiled
def solve_point(m, iterations):
    """As `make_consistent`, with nodes without inertia where they are."""
    problem, point, linear, matrices = m.problem, m.point, m.linear, m.linear.matrices
    mass_at(problem.call_mass, (problem.context, matrices.at_mass))
    status = prepare_consistent(problem, point, linear)
    if status == DONE and problem.n_moves > 0:
        status = project_positions(problem, point, linear)
    if status == DONE and problem.n_light > 0:
        status = follow_what_holds(problem, point, linear)
    if status == DONE:
        status = resolve_impact(m)
    if status != DONE:
        return status
    project(problem, point, linear)
    keep(point)
    status = newton(problem, point, linear, iterations)
    if status in (NOT_CONSISTENT, SINGULAR):
        give_back(point)
        status = damped_newton(problem, point, linear)
    return status


@compiled
def newton(problem, point, linear, iterations):
    """Newton with full updates; DONE or why not."""
    matrices = linear.matrices
    weigh(point, point.at_y)
    previous = 1e300
    for iteration in range(iterations):
        if iteration >= 2:
            status = prepare_consistent(problem, point, linear)
            if status != DONE:
                return status
        if problem.n_accelerated > 0 or iteration >= REFRESHED:
            # The force that would keep the slider of a crank from passing its dead centre is huge, as that is which
            # would hold a wheel at full speed: it is known to rounding of itself, not of what was there before.
            weigh(point, point.at_y)
        find_residual(problem, point, matrices, point.at_x)
        if iteration == 0:
            status = solve_checked(linear, point.at_x)
            if status != DONE:
                return status
        else:
            solve(linear, point.at_x)
        size = update(point, 1.0)
        if not isfinite(size):
            return NOT_CONSISTENT
        if problem.n_algebraic == 0 or size <= SETTLED_UPDATE or (size <= LAST_DIGITS and size > 0.5 * previous):
            find_slope_change(point, linear)
            return DONE
        if iterations > 12 and size > 0.9 * previous:  # nor as large: the root of a root is stepped over for ever
            size = damp(point, size)
        previous = size
    return NOT_CONSISTENT


@compiled
def damped_newton(problem, point, linear):
    """Newton that takes the largest share s = 1, 1/2, 1/4, ... of an update x after which less is left to do.

    Less by the natural test, which knows no units:  |x'| <= (1 - s/4) |x|  with the update x' that the same matrix asks
    for at the new point; a share small enough always passes. Source: Deuflhard 2004, Newton Methods for Nonlinear
    Problems, section 3.3.
    """
    matrices = linear.matrices
    previous = 1e300
    for iteration in range(DAMPED_UPDATES):
        status = prepare_consistent(problem, point, linear)
        if status != DONE:
            return status
        weigh(point, point.at_y)
        find_residual(problem, point, matrices, point.at_x)
        if iteration == 0:
            status = solve_checked(linear, point.at_x)
            if status != DONE:
                return status
        else:
            solve(linear, point.at_x)
        size = algebraic_size(point, point.at_x)
        if not isfinite(size):
            return NOT_CONSISTENT
        if size > LAST_DIGITS:
            if not take_share(problem, point, linear, size):
                return NOT_CONSISTENT
        else:
            update(point, 1.0)
            if size <= SETTLED_UPDATE or size > 0.5 * previous:
                find_slope_change(point, linear)
                return DONE
        previous = size
    return NOT_CONSISTENT


@compiled
def take_share(problem, point, linear, size):
    """Add the largest share of the update in x that passes the natural test; False where none does."""
    keep(point)
    share = 1.0
    while share >= LEAST_FRACTION:
        update(point, share)
        find_residual(problem, point, linear.matrices, point.at_b)
        solve(linear, point.at_b)
        if algebraic_size(point, point.at_b) <= (1.0 - share / 4.0) * size:
            return True
        give_back(point)
        share *= 0.5
    return False


@compiled
def keep(point):
    """Remember the point and its slopes."""
    n = point.n
    copy(reals(point.at_y, n), reals(point.at_y_kept, n))
    copy(reals(point.at_slope, n), reals(point.at_slope_kept, n))


@compiled
def give_back(point):
    """Go back to what was remembered."""
    n = point.n
    copy(reals(point.at_y_kept, n), reals(point.at_y, n))
    copy(reals(point.at_slope_kept, n), reals(point.at_slope, n))


@compiled
def algebraic_size(point, at_update):
    """The weighted size of the algebraic part of an update; not finite where any of it is not."""
    n = point.n
    given, to_weigh, differential = reals(at_update, n), reals(point.at_u, n), indices(point.at_differential, n)
    for k in range(n):
        to_weigh[k] = given[k] if differential[k] == 0 or not isfinite(given[k]) else 0.0
    return weighted_norm(point, point.at_u)


@compiled
def update(point, fraction):
    """Add `fraction` of the Newton update in x; the weighted size of its algebraic part."""
    n = point.n
    change, y, slope = reals(point.at_x, n), reals(point.at_y, n), reals(point.at_slope, n)
    differential, to_weigh = indices(point.at_differential, n), reals(point.at_u, n)
    for k in range(n):
        to_weigh[k] = 0.0
        if differential[k] == 1:
            slope[k] += fraction * change[k]
            if not isfinite(change[k]):
                to_weigh[k] = change[k]
        else:
            y[k] += fraction * change[k]
            to_weigh[k] = change[k]
    return weighted_norm(point, point.at_u)


@compiled
def damp(point, size):
    """Take back three quarters of an update that was larger than the one before it."""
    update(point, -0.75)
    return size


@compiled
def find_slope_change(point, linear):
    """Rate of change of the consistent point: `curvature` = y'' where differential, y' where algebraic.

    Differentiating M y' = f:  C (y''_d, y'_a) = J y'_d + f_t, with J and C of the point.
    """
    n = point.n
    curvature, ft = reals(point.at_curvature, n), reals(point.at_ft, n)
    copy(ft, curvature)
    add_slopes_times(linear.matrices, point.at_slope, point.at_curvature)
    solve(linear, point.at_curvature)
