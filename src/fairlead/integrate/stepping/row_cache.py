"""The row cache: rows of J and M that machines hold, kept for every zone a machine has been in, and exchanged.

A machine that holds a row changes, when it switches, that row of J and M alone. Where f is linear between switches,
the constant c of a row that slides, 0 = J_i u + c, is kept as well, and a row not yet known is that of a machine of the
same kind: laws then tell whether it is. Elsewhere it would change the iteration, and what it leaves of the residual,
by which machine was asked. A settlement forgets all: a time event may have changed the laws.

A pass that switches k contacts so costs k rows, the columns of the factors that use them, and one solve: neither J nor
M is evaluated. Where f is linear between switches and the constants of these rows are known, the residual is zero but
in them, and f is not evaluated either. All of this is a guess as to the laws, which are evaluated once no guard is
violated: the residual of the whole decides, and where it does not pass, J and M are evaluated anew.
"""

from __future__ import annotations

from fairlead.integrate.codes import DONE, KNOWN_ZONES
from fairlead.integrate.linear.condensed import factorise_marked, mark
from fairlead.integrate.linear.perturbed_pivots import substitute
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, reals

ROW, CONSTANT = 1, 2
"""What is known of a machine in a zone: nothing (0), its rows of J and M, and the constant too."""
OF_KIND = 4
"""A row taken from a machine of the same kind."""
SPEED_ROUNDING = 1e-14
"""A slip that may be left of two speeds of one m/s."""


@compiled
def learn_rows(problem, matrices, stepping):
    """Keep the rows of J and M that machines hold, in the zones in force; J and M are those of these zones."""
    exchange = stepping.exchange
    zones, own = indices(problem.at_zones, problem.n_machines), indices(exchange.at_own_row, problem.n_machines)
    known = indices(exchange.at_known, exchange.n_known)
    copy(zones, indices(exchange.at_zones_linearised, problem.n_machines))
    listed = indices(exchange.at_exchanged_machines, problem.n_machines)
    kind = indices(stepping.contacts.at_own_kind, problem.n_machines)
    of_kind = indices(exchange.at_known_of_kind, exchange.n_known)
    exchange.n_exchanged = 0
    for z in range(problem.n_machines):
        if own[z] < 0 or zones[z] < 0 or zones[z] >= KNOWN_ZONES:
            continue
        listed[exchange.n_exchanged] = z
        exchange.n_exchanged += 1
        place = zones[z] * problem.n_machines + z
        if known[place] > 0 and problem.linear == 1:
            continue
        known[place] = max(known[place], ROW)
        of_kind[zones[z] * problem.n_machines + kind[z]] = z + 1
        move_row(matrices, exchange, z, z, True)


@compiled
def move_row(matrices, exchange, z, like, learn):
    """Keep the row of machine z for the zone it is in, or put into J and M what was kept of machine `like`."""
    zone = indices(exchange.at_zones, exchange.n_machines)[z]
    starts = indices(exchange.at_own_slope_starts, exchange.n_machines + 1)
    entries = indices(exchange.at_own_slopes, exchange.n_own_slopes)
    values = reals(matrices.at_jacobian, matrices.n_jacobian)
    kept = reals(exchange.at_known_slopes, KNOWN_ZONES * exchange.n_own_slopes)
    move_entries(starts, entries, values, kept, z, zone * exchange.n_own_slopes + starts[like], learn)
    starts = indices(exchange.at_own_mass_starts, exchange.n_machines + 1)
    entries = indices(exchange.at_own_masses, exchange.n_own_masses)
    values = reals(matrices.at_mass, matrices.n_mass)
    kept = reals(exchange.at_known_masses, KNOWN_ZONES * exchange.n_own_masses)
    move_entries(starts, entries, values, kept, z, zone * exchange.n_own_masses + starts[like], learn)


@compiled
def move_entries(starts, entries, values, kept, z, place, learn):
    """Move the entries of machine z between a matrix and what is kept from `place` on."""
    for e in range(starts[z], starts[z + 1]):
        at = place + e - starts[z]
        if learn:
            kept[at] = values[entries[e]]
        else:
            values[entries[e]] = kept[at]


@compiled
def row_of(problem, stepping, z):
    """The machine whose row is known for the zone of machine z: itself, or one like it, or -1."""
    exchange = stepping.exchange
    zone = indices(problem.at_zones, problem.n_machines)[z]
    if zone < 0 or zone >= KNOWN_ZONES or indices(exchange.at_own_row, problem.n_machines)[z] < 0:
        return -1
    if indices(exchange.at_known, exchange.n_known)[zone * problem.n_machines + z] > 0:
        return z
    if problem.linear == 0 or (exchange.invalidated & OF_KIND) != 0:
        return -1
    kind = indices(stepping.contacts.at_own_kind, problem.n_machines)
    return indices(exchange.at_known_of_kind, exchange.n_known)[zone * problem.n_machines + kind[z]] - 1


@compiled
def update_row(problem, matrices, stepping, z):
    """Put the row of machine z for the zone it is in into J and M; it must be known."""
    exchange = stepping.exchange
    like = row_of(problem, stepping, z)
    move_row(matrices, exchange, z, like, False)
    if like != z:
        exchange.assumed |= OF_KIND
        move_row(matrices, exchange, z, z, True)
        zone = indices(exchange.at_zones, exchange.n_machines)[z]
        indices(exchange.at_known, exchange.n_known)[zone * exchange.n_machines + z] = ROW


@compiled
def note_hold(matrices, exchange, z):
    """1 if the row of machine z has an entry in M; also marks it if that is of a node without mass."""
    starts = indices(exchange.at_own_mass_starts, exchange.n_machines + 1)
    entries = indices(exchange.at_own_masses, exchange.n_own_masses)
    values = reals(matrices.at_mass, matrices.n_mass)
    columns = indices(exchange.at_own_mass_columns, exchange.n_own_masses)
    differential, found = indices(matrices.at_differential, matrices.n), 0
    for e in range(starts[z], starts[z + 1]):
        if values[entries[e]] != 0.0:
            found = 1
            if differential[columns[e]] == 0:
                row = indices(exchange.at_own_row, exchange.n_machines)[z]
                indices(exchange.at_of_algebraic_speed, matrices.n)[row] = 1
                exchange.algebraic_speeds = 1
    return found


@compiled
def learn_constants(point, matrices, stepping):
    """Keep the constants of the rows just exchanged or evaluated that do not hold, from the residual b at `y_end`."""
    exchange = stepping.exchange
    changed = indices(exchange.at_exchanged_machines, exchange.n_machines)
    zones = indices(exchange.at_zones, exchange.n_machines)
    constants = reals(exchange.at_known_constants, exchange.n_known)
    known = indices(exchange.at_known, exchange.n_known)
    b, own = reals(point.at_b, point.n), indices(exchange.at_own_row, exchange.n_machines)
    holds, kick = indices(exchange.at_holds, point.n), reals(stepping.rule.at_kick, point.n)
    for c in range(exchange.n_exchanged):
        z = changed[c]
        place = zones[z] * exchange.n_machines + z
        if known[place] == ROW and holds[own[z]] == 0:
            constants[place] = b[own[z]] + kick[own[z]] - linear_part(point, matrices, stepping, z)
            known[place] = CONSTANT


@compiled
def residual_of_row(point, matrices, stepping, z, h):
    """The entry of b in the row of machine z: by the constant, or where it holds by `minus_slip`."""
    exchange = stepping.exchange
    row = indices(exchange.at_own_row, exchange.n_machines)[z]
    if indices(exchange.at_holds, point.n)[row] == 1:
        return reals(point.at_minus_slip, point.n)[row] / h + linear_part(point, matrices, stepping, z)
    zone = indices(exchange.at_zones, exchange.n_machines)[z]
    constants = reals(exchange.at_known_constants, exchange.n_known)
    kick = reals(stepping.rule.at_kick, point.n)[row]
    return constants[zone * exchange.n_machines + z] - kick + linear_part(point, matrices, stepping, z)


@compiled
def linear_part(point, matrices, stepping, z):
    """J_i u in the row of machine z, with u at the theta point; of a row that holds J_i has entries of forces alone."""
    exchange = stepping.exchange
    y, y_end = reals(point.at_y, point.n), reals(point.at_y_end, point.n)
    differential = indices(point.at_differential, point.n)
    starts = indices(exchange.at_own_slope_starts, exchange.n_machines + 1)
    entries = indices(exchange.at_own_slopes, exchange.n_own_slopes)
    columns = indices(exchange.at_own_slope_columns, exchange.n_own_slopes)
    values, total = reals(matrices.at_jacobian, matrices.n_jacobian), 0.0
    for e in range(starts[z], starts[z + 1]):
        k = columns[e]
        u = y_end[k] if differential[k] == 0 else y[k] + stepping.rule.theta_now * (y_end[k] - y[k])
        total += values[entries[e]] * u
    return total


@compiled
def rows_are_known(problem, exchange):
    """True if f is linear, and the residual of the rows just exchanged known without it."""
    if problem.linear == 0 or (exchange.invalidated & CONSTANT) != 0:
        return False
    if exchange.support_accelerates == 1 or exchange.algebraic_speeds == 1:
        return False
    changed = indices(exchange.at_exchanged_machines, problem.n_machines)
    zones = indices(problem.at_zones, problem.n_machines)
    known, own = indices(exchange.at_known, exchange.n_known), indices(exchange.at_own_row, problem.n_machines)
    holds, captured, all_known = indices(exchange.at_holds, problem.n), indices(exchange.at_captured, problem.n), True
    for c in range(exchange.n_exchanged):
        z = changed[c]
        if holds[own[z]] == 1:
            all_known = all_known and captured[own[z]] == 1
        else:
            all_known = all_known and known[zones[z] * problem.n_machines + z] == CONSTANT
    return all_known


@compiled
def forget_rows(exchange):
    """Nothing is known of any row."""
    known, of_kind = indices(exchange.at_known, exchange.n_known), indices(exchange.at_known_of_kind, exchange.n_known)
    for k in range(exchange.n_known):
        known[k] = 0
        of_kind[k] = 0


@compiled
def exchange_rows(problem, linear, stepping, factorised):
    """Put the rows of the zones in force into J and M, and into their factors; False if they must be evaluated."""
    matrices, exchange = linear.matrices, stepping.exchange
    if not find_exchanged(problem, stepping):
        return False
    changed = indices(exchange.at_exchanged_machines, exchange.n_machines)
    zones = indices(exchange.at_zones, exchange.n_machines)
    then = indices(exchange.at_zones_linearised, exchange.n_machines)
    own = indices(exchange.at_own_row, exchange.n_machines)
    holds, captured = indices(exchange.at_holds, exchange.n), indices(exchange.at_captured, exchange.n)
    count = 0
    for c in range(exchange.n_exchanged):
        z = changed[c]
        update_row(problem, matrices, stepping, z)
        then[z] = zones[z]
        now = note_hold(matrices, exchange, z)
        if now == 1 and holds[own[z]] == 0:
            captured[own[z]] = 1
            exchange.any_captured = 1
            exchange.captured_by_row = 1
        holds[own[z]] = now
        if factorised:
            count = use_row(linear, exchange, z, count)
    return not factorised or factorise_marked(linear, count) == DONE


@compiled
def find_exchanged(problem, stepping):
    """List the machines whose zones are not those of J and M; False if the row of one is not known."""
    exchange = stepping.exchange
    zones = indices(problem.at_zones, problem.n_machines)
    then = indices(exchange.at_zones_linearised, problem.n_machines)
    changed = indices(exchange.at_exchanged_machines, problem.n_machines)
    kinks = indices(stepping.contacts.at_only_kinks, problem.n_machines)
    exchange.n_exchanged = 0
    for z in range(problem.n_machines):
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
    """Mark the columns of the reduced matrix that the row of machine z is in, `count` are marked; how many then are."""
    matrices, reduced, factors = linear.matrices, linear.reduced, linear.factors
    starts = indices(exchange.at_own_slope_starts, exchange.n_machines + 1)
    entries = indices(exchange.at_own_slopes, exchange.n_own_slopes)
    values = reals(matrices.at_jacobian, matrices.n_jacobian)
    used = reals(reduced.at_jacobian_used, matrices.n_jacobian)
    column = indices(reduced.at_jacobian_column, matrices.n_jacobian)
    count = use_entries(factors, starts, entries, values, used, column, z, count)
    starts = indices(exchange.at_own_mass_starts, exchange.n_machines + 1)
    entries = indices(exchange.at_own_masses, exchange.n_own_masses)
    values, used = reals(matrices.at_mass, matrices.n_mass), reals(reduced.at_mass_used, matrices.n_mass)
    column = indices(reduced.at_mass_column, matrices.n_mass)
    return use_entries(factors, starts, entries, values, used, column, z, count)


@compiled
def use_entries(factors, starts, entries, values, used, column, z, count):
    """Mark columns of machine z where entries of one matrix differ from those `used` in the factors; how many."""
    for e in range(starts[z], starts[z + 1]):
        p = entries[e]
        if values[p] != used[p]:
            used[p] = values[p]
            count = mark(factors, column[p], count)
    return count


@compiled
def solve_exchanged(problem, point, linear, stepping, h):
    """Move `y_end` by the solution for a residual that is zero but in the rows just exchanged."""
    reduced, factors, exchange = linear.reduced, linear.factors, stepping.exchange
    factors.solves += 1
    exchange.assumed |= CONSTANT
    if exchange.any_captured == 1:
        field_at(problem.call_drift, (problem.context, point.t + h, point.at_y_end, point.at_minus_slip))
    n = reduced.n_reduced
    x, place = reals(reduced.at_reduced_x, n), indices(factors.at_row_place, problem.n)
    changed = indices(exchange.at_exchanged_machines, problem.n_machines)
    own = indices(exchange.at_own_row, problem.n_machines)
    for k in range(n):
        x[k] = 0.0
    for c in range(exchange.n_exchanged):
        x[place[own[changed[c]]]] = residual_of_row(point, linear.matrices, stepping, changed[c], h)
    substitute(factors, reduced.at_reduced_x)
    order, y_end = indices(factors.at_column_order, n), reals(point.at_y_end, problem.n)
    differential = indices(problem.at_differential, problem.n)
    b, per_theta = reals(point.at_b, problem.n), 1.0 / stepping.rule.theta_now
    for k in range(n):
        j = order[k]
        b[j] = x[k]
        y_end[j] += per_theta * x[k] if differential[j] == 1 else x[k]
    position = indices(reduced.at_position, reduced.n_positions)
    speed = indices(reduced.at_position_speed, reduced.n_positions)
    ratio = reals(reduced.at_position_ratio, reduced.n_positions)
    for k in range(reduced.n_positions):
        if speed[k] >= 0:
            y_end[position[k]] += per_theta * ratio[k] * b[speed[k]]


@compiled
def forget_jacobian(rule):
    """Have J and M evaluated anew before the next solve. Another h or theta does not need it: only W is factorised.

    It is forgotten after a settlement (history.py); where a residual falls too slowly, or a step took more than two
    solves (theta_step.judge_residual); in a line search (residual.py); where rows of the cache were wrong (here); and
    where the rows of a zone are in no cache, or W is a full matrix (linearise.py). A part that is cut out or given back
    begins with none (parts.py).
    """
    rule.linearised = 0


@compiled
def invalidate_assumed(stepping):
    """The laws say otherwise than the rows of before: evaluate all, and rely on those no more."""
    exchange = stepping.exchange
    exchange.invalidated |= exchange.assumed
    exchange.assumed = 0
    forget_jacobian(stepping.rule)
    forget_rows(exchange)


@compiled
def watch_surfaces(problem, point, matrices, exchange):
    """Of contacts captured by their known rows: whether the surface of one varies its speed."""
    exchange.captured_by_row = 0
    if exchange.support_accelerates == 1:
        return
    field_at(problem.call_drift, (problem.context, point.t, point.at_y_end, point.at_minus_slip))
    row = indices(exchange.at_hold_mass_row, exchange.n_hold_mass)
    column = indices(exchange.at_hold_mass_column, exchange.n_hold_mass)
    entry, values = indices(exchange.at_hold_mass, exchange.n_hold_mass), reals(matrices.at_mass, matrices.n_mass)
    y_end = reals(point.at_y_end, problem.n)
    holds, captured = indices(exchange.at_holds, problem.n), indices(exchange.at_captured, problem.n)
    minus_slip = reals(point.at_minus_slip, problem.n)
    for e in range(exchange.n_hold_mass):
        left = SPEED_ROUNDING * (1.0 + abs(values[entry[e]] * y_end[column[e]]))
        if holds[row[e]] == 1 and captured[row[e]] == 1 and abs(minus_slip[row[e]]) > left:
            exchange.support_accelerates = 1
