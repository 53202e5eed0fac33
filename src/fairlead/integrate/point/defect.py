"""How far the dense output of a step is off the equations, through the factors of W."""

from __future__ import annotations

from fairlead.integrate.linear.products import add_mass_times
from fairlead.integrate.linear.systems import solve
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, reals


@compiled
def find_midpoint_defect(problem, point, linear, method, h):
    """Into `error_vector`: how far the dense output of the unknowns monitored is off in the middle of the step.

    A stiffly accurate method meets the algebraic equations at the end of a step of any size, so its
    error estimate says nothing about a multiplier that follows a force in time: without this, a held
    contact under a swinging load would be stepped over. So it is with stiff unknowns, the slip of a bound contact on
    a surface that moves, a bristle that is bent to its end on both sides of a reversal: right where a step ends,
    and anything in between. The residual of the interpolant, r = f - M y', through the factors of W, is the missing
    estimate (as in Rodas5Pr, Steinebach 2024); it behaves as the error of the dense output.
    """
    find_defect(problem, point, linear, h, 0.5)
    error, monitored = reals(point.at_error_vector, point.n), indices(method.at_monitored, point.n)
    for k in range(point.n):
        if monitored[k] == 0:
            error[k] = 0.0


@compiled
def find_defect(problem, point, linear, h, s):
    """Into `error_vector`: r = f - M y' of the dense output at s, through the factors of W."""
    n = problem.n
    y, y_end, D = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_D, 3 * n)
    inside, minus_rate = reals(point.at_u, n), reals(point.at_v, n)
    f, error = reals(point.at_f, n), reals(point.at_error_vector, n)
    both = s * (1.0 - s)
    for k in range(n):
        change = y_end[k] - y[k]
        inner = D[k] + s * (D[n + k] + s * D[2 * n + k])
        inside[k] = y[k] + s * change + both * inner
        minus_rate[k] = -(change + (1.0 - 2.0 * s) * inner + both * (D[n + k] + 2.0 * s * D[2 * n + k])) / h
    field_at(problem.call_rhs, (problem.context, point.t + s * h, point.at_u, point.at_f))
    problem.rhs += 1
    copy(f, error)
    add_mass_times(linear.matrices, point.at_v, point.at_error_vector)
    solve(linear, point.at_error_vector)
