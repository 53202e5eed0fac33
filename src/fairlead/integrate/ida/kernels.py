"""What the `ida` engine calls from Python, compiled: residual, linear system, guards, the judgement of a step.

    residual   r = M y' - f(t, y)
    matrix     cj M - J, factorised as `rodas` does it

All take the address of the struct first (memory/arena.py) and work on arrays at the addresses they are given.
"""

from __future__ import annotations

from math import inf

from fairlead.integrate.codes import RECORD, STEP_FLOOR
from fairlead.integrate.events.crossing import INCONSISTENT_START, NONE, find_first_crossing, guards_at
from fairlead.integrate.events.given_up import is_doubtful, settle_inconsistent_start
from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.events.pace import not_finite_here
from fairlead.integrate.linear.products import add_jacobian_times, add_mass_times
from fairlead.integrate.linear.systems import factorise_step, solve
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, jacobian_at, memory_at, reals
from fairlead.integrate.one_step import is_rough
from fairlead.integrate.point.controller import weigh, weighted_norm
from fairlead.integrate.point.interpolant import interpolate
from fairlead.integrate.point.swings import largest_turn


def residual(address, t, at_y, at_rate, at_r):
    """Set r = M y' - f(t, y)."""
    m = memory_at(address)
    problem = m.problem
    field_at(problem.call_rhs, (problem.context, t, at_y, at_r))
    problem.rhs += 1
    r = reals(at_r, problem.n)
    for k in range(problem.n):
        r[k] = -r[k]
    add_mass_times(m.linear.matrices, at_rate, at_r)


def prepare(address, t, at_y, cj):
    """J at (t, y), and the factors of cj M - J; 0, or why they fail (linear/systems.py)."""
    m = memory_at(address)
    problem = m.problem
    jacobian_at(problem.call_jacobian, (problem.context, t, at_y, m.linear.matrices.at_jacobian, m.point.at_ft))
    problem.jacobians += 1
    return factorise_step(m.linear, cj)


def solve_prepared(address, at_b, at_x):
    """Solve (cj M - J) x = b by the factors of `prepare`."""
    m = memory_at(address)
    problem = m.problem
    copy(reals(at_b, problem.n), reals(at_x, problem.n))
    solve(m.linear, at_x)


def multiply(address, cj, at_v, at_product):
    """Set product = (cj M - J) v with the J of `prepare` and this cj."""
    m = memory_at(address)
    matrices = m.linear.matrices
    product = reals(at_product, matrices.n)
    product[:] = 0.0
    add_mass_times(matrices, at_v, at_product)
    for k in range(matrices.n):
        product[k] *= cj
    add_jacobian_times(matrices, -1.0, at_v, at_product)


def guards(address, t, at_y, at_g):
    """Guards at (t, y), as all engines see them."""
    m = memory_at(address)
    evaluate_guards(m.problem, m.run, m.events.guards, t, at_y, at_g)


def judge_step(address, t_end, at_y_end, at_rate_end, at_rooted, n_rooted, floor):
    """Judge the step from the point to (t_end, y_end, y'_end) by the trigger rule; set its piece.

    1 if it is to be taken again, shorter: it is cut at a crossing where it does not satisfy the equations. Else 0.
    `rooted` are guards whose rise through zero at t_end was located by the integrator; what the rules of
    crossing.py see earlier in the step (a double crossing, a guard that begins at zero) comes first. A step of
    `floor` is not taken again. Or it turns an angle too far (swings.py).
    """
    m = memory_at(address)
    problem, run, point, guards = m.problem, m.run, m.point, m.events.guards
    h = t_end - point.t
    run.h = h
    run.landing = 1 if t_end >= run.t_land else 0
    prepare_cubic(point, h, at_y_end, at_rate_end)
    if note_swings(problem, run, point, h) and h > 2.0 * floor:
        return 1
    found = find_first_crossing(m, h)
    if found == INCONSISTENT_START:
        if h > 2.0 * floor and is_doubtful(problem, run, point, m.events):
            return 1
        settle_inconsistent_start(m, 0.0)
        return 0
    if found == NONE and n_rooted > 0:
        copy(indices(at_rooted, n_rooted), indices(guards.at_fired, n_rooted))
        guards.n_fired = n_rooted
        run.cut_at = 1.0
        look_beyond(m, h, run.t_land - t_end)
    crossed = guards.n_fired > 0
    if crossed and h > 2.0 * floor:
        weigh(point, point.at_y_end)
        if is_rough(problem, run, point, guards, m.linear, h):
            run.rejected_switch += 1
            guards.n_fired = 0
            return 1
    accept(run, point, h, crossed)
    copy(reals(at_rate_end, point.n), reals(point.at_slope, point.n))
    return 0


@compiled
def note_swings(problem, run, point, h):
    """Set `swing_step`, how long the step should be for the angles it turns; True if it turns one by twice as much.

    Steps of a multistep method grow without being asked, so the bound on them comes with the next start.
    """
    if problem.n_swings == 0:
        return False
    turn = largest_turn(problem, point, h)
    run.swing_step = h / turn if turn > 0.0 else inf
    return turn > 2.0


@compiled
def look_beyond(m, h, rest):
    """How high the guards that were located at the end of the step h rise after it, into `g_late`.

    Along the parabola through the last half of the step, and for the time `rest` until the next time event: there a
    load may turn, and `g_end` is what it has come to by then. What is at a limit of what holds and goes no further is
    taken out of `fired`: a tie holds. What is within its tolerance of a limit and goes further is put in: of two that
    reach it at once IDA finds one.
    """
    guards, fired = m.events.guards, indices(m.events.guards.at_fired, m.events.guards.n_guards)
    ng = guards.n_guards
    half, near, end = reals(guards.at_g_left, ng), reals(guards.at_g_right, ng), reals(guards.at_g_end, ng)
    height, tolerance = reals(guards.at_g_late, ng), reals(guards.at_guard_tolerance, ng)
    limit = indices(guards.at_limit_guard, ng)
    guards_at(m, 0.5, h, guards.at_g_left)
    guards_at(m, 0.75, h, guards.at_g_right)
    rooted, found = reals(m.events.settling.at_wrong, ng), 0
    for i in range(ng):
        rooted[i] = 0.0
    for k in range(guards.n_fired):
        rooted[fired[k]] = 1.0
    s = max(rest, 0.0) / h
    for i in range(ng):
        if rooted[i] == 0.0 and (limit[i] == 0 or end[i] < -tolerance[i]):
            continue
        slope = (3.0 * end[i] - 4.0 * near[i] + half[i]) / 0.5
        curve = (end[i] - 2.0 * near[i] + half[i]) / 0.0625
        top = min(s, -slope / curve) if curve < 0.0 else s
        height[i] = max(end[i], end[i] + slope * top + 0.5 * curve * top * top)
        end[i] += slope * s + 0.5 * curve * s * s
        if limit[i] == 0 or height[i] > tolerance[i]:
            fired[found] = i
            found += 1
    guards.n_fired = found


@compiled
def prepare_cubic(point, h, at_y_end, at_rate_end):
    """Set `y_end` and the D of interpolant.py for the cubic with these values and rates at both ends."""
    n = point.n
    y, end, D = reals(point.at_y, n), reals(point.at_y_end, n), reals(point.at_D, 3 * n)
    rate, rate_end, given = reals(point.at_slope, n), reals(at_rate_end, n), reals(at_y_end, n)
    for k in range(n):
        end[k] = given[k]
        change = end[k] - y[k]
        D[k] = h * rate[k] - change
        D[n + k] = change - D[k] - h * rate_end[k]
        D[2 * n + k] = 0.0


@compiled
def accept(run, point, h, crossed):
    """Set the piece that is accepted: up to the crossing, or to the end."""
    run.steps += 1
    run.last_error = 1.0
    run.retried = 0
    run.crossed = 1 if crossed else 0
    if crossed and run.cut_at < 1.0:
        run.landing = 0
        run.t_piece = point.t + run.cut_at * h
        interpolate(point, run.cut_at, point.at_y_piece)
    else:
        run.t_piece = run.t_land if run.landing == 1 else point.t + h
        copy(reals(point.at_y_end, point.n), reals(point.at_y_piece, point.n))
    run.phase = RECORD


def find_culprit(address):
    """Why no step succeeds at the point: NOT_FINITE if f is not ahead, else STEP_FLOOR; the unknown in `worst`."""
    m = memory_at(address)
    point = m.point
    weigh(point, point.at_y)
    weighted_norm(point, point.at_slope)
    return not_finite_here(m.problem, m.run, point, STEP_FLOOR)
