"""Guards that are below zero at both ends of a trial step and may rise to it between.

A guard that leaves the start upwards or comes to the end downwards may have a top inside: it may fall first and then
rise and fall, or rise, fall and rise. Where the cubic through its ends and slopes has a top that may reach zero, the
top is looked for by parabolas:

    a < x < b     three places, x above both others: the next is the top of the parabola through them
    a < b         no such place is known: that of the parabola that leaves the higher end by its slope, to the other
    given up      where the parabola, and as much again for what it does not see, stays below zero
    found         where zero is reached; locate() then closes in on the way up to there

An evaluation gives all guards at once, and elements that lie side by side swing alike. So all that may reach zero are
followed together: the next place is the earliest that any of them asks for, and each takes from it what it tells of its
own top. Followed one by one, 800 elements of a line were evaluated sixty times in a step.

What asks for a place behind one already found is left: if it reaches zero before that place, it is above zero there.
"""

from __future__ import annotations

from math import inf, sqrt

from fairlead.integrate.events.guards import guards_at
from fairlead.integrate.events.limits import AT_LIMIT
from fairlead.integrate.events.violators import RISE, look_ahead
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals

NEAR = 2.0**-10
"""Distance in s over which the slope of a guard at an end of the step is taken."""
HIGHEST = 4.0 / 27.0
"""Largest value of x (1 - x)^2, which is how far a cubic rises above its ends for a unit of slope at one of them."""
UNSEEN_BUMP = 0.25
"""Share of a bump that may be missing from the cubic through its ends."""
MOST_PLACES = 9
"""Places that one guard asks for before it counts as one that does not reach zero."""
ALIKE = 0.05
"""Share of a bracket by which a place may lie beside the one that was asked for, and do."""
TOO_NEAR, TOO_NEAR_ASKED = 0.1, 1e-3
"""Share of a bracket that a place has to lie beside its top to be taken as a new end of it; the same of one that was
asked for. Slopes over less would be those of rounding."""


@compiled
def find_earliest_bump(m, h):
    """The first interior point (s) found at which a guard negative at both ends is not; 1 if none.

    A guard at its limit that falls by y' and y'' of the point, as settled, and is below it at the end does not rise:
    the interpolant of a long step is rough at its start.
    """
    run, guards = m.run, m.events.guards
    ng = guards.n_guards
    end = reals(guards.at_g_end, ng)
    g, early, late = reals(guards.at_g, ng), reals(guards.at_g_early, ng), reals(guards.at_g_late, ng)
    tolerance, later = reals(guards.at_guard_tolerance, ng), reals(guards.at_g_later, ng)
    below = False
    for i in range(ng):
        below = below or (g[i] <= AT_LIMIT * tolerance[i] and end[i] < 0.0)
    if not below:
        return 1.0
    guards_at(m, 1.0 - NEAR, h, guards.at_g_late)
    followed, looked = 0, False
    for i in range(ng):
        rise, fall = (early[i] - g[i]) / NEAR, (end[i] - late[i]) / NEAR
        if g[i] <= AT_LIMIT * tolerance[i] and end[i] < 0.0 and (rise > 0.0 or fall < 0.0):
            higher_end = max(g[i], end[i])
            if higher_end + (1.0 + UNSEEN_BUMP) * HIGHEST * (max(rise, 0.0) + max(-fall, 0.0)) < 0.0:
                continue
            if rise > 0.0 and run.judged == 1 and g[i] >= -AT_LIMIT * tolerance[i]:
                if not looked:
                    look_ahead(m.problem, run, m.point, m.events)
                    copy(reals(guards.at_g_probe, ng), later)
                    looked = True
                if g[i] - later[i] > RISE * tolerance[i]:
                    continue
            top, height = hermite_top(g[i], end[i], rise, fall)
            if 0.0 < top < 1.0 and height + UNSEEN_BUMP * (height - higher_end) >= 0.0:
                follow(guards, followed, i, top, rise, fall)
                followed += 1
    return climb(m, h, followed) if followed > 0 else 1.0


@compiled
def hermite_top(g0, g1, s0, s1):
    """Where, and how high, the top of the cubic with these end values and slopes is; at 1 where it has none inside.

    Its slope s0 + 2 p x + 3 q x^2 has one root at which it falls; the formula that does not subtract what is alike
    holds for q of either sign, and for none, where the slopes are s0 > 0 > s1. With s0 < 0 the top lies behind a dip.
    """
    p, q = 3.0 * (g1 - g0) - 2.0 * s0 - s1, s0 + s1 - 2.0 * (g1 - g0)
    discriminant = p * p - 3.0 * q * s0
    if discriminant < 0.0 and not s0 > 0.0 > s1:
        return 1.0, g1
    root = sqrt(max(discriminant, 0.0)) - p
    x = s0 / root if s0 * root > 0.0 else 1.0
    x = min(x, 1.0)
    return x, g0 + x * (s0 + x * (p + x * q))


@compiled
def follow(guards, k, i, top, rise, fall):
    """Guard i is the k-th to be followed, from a first guess of where its top is and its slopes at the ends."""
    ng = guards.n_guards
    left, left_g = reals(guards.at_bump_left, ng), reals(guards.at_bump_left_g, ng)
    right, right_g = reals(guards.at_bump_right, ng), reals(guards.at_bump_right_g, ng)
    middle, asked = reals(guards.at_bump_top, ng), reals(guards.at_bump_asks, ng)
    which, places = indices(guards.at_bump_guard, ng), indices(guards.at_bump_places, ng)
    which[k], places[k] = i, 0
    reals(guards.at_bump_rise, ng)[k], reals(guards.at_bump_fall, ng)[k] = rise, fall
    left[k], left_g[k] = 0.0, reals(guards.at_g, ng)[i]
    right[k], right_g[k] = 1.0, reals(guards.at_g_end, ng)[i]
    middle[k], asked[k] = -1.0, min(max(top, NEAR), 1.0 - NEAR)


@compiled
def climb(m, h, followed):
    """Follow so many guards to their tops together; the first place at which one reaches zero, else 1."""
    guards = m.events.guards
    ng = guards.n_guards
    asked, probe = reals(guards.at_bump_asks, ng), reals(guards.at_g_probe, ng)
    which, places = indices(guards.at_bump_guard, ng), indices(guards.at_bump_places, ng)
    found = 1.0
    while True:
        x = found
        for k in range(followed):
            x = min(x, asked[k])
        if x >= found:
            return found
        guards_at(m, x, h, guards.at_g_probe)
        for k in range(followed):
            if asked[k] >= found:
                continue
            if probe[which[k]] >= floor_of(guards, which[k]):
                found = x
                break
            if is_asked_for(guards, k, x):
                places[k] += 1
            narrow_bracket(guards, k, x, probe[which[k]])
            if places[k] >= MOST_PLACES:
                asked[k] = 1.0


@compiled
def is_asked_for(guards, k, x):
    """Whether x is as good as the place that the k-th guard asks for."""
    ng = guards.n_guards
    width = reals(guards.at_bump_right, ng)[k] - reals(guards.at_bump_left, ng)[k]
    return abs(reals(guards.at_bump_asks, ng)[k] - x) <= ALIKE * width


@compiled
def floor_of(guards, i):
    """What guard i has to reach: zero; its tolerance, if it is the limit of a load or begins at zero within that.

    A load that tops out at its limit is held (limits.py), and hides nothing that follows it in the step. Just switched,
    a guard is at its limit within rounding: there, only a bump that leaves its tolerance is a crossing and not the
    error of the interpolant.
    """
    ng = guards.n_guards
    tolerance, limit = reals(guards.at_guard_tolerance, ng), indices(guards.at_limit_guard, ng)
    return tolerance[i] if limit[i] == 1 or reals(guards.at_g, ng)[i] >= -tolerance[i] else 0.0


@compiled
def narrow_bracket(guards, k, x, value):
    """What the k-th guard that is followed has at x: a narrower bracket, and the next place it asks for; 1 for none."""
    ng = guards.n_guards
    left, left_g = reals(guards.at_bump_left, ng), reals(guards.at_bump_left_g, ng)
    right, right_g = reals(guards.at_bump_right, ng), reals(guards.at_bump_right_g, ng)
    top, top_g, asked = reals(guards.at_bump_top, ng), reals(guards.at_bump_top_g, ng), reals(guards.at_bump_asks, ng)
    own, floor = is_asked_for(guards, k, x), floor_of(guards, indices(guards.at_bump_guard, ng)[k])
    if top[k] < 0.0 and value <= max(left_g[k], right_g[k]):
        if own:
            asked[k] = keep_higher_side(guards, k, x, value, floor)
        return
    if top[k] < 0.0:
        top[k], top_g[k] = x, value
    else:
        beside = (TOO_NEAR_ASKED if own else TOO_NEAR) * (right[k] - left[k])
        if not left[k] < x < right[k] or abs(x - top[k]) < beside:
            return
        higher, behind = value > top_g[k], x > top[k]
        if higher == behind:  # a new left end: the top so far, or this place
            left[k], left_g[k] = (top[k], top_g[k]) if higher else (x, value)
        else:
            right[k], right_g[k] = (top[k], top_g[k]) if higher else (x, value)
        if higher:
            top[k], top_g[k] = x, value
    asked[k] = next_place(left[k], left_g[k], top[k], top_g[k], right[k], right_g[k], floor)


@compiled
def keep_higher_side(guards, k, x, value, floor):
    """Keep that side of x on which the parabola from an end, by its slope there, to x is higher; its top, or 1.

    Where x is not above an end, the top that the slope there promises is on the way to x. An end that is cut off here
    has no known slope, and promises none.
    """
    ng = guards.n_guards
    left, left_g = reals(guards.at_bump_left, ng), reals(guards.at_bump_left_g, ng)
    right, right_g = reals(guards.at_bump_right, ng), reals(guards.at_bump_right_g, ng)
    rise, fall = reals(guards.at_bump_rise, ng), reals(guards.at_bump_fall, ng)
    way, up = top_after_end(left_g[k], rise[k], value, x - left[k])
    back, up_there = top_after_end(right_g[k], -fall[k], value, right[k] - x)
    if max(left_g[k] + 2.0 * up, right_g[k] + 2.0 * up_there) < floor:
        return 1.0
    if left_g[k] + up >= right_g[k] + up_there:
        place = left[k] + way
        right[k], right_g[k], fall[k] = x, value, 0.0
    else:
        place = right[k] - back
        left[k], left_g[k], rise[k] = x, value, 0.0
    nearest = NEAR * (right[k] - left[k])
    return min(max(place, left[k] + nearest), right[k] - nearest)


@compiled
def top_after_end(g, slope, value, way):
    """How far from an end, and how much above it, the parabola with this slope there is highest; none above: -inf."""
    if value > g or slope <= 0.0:
        return 0.0, -inf
    return 0.5 * slope * way * way / (slope * way + g - value), 0.25 * (slope * way) ** 2 / (slope * way + g - value)


@compiled
def next_place(a, ga, x, gx, b, gb, floor):
    """The top of the parabola through three places, well inside and not at x; 1 where it stays below the floor."""
    p = (b - x) * (gx - ga)
    q = (x - a) * (gb - gx)
    if not p - q > 0.0:
        return 1.0
    left, right = (gx - ga) / (x - a), (gb - gx) / (b - x)
    slope, curve = (left * (b - x) + right * (x - a)) / (b - a), (left - right) / (b - a)
    # The parabola through the points rises above the middle one by slope^2/(4 curve); what it does not see, no more.
    if gx + 0.5 * slope * slope / curve < floor:
        return 1.0
    new = 0.5 * (p * (x + b) - q * (a + x)) / (p - q)
    new = min(max(new, a + 0.1 * (x - a)), b - 0.1 * (b - x))
    if abs(new - x) < 1e-3 * (b - a):
        new = x + (1e-2 * (b - x) if b - x > x - a else -1e-2 * (x - a))
    return new
