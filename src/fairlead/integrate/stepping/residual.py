"""The residual of a step (the equations are in theta_step.py), its size, the move of a solution, the line search.

A Newton move that raises the residual is taken back by halves. Where laws bend sharply, as friction regularised over a
speed far below that of the motion, a full move goes beyond the bend, the next one back, and so on for ever. Its
direction is still that in which the residual falls. So within one set of zones, with s the share of the move that is
left and r the size of the residual,

    r(s) <= (1 - ARMIJO s) r(0)

is asked of a full move by halves (Armijo 1966), where that has not lowered r: elsewhere nothing is done, and no law is
evaluated more than once. J is evaluated anew then: only its own direction is sure to descend. The size is the one that
judges when a step is solved: each row over its largest entry in error weights, so that a share has the same meaning
whatever the units.

Not searched is where friction falls with speed faster than the step can follow, or may: its equations have more than
one solution there, and full moves that find none ask rightly for a shorter step. (Searched, stick-slip of a block on a
spring with exact hold came to errors that did not follow the accuracy.)
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import MIDDLE
from fairlead.integrate.linear.products import add_mass_times, inertia_of
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.stepping.row_cache import forget_jacobian

SOLVED = 1e-3
"""A residual below this, each row over its largest entry in error weights, is solved. Errors of iterations add up over
the steps, so they stay far below one weight: the code RADAU5 takes min(0.03, sqrt(accuracy)), 1e-3 at an accuracy
of 1e-6 (Hairer and Wanner, Solving ODEs II, section IV.8)."""
CHANGE_KNOWN = 4 * 2.0**-52
"""Share of a value to which its change in a step is known: a few ulps, from the solve and the sum that end the step."""
ARMIJO, LEAST_SHARE = 1e-4, 1e-3
"""Share of the promised fall that is asked for; below the least share of a move the next J has to tell."""
FALLING = 0.5
"""Share of the inertia that falling friction may take away over half a step."""
MOST_SEARCHED = 40
"""Solves before a step in which moves were taken back counts as not converging."""
SEARCHED, GIVEN_UP = 1, 2
"""What `searched` says: moves were taken back; and that did not help."""


@compiled
def find_theta_point(point, rule):
    """Into `u`: where the laws are evaluated."""
    y, y_end, u = reals(point.at_y, point.n), reals(point.at_y_end, point.n), reals(point.at_u, point.n)
    differential, theta = indices(point.at_differential, point.n), rule.theta_now
    for k in range(point.n):
        u[k] = y[k] + theta * (y_end[k] - y[k]) if differential[k] == 1 else y_end[k]


@compiled
def read_on_chord(problem, point, theta, h):
    """Begin: laws read given motions as they read the unknowns, on the chord of the step; `read_at_instant` ends it.

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
def read_at_instant(problem):
    """End what `read_on_chord` began: the laws read given motions at the time they are asked for."""
    if problem.mean_at != 0:
        mean = reals(problem.mean_at, 5)
        mean[2], mean[3] = 0.0, 0.0


@compiled
def differs(problem):
    """Whether the last mean was another number than the motion itself: one of constant speed is on its chord."""
    return problem.mean_at != 0 and reals(problem.mean_at, 5)[4] == 1.0


@compiled
def find_residual_of_step(problem, point, matrices, stepping, h, may_be_last):
    """Set b = f - M (y1 - y0)/h, and -slip/h at the end of the step in the rows of held contacts.

    friction   the force of a contact is an unknown in u, so all it does to bodies is in f (`call_forces`: all of f but
               quadratures; what a compiled model sums up there is in system/callbacks/evaluation.py, `evaluate`). The
               row of its own is its law while it slides, its slip while it holds, with its share of other forces where
               it closes a circle. `call_drift` gives minus the slip
    kick       what the mean of a law that jumps inside the step is asked to be, else 0 (jump_inside.py)

    What M (y1 - y0)/h says there is just that for a contact that held at the start, on a surface of constant
    speed. For one captured in the step, or on a surface that is accelerated, the law tells the slip; on a node without
    mass it tells that at the theta point, where the speed of such a node is.
    """
    rule, exchange = stepping.rule, stepping.exchange
    n = problem.n
    find_theta_point(point, rule)
    read_on_chord(problem, point, rule.theta_now, h)
    if may_be_last and problem.n_quadratures > 0 and rule.theta_now != MIDDLE:
        field_at(problem.call_rhs, (problem.context, point.t + rule.theta_now * h, point.at_u, point.at_f))
    else:
        field_at(problem.call_forces, (problem.context, point.t + rule.theta_now * h, point.at_u, point.at_f))
    read_at_instant(problem)
    problem.rhs += 1
    y, y_end, minus_rate, b = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_v, n), reals(point.at_b, n)
    f, kick = reals(point.at_f, n), reals(rule.at_kick, n)
    differential, holds = indices(problem.at_differential, n), indices(exchange.at_holds, n)
    backward = -1.0 / h
    for k in range(n):
        minus_rate[k] = backward * (y_end[k] - y[k]) if differential[k] == 1 else 0.0
        b[k] = f[k] - kick[k] if holds[k] == 0 else 0.0
    add_mass_times(matrices, point.at_v, point.at_b)
    row = indices(exchange.at_hold_mass_row, exchange.n_hold_mass)
    captured, minus_slip = indices(exchange.at_captured, n), reals(point.at_minus_slip, n)
    if exchange.any_captured == 1 or exchange.support_accelerates == 1:
        field_at(problem.call_drift, (problem.context, point.t + h, point.at_y_end, point.at_minus_slip))
        for e in range(exchange.n_hold_mass):
            if holds[row[e]] == 1 and (exchange.support_accelerates == 1 or captured[row[e]] == 1):
                b[row[e]] = minus_slip[row[e]] / h
    else:  # the row of a captured contact is linear, so a full move has left no slip
        for e in range(exchange.n_hold_mass):
            if holds[row[e]] == 1 and captured[row[e]] == 1:
                b[row[e]] = 0.0
    if exchange.algebraic_speeds == 1:
        find_slip_without_mass(problem, point, stepping, h)
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
def find_slip_without_mass(problem, point, stepping, h):
    """Set -slip/(theta h) at the theta point in the rows of contacts that hold nodes without mass."""
    rule, exchange = stepping.rule, stepping.exchange
    row = indices(exchange.at_hold_mass_row, exchange.n_hold_mass)
    of_algebraic_speed = indices(exchange.at_of_algebraic_speed, problem.n)
    holds, b = indices(exchange.at_holds, problem.n), reals(point.at_b, problem.n)
    minus_slip = reals(point.at_minus_slip, problem.n)
    field_at(problem.call_drift, (problem.context, point.t + rule.theta_now * h, point.at_u, point.at_minus_slip))
    for e in range(exchange.n_hold_mass):
        k = row[e]
        if holds[k] == 1 and of_algebraic_speed[k] == 1:
            b[k] = minus_slip[k] / (rule.theta_now * h)


@compiled
def scaled_residual(point, linear, h):
    """Largest |b_i| over the largest entry of row i in units of the weights; nan if any is.

    A change is known to the rounding of what it changes: 3000 km in steps of a microsecond to 0.5 mm/s. Of the row of
    such a position no solve leaves less than that, so what is no more counts as nothing.
    """
    reduced, factors = linear.reduced, linear.factors
    b, scale = reals(point.at_b, point.n), reals(factors.at_row_scale, point.n)
    quadrature = indices(point.at_quadrature, point.n)
    order = indices(reduced.at_row_order, reduced.n_reduced)
    rows = point.n if factors.dense == 1 else reduced.n_reduced
    largest = 0.0
    for k in range(rows):
        i = k if factors.dense == 1 else order[k]
        size = abs(b[i]) * scale[k]
        if not isfinite(size):
            point.worst = i
            return size
        if quadrature[i] == 0 and size > largest and (size <= SOLVED or not is_rounding(point, linear.matrices, i, h)):
            largest = size
            point.worst = i
    return largest


@compiled
def is_rounding(point, matrices, i, h):
    """True if the residual of row i is no more than the rounding of M y/h in it."""
    own, masses = indices(matrices.at_diagonal_mass, point.n), reals(matrices.at_mass, matrices.n_mass)
    b, y_end = reals(point.at_b, point.n), reals(point.at_y_end, point.n)
    return own[i] >= 0 and abs(b[i]) * h <= CHANGE_KNOWN * abs(masses[own[i]] * y_end[i])


@compiled
def move_end(point, rule):
    """Add the solution in b: theta times the change of a differential unknown, the change of a force."""
    b, y_end = reals(point.at_b, point.n), reals(point.at_y_end, point.n)
    differential = indices(point.at_differential, point.n)
    per_theta = 1.0 / rule.theta_now
    for k in range(point.n):
        y_end[k] += per_theta * b[k] if differential[k] == 1 else b[k]


@compiled
def remember_move(point, rule):
    """Keep the solution in b, which `y_end` is about to be moved by."""
    copy(reals(point.at_b, point.n), reals(rule.at_move, point.n))


@compiled
def search_line(problem, point, linear, stepping, h, before):
    """Leave the residual after the last move, of which as much is taken back as raises it above `before`."""
    matrices, rule = linear.matrices, stepping.rule
    find_residual_of_step(problem, point, matrices, stepping, h, True)
    size, share = scaled_residual(point, linear, h), 1.0
    if size <= max(before, SOLVED):
        return
    fresh = rule.searched == SEARCHED
    if friction_falls_steeply(matrices, stepping, h):
        if fresh:
            rule.searched = GIVEN_UP
        return
    rule.searched = SEARCHED
    forget_jacobian(rule)
    if problem.call_drift != 0:
        stepping.exchange.any_captured = 1  # what is taken back of a move leaves slip in rows that were captured
    y_end, move = reals(point.at_y_end, point.n), reals(rule.at_move, point.n)
    differential = indices(point.at_differential, point.n)
    per_theta = 1.0 / rule.theta_now
    while not size <= (1.0 - ARMIJO * share) * before and share > LEAST_SHARE:
        share *= 0.5
        for k in range(point.n):
            y_end[k] -= share * (per_theta * move[k] if differential[k] == 1 else move[k])
        find_residual_of_step(problem, point, matrices, stepping, h, True)
        size = scaled_residual(point, linear, h)
    if fresh and not size <= (1.0 - ARMIJO * share) * before:
        rule.searched = GIVEN_UP


@compiled
def friction_falls_steeply(matrices, stepping, h):
    """True if friction falls with speed by more than the step can follow; that of a contact that may hold might."""
    rule, exchange = stepping.rule, stepping.exchange
    row, holds = indices(exchange.at_hold_mass_row, exchange.n_hold_mass), indices(exchange.at_holds, matrices.n)
    for e in range(exchange.n_hold_mass):
        if holds[row[e]] == 0:
            return True
    slopes = reals(matrices.at_jacobian, matrices.n_jacobian)
    starts = indices(matrices.at_jacobian_starts, matrices.n + 1)
    rows = indices(matrices.at_jacobian_rows, matrices.n_jacobian)
    differential, controlled = indices(matrices.at_differential, matrices.n), indices(rule.at_controlled, matrices.n)
    for k in range(matrices.n):
        if differential[k] == 1 and controlled[k] == 0:
            for p in range(starts[k], starts[k + 1]):
                if rows[p] == k and h * rule.theta_now * slopes[p] > FALLING * inertia_of(matrices, k):
                    return True
    return False
