"""Who changes its zone under an impulse, and who does when its change of speed is over.

Contacts and stops are asked with the speeds v + dV, for they hold if they come to rest or touch then. What only tells
signals, as a limiter between the force of a stop and the brake that it presses, tells all through the impulse what it
tells of the force of that load. A law between the points of a table is followed from the speeds before. Such guards
(`blow_guard`) are asked with the speeds before and the load, and zones go back in the settlement after the impulse.
"""

from __future__ import annotations

from fairlead.integrate.events.guards import evaluate_guards, latches_wait
from fairlead.integrate.events.impulse_load import UNLIMITED, load, load_forces
from fairlead.integrate.events.least_index import keep_first
from fairlead.integrate.events.violators import place_rounding
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, reals

PROBE_TIME = 1e-6
"""Share of T (impulse_load.py) after which it is asked which stops come nearer: more than rounding of places."""
TIME_ROUNDING = 1e-12
"""Share of the time that is more than its rounding, which moves places that are given."""
LEAST_APPROACH = 1e-8
"""Share of the largest change of speed at which stops that touch must approach to take part: less is rounding."""


@compiled
def change_zones_for(m):
    """Fill `fired` with the guards of contacts, stops and signals that the impulse sends into another zone.

    All at once; once a pattern of zones has recurred in this settlement, the one of least index.
    """
    problem, run, point, guards, settling = m.problem, m.run, m.point, m.events.guards, m.events.settling
    n, ng = problem.n, problem.n_guards
    y, b, loaded = reals(point.at_y, n), reals(point.at_b, n), reals(point.at_y_probe, n)
    struck = indices(problem.at_struck, n)
    for k in range(n):
        loaded[k] = y[k] + (b[k] if struck[k] == 1 else 0.0)
    load_forces(problem, settling, point)
    evaluate_guards(problem, run, guards, point.t, point.at_y, guards.at_g)
    evaluate_guards(problem, run, guards, point.t, point.at_y_probe, guards.at_g_probe)
    least = max(LEAST_APPROACH * move_on(m), place_rounding(problem, point))
    load(problem, settling, point)
    evaluate_guards(problem, run, guards, point.t, point.at_y_probe, guards.at_g_later)
    g, under, tolerance = reals(guards.at_g, ng), reals(guards.at_g_probe, ng), reals(guards.at_guard_tolerance, ng)
    later, before = reals(settling.at_wrong, ng), reals(guards.at_g_later, ng)
    asked = indices(problem.at_blow_guard, ng)
    may_hold, fired = indices(problem.at_may_hold, ng), indices(guards.at_fired, ng)
    guards.n_fired = 0
    for i in range(ng):
        if asked[i] > 0:
            changes = before[i] > tolerance[i]
        else:
            changes = may_hold[i] > 0 and under[i] > tolerance[i] and under[i] != g[i]
        touches = may_hold[i] == UNLIMITED and abs(under[i]) <= tolerance[i]
        if changes or (touches and later[i] - under[i] > least):
            fired[guards.n_fired] = i
            guards.n_fired += 1
    latches_wait(problem, guards)
    if settling.stage > 0 and guards.n_fired > 1:
        keep_first(m.events)


@compiled
def move_on(m):
    """Guards a little later than at `y_probe`, into `wrong`; the largest way of what dV (in u) moves till then."""
    problem, run, point, matrices = m.problem, m.run, m.point, m.linear.matrices
    n = problem.n
    loaded, dv, moved, f = reals(point.at_y_probe, n), reals(point.at_u, n), reals(point.at_x, n), reals(point.at_f, n)
    differential, quadrature = indices(problem.at_differential, n), indices(problem.at_quadrature, n)
    values, rows = reals(matrices.at_mass, matrices.n_mass), indices(matrices.at_mass_rows, matrices.n_mass)
    columns = indices(matrices.at_mass_columns, matrices.n_mass)
    later, most = max(PROBE_TIME * m.events.settling.own_time, TIME_ROUNDING * abs(point.t)), 0.0
    for k in range(n):
        moved[k] = loaded[k]
        most = max(most, abs(dv[k]))
    field_at(problem.call_rhs, (problem.context, point.t, point.at_x, point.at_f))
    for e in range(matrices.n_mass):
        k = rows[e]
        if k == columns[e] and differential[k] == 1 and quadrature[k] == 0 and dv[k] == 0.0 and values[e] != 0.0:
            moved[k] += later * f[k] / values[e]
    evaluate_guards(problem, run, m.events.guards, point.t + later, point.at_x, m.events.settling.at_wrong)
    return later * most


@compiled
def turn_round(m):
    """Fire the guards of contacts that slide against the direction of their zones now, before a law is asked there.

    What friction is behind rest means nothing, and need not be finite: some laws are exponential in the speed. One that
    slides in name, as others hold its sides, is judged by what it shares of the impulses.
    """
    problem, run, point, guards = m.problem, m.run, m.point, m.events.guards
    g, inertia = reals(guards.at_g_probe, guards.n_guards), reals(guards.at_guard_inertia, guards.n_guards)
    tolerance, fired = reals(guards.at_guard_tolerance, guards.n_guards), indices(guards.at_fired, guards.n_guards)
    copy(reals(point.at_y, problem.n), reals(point.at_y_probe, problem.n))
    load_forces(problem, m.events.settling, point)
    evaluate_guards(problem, run, guards, point.t, point.at_y_probe, guards.at_g_probe)
    before = guards.n_fired
    for i in range(guards.n_guards):
        new = inertia[i] > 0.0 and g[i] > tolerance[i]
        for k in range(before):
            new = new and fired[k] != i
        if new:
            fired[guards.n_fired] = i
            guards.n_fired += 1
