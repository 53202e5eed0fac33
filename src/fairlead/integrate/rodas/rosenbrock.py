"""The method `rodas`: a step of a Rosenbrock method, linear systems only, zones, M and J frozen (the minor step).

    W K_i = f(t + c_i h, y + sum_j a_ij K_j) + M sum_j (C_ij/h) K_j + h d_i f_t,   W = M/(h gamma) - J

See tableau.py for the letters.
"""

from __future__ import annotations

from fairlead.integrate.codes import DONE
from fairlead.integrate.linear.products import add_mass_times
from fairlead.integrate.linear.systems import factorise_step, solve, solve_checked
from fairlead.integrate.loop import method_of
from fairlead.integrate.memory.foreign import compiled, copy, field_at, jacobian_at, reals
from fairlead.integrate.one_step import OneStep
from fairlead.integrate.point.faded import remember_slopes

CHUNK = 512
"""Unknowns combined at a time, so that sums over the stages stay in the nearest cache."""


@compiled
def linearise(problem, point, linear, method):
    """J and f_t at the point, once for all steps tried from it."""
    matrices = linear.matrices
    if matrices.jacobian_fresh == 0:
        remember_slopes(method, matrices)
        jacobian_at(problem.call_jacobian, (problem.context, point.t, point.at_y, matrices.at_jacobian, point.at_ft))
        problem.jacobians += 1
        matrices.jacobian_fresh = 1
        linear.factors.factored_h = 0.0


@compiled
def prepare_matrix(linear, method, h):
    """Factorise W for the step size h, unless it is already; DONE, SINGULAR or INACCURATE."""
    factors = linear.factors
    if factors.factored_h == h:
        return DONE
    factors.factored_h = 0.0
    status = factorise_step(linear, 1.0 / (h * method.gamma))
    if status == DONE:
        factors.factored_h = h
    return status


@compiled
def take_step(m, h):
    """Compute the stages K, the trial end `y_end` and the error estimate; DONE or why the matrix fails."""
    problem, point, linear, factors, method = m.problem, m.point, m.linear, m.linear.factors, m.method
    n = point.n
    linearise(problem, point, linear, method)
    unchecked = factors.factored_h != h
    status = prepare_matrix(linear, method, h)
    if status != DONE:
        return status
    K = reals(method.at_K, method.stages * n)
    for i in range(method.stages):
        stage_right_side(problem, point, m.linear.matrices, method, h, i)
        copy(reals(point.at_b, n), K[i * n : (i + 1) * n])
        if i == 0 and unchecked:
            status = solve_checked(linear, method.at_K)
            if status != DONE:
                factors.factored_h = 0.0
                return status
        else:
            solve(linear, method.at_K + 8 * i * n)
    combine(point, method)
    return DONE


@compiled
def stage_right_side(problem, point, matrices, method, h, i):
    """Set b = f(t + c_i h, y + sum_j a_ij K_j) + h d_i f_t + M sum_j (C_ij/h) K_j."""
    n, stages = problem.n, method.stages
    y, u, v, f = reals(point.at_y, n), reals(point.at_u, n), reals(point.at_v, n), reals(point.at_f, n)
    K, ft, b = reals(method.at_K, stages * n), reals(point.at_ft, n), reals(point.at_b, n)
    a, C = reals(method.at_a, stages * stages), reals(method.at_C, stages * stages)
    c, d = reals(method.at_c, stages), reals(method.at_d, stages)
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
        field_at(problem.call_rhs, (problem.context, point.t + c[i] * h, point.at_u, point.at_f))
        problem.rhs += 1
    slope_weight = h * d[i]
    for k in range(n):
        b[k] = f[k] + slope_weight * ft[k]
    if i > 0:
        add_mass_times(matrices, point.at_v, point.at_b)


@compiled
def combine(point, method):
    """y_end = y + sum_i m_i K_i and error_vector = sum_i e_i K_i."""
    n, stages = point.n, method.stages
    y, y_end, error = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_error_vector, n)
    K, weights, differences = reals(method.at_K, stages * n), reals(method.at_m, stages), reals(method.at_e, stages)
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
    point, method = m.point, m.method
    n, stages = point.n, method.stages
    D, K, H = reals(point.at_D, 3 * n), reals(method.at_K, stages * n), reals(method.at_H, 3 * stages)
    for r in range(3):
        D[r * n : (r + 1) * n] = 0.0
        for i in range(stages):
            factor = H[r * stages + i]
            if factor != 0.0:
                for k in range(n):
                    D[r * n + k] += factor * K[i * n + k]


METHOD = method_of(OneStep(take_step, prepare_interpolant))
