"""Switches at which a law jumps: stiction above Coulomb friction, an applied force, a rebound.

Inside a step such a switch would count for the whole step: order 1. So it is told from a continuous one,
and landed on. Told: where the guard comes to zero, on the chord of the step, the algebraic rows of the next
zone are zero if the law is continuous. Tried are the limits of held forces, if the problem says which guards
those are; one found continuous in a zone is not tried again. Landed on:
guards of forces are means over a step, values in its middle; the line through this and the one before
tells when the limit is reached, to order 2.
"""

from __future__ import annotations

from fairlead.integrate.foreign import compiled, copy, field_at, indices, reals, switch_at
from fairlead.integrate.guards import evaluate_guards
from fairlead.integrate.limits import ROUNDING

SMOOTH, JUMPS_SOMEWHERE = 1, 2
"""What `kind_is_smooth` says of a kind of contact, but for 0: nothing was seen of it yet."""
LOCATING = 6
"""Evaluations spent on the place where a guard comes to zero (Illinois rule)."""


@compiled
def all_continuous(m):
    """True if every guard in `fired` was found continuous in the zone its machine is in."""
    fired, known = indices(m.at_fired, m.n_guards), indices(m.at_continuous, m.n_guards)
    machine, zones = indices(m.at_guard_machine, m.n_guards), indices(m.at_zones, m.n_zones)
    may_jump = indices(m.at_may_jump, m.n_guards)
    for k in range(m.n_fired):
        i = fired[k]
        if may_jump[i] == 1 and (machine[i] < 0 or known[i] != zones[machine[i]] + 1):
            return False
    return True


@compiled
def share(m, i):
    """Share of the step after which guard i comes to zero; zero where it is at its limit from the start."""
    before, now = reals(m.at_g, m.n_guards)[i], reals(m.at_g_end, m.n_guards)[i]
    return before / (before - now) if is_inside(m, i) and now > before else 0.0


@compiled
def is_inside(m, i):
    """True if guard i is below zero at the start of the step by more than rounding."""
    return reals(m.at_g, m.n_guards)[i] < -ROUNDING * reals(m.at_guard_tolerance, m.n_guards)[i]


@compiled
def may_cross(m, i):
    """True if guard i is inside at the start of the step, or at its limit within rounding of either sign."""
    return reals(m.at_g, m.n_guards)[i] <= ROUNDING * reals(m.at_guard_tolerance, m.n_guards)[i]


@compiled
def law_jumps(m, h):
    """True if the law of some guard in `fired`, not yet known to be continuous, jumps where it comes to zero.

    All are asked, also after one that jumps: what is known afterwards must not depend on which is asked first.
    """
    fired, known = indices(m.at_fired, m.n_guards), indices(m.at_continuous, m.n_guards)
    machine, zones = indices(m.at_guard_machine, m.n_guards), indices(m.at_zones, m.n_zones)
    may_jump = indices(m.at_may_jump, m.n_guards)
    copy(fired, indices(m.at_suspects, m.n_guards))
    suspects, count = indices(m.at_suspects, m.n_guards), m.n_fired
    found = False
    for k in range(count):
        i = suspects[k]
        if may_jump[i] == 1 and (machine[i] < 0 or known[i] != zones[machine[i]] + 1):
            jumps = jumps_at_guard(m, h, i)
            note_kind(m, machine[i], jumps)
            found = found or jumps
            if machine[i] >= 0 and not jumps:
                known[i] = zones[machine[i]] + 1
    return found


@compiled
def note_kind(m, z, jumps):
    """Remember of the kind of machine z whether its laws are continuous where seen; one that jumps speaks for all."""
    if z >= 0:
        smooth, kind = indices(m.at_kind_is_smooth, m.n_zones), indices(m.at_own_kind, m.n_zones)[z]
        if jumps:
            smooth[kind] = JUMPS_SOMEWHERE
        elif smooth[kind] != JUMPS_SOMEWHERE:
            smooth[kind] = SMOOTH


@compiled
def jumps_at_guard(m, h, i):
    """True if an algebraic row that is zero in the zone of guard i is not in the next, where the guard is zero."""
    n = m.n
    if not (may_cross(m, i) and reals(m.at_g_end, m.n_guards)[i] > 0.0):
        return False
    s = locate_guard(m, h, i)
    t = m.t + s * h
    field_at(m.call_forces, (m.context, t, m.at_y_probe, m.at_x))
    zones, kept = indices(m.at_zones, m.n_zones), indices(m.at_zones_probed, m.n_zones)
    fired = indices(m.at_fired, m.n_guards)
    copy(zones, kept)
    copy(reals(m.at_y_probe, n), reals(m.at_u, n))
    first = fired[0]
    fired[0] = i
    switch_at(m.call_switch, (m.context, t, m.at_u, m.at_fired, 1))
    fired[0] = first
    field_at(m.call_forces, (m.context, t, m.at_y_probe, m.at_residual))
    m.rhs += 2
    copy(kept, zones)
    old, new = reals(m.at_x, n), reals(m.at_residual, n)
    differential, weight = indices(m.at_differential, n), reals(m.at_column_scale, n)
    found = False
    for k in range(n):
        # On a chord the row of either zone is a little off; a jump is off in the new zone and from the old one.
        found = found or (differential[k] == 0 and min(abs(new[k]), abs(new[k] - old[k])) > weight[k])
    return found


@compiled
def locate_guard(m, h, i):
    """Share of the step after which guard i is zero; leaves the point there, on the chord, in `y_probe`."""
    y, y_end, probe = reals(m.at_y, m.n), reals(m.at_y_end, m.n), reals(m.at_y_probe, m.n)
    if not is_inside(m, i):
        copy(y, probe)
        return 0.0
    left, right = 0.0, 1.0
    before, after = reals(m.at_g, m.n_guards)[i], reals(m.at_g_end, m.n_guards)[i]
    s = 0.0
    for _ in range(LOCATING):
        s = left + (right - left) * before / (before - after)
        for k in range(m.n):
            probe[k] = y[k] + s * (y_end[k] - y[k])
        evaluate_guards(m, m.t + s * h, m.at_y_probe, m.at_g_probe)
        here = reals(m.at_g_probe, m.n_guards)[i]
        if here <= 0.0:
            left, before, after = s, here, after * (0.5 if here < 0.0 else 1.0)
        else:
            right, after, before = s, here, before * 0.5
        if here == 0.0:
            return s
    return s


@compiled
def find_jump(m, h):
    """Into `t_jump`: when the first guard in `fired` reaches zero, by the line through two middles of steps."""
    fired = indices(m.at_fired, m.n_guards)
    near = m.gap + 0.5 * h
    m.t_jump = m.t + 2.0 * h
    for k in range(m.n_fired):
        m.t_jump = min(m.t_jump, m.t - m.gap + share(m, fired[k]) * near)
    m.t_jump = max(m.t_jump, m.t)


@compiled
def jump_is_due(m, h):
    """True if a force reaches a limit at which its law jumps before the end of the step, after its middle."""
    if m.passes > 0:
        return False
    g, g_end, fired = reals(m.at_g, m.n_guards), reals(m.at_g_end, m.n_guards), indices(m.at_fired, m.n_guards)
    may_jump = indices(m.at_may_jump, m.n_guards)
    ahead = 0.5 * h / (m.gap + 0.5 * h)
    m.n_fired = 0
    for i in range(m.n_guards):
        if may_jump[i] == 1 and may_cross(m, i) and g_end[i] > g[i] and g_end[i] + ahead * (g_end[i] - g[i]) > 0.0:
            fired[m.n_fired] = i
            m.n_fired += 1
    if m.n_fired == 0 or all_continuous(m):
        return False
    jumps = law_jumps_ahead(m, h)
    if jumps:
        find_jump(m, h)
    return jumps


@compiled
def law_jumps_ahead(m, h):
    """True if a row of the next zone, on the line from the start of the step through its end, is not zero there."""
    n = m.n
    field_at(m.call_rhs, (m.context, m.t + h, m.at_y_end, m.at_x))
    copy(reals(m.at_y_end, n), reals(m.at_y_probe, n))
    switch_at(m.call_switch, (m.context, m.t + h, m.at_y_probe, m.at_fired, m.n_fired))
    field_at(m.call_rhs, (m.context, m.t, m.at_y, m.at_f))
    field_at(m.call_rhs, (m.context, m.t + h, m.at_y_end, m.at_residual))
    m.rhs += 3
    copy(indices(m.at_zones_at_start, m.n_zones), indices(m.at_zones, m.n_zones))
    first, last, old = reals(m.at_f, n), reals(m.at_residual, n), reals(m.at_x, n)
    differential, weight = indices(m.at_differential, n), reals(m.at_column_scale, n)
    fired = indices(m.at_fired, m.n_guards)
    for i in range(n):
        if differential[i] == 0 and old[i] != last[i]:
            least = 1e300
            for k in range(m.n_fired):
                least = min(least, abs(first[i] + share(m, fired[k]) * (last[i] - first[i])))
            if least > weight[i]:
                return True
    return False
