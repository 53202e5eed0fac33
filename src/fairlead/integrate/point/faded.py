"""The error of speeds whose law fades within a step, as the bond of a line that leaves a drum.

W is of the start of the step. A bond that falls from 1e9 N s/m to 1e4 in a step takes its node along with moves that
are 1e5 times too small, in all stages alike: so their difference, the error estimate, sees nothing, and the node is
left behind by all that its slip should have grown. At the end of the step the law itself tells: the residual r of the
speed, r' after the move that W gives for it, and r - r', which that move changed,

    left behind    move r/(r - r')        where that is more than FURTHEST moves; else W tells as well

Asked are speeds that follow a law within the step which has changed since the last one, or may have as zones changed.
Of those with a weight of their own, as of contacts that creep, the defect tells (defect.py).
"""

from __future__ import annotations

from fairlead.integrate.linear.products import add_mass_times
from fairlead.integrate.linear.systems import solve
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.point.controller import weighted_norm
from fairlead.integrate.point.stiff import FURTHEST, follows_within

CHANGED = 1e-3
"""Share of a slope by which it must have changed since the last step to be asked about."""
NONE_LEFT = 1e-9
"""Share of a residual that a move must change to tell anything: a law that is less stiff than this is none."""


@compiled
def error_of_faded(m, h):
    """Largest error, in weights, of speeds whose law has faded by the end of the step; 0 where none has."""
    problem, point, linear = m.problem, m.point, m.linear
    n = problem.n
    if not ask_faded(m, h):
        return 0.0
    asked, error = indices(m.method.at_fades, n), reals(point.at_error_vector, n)
    y, y_end, D = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_D, 3 * n)
    moved, minus_rate, left = reals(point.at_u, n), reals(point.at_v, n), reals(point.at_x, n)
    before = reals(point.at_y_probe, n)
    for k in range(n):
        minus_rate[k] = -(y_end[k] - y[k] - D[k] - D[n + k] - D[2 * n + k]) / h
    find_left(m, h, point.at_y_end)
    copy(left, error)
    copy(left, before)
    solve(linear, point.at_error_vector)
    for k in range(n):
        error[k] = error[k] if asked[k] == 1 else 0.0
        moved[k] = y_end[k] + error[k]
    if weighted_norm(point, point.at_error_vector) <= NONE_LEFT:
        return 0.0
    for k in range(n):
        minus_rate[k] -= linear.factors.mass_factor * error[k]
    find_left(m, h, point.at_u)
    for k in range(n):
        done = before[k] - left[k]
        faded = before[k] * done > 0.0 and abs(before[k]) > FURTHEST * abs(done)
        tells = abs(done) > NONE_LEFT * abs(before[k])
        error[k] = error[k] * before[k] / done if asked[k] == 1 and faded and tells else 0.0
    return weighted_norm(point, point.at_error_vector)


@compiled
def find_left(m, h, at_y):
    """Set x = f - M y' at the end of the step, with -y' in v and unknowns in y."""
    problem, point = m.problem, m.point
    field_at(problem.call_rhs, (problem.context, point.t + h, at_y, point.at_f))
    problem.rhs += 1
    copy(reals(point.at_f, problem.n), reals(point.at_x, problem.n))
    add_mass_times(m.linear.matrices, point.at_v, point.at_x)


@compiled
def ask_faded(m, h):
    """Mark the speeds to ask about; True if there is any."""
    problem, method, matrices = m.problem, m.method, m.linear.matrices
    n, found = problem.n, False
    asked, monitored = indices(method.at_fades, n), indices(method.at_monitored, n)
    seen = reals(method.at_slope_seen, n)
    position, place = indices(problem.at_position_of, n), indices(matrices.at_diagonal_slope, n)
    slopes, switched = reals(matrices.at_jacobian, matrices.n_jacobian), m.events.settling.t_last_switch == m.point.t
    for k in range(n):
        asked[k] = 0
        if position[k] >= 0 and monitored[k] == 0 and follows_within(matrices, k, h):
            now = slopes[place[k]]
            if switched or abs(now - seen[k]) > CHANGED * abs(now):
                asked[k] = 1
                found = True
    return found


@compiled
def remember_slopes(method, matrices):
    """Keep the slopes of speeds by themselves, of the J that is to be replaced."""
    n = matrices.n
    seen, place = reals(method.at_slope_seen, n), indices(matrices.at_diagonal_slope, n)
    slopes = reals(matrices.at_jacobian, matrices.n_jacobian)
    for k in range(n):
        if place[k] >= 0:
            seen[k] = slopes[place[k]]
