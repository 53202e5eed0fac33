"""Rows of J and M that machines hold, kept for every zone a machine has been in.

A machine that holds a row changes, when it switches, that row of J and M alone. Where f is linear between switches,
the constant c of a row that slides, 0 = J_i u + c, is kept as well, and a row not yet known is that of a machine of the
same kind: laws then tell whether it is. Elsewhere it would change the iteration, and what it leaves of the residual,
by which machine was asked. A settlement forgets all: a time event may have changed the laws.
"""

from __future__ import annotations

from fairlead.integrate.codes import KNOWN_ZONES
from fairlead.integrate.foreign import compiled, copy, indices, reals

ROW, CONSTANT = 1, 2
"""What is known of a machine in a zone: nothing (0), its rows of J and M, and the constant too."""
OF_KIND = 4
"""A row taken from a machine of the same kind."""


@compiled
def learn_rows(m):
    """Keep the rows of J and M that machines hold, in the zones in force; J and M are those of these zones."""
    zones, own, known = indices(m.at_zones, m.n_zones), indices(m.at_own_row, m.n_zones), indices(m.at_known, m.n_known)
    copy(zones, indices(m.at_zones_linearised, m.n_zones))
    listed, kind = indices(m.at_exchanged_machines, m.n_zones), indices(m.at_own_kind, m.n_zones)
    of_kind = indices(m.at_known_of_kind, m.n_known)
    m.n_exchanged = 0
    for z in range(m.n_zones):
        if own[z] < 0 or zones[z] < 0 or zones[z] >= KNOWN_ZONES:
            continue
        listed[m.n_exchanged] = z
        m.n_exchanged += 1
        place = zones[z] * m.n_zones + z
        if known[place] > 0 and m.linear == 1:
            continue
        known[place] = max(known[place], ROW)
        of_kind[zones[z] * m.n_zones + kind[z]] = z + 1
        move_row(m, z, z, True)


@compiled
def move_row(m, z, like, learn):
    """Keep the row of machine z for the zone it is in, or put into J and M what was kept of machine `like`."""
    zone = indices(m.at_zones, m.n_zones)[z]
    starts, entries = indices(m.at_own_slope_starts, m.n_zones + 1), indices(m.at_own_slopes, m.n_own_slopes)
    values, kept = reals(m.at_jacobian, m.n_jacobian), reals(m.at_known_slopes, KNOWN_ZONES * m.n_own_slopes)
    move_entries(starts, entries, values, kept, z, zone * m.n_own_slopes + starts[like], learn)
    starts, entries = indices(m.at_own_mass_starts, m.n_zones + 1), indices(m.at_own_masses, m.n_own_masses)
    values, kept = reals(m.at_mass, m.n_mass), reals(m.at_known_masses, KNOWN_ZONES * m.n_own_masses)
    move_entries(starts, entries, values, kept, z, zone * m.n_own_masses + starts[like], learn)


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
def row_of(m, z):
    """The machine whose row is known for the zone of machine z: itself, or one like it, or -1."""
    zone = indices(m.at_zones, m.n_zones)[z]
    if zone < 0 or zone >= KNOWN_ZONES or indices(m.at_own_row, m.n_zones)[z] < 0:
        return -1
    if indices(m.at_known, m.n_known)[zone * m.n_zones + z] > 0:
        return z
    if m.linear == 0 or (m.distrusted & OF_KIND) != 0:
        return -1
    kind = indices(m.at_own_kind, m.n_zones)
    return indices(m.at_known_of_kind, m.n_known)[zone * m.n_zones + kind[z]] - 1


@compiled
def take_row(m, z):
    """Put the row of machine z for the zone it is in into J and M; it must be known."""
    like = row_of(m, z)
    move_row(m, z, like, False)
    if like != z:
        m.guessed |= OF_KIND
        move_row(m, z, z, True)
        indices(m.at_known, m.n_known)[indices(m.at_zones, m.n_zones)[z] * m.n_zones + z] = ROW


@compiled
def row_holds(m, z):
    """1 if the row of machine z has an entry in M; also marks it if that is of a node without mass."""
    starts, entries = indices(m.at_own_mass_starts, m.n_zones + 1), indices(m.at_own_masses, m.n_own_masses)
    values, columns = reals(m.at_mass, m.n_mass), indices(m.at_own_mass_columns, m.n_own_masses)
    differential, found = indices(m.at_differential, m.n), 0
    for e in range(starts[z], starts[z + 1]):
        if values[entries[e]] != 0.0:
            found = 1
            if differential[columns[e]] == 0:
                indices(m.at_of_massless, m.n)[indices(m.at_own_row, m.n_zones)[z]] = 1
                m.massless = 1
    return found


@compiled
def learn_constants(m):
    """Keep the constants of the rows just exchanged or evaluated that do not hold, from the residual b at `y_end`."""
    changed, zones = indices(m.at_exchanged_machines, m.n_zones), indices(m.at_zones, m.n_zones)
    constants, known = reals(m.at_known_constants, m.n_known), indices(m.at_known, m.n_known)
    b, own, holds = reals(m.at_b, m.n), indices(m.at_own_row, m.n_zones), indices(m.at_holds, m.n)
    for c in range(m.n_exchanged):
        z = changed[c]
        place = zones[z] * m.n_zones + z
        if known[place] == ROW and holds[own[z]] == 0:
            constants[place] = b[own[z]] - linear_part(m, z)
            known[place] = CONSTANT


@compiled
def residual_of_row(m, z, h):
    """The entry of b in the row of machine z: by the constant, or where it holds by the slip, in `residual`."""
    row = indices(m.at_own_row, m.n_zones)[z]
    if indices(m.at_holds, m.n)[row] == 1:
        return reals(m.at_residual, m.n)[row] / h + linear_part(m, z)
    return reals(m.at_known_constants, m.n_known)[indices(m.at_zones, m.n_zones)[z] * m.n_zones + z] + linear_part(m, z)


@compiled
def linear_part(m, z):
    """J_i u in the row of machine z, with u at the theta point; of a row that holds J_i has entries of forces alone."""
    y, y_end, differential = reals(m.at_y, m.n), reals(m.at_y_end, m.n), indices(m.at_differential, m.n)
    starts, entries = indices(m.at_own_slope_starts, m.n_zones + 1), indices(m.at_own_slopes, m.n_own_slopes)
    columns, values, total = indices(m.at_own_slope_columns, m.n_own_slopes), reals(m.at_jacobian, m.n_jacobian), 0.0
    for e in range(starts[z], starts[z + 1]):
        k = columns[e]
        u = y_end[k] if differential[k] == 0 else y[k] + m.theta_now * (y_end[k] - y[k])
        total += values[entries[e]] * u
    return total


@compiled
def rows_tell(m):
    """True if f is linear, and the residual of the rows just exchanged known without it."""
    if m.linear == 0 or (m.distrusted & CONSTANT) != 0 or m.driven == 1 or m.massless == 1:
        return False
    changed, zones = indices(m.at_exchanged_machines, m.n_zones), indices(m.at_zones, m.n_zones)
    known, own = indices(m.at_known, m.n_known), indices(m.at_own_row, m.n_zones)
    holds, caught, all_known = indices(m.at_holds, m.n), indices(m.at_caught, m.n), True
    for c in range(m.n_exchanged):
        z = changed[c]
        if holds[own[z]] == 1:
            all_known = all_known and caught[own[z]] == 1
        else:
            all_known = all_known and known[zones[z] * m.n_zones + z] == CONSTANT
    return all_known


@compiled
def forget_rows(m):
    """Nothing is known of any row."""
    known, of_kind = indices(m.at_known, m.n_known), indices(m.at_known_of_kind, m.n_known)
    for k in range(m.n_known):
        known[k] = 0
        of_kind[k] = 0
