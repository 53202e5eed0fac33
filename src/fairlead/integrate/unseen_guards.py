"""Guards that rise inside a step and have fallen by its end, as of a rope that is snatched while all else rests.

A step that its error does not limit may be any length: nothing may move in it but what is given. It is searched in
equal parts, on the chord. Contacts that may hold are left out: their forces are means, and overload.py sees to them.
"""

from __future__ import annotations

from fairlead.integrate.controller import IDLE_ERROR
from fairlead.integrate.foreign import compiled, indices, reals
from fairlead.integrate.guards import evaluate_guards
from fairlead.integrate.pace import smallest_step

PARTS = 8


@compiled
def guards_are_passed(m, h):
    """True if such a guard is above its tolerance inside the step; the place of the first goes to `t_switch`."""
    if m.n_free_guards == 0 or m.passes > 0 or m.error >= IDLE_ERROR:
        return False
    y, y_end, probe = reals(m.at_y, m.n), reals(m.at_y_end, m.n), reals(m.at_y_probe, m.n)
    g, tolerance = reals(m.at_g_probe, m.n_guards), reals(m.at_guard_tolerance, m.n_guards)
    machine, rows = indices(m.at_guard_machine, m.n_guards), indices(m.at_hold_row, m.n_zones)
    for part in range(1, PARTS):
        s = part / PARTS
        for k in range(m.n):
            probe[k] = y[k] + s * (y_end[k] - y[k])
        evaluate_guards(m, m.t + s * h, m.at_y_probe, m.at_g_probe)
        for i in range(m.n_guards):
            if g[i] > tolerance[i] and machine[i] >= 0 and rows[machine[i]] < 0:
                m.t_switch = m.t + s * h
                m.worst = -1
                return s * h > smallest_step(m)
    return False
