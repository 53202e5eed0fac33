"""Pivots that vanish are perturbed, and what that does to the solution is taken away again.

Pivots are planned once for all zones. Now and then, mostly in patterns of zones that the active set only tries, one
vanishes though the matrix A is regular. Other pivots for that matrix would fail for the next pattern (a run of a
line in a clamp went back and forth between two plans, in ever shorter steps). So a pivot k that is not to be trusted
is made as large as its column, by d_k; what is factorised is B = A + E D E^T, E the unit vectors of these k, and

    A x = b        x = B^-1 b + Z w        Z = B^-1 E        (I - D E^T Z) w = D E^T B^-1 b

(Sherman-Morrison-Woodbury; Hager, SIAM Review 31:221, 1989). Each takes one more substitution a factorisation. With
perturbations that large B is no worse conditioned than A by design; small ones, as in static pivoting
(Li, Demmel, ACM TOMS 29:110, 2003), would need refinement in every solve.
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import DONE, INACCURATE
from fairlead.integrate.linear.sparse import factorise_planned, substitute_planned
from fairlead.integrate.memory.foreign import compiled, indices, reals

SINGULAR_BELOW = 1e-13
"""A pivot of I - D E^T Z, whose numbers are of order one, that means a singular matrix."""


@compiled
def factorise_columns(factors):
    """Refactorise the columns marked `dirty`; DONE, or INACCURATE: a pivot is not to be trusted."""
    status = factorise_planned(factors)
    if status == DONE and factors.n_perturbed > 0:
        status = prepare_correction(factors)
    return status


@compiled
def substitute(factors, at_x):
    """Overwrite the right side at `at_x`, in pivot order, with the solution."""
    substitute_planned(factors, at_x)
    if factors.n_perturbed > 0:
        correct(factors, at_x)


@compiled
def prepare_correction(factors):
    """Z, and the factors of I - D E^T Z, rows in units of their scale; DONE, or INACCURATE if A is singular."""
    n, count = factors.n_reduced, 0
    added, place = reals(factors.at_perturbation, n), indices(factors.at_perturbed, factors.most_perturbed)
    for k in range(n):
        if added[k] != 0.0:
            place[count] = k
            count += 1
    scale, z = reals(factors.at_row_scale, n), reals(factors.at_perturbed_columns, factors.most_perturbed * n)
    c = reals(factors.at_capacitance, factors.most_perturbed * factors.most_perturbed)
    for j in range(count):
        for k in range(n):
            z[j * n + k] = 0.0
        z[j * n + place[j]] = 1.0
        substitute_planned(factors, factors.at_perturbed_columns + 8 * j * n)
        for i in range(count):
            p = place[i]
            share = -added[p] * z[j * n + p] * scale[p] / scale[place[j]]
            c[i * count + j] = share + (1.0 if i == j else 0.0)
    return eliminate(factors, c, count)


@compiled
def eliminate(factors, c, count):
    """LU with partial pivoting of the full `count` by `count` matrix c in place, by rows."""
    order = indices(factors.at_capacitance_order, factors.most_perturbed)
    place = indices(factors.at_perturbed, factors.most_perturbed)
    for k in range(count):
        row = k
        for i in range(k + 1, count):
            if abs(c[i * count + k]) > abs(c[row * count + k]):
                row = i
        order[k] = row
        for j in range(count):
            c[k * count + j], c[row * count + j] = c[row * count + j], c[k * count + j]
        pivot = c[k * count + k]
        if not (isfinite(pivot) and abs(pivot) > SINGULAR_BELOW):
            factors.culprit = indices(factors.at_column_order, factors.n_reduced)[place[k]]
            return INACCURATE
        for i in range(k + 1, count):
            c[i * count + k] /= pivot
            for j in range(k + 1, count):
                c[i * count + j] -= c[i * count + k] * c[k * count + j]
    return DONE


@compiled
def correct(factors, at_x):
    """Turn B^-1 b at `at_x` into A^-1 b."""
    n, count = factors.n_reduced, factors.n_perturbed
    x, z = reals(at_x, n), reals(factors.at_perturbed_columns, factors.most_perturbed * n)
    scale, added = reals(factors.at_row_scale, n), reals(factors.at_perturbation, n)
    order = indices(factors.at_capacitance_order, factors.most_perturbed)
    place = indices(factors.at_perturbed, factors.most_perturbed)
    c = reals(factors.at_capacitance, factors.most_perturbed * factors.most_perturbed)
    w = reals(factors.at_handed, factors.most_perturbed)
    for i in range(count):
        w[i] = scale[place[i]] * added[place[i]] * x[place[i]]
    for k in range(count):
        w[k], w[order[k]] = w[order[k]], w[k]
    for i in range(count):
        for j in range(i):
            w[i] -= c[i * count + j] * w[j]
    for i in range(count - 1, -1, -1):
        for j in range(i + 1, count):
            w[i] -= c[i * count + j] * w[j]
        w[i] /= c[i * count + i]
    for j in range(count):
        share = w[j] / scale[place[j]]
        if share != 0.0:
            for k in range(n):
                x[k] += share * z[j * n + k]
