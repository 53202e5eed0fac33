"""Slips that begin from nothing and grow: a step that does not see the growth goes the other way.

A contact whose friction falls with speed lets go when its load reaches stiction; at that instant nothing pulls, and

    slip = -r/w^2 (e^(w t) - 1 - w t),    w = slope of the curve over the inertia, r = rate of the load over the inertia

An implicit method takes a mode that grows, in a step that is long against 1/w, to where the forces balance, and that is
a slip against the load: the contact is caught again, and so on without end. The error norm says nothing, since all
of this is far below the weights, and y' and y'' at the switch do not tell w either: y' is that of the surroundings.
So where a slip is at its limit and moves neither way to be seen, w is had from y''' = J y'', and the first steps are
short against 1/w until the error norm sees what grows.
"""

from __future__ import annotations

from fairlead.integrate.controller import weighted_norm
from fairlead.integrate.even_steps import COARSE, rounded
from fairlead.integrate.foreign import compiled, copy, indices, reals
from fairlead.integrate.guards import evaluate_guards
from fairlead.integrate.linear import solve, times_jacobian
from fairlead.integrate.settling import RISE

STRIDE = 1.0
"""Step in times 1/w; at 1/gamma, 4.7 of one method and 3 of the other, the matrix of the step is singular."""
LONG_ENOUGH = 50.0
"""How many times 1/w the steps stay short at most: from what rounding leaves to any speed."""
SEEN = 1e-2
"""Error of a step, in weights, from which on it sets the step itself."""


@compiled
def watch_growth(m):
    """Set `growth` [1/s] and until when it counts, after a settlement; zero where nothing grows from rest.

    The factors of the consistent point and the guards that `judge` left there are those of now.
    """
    m.growth = 0.0
    g, tolerance = reals(m.at_g, m.n_guards), reals(m.at_guard_tolerance, m.n_guards)
    probe, inertia = reals(m.at_g_probe, m.n_guards), reals(m.at_guard_inertia, m.n_guards)
    undecided = False
    for i in range(m.n_guards):
        at_limit = inertia[i] > 0.0 and abs(g[i]) <= tolerance[i]
        undecided = undecided or (at_limit and abs(probe[i] - g[i]) <= RISE * tolerance[i])
    if not undecided:
        return
    b = reals(m.at_b, m.n)
    b[:] = 0.0
    times_jacobian(m, m.at_curvature, m.at_b)
    solve(m, m.at_b)
    far, early, late = reals(m.at_g_left, m.n_guards), reals(m.at_g_early, m.n_guards), reals(m.at_g_late, m.n_guards)
    guard_rates(m, m.at_curvature, m.at_g_early)
    guard_rates(m, m.at_b, m.at_g_late)
    copy(probe, far)
    for i in range(m.n_guards):
        at_limit = inertia[i] > 0.0 and abs(g[i]) <= tolerance[i]
        if at_limit and abs(far[i] - g[i]) <= RISE * tolerance[i] and early[i] < 0.0 and late[i] < 0.0:
            m.growth = max(m.growth, late[i] / early[i])
    if m.growth > 0.0:
        m.t_growth = m.t + LONG_ENOUGH / m.growth


@compiled
def guard_rates(m, at_direction, at_rates):
    """How fast guards rise when the differential unknowns go along a direction, by a move of one weight."""
    n = m.n
    y, direction, differential = reals(m.at_y, n), reals(at_direction, n), indices(m.at_differential, n)
    u, probe = reals(m.at_u, n), reals(m.at_y_probe, n)
    for k in range(n):
        u[k] = direction[k] if differential[k] == 1 else 0.0
    size = weighted_norm(m, m.at_u)
    g, rates = reals(m.at_g, m.n_guards), reals(at_rates, m.n_guards)
    rates[:] = 0.0
    if not size > 0.0:
        return
    for k in range(n):
        probe[k] = y[k] + u[k] / size
    evaluate_guards(m, m.t, m.at_y_probe, at_rates)
    for i in range(m.n_guards):
        rates[i] = (rates[i] - g[i]) * size


@compiled
def short_of_growth(m, h):
    """The step `h`, or a shorter one that sees what grows from rest."""
    if m.growth > 0.0:
        if m.t < m.t_growth and m.last_error < SEEN:
            return min(h, rounded(STRIDE / m.growth, COARSE))
        m.growth = 0.0
    return h
