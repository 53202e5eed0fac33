"""Settling: fire, switch, make the point consistent, judge the guards, repeat until none fires.

    contacts whose friction falls, as soon as there is more than one of them in it: in the order of release (release.py)
    all violators change at once
    if a pattern of zones recurs, or their number has not fallen for a while: those at least half as wrong
        as the worst; if a pattern recurs again: the worst alone; and again: the one of least index; and again: that
        and all at once in turn, since two diodes in a row that a current leaves together change by no single switch
    a pattern without an answer for the forces: what is wrong by speeds and places changes (no_answer.py)
    a pattern that leaves an unknown open, as a node without inertia of which all contacts slide: one near it
    no settlement within `max_passes` is an error that names what still switches

How wrong a zone is, is a force (violators.py). The least index always comes to an end
(least_index.py), while all at once may not. It is the last because it takes many passes: 300 contacts in a
random tree with 300 more, 240 on average, where half as wrong as the worst took 58 (and re-holding one by one while
all that must break, as many as the least index).
"""

from __future__ import annotations

from fairlead.integrate.codes import DONE, NO_ROOM, RELEASED, SETTLING_FOR_IT, SINGULAR, TOO_MANY_PASSES
from fairlead.integrate.events.balance import MOST_JUMPS, jump_to_balance
from fairlead.integrate.events.chatter import HOLD, watch_chatter, watch_progress
from fairlead.integrate.events.least_index import keep_first, keep_worst, number_machines
from fairlead.integrate.events.left_open import change_to_near_pattern
from fairlead.integrate.events.no_answer import find_answer
from fairlead.integrate.events.patterns import note_pattern, remember_pattern
from fairlead.integrate.events.release import add_ties, begin_release, order_matters, release
from fairlead.integrate.events.torn_loose import tear_first
from fairlead.integrate.events.violators import fire_violators, look_ahead, looked_ahead
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals, switch_at
from fairlead.integrate.record.rows import there_is_room, write_event

NEARER, LOOKS = 0.1, 3
"""How much less far guards are looked ahead for when single switches go in a circle, and how often. Nearer still no
guard would be seen to rise, and laws that contradict each other would pass for settled."""
ALL, HALF_AS_WRONG, LEAST_INDEX = 0, 1, 3
"""What `stage` says; between the last two it is the worst alone."""
PATIENCE = 10
"""Passes in which the number of violators need not fall below what it was."""


@compiled
def settle(m, iterations):
    """Settle the zones at the point, first firing what is in `fired`; DONE or why not.

    After INACCURATE (new pivots) and NO_ROOM (emptied buffers) it is called again and goes on.
    """
    problem, run, point, events, guards = m.problem, m.run, m.point, m.events, m.events.guards
    settling = m.events.settling
    moves = 0
    while moves <= MOST_JUMPS:
        if guards.n_fired > 0:
            if settling.passes >= run.max_passes:
                return TOO_MANY_PASSES
            if not there_is_room(problem, m.recorder) or wants_empty_log(problem, run, settling, m.recorder):
                return NO_ROOM
            if problem.falling == 1 and settling.passes == 0:
                add_ties(problem, run, point, events)
            change_zones(m)
        status = release_in_order(m)
        if status == DONE and guards.n_fired > 0:
            continue
        if status == DONE:
            status = find_answer(m, iterations)
        status = settle_nearby(m, status)
        if status == RELEASED:
            continue
        if status != DONE:
            return status
        fire_violators(problem, run, point, events)
        if guards.n_fired > 0 and order_matters(problem, events):
            status = begin_release(problem, point, m.linear, events)
            if status != DONE:
                return status
        elif still_wrong(problem, run, point, events):
            choose(problem, events)
        else:
            guards.n_fired = 0
            moves += 1
            if not jump_to_balance(m):
                return DONE
    return DONE


@compiled
def wants_empty_log(problem, run, settling, recorder):
    """True if the log is to be emptied before the first change, so that what circles can be taken out of it.

    Else it would depend on how full the log was, and so on slices, how much of that is still there (`keep_last_event`).
    """
    all_changes = run.max_passes * problem.n_machines
    begins = run.on_chatter == HOLD and settling.passes == 0
    return begins and recorder.events > 0 and recorder.events + all_changes > recorder.event_capacity


@compiled
def release_in_order(m):
    """Go on with the order of release, if there is one that does not go in a circle."""
    loads = m.events.loads
    if m.events.settling.passes >= m.run.max_passes // 2:
        loads.levels, loads.level_due = 0, 0
    return release(m) if loads.levels + loads.level_due > 0 else DONE


@compiled
def still_wrong(problem, run, point, events):
    """True if a zone must change; not where single switches go in a circle and all are at their limits."""
    if events.guards.n_fired == 0 or events.settling.stage <= LEAST_INDEX:
        return events.guards.n_fired > 0
    if not looked_ahead(events.guards):
        look_ahead(problem, run, point, events)
    return not all_at_limits(events)


@compiled
def begin_settling(problem, run, point, events):
    """Forget the last settlement and remember the zones in force as the first pattern of this one.

    What counts once a settlement is done here: `settle` is left and entered again for other pivots or empty buffers.
    """
    settling, loads = events.settling, events.loads
    settling.passes = 0
    loads.levels, loads.level_due, loads.ordered = 0, 0, 0
    settling.without_answer = 0
    settling.stage, settling.stage_from, settling.fewest, settling.waited = ALL, 0, settling.n_guards + 1, 0
    settling.lookahead = 0.0
    settling.nearness = 1.0
    remember_pattern(run, settling)
    watch_progress(problem, run, point, events)


@compiled
def change_zones(m):
    """Switch on the guards in `fired`, log what changed, see whether the pattern of zones recurs."""
    problem, run, point, guards, settling = m.problem, m.run, m.point, m.events.guards, m.events.settling
    nz = problem.n_machines
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
    elif note_pattern(run, settling):
        next_stage(problem, m.events)


@compiled
def settle_nearby(m, status):
    """RELEASED if other zones are to be tried, else as it was.

    For SINGULAR those that leave nothing open (left_open.py), which are in force then; for DONE those without the held
    contacts that contradict others (torn_loose.py), which are in `fired`. NO_ROOM if the buffer of events is to be
    emptied first; called again it comes to the same.
    """
    settling = m.events.settling
    if status == DONE and tear_first(m):
        return RELEASED
    if status != SINGULAR:
        return status
    if not there_is_room(m.problem, m.recorder):
        return NO_ROOM
    if settling.passes == 0 or settling.passes >= m.run.max_passes or not change_to_near_pattern(m):
        return SINGULAR
    log_changes(m)
    settling.passes += 1
    settling.settling_passes += 1
    if note_pattern(m.run, settling):
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
        settling.lookahead *= NEARER
        settling.nearness *= NEARER


@compiled
def choose(problem, events):
    """Of the violators in `fired` keep those that change in this pass."""
    guards, settling = events.guards, events.settling
    settling.waited += 1
    if guards.n_fired < settling.fewest:
        settling.fewest, settling.waited = guards.n_fired, 0
    if settling.stage == ALL and settling.waited > PATIENCE:
        next_stage(problem, events)
    if settling.stage == ALL:
        return
    if settling.stage > LEAST_INDEX and (settling.passes - settling.stage_from) % 2 == 1:
        return
    if settling.stage >= LEAST_INDEX:
        keep_first(events)
        return
    keep_worst(events, settling.stage == HALF_AS_WRONG)


@compiled
def all_at_limits(events):
    """True if any zone will do: each violator is at its limit as far ahead as was looked first, or below it by then.

    The current of a coil runs out through a diode. Where that conducts, u follows the current i by 0.1 ohm, is at its
    limit, and rises over it. Where it blocks, u follows i by a megaohm, is above its limit, and falls so much faster.
    Both say that the switch is now; the second zone is right as soon as i is the least bit smaller.
    """
    guards = events.guards
    g, tolerance = reals(guards.at_g, guards.n_guards), reals(guards.at_guard_tolerance, guards.n_guards)
    probe, fired = reals(guards.at_g_probe, guards.n_guards), indices(guards.at_fired, guards.n_guards)
    within = True
    for k in range(guards.n_fired):
        i = fired[k]
        later = g[i] + (probe[i] - g[i]) / events.settling.nearness
        within = within and later <= (tolerance[i] if g[i] <= tolerance[i] else 0.0)
    return within


@compiled
def log_changes(m):
    """Write an event for every machine that changed and for every guard that fired without changing one."""
    run, point, guards, settling, recorder = m.run, m.point, m.events.guards, m.events.settling, m.recorder
    if run.first_sample == SETTLING_FOR_IT:
        return
    nz, ng = settling.n_machines, guards.n_guards
    zones, before = indices(settling.at_zones, nz), indices(settling.at_zones_before, nz)
    machine, fired = indices(guards.at_guard_machine, ng), indices(guards.at_fired, ng)
    for k in range(guards.n_fired):
        owner = machine[fired[k]]
        if owner < 0:
            write_event(point, settling, recorder, -1, 0, 0, fired[k])
        elif zones[owner] == before[owner]:
            write_event(point, settling, recorder, owner, before[owner], before[owner], fired[k])
    for z in range(nz):
        if zones[z] != before[z]:
            log_change(m, z)


@compiled
def log_change(m, z):
    """Write the event of machine z, which changed."""
    run, guards, settling = m.run, m.events.guards, m.events.settling
    nz, ng = settling.n_machines, guards.n_guards
    zones, before = indices(settling.at_zones, nz), indices(settling.at_zones_before, nz)
    machine, fired = indices(guards.at_guard_machine, ng), indices(guards.at_fired, ng)
    guard = -1
    for k in range(guards.n_fired):
        if machine[fired[k]] == z:
            guard = fired[k]
            break
    write_event(m.point, settling, m.recorder, z, before[z], zones[z], guard)
    settling.switches += 1
    indices(settling.at_switches_by_machine, nz)[z] += 1
    if run.is_part == 1 and indices(settling.at_boundary, nz)[z] == 1:
        run.boundary_switched = 1
    watch_chatter(m, z)


