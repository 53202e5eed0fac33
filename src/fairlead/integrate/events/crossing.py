"""Where in a trial step the first guard fires.

Trigger rule: a guard fires on (t0, t1] when it is below zero at t0 and at or above zero at t1; exactly zero at t0 does
not fire. A guard that starts at zero and dips below it counts as below from there on. Double crossing: below zero at
both ends, where the cubic through ends and slopes has a top between them: it is tested (bumps.py; edges.py where it is
the least of several values), as where a force that presses passes through zero (corners.py). Inconsistent start: a
guard above its tolerance that never was below zero means that the zones at t0 were wrong (the caller settles there).
The limit of a force that holds fires where it goes on beyond its tolerance: a load that comes to its limit and no
further is held (limits.py).
Zero at t0 is what a settlement counts as at a limit (limits.AT_LIMIT): the slip of a contact that has just broken
away is 1e-20 m/s of either sign, and the sign must not tell whether the contact stops again or never slipped.

All is judged on the interpolant, in s = (t - t0)/h, for the whole vector of guards at once.
"""

from __future__ import annotations

from fairlead.integrate.events.bumps import NEAR, find_earliest_bump
from fairlead.integrate.events.corners import find_corner
from fairlead.integrate.events.edges import find_edge
from fairlead.integrate.events.guards import guards_at
from fairlead.integrate.events.limits import AT_LIMIT, weigh_limits
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals
from fairlead.integrate.point.illinois import LEFT, RIGHT, shares_of_ends

NONE, CROSSING, INCONSISTENT_START = 0, 1, 2
ALWAYS = 2.0
"""A place s, beyond the end of the step, up to which a guard counts as below zero that does so in the whole of it."""


@compiled
def find_first_crossing(m, h):
    """NONE, CROSSING (at `run.cut_at`, guards in `fired`) or INCONSISTENT_START (guards in `fired`)."""
    guards = m.events.guards
    ng = guards.n_guards
    guards.n_fired = 0
    if ng == 0:
        return NONE
    g, end = reals(guards.at_g, ng), reals(guards.at_g_end, ng)
    early, left, right = reals(guards.at_g_early, ng), reals(guards.at_g_left, ng), reals(guards.at_g_right, ng)
    tolerance = reals(guards.at_guard_tolerance, ng)
    weigh_limits(m.problem, guards, m.point.at_y_end)
    guards_at(m, 1.0, h, guards.at_g_end)
    guards_at(m, NEAR, h, guards.at_g_early)
    right_end = 1.0
    crossed = False
    since = reals(guards.at_g_since, ng)
    for i in range(ng):
        left[i], since[i] = g[i], 0.0
        if g[i] >= -AT_LIMIT * tolerance[i]:
            left[i] = early[i] if early[i] < -AT_LIMIT * tolerance[i] else max(g[i], 0.0)
            since[i] = NEAR if left[i] < 0.0 else 0.0
    copy(end, right)
    bump = find_earliest_bump(m, h)
    if m.problem.n_least > 0:
        bump = find_edge(m, h, bump)
    if m.problem.n_pressing > 0:
        bump = find_corner(m, h, bump)
    if bump < 1.0:
        right_end = bump
        guards_at(m, bump, h, guards.at_g_right)
    leave_ties(guards)
    unseen = overlooked(guards)
    if unseen and not look_further(m, h, right_end):
        found = look_closer(m, h)
        if found < right_end:
            right_end = found
            crossed = True
    for i in range(ng):
        crossed = crossed or (left[i] < 0.0 and right[i] >= 0.0)
    m.run.cut_at = 1.0
    copy(right, reals(guards.at_g_late, ng))
    if crossed:
        locate(m, h, right_end)
    return collect_fired(guards, crossed)


@compiled
def leave_ties(guards):
    """Limits of what holds that end the bracket at zero within their tolerance count as below: a tie holds.

    They are beyond zero by rounding, or by so little that a step later tells; what goes on from there fires there.
    """
    ng = guards.n_guards
    left, right = reals(guards.at_g_left, ng), reals(guards.at_g_right, ng)
    tolerance, since = reals(guards.at_guard_tolerance, ng), reals(guards.at_g_since, ng)
    limit = indices(guards.at_limit_guard, ng)
    for i in range(ng):
        if limit[i] == 1 and left[i] < 0.0 <= right[i] <= tolerance[i]:
            right[i], since[i] = left[i], ALWAYS


@compiled
def overlooked(guards):
    """True if some guard is above its tolerance at the end and was not seen below zero."""
    ng = guards.n_guards
    left, end, tolerance = reals(guards.at_g_left, ng), reals(guards.at_g_end, ng), reals(guards.at_guard_tolerance, ng)
    found = False
    for i in range(ng):
        found = found or (left[i] >= 0.0 and end[i] > tolerance[i])
    return found


@compiled
def look_further(m, h, right_end):
    """Look for a dip that has not left the limit by NEAR in guards that start at zero; True if there is one.

    A slip that has just begun grows with the square of time, or slower; it may be over before the step is.
    """
    guards = m.events.guards
    ng = guards.n_guards
    left, end = reals(guards.at_g_left, ng), reals(guards.at_g_end, ng)
    probe, tolerance = reals(guards.at_g_probe, ng), reals(guards.at_guard_tolerance, ng)
    since = reals(guards.at_g_since, ng)
    s, found = 2.0 * NEAR, False
    while s < right_end and not found:
        guards_at(m, s, h, guards.at_g_probe)
        for i in range(ng):
            if left[i] >= 0.0 and end[i] > tolerance[i] and probe[i] < -AT_LIMIT * tolerance[i]:
                left[i], since[i] = probe[i], s
                found = True
        s *= 2.0
    return found


@compiled
def look_closer(m, h):
    """Look for a dip shorter than NEAR in guards that start at zero; s by which it is over, 2 if none."""
    guards = m.events.guards
    ng = guards.n_guards
    left, right = reals(guards.at_g_left, ng), reals(guards.at_g_right, ng)
    early, probe = reals(guards.at_g_early, ng), reals(guards.at_g_probe, ng)
    tolerance, since = reals(guards.at_guard_tolerance, ng), reals(guards.at_g_since, ng)
    copy(early, reals(guards.at_g_late, ng))
    outer = NEAR
    while outer > 1e-13:
        inner = 0.125 * outer
        guards_at(m, inner, h, guards.at_g_probe)
        found = False
        for i in range(ng):
            if left[i] >= 0.0 and probe[i] < -AT_LIMIT * tolerance[i]:
                left[i], since[i] = probe[i], inner
                found = True
        if found:
            copy(reals(guards.at_g_late, ng), right)
            return outer
        copy(probe, reals(guards.at_g_late, ng))
        outer = inner
    return 2.0


@compiled
def collect_fired(guards, crossed):
    """Fill `fired` from the bracket: crossings, unless a guard is positive that never was negative."""
    ng = guards.n_guards
    left, right = reals(guards.at_g_left, ng), reals(guards.at_g_right, ng)
    tolerance = reals(guards.at_guard_tolerance, ng)
    fired = indices(guards.at_fired, ng)
    for i in range(ng):
        if left[i] >= 0.0 and right[i] > tolerance[i]:
            fired[guards.n_fired] = i
            guards.n_fired += 1
    if guards.n_fired > 0:
        return INCONSISTENT_START
    if not crossed:
        return NONE
    for i in range(ng):
        if left[i] < 0.0 and right[i] >= 0.0:
            fired[guards.n_fired] = i
            guards.n_fired += 1
    return CROSSING


@compiled
def locate(m, h, right_end):
    """Close a bracket on the earliest crossing to rounding in t; `run.cut_at` is its right-hand end.

    The rule of Illinois (point/illinois.py) on the whole vector: the next point is the
    earliest secant root of all guards that cross in the bracket, so the first of them is found
    without locating the others; a point that does not shrink the bracket well is followed by a
    bisection.

    Kinks are located as closely as jumps. A step that went past one would leave what follows a table by a stiff law
    behind by the difference of two pieces: 1e-5 m/s, which a bond of 1e9 N s/m shows as 10 kN.
    """
    point, guards = m.point, m.events.guards
    ng = guards.n_guards
    left, right, probe = reals(guards.at_g_left, ng), reals(guards.at_g_right, ng), reals(guards.at_g_probe, ng)
    since = reals(guards.at_g_since, ng)
    a, b = 0.0, right_end
    of_left, of_right, last = 1.0, 1.0, 0
    closeness = max(4e-16 * max(abs(point.t), abs(point.t + h)) / h, 4e-16)
    width, slow = b - a, 0
    while b - a > closeness:
        x = b
        for i in range(ng):
            if left[i] < 0.0 and right[i] >= 0.0:
                ga, gb = of_left * left[i], of_right * right[i]
                x = min(x, b - (b - a) * (gb / (gb - ga)))
        if slow >= 3:
            x = 0.5 * (a + b)
            slow = 0
        x = min(max(x, a + 0.5 * closeness), b - 0.5 * closeness)
        if not a < x < b:
            break
        guards_at(m, x, h, guards.at_g_probe)
        crossed = False
        for i in range(ng):
            if x < since[i]:
                probe[i] = left[i]
            crossed = crossed or (left[i] < 0.0 and probe[i] >= 0.0)
        moved = RIGHT if crossed else LEFT
        if crossed:
            b = x
            copy(probe, right)
        else:
            a = x
            copy(probe, left)
        of_left, of_right = shares_of_ends(of_left, of_right, last, moved)
        last = moved
        slow = slow + 1 if b - a > 0.5 * width else 0
        width = b - a
    m.run.cut_at = b
