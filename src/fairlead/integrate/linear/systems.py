"""Linear systems of a step and of a consistent point: assemble, factorise, solve.

    step              W = s M - J, s = 1/(h gamma)
    consistent point  C = the columns of M where y_i is differential, of -J where it is algebraic

Both live in `matrix`, along one fixed pattern. With up to ordering.DENSE_LIMIT unknowns, and with more where that takes
less operations (ordering.plan), it is a full matrix, by columns, factored here with partial pivoting; else the reduced
matrix (condensing.py) along a plan, see sparse.py. Unknowns are scaled by their error weight before rows are compared,
so that the choice of pivots does not depend on units.
"""

from __future__ import annotations

from fairlead.integrate.codes import DONE, INACCURATE, SINGULAR, VANISHES
from fairlead.integrate.linear.condensed import factorise_reduced, solve_reduced
from fairlead.integrate.memory.foreign import compiled, indices, reals

REFINE_ABOVE, REPLAN_ABOVE = 1e-12, 1e-9
"""Backward error of a first solve that asks for refinement, and, after it, for other pivots."""


@compiled
def factorise_step(linear, scale):
    """Factorise scale M - J; DONE, SINGULAR or INACCURATE. On SINGULAR, `culprit` is the unknown to blame."""
    factors = linear.factors
    factors.factorisations += 1
    factors.mass_factor = scale
    if factors.dense == 0:
        return factorise_reduced(linear, scale, False)
    assemble_step(linear, scale)
    return factorise_dense(factors)


@compiled
def factorise_consistent(linear):
    """Factorise the matrix of the consistent point; as factorise_step."""
    factors = linear.factors
    factors.factorisations += 1
    if factors.dense == 0:
        return factorise_reduced(linear, 1.0, True)
    assemble_consistent(linear)
    return factorise_dense(factors)


@compiled
def solve(linear, at_b):
    """Overwrite the n doubles at address `at_b` with the solution for that right-hand side."""
    factors = linear.factors
    factors.solves += 1
    if factors.dense == 1:
        solve_dense(factors, at_b)
    else:
        solve_reduced(linear, at_b, True, 0.0)


@compiled
def solve_motion(linear, at_b):
    """As solve, but for the quadratures: for iterations, which nothing of them enters."""
    factors = linear.factors
    factors.solves += 1
    if factors.dense == 1:
        solve_dense(factors, at_b)
    else:
        solve_reduced(linear, at_b, False, 0.0)


@compiled
def solve_checked(linear, at_b):
    """As solve, for the first one after a factorisation: DONE, or INACCURATE when other pivots are needed.

    A planned pivot order can lose all accuracy with no small pivot to see, so the residual decides,
    after one step of refinement.
    """
    factors = linear.factors
    factors.solves += 1
    if factors.dense == 1:
        solve_dense(factors, at_b)
        return DONE
    if solve_reduced(linear, at_b, True, REFINE_ABOVE) <= REPLAN_ABOVE:
        return DONE
    factors.culprit = -1
    return INACCURATE


@compiled
def assemble_step(linear, scale):
    """Write scale M - J into the full matrix."""
    matrices, factors = linear.matrices, linear.factors
    matrix = reals(factors.at_matrix, factors.n_matrix)
    place = indices(factors.at_jacobian_place, matrices.n_jacobian)
    values = reals(matrices.at_jacobian, matrices.n_jacobian)
    matrix[:] = 0.0
    for p in range(matrices.n_jacobian):
        matrix[place[p]] -= values[p]
    place, values = indices(factors.at_mass_place, matrices.n_mass), reals(matrices.at_mass, matrices.n_mass)
    for p in range(matrices.n_mass):
        matrix[place[p]] += scale * values[p]


@compiled
def assemble_consistent(linear):
    """Write the matrix of the consistent point into the full matrix."""
    matrices, factors = linear.matrices, linear.factors
    matrix = reals(factors.at_matrix, factors.n_matrix)
    differential = indices(matrices.at_differential, matrices.n)
    matrix[:] = 0.0
    starts = indices(matrices.at_jacobian_starts, matrices.n + 1)
    place = indices(factors.at_jacobian_place, matrices.n_jacobian)
    values = reals(matrices.at_jacobian, matrices.n_jacobian)
    for j in range(matrices.n):
        if differential[j] == 0:
            for p in range(starts[j], starts[j + 1]):
                matrix[place[p]] -= values[p]
    place, values = indices(factors.at_mass_place, matrices.n_mass), reals(matrices.at_mass, matrices.n_mass)
    for p in range(matrices.n_mass):
        matrix[place[p]] += values[p]


@compiled
def factorise_dense(factors):
    """LU with partial pivoting of the scaled full matrix, by columns, pivots stored as reciprocals."""
    n = factors.n
    a, order = reals(factors.at_matrix, n * n), indices(factors.at_pivot_rows, n)
    if not scale_dense(factors):
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
        terms = abs(a[k * n + k])
        for j in range(k):
            terms += abs(a[j * n + k] * a[k * n + j])
        if not abs(a[k * n + k]) > VANISHES * terms:
            factors.culprit = k
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
def scale_dense(factors):
    """Unknowns in units of their weight, rows by their largest entry; False where one is zero or not finite."""
    n = factors.n
    a = reals(factors.at_matrix, n * n)
    row_scale, column_scale = reals(factors.at_row_scale, n), reals(factors.at_column_scale, n)
    for i in range(n):
        largest = 0.0
        for j in range(n):
            a[j * n + i] *= column_scale[j]
            largest = max(largest, abs(a[j * n + i]))
        if not (largest > 0.0 and largest < 1e300):
            factors.culprit = i
            return False
        row_scale[i] = 1.0 / largest
        for j in range(n):
            a[j * n + i] *= row_scale[i]
    return True


@compiled
def solve_dense(factors, at_b):
    """Forward and backward substitution with the factors of `factorise_dense`."""
    n = factors.n
    a, b = reals(factors.at_matrix, n * n), reals(at_b, n)
    row_scale, column_scale = reals(factors.at_row_scale, n), reals(factors.at_column_scale, n)
    order = indices(factors.at_pivot_rows, n)
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
