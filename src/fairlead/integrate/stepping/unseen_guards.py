"""Guards that rise inside a step and have fallen by its end, as of a rope that is snatched while all else rests.

A step that its error does not limit may be any length: nothing may move in it but what is given. It is searched in
equal parts, on the chord. Contacts that may hold are left out: their forces are means, and overload.py sees to them.
"""

from __future__ import annotations

from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.events.pace import smallest_step
from fairlead.integrate.memory.foreign import compiled, indices, reals
from fairlead.integrate.point.controller import IDLE_ERROR

PARTS = 8


@compiled
def guards_are_passed(m, h):
    """True if such a guard is above its tolerance inside the step; the place of the first goes to `t_switch`."""
    run, point, guards, settling, contacts = m.run, m.point, m.events.guards, m.events.settling, m.stepping.contacts
    if contacts.n_free_guards == 0 or settling.passes > 0 or run.error >= IDLE_ERROR:
        return False
    y, y_end, probe = reals(point.at_y, point.n), reals(point.at_y_end, point.n), reals(point.at_y_probe, point.n)
    g, tolerance = reals(guards.at_g_probe, guards.n_guards), reals(guards.at_guard_tolerance, guards.n_guards)
    machine, rows = indices(guards.at_guard_machine, guards.n_guards), indices(contacts.at_hold_row, settling.n_zones)
    for part in range(1, PARTS):
        s = part / PARTS
        for k in range(point.n):
            probe[k] = y[k] + s * (y_end[k] - y[k])
        evaluate_guards(m.problem, run, guards, point.t + s * h, point.at_y_probe, guards.at_g_probe)
        for i in range(guards.n_guards):
            if g[i] > tolerance[i] and machine[i] >= 0 and rows[machine[i]] < 0:
                m.stepping.rule.t_switch = point.t + s * h
                point.worst = -1
                return s * h > smallest_step(run, point)
    return False
