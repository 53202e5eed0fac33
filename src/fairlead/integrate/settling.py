"""Settling: fire, switch, make the point consistent, judge the guards, repeat until none fires.

    all violators change at once;
    if a pattern of zones recurs, the violator of least index changes, one per pass
    no settlement within `max_passes` is an error that names what still switches

Judged at (t, y, y') right after a switch: a guard above its tolerance violates; one within its
tolerance violates if it is rising along (1, y'), so a slide guard at v_rel = 0 is the sign of a_rel.
The least index is not arbitrary: for the complementarity problem that stick and slip pose (a matrix
with positive principal minors) changing the violator of least index never returns to a pattern
(Murty, Opsearch 11:123, 1974), while all at once may.
"""

from __future__ import annotations

from fairlead.integrate.controller import weighted_norm
from fairlead.integrate.foreign import compiled, copy, indices, reals, switch_at
from fairlead.integrate.guards import evaluate_guards
from fairlead.integrate.linear import DONE
from fairlead.integrate.record import there_is_room, write_event
from fairlead.integrate.start import consistent

NOT_SETTLED, NO_ROOM = 4, 5
CHATTER_STREAK = 8
"""Toggles in a row, each within a dwell of the one before, that make a machine chatter."""
WARN, HOLD, STOP = 0, 1, 2
ROUNDING = 1e-3
"""How far below zero, in guard tolerances, a guard still counts as at its limit: further down it is inside
its zone and will cross by itself. A contact at rest just inside a border would else be sent to and fro."""
NUDGE, RISE = 1e-3, 1e-6
"""How far, in weights, the point is moved along y' to see guards rise, and the rise, in guard
tolerances, that counts: rounding of a guard at rest is far below, the slope of one in motion above."""


@compiled
def settle(m, iterations):
    """Settle the zones at the point, first firing what is in `fired`; DONE or why not.

    After INACCURATE (new pivots) and NO_ROOM (emptied buffers) it is called again and goes on.
    """
    while True:
        if m.n_fired > 0:
            if m.passes >= m.max_passes:
                return NOT_SETTLED
            if not there_is_room(m):
                return NO_ROOM
            change_zones(m)
        status = consistent(m, iterations)
        if status != DONE:
            return status
        judge(m)
        if m.n_fired == 0:
            return DONE
        if m.one_by_one == 1:
            m.n_fired = 1


@compiled
def begin_settling(m):
    """Forget the last settlement and remember the zones in force as the first pattern of this one."""
    m.passes = 0
    m.one_by_one = 0
    copy(indices(m.at_zones, m.n_zones), indices(m.at_zones_history, m.n_zones))


@compiled
def change_zones(m):
    """Switch on the guards in `fired`, log what changed, see whether the pattern of zones recurs."""
    nz = m.n_zones
    zones, before = indices(m.at_zones, nz), indices(m.at_zones_before, nz)
    copy(zones, before)
    switch_at(m.call_switch, (m.context, m.t, m.at_y, m.at_fired, m.n_fired))
    log_changes(m)
    m.n_fired = 0
    m.passes += 1
    m.settling_passes += 1
    if m.passes < m.max_passes:
        copy(zones, indices(m.at_zones_history + 8 * m.passes * nz, nz))
    if m.one_by_one == 0 and recurs(m):
        m.one_by_one = 1


@compiled
def recurs(m):
    """True if the zones now in force were already in force in this settlement."""
    nz = m.n_zones
    zones = indices(m.at_zones, nz)
    for k in range(min(m.passes, m.max_passes)):
        earlier = indices(m.at_zones_history + 8 * k * nz, nz)
        same = True
        for z in range(nz):
            same = same and earlier[z] == zones[z]
        if same:
            return True
    return False


@compiled
def log_changes(m):
    """Write an event for every machine that changed and for every guard that fired without changing one."""
    nz, ng = m.n_zones, m.n_guards
    zones, before = indices(m.at_zones, nz), indices(m.at_zones_before, nz)
    machine, fired = indices(m.at_guard_machine, ng), indices(m.at_fired, ng)
    by_machine = indices(m.at_switches_by_machine, nz)
    for k in range(m.n_fired):
        owner = machine[fired[k]]
        if owner < 0:
            write_event(m, -1, 0, 0, fired[k])
        elif zones[owner] == before[owner]:
            write_event(m, owner, before[owner], before[owner], fired[k])
    for z in range(nz):
        if zones[z] != before[z]:
            guard = -1
            for k in range(m.n_fired):
                if machine[fired[k]] == z:
                    guard = fired[k]
                    break
            write_event(m, z, before[z], zones[z], guard)
            m.switches += 1
            by_machine[z] += 1
            watch_chatter(m, z)


@compiled
def watch_chatter(m, z):
    """Count toggles of machine z that follow each other within a dwell; react when they become a streak."""
    last, streak = reals(m.at_last_toggle, m.n_zones), indices(m.at_streak, m.n_zones)
    if m.t > last[z]:
        streak[z] = streak[z] + 1 if m.t - last[z] < m.dwell else 0
        last[z] = m.t
        if streak[z] >= CHATTER_STREAK:
            indices(m.at_chatters, m.n_zones)[z] += 1
            if m.on_chatter == HOLD:
                block(m, z)
            elif m.on_chatter == STOP:
                m.culprit = z
                m.stop_asked = 1


@compiled
def block(m, z):
    """Hold machine z in its zone for one dwell."""
    reals(m.at_blocked_until, m.n_zones)[z] = m.t + m.dwell
    m.t_release = min(m.t_release, m.t + m.dwell)


@compiled
def judge(m):
    """Fill `fired` with the guards that violate at the point, `g` with their values there."""
    ng = m.n_guards
    m.n_fired = 0
    if ng == 0:
        return
    evaluate_guards(m, m.t, m.at_y, m.at_g)
    g, tolerance, probe = reals(m.at_g, ng), reals(m.at_guard_tolerance, ng), reals(m.at_g_probe, ng)
    at_limit = False
    for i in range(ng):
        at_limit = at_limit or abs(g[i]) <= tolerance[i]
    if at_limit:
        look_ahead(m)
    fired = indices(m.at_fired, ng)
    for i in range(ng):
        close = at_limit and -ROUNDING * tolerance[i] <= g[i] <= tolerance[i]
        if g[i] > tolerance[i] or (close and probe[i] - g[i] > RISE * tolerance[i]):
            fired[m.n_fired] = i
            m.n_fired += 1


@compiled
def look_ahead(m):
    """Guards a little later, along (1, y'), into `g_probe`; algebraic unknowns move as the equations say."""
    n = m.n
    y, slope, ahead = reals(m.at_y, n), reals(m.at_slope, n), reals(m.at_y_probe, n)
    curvature, differential, u = reals(m.at_curvature, n), indices(m.at_differential, n), reals(m.at_u, n)
    for k in range(n):
        u[k] = slope[k] if differential[k] == 1 else curvature[k]
    speed = weighted_norm(m, m.at_u)
    distance = 1e-6 * (m.stop - m.start)
    if speed > 0.0:
        distance = min(distance, NUDGE / speed)
    distance = max(distance, 1e-13 * abs(m.t))
    for k in range(n):
        ahead[k] = y[k] + distance * u[k]
    evaluate_guards(m, m.t + distance, m.at_y_probe, m.at_g_probe)
