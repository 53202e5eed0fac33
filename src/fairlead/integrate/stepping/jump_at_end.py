"""A law that jumps and does not say which row it holds: the step ends where it jumps (`t_cut`), at a settlement.

A law jumps where stiction exceeds Coulomb friction, with an applied force, at a rebound. It is told from a continuous
one where the guard comes to zero, on the chord of the step: the algebraic rows of the next zone are zero there if the
law is continuous. Tried are the limits of held forces, if the problem says which guards those are; one found continuous
in a zone is not tried again. Guards of forces are means over a step, values in its middle: the line through this and
the one before tells when the limit is reached, to order two.

Rows that a contact is known to hold are put right inside the step instead (jump_inside.py).
"""

from __future__ import annotations

from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.events.limits import AT_LIMIT
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.point.illinois import LEFT, RIGHT, shares_of_ends
from fairlead.integrate.stepping.other_zones import forces_if_switched, switch_back, switch_for_now

LOCATING = 6
"""Evaluations spent on the place where a guard comes to zero. The Illinois rule is of order 1.44 an evaluation (Dowell
and Jarratt 1971): what is half a step off is 2e-3 of it off after six."""
SMOOTH, JUMPS_SOMEWHERE = 1, 2
"""What `kind_is_smooth` says of a kind of contact, but for 0: nothing was seen of it yet."""


@compiled
def all_continuous(guards, contacts):
    """True if every guard in `fired` was found continuous in the zone its machine is in."""
    fired, known = indices(guards.at_fired, guards.n_guards), indices(contacts.at_continuous, guards.n_guards)
    machine, zones = indices(guards.at_guard_machine, guards.n_guards), indices(contacts.at_zones, contacts.n_machines)
    may_jump = indices(contacts.at_may_jump, guards.n_guards)
    for k in range(guards.n_fired):
        i = fired[k]
        if may_jump[i] == 1 and (machine[i] < 0 or known[i] != zones[machine[i]] + 1):
            return False
    return True


@compiled
def zero_of_guard(guards, i):
    """Where guard i comes to zero between its two values, as a share; zero where it is at its limit from the start.

    Of a guard that is read in the middle these are the middles of two steps, of others both ends of this one.
    """
    before, now = reals(guards.at_g, guards.n_guards)[i], reals(guards.at_g_end, guards.n_guards)[i]
    return before / (before - now) if is_inside(guards, i) and now > before else 0.0


@compiled
def is_inside(guards, i):
    """True if guard i is below zero at the start of the step by more than rounding."""
    return reals(guards.at_g, guards.n_guards)[i] < -AT_LIMIT * reals(guards.at_guard_tolerance, guards.n_guards)[i]


@compiled
def may_cross(guards, i):
    """True if guard i is inside at the start of the step, or at its limit within rounding of either sign."""
    return reals(guards.at_g, guards.n_guards)[i] <= AT_LIMIT * reals(guards.at_guard_tolerance, guards.n_guards)[i]


@compiled
def find_jumping_law(m, h):
    """True if the law of some guard in `fired`, not yet known to be continuous, jumps where it comes to zero.

    Learns of every guard, and of every kind of contact, whether its law is continuous.

    All are asked, also after one that jumps: what is known afterwards must not depend on which is asked first.
    """
    guards, contacts = m.events.guards, m.stepping.contacts
    fired, known = indices(guards.at_fired, guards.n_guards), indices(contacts.at_continuous, guards.n_guards)
    machine, zones = indices(guards.at_guard_machine, guards.n_guards), indices(contacts.at_zones, contacts.n_machines)
    may_jump = indices(contacts.at_may_jump, guards.n_guards)
    copy(fired, indices(contacts.at_suspects, guards.n_guards))
    suspects, count = indices(contacts.at_suspects, guards.n_guards), guards.n_fired
    found = False
    for k in range(count):
        i = suspects[k]
        if has_hold_row(contacts, machine[i]):
            continue  # jump_inside.py
        if may_jump[i] == 1 and (machine[i] < 0 or known[i] != zones[machine[i]] + 1):
            jumps = jumps_at_guard(m, h, i)
            note_kind(contacts, machine[i], jumps)
            found = found or jumps
            if machine[i] >= 0 and not jumps:
                known[i] = zones[machine[i]] + 1
    return found


@compiled
def has_hold_row(contacts, z):
    """True if machine z is known to hold a row: its jumps are put right inside the step (jump_inside.py)."""
    return z >= 0 and indices(contacts.at_hold_row, contacts.n_machines)[z] >= 0


@compiled
def note_kind(contacts, z, jumps):
    """Remember of the kind of machine z whether its laws are continuous where seen; one that jumps speaks for all."""
    if z >= 0:
        smooth = indices(contacts.at_kind_is_smooth, contacts.n_machines)
        kind = indices(contacts.at_own_kind, contacts.n_machines)[z]
        if jumps:
            smooth[kind] = JUMPS_SOMEWHERE
        elif smooth[kind] != JUMPS_SOMEWHERE:
            smooth[kind] = SMOOTH


@compiled
def jumps_at_guard(m, h, i):
    """True if an algebraic row that is zero in the zone of guard i is not in the next, where the guard is zero."""
    problem, point, guards = m.problem, m.point, m.events.guards
    n = problem.n
    if not (may_cross(guards, i) and reals(guards.at_g_end, problem.n_guards)[i] > 0.0):
        return False
    s = locate_guard(problem, m.run, point, guards, h, i)
    fired = indices(guards.at_fired, problem.n_guards)
    copy(reals(point.at_y_probe, n), reals(point.at_u, n))
    first = fired[0]
    fired[0] = i
    forces_if_switched(problem, point, guards, m.stepping.contacts, point.t + s * h, point.at_y_probe, point.at_u, 1)
    fired[0] = first
    f_old, f_new = reals(point.at_x, n), reals(point.at_f, n)
    differential, weight = indices(problem.at_differential, n), reals(m.linear.factors.at_column_scale, n)
    found = False
    for k in range(n):
        # On a chord the row of either zone is a little off; a jump is off in the f_new zone and from the f_old one.
        found = found or (differential[k] == 0 and min(abs(f_new[k]), abs(f_new[k] - f_old[k])) > weight[k])
    return found


@compiled
def locate_guard(problem, run, point, guards, h, i):
    """Share of the step after which guard i is zero; leaves the point there, on the chord, in `y_probe`."""
    y, y_end, probe = reals(point.at_y, point.n), reals(point.at_y_end, point.n), reals(point.at_y_probe, point.n)
    if not is_inside(guards, i):
        copy(y, probe)
        return 0.0
    left, right = 0.0, 1.0
    before, after = reals(guards.at_g, guards.n_guards)[i], reals(guards.at_g_end, guards.n_guards)[i]
    s, of_left, of_right, last = 0.0, 1.0, 1.0, 0
    for _ in range(LOCATING):
        ga, gb = of_left * before, of_right * after
        s = left + (right - left) * ga / (ga - gb)
        for k in range(point.n):
            probe[k] = y[k] + s * (y_end[k] - y[k])
        evaluate_guards(problem, run, guards, point.t + s * h, point.at_y_probe, guards.at_g_probe)
        here = reals(guards.at_g_probe, guards.n_guards)[i]
        if here == 0.0:
            return s
        moved = LEFT if here < 0.0 else RIGHT
        if moved == LEFT:
            left, before = s, here
        else:
            right, after = s, here
        of_left, of_right = shares_of_ends(of_left, of_right, last, moved)
        last = moved
    return s


@compiled
def find_means(m, h):
    """Mark the guards that are read in the middle of a step: limits, and what follows algebraic unknowns, its means."""
    point, guards, contacts = m.point, m.events.guards, m.stepping.contacts
    y, y_end, probe = reals(point.at_y, point.n), reals(point.at_y_end, point.n), reals(point.at_y_probe, point.n)
    differential = indices(point.at_differential, point.n)
    for k in range(point.n):
        probe[k] = y_end[k] if differential[k] == 1 else y[k]
    evaluate_guards(m.problem, m.run, guards, point.t + h, point.at_y_probe, guards.at_g_probe)
    g_end, without = reals(guards.at_g_end, guards.n_guards), reals(guards.at_g_probe, guards.n_guards)
    tolerance = reals(guards.at_guard_tolerance, guards.n_guards)
    is_mean, is_limit = (
        indices(contacts.at_is_mean, guards.n_guards), indices(contacts.at_limit_guard, guards.n_guards),
    )  # fmt: skip
    for i in range(guards.n_guards):
        is_mean[i] = 1 if is_limit[i] == 1 or abs(g_end[i] - without[i]) > tolerance[i] else 0


@compiled
def place_jump(point, guards, contacts, rule, h):
    """Into `t_cut`: when the first guard in `fired` reaches zero."""
    fired = indices(guards.at_fired, guards.n_guards)
    rule.t_cut = point.t + 2.0 * h
    for k in range(guards.n_fired):
        rule.t_cut = min(rule.t_cut, due_at(point, guards, contacts, rule, h, fired[k]))
    rule.t_cut = max(rule.t_cut, point.t)


@compiled
def due_at(point, guards, contacts, rule, h, i):
    """When guard i reaches zero: where it is read (`find_means`), in the middle of a step or at its end.

    By the line through two middles of steps, or through both ends of this one.
    """
    s = zero_of_guard(guards, i)
    is_mean = indices(contacts.at_is_mean, guards.n_guards)[i]
    return point.t + (s * (rule.gap + 0.5 * h) - rule.gap if is_mean == 1 else s * h)


@compiled
def keep_due(point, guards, contacts, rule, h, latest):
    """Leave guards out of `fired` that reach zero after this instant."""
    fired, count = indices(guards.at_fired, guards.n_guards), 0
    for k in range(guards.n_fired):
        if due_at(point, guards, contacts, rule, h, fired[k]) <= latest:
            fired[count] = fired[k]
            count += 1
    guards.n_fired = count


@compiled
def keep_at_limit(guards):
    """Leave guards out of `fired` that are below zero at the start of the step by more than rounding."""
    fired, count = indices(guards.at_fired, guards.n_guards), 0
    for k in range(guards.n_fired):
        if not is_inside(guards, fired[k]):
            fired[count] = fired[k]
            count += 1
    guards.n_fired = count


@compiled
def find_due_jump(m, h):
    """True if a force reaches a limit at which its law jumps after the middle of the step; when it does to `t_cut`."""
    guards, rule, contacts = m.events.guards, m.stepping.rule, m.stepping.contacts
    if m.events.settling.passes > 0:
        return False
    g, g_end = reals(guards.at_g, guards.n_guards), reals(guards.at_g_end, guards.n_guards)
    fired, machine = indices(guards.at_fired, guards.n_guards), indices(guards.at_guard_machine, guards.n_guards)
    may_jump = indices(contacts.at_may_jump, guards.n_guards)
    to_end = 0.5 * h / (rule.gap + 0.5 * h)
    guards.n_fired = 0
    for i in range(guards.n_guards):
        if may_jump[i] == 0 or has_hold_row(contacts, machine[i]):
            continue
        if may_cross(guards, i) and g_end[i] > g[i] and g_end[i] + to_end * (g_end[i] - g[i]) > 0.0:
            fired[guards.n_fired] = i
            guards.n_fired += 1
    if guards.n_fired == 0 or all_continuous(guards, contacts):
        return False
    keep_means(m, h)
    jumps = guards.n_fired > 0 and next_law_jumps(m, h)
    if jumps:
        place_jump(m.point, guards, contacts, rule, h)
    return jumps


@compiled
def keep_means(m, h):
    """Leave guards out of `fired` that are read at the end of a step, where they are not above zero."""
    guards, count = m.events.guards, 0
    find_means(m, h)
    fired, is_mean = indices(guards.at_fired, guards.n_guards), indices(m.stepping.contacts.at_is_mean, guards.n_guards)
    for k in range(guards.n_fired):
        if is_mean[fired[k]] == 1:
            fired[count] = fired[k]
            count += 1
    guards.n_fired = count


@compiled
def next_law_jumps(m, h):
    """True if a row of the next zone, on the line from the start of the step through its end, is not zero there."""
    problem, point, guards, contacts = m.problem, m.point, m.events.guards, m.stepping.contacts
    n = problem.n
    field_at(problem.call_rhs, (problem.context, point.t + h, point.at_y_end, point.at_x))
    copy(reals(point.at_y_end, n), reals(point.at_y_probe, n))
    switch_for_now(problem, guards, contacts, point.t + h, point.at_y_probe, guards.n_fired)
    field_at(problem.call_rhs, (problem.context, point.t, point.at_y, point.at_f))
    field_at(problem.call_rhs, (problem.context, point.t + h, point.at_y_end, point.at_v))
    problem.rhs += 3
    switch_back(problem, contacts)
    f_new_start, f_new_end, f_old = reals(point.at_f, n), reals(point.at_v, n), reals(point.at_x, n)
    differential, weight = indices(problem.at_differential, n), reals(m.linear.factors.at_column_scale, n)
    fired = indices(guards.at_fired, problem.n_guards)
    for i in range(n):
        if differential[i] == 0 and f_old[i] != f_new_end[i]:
            least = 1e300
            for k in range(guards.n_fired):
                row_at_zero = f_new_start[i] + zero_of_guard(guards, fired[k]) * (f_new_end[i] - f_new_start[i])
                least = min(least, abs(row_at_zero))
            if least > weight[i]:
                return True
    return False
