"""Products with J and M along their patterns, for vectors of n doubles at addresses; the inertia of an unknown."""

from __future__ import annotations

from fairlead.integrate.memory.foreign import compiled, indices, reals


@compiled
def add_mass_times(matrices, at_v, at_b):
    """Add M v to b."""
    rows, columns = indices(matrices.at_mass_rows, matrices.n_mass), indices(matrices.at_mass_columns, matrices.n_mass)
    values, v, b = reals(matrices.at_mass, matrices.n_mass), reals(at_v, matrices.n), reals(at_b, matrices.n)
    for p in range(matrices.n_mass):
        b[rows[p]] += values[p] * v[columns[p]]


@compiled
def add_jacobian_times(matrices, sign, at_v, at_b):
    """Add J v to b, or with a sign of -1 take it away."""
    starts = indices(matrices.at_jacobian_starts, matrices.n + 1)
    rows = indices(matrices.at_jacobian_rows, matrices.n_jacobian)
    values, v, b = reals(matrices.at_jacobian, matrices.n_jacobian), reals(at_v, matrices.n), reals(at_b, matrices.n)
    for j in range(matrices.n):
        if v[j] != 0.0:
            for p in range(starts[j], starts[j + 1]):
                b[rows[p]] += sign * values[p] * v[j]


@compiled
def add_slopes_times(matrices, at_v, at_b):
    """Add to b what J v has of the differential unknowns."""
    starts = indices(matrices.at_jacobian_starts, matrices.n + 1)
    rows = indices(matrices.at_jacobian_rows, matrices.n_jacobian)
    values, v, b = reals(matrices.at_jacobian, matrices.n_jacobian), reals(at_v, matrices.n), reals(at_b, matrices.n)
    differential = indices(matrices.at_differential, matrices.n)
    for j in range(matrices.n):
        if differential[j] == 1:
            for p in range(starts[j], starts[j + 1]):
                b[rows[p]] += values[p] * v[j]


@compiled
def sizes_through_jacobian(matrices, at_v, at_b):
    """Set b = |J| v, for a v that has no negative entries: how far J v may be rounded."""
    starts = indices(matrices.at_jacobian_starts, matrices.n + 1)
    rows = indices(matrices.at_jacobian_rows, matrices.n_jacobian)
    values, v, b = reals(matrices.at_jacobian, matrices.n_jacobian), reals(at_v, matrices.n), reals(at_b, matrices.n)
    b[:] = 0.0
    for j in range(matrices.n):
        if v[j] != 0.0:
            for p in range(starts[j], starts[j + 1]):
                b[rows[p]] += abs(values[p]) * v[j]


@compiled
def inertia_of(matrices, k):
    """The entry of M on the diagonal of column k."""
    starts, rows = indices(matrices.at_mass_starts, matrices.n + 1), indices(matrices.at_mass_rows, matrices.n_mass)
    mass, found = reals(matrices.at_mass, matrices.n_mass), 1.0
    for p in range(starts[k], starts[k + 1]):
        if rows[p] == k:
            found = mass[p]
    return found
