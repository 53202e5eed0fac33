"""What the `ida` engine calls from Python, compiled: residual, linear system, guards, the judgement of a step.

    residual   r = M y' - f(t, y)
    matrix     cj M - J, factorised as `rodas` does it

All take the address of the struct first (memory.py) and work on arrays at the addresses they are given.
"""

from __future__ import annotations

from fairlead.integrate.codes import BEFORE, RECORD, SETTLE, STEP_FLOOR
from fairlead.integrate.controller import weigh, weighted_norm
from fairlead.integrate.crossing import COMPANION, CROSSING, NONE, first_crossing
from fairlead.integrate.foreign import compiled, copy, field_at, indices, jacobian_at, memory_at, reals
from fairlead.integrate.guards import evaluate_guards
from fairlead.integrate.interpolant import interpolate
from fairlead.integrate.linear import add_mass_times, factorise_step, solve
from fairlead.integrate.one_step import rough
from fairlead.integrate.pace import not_finite_here
from fairlead.integrate.record import write_row
from fairlead.integrate.release import remember
from fairlead.integrate.settling import begin_settling


def residual(address, t, at_y, at_rate, at_r):
    """Set r = M y' - f(t, y)."""
    m = memory_at(address)
    field_at(m.call_rhs, (m.context, t, at_y, at_r))
    m.rhs += 1
    r = reals(at_r, m.n)
    for k in range(m.n):
        r[k] = -r[k]
    add_mass_times(m, at_rate, at_r)


def prepare(address, t, at_y, cj):
    """J at (t, y), and the factors of cj M - J; 0, or why they fail (linear.py)."""
    m = memory_at(address)
    jacobian_at(m.call_jacobian, (m.context, t, at_y, m.at_jacobian, m.at_ft))
    m.jacobians += 1
    return factorise_step(m, cj)


def solve_prepared(address, at_b, at_x):
    """Solve (cj M - J) x = b by the factors of `prepare`."""
    m = memory_at(address)
    copy(reals(at_b, m.n), reals(at_x, m.n))
    solve(m, at_x)


def multiply(address, cj, at_v, at_product):
    """Set product = (cj M - J) v with the J of `prepare` and this cj."""
    m = memory_at(address)
    product, v = reals(at_product, m.n), reals(at_v, m.n)
    product[:] = 0.0
    add_mass_times(m, at_v, at_product)
    for k in range(m.n):
        product[k] *= cj
    starts, rows = indices(m.at_jacobian_starts, m.n + 1), indices(m.at_jacobian_rows, m.n_jacobian)
    values = reals(m.at_jacobian, m.n_jacobian)
    for j in range(m.n):
        for p in range(starts[j], starts[j + 1]):
            product[rows[p]] -= values[p] * v[j]


def guards(address, t, at_y, at_g):
    """Guards at (t, y), as all engines see them."""
    m = memory_at(address)
    evaluate_guards(m, t, at_y, at_g)


def judge_step(address, t_end, at_y_end, at_rate_end, at_rooted, n_rooted, floor):
    """Judge the step from the point to (t_end, y_end, y'_end) by the trigger and companion rules; set its piece.

    1 if it is to be taken again, shorter: it is cut at a crossing where it does not satisfy the equations. Else 0.
    `rooted` are guards whose rise through zero at t_end was located by the integrator; what the rules of
    crossing.py see earlier in the step (a double crossing, a guard that begins at zero) comes first. A step of
    `floor` is not taken again.
    """
    m = memory_at(address)
    h = t_end - m.t
    m.h = h
    m.landing = 1 if t_end >= m.t_land else 0
    prepare_cubic(m, h, at_y_end, at_rate_end)
    found = first_crossing(m, h)
    if found == COMPANION:
        m.rejected_companion += 1
        m.companion = 1
        write_row(m, m.t, m.at_y, BEFORE)
        remember(m)
        begin_settling(m)
        m.phase = SETTLE
        return 0
    if found == NONE and n_rooted > 0:
        copy(indices(at_rooted, n_rooted), indices(m.at_fired, n_rooted))
        m.n_fired = n_rooted
        m.theta = 1.0
    crossed = found == CROSSING or n_rooted > 0
    if crossed and h > 2.0 * floor:
        weigh(m, m.at_y_end)
        if rough(m, h):
            m.n_fired = 0
            return 1
    accept(m, h, crossed)
    copy(reals(at_rate_end, m.n), reals(m.at_slope, m.n))
    return 0


@compiled
def prepare_cubic(m, h, at_y_end, at_rate_end):
    """Set `y_end` and the D of interpolant.py for the cubic with these values and rates at both ends."""
    n = m.n
    y, end, D = reals(m.at_y, n), reals(m.at_y_end, n), reals(m.at_D, 3 * n)
    rate, rate_end, given = reals(m.at_slope, n), reals(at_rate_end, n), reals(at_y_end, n)
    for k in range(n):
        end[k] = given[k]
        change = end[k] - y[k]
        D[k] = h * rate[k] - change
        D[n + k] = change - D[k] - h * rate_end[k]
        D[2 * n + k] = 0.0


@compiled
def accept(m, h, crossed):
    """Set the piece that is accepted: up to the crossing, or to the end."""
    m.steps += 1
    m.last_error = 1.0
    m.retried = 0
    m.crossed = 1 if crossed else 0
    if crossed and m.theta < 1.0:
        m.landing = 0
        m.t_piece = m.t + m.theta * h
        interpolate(m, m.theta, m.at_y_piece)
    else:
        m.t_piece = m.t_land if m.landing == 1 else m.t + h
        copy(reals(m.at_y_end, m.n), reals(m.at_y_piece, m.n))
    m.phase = RECORD


def find_culprit(address):
    """Why no step succeeds at the point: NOT_FINITE if f is not ahead, else STEP_FLOOR; the unknown in `worst`."""
    m = memory_at(address)
    weigh(m, m.at_y)
    weighted_norm(m, m.at_slope)
    return not_finite_here(m, STEP_FLOOR)
