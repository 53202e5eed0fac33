"""The log of switches inside a step: each machine at its instant, in the order of these.

The zones of a step are those of its end, and its motion knows no instants. Guards do: the zero of one on the chord of
the step, or of the limit of a force on the line through the middles of two steps, is right to order two. A contact that
was let go because others around it were (active_set.py) has no guard above zero; its load is followed from the two
middles before.
"""

from __future__ import annotations

from fairlead.integrate.events.settling import log_change
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals
from fairlead.integrate.stepping.switch_inside import NOT_SEEN


@compiled
def log_inside(m):
    """Write the events of machines that changed in the step."""
    point, settling, contacts = m.point, m.events.settling, m.stepping.contacts
    nz, start = settling.n_machines, m.point.t
    zones, before = indices(settling.at_zones, nz), indices(settling.at_zones_before, nz)
    left, in_order, count = reals(contacts.at_left_at, nz), indices(contacts.at_in_order, nz), 0
    copy(indices(contacts.at_zones_at_start, nz), before)
    m.events.guards.n_fired = 0
    settling.passes = 0
    for z in range(nz):
        if zones[z] != before[z]:
            if left[z] == NOT_SEEN:
                left[z] = load_at_limit(m, z)
            k = count
            while k > 0 and left[in_order[k - 1]] > left[z]:
                in_order[k] = in_order[k - 1]
                k -= 1
            in_order[k] = z
            count += 1
    for k in range(count):
        z = in_order[k]
        point.t = start + left[z] * (m.run.t_piece - start)
        log_change(m, z)
    point.t = start


@compiled
def load_at_limit(m, z):
    """The share of the step after which the force of machine z is at its limit as its load went before; 1: never."""
    guards, rule, contacts = m.events.guards, m.stepping.rule, m.stepping.contacts
    machine, limit = indices(guards.at_guard_machine, guards.n_guards), indices(guards.at_limit_guard, guards.n_guards)
    g, earlier = reals(guards.at_g, guards.n_guards), reals(contacts.at_g_before, guards.n_guards)
    first, i = 1.0, indices(contacts.at_first_guard, contacts.n_machines)[z]
    while rule.gap > 0.0 and 0 <= i < guards.n_guards and machine[i] == z:
        if limit[i] == 1 and g[i] > earlier[i]:
            to_limit = -g[i] * rule.gap_before / (g[i] - earlier[i])
            first = min(first, max(to_limit - rule.gap, 0.0) / m.run.h)
        i += 1
    return first
