"""Linear systems of a step and of a consistent point: assemble, factorise, solve.

    step              W = s M - J, s = 1/(h gamma)
    consistent point  C = the columns of M where y_i is differential, of -J where it is algebraic

Both live in `matrix`, along one fixed pattern. Below DENSE_LIMIT unknowns it is a full matrix, by
columns, factored here with partial pivoting; above, the core of it (condensing.py) along a plan, see
sparse.py. Unknowns are scaled by their error weight before rows are compared, so that the choice of
pivots does not depend on units.
"""

from __future__ import annotations

from fairlead.integrate.condensed import factorise_core, solve_core
from fairlead.integrate.foreign import compiled, indices, reals

DONE, SINGULAR, INACCURATE = 0, 1, 2
REFINE_ABOVE, DISTRUST_ABOVE = 1e-12, 1e-9
"""Backward error of a first solve that asks for refinement, and, after it, for other pivots."""


@compiled
def factorise_step(m, scale):
    """Factorise scale M - J; DONE, SINGULAR or INACCURATE. On SINGULAR, `culprit` is the unknown to blame."""
    m.factorisations += 1
    if m.dense == 0:
        return factorise_core(m, scale, False)
    assemble_step(m, scale)
    return factorise_dense(m)


@compiled
def factorise_consistent(m):
    """Factorise the matrix of the consistent point; as factorise_step."""
    m.factorisations += 1
    if m.dense == 0:
        return factorise_core(m, 1.0, True)
    assemble_consistent(m)
    return factorise_dense(m)


@compiled
def solve(m, at_b):
    """Overwrite the n doubles at address `at_b` with the solution for that right-hand side."""
    m.solves += 1
    if m.dense == 1:
        solve_dense(m, at_b)
    else:
        solve_core(m, at_b, 0.0)


@compiled
def solve_watched(m, at_b):
    """As solve, for the first one after a factorisation: DONE, or INACCURATE when other pivots are needed.

    A planned pivot order can lose all accuracy with no small pivot to see, so the residual decides,
    after one step of refinement.
    """
    m.solves += 1
    if m.dense == 1:
        solve_dense(m, at_b)
        return DONE
    if solve_core(m, at_b, REFINE_ABOVE) <= DISTRUST_ABOVE:
        return DONE
    m.culprit = -1
    return INACCURATE


@compiled
def assemble_step(m, scale):
    """Write scale M - J into the full matrix."""
    matrix = reals(m.at_matrix, m.n_matrix)
    place, values = indices(m.at_jacobian_place, m.n_jacobian), reals(m.at_jacobian, m.n_jacobian)
    matrix[:] = 0.0
    for p in range(m.n_jacobian):
        matrix[place[p]] -= values[p]
    place, values = indices(m.at_mass_place, m.n_mass), reals(m.at_mass, m.n_mass)
    for p in range(m.n_mass):
        matrix[place[p]] += scale * values[p]


@compiled
def assemble_consistent(m):
    """Write the matrix of the consistent point into the full matrix."""
    matrix = reals(m.at_matrix, m.n_matrix)
    differential = indices(m.at_differential, m.n)
    matrix[:] = 0.0
    starts, place = indices(m.at_jacobian_starts, m.n + 1), indices(m.at_jacobian_place, m.n_jacobian)
    values = reals(m.at_jacobian, m.n_jacobian)
    for j in range(m.n):
        if differential[j] == 0:
            for p in range(starts[j], starts[j + 1]):
                matrix[place[p]] -= values[p]
    place, values = indices(m.at_mass_place, m.n_mass), reals(m.at_mass, m.n_mass)
    for p in range(m.n_mass):
        matrix[place[p]] += values[p]


@compiled
def factorise_dense(m):
    """LU with partial pivoting of the scaled full matrix, by columns, pivots stored as reciprocals."""
    n = m.n
    a, order = reals(m.at_matrix, n * n), indices(m.at_pivot_rows, n)
    if not scale_dense(m):
        return SINGULAR
    for k in range(n):
        pivot_row = k
        for i in range(k + 1, n):
            if abs(a[k * n + i]) > abs(a[k * n + pivot_row]):
                pivot_row = i
        order[k] = pivot_row
        if pivot_row != k:
            for j in range(n):
                a[j * n + k], a[j * n + pivot_row] = a[j * n + pivot_row], a[j * n + k]
        if not abs(a[k * n + k]) > 1e-15:
            m.culprit = k
            return SINGULAR
        inverse = 1.0 / a[k * n + k]
        a[k * n + k] = inverse
        for i in range(k + 1, n):
            a[k * n + i] *= inverse
        for j in range(k + 1, n):
            value = a[j * n + k]
            if value != 0.0:
                for i in range(k + 1, n):
                    a[j * n + i] -= a[k * n + i] * value
    return DONE


@compiled
def scale_dense(m):
    """Unknowns in units of their weight, rows by their largest entry; False where one is zero or not finite."""
    n = m.n
    a = reals(m.at_matrix, n * n)
    row_scale, column_scale = reals(m.at_row_scale, n), reals(m.at_column_scale, n)
    for i in range(n):
        largest = 0.0
        for j in range(n):
            a[j * n + i] *= column_scale[j]
            largest = max(largest, abs(a[j * n + i]))
        if not (largest > 0.0 and largest < 1e300):
            m.culprit = i
            return False
        row_scale[i] = 1.0 / largest
        for j in range(n):
            a[j * n + i] *= row_scale[i]
    return True


@compiled
def solve_dense(m, at_b):
    """Forward and backward substitution with the factors of `factorise_dense`."""
    n = m.n
    a, b = reals(m.at_matrix, n * n), reals(at_b, n)
    row_scale, column_scale = reals(m.at_row_scale, n), reals(m.at_column_scale, n)
    order = indices(m.at_pivot_rows, n)
    for i in range(n):
        b[i] *= row_scale[i]
    for k in range(n):
        b[k], b[order[k]] = b[order[k]], b[k]
    for k in range(n):
        value = b[k]
        if value != 0.0:
            for i in range(k + 1, n):
                b[i] -= a[k * n + i] * value
    for k in range(n - 1, -1, -1):
        value = b[k] * a[k * n + k]
        b[k] = value
        if value != 0.0:
            for i in range(k):
                b[i] -= a[k * n + i] * value
    for i in range(n):
        b[i] *= column_scale[i]


@compiled
def add_mass_times(m, at_v, at_b):
    """Add M v to b, for the n doubles at the two addresses."""
    rows, columns = indices(m.at_mass_rows, m.n_mass), indices(m.at_mass_columns, m.n_mass)
    values, v, b = reals(m.at_mass, m.n_mass), reals(at_v, m.n), reals(at_b, m.n)
    for p in range(m.n_mass):
        b[rows[p]] += values[p] * v[columns[p]]


@compiled
def times_jacobian(m, at_v, at_b):
    """Add J v to b over the differential columns, for the n doubles at the two addresses."""
    starts, rows = indices(m.at_jacobian_starts, m.n + 1), indices(m.at_jacobian_rows, m.n_jacobian)
    values, differential = reals(m.at_jacobian, m.n_jacobian), indices(m.at_differential, m.n)
    v, b = reals(at_v, m.n), reals(at_b, m.n)
    for j in range(m.n):
        if differential[j] == 1:
            for p in range(starts[j], starts[j + 1]):
                b[rows[p]] += values[p] * v[j]
