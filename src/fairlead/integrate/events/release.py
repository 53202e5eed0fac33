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

by its acceleration and by that of what is given, above the rounding of what a force that changes would give by itself,
and is caught where that comes back to zero. In a level above, which takes no time beside it, it cannot be caught; when
its level is taken off, its slip is none beside the slips of the level below, but its zone remains.

Ties. Who is within the tolerance of its guard of a limit at which another lets go, and still rises, goes with it.

What remains when all levels are off is the outcome. With stiction equal to sliding the outcome depends on no order
(Gauss's principle of least constraint, a convex problem for given normal forces), and settling.py finds it faster; so
this is done where some contact falls, and only when more than one of them is at its limit.

At the start of a run nothing was before: forces that hold are built up from zero, on bodies that do not yet accelerate.
"""

from __future__ import annotations

from fairlead.integrate.codes import DONE, LEVELS
from fairlead.integrate.events.consistent import find_residual, prepare_consistent
from fairlead.integrate.events.fast_way import (
    NOT_REACHED,
    TIE,
    find_reached,
    first_reached,
    go_along,
    hardly_changes,
    look_along,
)
from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.events.patterns import remember_pattern
from fairlead.integrate.events.violators import RISE
from fairlead.integrate.linear.products import add_mass_times, inertia_of
from fairlead.integrate.linear.systems import solve_checked
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, mass_at, reals
from fairlead.integrate.point.controller import weigh, weighted_norm


@compiled
def order_matters(problem, events):
    """True if more than one contact is in doubt, and friction of one of them falls where it lets go."""
    guards = events.guards
    if problem.falling == 0 or events.loads.ordered == 1:
        return False
    fired, machine = indices(guards.at_fired, problem.n_guards), indices(problem.at_guard_machine, problem.n_guards)
    falls, may_hold = indices(problem.at_falls, problem.n_machines), indices(problem.at_may_hold, problem.n_guards)
    for k in range(guards.n_fired):
        if may_hold[fired[k]] > 0 and falls[machine[fired[k]]] == 1:
            return True
    zones = indices(problem.at_zones, problem.n_machines)
    first = indices(events.settling.at_zones_history, problem.n_machines)
    fell = False
    for z in range(problem.n_machines):
        fell = fell or (falls[z] == 1 and zones[z] != first[z])
    return fell


@compiled
def remember(problem, point, loads):
    """Keep the point just before a jump: unknowns, zones, and the load f."""
    if problem.falling == 1:
        copy(reals(point.at_y, problem.n), reals(loads.at_y_before, problem.n))
        copy(indices(problem.at_zones, problem.n_machines), indices(loads.at_zones_just_before, problem.n_machines))
        field_at(problem.call_rhs, (problem.context, point.t, point.at_y, loads.at_f_before))
        problem.rhs += 1


@compiled
def add_ties(problem, run, point, events):
    """Contacts whose friction falls and that come to their limits with one in `fired`, within a tolerance, go too."""
    guards, settling = events.guards, events.settling
    ng = problem.n_guards
    fired, machine = indices(guards.at_fired, ng), indices(problem.at_guard_machine, ng)
    may_hold = indices(problem.at_may_hold, ng)
    falls, here = indices(problem.at_falls, problem.n_machines), reals(settling.at_wrong, ng)
    tolerance = reals(guards.at_guard_tolerance, ng)
    g, g_end, asked = reals(guards.at_g, ng), reals(guards.at_g_end, ng), False
    for k in range(guards.n_fired):
        asked = asked or (may_hold[fired[k]] > 0 and falls[machine[fired[k]]] == 1)
    if not asked:
        return
    evaluate_guards(problem, run, guards, point.t, point.at_y, settling.at_wrong)
    first = guards.n_fired
    for i in range(ng):
        ties = may_hold[i] > 0 and falls[machine[i]] == 1 and here[i] >= -tolerance[i]
        if ties and g_end[i] - g[i] > RISE * tolerance[i]:
            new = True
            for k in range(first):
                new = new and fired[k] != i
            if new:
                fired[guards.n_fired] = i
                guards.n_fired += 1


@compiled
def begin_release(problem, point, linear, events):
    """Back to the forces just before, with the zones in force: the load between is out.

    Who is in doubt is asked again on the way, also when other pivots are needed first.
    """
    guards, settling, loads = events.guards, events.settling, events.loads
    guards.n_fired = 0
    nothing = loads.nothing_before == 1
    status = from_nothing(problem, point) if nothing else accelerations_before(problem, point, linear, events)
    if status != DONE:
        return status
    born, slips = indices(loads.at_born, guards.n_guards), reals(loads.at_fast_slip, guards.n_guards)
    for i in range(guards.n_guards):
        born[i], slips[i] = 0, 0.0
    copy(indices(settling.at_zones, settling.n_machines), indices(settling.at_zones_before, settling.n_machines))
    loads.levels = 0
    loads.level_due = 1
    loads.ordered = 1
    loads.fastest = 0.0
    return DONE


@compiled
def from_nothing(problem, point):
    """At the start: nothing holds yet, and nothing accelerates."""
    y, slope = reals(point.at_y, problem.n), reals(point.at_slope, problem.n)
    holder = indices(problem.at_holder, problem.n)
    for k in range(problem.n):
        slope[k] = 0.0
        if holder[k] >= 0:
            y[k] = 0.0
    return DONE


@compiled
def accelerations_before(problem, point, linear, events):
    """Put the algebraic unknowns and the accelerations of the point just before into the point.

    C dx = f - M y' of that point and its zones; the unknowns were consistent there up to the error of a step.
    """
    matrices, loads = linear.matrices, events.loads
    n = problem.n
    zones = indices(problem.at_zones, problem.n_machines)
    now = indices(events.settling.at_zones_before, problem.n_machines)
    y, after, before = reals(point.at_y, n), reals(point.at_y_probe, n), reals(loads.at_y_before, n)
    slope, differential = reals(point.at_slope, n), indices(problem.at_differential, n)
    minus_rate = reals(point.at_v, n)
    copy(zones, now)
    copy(y, after)
    copy(indices(loads.at_zones_just_before, problem.n_machines), zones)
    copy(before, y)
    mass_at(problem.call_mass, (problem.context, matrices.at_mass))
    status = prepare_consistent(problem, point, linear)
    if status == DONE:
        copy(reals(loads.at_f_before, n), reals(point.at_x, n))
        for k in range(n):
            minus_rate[k] = -slope[k] if differential[k] == 1 else 0.0
        add_mass_times(matrices, point.at_v, point.at_x)
        status = solve_checked(linear, point.at_x)
    change = reals(point.at_x, n)
    copy(now, zones)
    for k in range(n):
        if differential[k] == 1:
            y[k] = after[k]
        elif status == DONE:
            y[k] += change[k]
        if differential[k] == 1 and status == DONE:
            slope[k] += change[k]
    return status


@compiled
def release(m):
    """Build up the load until somebody changes zone (`fired`), or all of it is in (no levels are left)."""
    problem, run, point, linear, matrices, events = m.problem, m.run, m.point, m.linear, m.linear.matrices, m.events
    guards, settling, loads = m.events.guards, m.events.settling, m.events.loads
    mass_at(problem.call_mass, (problem.context, matrices.at_mass))
    status = prepare_consistent(problem, point, linear)
    if status != DONE:
        return status
    weigh(point, point.at_y)
    if loads.level_due == 1:
        open_level(problem, point, matrices, events)
    while loads.levels > 0:
        top = loads.levels - 1
        if reals(loads.at_left, LEVELS)[top] < TIE:
            close_level(problem, loads)
            continue
        copy(reals(loads.at_out + 8 * top * problem.n, problem.n), reals(point.at_x, problem.n))
        status = solve_checked(linear, point.at_x)
        if status != DONE:
            return status
        guards.n_fired = 0
        loads.fastest = max(loads.fastest, acceleration_by_forces(problem, point, matrices))
        look_along(problem, run, point, events)
        s = NOT_REACHED if hardly_changes(point) else first_reached(problem, events)
        go_along(problem, point, events, min(s, 1.0))
        if s <= 1.0:
            find_reached(problem, run, point, events)
            if guards.n_fired > 0:
                loads.level_due = 1
                return DONE
            settling.passes += 1  # a limit that is no straight line was not quite reached
            remember_pattern(run, settling)
            if settling.passes >= run.max_passes:
                loads.levels = 0
        else:
            close_level(problem, loads)
    return DONE


@compiled
def open_level(problem, point, matrices, events):
    """What the laws now in force jump by, beside what is out already, is a load of its own."""
    loads = events.loads
    n = problem.n
    zones = indices(problem.at_zones, problem.n_machines)
    before = indices(events.settling.at_zones_before, problem.n_machines)
    holder, born = indices(problem.at_holder, n), indices(loads.at_born, problem.n_guards)
    machine = indices(problem.at_guard_machine, problem.n_guards)
    slips = reals(loads.at_fast_slip, problem.n_guards)
    find_residual(problem, point, matrices, point.at_x)
    r = reals(point.at_x, n)
    circle, circle_changed = indices(problem.at_circle, n), indices(loads.at_circle_changed, n)
    for k in range(n):
        circle_changed[k] = 0
    for k in range(n):
        if holder[k] >= 0 and circle[k] > 0 and zones[holder[k]] != before[holder[k]]:
            circle_changed[circle[k] - 1] = 1
    for level in range(loads.levels):
        out = reals(loads.at_out + 8 * level * n, n)
        for k in range(n):
            own_changed = holder[k] >= 0 and zones[holder[k]] != before[holder[k]]
            if own_changed or (circle[k] > 0 and circle_changed[circle[k] - 1] == 1):
                out[k] = 0.0
            r[k] -= out[k]
    for i in range(problem.n_guards):
        if machine[i] >= 0 and zones[machine[i]] != before[machine[i]]:
            born[i], slips[i] = 0, 0.0
    copy(zones, before)
    if loads.levels < LEVELS:
        copy(r, reals(loads.at_out + 8 * loads.levels * n, n))
        reals(loads.at_left, LEVELS)[loads.levels] = 1.0
        loads.levels += 1
    else:
        top = reals(loads.at_out + 8 * (LEVELS - 1) * n, n)
        for k in range(n):
            top[k] += r[k]
    loads.level_due = 0


@compiled
def acceleration_by_forces(problem, point, matrices):
    """The largest acceleration, weighted, that one of the forces that change on the way x would give by itself.

    Where contacts hold, accelerations are the rounding of these, and tell of no slip.
    """
    n = problem.n
    way, to_weigh = reals(point.at_x, n), reals(point.at_u, n)
    starts, rows = indices(matrices.at_jacobian_starts, n + 1), indices(matrices.at_jacobian_rows, matrices.n_jacobian)
    values, is_speed = reals(matrices.at_jacobian, matrices.n_jacobian), indices(problem.at_is_speed, n)
    differential = indices(problem.at_differential, n)
    for k in range(n):
        to_weigh[k] = 0.0
    for k in range(n):
        if differential[k] == 0 and way[k] != 0.0:
            for p in range(starts[k], starts[k + 1]):
                if is_speed[rows[p]] == 1:
                    to_weigh[rows[p]] = max(to_weigh[rows[p]], abs(values[p] * way[k]))
    for k in range(n):
        if to_weigh[k] > 0.0:
            inertia = inertia_of(matrices, k)
            to_weigh[k] = to_weigh[k] / inertia if inertia > 0.0 else 0.0
    return weighted_norm(point, point.at_u)


@compiled
def close_level(problem, loads):
    """Take the uppermost level off: beside the slips of the one below, those that began in it are none."""
    born, slips = indices(loads.at_born, problem.n_guards), reals(loads.at_fast_slip, problem.n_guards)
    for i in range(problem.n_guards):
        if born[i] == loads.levels:
            born[i], slips[i] = 0, 0.0
    loads.levels -= 1
