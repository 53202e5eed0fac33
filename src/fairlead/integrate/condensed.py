"""The core of W, assembled, factorised and solved; positions and quadratures follow (condensing.py).

Only columns whose entries changed since the last factorisation, and those that depend on them, are done
anew: a contact that switches changes a few. The factors of the others are what they would be again.
"""

from __future__ import annotations

from fairlead.integrate.condensing import FROM_JACOBIAN, FROM_MASS
from fairlead.integrate.foreign import compiled, copy, indices, reals
from fairlead.integrate.perturbed_pivots import factorise_columns, substitute
from fairlead.integrate.sparse import backward_error, mark_users, scale_rows

REFILL = 0.3
"""With more than this share of the columns changed, all are done."""


@compiled
def factorise_core(m, scale, consistent):
    """Factorise s M - J, or the matrix of the consistent point; 0 done, 2 a pivot is not to be trusted."""
    n = m.n_core
    kind = 1 if consistent else 0
    dirty = indices(m.at_dirty, n)
    everything = m.core_kind != kind or m.core_scale != scale or m.core_valid == 0
    changed = 0
    if not everything:
        changed = mark_changed(m)
        everything = changed > REFILL * n
    if everything:
        for k in range(n):
            dirty[k] = 1
    m.core_kind, m.core_scale, m.core_valid = kind, scale, 0
    slopes_of_positions(m)
    for k in range(n):
        if dirty[k] == 1:
            assemble_column(m, k)
    copy(reals(m.at_jacobian, m.n_jacobian), reals(m.at_jacobian_used, m.n_jacobian))
    copy(reals(m.at_mass, m.n_mass), reals(m.at_mass_used, m.n_mass))
    if everything:
        scale_rows(m)
    else:
        mark_users(m, changed)
    status = factorise_columns(m)
    m.core_valid = 1 if status == 0 else 0
    return status


@compiled
def mark_changed(m):
    """Mark the columns of the core with an entry of J or M that is not what it was; how many, listed in `waiting`."""
    count = 0
    column, now, used = (
        indices(m.at_jacobian_column, m.n_jacobian), reals(m.at_jacobian, m.n_jacobian),
        reals(m.at_jacobian_used, m.n_jacobian),
    )  # fmt: skip
    for p in range(m.n_jacobian):
        if now[p] != used[p]:
            count = mark(m, column[p], count)
    column, now, used = indices(m.at_mass_column, m.n_mass), reals(m.at_mass, m.n_mass), reals(m.at_mass_used, m.n_mass)
    for p in range(m.n_mass):
        if now[p] != used[p]:
            count = mark(m, column[p], count)
    return count


@compiled
def mark(m, k, count):
    """Mark column k of the core (-1: none), the `count`-th or already marked; how many then are."""
    dirty = indices(m.at_dirty, m.n_core)
    if k >= 0 and dirty[k] == 0:
        dirty[k] = 1
        indices(m.at_waiting, m.n_core)[count] = k
        count += 1
    return count


@compiled
def factorise_marked(m, count):
    """Factorise anew the `count` columns in `waiting`, whose entries changed, and those that use them."""
    waiting = indices(m.at_waiting, m.n_core)
    m.core_valid = 0
    for e in range(count):
        assemble_column(m, waiting[e])
    mark_users(m, count)
    status = factorise_columns(m)
    m.core_valid = 1 if status == 0 else 0
    return status


@compiled
def slopes_of_positions(m):
    """position_ratio = dx/dv, position_share = dx/db_x of every position; meter_share the same of quadratures."""
    jacobian, mass = reals(m.at_jacobian, m.n_jacobian), reals(m.at_mass, m.n_mass)
    ratio, part = reals(m.at_position_ratio, m.n_positions), reals(m.at_position_share, m.n_positions)
    slope, inertia = indices(m.at_position_slope, m.n_positions), indices(m.at_position_mass, m.n_positions)
    speed, differential = indices(m.at_position_speed, m.n_positions), indices(m.at_differential, m.n)
    for k in range(m.n_positions):
        part[k] = 1.0 / (m.core_scale * mass[inertia[k]])
        ratio[k] = 0.0
        if slope[k] >= 0 and (m.core_kind == 0 or differential[speed[k]] == 0):
            ratio[k] = jacobian[slope[k]] * part[k]
    part, inertia = reals(m.at_meter_share, m.n_meters), indices(m.at_meter_mass, m.n_meters)
    for k in range(m.n_meters):
        part[k] = 1.0 / (m.core_scale * mass[inertia[k]])


@compiled
def assemble_column(m, k):
    """Fill column k of the core."""
    matrix, starts = reals(m.at_matrix, m.n_matrix), indices(m.at_matrix_starts, m.n_core + 1)
    for p in range(starts[k], starts[k + 1]):
        matrix[p] = 0.0
    jacobian, mass = reals(m.at_jacobian, m.n_jacobian), reals(m.at_mass, m.n_mass)
    ratio = reals(m.at_position_ratio, m.n_positions)
    begins = indices(m.at_entry_starts, m.n_core + 1)
    source, place = indices(m.at_entry_source, m.n_entries), indices(m.at_entry_place, m.n_entries)
    kind = indices(m.at_entry_kind, m.n_entries)
    algebraic = indices(m.at_differential, m.n)[indices(m.at_column_order, m.n_core)[k]] == 0
    from_jacobian = m.core_kind == 0 or algebraic
    for e in range(begins[k], begins[k + 1]):
        if kind[e] == FROM_MASS:
            matrix[place[e]] += m.core_scale * mass[source[e]]
        elif kind[e] == FROM_JACOBIAN:
            if from_jacobian:
                matrix[place[e]] -= jacobian[source[e]]
        elif m.core_kind == 0:
            matrix[place[e]] -= jacobian[source[e]] * ratio[kind[e]]


@compiled
def solve_core(m, at_b, refine_above):
    """Overwrite the n doubles at `at_b` with the solution; its backward error if `refine_above` is not 0, else 0."""
    n = m.n_core
    b, x, right = reals(at_b, m.n), reals(m.at_core_x, n), reals(m.at_core_b, n)
    row_order, column_order = indices(m.at_row_order, n), indices(m.at_column_order, n)
    pass_positions_on(m, at_b)
    for k in range(n):
        x[k] = b[row_order[k]]
    if refine_above > 0.0:
        copy(x, right)
    substitute(m, m.at_core_x)
    error = 0.0
    if refine_above > 0.0:
        error = backward_error(m)
        if error > refine_above:
            correction = reals(m.at_core_residual, n)
            substitute(m, m.at_core_residual)
            for k in range(n):
                x[k] += correction[k]
            error = backward_error(m)
    for k in range(n):
        b[column_order[k]] = x[k]
    follow_core(m, at_b)
    return error


@compiled
def pass_positions_on(m, at_b):
    """Add to b what the right sides of the positions do to other rows; quadratures have no use for it."""
    if m.core_kind == 1:
        return
    b = reals(at_b, m.n)
    position, part = indices(m.at_position, m.n_positions), reals(m.at_position_share, m.n_positions)
    starts, rows = indices(m.at_jacobian_starts, m.n + 1), indices(m.at_jacobian_rows, m.n_jacobian)
    jacobian, quadrature = reals(m.at_jacobian_used, m.n_jacobian), indices(m.at_quadrature, m.n)
    for k in range(m.n_positions):
        x = position[k]
        shift = b[x] * part[k]
        if shift == 0.0:
            continue
        if m.skip_meters == 1:
            for p in range(starts[x], starts[x + 1]):
                b[rows[p]] += jacobian[p] * shift
        else:
            for p in range(starts[x], starts[x + 1]):
                if quadrature[rows[p]] == 0:
                    b[rows[p]] += jacobian[p] * shift


@compiled
def follow_core(m, at_b):
    """Positions and quadratures from the solution of the core."""
    b = reals(at_b, m.n)
    position, speed = indices(m.at_position, m.n_positions), indices(m.at_position_speed, m.n_positions)
    ratio, part = reals(m.at_position_ratio, m.n_positions), reals(m.at_position_share, m.n_positions)
    for k in range(m.n_positions):
        x, v = position[k], speed[k]
        b[x] = part[k] * b[x] + (ratio[k] * b[v] if v >= 0 else 0.0)
    if m.skip_meters == 1:
        return
    jacobian, differential = reals(m.at_jacobian_used, m.n_jacobian), indices(m.at_differential, m.n)
    meter, starts = indices(m.at_meter, m.n_meters), indices(m.at_meter_starts, m.n_meters + 1)
    entry, column = indices(m.at_meter_entry, m.n_meter_entries), indices(m.at_meter_column, m.n_meter_entries)
    part = reals(m.at_meter_share, m.n_meters)
    for k in range(m.n_meters):
        total = b[meter[k]]
        for e in range(starts[k], starts[k + 1]):
            if m.core_kind == 0 or differential[column[e]] == 0:
                total += jacobian[entry[e]] * b[column[e]]
        b[meter[k]] = part[k] * total
