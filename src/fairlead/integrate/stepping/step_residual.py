"""The residual of a step (the equations are in theta_step.py), its size, and the move a solution stands for."""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import MIDDLE
from fairlead.integrate.linear.products import add_mass_times
from fairlead.integrate.memory.foreign import compiled, field_at, indices, reals

PASSED = 1e-3
"""A residual below this, each row over its largest entry in error weights, is solved."""


@compiled
def theta_point(point, rule):
    """Into `u`: where the laws are evaluated."""
    y, y_end, u = reals(point.at_y, point.n), reals(point.at_y_end, point.n), reals(point.at_u, point.n)
    differential, theta = indices(point.at_differential, point.n), rule.theta_now
    for k in range(point.n):
        u[k] = y[k] + theta * (y_end[k] - y[k]) if differential[k] == 1 else y_end[k]


@compiled
def take_mean(problem, point, theta, h):
    """Have the laws read given motions as they read the unknowns, on the chord of the step; until `take_moment`.

    A spring between a point that is moved and a body that follows would else be compared with its other end at another
    place: of a motion that speeds up by a the chord is a h^2/8 ahead in the middle, which times a stiffness is much.
    """
    weigh_ends(problem, point, h, 1.0 - theta, theta)


@compiled
def weigh_ends(problem, point, h, of_start, of_end):
    """Have the laws read given motions with these weights of the ends of the step."""
    if problem.mean_at != 0:
        mean = reals(problem.mean_at, 5)
        mean[0], mean[1], mean[2], mean[3] = point.t, point.t + h, of_start, of_end


@compiled
def take_moment(problem):
    """Have the laws read given motions at the time they are asked for."""
    if problem.mean_at != 0:
        mean = reals(problem.mean_at, 5)
        mean[2], mean[3] = 0.0, 0.0


@compiled
def differs(problem):
    """Whether the last mean was another number than the motion itself: one of constant speed is on its chord."""
    return problem.mean_at != 0 and reals(problem.mean_at, 5)[4] == 1.0


@compiled
def residual_of_step(problem, point, matrices, stepping, h, may_be_last):
    """Set b = f - M (y1 - y0)/h, and -slip/h at the end of the step in the rows of held contacts.

    What M (y1 - y0)/h says there is just that for a contact that held at the start, on a surface of constant
    speed. For one caught in the step, or on a surface that is accelerated, the law tells the slip; on a node without
    mass it tells that at the theta point, where the speed of such a node is.
    """
    rule, exchange = stepping.rule, stepping.exchange
    n = problem.n
    theta_point(point, rule)
    take_mean(problem, point, rule.theta_now, h)
    if may_be_last and problem.n_quadratures > 0 and rule.theta_now != MIDDLE:
        field_at(problem.call_rhs, (problem.context, point.t + rule.theta_now * h, point.at_u, point.at_f))
    else:
        field_at(problem.call_forces, (problem.context, point.t + rule.theta_now * h, point.at_u, point.at_f))
    take_moment(problem)
    problem.rhs += 1
    y, y_end, v, b = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_v, n), reals(point.at_b, n)
    f = reals(point.at_f, n)
    differential, holds = indices(problem.at_differential, n), indices(exchange.at_holds, n)
    backward = -1.0 / h
    for k in range(n):
        v[k] = backward * (y_end[k] - y[k]) if differential[k] == 1 else 0.0
        b[k] = f[k] if holds[k] == 0 else 0.0
    add_mass_times(matrices, point.at_v, point.at_b)
    row = indices(exchange.at_hold_mass_row, exchange.n_hold_mass)
    caught, slip = indices(exchange.at_caught, n), reals(point.at_residual, n)
    if exchange.newly_held == 1 or exchange.driven == 1:
        field_at(problem.call_drift, (problem.context, point.t + h, point.at_y_end, point.at_residual))
        for e in range(exchange.n_hold_mass):
            if holds[row[e]] == 1 and (exchange.driven == 1 or caught[row[e]] == 1):
                b[row[e]] = slip[row[e]] / h
    else:
        for e in range(exchange.n_hold_mass):
            if holds[row[e]] == 1 and caught[row[e]] == 1:
                b[row[e]] = 0.0
    if exchange.massless == 1:
        slip_without_mass(problem, point, stepping, h)
    entry, row, column = (
        indices(exchange.at_hold_share, exchange.n_hold_share),
        indices(exchange.at_hold_share_row, exchange.n_hold_share),
        indices(exchange.at_hold_share_column, exchange.n_hold_share),
    )  # fmt: skip
    slopes = reals(matrices.at_jacobian, matrices.n_jacobian)
    for e in range(exchange.n_hold_share):
        if holds[row[e]] == 1:
            b[row[e]] += slopes[entry[e]] * y_end[column[e]]


@compiled
def slip_without_mass(problem, point, stepping, h):
    """Set -slip/(theta h) at the theta point in the rows of contacts that hold nodes without mass."""
    rule, exchange = stepping.rule, stepping.exchange
    row = indices(exchange.at_hold_mass_row, exchange.n_hold_mass)
    of_massless = indices(exchange.at_of_massless, problem.n)
    holds, b = indices(exchange.at_holds, problem.n), reals(point.at_b, problem.n)
    slip = reals(point.at_error_vector, problem.n)
    field_at(problem.call_drift, (problem.context, point.t + rule.theta_now * h, point.at_u, point.at_error_vector))
    for e in range(exchange.n_hold_mass):
        k = row[e]
        if holds[k] == 1 and of_massless[k] == 1:
            b[k] = slip[k] / (rule.theta_now * h)


@compiled
def scaled_residual(point, linear):
    """Largest |b_i| over the largest entry of row i in units of the weights; nan if any is. See `worst`."""
    core, factors = linear.core, linear.factors
    b, scale = reals(point.at_b, point.n), reals(factors.at_row_scale, point.n)
    quadrature = indices(point.at_quadrature, point.n)
    order = indices(core.at_row_order, core.n_core)
    rows = point.n if factors.dense == 1 else core.n_core
    largest = 0.0
    for k in range(rows):
        i = k if factors.dense == 1 else order[k]
        size = abs(b[i]) * scale[k]
        if not isfinite(size):
            point.worst = i
            return size
        if quadrature[i] == 0 and size > largest:
            largest = size
            point.worst = i
    return largest


@compiled
def move_end(point, rule):
    """Add the solution in b: theta times the change of a differential unknown, the change of a force."""
    b, y_end = reals(point.at_b, point.n), reals(point.at_y_end, point.n)
    differential = indices(point.at_differential, point.n)
    ahead = 1.0 / rule.theta_now
    for k in range(point.n):
        y_end[k] += ahead * b[k] if differential[k] == 1 else b[k]
