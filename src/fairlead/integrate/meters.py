"""Quadratures, as the energy ledger, of steps in which the method does them badly: once more, from the states.

In a method with stages a quadrature follows a stiff unknown no better than the stages do, and its dense output
worse: where a bound contact had crept for a tenth of a second and then broke away, it was off by a hundred times
what had passed meanwhile. The method knows: its own error estimate of the quadrature is large then. Nothing
depends on a quadrature, so it may as well be had from the states at the end of the accepted piece,

    q(t_piece) = q(t0) + piece * sum_k w_k f_q(t_k, y(t_k))

by the rule of Lobatto with four nodes (order 6). Elsewhere the stages do better than the interpolant.
"""

from __future__ import annotations

from fairlead.integrate.foreign import compiled, field_at, indices, reals
from fairlead.integrate.interpolant import interpolate

OFF = 0.3
"""In weights. At a thousandth, runs of all kinds lost digits to the interpolant; here those with creep alone change."""
LITTLE = 0.01
"""What has passed, in the unit of the quadrature, below which the error is no longer measured by it."""
INNER = 5.0**-0.5


@compiled
def meter_piece(m, h):
    """Write the quadratures at the end of the piece [t, t + theta h] into `y_piece`, and follow it inside.

    Inside the piece the dense output becomes the cubic with the values and the slopes of both its ends.
    """
    n, theta = m.n, m.theta
    quadrature = indices(m.at_quadrature, n)
    y, piece, y_end, f = reals(m.at_y, n), reals(m.at_y_piece, n), reals(m.at_y_end, n), reals(m.at_f, n)
    first, last, D = reals(m.at_u, n), reals(m.at_v, n), reals(m.at_D, 3 * n)
    for k in range(n):
        if quadrature[k] == 1:
            piece[k] = y[k]
    for node in range(4):
        place, weight = node_of(node)
        interpolate(m, place * theta, m.at_y_probe)
        field_at(m.call_rhs, (m.context, m.t + place * theta * h, m.at_y_probe, m.at_f))
        m.rhs += 1
        for k in range(n):
            if quadrature[k] == 1:
                last[k] = theta * h * f[k] / inertia_of(m, k)
                piece[k] += weight * last[k]
                if node == 0:
                    first[k] = last[k]
    for k in range(n):
        if quadrature[k] == 1:
            change = piece[k] - y[k]
            a = first[k] / theta
            b = (3.0 * change - 2.0 * first[k] - last[k]) / theta**2
            c = (first[k] + last[k] - 2.0 * change) / theta**3
            y_end[k] = y[k] + a + b + c
            D[k], D[n + k], D[2 * n + k] = -b - c, -c, 0.0


@compiled
def judge_meters(m):
    """Set `meters_off` if the method itself finds a quadrature wrong by OFF, of what has passed, in this step."""
    error, quadrature, weight = reals(m.at_error_vector, m.n), indices(m.at_quadrature, m.n), reals(m.at_weight, m.n)
    y = reals(m.at_y_end, m.n)
    m.meters_off = 0
    for k in range(m.n):
        if quadrature[k] == 1 and abs(error[k]) > OFF * weight[k] * max(LITTLE, abs(y[k])):
            m.meters_off = 1


@compiled
def inertia_of(m, k):
    """The entry of M on the diagonal of column k."""
    starts, rows = indices(m.at_mass_starts, m.n + 1), indices(m.at_mass_rows, m.n_mass)
    mass, found = reals(m.at_mass, m.n_mass), 1.0
    for p in range(starts[k], starts[k + 1]):
        if rows[p] == k:
            found = mass[p]
    return found


@compiled
def node_of(node):
    """Place on [0, 1] and weight of a node of the rule."""
    at = (-1.0, -INNER, INNER, 1.0)[node]
    weight = (1.0 / 12.0, 5.0 / 12.0, 5.0 / 12.0, 1.0 / 12.0)[node]
    return 0.5 * (1.0 + at), weight
