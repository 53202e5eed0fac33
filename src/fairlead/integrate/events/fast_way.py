"""The way on which a load is built up in no time: which guard it reaches first, and how far the point goes on it.

The way x = (change of y', change of algebraic y) leads from where the point is to where all of the uppermost level of
load is in (release.py). On it forces change linearly; slips are the integral of their rates over the time of the level.

    look_along       guards at both ends of the way, and their rates there
    first_reached    the share of the way after which the first guard of a contact comes to zero, by load or by slip
    go_along         the point, the load that is left, and the slips after a share of it
    find_reached     the guards that fire there
"""

from __future__ import annotations

from math import sqrt

from fairlead.integrate.codes import LEVELS
from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.events.violators import NUDGE, RISE
from fairlead.integrate.memory.foreign import compiled, indices, reals
from fairlead.integrate.point.controller import weighted_norm

NOT_REACHED = 2.0
"""Share of the way after which nothing is reached: there are only shares up to 1."""
TIE = 1e-6
"""Shares of the way that count as one, of slips that come to zero; change of forces, in weights, that is none."""


@compiled
def hardly_changes(point):
    """True if no force changes by more than rounding on the way x, as where a law goes over without a jump."""
    way, to_weigh = reals(point.at_x, point.n), reals(point.at_u, point.n)
    differential = indices(point.at_differential, point.n)
    for k in range(point.n):
        to_weigh[k] = 0.0 if differential[k] == 1 else way[k]
    return weighted_norm(point, point.at_u) <= TIE


@compiled
def look_along(problem, run, point, events):
    """Guards at both ends of the way x, and the rates of slips in the fast time there, by the accelerations.

    What is given accelerates as well; so slips are asked a little later, but limits are as they are at this instant.
    """
    guards, loads = events.guards, events.loads
    n, ng = problem.n, problem.n_guards
    way, y, slope = reals(point.at_x, n), reals(point.at_y, n), reals(point.at_slope, n)
    probe, to_weigh, fast = reals(point.at_y_probe, n), reals(point.at_u, n), indices(problem.at_is_speed, n)
    largest = 0.0
    for end in range(2):
        for k in range(n):
            to_weigh[k] = (slope[k] + end * way[k]) if fast[k] == 1 else 0.0
        largest = max(largest, weighted_norm(point, point.at_u))
    loads.fastest = max(largest, loads.fastest)
    largest = max(largest, TIE * loads.fastest)  # what is so much slower than all before is rounding
    d = NUDGE / largest if largest > 0.0 else 1.0
    differential = indices(problem.at_differential, n)
    tolerance, limit = reals(guards.at_guard_tolerance, ng), indices(guards.at_limit_guard, ng)
    for end in range(2):
        at_g, at_rate = (guards.at_g, loads.at_rate) if end == 0 else (guards.at_g_probe, loads.at_rate_end)
        for k in range(n):
            probe[k] = y[k] + (end * way[k] if differential[k] == 0 else 0.0)
        evaluate_guards(problem, run, guards, point.t, point.at_y_probe, at_g)
        for k in range(n):
            if fast[k] == 1:
                probe[k] = y[k] + d * (slope[k] + end * way[k])
        evaluate_guards(problem, run, guards, point.t + d, point.at_y_probe, at_rate)
        g, rate = reals(at_g, ng), reals(at_rate, ng)
        for i in range(ng):
            rise = rate[i] - g[i] if limit[i] == 0 else 0.0
            rate[i] = rise / d if abs(rise) > RISE * tolerance[i] else 0.0


@compiled
def first_reached(problem, events):
    """Share of the way after which the first guard of a contact comes to zero; NOT_REACHED if none does."""
    may_hold, least = indices(problem.at_may_hold, problem.n_guards), NOT_REACHED
    for i in range(problem.n_guards):
        if may_hold[i] > 0:
            least = min(least, min(reached_by_load(events.guards, i), reached_by_slip(events, i)))
    return least


@compiled
def reached_by_load(guards, i):
    """Share of the way after which the forces bring guard i to zero."""
    now, then = reals(guards.at_g, guards.n_guards)[i], reals(guards.at_g_probe, guards.n_guards)[i]
    tolerance = reals(guards.at_guard_tolerance, guards.n_guards)[i]
    if now >= 0.0:
        return 0.0 if then - now > RISE * tolerance else NOT_REACHED
    return now / (now - then) if now < 0.0 < then else NOT_REACHED


@compiled
def reached_by_slip(events, i):
    """Share of the way after which the fast slip brings guard i back to zero; NOT_REACHED if it slips by more."""
    guards, loads = events.guards, events.loads
    born = indices(loads.at_born, guards.n_guards)[i]
    now, tolerance = reals(guards.at_g, guards.n_guards)[i], reals(guards.at_guard_tolerance, guards.n_guards)[i]
    if abs(now) > tolerance or 0 < born < loads.levels:
        return NOT_REACHED
    slip = reals(loads.at_fast_slip, guards.n_guards)[i] / reals(loads.at_left, LEVELS)[loads.levels - 1]
    return first_root(slip, reals(loads.at_rate, guards.n_guards)[i], reals(loads.at_rate_end, guards.n_guards)[i])


@compiled
def first_root(value, rate, rate_end):
    """Where value + rate s + (rate_end - rate) s^2/2, at most zero at s = 0, rises through zero; else NOT_REACHED."""
    rise = rate_end - rate
    if value >= 0.0:
        if rate > 0.0 or (rate == 0.0 and rise > 0.0):
            return 0.0
        s = -2.0 * rate / rise if rise > 0.0 else NOT_REACHED
    else:
        under = rate * rate - 2.0 * rise * value
        if under < 0.0:
            return NOT_REACHED
        below = rate + sqrt(under)  # of the two roots that one where it rises
        s = -2.0 * value / below if below > 0.0 else NOT_REACHED
    return s if s <= 1.0 else NOT_REACHED


@compiled
def go_along(problem, point, events, s):
    """Move by the share s of the way; add up the slips, and mark those that have come back to zero."""
    guards, loads = events.guards, events.loads
    n, ng, top = problem.n, problem.n_guards, loads.levels - 1
    way, y, slope = reals(point.at_x, n), reals(point.at_y, n), reals(point.at_slope, n)
    out = reals(loads.at_out + 8 * top * n, n)
    g, tolerance = reals(guards.at_g, ng), reals(guards.at_guard_tolerance, ng)
    may_hold = indices(problem.at_may_hold, ng)
    rate, rate_end, slips = reals(loads.at_rate, ng), reals(loads.at_rate_end, ng), reals(loads.at_fast_slip, ng)
    born, back = indices(loads.at_born, ng), indices(loads.at_came_back, ng)
    left = reals(loads.at_left, LEVELS)
    for i in range(ng):
        back[i] = 0
        if may_hold[i] > 0 and abs(g[i]) <= tolerance[i] and (born[i] == 0 or born[i] == loads.levels):
            back[i] = 1 if reached_by_slip(events, i) <= s + TIE else 0
            slips[i] = min(slips[i] + left[top] * s * (rate[i] + 0.5 * s * (rate_end[i] - rate[i])), 0.0)
            born[i] = loads.levels if slips[i] < 0.0 else 0
    differential = indices(problem.at_differential, n)
    for k in range(n):
        if differential[k] == 1:
            slope[k] += s * way[k]
        else:
            y[k] += s * way[k]
        out[k] *= 1.0 - s
    left[top] *= 1.0 - s


@compiled
def find_reached(problem, run, point, events):
    """Fill `fired` with the guards of contacts that are reached here, and with those that tie with them."""
    guards, settling = events.guards, events.settling
    ng, back = problem.n_guards, indices(events.loads.at_came_back, problem.n_guards)
    g, g_end, here = reals(guards.at_g, ng), reals(guards.at_g_probe, ng), reals(settling.at_wrong, ng)
    tolerance, fired = reals(guards.at_guard_tolerance, ng), indices(guards.at_fired, ng)
    may_hold = indices(problem.at_may_hold, ng)
    evaluate_guards(problem, run, guards, point.t, point.at_y, settling.at_wrong)
    for i in range(ng):
        if may_hold[i] == 0:
            continue
        rises = g_end[i] - g[i] > RISE * tolerance[i]
        if back[i] == 1 or (rises and here[i] >= -tolerance[i]):
            fired[guards.n_fired] = i
            guards.n_fired += 1
