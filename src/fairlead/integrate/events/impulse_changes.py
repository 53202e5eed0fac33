"""What an impulse changes: speeds, the ledger of energy with what is lost, and what is integrated of forces.

The integral z of what follows from a force, z' = f(force, speeds), takes in the impulse, as an impulse is the integral
of its force:

    change of z = (df/dforce) (1 + e) P        at the force of P (impulse_load.py), at the speeds halfway through

Halfway through their change, because the integral of a power is then the work: a speed changes evenly with the
impulse.
"""

from __future__ import annotations

from fairlead.integrate.events.impulse_load import UNLIMITED, load_forces
from fairlead.integrate.events.rebound import NO_REBOUND
from fairlead.integrate.memory.foreign import compiled, indices, jacobian_at, reals, slip_at
from fairlead.integrate.point.controller import weighted_norm


@compiled
def find_change_of_speed(problem, point):
    """Set u = dV and tell its weighted norm; the ledger has its own account of an impact, and positions stand still."""
    b, dv, struck = reals(point.at_b, problem.n), reals(point.at_u, problem.n), indices(problem.at_struck, problem.n)
    for k in range(problem.n):
        dv[k] = b[k] if struck[k] == 1 else 0.0
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


@compiled
def integrate_impulses(problem, point, matrices, settling):
    """Add to integrals of forces what the impulses in b give them; u has the change of speed, `y_probe` e by row."""
    n = problem.n
    y, b, dv, e = reals(point.at_y, n), reals(point.at_b, n), reals(point.at_u, n), reals(point.at_y_probe, n)
    speed_of, differential = indices(problem.at_speed_of, n), indices(problem.at_differential, n)
    integral, halfway = indices(problem.at_integral, n), reals(point.at_y_probe, n)
    for k in range(n):
        if differential[k] == 0:
            b[k] *= 1.0 + e[speed_of[k]]
    for k in range(n):
        halfway[k] = y[k] - 0.5 * dv[k]
    load_forces(problem, settling, point)
    jacobian_at(problem.call_jacobian, (problem.context, point.t, point.at_y_probe, matrices.at_jacobian, point.at_x))
    problem.jacobians += 1
    starts, rows = indices(matrices.at_jacobian_starts, n + 1), indices(matrices.at_jacobian_rows, matrices.n_jacobian)
    slopes, mass = reals(matrices.at_jacobian, matrices.n_jacobian), reals(matrices.at_mass, matrices.n_mass)
    own_mass = indices(matrices.at_diagonal_mass, n)
    for k in range(n):
        if differential[k] == 0 and b[k] != 0.0:
            for p in range(starts[k], starts[k + 1]):
                if integral[rows[p]] == 1:
                    y[rows[p]] += slopes[p] * b[k] / mass[own_mass[rows[p]]]
