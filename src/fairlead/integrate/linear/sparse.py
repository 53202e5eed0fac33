"""Sparse LU along a pivot order planned once (see ordering.py): refactorise and solve.

Left-looking, column by column (Gilbert, Peierls, SIAM J. Sci. Stat. Comput. 9:862, 1988), with the
patterns of L and U known, as KLU does when it refactorises (Davis, Palamadai Natarajan, ACM TOMS
37:36, 2010). `matrix` holds the columns of the reduced matrix in pivot order, rows renumbered in pivot order.
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import DONE, INACCURATE
from fairlead.integrate.memory.foreign import compiled, indices, reals

GROWTH_LIMIT = 1e8
"""Largest entry of L that is still trusted: with pivots this small a residual of rounding size is luck."""

DROPPED = 1e-200
"""Below this a number is zero. Along a chain of which one end rests the solution decays to numbers that
processors handle a hundred times slower than others; none of them matters."""
NO_SIZE = 1e-180
"""A right-hand side smaller than this everywhere is no test of a factorisation: what `DROPPED` drops of its
solution would count as an error (a chain that came to rest once ended a run as singular, with 1e-209)."""


@compiled
def factorise_planned(factors):
    """Refactorise the `n_redone` columns marked `dirty`, and unmark them; DONE, or INACCURATE: a pivot is untrusted.

    Up to `most_perturbed` pivots are perturbed instead (perturbed_pivots.py).
    """
    n = factors.n_reduced
    starts, rows = indices(factors.at_matrix_starts, n + 1), indices(factors.at_matrix_rows, factors.n_matrix)
    values = reals(factors.at_matrix, factors.n_matrix)
    lower_starts, upper_starts = indices(factors.at_lower_starts, n + 1), indices(factors.at_upper_starts, n + 1)
    n_lower, n_upper = lower_starts[n], upper_starts[n]
    lower_rows, upper_rows = indices(factors.at_lower_rows, n_lower), indices(factors.at_upper_rows, n_upper)
    lower, upper = reals(factors.at_lower, n_lower), reals(factors.at_upper, n_upper)
    pivot, x = reals(factors.at_pivot, n), reals(factors.at_factor_work, n)
    dirty, scale = indices(factors.at_dirty, n), reals(factors.at_row_scale, n)
    added = reals(factors.at_perturbation, n)
    factors.n_redone = 0
    for k in range(n):
        if dirty[k] == 0:
            continue
        dirty[k] = 0
        factors.n_redone += 1
        if added[k] != 0.0:
            added[k] = 0.0
            factors.n_perturbed -= 1
        first, last = upper_starts[k], upper_starts[k + 1]
        for p in range(first, last):
            x[upper_rows[p]] = 0.0
        x[k] = 0.0
        below, end = lower_starts[k], lower_starts[k + 1]
        for p in range(below, end):
            x[lower_rows[p]] = 0.0
        for p in range(starts[k], starts[k + 1]):
            x[rows[p]] = values[p]
        for p in range(first, last):
            j = upper_rows[p]
            value = x[j]
            upper[p] = value
            if value != 0.0:
                for q in range(lower_starts[j], lower_starts[j + 1]):
                    x[lower_rows[q]] -= lower[q] * value
        largest = 0.0
        for p in range(below, end):
            largest = max(largest, abs(x[lower_rows[p]]) * scale[lower_rows[p]])
        if not (abs(x[k]) > 0.0 and largest <= GROWTH_LIMIT * abs(x[k]) * scale[k]):
            unknown = indices(factors.at_column_order, n)[k]
            if factors.n_perturbed >= factors.most_perturbed or not (isfinite(x[k]) and isfinite(largest)):
                factors.culprit = unknown
                return INACCURATE
            added[k] = max(largest, 1.0 / reals(factors.at_column_scale, factors.n)[unknown]) / scale[k]
            added[k] = -added[k] if x[k] < 0.0 else added[k]
            x[k] += added[k]
            factors.n_perturbed += 1
        inverse = 1.0 / x[k]
        pivot[k] = inverse
        for p in range(below, end):
            lower[p] = x[lower_rows[p]] * inverse
    return DONE


@compiled
def mark_users(factors, count):
    """Mark as `dirty` all columns that use one of the `count` columns in `waiting`, and those that use them."""
    starts = indices(factors.at_using_starts, factors.n_reduced + 1)
    columns = indices(factors.at_using_columns, starts[factors.n_reduced])
    dirty, waiting = indices(factors.at_dirty, factors.n_reduced), indices(factors.at_waiting, factors.n_reduced)
    while count > 0:
        count -= 1
        j = waiting[count]
        for p in range(starts[j], starts[j + 1]):
            k = columns[p]
            if dirty[k] == 0:
                dirty[k] = 1
                waiting[count] = k
                count += 1


@compiled
def scale_rows(factors):
    """row_scale = 1 / the largest entry of each row of the reduced matrix, its columns in units of their weight."""
    n = factors.n_reduced
    starts, rows = indices(factors.at_matrix_starts, n + 1), indices(factors.at_matrix_rows, factors.n_matrix)
    values, column_order = reals(factors.at_matrix, factors.n_matrix), indices(factors.at_column_order, n)
    row_scale, column_scale = reals(factors.at_row_scale, n), reals(factors.at_column_scale, factors.n)
    row_scale[:] = 0.0
    for k in range(n):
        nominal = column_scale[column_order[k]]
        for p in range(starts[k], starts[k + 1]):
            row_scale[rows[p]] = max(row_scale[rows[p]], abs(values[p]) * nominal)
    for i in range(n):
        row_scale[i] = 1.0 / row_scale[i] if row_scale[i] > 0.0 else 1.0


@compiled
def substitute_planned(factors, at_x):
    """Overwrite the right side at `at_x`, in pivot order, with the solution, by the factors."""
    n = factors.n_reduced
    lower_starts, upper_starts = indices(factors.at_lower_starts, n + 1), indices(factors.at_upper_starts, n + 1)
    n_lower, n_upper = lower_starts[n], upper_starts[n]
    lower_rows, upper_rows = indices(factors.at_lower_rows, n_lower), indices(factors.at_upper_rows, n_upper)
    lower, upper = reals(factors.at_lower, n_lower), reals(factors.at_upper, n_upper)
    pivot, x = reals(factors.at_pivot, n), reals(at_x, n)
    for k in range(n):
        value = x[k]
        if abs(value) <= DROPPED:
            x[k] = 0.0
        else:
            for p in range(lower_starts[k], lower_starts[k + 1]):
                x[lower_rows[p]] -= lower[p] * value
    for k in range(n - 1, -1, -1):
        value = x[k] * pivot[k]
        if abs(value) <= DROPPED:
            x[k] = 0.0
        else:
            x[k] = value
            for p in range(upper_starts[k], upper_starts[k + 1]):
                x[upper_rows[p]] -= upper[p] * value


@compiled
def backward_error(linear):
    """Largest |b - A x| over the largest |A||x| + |b|, for reduced_x the solution computed for reduced_b.

    By the norm of the scaled rows, not row by row: a row of a chain where nothing moves yet holds
    numbers near underflow, which no factorisation gets right and nobody needs. The residual itself is
    left in `reduced_residual`, ready for a step of refinement.
    """
    reduced, factors = linear.reduced, linear.factors
    n = reduced.n_reduced
    starts, rows = indices(factors.at_matrix_starts, n + 1), indices(factors.at_matrix_rows, factors.n_matrix)
    values, x = reals(factors.at_matrix, factors.n_matrix), reals(reduced.at_reduced_x, n)
    b = reals(reduced.at_reduced_b, n)
    residual, size = reals(factors.at_reduced_residual, n), reals(factors.at_factor_work, n)
    for k in range(n):
        residual[k] = b[k]
        size[k] = abs(b[k])
    for k in range(n):
        value = x[k]
        for p in range(starts[k], starts[k + 1]):
            product = values[p] * value
            residual[rows[p]] -= product
            size[rows[p]] += abs(product)
    scale = reals(factors.at_row_scale, n)
    worst, largest = 0.0, 0.0
    for k in range(n):
        error = abs(residual[k]) * scale[k]
        if not error <= worst:
            worst = error
        largest = max(largest, size[k] * scale[k])
    if largest <= NO_SIZE and worst <= NO_SIZE:
        return 0.0
    return worst / largest if largest > 0.0 else worst
