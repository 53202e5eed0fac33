"""J, M and the factors of W for the zones in force: from the row cache as far as it has them, else evaluated.

    zones differ, rows known    these rows are exchanged in J and M, and in the factors if those are of this h and theta
    zones differ, not known     J and M are evaluated (`forget_jacobian`)
    another h or theta          W is factorised
"""

from __future__ import annotations

from fairlead.integrate.codes import DONE
from fairlead.integrate.linear.systems import factorise_step
from fairlead.integrate.memory.foreign import compiled, indices, jacobian_at, mass_at, reals
from fairlead.integrate.stepping.residual import find_theta_point, read_at_instant, read_on_chord
from fairlead.integrate.stepping.row_cache import exchange_rows, forget_jacobian, learn_rows


@compiled
def linearise_step(problem, point, linear, stepping, h):
    """M, J and the factors, as far as they are not those of the zones and the step in force."""
    factors, rule, exchange = linear.factors, stepping.rule, stepping.exchange
    exchange.n_exchanged, exchange.rows_alone = 0, 0
    if exchange.zones_differ == 1 and rule.linearised == 1:
        same = factors.factored_h == h and factors.factored_theta == rule.theta_now
        factorised = same and linear.reduced.reduced_valid == 1
        if factors.dense == 1 or not exchange_rows(problem, linear, stepping, factorised):
            forget_jacobian(rule)
            exchange.n_exchanged = 0
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

    They are the rows of algebraic unknowns in which M has an entry now. `support_accelerates` tells of a surface with
    a speed that varies, `captured` of rows that did not hold before.
    """
    captured = indices(exchange.at_captured, point.n)
    holds, slopes = indices(exchange.at_holds, point.n), reals(matrices.at_jacobian, matrices.n_jacobian)
    ft = reals(point.at_ft, point.n)
    entry = indices(exchange.at_hold_mass, exchange.n_hold_mass)
    row = indices(exchange.at_hold_mass_row, exchange.n_hold_mass)
    values = reals(matrices.at_mass, matrices.n_mass)
    column = indices(exchange.at_hold_mass_column, exchange.n_hold_mass)
    differential = indices(point.at_differential, point.n)
    of_algebraic_speed = indices(exchange.at_of_algebraic_speed, point.n)
    for e in range(exchange.n_hold_mass):
        if holds[row[e]] == 1:
            holds[row[e]] = 2
        if values[entry[e]] != 0.0 and differential[column[e]] == 0:
            of_algebraic_speed[row[e]] = 1
            exchange.algebraic_speeds = 1
    exchange.support_accelerates = 0
    for e in range(exchange.n_hold_mass):
        if values[entry[e]] != 0.0:
            if holds[row[e]] == 0:
                captured[row[e]] = 1
                exchange.any_captured = 1
            holds[row[e]] = 1
            if ft[row[e]] != 0.0:
                exchange.support_accelerates = 1
    for e in range(exchange.n_hold_mass):
        if holds[row[e]] == 2:
            holds[row[e]] = 0
    entry = indices(exchange.at_hold_slope, exchange.n_hold_slope)
    row = indices(exchange.at_hold_slope_row, exchange.n_hold_slope)
    for e in range(exchange.n_hold_slope):
        if holds[row[e]] == 1:
            slopes[entry[e]] = 0.0
