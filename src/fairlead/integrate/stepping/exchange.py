"""What a switch exchanges: a row or a few, known from the last time their contacts were in those zones.

A pass that switches k contacts so costs k rows, the columns of the factors that use them, and one solve: neither J nor
M is evaluated (known_rows.py). Where f is linear between switches and the constants of these rows are known, the
residual is zero but in them, and f is not evaluated either. All of this is a guess as to the laws, which are
evaluated once no guard is violated: the residual of the whole decides, and where it does not pass, J and M are
evaluated anew.
"""

from __future__ import annotations

from fairlead.integrate.linear.condensed import factorise_marked, mark
from fairlead.integrate.linear.perturbed_pivots import substitute
from fairlead.integrate.memory.foreign import compiled, field_at, indices, reals
from fairlead.integrate.stepping.known_rows import CONSTANT, forget_rows, residual_of_row, row_holds, row_of, take_row

ROUNDING = 1e-14
"""A slip that may be left of two speeds of one m/s."""


@compiled
def exchange_rows(problem, linear, stepping, factorised):
    """Put the rows of the zones in force into J and M, and into their factors; False if they must be evaluated."""
    matrices, exchange = linear.matrices, stepping.exchange
    if not find_exchanged(problem, stepping):
        return False
    changed = indices(exchange.at_exchanged_machines, exchange.n_zones)
    zones = indices(exchange.at_zones, exchange.n_zones)
    then, own = indices(exchange.at_zones_linearised, exchange.n_zones), indices(exchange.at_own_row, exchange.n_zones)
    holds, caught = indices(exchange.at_holds, exchange.n), indices(exchange.at_caught, exchange.n)
    count = 0
    for c in range(exchange.n_exchanged):
        z = changed[c]
        take_row(problem, matrices, stepping, z)
        then[z] = zones[z]
        now = row_holds(matrices, exchange, z)
        if now == 1 and holds[own[z]] == 0:
            caught[own[z]] = 1
            exchange.newly_held = 1
            exchange.caught_by_row = 1
        holds[own[z]] = now
        if factorised:
            count = use_row(linear, exchange, z, count)
    return not factorised or factorise_marked(linear, count) == 0


@compiled
def find_exchanged(problem, stepping):
    """List the machines whose zones are not those of J and M; False if the row of one is not known."""
    exchange = stepping.exchange
    zones, then = indices(problem.at_zones, problem.n_zones), indices(exchange.at_zones_linearised, problem.n_zones)
    changed = indices(exchange.at_exchanged_machines, problem.n_zones)
    kinks = indices(stepping.contacts.at_only_kinks, problem.n_zones)
    exchange.n_exchanged = 0
    for z in range(problem.n_zones):
        if zones[z] != then[z]:
            if kinks[z] == 1 and problem.linear == 0:
                then[z] = zones[z]
                continue
            if row_of(problem, stepping, z) < 0:
                return False
            changed[exchange.n_exchanged] = z
            exchange.n_exchanged += 1
    return True


@compiled
def use_row(linear, exchange, z, count):
    """Mark the columns of the core that the row of machine z is in, `count` are marked; how many then are."""
    matrices, core, factors = linear.matrices, linear.core, linear.factors
    starts = indices(exchange.at_own_slope_starts, exchange.n_zones + 1)
    entries = indices(exchange.at_own_slopes, exchange.n_own_slopes)
    values, used = reals(matrices.at_jacobian, matrices.n_jacobian), reals(core.at_jacobian_used, matrices.n_jacobian)
    column = indices(core.at_jacobian_column, matrices.n_jacobian)
    count = use_entries(factors, starts, entries, values, used, column, z, count)
    starts = indices(exchange.at_own_mass_starts, exchange.n_zones + 1)
    entries = indices(exchange.at_own_masses, exchange.n_own_masses)
    values, used = reals(matrices.at_mass, matrices.n_mass), reals(core.at_mass_used, matrices.n_mass)
    return use_entries(factors, starts, entries, values, used, indices(core.at_mass_column, matrices.n_mass), z, count)


@compiled
def use_entries(factors, starts, entries, values, used, column, z, count):
    """The same of one matrix."""
    for e in range(starts[z], starts[z + 1]):
        p = entries[e]
        if values[p] != used[p]:
            used[p] = values[p]
            count = mark(factors, column[p], count)
    return count


@compiled
def solve_exchanged(problem, point, linear, stepping, h):
    """Move `y_end` by the solution for a residual that is zero but in the rows just exchanged."""
    core, factors, exchange = linear.core, linear.factors, stepping.exchange
    factors.solves += 1
    exchange.guessed |= CONSTANT
    if exchange.newly_held == 1:
        field_at(problem.call_drift, (problem.context, point.t + h, point.at_y_end, point.at_residual))
    n = core.n_core
    x, place = reals(core.at_core_x, n), indices(factors.at_row_place, problem.n)
    changed = indices(exchange.at_exchanged_machines, problem.n_zones)
    own = indices(exchange.at_own_row, problem.n_zones)
    for k in range(n):
        x[k] = 0.0
    for c in range(exchange.n_exchanged):
        x[place[own[changed[c]]]] = residual_of_row(point, linear.matrices, stepping, changed[c], h)
    substitute(factors, core.at_core_x)
    order, y_end = indices(factors.at_column_order, n), reals(point.at_y_end, problem.n)
    differential = indices(problem.at_differential, problem.n)
    b, ahead = reals(point.at_b, problem.n), 1.0 / stepping.rule.theta_now
    for k in range(n):
        j = order[k]
        b[j] = x[k]
        y_end[j] += ahead * x[k] if differential[j] == 1 else x[k]
    position, speed = indices(core.at_position, core.n_positions), indices(core.at_position_speed, core.n_positions)
    ratio = reals(core.at_position_ratio, core.n_positions)
    for k in range(core.n_positions):
        if speed[k] >= 0:
            y_end[position[k]] += ahead * ratio[k] * b[speed[k]]


@compiled
def give_up_guesses(stepping):
    """The laws say otherwise than the rows of before: evaluate all, and rely on those no more."""
    exchange = stepping.exchange
    exchange.distrusted |= exchange.guessed
    exchange.guessed = 0
    stepping.rule.linearised = 0
    forget_rows(exchange)


@compiled
def watch_surfaces(problem, point, matrices, exchange):
    """Of contacts caught by their known rows: whether the surface of one varies its speed."""
    exchange.caught_by_row = 0
    if exchange.driven == 1:
        return
    field_at(problem.call_drift, (problem.context, point.t, point.at_y_end, point.at_residual))
    row = indices(exchange.at_hold_mass_row, exchange.n_hold_mass)
    column = indices(exchange.at_hold_mass_column, exchange.n_hold_mass)
    entry, values = indices(exchange.at_hold_mass, exchange.n_hold_mass), reals(matrices.at_mass, matrices.n_mass)
    y_end = reals(point.at_y_end, problem.n)
    holds, caught = indices(exchange.at_holds, problem.n), indices(exchange.at_caught, problem.n)
    slip = reals(point.at_residual, problem.n)
    for e in range(exchange.n_hold_mass):
        left = ROUNDING * (1.0 + abs(values[entry[e]] * y_end[column[e]]))
        if holds[row[e]] == 1 and caught[row[e]] == 1 and abs(slip[row[e]]) > left:
            exchange.driven = 1
