"""What a switch exchanges: a row or a few, known from the last time their contacts were in those zones.

A pass that switches k contacts so costs k rows, the columns of the factors that use them, and one solve: neither J nor
M is evaluated (known_rows.py). Where f is linear between switches and the constants of these rows are known, the
residual is zero but in them, and f is not evaluated either. All of this is a guess as to the laws, which are
evaluated once no guard is violated: the residual of the whole decides, and where it does not pass, J and M are
evaluated anew.
"""

from __future__ import annotations

from fairlead.integrate.condensed import factorise_marked, mark
from fairlead.integrate.foreign import compiled, field_at, indices, reals
from fairlead.integrate.known_rows import CONSTANT, forget_rows, residual_of_row, row_holds, row_of, take_row
from fairlead.integrate.perturbed_pivots import substitute

ROUNDING = 1e-14
"""A slip that may be left of two speeds of one m/s."""


@compiled
def exchange_rows(m, factorised):
    """Put the rows of the zones in force into J and M, and into their factors; False if they must be evaluated."""
    if not find_exchanged(m):
        return False
    changed, zones = indices(m.at_exchanged_machines, m.n_zones), indices(m.at_zones, m.n_zones)
    then, own = indices(m.at_zones_linearised, m.n_zones), indices(m.at_own_row, m.n_zones)
    holds, caught = indices(m.at_holds, m.n), indices(m.at_caught, m.n)
    count = 0
    for c in range(m.n_exchanged):
        z = changed[c]
        take_row(m, z)
        then[z] = zones[z]
        now = row_holds(m, z)
        if now == 1 and holds[own[z]] == 0:
            caught[own[z]] = 1
            m.newly_held = 1
            m.caught_by_row = 1
        holds[own[z]] = now
        if factorised:
            count = use_row(m, z, count)
    return not factorised or factorise_marked(m, count) == 0


@compiled
def find_exchanged(m):
    """List the machines whose zones are not those of J and M; False if the row of one is not known."""
    zones, then = indices(m.at_zones, m.n_zones), indices(m.at_zones_linearised, m.n_zones)
    changed, kinks = indices(m.at_exchanged_machines, m.n_zones), indices(m.at_only_kinks, m.n_zones)
    m.n_exchanged = 0
    for z in range(m.n_zones):
        if zones[z] != then[z]:
            if kinks[z] == 1 and m.linear == 0:
                then[z] = zones[z]
                continue
            if row_of(m, z) < 0:
                return False
            changed[m.n_exchanged] = z
            m.n_exchanged += 1
    return True


@compiled
def use_row(m, z, count):
    """Mark the columns of the core that the row of machine z is in, `count` are marked; how many then are."""
    starts, entries = indices(m.at_own_slope_starts, m.n_zones + 1), indices(m.at_own_slopes, m.n_own_slopes)
    values, used = reals(m.at_jacobian, m.n_jacobian), reals(m.at_jacobian_used, m.n_jacobian)
    count = use_entries(m, starts, entries, values, used, indices(m.at_jacobian_column, m.n_jacobian), z, count)
    starts, entries = indices(m.at_own_mass_starts, m.n_zones + 1), indices(m.at_own_masses, m.n_own_masses)
    values, used = reals(m.at_mass, m.n_mass), reals(m.at_mass_used, m.n_mass)
    return use_entries(m, starts, entries, values, used, indices(m.at_mass_column, m.n_mass), z, count)


@compiled
def use_entries(m, starts, entries, values, used, column, z, count):
    """The same of one matrix."""
    for e in range(starts[z], starts[z + 1]):
        p = entries[e]
        if values[p] != used[p]:
            used[p] = values[p]
            count = mark(m, column[p], count)
    return count


@compiled
def solve_exchanged(m, h):
    """Move `y_end` by the solution for a residual that is zero but in the rows just exchanged."""
    m.solves += 1
    m.guessed |= CONSTANT
    if m.newly_held == 1:
        field_at(m.call_drift, (m.context, m.t + h, m.at_y_end, m.at_residual))
    n = m.n_core
    x, place = reals(m.at_core_x, n), indices(m.at_row_place, m.n)
    changed, own = indices(m.at_exchanged_machines, m.n_zones), indices(m.at_own_row, m.n_zones)
    for k in range(n):
        x[k] = 0.0
    for c in range(m.n_exchanged):
        x[place[own[changed[c]]]] = residual_of_row(m, changed[c], h)
    substitute(m, m.at_core_x)
    order, y_end, differential = indices(m.at_column_order, n), reals(m.at_y_end, m.n), indices(m.at_differential, m.n)
    b, ahead = reals(m.at_b, m.n), 1.0 / m.theta_now
    for k in range(n):
        j = order[k]
        b[j] = x[k]
        y_end[j] += ahead * x[k] if differential[j] == 1 else x[k]
    position, speed = indices(m.at_position, m.n_positions), indices(m.at_position_speed, m.n_positions)
    ratio = reals(m.at_position_ratio, m.n_positions)
    for k in range(m.n_positions):
        if speed[k] >= 0:
            y_end[position[k]] += ahead * ratio[k] * b[speed[k]]


@compiled
def give_up_guesses(m):
    """The laws say otherwise than the rows of before: evaluate all, and rely on those no more."""
    m.distrusted |= m.guessed
    m.guessed = 0
    m.linearised = 0
    forget_rows(m)


@compiled
def watch_surfaces(m):
    """Of contacts caught by their known rows: whether the surface of one varies its speed."""
    m.caught_by_row = 0
    if m.driven == 1:
        return
    field_at(m.call_drift, (m.context, m.t, m.at_y_end, m.at_residual))
    row, column = indices(m.at_hold_mass_row, m.n_hold_mass), indices(m.at_hold_mass_column, m.n_hold_mass)
    entry, values, y_end = indices(m.at_hold_mass, m.n_hold_mass), reals(m.at_mass, m.n_mass), reals(m.at_y_end, m.n)
    holds, caught, slip = indices(m.at_holds, m.n), indices(m.at_caught, m.n), reals(m.at_residual, m.n)
    for e in range(m.n_hold_mass):
        left = ROUNDING * (1.0 + abs(values[entry[e]] * y_end[column[e]]))
        if holds[row[e]] == 1 and caught[row[e]] == 1 and abs(slip[row[e]]) > left:
            m.driven = 1
