"""The method `rodas`: a step of a Rosenbrock method, linear systems only, zones, M and J frozen (the minor step).

    W K_i = f(t + c_i h, y + sum_j a_ij K_j) + M sum_j (C_ij/h) K_j + h d_i f_t,   W = M/(h gamma) - J

See tableau.py for the letters.
"""

from __future__ import annotations

from fairlead.integrate.foreign import compiled, copy, field_at, jacobian_at, reals
from fairlead.integrate.linear import DONE, add_mass_times, factorise_step, solve, solve_watched
from fairlead.integrate.loop import method_of
from fairlead.integrate.one_step import OneStep

CHUNK = 512
"""Unknowns combined at a time, so that sums over the stages stay in the nearest cache."""


@compiled
def linearise(m):
    """J and f_t at the point, once for all steps tried from it."""
    if m.jacobian_fresh == 0:
        jacobian_at(m.call_jacobian, (m.context, m.t, m.at_y, m.at_jacobian, m.at_ft))
        m.jacobians += 1
        m.jacobian_fresh = 1
        m.factored_h = 0.0


@compiled
def prepare_matrix(m, h):
    """Factorise W for the step size h, unless it is already; DONE, SINGULAR or INACCURATE."""
    if m.factored_h == h:
        return DONE
    m.factored_h = 0.0
    status = factorise_step(m, 1.0 / (h * m.gamma))
    if status == DONE:
        m.factored_h = h
    return status


@compiled
def take_step(m, h):
    """Compute the stages K, the trial end `y_end` and the error estimate; DONE or why the matrix fails."""
    n = m.n
    linearise(m)
    unchecked = m.factored_h != h
    status = prepare_matrix(m, h)
    if status != DONE:
        return status
    K = reals(m.at_K, m.stages * n)
    for i in range(m.stages):
        stage_right_side(m, h, i)
        copy(reals(m.at_b, n), K[i * n : (i + 1) * n])
        if i == 0 and unchecked:
            status = solve_watched(m, m.at_K)
            if status != DONE:
                m.factored_h = 0.0
                return status
        else:
            solve(m, m.at_K + 8 * i * n)
    combine(m)
    return DONE


@compiled
def stage_right_side(m, h, i):
    """Set b = f(t + c_i h, y + sum_j a_ij K_j) + h d_i f_t + M sum_j (C_ij/h) K_j."""
    n, stages = m.n, m.stages
    y, u, v, f = reals(m.at_y, n), reals(m.at_u, n), reals(m.at_v, n), reals(m.at_f, n)
    K, ft, b = reals(m.at_K, stages * n), reals(m.at_ft, n), reals(m.at_b, n)
    a, C = reals(m.at_a, stages * stages), reals(m.at_C, stages * stages)
    c, d = reals(m.at_c, stages), reals(m.at_d, stages)
    moved = i == 0 or c[i] != c[i - 1]
    for j in range(i):
        moved = moved or a[i * stages + j] != a[(i - 1) * stages + j]
    for begin in range(0, n, CHUNK):
        end = min(begin + CHUNK, n)
        u_part, v_part, y_part = u[begin:end], v[begin:end], y[begin:end]
        for k in range(end - begin):
            u_part[k] = y_part[k]
            v_part[k] = 0.0
        for j in range(i):
            a_ij, C_ij = a[i * stages + j], C[i * stages + j] / h
            K_j = K[j * n + begin : j * n + end]
            for k in range(end - begin):
                u_part[k] += a_ij * K_j[k]
                v_part[k] += C_ij * K_j[k]
    if moved:
        field_at(m.call_rhs, (m.context, m.t + c[i] * h, m.at_u, m.at_f))
        m.rhs += 1
    slope_weight = h * d[i]
    for k in range(n):
        b[k] = f[k] + slope_weight * ft[k]
    if i > 0:
        add_mass_times(m, m.at_v, m.at_b)


@compiled
def combine(m):
    """y_end = y + sum_i m_i K_i and error_vector = sum_i e_i K_i."""
    n, stages = m.n, m.stages
    y, y_end, error = reals(m.at_y, n), reals(m.at_y_end, n), reals(m.at_error_vector, n)
    K, weights, differences = reals(m.at_K, stages * n), reals(m.at_m, stages), reals(m.at_e, stages)
    for k in range(n):
        y_end[k] = y[k]
        error[k] = 0.0
    for i in range(stages):
        for k in range(n):
            y_end[k] += weights[i] * K[i * n + k]
        if differences[i] != 0.0:
            for k in range(n):
                error[k] += differences[i] * K[i * n + k]


@compiled
def prepare_interpolant(m, h):
    """D_r = sum_i H_ri K_i, once for an accepted step."""
    n, stages = m.n, m.stages
    D, K, H = reals(m.at_D, 3 * n), reals(m.at_K, stages * n), reals(m.at_H, 3 * stages)
    for r in range(3):
        D[r * n : (r + 1) * n] = 0.0
        for i in range(stages):
            factor = H[r * stages + i]
            if factor != 0.0:
                for k in range(n):
                    D[r * n + k] += factor * K[i * n + k]


METHOD = method_of(OneStep(take_step, prepare_interpolant))
