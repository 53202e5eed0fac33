"""Which guards are violated at a settled point, and by how much: now, and a little later along (y', y'').

Judged at (t, y, y') right after a switch: a guard above its tolerance violates; one within its
tolerance violates if it is about to rise through zero along (y', y''), so a slide guard at v_rel = 0 is the
sign of a_rel. How wrong a zone is, is a force: what a contact that holds carries beyond its limit, and what
must be added to a contact that slides to keep it from going against its friction, m a_rel (the problem says
with which inertia; where it does not, the least index follows at once).
"""

from __future__ import annotations

from fairlead.integrate.events.guards import evaluate_guards, latches_wait
from fairlead.integrate.events.limits import AT_LIMIT, weigh_limits
from fairlead.integrate.memory.foreign import compiled, indices, reals
from fairlead.integrate.point.controller import weighted_norm

NUDGE, RISE = 1e-3, 1e-6
"""How far, in weights, the point is moved along y' to see guards rise, and the rise, in guard
tolerances, that counts: rounding of a guard at rest is far below, the slope of one in motion above."""
PLACE_ROUNDING = 4 * 2.0**-52
"""What a place is known to, as a share of itself and of speed times time, the phase of x(t): four ulps each."""
SLIP_TIME = 1e-3
"""A slip beyond its tolerance counts as the acceleration that would undo it in this time, s."""


@compiled
def fire_violators(problem, run, point, events):
    """Fill `fired` with the guards that violate at the point, `wrong` with how much, `g` with their values."""
    guards, settling = events.guards, events.settling
    ng = guards.n_guards
    guards.n_fired = 0
    if ng == 0:
        return
    weigh_limits(problem, guards, point.at_y)
    evaluate_guards(problem, run, guards, point.t, point.at_y, guards.at_g)
    g, tolerance, probe = reals(guards.at_g, ng), reals(guards.at_guard_tolerance, ng), reals(guards.at_g_probe, ng)
    known_to = place_rounding(problem, point) if problem.n_met_guards > 0 else 0.0
    met = indices(problem.at_met_guard, problem.n_met_guards)
    for i in met:
        if tolerance[i] < g[i] <= known_to:
            g[i] = 0.0  # a time is no better known than that, so the stop is not passed
    looks_ahead = looked_ahead(guards) and not event_is_due(run, point)
    if looks_ahead:
        look_ahead(problem, run, point, events)
        for i in met:
            if abs(probe[i] - g[i]) <= known_to:
                probe[i] = g[i]
    fired, wrong = indices(guards.at_fired, ng), reals(settling.at_wrong, ng)
    inertia = reals(guards.at_guard_inertia, ng)
    for i in range(ng):
        close = looks_ahead and -AT_LIMIT * tolerance[i] <= g[i] <= tolerance[i]
        rises = close and probe[i] >= 0.0 and probe[i] - g[i] > RISE * tolerance[i]
        if g[i] > tolerance[i] or rises:
            wrong[i] = g[i] if g[i] > tolerance[i] else probe[i] - g[i]
            if inertia[i] > 0.0:
                wrong[i] *= inertia[i] / (SLIP_TIME if g[i] > tolerance[i] else settling.lookahead)
            fired[guards.n_fired] = i
            guards.n_fired += 1
    if settling.stage == 0:
        functions_first(problem, guards)
    latches_wait(problem, guards)


@compiled
def functions_first(problem, guards):
    """Leave in `fired` those alone that tell no more than they read, if there are any: limiters, tables.

    They are functions, and have no state before each is in its piece: a contact behind a limiter would else let go
    under a force that the limiter does not let pass, and slide on. Where what they read depends on contacts in turn
    patterns recur, and all change together.
    """
    fired, latch = indices(guards.at_fired, guards.n_guards), indices(problem.at_latch_guard, guards.n_guards)
    tells, kept = indices(problem.at_blow_guard, guards.n_guards), 0
    for k in range(guards.n_fired):
        if tells[fired[k]] > 0 and latch[fired[k]] == 0:
            fired[kept] = fired[k]
            kept += 1
    guards.n_fired = kept if kept > 0 else guards.n_fired


@compiled
def event_is_due(run, point):
    """True if a time event follows at this instant: what rises until then says nothing of what rises behind it."""
    return run.crossed == 1 and run.landing == 1 and point.t < run.stop and point.t >= min(run.t_next, run.t_release)


@compiled
def looked_ahead(guards):
    """True if a guard is at its limit, so that all guards are looked at a little later, too."""
    g, tolerance, found = reals(guards.at_g, guards.n_guards), reals(guards.at_guard_tolerance, guards.n_guards), False
    for i in range(guards.n_guards):
        found = found or abs(g[i]) <= tolerance[i]
    return found


@compiled
def place_rounding(problem, point):
    """What places at which stops are met are known to: by rounding of places, and of a given one by that of the time.

    Without this a body that leaves a stop on a shaker, or late in a run, met it again at once, and left it, some times
    over.
    """
    position, y, known_to = indices(problem.at_position_of, problem.n), reals(point.at_y, problem.n), 0.0
    for v in range(problem.n):
        if position[v] >= 0:
            known_to = max(known_to, PLACE_ROUNDING * (abs(y[position[v]]) + abs(y[v] * point.t)))
    return known_to


@compiled
def look_ahead(problem, run, point, events):
    """Guards a little later, along (y', y''), into `g_probe`; algebraic unknowns move as the equations say.

    A contact held at its limit under a growing load and the same contact just sliding, under a load a hair
    below it, must not each send to the other. The slip of the one after a time d is the mean over that time of what
    the other's load is beyond its limit; so guards of slips are taken at d, all others at d/2. And d is the same for
    all zones of a settlement. Where no guard is known for a slip, forces alone are taken at d/2.
    """
    guards, settling = events.guards, events.settling
    if settling.lookahead == 0.0:
        settling.lookahead = max(distance_of_lookahead(run, point), settling.least_lookahead)
    if problem.weighs_guards == 0:
        move_ahead(point, settling.lookahead, 0.5 * settling.lookahead)
        evaluate_guards(problem, run, guards, point.t + settling.lookahead, point.at_y_probe, guards.at_g_probe)
        return
    inertia, probe = reals(guards.at_guard_inertia, problem.n_guards), reals(guards.at_g_probe, problem.n_guards)
    late = reals(guards.at_g_later, problem.n_guards)
    move_ahead(point, settling.lookahead, settling.lookahead)
    evaluate_guards(problem, run, guards, point.t + settling.lookahead, point.at_y_probe, guards.at_g_later)
    move_ahead(point, 0.5 * settling.lookahead, 0.5 * settling.lookahead)
    evaluate_guards(problem, run, guards, point.t + 0.5 * settling.lookahead, point.at_y_probe, guards.at_g_probe)
    for i in range(problem.n_guards):
        if inertia[i] > 0.0:
            probe[i] = late[i]


@compiled
def move_ahead(point, d, forces):
    """Set `y_probe` to the point moved by the time d along (y', y''), algebraic unknowns by the time `forces`."""
    n = point.n
    y, slope, later = reals(point.at_y, n), reals(point.at_slope, n), reals(point.at_y_probe, n)
    curvature, differential = reals(point.at_curvature, n), indices(point.at_differential, n)
    for k in range(n):
        if differential[k] == 1:
            later[k] = y[k] + d * (slope[k] + 0.5 * d * curvature[k])
        else:
            later[k] = y[k] + forces * curvature[k]


@compiled
def distance_of_lookahead(run, point):
    """How far ahead: NUDGE weights, but no further than y'' leaves y' its direction, nor than 1e-6 of the span."""
    n = point.n
    slope, curvature, rate = reals(point.at_slope, n), reals(point.at_curvature, n), reals(point.at_u, n)
    differential = indices(point.at_differential, n)
    for k in range(n):
        rate[k] = curvature[k] if differential[k] == 0 else 0.0
    of_forces = weighted_norm(point, point.at_u)
    for k in range(n):
        rate[k] = slope[k] if differential[k] == 1 else 0.0
    of_motions = weighted_norm(point, point.at_u)
    for k in range(n):
        rate[k] = curvature[k] if differential[k] == 1 else 0.0
    of_slopes = weighted_norm(point, point.at_u)
    distance = 1e-6 * (run.stop - run.start)
    if max(of_forces, of_motions) > 0.0:
        distance = min(distance, NUDGE / max(of_forces, of_motions))
    if of_motions > 0.0 and of_slopes > 0.0:
        distance = min(distance, of_motions / of_slopes)
    return max(distance, 1e-13 * abs(point.t))


@compiled
def fall_from_start(problem, run, point, events):
    """True if every guard in `fired` decreases along (y', y'') from the point, as it was settled.

    Or does not rise there, and is below zero at the end of the step: it decreases by its third derivative.
    """
    guards, ng = events.guards, events.guards.n_guards
    look_ahead(problem, run, point, events)
    g, probe, end = reals(guards.at_g, ng), reals(guards.at_g_probe, ng), reals(guards.at_g_end, ng)
    tolerance, fired = reals(guards.at_guard_tolerance, ng), indices(guards.at_fired, ng)
    falling = True
    for k in range(guards.n_fired):
        change, seen = probe[fired[k]] - g[fired[k]], RISE * tolerance[fired[k]]
        falling = falling and (change < -seen or (change <= seen and end[fired[k]] < 0.0))
    return falling
