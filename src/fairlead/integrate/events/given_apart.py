"""Rigid rows of a circle that cannot all hold: what they hold a body to is given, and moves apart.

    C v = speeds of what is given        has no solution where these differ

Two freewheels drive one shaft, and the second motor overtakes the first. What held rows of a circle share (the problem
says how) is the least sum of squares; so is what contradicts them: the body moves at a mean of the speeds, and every
row slips. The forces do not tell that at once, since the accelerations differ by little, or by nothing yet.

So the slip of such rows is part of the error of a step, and is looked at where one ends. Where it is more than an error
the zones settle there, as in an impact: with the impulses that would take the slip away, though they change no speed,
who would have to pull opens (impulse.py). Where none would, as where a body falls on a floor and on a lifter that rises
past it, all push, and the body is thrown faster than some of them follow: who is left behind most opens. Where nobody
can, the run ends and names a row. Friction needs none of this: it lets go by a guard on its slip.
"""

from __future__ import annotations

from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.events.impulse_load import SHORT, UNLIMITED
from fairlead.integrate.memory.foreign import compiled, indices, reals, slip_at

LEAST_APART = 2.0
"""Slip in error weights from which on rows contradict each other; less is the error of a step."""
AS_MUCH = 1e-9
"""Share by which the slips of two that are left behind may differ and still be one."""
MOST_APART = 4.0
"""Slip in error weights with which a step may end: its error is one then."""


@compiled
def slip_of_given(problem, point, matrices, t, at_y):
    """The largest slip of a rigid row of a circle at (t, y), in weights of the speeds it joins; its row in `worst`."""
    n, largest = problem.n, 0.0
    slip_at(problem.call_slip, (problem.context, t, at_y, point.at_x))
    slip, weight = reals(point.at_x, n), reals(point.at_weight, n)
    takes, circle = indices(problem.at_takes_impulse, n), indices(problem.at_circle, n)
    speed_of = indices(problem.at_speed_of, n)
    starts, rows = indices(matrices.at_jacobian_starts, n + 1), indices(matrices.at_jacobian_rows, matrices.n_jacobian)
    values, differential = reals(matrices.at_jacobian, matrices.n_jacobian), indices(problem.at_differential, n)
    for k in range(n):
        if takes[k] < UNLIMITED or circle[k] == 0 or slip[k] == 0.0:
            continue
        allowed = 0.0
        for p in range(starts[k], starts[k + 1]):
            v = speed_of[rows[p]]
            if differential[v] == 1:
                allowed += abs(values[p]) * weight[v]
        if allowed > 0.0 and abs(slip[k]) > largest * allowed:
            largest = abs(slip[k]) / allowed
            point.worst = k
    return largest


@compiled
def moves_apart(problem, point, linear):
    """True if rigid rows contradict each other at the point."""
    if problem.rigid_circles == 0:
        return False
    return slip_of_given(problem, point, linear.matrices, point.t, point.at_y) > LEAST_APART


@compiled
def judge_given(m, h):
    """Let the slip of such rows at the end of the trial step count as its error."""
    if m.problem.rigid_circles == 1 and m.run.adaptive == 1:
        worst = m.point.worst
        slip = slip_of_given(m.problem, m.point, m.linear.matrices, m.point.t + h, m.point.at_y_end)
        if slip / MOST_APART > m.run.error:
            m.run.error = slip / MOST_APART
        else:
            m.point.worst = worst


@compiled
def leave_behind(m):
    """True with the guards in `fired` of those rows that the impulse in b leaves behind most, with the change in u.

    They closed before and part after it: to keep up, they would have to pull.
    """
    problem, point, guards = m.problem, m.point, m.events.guards
    n, ng = problem.n, problem.n_guards
    y, dv, b = reals(point.at_y, n), reals(point.at_u, n), reals(point.at_b, n)
    after, parting, slip = reals(point.at_y_probe, n), reals(point.at_x, n), reals(point.at_f, n)
    takes, circle = indices(problem.at_takes_impulse, n), indices(problem.at_circle, n)
    for k in range(n):
        after[k] = y[k] + dv[k]
    slip_at(problem.call_slip, (problem.context, point.t, point.at_y, point.at_f))
    slip_at(problem.call_slip, (problem.context, point.t, point.at_y_probe, point.at_x))
    most = 0.0
    for k in range(n):
        rigid = takes[k] >= UNLIMITED and circle[k] > 0
        slip[k] = abs(parting[k]) if rigid and slip[k] * parting[k] < 0.0 else 0.0
        most = max(most, slip[k])
    for k in range(n):
        left = most > 0.0 and slip[k] >= (1.0 - AS_MUCH) * most
        parting[k] = -b[k] / (SHORT * m.events.settling.own_time) if left else after[k]
    evaluate_guards(problem, m.run, guards, point.t, point.at_y_probe, guards.at_g_probe)
    evaluate_guards(problem, m.run, guards, point.t, point.at_x, guards.at_g)
    under, g = reals(guards.at_g_probe, ng), reals(guards.at_g, ng)
    tolerance, may_hold = reals(guards.at_guard_tolerance, ng), indices(problem.at_may_hold, ng)
    fired = indices(guards.at_fired, ng)
    guards.n_fired = 0
    for i in range(ng):
        if may_hold[i] == UNLIMITED and g[i] > tolerance[i] >= under[i]:
            fired[guards.n_fired] = i
            guards.n_fired += 1
    return guards.n_fired > 0
