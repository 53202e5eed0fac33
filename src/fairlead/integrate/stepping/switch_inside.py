"""A switch inside a step that the step must not pass: where it is (`t_cut`), and whether its error counts.

A step has the zones of its end for all of it. A step that ends at the switch misses nothing, so where the error of one
inside counts the step is taken again up to there. There are two such:

    a law jumps     stiction above Coulomb friction, an applied force, a rebound: of order one. It is told from a
                    continuous one where the guard comes to zero, on the chord of the step: the algebraic rows of the
                    next zone are zero there if the law is continuous. Tried are the limits of held forces, if the
                    problem says which guards those are; one found continuous in a zone is not tried again. Guards of
                    forces are means over a step, values in its middle: the line through this and the one before tells
                    when the limit is reached, to order two.
    an impulse      is missed, and the speed is wrong from then on. The place s h of the switch is that of its guard's
                    zero between the start and the end the step would have without it. What is missed is below.

What has risen and fallen again by the end of a step is in passed_over.py.

Impulses that are missed:

    turned round    A contact that slid with the force F, and whose slip comes to zero, ends the step held or sliding
                    the other way, under a mean force p. Had it turned, the mean would be F s - F (1 - s). Where that
                    lies beyond p, seen from F, the contact cannot have held: more than F pulls, and h times the
                    difference is missed.
    bent            A law without a force of its own among the unknowns (a stop, a rope, a contact that binds) says
                    other forces after the switch. Straight on either side of s, it misses h s (f_old - f_new)/2, both
                    at the start of the step.
"""

from __future__ import annotations

from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.events.limits import ROUNDING
from fairlead.integrate.memory.foreign import compiled, copy, field_at, indices, reals, switch_at
from fairlead.integrate.point.meters import inertia_of
from fairlead.integrate.stepping.step_error import JUMPS_SOMEWHERE, SMOOTH, error_of_speed, response_of

LOCATING = 6
"""Evaluations spent on the place where a guard comes to zero. The Illinois rule is of order 1.44 an evaluation (Dowell
and Jarratt 1971): what is half a step off is 2e-3 of it off after six."""
AT_ONCE = 1e-2
"""A switch within this share s of a step happens at its start. A turn misses (a - b) s h, a hundredth of what one
misses at the end; a stop (k u h^2/2m) s^2, a ten-thousandth. The chord does not tell the place more closely."""
SHORT_OF = AT_ONCE
"""Share of a step by which it ends short of a stop or a rope: right there no zone is the right one, and they cycle.
What is left of the way counts as none in the next step."""
NOTHING = 1e-6
"""Share of a step so near its start that what follows a table there by a stiff law has no difference to follow. At a
thousandth the speeds of line on the two pieces of a drum's radius differ by 1e-5 m/s, which a bond of 1e9 N s/m shows
as 10 kN; at a millionth as 10 N."""


@compiled
def all_continuous(guards, contacts):
    """True if every guard in `fired` was found continuous in the zone its machine is in."""
    fired, known = indices(guards.at_fired, guards.n_guards), indices(contacts.at_continuous, guards.n_guards)
    machine, zones = indices(guards.at_guard_machine, guards.n_guards), indices(contacts.at_zones, contacts.n_zones)
    may_jump = indices(contacts.at_may_jump, guards.n_guards)
    for k in range(guards.n_fired):
        i = fired[k]
        if may_jump[i] == 1 and (machine[i] < 0 or known[i] != zones[machine[i]] + 1):
            return False
    return True


@compiled
def share(guards, i):
    """Where guard i comes to zero between its two values, as a share; zero where it is at its limit from the start.

    Of a guard that is read in the middle these are the middles of two steps, of others both ends of this one.
    """
    before, now = reals(guards.at_g, guards.n_guards)[i], reals(guards.at_g_end, guards.n_guards)[i]
    return before / (before - now) if is_inside(guards, i) and now > before else 0.0


@compiled
def is_inside(guards, i):
    """True if guard i is below zero at the start of the step by more than rounding."""
    return reals(guards.at_g, guards.n_guards)[i] < -ROUNDING * reals(guards.at_guard_tolerance, guards.n_guards)[i]


@compiled
def may_cross(guards, i):
    """True if guard i is inside at the start of the step, or at its limit within rounding of either sign."""
    return reals(guards.at_g, guards.n_guards)[i] <= ROUNDING * reals(guards.at_guard_tolerance, guards.n_guards)[i]


@compiled
def law_jumps(m, h):
    """True if the law of some guard in `fired`, not yet known to be continuous, jumps where it comes to zero.

    All are asked, also after one that jumps: what is known afterwards must not depend on which is asked first.
    """
    guards, contacts = m.events.guards, m.stepping.contacts
    fired, known = indices(guards.at_fired, guards.n_guards), indices(contacts.at_continuous, guards.n_guards)
    machine, zones = indices(guards.at_guard_machine, guards.n_guards), indices(contacts.at_zones, contacts.n_zones)
    may_jump = indices(contacts.at_may_jump, guards.n_guards)
    copy(fired, indices(contacts.at_suspects, guards.n_guards))
    suspects, count = indices(contacts.at_suspects, guards.n_guards), guards.n_fired
    found = False
    for k in range(count):
        i = suspects[k]
        if holds_row(contacts, machine[i]):
            continue  # jump_inside.py
        if may_jump[i] == 1 and (machine[i] < 0 or known[i] != zones[machine[i]] + 1):
            jumps = jumps_at_guard(m, h, i)
            note_kind(contacts, machine[i], jumps)
            found = found or jumps
            if machine[i] >= 0 and not jumps:
                known[i] = zones[machine[i]] + 1
    return found


@compiled
def holds_row(contacts, z):
    """True if machine z is known to hold a row: its jumps are put right inside the step (jump_inside.py)."""
    return z >= 0 and indices(contacts.at_hold_row, contacts.n_zones)[z] >= 0


@compiled
def note_kind(contacts, z, jumps):
    """Remember of the kind of machine z whether its laws are continuous where seen; one that jumps speaks for all."""
    if z >= 0:
        smooth = indices(contacts.at_kind_is_smooth, contacts.n_zones)
        kind = indices(contacts.at_own_kind, contacts.n_zones)[z]
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
    t = point.t + s * h
    field_at(problem.call_forces, (problem.context, t, point.at_y_probe, point.at_x))
    zones = indices(problem.at_zones, problem.n_zones)
    kept = indices(m.stepping.contacts.at_zones_probed, problem.n_zones)
    fired = indices(guards.at_fired, problem.n_guards)
    copy(zones, kept)
    copy(reals(point.at_y_probe, n), reals(point.at_u, n))
    first = fired[0]
    fired[0] = i
    switch_at(problem.call_switch, (problem.context, t, point.at_u, guards.at_fired, 1))
    fired[0] = first
    field_at(problem.call_forces, (problem.context, t, point.at_y_probe, point.at_residual))
    problem.rhs += 2
    copy(kept, zones)
    old, new = reals(point.at_x, n), reals(point.at_residual, n)
    differential, weight = indices(problem.at_differential, n), reals(m.linear.factors.at_column_scale, n)
    found = False
    for k in range(n):
        # On a chord the row of either zone is a little off; a jump is off in the new zone and from the old one.
        found = found or (differential[k] == 0 and min(abs(new[k]), abs(new[k] - old[k])) > weight[k])
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
    s, last = 0.0, 0
    for _ in range(LOCATING):
        s = left + (right - left) * before / (before - after)
        for k in range(point.n):
            probe[k] = y[k] + s * (y_end[k] - y[k])
        evaluate_guards(problem, run, guards, point.t + s * h, point.at_y_probe, guards.at_g_probe)
        here = reals(guards.at_g_probe, guards.n_guards)[i]
        if here == 0.0:
            return s
        if here < 0.0:
            left, before = s, here
            after *= 0.5 if last == -1 else 1.0  # an end that is kept twice
            last = -1
        else:
            right, after = s, here
            before *= 0.5 if last == 1 else 1.0
            last = 1
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
def find_jump(point, guards, contacts, rule, h):
    """Into `t_cut`: when the first guard in `fired` reaches zero.

    By the line through two middles of steps, or through both ends of this one: where it is read (`find_means`).
    """
    fired, is_mean = indices(guards.at_fired, guards.n_guards), indices(contacts.at_is_mean, guards.n_guards)
    near = rule.gap + 0.5 * h
    rule.t_cut = point.t + 2.0 * h
    for k in range(guards.n_fired):
        s = share(guards, fired[k])
        rule.t_cut = min(rule.t_cut, point.t + (s * near - rule.gap if is_mean[fired[k]] == 1 else s * h))
    rule.t_cut = max(rule.t_cut, point.t)


@compiled
def jump_is_due(m, h):
    """True if a force reaches a limit at which its law jumps before the end of the step, after its middle."""
    guards, rule, contacts = m.events.guards, m.stepping.rule, m.stepping.contacts
    if m.events.settling.passes > 0:
        return False
    g, g_end = reals(guards.at_g, guards.n_guards), reals(guards.at_g_end, guards.n_guards)
    fired, machine = indices(guards.at_fired, guards.n_guards), indices(guards.at_guard_machine, guards.n_guards)
    may_jump = indices(contacts.at_may_jump, guards.n_guards)
    ahead = 0.5 * h / (rule.gap + 0.5 * h)
    guards.n_fired = 0
    for i in range(guards.n_guards):
        if may_jump[i] == 0 or holds_row(contacts, machine[i]):
            continue
        if may_cross(guards, i) and g_end[i] > g[i] and g_end[i] + ahead * (g_end[i] - g[i]) > 0.0:
            fired[guards.n_fired] = i
            guards.n_fired += 1
    if guards.n_fired == 0 or all_continuous(guards, contacts):
        return False
    keep_means(m, h)
    jumps = guards.n_fired > 0 and law_jumps_ahead(m, h)
    if jumps:
        find_jump(m.point, guards, contacts, rule, h)
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
def law_jumps_ahead(m, h):
    """True if a row of the next zone, on the line from the start of the step through its end, is not zero there."""
    problem, point, guards = m.problem, m.point, m.events.guards
    n = problem.n
    field_at(problem.call_rhs, (problem.context, point.t + h, point.at_y_end, point.at_x))
    copy(reals(point.at_y_end, n), reals(point.at_y_probe, n))
    switch_at(problem.call_switch, (problem.context, point.t + h, point.at_y_probe, guards.at_fired, guards.n_fired))
    field_at(problem.call_rhs, (problem.context, point.t, point.at_y, point.at_f))
    field_at(problem.call_rhs, (problem.context, point.t + h, point.at_y_end, point.at_residual))
    problem.rhs += 3
    copy(indices(m.stepping.contacts.at_zones_at_start, problem.n_zones), indices(problem.at_zones, problem.n_zones))
    first, last, old = reals(point.at_f, n), reals(point.at_residual, n), reals(point.at_x, n)
    differential, weight = indices(problem.at_differential, n), reals(m.linear.factors.at_column_scale, n)
    fired = indices(guards.at_fired, problem.n_guards)
    for i in range(n):
        if differential[i] == 0 and old[i] != last[i]:
            least = 1e300
            for k in range(guards.n_fired):
                least = min(least, abs(first[i] + share(guards, fired[k]) * (last[i] - first[i])))
            if least > weight[i]:
                return True
    return False


@compiled
def forget_switches(contacts):
    """Before a step: nothing has switched in it."""
    switched = indices(contacts.at_switched, contacts.n_zones)
    after = reals(contacts.at_switched_after, contacts.n_zones)
    for k in range(contacts.n_switched):
        after[switched[k]] = 0.0
    contacts.n_switched = 0


@compiled
def note_switches(guards, stepping):
    """Of the machines whose guards are in `fired` those that leave their zone for the first time, and when."""
    exchange, contacts = stepping.exchange, stepping.contacts
    fired, machine, rows = (
        indices(guards.at_fired, guards.n_guards), indices(guards.at_guard_machine, guards.n_guards),
        indices(contacts.at_hold_row, exchange.n_zones),
    )  # fmt: skip
    zones, before, holds = (
        indices(exchange.at_zones, exchange.n_zones), indices(contacts.at_zones_at_start, exchange.n_zones),
        indices(exchange.at_holds, exchange.n),
    )  # fmt: skip
    switched = indices(contacts.at_switched, exchange.n_zones)
    after = reals(contacts.at_switched_after, exchange.n_zones)
    for k in range(guards.n_fired):
        i, z = fired[k], machine[fired[k]]
        if z < 0 or after[z] > 0.0 or zones[z] != before[z] or (rows[z] >= 0 and holds[rows[z]] == 1):
            continue
        s = share(guards, i)
        if 0.0 < s < 1.0:
            switched[contacts.n_switched] = z
            after[z] = s
            contacts.n_switched += 1


@compiled
def impulse_is_missed(problem, point, matrices, stepping, h):
    """True if a switch inside the step makes an error that counts; the step should end at `t_cut`."""
    rule = stepping.rule
    turned = first_turned(point, matrices, stepping.contacts, h)
    bent = first_bent(problem, point, matrices, stepping, h)
    first = min(turned, bent)
    rule.t_cut = point.t + first * h
    kink = first_kink(stepping)
    if bent == first and bent == (1.0 - SHORT_OF) * kink and kink < 1.0:
        rule.t_bent = point.t + kink * h
        if kink < AT_ONCE:
            rule.t_cut = point.t + 2.0 * kink * h
    return first < 1.0


@compiled
def first_turned(point, matrices, contacts, h):
    """The share of the step after which a slip turned round, of the first whose error counts; 1 without one."""
    switched = indices(contacts.at_switched, contacts.n_zones)
    after = reals(contacts.at_switched_after, contacts.n_zones)
    rows, inertia = indices(contacts.at_hold_row, contacts.n_zones), reals(contacts.at_held_inertia, contacts.n_zones)
    y, y_end = reals(point.at_y, point.n), reals(point.at_y_end, point.n)
    first = 1.0
    for k in range(contacts.n_switched):
        z = switched[k]
        s = after[z]
        if rows[z] < 0 or inertia[z] <= 0.0 or s >= first or s < AT_ONCE:
            continue
        force, mean = y[rows[z]], y_end[rows[z]]
        missed = force * (2.0 * s - 1.0) - mean
        if missed * force > 0.0 and error_of_speed(point, matrices, contacts, h, z, 2.0 * abs(missed), h) > 1.0:
            first = s
            point.worst = rows[z]
    return first


@compiled
def first_kink(stepping):
    """The share of the step after which a table first went on in its next piece; 1 without one.

    A step that goes over a kink on purpose (trial.over_kink) has none, for it is implicit.
    """
    contacts = stepping.contacts
    switched = indices(contacts.at_switched, contacts.n_zones)
    after = reals(contacts.at_switched_after, contacts.n_zones)
    rows, kinks = indices(contacts.at_hold_row, contacts.n_zones), indices(contacts.at_only_kinks, contacts.n_zones)
    first = 1.0
    for k in range(contacts.n_switched):
        z = switched[k]
        if rows[z] < 0 and kinks[z] == 1 and stepping.rule.theta_now < 1.0 and after[z] >= NOTHING:
            first = min(first, after[z])
    return first


@compiled
def first_bent(problem, point, matrices, stepping, h):
    """The share of the step after which a law without a force of its own first switched, if the error counts; or 1."""
    contacts = stepping.contacts
    switched, after = indices(contacts.at_switched, problem.n_zones), reals(contacts.at_switched_after, problem.n_zones)
    rows, first, last = indices(contacts.at_hold_row, problem.n_zones), first_kink(stepping), 0.0
    if first < 1.0:
        last = first
    for k in range(contacts.n_switched):
        s = after[switched[k]]
        if rows[switched[k]] < 0 and s >= AT_ONCE:
            first, last = min(first, s), max(last, s)
    if first == 1.0:
        return 1.0
    zones, kept, before = (
        indices(problem.at_zones, problem.n_zones), indices(contacts.at_zones_probed, problem.n_zones),
        indices(contacts.at_zones_at_start, problem.n_zones),
    )  # fmt: skip
    field_at(problem.call_forces, (problem.context, point.t, point.at_y, point.at_x))
    copy(zones, kept)
    copy(before, zones)
    field_at(problem.call_forces, (problem.context, point.t, point.at_y, point.at_residual))
    copy(kept, zones)
    problem.rhs += 2
    new, old = reals(point.at_x, problem.n), reals(point.at_residual, problem.n)
    weight = reals(point.at_weight, problem.n)
    position = indices(problem.at_position_of, problem.n)
    for v in range(problem.n):
        x = position[v]
        if x < 0 or old[v] == new[v]:
            continue
        inertia = inertia_of(matrices, v)
        if inertia > 0.0:
            error = 0.5 * last * h * abs(old[v] - new[v]) / inertia
            if min(error / weight[v], error * response_of(matrices, x, v, inertia) / weight[x]) > 1.0:
                point.worst = v
                return (1.0 - SHORT_OF) * first
    return 1.0
