"""Guards that are the least of several values: below zero at both ends of a trial step, and above it between.

They are looked for where the part remembers that all had risen (`Facts.least_guard`).

Each value is smooth, but their least has an edge where two of them meet, and that is its top. The cubic of bumps.py is
far below it. The tangents at both ends meet above it, and at it where the values are straight. So that place is asked;
if the guard is below zero there, its tangent takes the place of that of the end from which it still rises, or to which
it already falls (cutting planes: Kelley, J. SIAM 8:703, 1960). It is given up where the tangents, and a share more for
what they do not see, meet below zero.
"""

from __future__ import annotations

from fairlead.integrate.events.bumps import NEAR, UNSEEN_BUMP, floor_of
from fairlead.integrate.events.guards import guards_at
from fairlead.integrate.events.limits import AT_LIMIT
from fairlead.integrate.memory.foreign import compiled, indices, reals

MOST_TANGENTS = 20
"""Places that one guard is asked at: the bracket of two straight values ends with the first, of curved ones it shrinks
with the square of its width."""


@compiled
def find_edge(m, h, before):
    """The first place s below `before` found at which the least of several values is not below zero, else `before`."""
    guards = m.events.guards
    ng = guards.n_guards
    least, tolerance = indices(m.problem.at_least_guard, ng), reals(guards.at_guard_tolerance, ng)
    g, end = reals(guards.at_g, ng), reals(guards.at_g_end, ng)
    early, late = reals(guards.at_g_early, ng), reals(guards.at_g_late, ng)
    found = before
    for i in range(ng):
        if least[i] == 1 and g[i] <= AT_LIMIT * tolerance[i] and end[i] < 0.0:
            rise, fall = (early[i] - g[i]) / NEAR, (end[i] - late[i]) / NEAR
            if rise > 0.0 and fall < 0.0:
                found = min(found, place_above(m, h, i, rise, fall))
    return found


@compiled
def place_above(m, h, i, rise, fall):
    """A place between the ends at which guard i, with these slopes there, is not below zero; 1 if none is found."""
    guards = m.events.guards
    ng = guards.n_guards
    probe, floor = reals(guards.at_g_probe, ng), floor_of(guards, i)
    a, ga, b, gb = 0.0, reals(guards.at_g, ng)[i], 1.0, reals(guards.at_g_end, ng)[i]
    for _ in range(MOST_TANGENTS):
        x = a + (gb - ga - fall * (b - a)) / (rise - fall)
        top = ga + rise * (x - a)
        if top + UNSEEN_BUMP * (top - max(ga, gb)) < floor:
            return 1.0
        nearest = NEAR * (b - a)
        x = min(max(x, a + nearest), b - 2.0 * nearest)
        guards_at(m, x, h, guards.at_g_probe)
        here = probe[i]
        if here >= floor:
            return x
        guards_at(m, x + nearest, h, guards.at_g_probe)
        beside = probe[i]
        if beside >= floor:
            return x + nearest
        slope = (beside - here) / nearest
        if slope > 0.0:
            a, ga, rise = x, here, slope
        elif slope < 0.0:
            b, gb, fall = x + nearest, beside, slope
        else:
            return 1.0
    return 1.0
