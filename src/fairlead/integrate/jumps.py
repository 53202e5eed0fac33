"""Switches at which a law jumps: stiction above Coulomb friction, an applied force, a rebound.

Inside a step such a switch would count for the whole step: order 1. So it is told from a continuous one,
and landed on. Told: on the way from the start of the step to its end the guard k comes to zero at a share
s_k of it, and there the residual of every algebraic row, in the new zones, is zero if the law is
continuous; rows that no guard explains within the weight of their unknown jump. A guard found continuous
in a zone is not tried again. Landed on: guards of forces are means over a step, values in its middle; the
line through this and the one before tells when the limit is reached, to order 2.
"""

from __future__ import annotations

from fairlead.integrate.foreign import compiled, copy, field_at, indices, reals, switch_at


@compiled
def all_continuous(m):
    """True if every guard in `fired` was found continuous in the zone its machine is in."""
    fired, known = indices(m.at_fired, m.n_guards), indices(m.at_continuous, m.n_guards)
    machine, zones = indices(m.at_guard_machine, m.n_guards), indices(m.at_zones, m.n_zones)
    for k in range(m.n_fired):
        i = fired[k]
        if machine[i] < 0 or known[i] != zones[machine[i]] + 1:
            return False
    return True


@compiled
def share(m, i):
    """Share of the step after which guard i comes to zero."""
    before, now = reals(m.at_g, m.n_guards)[i], reals(m.at_g_end, m.n_guards)[i]
    return before / (before - now) if before < 0.0 and now > before else 0.0


@compiled
def law_jumps(m, h):
    """True if some algebraic row, in the new zones, is not zero where a guard in `fired` is.

    In `x` is f at the end of the step in the zones before.
    """
    n = m.n
    field_at(m.call_rhs, (m.context, m.t, m.at_y, m.at_f))
    field_at(m.call_rhs, (m.context, m.t + h, m.at_y_end, m.at_residual))
    m.rhs += 3
    first, last, old = reals(m.at_f, n), reals(m.at_residual, n), reals(m.at_x, n)
    differential, fired = indices(m.at_differential, n), indices(m.at_fired, m.n_guards)
    weight = reals(m.at_column_scale, n)
    for i in range(n):
        if differential[i] == 0 and old[i] != last[i]:
            least = 1e300
            for k in range(m.n_fired):
                least = min(least, abs(first[i] + share(m, fired[k]) * (last[i] - first[i])))
            if least > weight[i]:
                return True
    known, machine = indices(m.at_continuous, m.n_guards), indices(m.at_guard_machine, m.n_guards)
    before = indices(m.at_zones_at_start, m.n_zones)
    for k in range(m.n_fired):
        if machine[fired[k]] >= 0:
            known[fired[k]] = before[machine[fired[k]]] + 1
    return False


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
    ahead = 0.5 * h / (m.gap + 0.5 * h)
    m.n_fired = 0
    for i in range(m.n_guards):
        if g[i] < 0.0 and g_end[i] > g[i] and g_end[i] + ahead * (g_end[i] - g[i]) > 0.0:
            fired[m.n_fired] = i
            m.n_fired += 1
    if m.n_fired == 0 or all_continuous(m):
        return False
    field_at(m.call_rhs, (m.context, m.t + h, m.at_y_end, m.at_x))
    copy(reals(m.at_y_end, m.n), reals(m.at_y_probe, m.n))
    switch_at(m.call_switch, (m.context, m.t + h, m.at_y_probe, m.at_fired, m.n_fired))
    jumps = law_jumps(m, h)
    copy(indices(m.at_zones_at_start, m.n_zones), indices(m.at_zones, m.n_zones))
    if jumps:
        find_jump(m, h)
    return jumps
