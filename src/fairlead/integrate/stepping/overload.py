"""What a step may miss of contacts that hold at its start: overloads that no mean force shows.

A force that holds is a mean over the step. Between the middles of steps it may swing through its limit and back,
or reach it: a contact that lets go inside a step lets go for all of it or not at all. Neither shows in the
motion of the steps before, so neither is in their error. With the force and its distance from the limit, g, of
the last three points:

    peak      between two points a smooth force goes beyond both by about an eighth of its second difference.
              An excess e, on an inertia m, moves it by e h^2/m in the step, and by e/k if a stiffness k takes it up
    start     a force that grows with rate r and comes to its limit d before the end, or after the start, of the
              step that does not know: the speed is wrong by r d^2/(2 m)

And of a law that comes into force inside the step by a position, as a rope that comes taut: the middle knows half of
its force, or none of it where it comes into force there. What is left over at the end tells.

A wrong speed is a wrong position later: by as much as 1/omega of what holds it back, k = m omega^2. Where
nothing does, it is measured by the weight of the speed itself.
"""

from __future__ import annotations

from math import sqrt

from fairlead.integrate.memory.foreign import compiled, field_at, indices, reals
from fairlead.integrate.stepping.jumps import SMOOTH

BEYOND = 0.25
"""Share of the second difference that a force may go beyond what was seen of it; twice what a parabola does."""
SEEN = 2
"""Steps a contact must have held through for its force to have a second difference."""
ONCE = 10.0
"""Weights that a contact may hide of a kind whose laws are continuous where they let go: it does so once, where a
step's own error comes in every step. With one weight a chain of 100 took 1.4 times the steps at accuracy 1e-5, to the
same error. Where friction falls as it lets go, what is hidden is all that follows, not a small slip: one weight."""
FREE = 1e300


@compiled
def unseen_slip(point, matrices, guards, stepping, h):
    """Largest error, in weights, that an unseen overload may have caused; the unknown it is in to `worst`."""
    rule, exchange, contacts = stepping.rule, stepping.exchange, stepping.contacts
    g, g_end = reals(guards.at_g, guards.n_guards), reals(guards.at_g_end, guards.n_guards)
    is_limit = indices(contacts.at_limit_guard, guards.n_guards)
    machine = indices(guards.at_guard_machine, guards.n_guards)
    rows, rested = indices(contacts.at_hold_row, exchange.n_zones), indices(contacts.at_rested, point.n)
    holds = indices(exchange.at_holds, point.n)
    tolerance = reals(guards.at_guard_tolerance, guards.n_guards)
    smooth = indices(contacts.at_kind_is_smooth, exchange.n_zones)
    kind = indices(contacts.at_own_kind, exchange.n_zones)
    largest = 0.0
    near, between = rule.gap + 0.5 * h, 0.5 * (rule.gap + 0.5 * h + rule.gap_before)
    per_near, per_before, per_between = 1.0 / near, 1.0 / rule.gap_before, 1.0 / between
    for i in range(guards.n_guards):
        z = machine[i]
        if is_limit[i] == 0 or z < 0 or rows[z] < 0 or rested[rows[z]] < SEEN:
            continue
        k = rows[z]
        rate, curve = course_of_force(guards, stepping, h, i, k, per_near, per_before, per_between)
        error = 0.0
        if holds[k] == 1:
            peak = max(g[i], g_end[i]) + BEYOND * h * h * curve
            if peak > tolerance[i] and abs(rate) <= curve * (rule.gap + 0.5 * h):
                error = error_of_peak(point, matrices, contacts, h, z, peak)
            ahead = g_end[i] + 0.5 * h * (rate + 0.5 * curve * (rule.gap + h))
            if rate > 0.0 and ahead > tolerance[i]:
                error = max(error, error_of_speed(point, matrices, contacts, h, z, ahead, min(ahead / rate, h)))
        else:
            behind = -(g[i] + rate * rule.gap)
            if rate > 0.0 and behind > tolerance[i] and behind < h * rate:
                error = error_of_speed(point, matrices, contacts, h, z, behind, behind / rate)
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
    cannot hold what is left over there has moved meanwhile: by up to F h^2/(12 m), F beyond either limit.
    """
    problem, point, contacts = m.problem, m.point, m.stepping.contacts
    zones, before = indices(problem.at_zones, problem.n_zones), indices(contacts.at_zones_at_start, problem.n_zones)
    rows, holds = indices(contacts.at_hold_row, problem.n_zones), indices(m.stepping.exchange.at_holds, problem.n)
    changed = False
    for z in range(problem.n_zones):
        changed = changed or (zones[z] != before[z] and rows[z] < 0)
    if not changed:
        return 0.0
    field_at(problem.call_forces, (problem.context, point.t + h, point.at_y_end, point.at_x))
    problem.rhs += 1
    f, g_end = reals(point.at_x, problem.n), reals(m.events.guards.at_g_end, problem.n_guards)
    first = indices(contacts.at_first_guard, problem.n_zones)
    machine = indices(problem.at_guard_machine, problem.n_guards)
    is_limit = indices(contacts.at_limit_guard, problem.n_guards)
    bodies = indices(contacts.at_body_starts, problem.n_zones + 1)
    speed = indices(contacts.at_body_speed, contacts.n_body_speed)
    largest = 0.0
    for z in range(problem.n_zones):
        if rows[z] < 0 or holds[rows[z]] == 0 or bodies[z] == bodies[z + 1]:
            continue
        over, i = 0.0, first[z]
        for e in range(bodies[z], bodies[z + 1]):
            over = max(over, abs(f[speed[e]]))
        furthest = 0.0
        while i < problem.n_guards and machine[i] == z:
            if is_limit[i] == 1:
                furthest = max(furthest, -g_end[i])
            i += 1
        if over > furthest:
            error = error_of_peak(point, m.linear.matrices, contacts, h, z, over - furthest) / 12.0
            if error > largest:
                largest = error
                point.worst = rows[z]
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
    early, g = reals(guards.at_g_early, guards.n_guards), reals(guards.at_g, guards.n_guards)
    g_end = reals(guards.at_g_end, guards.n_guards)
    if rule.gap == 0.0:
        return abs(before[k]), abs(slope[k] - before[k]) / h
    earlier = (g[i] - early[i]) * per_before
    if holds[k] == 0:
        return earlier, 0.0
    rate = (g_end[i] - g[i]) * per_near
    return rate, max(abs(slope[k] - before[k]), abs(rate - earlier)) * per_between


@compiled
def response_of(matrices, x, v, inertia):
    """1/omega of what holds back the position x with the speed v and this inertia; FREE without one."""
    starts = indices(matrices.at_jacobian_starts, matrices.n + 1)
    rows = indices(matrices.at_jacobian_rows, matrices.n_jacobian)
    slopes = reals(matrices.at_jacobian, matrices.n_jacobian)
    for p in range(starts[x], starts[x + 1]):
        if rows[p] == v and slopes[p] < 0.0:
            return sqrt(-inertia / slopes[p])
    return FREE


@compiled
def error_of_peak(point, matrices, contacts, h, z, over):
    """What an excess force inside the step may move, in weights; of an unknown inertia: the force itself.

    Of several bodies that machine z holds the one that is moved most counts: which is named first is chance.
    """
    weight, inertia = reals(point.at_weight, point.n), reals(contacts.at_held_inertia, contacts.n_zones)[z]
    bodies = indices(contacts.at_body_starts, contacts.n_zones + 1)
    position = indices(contacts.at_body_position, contacts.n_body_speed)
    speed, largest = indices(contacts.at_body_speed, contacts.n_body_speed), 0.0
    if bodies[z] == bodies[z + 1] or position[bodies[z]] < 0 or inertia <= 0.0:
        return over / weight[indices(contacts.at_hold_row, contacts.n_zones)[z]]
    for e in range(bodies[z], bodies[z + 1]):
        time = min(h, response_of(matrices, position[e], speed[e], inertia))
        largest = max(largest, over * time * time / (inertia * weight[position[e]]))
    return largest


@compiled
def error_of_speed(point, matrices, contacts, h, z, most, lasting):
    """What a missed force that rises to `most` in the time `lasting` means, in weights, for the speed or the position.

    Where a stiffness holds back, it takes the force up within the response time. Of several bodies as above.
    """
    weight, inertia = reals(point.at_weight, point.n), reals(contacts.at_held_inertia, contacts.n_zones)[z]
    bodies = indices(contacts.at_body_starts, contacts.n_zones + 1)
    position = indices(contacts.at_body_position, contacts.n_body_speed)
    speed, largest = indices(contacts.at_body_speed, contacts.n_body_speed), 0.0
    if bodies[z] == bodies[z + 1] or inertia <= 0.0:
        return 0.5 * most * lasting / (h * weight[indices(contacts.at_hold_row, contacts.n_zones)[z]])
    for e in range(bodies[z], bodies[z + 1]):
        x, error = position[e], 0.5 * most * lasting / (inertia * weight[speed[e]])
        if x >= 0:
            time = response_of(matrices, x, speed[e], inertia)
            error = min(error, 0.5 * most * min(lasting, time) * time / (inertia * weight[x]))
        largest = max(largest, error)
    return largest


@compiled
def count_rest(stepping):
    """After an accepted step: through how many each row has held."""
    exchange = stepping.exchange
    rested, holds = indices(stepping.contacts.at_rested, exchange.n), indices(exchange.at_holds, exchange.n)
    for k in range(exchange.n):
        rested[k] = rested[k] + 1 if holds[k] == 1 else 0


@compiled
def begin_rest(contacts):
    """After a settlement the slopes of all forces are known."""
    rested = indices(contacts.at_rested, contacts.n)
    for k in range(contacts.n):
        rested[k] = SEEN
