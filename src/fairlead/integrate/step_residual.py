"""The residual of a step (the equations are in theta_step.py), its size, and the move a solution stands for."""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.codes import MIDDLE
from fairlead.integrate.foreign import compiled, field_at, indices, reals
from fairlead.integrate.linear import add_mass_times

PASSED = 1e-3
"""A residual below this, each row over its largest entry in error weights, is solved."""


@compiled
def theta_point(m):
    """Into `u`: where the laws are evaluated."""
    y, y_end, u = reals(m.at_y, m.n), reals(m.at_y_end, m.n), reals(m.at_u, m.n)
    differential, theta = indices(m.at_differential, m.n), m.theta_now
    for k in range(m.n):
        u[k] = y[k] + theta * (y_end[k] - y[k]) if differential[k] == 1 else y_end[k]


@compiled
def residual_of_step(m, h, may_be_last):
    """Set b = f - M (y1 - y0)/h, and -slip/h at the end of the step in the rows of held contacts.

    What M (y1 - y0)/h says there is just that for a contact that held at the start, on a surface of constant
    speed. For one caught in the step, or on a surface that is accelerated, the law tells the slip; on a node without
    mass it tells that at the theta point, where the speed of such a node is.
    """
    n = m.n
    theta_point(m)
    if may_be_last and m.n_quadratures > 0 and m.theta_now != MIDDLE:
        field_at(m.call_rhs, (m.context, m.t + m.theta_now * h, m.at_u, m.at_f))
    else:
        field_at(m.call_forces, (m.context, m.t + m.theta_now * h, m.at_u, m.at_f))
    m.rhs += 1
    y, y_end, v, b, f = reals(m.at_y, n), reals(m.at_y_end, n), reals(m.at_v, n), reals(m.at_b, n), reals(m.at_f, n)
    differential, holds = indices(m.at_differential, n), indices(m.at_holds, n)
    backward = -1.0 / h
    for k in range(n):
        v[k] = backward * (y_end[k] - y[k]) if differential[k] == 1 else 0.0
        b[k] = f[k] if holds[k] == 0 else 0.0
    add_mass_times(m, m.at_v, m.at_b)
    row = indices(m.at_hold_mass_row, m.n_hold_mass)
    caught, slip = indices(m.at_caught, n), reals(m.at_residual, n)
    if m.newly_held == 1 or m.driven == 1:
        field_at(m.call_drift, (m.context, m.t + h, m.at_y_end, m.at_residual))
        for e in range(m.n_hold_mass):
            if holds[row[e]] == 1 and (m.driven == 1 or caught[row[e]] == 1):
                b[row[e]] = slip[row[e]] / h
    else:
        for e in range(m.n_hold_mass):
            if holds[row[e]] == 1 and caught[row[e]] == 1:
                b[row[e]] = 0.0
    if m.massless == 1:
        slip_without_mass(m, h)
    entry, row, column = (
        indices(m.at_hold_share, m.n_hold_share), indices(m.at_hold_share_row, m.n_hold_share),
        indices(m.at_hold_share_column, m.n_hold_share),
    )  # fmt: skip
    slopes = reals(m.at_jacobian, m.n_jacobian)
    for e in range(m.n_hold_share):
        if holds[row[e]] == 1:
            b[row[e]] += slopes[entry[e]] * y_end[column[e]]


@compiled
def slip_without_mass(m, h):
    """Set -slip/(theta h) at the theta point in the rows of contacts that hold nodes without mass."""
    row, of_massless = indices(m.at_hold_mass_row, m.n_hold_mass), indices(m.at_of_massless, m.n)
    holds, b, slip = indices(m.at_holds, m.n), reals(m.at_b, m.n), reals(m.at_error_vector, m.n)
    field_at(m.call_drift, (m.context, m.t + m.theta_now * h, m.at_u, m.at_error_vector))
    for e in range(m.n_hold_mass):
        k = row[e]
        if holds[k] == 1 and of_massless[k] == 1:
            b[k] = slip[k] / (m.theta_now * h)


@compiled
def scaled_residual(m):
    """Largest |b_i| over the largest entry of row i in units of the weights; nan if any is. See `worst`."""
    b, scale, quadrature = reals(m.at_b, m.n), reals(m.at_row_scale, m.n), indices(m.at_quadrature, m.n)
    order = indices(m.at_row_order, m.n_core)
    rows = m.n if m.dense == 1 else m.n_core
    largest = 0.0
    for k in range(rows):
        i = k if m.dense == 1 else order[k]
        size = abs(b[i]) * scale[k]
        if not isfinite(size):
            m.worst = i
            return size
        if quadrature[i] == 0 and size > largest:
            largest = size
            m.worst = i
    return largest


@compiled
def move_end(m):
    """Add the solution in b: theta times the change of a differential unknown, the change of a force."""
    b, y_end, differential = reals(m.at_b, m.n), reals(m.at_y_end, m.n), indices(m.at_differential, m.n)
    ahead = 1.0 / m.theta_now
    for k in range(m.n):
        y_end[k] += ahead * b[k] if differential[k] == 1 else b[k]
