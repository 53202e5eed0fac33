"""A step of `stepping` in the zones of its start, cut at the first switch inside: while there are few machines.

What a switch inside a step makes wrong is written in docs/stepping.md. A step that ends at the switch has none of it,
and costs a settlement. So steps of the same rule (theta_step.py, third_order.py) are taken with frozen zones, guards
are judged on the dense output as `rodas` judges them (crossing.py), and what fires is settled.

    forces     means over the step, so those of its middle; at its end the line through this middle and the one
               before says what they are, and between its ends a straight line
    error      the third difference of all differential unknowns, speeds among them, and what they lag behind a slow
               load; of a force that holds the second
    energy     from the states at the nodes of Gauss (quadratures.py)
"""

from __future__ import annotations

from fairlead.integrate.linear.products import add_mass_times
from fairlead.integrate.linear.systems import solve
from fairlead.integrate.memory.foreign import compiled, field_at, indices, reals
from fairlead.integrate.point.controller import weigh, weighted_norm
from fairlead.integrate.point.stiff import follows_within
from fairlead.integrate.record.between import take_slip_away

CAREFUL = 10.0
"""A step is allowed a tenth of a weight: errors of one sign add up, and energy is to be right to ten accuracies of what
passed. With one weight one in ten random networks of springs missed that (tests/hard, random networks)."""
HOLD_SHARE = 0.025
"""Share of the second difference of a holding force that counts as its error."""
LITTLE = 1.0 / CAREFUL
"""Weights of a force that the stop of a slip that counts as none may seem to be: what is allowed of any error."""
MOMENTUM_ROUNDING = 16 * 2.0**-52
"""Share of a momentum to which the change of it in a step is known: a few ulps, and twice as many of two steps."""
FOLLOWED = 0.1
"""Share of the way to the balance that is left as error where it was gone. The factors of the step go all of it but
2/(2 + h |J|/M), less than 2/STIFF, where the law is straight. Five times that is for laws that bend: it is chosen."""


@compiled
def holds_with_slip(m):
    """True if contacts that hold begin the step with a slip that counts as none.

    A step would take it away by a mean force m v/h, which says nothing about what holds.
    """
    problem, point = m.problem, m.point
    if problem.call_drift == 0:
        return False
    minus_slip, holder = reals(point.at_minus_slip, problem.n), indices(problem.at_holder, problem.n)
    holds, weight = indices(m.stepping.exchange.at_holds, problem.n), reals(point.at_weight, problem.n)
    inertia = reals(m.stepping.contacts.at_held_inertia, problem.n_machines)
    field_at(problem.call_drift, (problem.context, point.t, point.at_y, point.at_minus_slip))
    weigh(point, point.at_y)
    found = False
    for k in range(problem.n):
        if holds[k] == 1 and holder[k] >= 0:
            found = found or inertia[holder[k]] * abs(minus_slip[k]) > LITTLE * m.run.h * weight[k]
    return found


@compiled
def stop_slip(m):
    """Take the slip of what holds away at the start of the step, by an impulse; no guard fires for that."""
    take_slip_away(m.problem, m.point, m.linear, m.stepping.exchange, m.point.t, m.point.at_y)
    m.events.guards.n_fired = 0


@compiled
def error_of_located(m, h):
    """Size of the error of a step in weights, from the differences in `error_vector` and the slopes of forces."""
    add_error_of_forces(m, h)
    add_lag(m.point)
    return CAREFUL * weighted_norm(m.point, m.point.at_error_vector)


@compiled
def add_lag(point):
    """Into `error_vector`: what follows a slow load lags by, so that one weight of it is allowed.

    Where e is too large by c, the step misses -J c h/12, which no difference of its ends shows. A motion that is
    driven through something stiff forgets h J of what it is off in each step. So all steps together leave -c/12, and
    no more: it needs no CAREFUL. `sharpen` has left c/2 in `minus_slip`.
    """
    error, left = reals(point.at_error_vector, point.n), reals(point.at_minus_slip, point.n)
    for k in range(point.n):
        error[k] = max(error[k], LITTLE * abs(left[k]) / 6.0)


@compiled
def add_error_of_forces(m, h):
    """Into `error_vector`: of forces that hold a share of their second differences, beyond what rounding makes of them.

    A mean force is known to the rounding of momentum over the step, m |v| eps/h. In the last steps before a switch,
    of a picosecond, that is more than any weight, and the difference of two such means says nothing.
    """
    point, rule, exchange, matrices = m.point, m.stepping.rule, m.stepping.exchange, m.linear.matrices
    n = point.n
    error, slope, before = reals(point.at_error_vector, n), reals(rule.at_mean_slope, n), reals(rule.at_slope_before, n)
    holds, differential = indices(exchange.at_holds, n), indices(point.at_differential, n)
    for k in range(n):
        if holds[k] == 1 and differential[k] == 0:
            error[k] = HOLD_SHARE * h * abs(slope[k] - before[k])
    row = indices(exchange.at_hold_mass_row, exchange.n_hold_mass)
    column = indices(exchange.at_hold_mass_column, exchange.n_hold_mass)
    entry, masses = indices(exchange.at_hold_mass, exchange.n_hold_mass), reals(matrices.at_mass, matrices.n_mass)
    own, y_end = indices(matrices.at_diagonal_mass, n), reals(point.at_y_end, n)
    for e in range(exchange.n_hold_mass):
        k, j = row[e], column[e]
        if holds[k] == 1 and differential[k] == 0 and own[j] >= 0 and masses[entry[e]] != 0.0:
            momentum = abs(masses[own[j]] * y_end[j] / masses[entry[e]])
            error[k] = max(error[k] - HOLD_SHARE * MOMENTUM_ROUNDING * momentum / h, 0.0)


@compiled
def balance_end(m, h):
    """Put what follows at once where the laws of the end balance; the error, in weights, of what may follow in a step.

    Algebraic unknowns are on the line through this middle and the one before, and an unknown with a stiff law rings
    about its balance by a third of the second difference of what it follows. The residual f - M y' at the end, through
    the factors of the step, says how far they are off; y' there is the mean slope and half the change from the one
    before.
    """
    problem, point, matrices, rule = m.problem, m.point, m.linear.matrices, m.stepping.rule
    n = problem.n
    y_end, slope, before = reals(point.at_y_end, n), reals(rule.at_mean_slope, n), reals(rule.at_slope_before, n)
    way, minus_rate, error = reals(point.at_b, n), reals(point.at_v, n), reals(point.at_error_vector, n)
    differential, holds = indices(problem.at_differential, n), indices(m.stepping.exchange.at_holds, n)
    monitored = indices(m.method.at_monitored, n)
    to_end = 0.5 * h / (rule.gap + 0.5 * h)
    for k in range(n):
        minus_rate[k] = -slope[k] - to_end * (slope[k] - before[k]) if differential[k] == 1 else 0.0
        if differential[k] == 0:
            y_end[k] += 0.5 * h * slope[k]
    field_at(problem.call_rhs, (problem.context, point.t + h, point.at_y_end, point.at_b))
    problem.rhs += 1
    add_mass_times(matrices, point.at_v, point.at_b)
    for k in range(n):
        error[k] = 0.0
        if holds[k] == 1:
            way[k] = 0.0
    solve(m.linear, point.at_b)
    for k in range(n):
        if differential[k] == 0:
            y_end[k] += way[k]
        elif monitored[k] == 1:
            error[k] = way[k]
            if follows_within(matrices, k, h):
                y_end[k] += way[k]
                error[k] *= FOLLOWED
    return weighted_norm(point, point.at_error_vector)


@compiled
def remember_middle(point, rule, h):
    """Algebraic unknowns in the middle of a step that is accepted."""
    y, slope = reals(point.at_y, point.n), reals(rule.at_mean_slope, point.n)
    differential = indices(point.at_differential, point.n)
    mean = reals(rule.at_mean_before, point.n)
    for k in range(point.n):
        if differential[k] == 0:
            start = y[k] if rule.gap == 0.0 else mean[k]
            mean[k] = start + slope[k] * (rule.gap + 0.5 * h)
