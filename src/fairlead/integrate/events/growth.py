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

from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.events.violators import RISE
from fairlead.integrate.linear.products import add_slopes_times
from fairlead.integrate.linear.systems import solve
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals
from fairlead.integrate.point.controller import smallest_step, weighted_norm
from fairlead.integrate.point.even_steps import COARSE, rounded

STRIDE = 1.0
"""Step in times 1/w; at 1/gamma, 4.7 of one method and 3 of the other, the matrix of the step is singular."""
LONG_ENOUGH = 50.0
"""How many times 1/w the steps stay short at most: from what rounding leaves to any speed."""
GROWN = 1e-2
"""Error of a step, in weights, from which on it sets the step itself."""


@compiled
def watch_growth(m):
    """Set `growth` [1/s] and until when it counts, after a settlement; zero where nothing grows from rest.

    The factors of the consistent point and the guards that `fire_violators` left there are those of now.
    """
    problem, run, point, guards = m.problem, m.run, m.point, m.events.guards
    run.growth = 0.0
    g, tolerance = reals(guards.at_g, guards.n_guards), reals(guards.at_guard_tolerance, guards.n_guards)
    probe, inertia = reals(guards.at_g_probe, guards.n_guards), reals(guards.at_guard_inertia, guards.n_guards)
    undecided = False
    for i in range(guards.n_guards):
        on_limit = inertia[i] > 0.0 and abs(g[i]) <= tolerance[i]
        undecided = undecided or (on_limit and abs(probe[i] - g[i]) <= RISE * tolerance[i])
    if not undecided:
        return
    third_derivative = reals(point.at_b, point.n)
    third_derivative[:] = 0.0
    add_slopes_times(m.linear.matrices, point.at_curvature, point.at_b)
    solve(m.linear, point.at_b)
    far, early = reals(guards.at_g_left, guards.n_guards), reals(guards.at_g_early, guards.n_guards)
    late = reals(guards.at_g_late, guards.n_guards)
    find_guard_rates(problem, run, point, guards, point.at_curvature, guards.at_g_early)
    find_guard_rates(problem, run, point, guards, point.at_b, guards.at_g_late)
    copy(probe, far)
    for i in range(guards.n_guards):
        on_limit = inertia[i] > 0.0 and abs(g[i]) <= tolerance[i]
        if on_limit and abs(far[i] - g[i]) <= RISE * tolerance[i] and early[i] < 0.0 and late[i] < 0.0:
            run.growth = max(run.growth, late[i] / early[i])
    if run.growth * smallest_step(run, point) > STRIDE:  # of two rates that are rounding
        run.growth = 0.0
    if run.growth > 0.0:
        run.t_growth = point.t + LONG_ENOUGH / run.growth


@compiled
def find_guard_rates(problem, run, point, guards, at_direction, at_rates):
    """How fast guards rise when the differential unknowns go along a direction, by a move of one weight."""
    n = point.n
    y, direction, differential = reals(point.at_y, n), reals(at_direction, n), indices(point.at_differential, n)
    along, probe = reals(point.at_u, n), reals(point.at_y_probe, n)
    for k in range(n):
        along[k] = direction[k] if differential[k] == 1 else 0.0
    size = weighted_norm(point, point.at_u)
    g, rates = reals(guards.at_g, guards.n_guards), reals(at_rates, guards.n_guards)
    rates[:] = 0.0
    if not size > 0.0:
        return
    for k in range(n):
        probe[k] = y[k] + along[k] / size
    evaluate_guards(problem, run, guards, point.t, point.at_y_probe, at_rates)
    for i in range(guards.n_guards):
        rates[i] = (rates[i] - g[i]) * size


@compiled
def shorten_for_growth(run, point, h):
    """The step `h`, or a shorter one that sees what grows from rest."""
    if run.growth > 0.0:
        if point.t < run.t_growth and run.last_error < GROWN:
            return min(h, rounded(STRIDE / run.growth, COARSE))
        run.growth = 0.0
    return h
