"""Machines that switch again and again: counted, and held in their zones for a dwell, or the run ends.

    chatters    a machine that toggles CHATTER_STREAK times in a row, each within a dwell of the one before
    stalls      STALL_LIMIT settlements in a row, each within a progress floor of the one before
"""

from __future__ import annotations

from fairlead.integrate.memory.foreign import compiled, indices, reals

CHATTER_STREAK = 8
"""Toggles in a row, each within a dwell of the one before, that make a machine chatter."""
STALL_LIMIT = 5
"""Switches in a row, each within a progress floor of the one before, that earn a machine a dwell."""
HOLD, STOP = 1, 2
"""What `on_chatter` says, but for 0: warn."""


@compiled
def watch_progress(problem, run, point, events):
    """Count switches that do not advance; when there are too many, hold the machines for a dwell."""
    guards, settling = events.guards, events.settling
    if guards.n_fired == 0:
        return
    settling.stalls = settling.stalls + 1 if point.t - settling.t_last_switch < run.progress_floor else 0
    settling.t_last_switch = point.t
    if settling.stalls >= STALL_LIMIT:
        fired, machine = indices(guards.at_fired, guards.n_guards), indices(guards.at_guard_machine, guards.n_guards)
        chatters = indices(settling.at_chatters, settling.n_zones)
        for k in range(guards.n_fired):
            z = machine[fired[k]]
            if z >= 0:
                block(problem, run, point, guards, z)
                chatters[z] += 1


@compiled
def watch_chatter(m, z):
    """Count toggles of machine z that follow each other within a dwell; react when they become a streak."""
    run, point, settling = m.run, m.point, m.events.settling
    last, streak = reals(settling.at_last_toggle, settling.n_zones), indices(settling.at_streak, settling.n_zones)
    if point.t > last[z]:
        streak[z] = streak[z] + 1 if point.t - last[z] < run.dwell else 0
        last[z] = point.t
        if streak[z] >= CHATTER_STREAK:
            indices(settling.at_chatters, settling.n_zones)[z] += 1
            if run.on_chatter == HOLD:
                block(m.problem, run, point, m.events.guards, z)
            elif run.on_chatter == STOP:
                m.linear.factors.culprit = z
                run.stop_asked = 1


@compiled
def block(problem, run, point, guards, z):
    """Hold machine z in its zone for one dwell."""
    reals(guards.at_blocked_until, problem.n_zones)[z] = point.t + run.dwell
    run.t_release = min(run.t_release, point.t + run.dwell)
