"""The error of one step of `stepping`, in weights.

The error of the midpoint rule is h^3 y'''/12, and y''' comes free of charge: it is the second divided difference of
the mean slopes of this step and the two before,

    error = h^3/6 [k_n, k_n-1, k_n-2]

It is taken away before (third_order.py): what is controlled is the error of the step without that, which is more than
what is left of it.
With a theta above 1/2 nothing is taken away, and the step misses (theta - 1/2) h^2 y'' besides: that comes on top.
Controlled are all differential unknowns but speeds that have a position (x' = v); these too where every switch is
landed on, by located_step.py, which counts ten times the error. A contact that starts
or stops inside a step bends the motion there: the speed at the end of the step is then still right to
order 2, while a difference of accelerations sees a jump; the position it leads to is wrong by order
h^2 times the jump, which is what the difference of speeds says.

What a step may miss of contacts that hold at its start: overloads that no mean force shows.

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

from math import inf, isfinite, sqrt

from fairlead.integrate.codes import MIDDLE
from fairlead.integrate.memory.foreign import compiled, field_at, indices, reals
from fairlead.integrate.point.controller import weigh, weighted_norm
from fairlead.integrate.stepping.located_step import HOLD_SHARE, error_of_located

STILL = 1e-2
"""Where no position changes by more than this share of its weight, HOLD_SHARE of the bend of a holding force counts
as its error: what is recorded of a force that swings while nothing moves would else be a few means."""
UNEVEN = 4.0
"""Rows inside a step lie on a parabola where the motion is smooth, on the chord where its bend c grows by more than
this or turns round: what is stiff rings at its steps, and a parabola through that shows motions that never were. The
bulge of the parabola is h^2 c/8, the error of the step h^2 (c - c_before)/12. Where c is four times c_before that is
half the bulge, which then says nothing."""
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
FREE = 1e300
SMOOTH, JUMPS_SOMEWHERE = 1, 2
"""What `kind_is_smooth` says of a kind of contact, but for 0: nothing was seen of it yet."""


@compiled
def error_of_step(m, h):
    """Size of the error of the step in weights; leaves `mean_slope`, and the bend of the step in `D`."""
    point, settling, stepping, rule = m.point, m.events.settling, m.stepping, m.stepping.rule
    n = point.n
    y, y_end, slope = reals(point.at_y, n), reals(point.at_y_end, n), reals(rule.at_mean_slope, n)
    before, earlier = reals(rule.at_slope_before, n), reals(rule.at_slope_earlier, n)
    error = reals(point.at_error_vector, n)
    bend, differential = reals(point.at_D, n), indices(point.at_differential, n)
    controlled = indices(rule.at_controlled, n)
    holds, quadrature = indices(m.stepping.exchange.at_holds, n), indices(point.at_quadrature, n)
    mean = reals(rule.at_mean_before, n)
    settled = rule.locates == 0 or rule.gap == 0.0
    near, far = rule.gap + 0.5 * h, rule.gap_before
    per_step, per_near, per_far = 1.0 / h, 1.0 / near, 1.0 / far
    third = h * h * h / 6.0 / (near + far)
    second = (rule.theta_now - MIDDLE) * h * h
    weigh(point, point.at_y_end)
    for k in range(n):
        if not isfinite(y_end[k]):
            point.worst = k
            return inf - inf
    located, start = rule.locates == 1, y if settled else mean
    for k in range(n):
        moving, rise = differential[k] == 1, (y_end[k] - start[k]) * per_near
        rate = (y_end[k] - y[k]) * per_step
        curve, curve_before = (rate - before[k]) * per_near, (before[k] - earlier[k]) * per_far
        even = (curve * curve_before > 0.0) & (abs(curve) <= UNEVEN * abs(curve_before))
        parabola, missed = -0.5 * h * h * curve, abs(third * (curve - curve_before)) + abs(second * curve)
        judged = (controlled[k] == 1) | (located & (quadrature[k] == 0))
        slope[k] = rate if moving else rise
        bend[k] = parabola if moving & even else 0.0
        error[k] = missed if moving & judged else 0.0
    if rule.locates == 1:
        return error_of_located(point, stepping, h)
    size = weighted_norm(point, point.at_error_vector)
    worst = point.worst
    size = larger(point, size, worst, unseen_slip(point, m.linear.matrices, m.events.guards, stepping, h))
    worst = point.worst
    if settling.passes > 0:
        size = larger(point, size, worst, unseen_force(m, h))
    if settling.passes > 0 or moves(point, rule):
        return size
    for k in range(n):
        if holds[k] == 1:
            error[k] = HOLD_SHARE * h * (slope[k] - before[k])
    return larger(point, size, worst, weighted_norm(point, point.at_error_vector))


@compiled
def larger(point, size, worst, other):
    """The larger of two sizes; `worst`, in which the second has left its place, is the place of the first again."""
    if other <= size:
        point.worst = worst
    return max(size, other)


@compiled
def moves(point, rule):
    """True if a controlled unknown changes in the step by more than STILL of its weight."""
    y, y_end, weight = reals(point.at_y, point.n), reals(point.at_y_end, point.n), reals(point.at_weight, point.n)
    controlled = indices(rule.at_controlled, point.n)
    found = False
    for k in range(point.n):
        found = found or (controlled[k] == 1 and abs(y_end[k] - y[k]) > STILL * weight[k])
    return found


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
        if is_limit[i] == 0 or z < 0 or rows[z] < 0 or rested[rows[z]] < HELD_THROUGH:
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
