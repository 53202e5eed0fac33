"""The order of release: which held contacts let go when a load jumps, where friction falls as it lets go.

An instant has no order, but a load that jumps was built up before it jumped. So between the point just before, x0, and
full load the forces are built up in a fast time in which positions stand still and slips start from zero:

    C x = r - (load that is still out),        x = (y', algebraic y),   C, r of the zones in force

Let out[1] be what is still out at first. Along  C dx = out[1]  x goes linearly to full load, until a guard of a contact
rises through zero. The contact changes its zone, which changes the equations: what its law jumps by,

    out[2] = r - C x - out[1]                  without the rows that changed their meaning

(of the contact, and of all that may close a circle with it: there a row says how they share what they hold)
is a load too, and comes in before the rest of out[1] does, in a time that is fast beside that time. So levels of load
lie one on another. A level that is all in is taken off, and the one below goes on, with C of the zones now in force.

Slips. In a level of its own, whoever slips since a time s slips by

    integral of the rate of its guard over the time of the level

and is caught where that comes back to zero. In a level above, which takes no time beside it, it cannot be caught; when
its level is taken off, its slip is none beside the slips of the level below, but its zone remains.

Ties. Who is within the tolerance of its guard of a limit at which another lets go, and still rises, goes with it.

What remains when all levels are off is the outcome. With stiction equal to sliding the outcome depends on no order
(Gauss's principle of least constraint, a convex problem for given normal forces), and settling.py finds it faster; so
this is done where some contact falls, and only when more than one of them is at its limit.

At the start of a run nothing was before: forces that hold are built up from zero, on bodies that do not yet accelerate.
"""

from __future__ import annotations

from math import sqrt

from fairlead.integrate.codes import LEVELS
from fairlead.integrate.controller import weigh, weighted_norm
from fairlead.integrate.foreign import compiled, copy, field_at, indices, mass_at, reals
from fairlead.integrate.guards import evaluate_guards
from fairlead.integrate.linear import DONE, add_mass_times, solve_watched
from fairlead.integrate.start import prepare_consistent, residual_here

NUDGE, RISE = 1e-3, 1e-6
"""How far, in weights, speeds are moved to see a guard rise; the rise, in its tolerances, that is above rounding."""
NEVER = 2.0
"""Share of the way after which nothing is reached: there are only shares up to 1."""
TIE = 1e-6
"""Shares of the way that count as one, of slips that come to zero; change of forces, in weights, that is none."""


@compiled
def order_matters(m):
    """True if more than one contact is in doubt, and friction of one of them falls where it lets go."""
    if m.falling == 0 or m.ordered == 1:
        return False
    fired, machine = indices(m.at_fired, m.n_guards), indices(m.at_guard_machine, m.n_guards)
    falls, may_hold = indices(m.at_falls, m.n_zones), indices(m.at_may_hold, m.n_guards)
    for k in range(m.n_fired):
        if may_hold[fired[k]] > 0 and falls[machine[fired[k]]] == 1:
            return True
    zones, first = indices(m.at_zones, m.n_zones), indices(m.at_zones_history, m.n_zones)
    fell = False
    for z in range(m.n_zones):
        fell = fell or (falls[z] == 1 and zones[z] != first[z])
    return fell


@compiled
def remember(m):
    """Keep the point just before a jump: unknowns, zones, and the load f."""
    if m.falling == 1:
        copy(reals(m.at_y, m.n), reals(m.at_y_before, m.n))
        copy(indices(m.at_zones, m.n_zones), indices(m.at_zones_just_before, m.n_zones))
        field_at(m.call_rhs, (m.context, m.t, m.at_y, m.at_f_before))
        m.rhs += 1


@compiled
def add_ties(m):
    """Contacts whose friction falls and that come to their limits with one in `fired`, within a tolerance, go too."""
    ng = m.n_guards
    fired, machine, may_hold = indices(m.at_fired, ng), indices(m.at_guard_machine, ng), indices(m.at_may_hold, ng)
    falls, here, tolerance = indices(m.at_falls, m.n_zones), reals(m.at_wrong, ng), reals(m.at_guard_tolerance, ng)
    g, g_end, asked = reals(m.at_g, ng), reals(m.at_g_end, ng), False
    for k in range(m.n_fired):
        asked = asked or (may_hold[fired[k]] > 0 and falls[machine[fired[k]]] == 1)
    if not asked:
        return
    evaluate_guards(m, m.t, m.at_y, m.at_wrong)
    first = m.n_fired
    for i in range(ng):
        ties = may_hold[i] > 0 and falls[machine[i]] == 1 and here[i] >= -tolerance[i]
        if ties and g_end[i] - g[i] > RISE * tolerance[i]:
            new = True
            for k in range(first):
                new = new and fired[k] != i
            if new:
                fired[m.n_fired] = i
                m.n_fired += 1


@compiled
def begin_release(m):
    """Back to the forces just before, with the zones in force: the load between is out.

    Who is in doubt is asked again on the way, also when other pivots are needed first.
    """
    m.n_fired = 0
    status = from_nothing(m) if m.nothing_before == 1 else accelerations_before(m)
    if status != DONE:
        return status
    born, slips = indices(m.at_born, m.n_guards), reals(m.at_fast_slip, m.n_guards)
    for i in range(m.n_guards):
        born[i], slips[i] = 0, 0.0
    copy(indices(m.at_zones, m.n_zones), indices(m.at_zones_before, m.n_zones))
    m.levels = 0
    m.level_due = 1
    m.ordered = 1
    m.fastest = 0.0
    return DONE


@compiled
def from_nothing(m):
    """At the start: nothing holds yet, and nothing accelerates."""
    y, slope, holder = reals(m.at_y, m.n), reals(m.at_slope, m.n), indices(m.at_holder, m.n)
    for k in range(m.n):
        slope[k] = 0.0
        if holder[k] >= 0:
            y[k] = 0.0
    return DONE


@compiled
def accelerations_before(m):
    """Put the algebraic unknowns and the accelerations of the point just before into the point.

    C dx = f - M y' of that point and its zones; the unknowns were consistent there up to the error of a step.
    """
    n = m.n
    zones, now = indices(m.at_zones, m.n_zones), indices(m.at_zones_before, m.n_zones)
    y, after, before = reals(m.at_y, n), reals(m.at_y_probe, n), reals(m.at_y_before, n)
    slope, v, differential = reals(m.at_slope, n), reals(m.at_v, n), indices(m.at_differential, n)
    copy(zones, now)
    copy(y, after)
    copy(indices(m.at_zones_just_before, m.n_zones), zones)
    copy(before, y)
    mass_at(m.call_mass, (m.context, m.at_mass))
    status = prepare_consistent(m)
    if status == DONE:
        copy(reals(m.at_f_before, n), reals(m.at_x, n))
        for k in range(n):
            v[k] = -slope[k] if differential[k] == 1 else 0.0
        add_mass_times(m, m.at_v, m.at_x)
        status = solve_watched(m, m.at_x)
    x = reals(m.at_x, n)
    copy(now, zones)
    for k in range(n):
        if differential[k] == 1:
            y[k] = after[k]
        elif status == DONE:
            y[k] += x[k]
        if differential[k] == 1 and status == DONE:
            slope[k] += x[k]
    return status


@compiled
def release(m):
    """Build up the load until somebody changes zone (`fired`), or all of it is in (no levels are left)."""
    mass_at(m.call_mass, (m.context, m.at_mass))
    status = prepare_consistent(m)
    if status != DONE:
        return status
    weigh(m, m.at_y)
    if m.level_due == 1:
        open_level(m)
    while m.levels > 0:
        top = m.levels - 1
        if reals(m.at_left, LEVELS)[top] < TIE:
            close_level(m)
            continue
        copy(reals(m.at_out + 8 * top * m.n, m.n), reals(m.at_x, m.n))
        status = solve_watched(m, m.at_x)
        if status != DONE:
            return status
        m.n_fired = 0
        look_along(m)
        s = NEVER if hardly_changes(m) else first_reached(m)
        go_along(m, min(s, 1.0))
        if s <= 1.0:
            find_reached(m)
            if m.n_fired > 0:
                m.level_due = 1
                return DONE
            m.passes += 1  # a limit that is no straight line was not quite reached
            if m.passes >= m.max_passes:
                m.levels = 0
        else:
            close_level(m)
    return DONE


@compiled
def open_level(m):
    """What the laws now in force jump by, beside what is out already, is a load of its own."""
    n = m.n
    zones, before = indices(m.at_zones, m.n_zones), indices(m.at_zones_before, m.n_zones)
    holder, born = indices(m.at_holder, n), indices(m.at_born, m.n_guards)
    machine = indices(m.at_guard_machine, m.n_guards)
    slips = reals(m.at_fast_slip, m.n_guards)
    residual_here(m, m.at_x)
    r = reals(m.at_x, n)
    in_circle, circle_changed = indices(m.at_in_circle, n), False
    for k in range(n):
        if holder[k] >= 0 and in_circle[k] == 1:
            circle_changed = circle_changed or zones[holder[k]] != before[holder[k]]
    for level in range(m.levels):
        out = reals(m.at_out + 8 * level * n, n)
        for k in range(n):
            own_changed = holder[k] >= 0 and zones[holder[k]] != before[holder[k]]
            if own_changed or (circle_changed and in_circle[k] == 1):
                out[k] = 0.0
            r[k] -= out[k]
    for i in range(m.n_guards):
        if machine[i] >= 0 and zones[machine[i]] != before[machine[i]]:
            born[i], slips[i] = 0, 0.0
    copy(zones, before)
    if m.levels < LEVELS:
        copy(r, reals(m.at_out + 8 * m.levels * n, n))
        reals(m.at_left, LEVELS)[m.levels] = 1.0
        m.levels += 1
    else:
        top = reals(m.at_out + 8 * (LEVELS - 1) * n, n)
        for k in range(n):
            top[k] += r[k]
    m.level_due = 0


@compiled
def close_level(m):
    """Take the uppermost level off: beside the slips of the one below, those that began in it are none."""
    born, slips = indices(m.at_born, m.n_guards), reals(m.at_fast_slip, m.n_guards)
    for i in range(m.n_guards):
        if born[i] == m.levels:
            born[i], slips[i] = 0, 0.0
    m.levels -= 1


@compiled
def hardly_changes(m):
    """True if no force changes by more than rounding on the way x, as where a law goes over without a jump."""
    x, u, differential = reals(m.at_x, m.n), reals(m.at_u, m.n), indices(m.at_differential, m.n)
    for k in range(m.n):
        u[k] = 0.0 if differential[k] == 1 else x[k]
    return weighted_norm(m, m.at_u) <= TIE


@compiled
def look_along(m):
    """Guards at both ends of the way x, and their rates in the fast time there, by the slips of the accelerations."""
    n, ng = m.n, m.n_guards
    x, y, slope = reals(m.at_x, n), reals(m.at_y, n), reals(m.at_slope, n)
    probe, u, fast = reals(m.at_y_probe, n), reals(m.at_u, n), indices(m.at_is_speed, n)
    largest = 0.0
    for end in range(2):
        for k in range(n):
            u[k] = (slope[k] + end * x[k]) if fast[k] == 1 else 0.0
        largest = max(largest, weighted_norm(m, m.at_u))
    m.fastest = max(largest, m.fastest)
    largest = max(largest, TIE * m.fastest)  # what is so much slower than all before is rounding
    d = NUDGE / largest if largest > 0.0 else 1.0
    differential = indices(m.at_differential, n)
    tolerance = reals(m.at_guard_tolerance, ng)
    for end in range(2):
        at_g, at_rate = (m.at_g, m.at_rate) if end == 0 else (m.at_g_probe, m.at_rate_end)
        for k in range(n):
            probe[k] = y[k] + (end * x[k] if differential[k] == 0 else 0.0)
        evaluate_guards(m, m.t, m.at_y_probe, at_g)
        for k in range(n):
            if fast[k] == 1:
                probe[k] = y[k] + d * (slope[k] + end * x[k])
        evaluate_guards(m, m.t, m.at_y_probe, at_rate)
        g, rate = reals(at_g, ng), reals(at_rate, ng)
        for i in range(ng):
            rise = rate[i] - g[i]
            rate[i] = rise / d if abs(rise) > RISE * tolerance[i] else 0.0


@compiled
def first_reached(m):
    """Share of the way after which the first guard of a contact comes to zero; NEVER if none does."""
    may_hold, least = indices(m.at_may_hold, m.n_guards), NEVER
    for i in range(m.n_guards):
        if may_hold[i] > 0:
            least = min(least, min(reached_by_load(m, i), reached_by_slip(m, i)))
    return least


@compiled
def reached_by_load(m, i):
    """Share of the way after which the forces bring guard i to zero."""
    now, then = reals(m.at_g, m.n_guards)[i], reals(m.at_g_probe, m.n_guards)[i]
    tolerance = reals(m.at_guard_tolerance, m.n_guards)[i]
    if now >= 0.0:
        return 0.0 if then - now > RISE * tolerance else NEVER
    return now / (now - then) if now < 0.0 < then else NEVER


@compiled
def reached_by_slip(m, i):
    """Share of the way after which the fast slip brings guard i back to zero; of one that slips by more, NEVER."""
    born = indices(m.at_born, m.n_guards)[i]
    now, tolerance = reals(m.at_g, m.n_guards)[i], reals(m.at_guard_tolerance, m.n_guards)[i]
    if abs(now) > tolerance or 0 < born < m.levels:
        return NEVER
    slip = reals(m.at_fast_slip, m.n_guards)[i] / reals(m.at_left, LEVELS)[m.levels - 1]
    return first_root(slip, reals(m.at_rate, m.n_guards)[i], reals(m.at_rate_end, m.n_guards)[i])


@compiled
def first_root(value, rate, rate_end):
    """Where value + rate s + (rate_end - rate) s^2/2, at most zero at s = 0, rises through zero; NEVER beyond 1."""
    bend = rate_end - rate
    if value >= 0.0:
        if rate > 0.0 or (rate == 0.0 and bend > 0.0):
            return 0.0
        s = -2.0 * rate / bend if bend > 0.0 else NEVER
    else:
        under = rate * rate - 2.0 * bend * value
        if under < 0.0:
            return NEVER
        below = rate + sqrt(under)  # of the two roots that one where it rises
        s = -2.0 * value / below if below > 0.0 else NEVER
    return s if s <= 1.0 else NEVER


@compiled
def find_reached(m):
    """Fill `fired` with the guards of contacts that are reached here, and with those that tie with them."""
    ng, back = m.n_guards, indices(m.at_came_back, m.n_guards)
    g, g_end, here = reals(m.at_g, ng), reals(m.at_g_probe, ng), reals(m.at_wrong, ng)
    tolerance, fired, may_hold = reals(m.at_guard_tolerance, ng), indices(m.at_fired, ng), indices(m.at_may_hold, ng)
    evaluate_guards(m, m.t, m.at_y, m.at_wrong)
    for i in range(ng):
        if may_hold[i] == 0:
            continue
        rises = g_end[i] - g[i] > RISE * tolerance[i]
        if back[i] == 1 or (rises and here[i] >= -tolerance[i]):
            fired[m.n_fired] = i
            m.n_fired += 1


@compiled
def go_along(m, s):
    """Move by the share s of the way; add up the slips, and mark those that have come back to zero."""
    n, ng, top = m.n, m.n_guards, m.levels - 1
    x, y, slope, out = reals(m.at_x, n), reals(m.at_y, n), reals(m.at_slope, n), reals(m.at_out + 8 * top * n, n)
    g, tolerance, may_hold = reals(m.at_g, ng), reals(m.at_guard_tolerance, ng), indices(m.at_may_hold, ng)
    rate, rate_end, slips = reals(m.at_rate, ng), reals(m.at_rate_end, ng), reals(m.at_fast_slip, ng)
    born, back = indices(m.at_born, ng), indices(m.at_came_back, ng)
    left = reals(m.at_left, LEVELS)
    for i in range(ng):
        back[i] = 0
        if may_hold[i] > 0 and abs(g[i]) <= tolerance[i] and (born[i] == 0 or born[i] == m.levels):
            back[i] = 1 if reached_by_slip(m, i) <= s + TIE else 0
            slips[i] = min(slips[i] + left[top] * s * (rate[i] + 0.5 * s * (rate_end[i] - rate[i])), 0.0)
            born[i] = m.levels if slips[i] < 0.0 else 0
    differential = indices(m.at_differential, n)
    for k in range(n):
        if differential[k] == 1:
            slope[k] += s * x[k]
        else:
            y[k] += s * x[k]
        out[k] *= 1.0 - s
    left[top] *= 1.0 - s
