"""A method of another kind, for the tests: BDF of order two with variable steps, in one file.

    M (a0 y1 + a1 y0 + a2 y_-1)/h = f(t1, y1),   w = h/h_-1,
    a0 = (1 + 2w)/(1 + w),  a1 = -(1 + w),  a2 = w^2/(1 + w)      (Hairer, Norsett, Wanner I, III.5)

by Newton's iteration with W = a0 M/h - J; the first step after a settlement is implicit Euler's. The error is Milne's:
what is predicted by the polynomial through earlier points, less y1, in the share of the two error constants.
"""

from __future__ import annotations

from fairlead.integrate.codes import DONE
from fairlead.integrate.engine import Engine
from fairlead.integrate.events.arrival import arrive
from fairlead.integrate.linear.products import add_mass_times
from fairlead.integrate.linear.systems import factorise_step, solve, solve_checked
from fairlead.integrate.loop import Method
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, jacobian_at, reals
from fairlead.integrate.one_step import OneStep, trial_of

ITERATIONS, CONVERGED = 6, 1e-3
"""Iterations of Newton at most; the move, in error weights, after which there is none."""

# What it keeps of earlier steps, in the room that a method has for stages: y_-1, y_-2, and y while the point moves on;
# at its end h_-1, h_-2, and how many steps there are since a settlement.
EARLIER, BEFORE_THAT, LEFT = 0, 1, 2
H1, H2, KNOWN = -3, -2, -1


@compiled
def take(m, h):
    """One step from the point."""
    problem, point, linear, method = m.problem, m.point, m.linear, m.method
    n, K = point.n, reals(method.at_K, method.stages * point.n)
    end = method.stages * n
    h1, known = K[end + H1], K[end + KNOWN]
    w = h / h1 if known > 0.0 else 0.0
    a0, a2 = (1.0 + 2.0 * w) / (1.0 + w), w * w / (1.0 + w)
    J = linear.matrices.at_jacobian
    jacobian_at(problem.call_jacobian, (problem.context, point.t + h, point.at_y, J, point.at_ft))
    problem.jacobians += 1
    status = factorise_step(linear, a0 / h)
    linear.factors.factored_h = 0.0
    y, y_end, b, v = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_b, n), reals(point.at_v, n)
    weight = reals(point.at_weight, n)
    absolute, relative = reals(point.at_absolute, n), reals(point.at_relative, n)
    copy(y, y_end)
    for k in range(n):
        weight[k] = absolute[k] + relative[k] * abs(y[k])
    for i in range(ITERATIONS):
        if status != DONE:
            return status
        field_at(problem.call_rhs, (problem.context, point.t + h, point.at_y_end, point.at_b))
        problem.rhs += 1
        for k in range(n):
            v[k] = a0 * (y[k] - y_end[k]) / h
            if w > 0.0:
                v[k] += a2 * (y[k] - K[EARLIER * n + k]) / h
        add_mass_times(linear.matrices, point.at_v, point.at_b)
        if i == 0:
            status = solve_checked(linear, point.at_b)
        else:
            solve(linear, point.at_b)
        moved = 0.0
        for k in range(n):
            y_end[k] += b[k]
            moved = max(moved, abs(b[k]) / weight[k])
        if moved <= CONVERGED:
            break
    estimate(point, method, h, a0)
    return status


@compiled
def estimate(point, method, h, a0):
    """Into `error_vector`: y1 less what earlier points predict, in the share of this method's error in that."""
    n, K = point.n, reals(method.at_K, method.stages * point.n)
    end = method.stages * n
    h1, h2, known = K[end + H1], K[end + H2], K[end + KNOWN]
    y, y_end, slope = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_slope, n)
    error, differential = reals(point.at_error_vector, n), indices(point.at_differential, n)
    for k in range(n):
        first = (y[k] - K[EARLIER * n + k]) / h1 if known > 0.0 else slope[k]
        predicted, share = y[k] + h * first, 0.5 if known == 0.0 else h / (h + h1)
        if known > 1.0:
            bend = (first - (K[EARLIER * n + k] - K[BEFORE_THAT * n + k]) / h2) / (h1 + h2)
            predicted += h * (h + h1) * bend
            share = h / (a0 * (h + h1 + h2))
        error[k] = share * (y_end[k] - predicted) if differential[k] == 1 else 0.0


@compiled
def prepare_interpolant(m, h):
    """The parabola through the point before, the point and the end; after a settlement, with the slope of the point."""
    point, method = m.point, m.method
    n, K, D = point.n, reals(method.at_K, method.stages * point.n), reals(point.at_D, 3 * point.n)
    y, y_end, slope = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_slope, n)
    differential, end = indices(point.at_differential, n), method.stages * n
    h1, known = K[end + H1], K[end + KNOWN]
    for k in range(n):
        change, bend = (y_end[k] - y[k]) / h, 0.0
        if known > 0.0:
            bend = (change - (y[k] - K[EARLIER * n + k]) / h1) / (h + h1)
        elif differential[k] == 1:
            bend = (change - slope[k]) / h
        D[k], D[n + k], D[2 * n + k] = -h * h * bend, 0.0, 0.0


@compiled
def arrive_and_remember(m):
    """Arrive at the end of the piece; the point left becomes the one before."""
    run, point, method = m.run, m.point, m.method
    n, K = point.n, reals(method.at_K, method.stages * point.n)
    left = run.t_piece - point.t
    if left > 0.0:
        for k in range(n):
            K[LEFT * n + k] = reals(point.at_y, n)[k]
    status = arrive(m, True)
    if left > 0.0 and point.t == run.t_piece:
        for k in range(n):
            K[BEFORE_THAT * n + k] = K[EARLIER * n + k]
            K[EARLIER * n + k] = K[LEFT * n + k]
        end = method.stages * n
        K[end + H2], K[end + H1] = K[end + H1], left
        K[end + KNOWN] = min(K[end + KNOWN] + 1.0, 2.0)
    return status


@compiled
def forget(m):
    """After a settlement no earlier point lies on the same smooth motion."""
    end = m.method.stages * m.point.n
    reals(m.method.at_K, end)[end + KNOWN] = 0.0


METHOD = Method(trial_of(OneStep(take, prepare_interpolant)), arrive_and_remember, forget)
BDF2 = Engine("bdf2", __name__, (__file__,), lambda run, problem: {"error_exponent": 1.0 / 3.0})
