"""Rows inside a step of the stepping engine show its end zones: what holds at the end is shown without slip.

It would else seem to creep: a body that is caught in the step has a slip at its start, bodies that hold on to each
other have parabolas of their own, and one that is carried along has another than the surface, which follows its law.
The slip r of held contacts, whatever network they form, is taken away by an impulse spread over the step,

    (M/(h theta) - J) (dv, Lambda) = r/(h theta)    r = -slip in the rows that hold

with the factors the step has left; dv is added, Lambda dropped. Slip is linear in the speeds. So where surfaces keep
their speed this is done once for the start of the step and once for its bend, else in every row.
"""

from __future__ import annotations

from fairlead.integrate.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.linear import add_mass_times, solve

STIFF = 100.0
"""An unknown follows its law within a step when h |df/dy| is so many times its inertia."""
FURTHEST = 10.0
"""Times the move that the factors of a step ask for, where a law is less stiff at the point than in the step."""


@compiled
def prepare_rows(m):
    """Of an accepted step with rows inside: take slip out of its start and its bend; see `rows_slip`."""
    m.rows_slip = 0
    gridless = m.on_grid == 0 or m.start + m.grid_next * m.every >= m.t_piece - 1e-12 * max(abs(m.t_piece), m.every)
    if not gridless or m.inside > 0:
        hold_inside(m)


@compiled
def hold_inside(m):
    """Take slip out of the start and the bend of a step, or have every point inside it done (`rows_slip`)."""
    m.rows_slip = 0
    row, caught = indices(m.at_hold_mass_row, m.n_hold_mass), indices(m.at_caught, m.n)
    holds, any_holds, any_caught = indices(m.at_holds, m.n), False, False
    for e in range(m.n_hold_mass):
        if holds[row[e]] == 1:
            any_holds = True
            any_caught = any_caught or caught[row[e]] == 1
    if not any_holds:
        return
    if m.driven == 1 or m.massless == 1:
        m.rows_slip = 1
        return
    if any_caught:
        take_slip_away(m, m.t, m.at_y)
    entry, column = indices(m.at_hold_mass, m.n_hold_mass), indices(m.at_hold_mass_column, m.n_hold_mass)
    values, bend, slip = reals(m.at_mass, m.n_mass), reals(m.at_D, m.n), reals(m.at_residual, m.n)
    for k in range(m.n):
        slip[k] = 0.0
    for e in range(m.n_hold_mass):
        slip[row[e]] -= values[entry[e]] * bend[column[e]]
    remove_slip(m, m.at_D)


@compiled
def take_slip_away(m, t, at_y):
    """Correct the speeds at (t, y) by the slip of contacts that hold."""
    field_at(m.call_drift, (m.context, t, at_y, m.at_residual))
    remove_slip(m, at_y)


@compiled
def end_massless(m, h):
    """Give nodes without mass that are held the speed they have at the end of a step, for their mean over it."""
    row, column = indices(m.at_hold_mass_row, m.n_hold_mass), indices(m.at_hold_mass_column, m.n_hold_mass)
    holds, of_massless, differential = (
        indices(m.at_holds, m.n), indices(m.at_of_massless, m.n), indices(m.at_differential, m.n),
    )  # fmt: skip
    field_at(m.call_drift, (m.context, m.t + h, m.at_y_end, m.at_residual))
    slip, b, y_end, found = reals(m.at_residual, m.n), reals(m.at_b, m.n), reals(m.at_y_end, m.n), False
    for k in range(m.n):
        b[k] = 0.0
    for e in range(m.n_hold_mass):
        k = row[e]
        if holds[k] == 1 and of_massless[k] == 1 and slip[k] != 0.0:
            b[k] = slip[k] / (m.factored_h * m.factored_theta)
            found = True
    if not found:
        return
    solve(m, m.at_b)
    for e in range(m.n_hold_mass):
        if differential[column[e]] == 0:
            y_end[column[e]] += b[column[e]]
            b[column[e]] = 0.0


@compiled
def remove_slip(m, at_v):
    """Add to the speeds in v what takes away the slip whose negative is in `residual`, in rows that hold."""
    row, holds = indices(m.at_hold_mass_row, m.n_hold_mass), indices(m.at_holds, m.n)
    slip, b, found = reals(m.at_residual, m.n), reals(m.at_b, m.n), False
    for k in range(m.n):
        b[k] = 0.0
    for e in range(m.n_hold_mass):
        if holds[row[e]] == 1 and slip[row[e]] != 0.0:
            b[row[e]] = slip[row[e]] / (m.factored_h * m.factored_theta)
            found = True
    if not found:
        return
    solve(m, m.at_b)
    v, speeds = reals(at_v, m.n), indices(m.at_hold_mass_column, m.n_hold_mass)
    for e in range(m.n_hold_mass):
        v[speeds[e]] += b[speeds[e]]
        b[speeds[e]] = 0.0


@compiled
def find_stiff(m, h):
    """Mark the speeds that follow a stiff law within the step; 1 if there is any.

    Speeds alone: what they hold of the energy is nothing. A pressure that is shown elsewhere has another energy.
    """
    slope, mass = indices(m.at_diagonal_slope, m.n), indices(m.at_diagonal_mass, m.n)
    values, inertia = reals(m.at_jacobian, m.n_jacobian), reals(m.at_mass, m.n_mass)
    stiff, position, found = indices(m.at_is_stiff, m.n), indices(m.at_position_of, m.n), 0
    for k in range(m.n):
        stiff[k] = 0
        moved = position[k] >= 0 and slope[k] >= 0 and mass[k] >= 0
        if moved and -values[slope[k]] * h > STIFF * inertia[mass[k]] > 0.0:
            stiff[k] = 1
            found = 1
    return found


@compiled
def balance_stiff(m, t, theta, at_y):
    """Give unknowns that follow a stiff law at theta, in y, the values at which it balances: f(y) = M y'.

    The midpoint rule leaves a third of a difference ringing in them, and the dense output inside a step knows
    nothing of the law: nothing as a speed, and much as a force. y' is that of the dense output, and says little here.
    How far to go along the move that the factors of the step give follows from the residuals before and after it.
    """
    n, per_step = m.n, 1.0 / m.h
    start, end, D, y = reals(m.at_y, n), reals(m.at_y_end, n), reals(m.at_D, 3 * n), reals(at_y, n)
    f, v, b, inert, before = (
        reals(m.at_f, n), reals(m.at_v, n), reals(m.at_b, n), reals(m.at_x, n), reals(m.at_residual, n),
    )  # fmt: skip
    stiff, differential = indices(m.at_is_stiff, n), indices(m.at_differential, n)
    for k in range(n):
        bend = D[k] + theta * (D[n + k] + theta * D[2 * n + k])
        turn = theta * (1.0 - theta) * (D[n + k] + 2.0 * theta * D[2 * n + k])
        slope = end[k] - start[k] + (1.0 - 2.0 * theta) * bend + turn
        v[k] = -slope * per_step if differential[k] == 1 else 0.0
        inert[k] = 0.0
    add_mass_times(m, m.at_v, m.at_x)
    field_at(m.call_forces, (m.context, t, at_y, m.at_f))
    for k in range(n):
        b[k] = f[k] + inert[k] if stiff[k] == 1 else 0.0
    copy(b, before)
    m.skip_meters = 1
    solve(m, m.at_b)
    m.skip_meters = 0
    for k in range(n):
        if stiff[k] == 1:
            y[k] += b[k]
    field_at(m.call_forces, (m.context, t, at_y, m.at_f))
    m.rhs += 2
    for k in range(n):
        if stiff[k] == 1:
            gone = before[k] - f[k] - inert[k]
            if before[k] * gone > 0.0:
                y[k] += (min(before[k] / gone, FURTHEST) - 1.0) * b[k]
            else:
                y[k] -= b[k]
        b[k] = 0.0
