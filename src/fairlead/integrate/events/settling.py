"""Settling: fire, switch, make the point consistent, judge the guards, repeat until none fires.

    contacts whose friction falls, as soon as there is more than one of them in it: in the order of release (release.py)
    all violators change at once
    if a pattern of zones recurs, or their number has not fallen for a while: those at least half as wrong
        as the worst; if a pattern recurs again: the worst alone; and again: the one of least index
    a pattern that leaves an unknown open, as a node without inertia of which all contacts slide: one near it
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

from fairlead.integrate.codes import SETTLING_FOR_IT
from fairlead.integrate.events.balance import MOVES, jump_to_balance
from fairlead.integrate.events.consistent import consistent
from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.events.impulse import RELEASED
from fairlead.integrate.events.least_index import HALF, keep_first, number_machines
from fairlead.integrate.events.left_open import near_pattern
from fairlead.integrate.events.limits import ROUNDING, weigh_limits
from fairlead.integrate.events.patterns import recurs, remember_pattern
from fairlead.integrate.events.release import add_ties, begin_release, order_matters, release
from fairlead.integrate.linear.systems import DONE, SINGULAR
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals, switch_at
from fairlead.integrate.point.controller import weighted_norm
from fairlead.integrate.record.rows import there_is_room, write_event

NOT_SETTLED, NO_ROOM = 4, 5
CHATTER_STREAK = 8
"""Toggles in a row, each within a dwell of the one before, that make a machine chatter."""
STALL_LIMIT = 5
"""Switches in a row, each within a progress floor of the one before, that earn a machine a dwell."""
HOLD, STOP = 1, 2
"""What `on_chatter` says, but for 0: warn."""
NUDGE, RISE = 1e-3, 1e-6
"""How far, in weights, the point is moved along y' to see guards rise, and the rise, in guard
tolerances, that counts: rounding of a guard at rest is far below, the slope of one in motion above."""
PLACE_ROUNDING = 4 * 2.0**-52
"""What a place is known to, as a share of itself and of speed times time, the phase of x(t): four ulps each."""
NEARER, LOOKS = 0.1, 3
"""How much less far guards are looked ahead for when single switches go in a circle, and how often. Nearer still no
guard would be seen to rise, and laws that contradict each other would pass for settled."""
ALL, HALF_AS_WRONG, LEAST_INDEX = 0, 1, 3
"""What `stage` says; between the last two it is the worst alone."""
PATIENCE = 10
"""Passes in which the number of violators need not fall below what it was."""
SLIP_TIME = 1e-3
"""A slip beyond its tolerance counts as the acceleration that would undo it in this time, s."""


@compiled
def settle(m, iterations):
    """Settle the zones at the point, first firing what is in `fired`; DONE or why not.

    After INACCURATE (new pivots) and NO_ROOM (emptied buffers) it is called again and goes on.
    """
    problem, run, point, events, guards = m.problem, m.run, m.point, m.events, m.events.guards
    settling = m.events.settling
    moves = 0
    while moves <= MOVES:
        if guards.n_fired > 0:
            if settling.passes >= run.max_passes:
                return NOT_SETTLED
            if not there_is_room(problem, m.recorder):
                return NO_ROOM
            if problem.falling == 1 and settling.passes == 0:
                add_ties(problem, run, point, events)
            change_zones(m)
        status = release_in_order(m)
        if status == DONE and guards.n_fired > 0:
            continue
        if status == DONE:
            status = consistent(m, iterations)
        status = settle_nearby(m, status)
        if status == RELEASED:
            continue
        if status != DONE:
            return status
        judge(problem, run, point, events)
        if guards.n_fired > 0 and order_matters(problem, events):
            status = begin_release(problem, point, m.linear, events)
            if status != DONE:
                return status
        elif still_wrong(events):
            choose(problem, events)
        else:
            guards.n_fired = 0
            moves += 1
            if not jump_to_balance(m):
                return DONE
    return DONE


@compiled
def release_in_order(m):
    """Go on with the order of release, if there is one that does not go in a circle."""
    loads = m.events.loads
    if m.events.settling.passes >= m.run.max_passes // 2:
        loads.levels, loads.level_due = 0, 0
    return release(m) if loads.levels + loads.level_due > 0 else DONE


@compiled
def still_wrong(events):
    """True if a zone must change; not where single switches go in a circle and all are at their limits."""
    return events.guards.n_fired > 0 and not (events.settling.stage > LEAST_INDEX and all_at_limits(events))


@compiled
def begin_settling(problem, run, point, events):
    """Forget the last settlement and remember the zones in force as the first pattern of this one.

    What counts once a settlement is done here: `settle` is left and entered again for other pivots or empty buffers.
    """
    settling, loads = events.settling, events.loads
    settling.passes = 0
    loads.levels, loads.level_due, loads.ordered = 0, 0, 0
    settling.one_by_one = 0
    settling.stage, settling.stage_from, settling.fewest, settling.waited = ALL, 0, settling.n_guards + 1, 0
    settling.look = 0.0
    settling.nearness = 1.0
    remember_pattern(run, settling)
    watch_progress(problem, run, point, events)


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
def change_zones(m):
    """Switch on the guards in `fired`, log what changed, see whether the pattern of zones recurs."""
    problem, run, point, guards, settling = m.problem, m.run, m.point, m.events.guards, m.events.settling
    nz = problem.n_zones
    zones, before = indices(problem.at_zones, nz), indices(settling.at_zones_before, nz)
    copy(zones, before)
    switch_at(problem.call_switch, (problem.context, point.t, point.at_y, guards.at_fired, guards.n_fired))
    log_changes(m)
    guards.n_fired = 0
    settling.passes += 1
    settling.settling_passes += 1
    if m.events.loads.levels > 0:
        settling.stage_from = settling.passes
        remember_pattern(run, settling)
    elif recurs(run, settling):
        next_stage(problem, m.events)


@compiled
def settle_nearby(m, status):
    """For SINGULAR: RELEASED if zones are in force instead that leave nothing open (left_open.py), else as it was.

    NO_ROOM if the buffer of events is to be emptied first; called again it comes to the same.
    """
    settling = m.events.settling
    if status != SINGULAR:
        return status
    if not there_is_room(m.problem, m.recorder):
        return NO_ROOM
    if settling.passes == 0 or settling.passes >= m.run.max_passes or not near_pattern(m):
        return SINGULAR
    log_changes(m)
    settling.passes += 1
    settling.settling_passes += 1
    if recurs(m.run, settling):
        next_stage(m.problem, m.events)
    return RELEASED


@compiled
def next_stage(problem, events):
    """Change fewer zones a pass from now on; patterns of before may come again.

    When fewer cannot be, look less far ahead: a load a little above what a contact holds that falls fast moves it now,
    and no longer a moment later.
    """
    settling = events.settling
    if settling.stage == ALL:
        number_machines(events, events.guards.at_g)
    settling.stage = settling.stage + 1 if problem.weighs_guards == 1 else max(settling.stage + 1, LEAST_INDEX)
    settling.stage_from = settling.passes
    if LEAST_INDEX < settling.stage <= LEAST_INDEX + LOOKS:
        settling.look *= NEARER
        settling.nearness *= NEARER


@compiled
def choose(problem, events):
    """Of the violators in `fired` keep those that change in this pass."""
    guards, settling = events.guards, events.settling
    fired, wrong = indices(guards.at_fired, guards.n_guards), reals(settling.at_wrong, guards.n_guards)
    settling.waited += 1
    if guards.n_fired < settling.fewest:
        settling.fewest, settling.waited = guards.n_fired, 0
    if settling.stage == ALL and settling.waited > PATIENCE:
        next_stage(problem, events)
    if settling.stage == ALL:
        return
    if settling.stage >= LEAST_INDEX:
        keep_first(events)
        return
    worst = fired[0]
    for k in range(guards.n_fired):
        if wrong[fired[k]] > wrong[worst]:
            worst = fired[k]
    kept = 0
    for k in range(guards.n_fired):
        if fired[k] == worst or (settling.stage == HALF_AS_WRONG and wrong[fired[k]] >= HALF * wrong[worst]):
            fired[kept] = fired[k]
            kept += 1
    guards.n_fired = kept


@compiled
def all_at_limits(events):
    """True if every violator is within its tolerance, there and as far ahead as was looked first: any zone will do."""
    guards = events.guards
    g, tolerance = reals(guards.at_g, guards.n_guards), reals(guards.at_guard_tolerance, guards.n_guards)
    probe, fired = reals(guards.at_g_probe, guards.n_guards), indices(guards.at_fired, guards.n_guards)
    within = True
    for k in range(guards.n_fired):
        i = fired[k]
        ahead = g[i] + (probe[i] - g[i]) / events.settling.nearness
        within = within and g[i] <= tolerance[i] and ahead <= tolerance[i]
    return within


@compiled
def log_changes(m):
    """Write an event for every machine that changed and for every guard that fired without changing one."""
    run, point, guards, settling, recorder = m.run, m.point, m.events.guards, m.events.settling, m.recorder
    if run.first_sample == SETTLING_FOR_IT:
        return
    nz, ng = settling.n_zones, guards.n_guards
    zones, before = indices(settling.at_zones, nz), indices(settling.at_zones_before, nz)
    machine, fired = indices(guards.at_guard_machine, ng), indices(guards.at_fired, ng)
    by_machine, rim = indices(settling.at_switches_by_machine, nz), indices(settling.at_rim, nz)
    for k in range(guards.n_fired):
        owner = machine[fired[k]]
        if owner < 0:
            write_event(point, settling, recorder, -1, 0, 0, fired[k])
        elif zones[owner] == before[owner]:
            write_event(point, settling, recorder, owner, before[owner], before[owner], fired[k])
    for z in range(nz):
        if zones[z] != before[z]:
            guard = -1
            for k in range(guards.n_fired):
                if machine[fired[k]] == z:
                    guard = fired[k]
                    break
            write_event(point, settling, recorder, z, before[z], zones[z], guard)
            settling.switches += 1
            by_machine[z] += 1
            if run.narrowed == 1 and rim[z] == 1:
                run.woken = 1
            watch_chatter(m, z)


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


@compiled
def judge(problem, run, point, events):
    """Fill `fired` with the guards that violate at the point, `wrong` with how much, `g` with their values."""
    guards, settling = events.guards, events.settling
    ng = guards.n_guards
    guards.n_fired = 0
    if ng == 0:
        return
    weigh_limits(problem, guards, point.at_y)
    evaluate_guards(problem, run, guards, point.t, point.at_y, guards.at_g)
    g, tolerance, probe = reals(guards.at_g, ng), reals(guards.at_guard_tolerance, ng), reals(guards.at_g_probe, ng)
    known_to = place_rounding(problem, point) if problem.n_met_guards > 0 else 0.0
    met = indices(problem.at_met_guard, problem.n_met_guards)
    for i in met:
        if tolerance[i] < g[i] <= known_to:
            g[i] = 0.0  # a time is no better known than that, so the stop is not passed
    at_limit = False
    for i in range(ng):
        at_limit = at_limit or abs(g[i]) <= tolerance[i]
    if at_limit:
        look_ahead(problem, run, point, events)
        for i in met:
            if abs(probe[i] - g[i]) <= known_to:
                probe[i] = g[i]
    fired, wrong = indices(guards.at_fired, ng), reals(settling.at_wrong, ng)
    inertia = reals(guards.at_guard_inertia, ng)
    for i in range(ng):
        close = at_limit and -ROUNDING * tolerance[i] <= g[i] <= tolerance[i]
        rises = close and probe[i] >= 0.0 and probe[i] - g[i] > RISE * tolerance[i]
        if g[i] > tolerance[i] or rises:
            wrong[i] = g[i] if g[i] > tolerance[i] else probe[i] - g[i]
            if inertia[i] > 0.0:
                wrong[i] *= inertia[i] / (SLIP_TIME if g[i] > tolerance[i] else settling.look)
            fired[guards.n_fired] = i
            guards.n_fired += 1


@compiled
def place_rounding(problem, point):
    """What places at which stops are met are known to: by rounding of places, and of a given one by that of the time.

    Without this a body that leaves a stop on a shaker, or late in a run, met it again at once, and left it, some times
    over.
    """
    position, y, known_to = indices(problem.at_position_of, problem.n), reals(point.at_y, problem.n), 0.0
    for v in range(problem.n):
        if position[v] >= 0:
            known_to = max(known_to, PLACE_ROUNDING * (abs(y[position[v]]) + abs(y[v] * point.t)))
    return known_to


@compiled
def look_ahead(problem, run, point, events):
    """Guards a little later, along (y', y''), into `g_probe`; algebraic unknowns move as the equations say.

    A contact held at its limit under a growing load and the same contact just sliding, under a load a hair
    below it, must not each send to the other. The slip of the one after a time d is the mean over that time of what
    the other's load is beyond its limit; so guards of slips are taken at d, all others at d/2. And d is the same for
    all zones of a settlement. Where no guard is known for a slip, forces alone are taken at d/2.
    """
    guards, settling = events.guards, events.settling
    if settling.look == 0.0:
        settling.look = max(distance_to_look(run, point), settling.least_look)
    if problem.weighs_guards == 0:
        move_ahead(point, settling.look, 0.5 * settling.look)
        evaluate_guards(problem, run, guards, point.t + settling.look, point.at_y_probe, guards.at_g_probe)
        return
    inertia, probe = reals(guards.at_guard_inertia, problem.n_guards), reals(guards.at_g_probe, problem.n_guards)
    late = reals(guards.at_g_ahead, problem.n_guards)
    move_ahead(point, settling.look, settling.look)
    evaluate_guards(problem, run, guards, point.t + settling.look, point.at_y_probe, guards.at_g_ahead)
    move_ahead(point, 0.5 * settling.look, 0.5 * settling.look)
    evaluate_guards(problem, run, guards, point.t + 0.5 * settling.look, point.at_y_probe, guards.at_g_probe)
    for i in range(problem.n_guards):
        if inertia[i] > 0.0:
            probe[i] = late[i]


@compiled
def move_ahead(point, d, forces):
    """Set `y_probe` to the point moved by the time d along (y', y''), algebraic unknowns by the time `forces`."""
    n = point.n
    y, slope, ahead = reals(point.at_y, n), reals(point.at_slope, n), reals(point.at_y_probe, n)
    curvature, differential = reals(point.at_curvature, n), indices(point.at_differential, n)
    for k in range(n):
        if differential[k] == 1:
            ahead[k] = y[k] + d * (slope[k] + 0.5 * d * curvature[k])
        else:
            ahead[k] = y[k] + forces * curvature[k]


@compiled
def all_fall(problem, run, point, events):
    """True if every guard in `fired` falls along (y', y'') from the point, as it was settled."""
    guards = events.guards
    look_ahead(problem, run, point, events)
    g, probe = reals(guards.at_g, guards.n_guards), reals(guards.at_g_probe, guards.n_guards)
    tolerance, fired = reals(guards.at_guard_tolerance, guards.n_guards), indices(guards.at_fired, guards.n_guards)
    falling = True
    for k in range(guards.n_fired):
        falling = falling and g[fired[k]] - probe[fired[k]] > RISE * tolerance[fired[k]]
    return falling


@compiled
def distance_to_look(run, point):
    """How far ahead: NUDGE weights, but no further than y'' leaves y' its direction, nor than 1e-6 of the span."""
    n = point.n
    slope, curvature, u = reals(point.at_slope, n), reals(point.at_curvature, n), reals(point.at_u, n)
    differential = indices(point.at_differential, n)
    for k in range(n):
        u[k] = curvature[k] if differential[k] == 0 else 0.0
    speed = weighted_norm(point, point.at_u)
    for k in range(n):
        u[k] = slope[k] if differential[k] == 1 else 0.0
    motion = weighted_norm(point, point.at_u)
    for k in range(n):
        u[k] = curvature[k] if differential[k] == 1 else 0.0
    bend = weighted_norm(point, point.at_u)
    distance = 1e-6 * (run.stop - run.start)
    if max(speed, motion) > 0.0:
        distance = min(distance, NUDGE / max(speed, motion))
    if motion > 0.0 and bend > 0.0:
        distance = min(distance, motion / bend)
    return max(distance, 1e-13 * abs(point.t))
