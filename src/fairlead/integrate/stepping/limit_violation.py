"""Violations of limits inside a step, by contacts that hold at its start: overloads that no mean force shows.

A force that holds is a mean over the step. Between the middles of steps it may swing through its limit and back,
or reach it: a contact that lets go inside a step lets go for all of it or not at all. Neither shows in the
motion of the steps before, so neither is in their error. With the force and its distance from the limit, g, of
the last three points:

    peak      between two points a smooth force goes beyond both by about an eighth of its second difference.
              An excess e, on an inertia m, moves it by e h^2/m in the step, and by e/k if a stiffness k takes it up
    start     a force that grows with rate r and comes to its limit d before the end, or after the start, of the
              step that does not know: the speed is wrong by r d^2/(2 m)

And of a law that comes into force inside the step by a position, as a rope that comes taut: the middle knows half of
its force, or none of it where it comes into force there. What is left over at the end tells (`unseen_force`).
"""

from __future__ import annotations

from fairlead.integrate.memory.foreign import compiled, field_at, indices, reals
from fairlead.integrate.stepping.jump_at_end import SMOOTH
from fairlead.integrate.stepping.response import error_of_peak, error_of_speed

BEYOND = 0.25
"""Share of the second difference that a force may go beyond what was seen of it. A parabola goes beyond by 1/8. What
swings with omega, seen at c = cos(omega h/2) of its peak on both sides of it, goes beyond by 1/(4 c (1 + c)) of the
second difference at the nearer of these points: by less than 1/4 as long as a period takes 3.5 steps."""
HELD_THROUGH = 2
"""Steps a contact must have held through for its force to have a second difference."""
ONCE = 10.0
"""Weights that a contact may hide of a kind whose laws are continuous where they let go: it does so once, where a
step's own error comes in every step. With one weight a chain of 100 took 1.4 times the steps at accuracy 1e-5, to the
same error. Where friction falls as it lets go, what is hidden is all that follows, not a small slip: one weight."""


@compiled
def unseen_slip(point, matrices, guards, stepping, h):
    """Largest error, in weights, that an unseen overload may have caused; the unknown it is in to `worst`."""
    rule, exchange, contacts = stepping.rule, stepping.exchange, stepping.contacts
    g, g_end = reals(guards.at_g, guards.n_guards), reals(guards.at_g_end, guards.n_guards)
    is_limit = indices(contacts.at_limit_guard, guards.n_guards)
    machine = indices(guards.at_guard_machine, guards.n_guards)
    hold_row, rested = indices(contacts.at_hold_row, exchange.n_machines), indices(contacts.at_rested, point.n)
    holds = indices(exchange.at_holds, point.n)
    tolerance = reals(guards.at_guard_tolerance, guards.n_guards)
    smooth = indices(contacts.at_kind_is_smooth, exchange.n_machines)
    kind = indices(contacts.at_own_kind, exchange.n_machines)
    largest = 0.0
    near, between = rule.gap + 0.5 * h, 0.5 * (rule.gap + 0.5 * h + rule.gap_before)
    per_near, per_before, per_between = 1.0 / near, 1.0 / rule.gap_before, 1.0 / between
    for i in range(guards.n_guards):
        z = machine[i]
        if is_limit[i] == 0 or z < 0 or hold_row[z] < 0 or rested[hold_row[z]] < HELD_THROUGH:
            continue
        k = hold_row[z]
        rate, curve = course_of_force(guards, stepping, h, i, k, per_near, per_before, per_between)
        error = 0.0
        if holds[k] == 1:
            peak = max(g[i], g_end[i]) + BEYOND * h * h * curve
            if peak > tolerance[i] and abs(rate) <= curve * (rule.gap + 0.5 * h):
                error = error_of_peak(point, matrices, contacts, h, z, peak)
            over_at_end = g_end[i] + 0.5 * h * (rate + 0.5 * curve * (rule.gap + h))
            if rate > 0.0 and over_at_end > tolerance[i]:
                lasting = min(over_at_end / rate, h)
                error = max(error, error_of_speed(point, matrices, contacts, h, z, over_at_end, lasting))
        else:
            over_at_start = -(g[i] + rate * rule.gap)
            if rate > 0.0 and over_at_start > tolerance[i] and over_at_start < h * rate:
                error = error_of_speed(point, matrices, contacts, h, z, over_at_start, over_at_start / rate)
        if smooth[kind[z]] == SMOOTH:
            error /= ONCE
        if error > largest:
            largest = error
            point.worst = k
    return largest


@compiled
def unseen_force(m, h):
    """Largest error, in weights, of what holds at the end of a step in which a law came into force by a position.

    The mean force that holds knows half of what such a law has come to at the end, or nothing. A body whose contact
    cannot hold what is left over there has moved meanwhile: by F h^2/(24 m) at most, F beyond either limit, if the law
    grows evenly from the middle of the step on (docs/stepping.md). Twice that counts.
    """
    problem, point, contacts = m.problem, m.point, m.stepping.contacts
    zones = indices(problem.at_zones, problem.n_machines)
    before = indices(contacts.at_zones_at_start, problem.n_machines)
    hold_row = indices(contacts.at_hold_row, problem.n_machines)
    holds = indices(m.stepping.exchange.at_holds, problem.n)
    changed = False
    for z in range(problem.n_machines):
        changed = changed or (zones[z] != before[z] and hold_row[z] < 0)
    if not changed:
        return 0.0
    field_at(problem.call_forces, (problem.context, point.t + h, point.at_y_end, point.at_x))
    problem.rhs += 1
    left_over, g_end = reals(point.at_x, problem.n), reals(m.events.guards.at_g_end, problem.n_guards)
    first = indices(contacts.at_first_guard, problem.n_machines)
    machine = indices(problem.at_guard_machine, problem.n_guards)
    is_limit = indices(contacts.at_limit_guard, problem.n_guards)
    bodies = indices(contacts.at_body_starts, problem.n_machines + 1)
    speed = indices(contacts.at_body_speed, contacts.n_body_speed)
    largest = 0.0
    for z in range(problem.n_machines):
        if hold_row[z] < 0 or holds[hold_row[z]] == 0 or bodies[z] == bodies[z + 1]:
            continue
        over, i = 0.0, first[z]
        for e in range(bodies[z], bodies[z + 1]):
            over = max(over, abs(left_over[speed[e]]))
        furthest = 0.0
        while i < problem.n_guards and machine[i] == z:
            if is_limit[i] == 1:
                furthest = max(furthest, -g_end[i])
            i += 1
        if over > furthest:
            error = error_of_peak(point, m.linear.matrices, contacts, h, z, over - furthest) / 12.0
            if error > largest:
                largest = error
                point.worst = hold_row[z]
    return largest


@compiled
def course_of_force(guards, stepping, h, i, k, per_near, per_before, per_between):
    """Rate of the distance from limit i, which row k comes to, and the size of its second derivative.

    By the middles of the last three steps; right after a settlement by the slope of the force there. A contact that
    has just let go has no force of its own any more: the rate is that before. The last three arguments are one over
    the distances of these middles, and over their mean.
    """
    rule = stepping.rule
    slope, before = reals(rule.at_mean_slope, rule.n), reals(rule.at_slope_before, rule.n)
    holds = indices(stepping.exchange.at_holds, rule.n)
    g_before, g = reals(stepping.contacts.at_g_before, guards.n_guards), reals(guards.at_g, guards.n_guards)
    g_end = reals(guards.at_g_end, guards.n_guards)
    if rule.gap == 0.0:
        return abs(before[k]), abs(slope[k] - before[k]) / h
    earlier = (g[i] - g_before[i]) * per_before
    if holds[k] == 0:
        return earlier, 0.0
    rate = (g_end[i] - g[i]) * per_near
    return rate, max(abs(slope[k] - before[k]), abs(rate - earlier)) * per_between
