"""Values of all guards, at a point or along a step, as the loop sees them: a machine held in its zone has none."""

from __future__ import annotations

from fairlead.integrate.memory.foreign import compiled, field_at, indices, reals
from fairlead.integrate.point.interpolant import interpolate
from fairlead.integrate.record.between import take_slip_away

OUT_OF_FORCE = -1.0


@compiled
def evaluate_guards(problem, run, guards, t, at_y, at_g):
    """Guards at (t, y) into the array at `at_g`; -1 for those of machines blocked until after t."""
    if problem.n_guards == 0:
        return
    field_at(problem.call_guards, (problem.context, t, at_y, at_g))
    problem.guards += 1
    if run.t_release < 1e300:
        g, machine = reals(at_g, problem.n_guards), indices(problem.at_guard_machine, problem.n_guards)
        blocked = reals(guards.at_blocked_until, problem.n_machines)
        for i in range(problem.n_guards):
            if machine[i] >= 0 and blocked[machine[i]] > t:
                g[i] = OUT_OF_FORCE


@compiled
def latches_wait(problem, guards):
    """Leave those that remember out of `fired` as long as any other is in it.

    While zones are still looked for, forces are only tried: a contact holds with ten times its limit, or a stop pulls.
    A relay would remember that, though it never was.
    """
    fired, latch = indices(guards.at_fired, guards.n_guards), indices(problem.at_latch_guard, guards.n_guards)
    kept = 0
    for k in range(guards.n_fired):
        if latch[fired[k]] == 0:
            fired[kept] = fired[k]
            kept += 1
    guards.n_fired = kept if kept > 0 else guards.n_fired


@compiled
def guards_at(m, s, h, at_g):
    """Guards at s on the interpolant."""
    problem, run, point, guards = m.problem, m.run, m.point, m.events.guards
    if s == 1.0:
        evaluate_guards(problem, run, guards, run.t_land if run.landing == 1 else point.t + h, point.at_y_end, at_g)
    else:
        interpolate(point, s, point.at_y_probe)
        if m.recorder.rows_slip == 1:
            take_slip_away(problem, point, m.linear, m.stepping.exchange, point.t + s * h, point.at_y_probe)
        evaluate_guards(problem, run, guards, point.t + s * h, point.at_y_probe, at_g)
