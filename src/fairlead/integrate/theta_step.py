"""One step of nonsmooth time stepping: the zones are unknowns of the step (after Moreau 1988).

    rows with mass     M (y1 - y0)/h = f(t0 + theta h, y0 + theta (y1 - y0), a)
    algebraic rows                 0 = f(t0 + theta h, y0 + theta (y1 - y0), a)
    held contacts                  0 = slip(t0 + h, y1)

y are the differential unknowns, a the algebraic ones: forces of contacts, means over the step. With
theta = 1/2 this is the implicit midpoint rule (order 2). A guard reads the speeds at the end of the step
and the mean forces, so a contact that holds and one that slides are the two branches of
|force| <= limit, slip at the end = 0 or against the force: a complementarity problem. It is solved by an
active set: solve with the zones frozen, switch all whose guards are violated, solve again; when a pattern
of zones recurs, switch the one of least index per pass (see settling.py). Smooth nonlinearity is taken up
by the same iteration, which ends when no guard is violated and the residual passes.

The matrix is the W of the Rosenbrock methods with gamma = theta, for theta (y1 - y0), so that one plan of
pivots serves both engines; the row of a held contact is M/(h theta) alone.
"""

from __future__ import annotations

from math import isfinite

from fairlead.integrate.foreign import (
    compiled,
    copy,
    field_at,
    indices,
    jacobian_at,
    mass_at,
    reals,
    slip_at,
    switch_at,
)
from fairlead.integrate.guards import evaluate_guards
from fairlead.integrate.jumps import all_continuous, find_jump, law_jumps
from fairlead.integrate.linear import DONE, add_mass_times, factorise_step, solve
from fairlead.integrate.settling import begin_settling, recurs

CYCLES, DIVERGES, JUMPS = 6, 7, 8
PASSED = 1e-3
"""A residual below this, each row over its largest entry in error weights, is solved."""
SLOW = 0.01
"""A residual that shrinks by less than this in an iteration asks for a new Jacobian."""
SMOOTH_ITERATIONS = 10
"""Iterations without a switch before the step counts as not converging."""


@compiled
def take_theta_step(m, h):
    """Compute `y_end` and the zones that go with it.

    Returns DONE, SINGULAR, INACCURATE, CYCLES, DIVERGES or JUMPS (a switch with a jump, at `t_jump`).
    """
    predict(m, h)
    begin_settling(m)
    copy(indices(m.at_zones, m.n_zones), indices(m.at_zones_at_start, m.n_zones))
    fresh_slip, smooth, previous = m.driven == 1 or m.gap == 0.0, 0, 1e300
    if m.driven == 1:
        m.linearised = 0
    while True:
        status = linearise_step(m, h)
        if status != DONE:
            return status
        residual_of_step(m, h, fresh_slip)
        size = scaled_residual(m)
        if not isfinite(size):
            return DIVERGES
        if smooth > 0 and size <= PASSED and (smooth > 1 or m.driven == 0):
            if smooth > 2:
                m.linearised = 0
            return DONE
        if smooth >= SMOOTH_ITERATIONS:
            return DIVERGES
        if smooth > 1 and size > SLOW * previous:
            m.linearised = 0
        previous = size
        solve(m, m.at_b)
        move_end(m)
        smooth += 1
        evaluate_guards(m, m.t + h, m.at_y_end, m.at_g_end)
        violators(m)
        fresh_slip = m.n_fired > 0
        if m.n_fired > 0:
            smooth = 0
            suspect = m.passes == 0 and not all_continuous(m)
            if suspect:
                field_at(m.call_rhs, (m.context, m.t + h, m.at_y_end, m.at_x))
            jumped = follow_guards(m, h)
            if jumped or (suspect and law_jumps(m, h)):
                find_jump(m, h)
                return JUMPS
            if m.passes > m.max_passes:
                return CYCLES


@compiled
def predict(m, h):
    """First guess of the end: on along the last slope, forces as they were."""
    y, y_end, slope = reals(m.at_y, m.n), reals(m.at_y_end, m.n), reals(m.at_slope_before, m.n)
    differential = indices(m.at_differential, m.n)
    for k in range(m.n):
        y_end[k] = y[k] + h * slope[k] if differential[k] == 1 else y[k]


@compiled
def theta_point(m):
    """Into `u`: where the laws are evaluated."""
    y, y_end, u = reals(m.at_y, m.n), reals(m.at_y_end, m.n), reals(m.at_u, m.n)
    differential, theta = indices(m.at_differential, m.n), m.theta_now
    for k in range(m.n):
        u[k] = y[k] + theta * (y_end[k] - y[k]) if differential[k] == 1 else y_end[k]


@compiled
def linearise_step(m, h):
    """M, J and the factors, as far as they are not those of the zones and the step in force."""
    if m.linearised == 0:
        mass_at(m.call_mass, (m.context, m.at_mass))
        theta_point(m)
        jacobian_at(m.call_jacobian, (m.context, m.t + m.theta_now * h, m.at_u, m.at_jacobian, m.at_ft))
        m.jacobians += 1
        find_holds(m)
        m.linearised = 1
        m.factored_h = 0.0
    if m.factored_h == h and m.factored_theta == m.theta_now:
        return DONE
    m.factored_h = 0.0
    status = factorise_step(m, 1.0 / (h * m.theta_now))
    if status == DONE:
        m.factored_h = h
        m.factored_theta = m.theta_now
    return status


@compiled
def find_holds(m):
    """Mark the rows of contacts that hold: those of an algebraic unknown in which M has an entry now.

    Their right side is -slip/tau plus the acceleration of the surface; `hold_time` is that tau, and the
    acceleration is tau f_t when it is constant. (`slip` itself answers only within the stick speed, and a
    contact is caught from any speed here.)
    """
    n = m.n
    holds, differential = indices(m.at_holds, n), indices(m.at_differential, n)
    starts, rows = indices(m.at_mass_starts, n + 1), indices(m.at_mass_rows, m.n_mass)
    values = reals(m.at_mass, m.n_mass)
    slopes, ft, times = reals(m.at_jacobian, m.n_jacobian), reals(m.at_ft, n), reals(m.at_hold_time, n)
    slope_starts, slope_rows = indices(m.at_jacobian_starts, n + 1), indices(m.at_jacobian_rows, m.n_jacobian)
    holds[:] = 0
    m.driven = 0
    m.sharing = 0
    if m.call_slip == 0:
        return
    for j in range(n):
        for p in range(starts[j], starts[j + 1]):
            i = rows[p]
            if differential[i] == 0 and values[p] != 0.0 and holds[i] == 0:
                for q in range(slope_starts[j], slope_starts[j + 1]):
                    if slope_rows[q] == i and slopes[q] != 0.0:
                        holds[i] = 1
                        times[i] = -values[p] / slopes[q]
                        if ft[i] != 0.0:
                            m.driven = 1
    for j in range(n):
        for q in range(slope_starts[j], slope_starts[j + 1]):
            i = slope_rows[q]
            if holds[i] == 1 and slopes[q] != 0.0:
                if differential[j] == 1 or has_mass(m, i, j):
                    slopes[q] = 0.0
                else:
                    m.sharing = 1


@compiled
def has_mass(m, i, j):
    """True if M has an entry at row i, column j, in the zones in force."""
    starts, rows = indices(m.at_mass_starts, m.n + 1), indices(m.at_mass_rows, m.n_mass)
    values = reals(m.at_mass, m.n_mass)
    found = False
    for p in range(starts[j], starts[j + 1]):
        found = found or (rows[p] == i and values[p] != 0.0)
    return found


@compiled
def add_shares(m, sign):
    """Add `sign` times what forces add to the rows of b that hold: contacts that close a circle share a load."""
    n = m.n
    if m.sharing == 0:
        return
    b, holds, y_end = reals(m.at_b, n), indices(m.at_holds, n), reals(m.at_y_end, n)
    differential, slopes = indices(m.at_differential, n), reals(m.at_jacobian, m.n_jacobian)
    starts, rows = indices(m.at_jacobian_starts, n + 1), indices(m.at_jacobian_rows, m.n_jacobian)
    for j in range(n):
        if differential[j] == 0:
            for q in range(starts[j], starts[j + 1]):
                if holds[rows[q]] == 1:
                    b[rows[q]] += sign * slopes[q] * y_end[j]


@compiled
def residual_of_step(m, h, fresh_slip):
    """Set b = f - M (y1 - y0)/h, and -slip/h in the rows of held contacts."""
    n = m.n
    theta_point(m)
    field_at(m.call_rhs, (m.context, m.t + m.theta_now * h, m.at_u, m.at_f))
    m.rhs += 1
    y, y_end, v, b, f = reals(m.at_y, n), reals(m.at_y_end, n), reals(m.at_v, n), reals(m.at_b, n), reals(m.at_f, n)
    differential, holds = indices(m.at_differential, n), indices(m.at_holds, n)
    backward = -1.0 / h
    for k in range(n):
        v[k] = backward * (y_end[k] - y[k]) if differential[k] == 1 else 0.0
        b[k] = f[k] if holds[k] == 0 else 0.0
    add_mass_times(m, m.at_v, m.at_b)
    if m.call_slip != 0:
        slips_of_step(m, h, fresh_slip)


@compiled
def slips_of_step(m, h, fresh_slip):
    """Write -slip/h at the end of the step into the rows of b that hold.

    What b holds already, -M (y1 - y0)/h, is just that for a contact that held at the start, on a surface
    at constant speed. After a switch the slip is taken from the law; where a surface is accelerated it is
    looked at once more, when it is small enough for `slip` to answer exactly.
    """
    n = m.n
    b, holds, r = reals(m.at_b, n), indices(m.at_holds, n), reals(m.at_residual, n)
    times, ft = reals(m.at_hold_time, n), reals(m.at_ft, n)
    if fresh_slip:
        field_at(m.call_rhs, (m.context, m.t + h, m.at_y_end, m.at_residual))
        m.rhs += 1
        for k in range(n):
            if holds[k] == 1:
                b[k] = r[k] - times[k] * ft[k]
        add_shares(m, -1.0)
        for k in range(n):
            if holds[k] == 1:
                b[k] = times[k] * b[k] / h
    elif m.driven == 1:
        slip_at(m.call_slip, (m.context, m.t + h, m.at_y_end, m.at_residual))
        for k in range(n):
            if holds[k] == 1:
                b[k] = r[k] / h
    elif m.passes > 0 or m.gap == 0.0:
        for k in range(n):
            if holds[k] == 1:
                b[k] = 0.0
    add_shares(m, 1.0)


@compiled
def scaled_residual(m):
    """Largest |b_i| over the largest entry of row i in units of the weights; nan if any is. See `worst`."""
    b, scale, quadrature = reals(m.at_b, m.n), reals(m.at_row_scale, m.n), indices(m.at_quadrature, m.n)
    rows = m.n if m.dense == 1 else m.n_core
    order = indices(m.at_row_order, m.n_core)
    largest = 0.0
    for k in range(rows):
        i = k if m.dense == 1 else order[k]
        size = abs(b[i]) * scale[k]
        if not isfinite(size):
            m.worst = i
            return size
        if quadrature[i] == 0 and size > largest:
            largest = size
            m.worst = i
    return largest


@compiled
def move_end(m):
    """Add the solution in b: theta times the change of a differential unknown, the change of a force."""
    b, y_end, differential = reals(m.at_b, m.n), reals(m.at_y_end, m.n), indices(m.at_differential, m.n)
    ahead = 1.0 / m.theta_now
    for k in range(m.n):
        y_end[k] += ahead * b[k] if differential[k] == 1 else b[k]


@compiled
def violators(m):
    """Fill `fired` with the guards above their tolerance at the end of the step."""
    g, tolerance = reals(m.at_g_end, m.n_guards), reals(m.at_guard_tolerance, m.n_guards)
    fired = indices(m.at_fired, m.n_guards)
    m.n_fired = 0
    for i in range(m.n_guards):
        if g[i] > tolerance[i]:
            fired[m.n_fired] = i
            m.n_fired += 1


@compiled
def follow_guards(m, h):
    """Switch on `fired`, all or the first; True if the switch changes unknowns (a rebound)."""
    if m.passes >= m.max_passes:
        m.passes += 1
        return False
    if m.one_by_one == 1:
        m.n_fired = 1
    nz = m.n_zones
    y, after = reals(m.at_y_end, m.n), reals(m.at_y_probe, m.n)
    copy(y, after)
    switch_at(m.call_switch, (m.context, m.t + h, m.at_y_probe, m.at_fired, m.n_fired))
    m.linearised = 0
    m.passes += 1
    m.settling_passes += 1
    if m.passes < m.max_passes:
        copy(indices(m.at_zones, nz), indices(m.at_zones_history + 8 * m.passes * nz, nz))
    if m.one_by_one == 0 and recurs(m):
        m.one_by_one = 1
    changed = False
    for k in range(m.n):
        changed = changed or y[k] != after[k]
    return changed


@compiled
def give_back_zones(m):
    """The zones of the start of the step; M and J are then not theirs."""
    copy(indices(m.at_zones_at_start, m.n_zones), indices(m.at_zones, m.n_zones))
    m.linearised = 0
    m.n_fired = 0
