"""What an impulse changes: speeds, and the ledger of energy with what is lost."""

from __future__ import annotations

from fairlead.integrate.events.impulse_load import UNLIMITED
from fairlead.integrate.events.rebound import NO_REBOUND
from fairlead.integrate.memory.foreign import compiled, indices, reals, slip_at
from fairlead.integrate.point.controller import weighted_norm


@compiled
def change_of_speed(problem, point):
    """Set u = dV and tell its weighted norm; the ledger has its own account of an impact, and positions stand still."""
    b, u, is_speed = reals(point.at_b, problem.n), reals(point.at_u, problem.n), indices(problem.at_is_speed, problem.n)
    for k in range(problem.n):
        u[k] = b[k] if is_speed[k] == 1 else 0.0
    return weighted_norm(point, point.at_u)


@compiled
def change_speeds(problem, point, matrices, back, supports):
    """Add the change in u to the speeds and book what is lost, and what supports that move have given."""
    n = problem.n
    y, b, r, e = reals(point.at_y, n), reals(point.at_b, n), reals(point.at_v, n), reals(point.at_y_probe, n)
    dv, lost = reals(point.at_u, n), reals(point.at_lost, n)
    for k in range(n if back == NO_REBOUND else 0):
        e[k] = 0.0
    gained, loss = energies(point, matrices)
    weight = 0.0
    for k in range(n):
        weight += abs(b[k] * r[k]) * (1.0 - e[k] ** 2)
    if not supports:
        loss = -gained
    for k in range(n):
        y[k] += dv[k]
        if weight > 0.0:
            lost[k] += loss * abs(b[k] * r[k]) * (1.0 - e[k] ** 2) / weight
    if problem.dissipated_at >= 0:
        y[problem.dissipated_at] += loss
        y[problem.supplied_at] += gained + loss


@compiled
def energies(point, matrices):
    """The change of kinetic energy that u makes, and what is lost: (1 - e^2) dV M dV / 2 with u = (1 + e) dV."""
    y, dv = reals(point.at_y, point.n), reals(point.at_u, point.n)
    differential = indices(point.at_differential, point.n)
    values, rows = reals(matrices.at_mass, matrices.n_mass), indices(matrices.at_mass_rows, matrices.n_mass)
    columns, e = indices(matrices.at_mass_columns, matrices.n_mass), reals(point.at_y_probe, point.n)
    gained = loss = 0.0
    for p in range(matrices.n_mass):
        i, j = rows[p], columns[p]
        if differential[i] == 1:
            loss += 0.5 * values[p] * dv[i] * dv[j] * (1.0 - e[i]) / (1.0 + e[i])
            gained += 0.5 * values[p] * (dv[i] * y[j] + y[i] * dv[j] + dv[i] * dv[j])
    return gained, loss


@compiled
def any_support_moves(problem, point):
    """True if a rigid row slips though all that the impulse moves is at rest: what it leans on moves."""
    n = problem.n
    y, dv, still = reals(point.at_y, n), reals(point.at_u, n), reals(point.at_y_probe, n)
    for k in range(n):
        still[k] = 0.0 if dv[k] != 0.0 else y[k]
    slip_at(problem.call_slip, (problem.context, point.t, point.at_y_probe, point.at_x))
    r, takes = reals(point.at_x, n), indices(problem.at_takes_impulse, n)
    moves = False
    for k in range(n):
        moves = moves or (takes[k] >= UNLIMITED and r[k] != 0.0)
    return moves
