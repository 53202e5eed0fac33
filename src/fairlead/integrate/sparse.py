"""Sparse LU along a pivot order planned once (see ordering.py): refactorise and solve.

Left-looking, column by column (Gilbert, Peierls, SIAM J. Sci. Stat. Comput. 9:862, 1988), with the
patterns of L and U known, as KLU does when it refactorises (Davis, Palamadai Natarajan, ACM TOMS
37:36, 2010). `matrix` holds the columns in pivot order, rows renumbered in pivot order.
"""

from __future__ import annotations

from fairlead.integrate.foreign import compiled, indices, reals

GROWTH_LIMIT = 1e8
"""Largest entry of L that is still trusted: with pivots this small a residual of rounding size is luck."""

NOTHING = 1e-200
"""Below this a number, in units of its weight, is zero. Along a chain of which one end rests the solution
decays to numbers that processors handle a hundred times slower than others; none of them matters."""


@compiled
def factorise_sparse(m):
    """Refactorise `matrix` along the plan; 0 done, 2 a pivot is too small (or not a number) to be trusted."""
    n = m.n
    starts, rows = indices(m.at_matrix_starts, n + 1), indices(m.at_matrix_rows, m.n_matrix)
    values = reals(m.at_matrix, m.n_matrix)
    lower_starts, upper_starts = indices(m.at_lower_starts, n + 1), indices(m.at_upper_starts, n + 1)
    n_lower, n_upper = lower_starts[n], upper_starts[n]
    lower_rows, upper_rows = indices(m.at_lower_rows, n_lower), indices(m.at_upper_rows, n_upper)
    lower, upper = reals(m.at_lower, n_lower), reals(m.at_upper, n_upper)
    pivot, x = reals(m.at_pivot, n), reals(m.at_factor_work, n)
    column_order = indices(m.at_column_order, n)
    scale_rows(m)
    row_scale, column_scale = reals(m.at_row_scale, n), reals(m.at_column_scale, n)
    for k in range(n):
        for p in range(upper_starts[k], upper_starts[k + 1]):
            x[upper_rows[p]] = 0.0
        x[k] = 0.0
        for p in range(lower_starts[k], lower_starts[k + 1]):
            x[lower_rows[p]] = 0.0
        nominal = column_scale[column_order[k]]
        for p in range(starts[k], starts[k + 1]):
            x[rows[p]] = values[p] * nominal * row_scale[rows[p]]
        for p in range(upper_starts[k], upper_starts[k + 1]):
            j = upper_rows[p]
            value = x[j]
            upper[p] = value
            if value != 0.0:
                for q in range(lower_starts[j], lower_starts[j + 1]):
                    x[lower_rows[q]] -= lower[q] * value
        largest = 0.0
        for p in range(lower_starts[k], lower_starts[k + 1]):
            largest = max(largest, abs(x[lower_rows[p]]))
        if not (abs(x[k]) > 0.0 and largest <= GROWTH_LIMIT * abs(x[k])):
            m.culprit = column_order[k]
            return 2
        inverse = 1.0 / x[k]
        pivot[k] = inverse
        for p in range(lower_starts[k], lower_starts[k + 1]):
            lower[p] = x[lower_rows[p]] * inverse
    return 0


@compiled
def scale_rows(m):
    """row_scale (in pivot order) = 1 / the largest entry of each row, columns in units of their weight."""
    n = m.n
    starts, rows = indices(m.at_matrix_starts, n + 1), indices(m.at_matrix_rows, m.n_matrix)
    values, column_order = reals(m.at_matrix, m.n_matrix), indices(m.at_column_order, n)
    row_scale, column_scale = reals(m.at_row_scale, n), reals(m.at_column_scale, n)
    row_scale[:] = 0.0
    for k in range(n):
        nominal = column_scale[column_order[k]]
        for p in range(starts[k], starts[k + 1]):
            row_scale[rows[p]] = max(row_scale[rows[p]], abs(values[p]) * nominal)
    for i in range(n):
        row_scale[i] = 1.0 / row_scale[i] if row_scale[i] > 0.0 else 1.0


@compiled
def solve_sparse(m, at_b):
    """Overwrite the n doubles at `at_b` with the solution, by the factors of `factorise_sparse`."""
    n = m.n
    lower_starts, upper_starts = indices(m.at_lower_starts, n + 1), indices(m.at_upper_starts, n + 1)
    n_lower, n_upper = lower_starts[n], upper_starts[n]
    lower_rows, upper_rows = indices(m.at_lower_rows, n_lower), indices(m.at_upper_rows, n_upper)
    lower, upper = reals(m.at_lower, n_lower), reals(m.at_upper, n_upper)
    pivot, x, b = reals(m.at_pivot, n), reals(m.at_factor_work, n), reals(at_b, n)
    row_order, column_order = indices(m.at_row_order, n), indices(m.at_column_order, n)
    row_scale, column_scale = reals(m.at_row_scale, n), reals(m.at_column_scale, n)
    for k in range(n):
        x[k] = b[row_order[k]] * row_scale[k]
    for k in range(n):
        value = x[k]
        if abs(value) <= NOTHING:
            x[k] = 0.0
        else:
            for p in range(lower_starts[k], lower_starts[k + 1]):
                x[lower_rows[p]] -= lower[p] * value
    for k in range(n - 1, -1, -1):
        value = x[k] * pivot[k]
        if abs(value) <= NOTHING:
            x[k] = 0.0
        else:
            x[k] = value
            for p in range(upper_starts[k], upper_starts[k + 1]):
                x[upper_rows[p]] -= upper[p] * value
    for k in range(n):
        b[column_order[k]] = x[k] * column_scale[column_order[k]]


@compiled
def backward_error(m, at_x, at_b):
    """Largest |b - A x| over the largest |A||x| + |b|, for x at `at_x` the solution computed for b at `at_b`.

    By the norm of the scaled rows, not row by row: a row of a chain where nothing moves yet holds
    numbers near underflow, which no factorisation gets right and nobody needs. The residual itself is
    left in `residual`, ready for a step of refinement.
    """
    n = m.n
    starts, rows = indices(m.at_matrix_starts, n + 1), indices(m.at_matrix_rows, m.n_matrix)
    values, x, b = reals(m.at_matrix, m.n_matrix), reals(at_x, n), reals(at_b, n)
    row_order, column_order = indices(m.at_row_order, n), indices(m.at_column_order, n)
    residual, size = reals(m.at_residual, n), reals(m.at_factor_work, n)
    for k in range(n):
        residual[row_order[k]] = b[row_order[k]]
        size[k] = abs(b[row_order[k]])
    for k in range(n):
        value = x[column_order[k]]
        for p in range(starts[k], starts[k + 1]):
            product = values[p] * value
            residual[row_order[rows[p]]] -= product
            size[rows[p]] += abs(product)
    scale = reals(m.at_row_scale, n)
    worst, largest = 0.0, 0.0
    for k in range(n):
        error = abs(residual[row_order[k]]) * scale[k]
        if not error <= worst:
            worst = error
        largest = max(largest, size[k] * scale[k])
    return worst / largest if largest > 0.0 else worst
