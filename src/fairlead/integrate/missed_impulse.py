"""The impulse that a step misses of a switch inside it, because it has the zones of its end for all of it.

A speed wrong by that is wrong from then on, by order h where a law jumps. A step that ends at the switch misses
nothing. So it is taken again up to there where the error counts. The place s h of a switch is that of its guard's
zero between the start and the end the step would have without a switch.

    turned round    A contact that slid with the force F, and whose slip comes to zero, ends the step held or sliding
                    the other way, under a mean force p. Had it turned, the mean would be F s - F (1 - s). Where that
                    lies beyond p, seen from F, the contact cannot have held: more than F pulls, and h times the
                    difference is missed.
    bent            A law without a force of its own among the unknowns (a stop, a rope, a contact that binds) says
                    other forces after the switch. Straight on either side of s, it misses h s (f_old - f_new)/2, both
                    at the start of the step.
"""

from __future__ import annotations

from fairlead.integrate.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.jumps import share
from fairlead.integrate.meters import inertia_of
from fairlead.integrate.overload import error_of_speed, response_of

AT_ONCE = 1e-2
"""A switch within this share of a step happens at its start."""
NOTHING = 1e-6
"""Share of a step so near its start that what follows a table there by a stiff law has no difference to follow."""
SHORT_OF = 1e-2
"""Share of a step by which it ends short of a stop or a rope: right there no zone is the right one, and they cycle."""


@compiled
def forget_switches(m):
    """Before a step: nothing has switched in it."""
    switched, after = indices(m.at_switched, m.n_zones), reals(m.at_switched_after, m.n_zones)
    for k in range(m.n_switched):
        after[switched[k]] = 0.0
    m.n_switched = 0


@compiled
def note_switches(m):
    """Of the machines whose guards are in `fired` those that leave their zone for the first time, and when."""
    fired, machine, rows = (
        indices(m.at_fired, m.n_guards), indices(m.at_guard_machine, m.n_guards), indices(m.at_hold_row, m.n_zones),
    )  # fmt: skip
    zones, before, holds = (
        indices(m.at_zones, m.n_zones), indices(m.at_zones_at_start, m.n_zones), indices(m.at_holds, m.n),
    )  # fmt: skip
    switched, after = indices(m.at_switched, m.n_zones), reals(m.at_switched_after, m.n_zones)
    for k in range(m.n_fired):
        i, z = fired[k], machine[fired[k]]
        if z < 0 or after[z] > 0.0 or zones[z] != before[z] or (rows[z] >= 0 and holds[rows[z]] == 1):
            continue
        s = share(m, i)
        if 0.0 < s < 1.0:
            switched[m.n_switched] = z
            after[z] = s
            m.n_switched += 1


@compiled
def impulse_is_missed(m, h):
    """True if a switch inside the step makes an error that counts; the step should end at `t_switch`."""
    turned, bent = first_turned(m, h), first_bent(m, h)
    first = min(turned, bent)
    m.t_switch = m.t + first * h
    kink = first_kink(m)
    if bent == first and bent == (1.0 - SHORT_OF) * kink and kink < 1.0:
        m.t_bent = m.t + kink * h
        if kink < AT_ONCE:
            m.t_switch = m.t + 2.0 * kink * h
    return first < 1.0


@compiled
def first_turned(m, h):
    """The share of the step after which a slip turned round, of the first whose error counts; 1 without one."""
    switched, after = indices(m.at_switched, m.n_zones), reals(m.at_switched_after, m.n_zones)
    rows, inertia = indices(m.at_hold_row, m.n_zones), reals(m.at_held_inertia, m.n_zones)
    y, y_end = reals(m.at_y, m.n), reals(m.at_y_end, m.n)
    first = 1.0
    for k in range(m.n_switched):
        z = switched[k]
        s = after[z]
        if rows[z] < 0 or inertia[z] <= 0.0 or s >= first or s < AT_ONCE:
            continue
        force, mean = y[rows[z]], y_end[rows[z]]
        missed = force * (2.0 * s - 1.0) - mean
        if missed * force > 0.0 and error_of_speed(m, h, z, 2.0 * abs(missed), h) > 1.0:
            first = s
            m.worst = rows[z]
    return first


@compiled
def first_kink(m):
    """The share of the step after which a table first went on in its next piece; 1 without one.

    A step that goes over a kink on purpose (stepping_trial.over_kink) has none, for it is implicit.
    """
    switched, after = indices(m.at_switched, m.n_zones), reals(m.at_switched_after, m.n_zones)
    rows, kinks = indices(m.at_hold_row, m.n_zones), indices(m.at_only_kinks, m.n_zones)
    first = 1.0
    for k in range(m.n_switched):
        z = switched[k]
        if rows[z] < 0 and kinks[z] == 1 and m.theta_now < 1.0 and after[z] >= NOTHING:
            first = min(first, after[z])
    return first


@compiled
def first_bent(m, h):
    """The share of the step after which a law without a force of its own first switched, if the error counts; or 1."""
    switched, after = indices(m.at_switched, m.n_zones), reals(m.at_switched_after, m.n_zones)
    rows, first, last = indices(m.at_hold_row, m.n_zones), first_kink(m), 0.0
    if first < 1.0:
        last = first
    for k in range(m.n_switched):
        s = after[switched[k]]
        if rows[switched[k]] < 0 and s >= AT_ONCE:
            first, last = min(first, s), max(last, s)
    if first == 1.0:
        return 1.0
    zones, kept, before = (
        indices(m.at_zones, m.n_zones), indices(m.at_zones_probed, m.n_zones), indices(m.at_zones_at_start, m.n_zones),
    )  # fmt: skip
    field_at(m.call_forces, (m.context, m.t, m.at_y, m.at_x))
    copy(zones, kept)
    copy(before, zones)
    field_at(m.call_forces, (m.context, m.t, m.at_y, m.at_residual))
    copy(kept, zones)
    m.rhs += 2
    new, old, weight = reals(m.at_x, m.n), reals(m.at_residual, m.n), reals(m.at_weight, m.n)
    position = indices(m.at_position_of, m.n)
    for v in range(m.n):
        x = position[v]
        if x < 0 or old[v] == new[v]:
            continue
        inertia = inertia_of(m, v)
        if inertia > 0.0:
            error = 0.5 * last * h * abs(old[v] - new[v]) / inertia
            if min(error / weight[v], error * response_of(m, x, v, inertia) / weight[x]) > 1.0:
                m.worst = v
                return (1.0 - SHORT_OF) * first
    return 1.0

