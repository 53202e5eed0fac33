"""A guard that rises inside a step and has fallen by its end: a stop touched and left, a rope snatched for a moment.

A step has the zones of its end for all of it, and would not see it. Contacts that may hold are left out: their forces
are means, and limit_violation.unseen_slip sees to them; and in the first of these also kinks of tables, where nothing
jumps but a slope.

    a step that its error limits     is short for what moves. Of a guard below zero at both its ends the parabola
                                     through these values and the one a step before says where it is highest, or through
                                     the value in the middle after a settlement. Where that may be above zero, by BEYOND
                                     of its bulge, the guard is asked there, on the dense output.
    a step that it does not limit    may be any length: nothing may move in it but what is given. It is searched in
                                     equal parts, on the chord, for kinks of tables too.

The step then ends where the guard was found above its tolerance; of the first kind if the impulse of what is touched
counts. A function `find_...` leaves the place that it finds in `t_cut`.
"""

from __future__ import annotations

from math import sqrt

from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals
from fairlead.integrate.point.controller import IDLE_ERROR, smallest_step
from fairlead.integrate.point.interpolant import interpolate
from fairlead.integrate.stepping.jump_at_end import has_hold_row
from fairlead.integrate.stepping.limit_violation import BEYOND
from fairlead.integrate.stepping.other_zones import forces_if_switched, state_off

PER_PARABOLA = 1.5
"""Largest value of a parabola between two zeros over its mean: what follows one has two thirds of the impulse."""
PARTS = 8
"""No step is longer than an eighth of the period of what swings in time alone, so a period has 64 parts or more."""


@compiled
def find_passed_guard(m, h):
    """True if such a guard is above its tolerance inside the step; the place of the first goes to `t_cut`."""
    if m.stepping.contacts.n_free_guards == 0 or m.events.settling.passes > 0:
        return False
    return find_touch(m, h) if m.run.error >= IDLE_ERROR else find_touch_while_idle(m, h)


@compiled
def find_touch(m, h):
    """True if a guard of a stop or rope is above its tolerance inside a step whose length its error limits."""
    guards, rule = m.events.guards, m.stepping.rule
    ng = guards.n_guards
    g, end, third = reals(guards.at_g, ng), reals(guards.at_g_end, ng), reals(m.stepping.contacts.at_g_before, ng)
    t_third = -2.0 * rule.gap
    if rule.gap == 0.0:
        evaluate_inside(m, 0.5, h)
        third = reals(guards.at_g_late, ng)
        copy(reals(guards.at_g_probe, ng), third)
        t_third = 0.5 * h
    kink, soonest = indices(m.problem.at_kink_guard, ng), 1.0
    for i in range(ng):
        if not (g[i] < 0.0 and end[i] < 0.0 and kink[i] == 0 and is_free(guards, m.stepping.contacts, i)):
            continue
        slope = (end[i] - g[i]) / h
        curve = (slope - (third[i] - g[i]) / t_third) / (h - t_third)  # half of the second derivative
        if not curve < 0.0:
            continue
        s = 0.5 - 0.5 * slope / (curve * h)
        if 0.0 < s < soonest and g[i] + s * h * slope - curve * h * h * s * (1.0 - s) * (1.0 + BEYOND) > 0.0:
            soonest = s
    return soonest < 1.0 and note_touched(m, soonest, h)


@compiled
def evaluate_inside(m, s, h):
    """Guards at the share s of the step, on its dense output, into `g_probe`."""
    point, guards = m.point, m.events.guards
    interpolate(point, s, point.at_y_probe)
    evaluate_guards(m.problem, m.run, guards, point.t + s * h, point.at_y_probe, guards.at_g_probe)


@compiled
def note_touched(m, s, h):
    """True if a guard of a stop or rope is above its tolerance at the share s of the step; it goes to `t_cut`."""
    evaluate_inside(m, s, h)
    guards, contacts = m.events.guards, m.stepping.contacts
    g, tolerance = reals(guards.at_g_probe, guards.n_guards), reals(guards.at_guard_tolerance, guards.n_guards)
    start, end = reals(guards.at_g, guards.n_guards), reals(guards.at_g_end, guards.n_guards)
    kink, fired = indices(m.problem.at_kink_guard, guards.n_guards), indices(guards.at_fired, guards.n_guards)
    found, longest = 0, 0.0
    for i in range(guards.n_guards):
        if g[i] > tolerance[i] and start[i] < 0.0 and end[i] < 0.0 and kink[i] == 0 and is_free(guards, contacts, i):
            fired[found] = i
            found += 1
            longest = max(longest, sqrt(g[i] / (g[i] - max(start[i], end[i]))))
    if found == 0 or s * h <= smallest_step(m.run, m.point):
        return False
    if not impulse_counts(m, s, h, found, min(longest, 1.0) * h):
        return False
    m.stepping.rule.t_cut = m.point.t + s * h
    m.point.worst = -1
    return True


@compiled
def impulse_counts(m, s, h, found, lasting):
    """True if what the first of `fired` would do meanwhile, at its most two thirds of the time, is above a weight."""
    problem, point, t = m.problem, m.point, m.point.t + s * h
    at_y = point.at_y_probe
    forces_if_switched(problem, point, m.events.guards, m.stepping.contacts, t, at_y, at_y, found)
    return state_off(m, h, lasting, PER_PARABOLA) >= 0


@compiled
def is_free(guards, contacts, i):
    """True if guard i is of a machine that holds nothing."""
    z = indices(guards.at_guard_machine, guards.n_guards)[i]
    return z >= 0 and not has_hold_row(contacts, z)


@compiled
def find_touch_while_idle(m, h):
    """True if a guard of a machine that holds nothing is above its tolerance in a step that no error limits."""
    run, point, guards = m.run, m.point, m.events.guards
    y, y_end, probe = reals(point.at_y, point.n), reals(point.at_y_end, point.n), reals(point.at_y_probe, point.n)
    g, tolerance = reals(guards.at_g_probe, guards.n_guards), reals(guards.at_guard_tolerance, guards.n_guards)
    for part in range(1, PARTS):
        s = part / PARTS
        for k in range(point.n):
            probe[k] = y[k] + s * (y_end[k] - y[k])
        evaluate_guards(m.problem, run, guards, point.t + s * h, point.at_y_probe, guards.at_g_probe)
        for i in range(guards.n_guards):
            if g[i] > tolerance[i] and is_free(guards, m.stepping.contacts, i):
                m.stepping.rule.t_cut = point.t + s * h
                point.worst = -1
                return s * h > smallest_step(run, point)
    return False
