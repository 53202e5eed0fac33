"""Settling: fire, switch, make the point consistent, judge the guards, repeat until none fires.

    contacts whose friction falls, as soon as there is more than one of them in it: in the order of release (release.py)
    all violators change at once
    if a pattern of zones recurs, or their number has not fallen for a while: those at least half as wrong
        as the worst; if a pattern recurs again: the worst alone; and again: the one of least index
    no settlement within `max_passes` is an error that names what still switches

Judged at (t, y, y') right after a switch: a guard above its tolerance violates; one within its
tolerance violates if it is about to rise through zero along (y', y''), so a slide guard at v_rel = 0 is the
sign of a_rel. How wrong a zone is, is a force: what a contact that holds carries beyond its limit, and what
must be added to a contact that slides to keep it from going against its friction, m a_rel (the problem says
with which inertia; where it does not, the least index follows at once). The least index always comes to an end
(least_index.py), while all at once may not. It is the last because it takes many passes: 300 contacts in a
random tree with 300 more, 240 on average, where half as wrong as the worst took 58 (and re-holding one by one while
all that must break, as many as the least index).
"""

from __future__ import annotations

from fairlead.integrate.balance import MOVES, jump_to_balance
from fairlead.integrate.controller import weighted_norm
from fairlead.integrate.foreign import compiled, copy, indices, reals, switch_at
from fairlead.integrate.guards import evaluate_guards
from fairlead.integrate.impulse import RELEASED
from fairlead.integrate.least_index import HALF, keep_first, number_machines
from fairlead.integrate.limits import ROUNDING
from fairlead.integrate.linear import DONE
from fairlead.integrate.record import there_is_room, write_event
from fairlead.integrate.release import add_ties, begin_release, order_matters, release
from fairlead.integrate.start import consistent

NOT_SETTLED, NO_ROOM = 4, 5
CHATTER_STREAK = 8
"""Toggles in a row, each within a dwell of the one before, that make a machine chatter."""
STALL_LIMIT = 5
"""Switches in a row, each within a progress floor of the one before, that earn a machine a dwell."""
WARN, HOLD, STOP = 0, 1, 2
NUDGE, RISE = 1e-3, 1e-6
"""How far, in weights, the point is moved along y' to see guards rise, and the rise, in guard
tolerances, that counts: rounding of a guard at rest is far below, the slope of one in motion above."""
NEARER, LOOKS = 0.1, 3
"""How much less far guards are looked ahead for when single switches go in a circle, and how often. Nearer still no
guard would be seen to rise, and laws that contradict each other would pass for settled."""
ALL, HALF_AS_WRONG, WORST, LEAST_INDEX = 0, 1, 2, 3
PATIENCE = 10
"""Passes in which the number of violators need not fall below what it was."""
SLIP_TIME = 1e-3
"""A slip beyond its tolerance counts as the acceleration that would undo it in this time, s."""


@compiled
def settle(m, iterations):
    """Settle the zones at the point, first firing what is in `fired`; DONE or why not.

    After INACCURATE (new pivots) and NO_ROOM (emptied buffers) it is called again and goes on.
    """
    moves = 0
    while moves <= MOVES:
        if m.n_fired > 0:
            if m.passes >= m.max_passes:
                return NOT_SETTLED
            if not there_is_room(m):
                return NO_ROOM
            if m.falling == 1 and m.passes == 0:
                add_ties(m)
            change_zones(m)
        status = release_in_order(m)
        if status == DONE and m.n_fired > 0:
            continue
        if status == DONE:
            status = consistent(m, iterations)
        if status == RELEASED:
            continue
        if status != DONE:
            return status
        judge(m)
        if m.n_fired > 0 and order_matters(m):
            status = begin_release(m)
            if status != DONE:
                return status
        elif still_wrong(m):
            choose(m)
        else:
            m.n_fired = 0
            moves += 1
            if not jump_to_balance(m):
                return DONE
    return DONE


@compiled
def release_in_order(m):
    """Go on with the order of release, if there is one that does not go in a circle."""
    if m.passes >= m.max_passes // 2:
        m.levels, m.level_due = 0, 0
    return release(m) if m.levels + m.level_due > 0 else DONE


@compiled
def still_wrong(m):
    """True if a zone must change; not where single switches go in a circle and all are at their limits."""
    return m.n_fired > 0 and not (m.stage > LEAST_INDEX and all_at_limits(m))


@compiled
def begin_settling(m):
    """Forget the last settlement and remember the zones in force as the first pattern of this one.

    What counts once a settlement is done here: `settle` is left and entered again for other pivots or empty buffers.
    """
    m.passes = 0
    m.levels, m.level_due, m.ordered = 0, 0, 0
    m.one_by_one = 0
    m.stage, m.stage_from, m.fewest, m.waited = ALL, 0, m.n_guards + 1, 0
    m.look = 0.0
    m.nearness = 1.0
    copy(indices(m.at_zones, m.n_zones), indices(m.at_zones_history, m.n_zones))
    watch_progress(m)


@compiled
def watch_progress(m):
    """Count switches that do not advance; when there are too many, hold the machines for a dwell."""
    if m.n_fired == 0:
        return
    m.stalls = m.stalls + 1 if m.t - m.t_last_switch < m.progress_floor else 0
    m.t_last_switch = m.t
    if m.stalls >= STALL_LIMIT:
        fired, machine = indices(m.at_fired, m.n_guards), indices(m.at_guard_machine, m.n_guards)
        chatters = indices(m.at_chatters, m.n_zones)
        for k in range(m.n_fired):
            z = machine[fired[k]]
            if z >= 0:
                block(m, z)
                chatters[z] += 1


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
    if m.levels > 0:
        m.stage_from = m.passes
    elif recurs(m):
        next_stage(m)


@compiled
def recurs(m):
    """True if the zones now in force were already in force in this stage of the settlement."""
    nz = m.n_zones
    zones = indices(m.at_zones, nz)
    for k in range(m.stage_from, min(m.passes, m.max_passes)):
        earlier = indices(m.at_zones_history + 8 * k * nz, nz)
        z = 0
        while z < nz and earlier[z] == zones[z]:
            z += 1
        if z == nz:
            return True
    return False


@compiled
def next_stage(m):
    """Change fewer zones a pass from now on; patterns of before may come again.

    When fewer cannot be, look less far ahead: a load a little above what a contact holds that falls fast moves it now,
    and no longer a moment later.
    """
    if m.stage == ALL:
        number_machines(m, m.at_g)
    m.stage = m.stage + 1 if m.weighs_guards == 1 else max(m.stage + 1, LEAST_INDEX)
    m.stage_from = m.passes
    if LEAST_INDEX < m.stage <= LEAST_INDEX + LOOKS:
        m.look *= NEARER
        m.nearness *= NEARER


@compiled
def choose(m):
    """Of the violators in `fired` keep those that change in this pass."""
    fired, wrong = indices(m.at_fired, m.n_guards), reals(m.at_wrong, m.n_guards)
    m.waited += 1
    if m.n_fired < m.fewest:
        m.fewest, m.waited = m.n_fired, 0
    if m.stage == ALL and m.waited > PATIENCE:
        next_stage(m)
    if m.stage == ALL:
        return
    if m.stage >= LEAST_INDEX:
        keep_first(m)
        return
    worst = fired[0]
    for k in range(m.n_fired):
        if wrong[fired[k]] > wrong[worst]:
            worst = fired[k]
    kept = 0
    for k in range(m.n_fired):
        if fired[k] == worst or (m.stage == HALF_AS_WRONG and wrong[fired[k]] >= HALF * wrong[worst]):
            fired[kept] = fired[k]
            kept += 1
    m.n_fired = kept


@compiled
def all_at_limits(m):
    """True if every violator is within its tolerance, there and as far ahead as was looked first: any zone will do."""
    g, tolerance = reals(m.at_g, m.n_guards), reals(m.at_guard_tolerance, m.n_guards)
    probe, fired = reals(m.at_g_probe, m.n_guards), indices(m.at_fired, m.n_guards)
    within = True
    for k in range(m.n_fired):
        i = fired[k]
        ahead = g[i] + (probe[i] - g[i]) / m.nearness
        within = within and g[i] <= tolerance[i] and ahead <= tolerance[i]
    return within


@compiled
def log_changes(m):
    """Write an event for every machine that changed and for every guard that fired without changing one."""
    nz, ng = m.n_zones, m.n_guards
    zones, before = indices(m.at_zones, nz), indices(m.at_zones_before, nz)
    machine, fired = indices(m.at_guard_machine, ng), indices(m.at_fired, ng)
    by_machine, rim = indices(m.at_switches_by_machine, nz), indices(m.at_rim, nz)
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
            if m.narrowed == 1 and rim[z] == 1:
                m.woken = 1
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
    """Fill `fired` with the guards that violate at the point, `wrong` with how much, `g` with their values."""
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
    fired, wrong, inertia = indices(m.at_fired, ng), reals(m.at_wrong, ng), reals(m.at_guard_inertia, ng)
    for i in range(ng):
        close = at_limit and -ROUNDING * tolerance[i] <= g[i] <= tolerance[i]
        rises = close and probe[i] >= 0.0 and probe[i] - g[i] > RISE * tolerance[i]
        if g[i] > tolerance[i] or rises:
            wrong[i] = g[i] if g[i] > tolerance[i] else probe[i] - g[i]
            if inertia[i] > 0.0:
                wrong[i] *= inertia[i] / (SLIP_TIME if g[i] > tolerance[i] else m.look)
            fired[m.n_fired] = i
            m.n_fired += 1


@compiled
def look_ahead(m):
    """Guards a little later, along (y', y''), into `g_probe`; algebraic unknowns move as the equations say.

    A contact held at its limit under a growing load and the same contact just sliding, under a load a hair
    below it, must not each send to the other. The slip of the one after a time d is the mean over that time of what
    the other's load is beyond its limit; so guards of slips are taken at d, all others at d/2. And d is the same for
    all zones of a settlement. Where no guard is known for a slip, forces alone are taken at d/2.
    """
    if m.look == 0.0:
        m.look = max(distance_to_look(m), m.least_look)
    if m.weighs_guards == 0:
        move_ahead(m, m.look, 0.5 * m.look)
        evaluate_guards(m, m.t + m.look, m.at_y_probe, m.at_g_probe)
        return
    inertia, probe = reals(m.at_guard_inertia, m.n_guards), reals(m.at_g_probe, m.n_guards)
    late = reals(m.at_g_ahead, m.n_guards)
    move_ahead(m, m.look, m.look)
    evaluate_guards(m, m.t + m.look, m.at_y_probe, m.at_g_ahead)
    move_ahead(m, 0.5 * m.look, 0.5 * m.look)
    evaluate_guards(m, m.t + 0.5 * m.look, m.at_y_probe, m.at_g_probe)
    for i in range(m.n_guards):
        if inertia[i] > 0.0:
            probe[i] = late[i]


@compiled
def move_ahead(m, d, forces):
    """Set `y_probe` to the point moved by the time d along (y', y''), algebraic unknowns by the time `forces`."""
    n = m.n
    y, slope, ahead = reals(m.at_y, n), reals(m.at_slope, n), reals(m.at_y_probe, n)
    curvature, differential = reals(m.at_curvature, n), indices(m.at_differential, n)
    for k in range(n):
        if differential[k] == 1:
            ahead[k] = y[k] + d * (slope[k] + 0.5 * d * curvature[k])
        else:
            ahead[k] = y[k] + forces * curvature[k]


@compiled
def all_fall(m):
    """True if every guard in `fired` falls along (y', y'') from the point, as it was settled."""
    look_ahead(m)
    g, probe = reals(m.at_g, m.n_guards), reals(m.at_g_probe, m.n_guards)
    tolerance, fired = reals(m.at_guard_tolerance, m.n_guards), indices(m.at_fired, m.n_guards)
    falling = True
    for k in range(m.n_fired):
        falling = falling and g[fired[k]] - probe[fired[k]] > RISE * tolerance[fired[k]]
    return falling


@compiled
def distance_to_look(m):
    """How far ahead: NUDGE weights, but no further than y'' leaves y' its direction, nor than 1e-6 of the span."""
    n = m.n
    slope, curvature, u = reals(m.at_slope, n), reals(m.at_curvature, n), reals(m.at_u, n)
    differential = indices(m.at_differential, n)
    for k in range(n):
        u[k] = curvature[k] if differential[k] == 0 else 0.0
    speed = weighted_norm(m, m.at_u)
    for k in range(n):
        u[k] = slope[k] if differential[k] == 1 else 0.0
    motion = weighted_norm(m, m.at_u)
    for k in range(n):
        u[k] = curvature[k] if differential[k] == 1 else 0.0
    bend = weighted_norm(m, m.at_u)
    distance = 1e-6 * (m.stop - m.start)
    if max(speed, motion) > 0.0:
        distance = min(distance, NUDGE / max(speed, motion))
    if motion > 0.0 and bend > 0.0:
        distance = min(distance, motion / bend)
    return max(distance, 1e-13 * abs(m.t))
