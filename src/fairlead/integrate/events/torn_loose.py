"""Held contacts that contradict each other: the first to come to its limit lets go.

A block is held by the ground and rubs on a belt that turns round. As the belt stands still both contacts are without
slip, and then belt and ground move apart. Contacts of a circle share what contradicts them by the least sum of squares,
as they share forces: the block moves at a mean of the motions, and every contact slips. If all were to let go of it,
the belt might take it along, though the ground could have held it.

A rigid contact is the limit of a stiff one. As equal springs the contacts would be stretched by just these slips v,
and their forces would grow with them, F = F_0 + v s, in a time as short as one likes. The guard g of the limit of a
force is a straight line on that way, and the first limit to be reached is that of the least

    s = -g / (dg/ds)                of guards that rise

It lets go, and those that tie with it; the others are asked again. With which forces F_0 one begins does not matter, as
long as they balance: they differ by what the contacts of a ring can be braced against each other, which is how they
grow. What has no limit never is the first. Rigid rows that contradict each other are the matter of given_apart.py.

So after every pass of a settlement, before forces are judged, slips are looked at a little later.
"""

from __future__ import annotations

from fairlead.integrate.events.fast_way import TIE
from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.events.limits import AT_LIMIT
from fairlead.integrate.events.violators import RISE, distance_of_lookahead, event_is_due, move_ahead
from fairlead.integrate.memory.foreign import compiled, indices, reals, slip_at

ROUNDING = 1e-6
"""Share of the largest slip in a circle below which another is rounding."""
DYING_OUT = 2e3
"""Share of itself that a slip left by rounding loses by the second in a row that holds, twice over: that row is
d(v_rel)/dt = -v_rel/tau with tau = 1 ms."""
NOWHERE = 1e300
"""How far what has no limit is from it."""


@compiled
def tear_first(m):
    """True if held contacts of circles contradict each other; the first of each circle to let go is in `fired` then.

    After half of the passes that a settlement is allowed, as with the order of release, guards decide as in any other.
    """
    problem, settling, guards = m.problem, m.events.settling, m.events.guards
    if problem.call_drift == 0 or problem.has_circles == 0 or event_is_due(m.run, m.point):
        return False
    if settling.passes >= m.run.max_passes // 2 or not find_contradictions(problem, m.point, find_slips(m)):
        return False
    grow_forces(problem, m.run, m.point, guards)
    fire_first(problem, m.point, guards)
    return guards.n_fired > 0


@compiled
def find_slips(m):
    """Slips of held rows a little later, into v, zero where they only die out; what rounding of them comes to.

    A slip that is at zero to rounding counts as none: it may be on either side. A larger one has yet to come to zero,
    soon, in the zone that it is in.
    """
    problem, run, point, guards, settling = m.problem, m.run, m.point, m.events.guards, m.events.settling
    if settling.lookahead == 0.0:
        settling.lookahead = max(distance_of_lookahead(run, point), settling.least_lookahead)
    move_ahead(point, settling.lookahead, settling.lookahead)
    slip_at(problem.call_drift, (problem.context, point.t, point.at_y, point.at_x))
    slip_at(problem.call_drift, (problem.context, point.t + settling.lookahead, point.at_y_probe, point.at_v))
    now, slip = reals(point.at_x, problem.n), reals(point.at_v, problem.n)
    holding, limit = indices(problem.at_may_hold, guards.n_guards), indices(guards.at_limit_guard, guards.n_guards)
    least, none, tolerance = NOWHERE, 0.0, reals(guards.at_guard_tolerance, guards.n_guards)
    for i in range(guards.n_guards):
        if holding[i] > 0 and limit[i] == 0:
            least, none = min(least, RISE * tolerance[i]), max(none, AT_LIMIT * tolerance[i])
    for k in range(problem.n):
        grows = abs(slip[k] - now[k]) > least + DYING_OUT * settling.lookahead * abs(now[k])
        of_now = 0.0 if abs(now[k]) <= none else now[k]
        slip[k] = now[k] - slip[k] - of_now if grows else 0.0  # the callback gives -v_rel
    return least


@compiled
def find_contradictions(problem, point, least):
    """True if more than one row of a circle slips; of other circles, and of rounding, slips are zero in v then.

    Of one row alone what it follows has jumped. The largest slip of each circle is in b.
    """
    n, found = problem.n, False
    circle, slip = indices(problem.at_circle, n), reals(point.at_v, n)
    largest, count = reals(point.at_b, n), reals(point.at_x, n)
    for k in range(n):
        largest[k], count[k] = 0.0, 0.0
    for k in range(n):
        if circle[k] > 0:
            largest[circle[k] - 1] = max(largest[circle[k] - 1], abs(slip[k]))
    for k in range(n):
        c = circle[k] - 1
        if c < 0 or largest[c] <= least or abs(slip[k]) <= ROUNDING * largest[c]:
            slip[k] = 0.0
        else:
            count[c] += 1.0
    for k in range(n):
        if slip[k] != 0.0 and count[circle[k] - 1] < 2.0:
            slip[k] = 0.0
        found = found or slip[k] != 0.0
    return found


@compiled
def grow_forces(problem, run, point, guards):
    """Guards at the point into `g`, and where forces of circles have grown with their slips into `g_probe`.

    By the largest force of their circle, or its weight, for the largest slip of it: circles have no body in common.
    """
    n = problem.n
    circle, slip, largest = indices(problem.at_circle, n), reals(point.at_v, n), reals(point.at_b, n)
    grows, y, probe = indices(problem.at_grows_with_slip, n), reals(point.at_y, n), reals(point.at_y_probe, n)
    weight, size = reals(point.at_weight, n), reals(point.at_u, n)
    for k in range(n):
        size[k] = 0.0
    for k in range(n):
        if circle[k] > 0 and grows[k] != 0:
            size[circle[k] - 1] = max(size[circle[k] - 1], max(abs(y[k]), weight[k]))
    for k in range(n):
        c = circle[k] - 1
        probe[k] = y[k] + (grows[k] * slip[k] / largest[c] * size[c] if slip[k] != 0.0 else 0.0)
    evaluate_guards(problem, run, guards, point.t, point.at_y, guards.at_g)
    evaluate_guards(problem, run, guards, point.t, point.at_y_probe, guards.at_g_probe)


@compiled
def fire_first(problem, point, guards):
    """Into `fired` the limits that the forces of each circle reach first on that way."""
    n, ng = problem.n, guards.n_guards
    circle, first = indices(problem.at_circle, n), reals(point.at_x, n)
    row, fired = indices(problem.at_bounded_row, ng), indices(guards.at_fired, ng)
    for k in range(n):
        first[k] = NOWHERE
    for i in range(ng):
        if row[i] >= 0 and circle[row[i]] > 0:
            c = circle[row[i]] - 1
            first[c] = min(first[c], way_to_limit(guards, i))
    guards.n_fired = 0
    for i in range(ng):
        if row[i] >= 0 and circle[row[i]] > 0:
            way = way_to_limit(guards, i)
            if way < NOWHERE and way <= first[circle[row[i]] - 1] + TIE:
                fired[guards.n_fired] = i
                guards.n_fired += 1


@compiled
def way_to_limit(guards, i):
    """How far on its way a force is when it comes to the limit of guard i; NOWHERE if it does not."""
    here, there = reals(guards.at_g, guards.n_guards)[i], reals(guards.at_g_probe, guards.n_guards)[i]
    if not there - here > RISE * reals(guards.at_guard_tolerance, guards.n_guards)[i]:
        return NOWHERE
    return -here / (there - here)
