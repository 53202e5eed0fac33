"""Values of all guards, as the loop sees them: a machine that is held in its zone has none."""

from __future__ import annotations

from fairlead.integrate.foreign import compiled, field_at, indices, reals

OUT_OF_FORCE = -1.0


@compiled
def evaluate_guards(m, t, at_y, at_g):
    """Guards at (t, y) into the array at `at_g`; -1 for those of machines blocked until after t."""
    if m.n_guards == 0:
        return
    field_at(m.call_guards, (m.context, t, at_y, at_g))
    m.guards += 1
    if m.t_release < 1e300:
        g, machine = reals(at_g, m.n_guards), indices(m.at_guard_machine, m.n_guards)
        blocked = reals(m.at_blocked_until, m.n_zones)
        for i in range(m.n_guards):
            if machine[i] >= 0 and blocked[machine[i]] > t:
                g[i] = OUT_OF_FORCE
