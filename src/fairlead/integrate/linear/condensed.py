"""The reduced matrix, assembled, factorised and solved; positions and quadratures follow (condensing.py).

Only columns whose entries changed since the last factorisation, and those that depend on them, are done
anew: a contact that switches changes a few. The factors of the others are what they would be again.
"""

from __future__ import annotations

from fairlead.integrate.codes import DONE, INACCURATE, SINGULAR
from fairlead.integrate.linear.condensing import FROM_JACOBIAN, FROM_MASS
from fairlead.integrate.linear.perturbed_pivots import factorise_columns, substitute
from fairlead.integrate.linear.sparse import backward_error, mark_users, scale_rows
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals

REFILL = 0.3
"""With more than this share of the columns changed, all are done."""


@compiled
def factorise_reduced(linear, scale, consistent):
    """Factorise s M - J, or the matrix of the consistent point; DONE, or INACCURATE: a pivot is not to be trusted.

    SINGULAR where other pivots were asked for, and there were none.
    """
    matrices, reduced, factors = linear.matrices, linear.reduced, linear.factors
    n = reduced.n_reduced
    kind = 1 if consistent else 0
    dirty = indices(factors.at_dirty, n)
    everything = reduced.reduced_kind != kind or reduced.reduced_scale != scale or reduced.reduced_valid == 0
    changed = 0
    if not everything:
        changed = mark_changed(linear)
        everything = changed > REFILL * n
    if everything:
        for k in range(n):
            dirty[k] = 1
    reduced.reduced_kind, reduced.reduced_scale, reduced.reduced_valid = kind, scale, 0
    slopes_of_positions(linear)
    for k in range(n):
        if dirty[k] == 1:
            assemble_column(linear, k)
    copy(reals(matrices.at_jacobian, matrices.n_jacobian), reals(reduced.at_jacobian_used, matrices.n_jacobian))
    copy(reals(matrices.at_mass, matrices.n_mass), reals(reduced.at_mass_used, matrices.n_mass))
    if everything:
        scale_rows(factors)
    else:
        mark_users(factors, changed)
    status = factorise_columns(factors)
    reduced.reduced_valid = 1 if status == DONE else 0
    if factors.no_pivots == 1:
        factors.no_pivots = 0
        status = SINGULAR if status == INACCURATE else status
    return status


@compiled
def mark_changed(linear):
    """Mark the columns of the reduced matrix in which J or M is not what it was; how many, listed in `waiting`."""
    matrices, reduced, factors = linear.matrices, linear.reduced, linear.factors
    count = 0
    column, now, used = (
        indices(reduced.at_jacobian_column, matrices.n_jacobian), reals(matrices.at_jacobian, matrices.n_jacobian),
        reals(reduced.at_jacobian_used, matrices.n_jacobian),
    )  # fmt: skip
    for p in range(matrices.n_jacobian):
        if now[p] != used[p]:
            count = mark(factors, column[p], count)
    column, now = indices(reduced.at_mass_column, matrices.n_mass), reals(matrices.at_mass, matrices.n_mass)
    used = reals(reduced.at_mass_used, matrices.n_mass)
    for p in range(matrices.n_mass):
        if now[p] != used[p]:
            count = mark(factors, column[p], count)
    return count


@compiled
def mark(factors, k, count):
    """Mark column k of the reduced matrix (-1: none), the `count`-th or already marked; how many then are."""
    dirty = indices(factors.at_dirty, factors.n_reduced)
    if k >= 0 and dirty[k] == 0:
        dirty[k] = 1
        indices(factors.at_waiting, factors.n_reduced)[count] = k
        count += 1
    return count


@compiled
def factorise_marked(linear, count):
    """Factorise anew the `count` columns in `waiting`, whose entries changed, and those that use them."""
    reduced, factors = linear.reduced, linear.factors
    waiting = indices(factors.at_waiting, reduced.n_reduced)
    reduced.reduced_valid = 0
    for e in range(count):
        assemble_column(linear, waiting[e])
    mark_users(factors, count)
    status = factorise_columns(factors)
    reduced.reduced_valid = 1 if status == DONE else 0
    return status


@compiled
def slopes_of_positions(linear):
    """position_ratio = dx/dv, position_share = dx/db_x of every position; quadrature_share the same of quadratures."""
    matrices, reduced = linear.matrices, linear.reduced
    jacobian, mass = reals(matrices.at_jacobian, matrices.n_jacobian), reals(matrices.at_mass, matrices.n_mass)
    ratio = reals(reduced.at_position_ratio, reduced.n_positions)
    part = reals(reduced.at_position_share, reduced.n_positions)
    slope = indices(reduced.at_position_slope, reduced.n_positions)
    inertia = indices(reduced.at_position_mass, reduced.n_positions)
    speed = indices(reduced.at_position_speed, reduced.n_positions)
    differential = indices(matrices.at_differential, matrices.n)
    for k in range(reduced.n_positions):
        part[k] = 1.0 / (reduced.reduced_scale * mass[inertia[k]])
        ratio[k] = 0.0
        if slope[k] >= 0 and (reduced.reduced_kind == 0 or differential[speed[k]] == 0):
            ratio[k] = jacobian[slope[k]] * part[k]
    part = reals(reduced.at_quadrature_share, reduced.n_quadrature_rows)
    inertia = indices(reduced.at_quadrature_mass, reduced.n_quadrature_rows)
    for k in range(reduced.n_quadrature_rows):
        part[k] = 1.0 / (reduced.reduced_scale * mass[inertia[k]])


@compiled
def assemble_column(linear, k):
    """Fill column k of the reduced matrix."""
    matrices, reduced, factors = linear.matrices, linear.reduced, linear.factors
    matrix = reals(factors.at_matrix, factors.n_matrix)
    starts = indices(factors.at_matrix_starts, reduced.n_reduced + 1)
    for p in range(starts[k], starts[k + 1]):
        matrix[p] = 0.0
    jacobian, mass = reals(matrices.at_jacobian, matrices.n_jacobian), reals(matrices.at_mass, matrices.n_mass)
    ratio = reals(reduced.at_position_ratio, reduced.n_positions)
    begins = indices(reduced.at_entry_starts, reduced.n_reduced + 1)
    source = indices(reduced.at_entry_source, reduced.n_entries)
    place = indices(reduced.at_entry_place, reduced.n_entries)
    kind = indices(reduced.at_entry_kind, reduced.n_entries)
    unknown = indices(factors.at_column_order, reduced.n_reduced)[k]
    algebraic = indices(matrices.at_differential, matrices.n)[unknown] == 0
    from_jacobian = reduced.reduced_kind == 0 or algebraic
    for e in range(begins[k], begins[k + 1]):
        if kind[e] == FROM_MASS:
            matrix[place[e]] += reduced.reduced_scale * mass[source[e]]
        elif kind[e] == FROM_JACOBIAN:
            if from_jacobian:
                matrix[place[e]] -= jacobian[source[e]]
        elif reduced.reduced_kind == 0:
            matrix[place[e]] -= jacobian[source[e]] * ratio[kind[e]]


@compiled
def solve_reduced(linear, at_b, quadratures, refine_above):
    """Overwrite the n doubles at `at_b` with the solution; its backward error if `refine_above` is not 0, else 0.

    Where `quadratures` are not asked for, what stands in their rows is of no use.
    """
    reduced, factors = linear.reduced, linear.factors
    n = reduced.n_reduced
    b, x, right = reals(at_b, reduced.n), reals(reduced.at_reduced_x, n), reals(reduced.at_reduced_b, n)
    row_order, column_order = indices(reduced.at_row_order, n), indices(factors.at_column_order, n)
    pass_positions_on(linear, at_b, quadratures)
    for k in range(n):
        x[k] = b[row_order[k]]
    if refine_above > 0.0:
        copy(x, right)
    substitute(factors, reduced.at_reduced_x)
    error = 0.0
    if refine_above > 0.0:
        error = backward_error(linear)
        if error > refine_above:
            correction = reals(factors.at_reduced_residual, n)
            substitute(factors, factors.at_reduced_residual)
            for k in range(n):
                x[k] += correction[k]
            error = backward_error(linear)
    for k in range(n):
        b[column_order[k]] = x[k]
    follow_reduced(linear, at_b, quadratures)
    return error


@compiled
def pass_positions_on(linear, at_b, quadratures):
    """Add to b what the right sides of the positions do to other rows; `quadratures` that are asked for are spared."""
    matrices, reduced = linear.matrices, linear.reduced
    if reduced.reduced_kind == 1:
        return
    b = reals(at_b, matrices.n)
    position = indices(reduced.at_position, reduced.n_positions)
    part = reals(reduced.at_position_share, reduced.n_positions)
    starts = indices(matrices.at_jacobian_starts, matrices.n + 1)
    rows = indices(matrices.at_jacobian_rows, matrices.n_jacobian)
    jacobian = reals(reduced.at_jacobian_used, matrices.n_jacobian)
    quadrature = indices(matrices.at_quadrature, matrices.n)
    for k in range(reduced.n_positions):
        x = position[k]
        shift = b[x] * part[k]
        if shift == 0.0:
            continue
        if quadratures:
            for p in range(starts[x], starts[x + 1]):
                if quadrature[rows[p]] == 0:
                    b[rows[p]] += jacobian[p] * shift
        else:
            for p in range(starts[x], starts[x + 1]):
                b[rows[p]] += jacobian[p] * shift


@compiled
def follow_reduced(linear, at_b, quadratures):
    """Positions from the solution of the reduced matrix, and `quadratures` if they are asked for."""
    matrices, reduced = linear.matrices, linear.reduced
    b = reals(at_b, matrices.n)
    position = indices(reduced.at_position, reduced.n_positions)
    speed = indices(reduced.at_position_speed, reduced.n_positions)
    ratio = reals(reduced.at_position_ratio, reduced.n_positions)
    part = reals(reduced.at_position_share, reduced.n_positions)
    for k in range(reduced.n_positions):
        x, v = position[k], speed[k]
        b[x] = part[k] * b[x] + (ratio[k] * b[v] if v >= 0 else 0.0)
    if not quadratures:
        return
    jacobian = reals(reduced.at_jacobian_used, matrices.n_jacobian)
    differential = indices(matrices.at_differential, matrices.n)
    row = indices(reduced.at_quadrature_row, reduced.n_quadrature_rows)
    starts = indices(reduced.at_quadrature_starts, reduced.n_quadrature_rows + 1)
    entry = indices(reduced.at_quadrature_entry, reduced.n_quadrature_entries)
    column = indices(reduced.at_quadrature_column, reduced.n_quadrature_entries)
    part = reals(reduced.at_quadrature_share, reduced.n_quadrature_rows)
    for k in range(reduced.n_quadrature_rows):
        total = b[row[k]]
        for e in range(starts[k], starts[k + 1]):
            if reduced.reduced_kind == 0 or differential[column[e]] == 0:
                total += jacobian[entry[e]] * b[column[e]]
        b[row[k]] = part[k] * total
