"""Machines that switch again and again: counted, and held in their zones for a dwell, or the run ends.

    chatters    a machine that toggles CHATTER_STREAK times in a row, each within a dwell of the one before
    stalls      STALL_LIMIT settlements in a row, each within a progress floor of the one before

A dwell and a floor that are given count as they are. Else they are shares of the span, but a dwell is no longer than
nothing moves by more than STILL of its error weight, and a floor a small part of that: a scene may move much faster
than it lasts, and what lasts longer than its own motion is no chatter, nor may it be held.
"""

from __future__ import annotations

from math import inf

from fairlead.integrate.memory.foreign import compiled, indices, reals
from fairlead.integrate.record.rows import keep_last_event

CHATTER_STREAK = 8
"""Toggles in a row, each within a dwell of the one before, that make a machine chatter."""
STALL_LIMIT = 5
"""Switches in a row, each within a progress floor of the one before, that earn a machine a dwell."""
HOLD, STOP = 1, 2
"""What `on_chatter` says, but for 0: warn."""
STILL = 0.1
"""Of an error weight: what moves less while a zone is held is right to well below its error."""
AGAIN = 4.0
"""Dwells after one within which the next is twice as long: what bounces ever faster and has no zone to rest in falls
through then, and is named, where it would bounce again and again after ever so short a fall."""
MOST_HELD = 100.0
"""Dwells that one may so become: nothing moves by more than ten error weights then, however long the run would last."""
NO_WAY = 1e-3
"""Of STILL: switches nearer to each other than nothing moves by this share of it do not advance."""
RESOLVED = 1e-14
"""Of the time: what is shorter is rounding of the time."""


@compiled
def floor_here(run, point):
    """The progress floor [s] that counts at the point."""
    if run.step_floor_given == 1:
        return run.progress_floor
    return max(min(run.progress_floor, NO_WAY * still_for(point)), RESOLVED * abs(point.t))


@compiled
def is_within_floor(run, point, gap):
    """True if a gap [s] is below the progress floor here; of one that no motion could make so long none is asked."""
    return gap < max(run.progress_floor, RESOLVED * abs(point.t)) and gap < floor_here(run, point)


@compiled
def is_within_dwell(run, point, gap):
    """True if a gap [s] is below the dwell here; of one that no motion could make so long none is asked."""
    return gap < run.dwell and gap < dwell_here(run, point)


@compiled
def dwell_here(run, point):
    """The dwell [s] that counts at the point."""
    if run.dwell_given == 1:
        return run.dwell
    return min(run.dwell, still_for(point))


@compiled
def still_for(point):
    """The time [s] in which nothing moves by more than STILL weights, by the slopes at the last settlement."""
    n, fastest = point.n, 0.0
    slope, weight = reals(point.at_slope, n), reals(point.at_weight, n)
    differential, unweighed = indices(point.at_differential, n), indices(point.at_unweighed, n)
    for k in range(n):
        if differential[k] == 1 and unweighed[k] == 0:
            fastest = max(fastest, abs(slope[k]) / weight[k])
    return STILL / fastest if fastest > 0.0 else inf


@compiled
def watch_progress(problem, run, point, events):
    """Count switches that do not advance; when there are too many, hold the machines for a dwell."""
    guards, settling = events.guards, events.settling
    if guards.n_fired == 0:
        return
    settling.stalls = settling.stalls + 1 if is_within_floor(run, point, point.t - settling.t_last_switch) else 0
    settling.t_last_switch = point.t
    if settling.stalls >= STALL_LIMIT:
        fired, machine = indices(guards.at_fired, guards.n_guards), indices(guards.at_guard_machine, guards.n_guards)
        chatters = indices(settling.at_chatters, settling.n_machines)
        for k in range(guards.n_fired):
            z = machine[fired[k]]
            if z >= 0:
                block(problem, run, point, events, z)
                chatters[z] += 0 if bounces(problem, z) else 1


@compiled
def watch_chatter(m, z):
    """Count toggles of machine z that follow each other within a dwell; react when they become a streak."""
    run, point, settling = m.run, m.point, m.events.settling
    last, streak = reals(settling.at_last_toggle, settling.n_machines), indices(settling.at_streak, settling.n_machines)
    if point.t > last[z]:
        streak[z] = streak[z] + 1 if is_within_dwell(run, point, point.t - last[z]) else 0
        last[z] = point.t
        if streak[z] >= CHATTER_STREAK and not bounces(m.problem, z):
            indices(settling.at_chatters, settling.n_machines)[z] += 1
            if run.on_chatter == HOLD:
                block(m.problem, run, point, m.events, z)
            elif run.on_chatter == STOP:
                m.linear.factors.culprit = z
                run.stop_asked = 1


@compiled
def hold_what_circles(m):
    """Hold for a dwell the machines that went on switching in a settlement without end; True if there are such.

    A comparator without hysteresis whose output drives its input back has no zone to rest in at its level: no time
    passes between its switches, so that none of them is within a dwell of the one before. They count as one switch, or
    as none.
    """
    run, settling = m.run, m.events.settling
    nz, found = settling.n_machines, False
    zones, chatters = indices(settling.at_zones, nz), indices(settling.at_chatters, nz)
    until = reals(m.events.guards.at_blocked_until, nz)
    for z in range(nz):
        circles = False
        for k in range(settling.passes // 2, settling.passes):
            circles = circles or indices(settling.at_zones_history + 8 * k * nz, nz)[z] != zones[z]
        if circles and until[z] <= m.point.t:
            block(m.problem, run, m.point, m.events, z)
            gone = keep_last_event(m.point, m.recorder, z, indices(settling.at_zones_history, nz)[z])
            settling.switches -= gone
            indices(settling.at_switches_by_machine, nz)[z] -= gone
            chatters[z] += 1
            found = True
    m.events.guards.n_fired = 0
    return found


@compiled
def bounces(problem, z):
    """True if machine z gives back a share of an impact: it bounces ever faster until it lies, and that is right."""
    if problem.rebounds == 0:
        return False
    holder, rebound = indices(problem.at_holder, problem.n), reals(problem.at_rebound, problem.n)
    found = False
    for k in range(problem.n):
        found = found or (holder[k] == z and rebound[k] > 0.0)
    return found


@compiled
def block(problem, run, point, events, z):
    """Hold machine z in its zone for one dwell; where one was just over twice as long as before, up to MOST_HELD."""
    until = reals(events.guards.at_blocked_until, problem.n_machines)
    held = reals(events.settling.at_held_for, problem.n_machines)
    dwell = dwell_here(run, point)
    if point.t - until[z] <= AGAIN * held[z]:
        dwell = min(max(dwell, 2.0 * held[z]), MOST_HELD * dwell, run.dwell)
    held[z] = max(dwell, RESOLVED * abs(point.t))
    until[z] = point.t + held[z]
    run.t_release = min(run.t_release, until[z])
