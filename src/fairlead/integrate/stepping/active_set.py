"""The active set of a step: which contacts hold, slide, pull or are apart at its end.

    all whose guards are violated switch at once, and with them those that will be handed too much
    if a pattern of zones recurs, those at least half as wrong as the worst, by the force each is wrong by
    if one recurs again, the one of least index, one per pass (least_index.py); all again, once fewer are
    violated than ever before in the step

A contact that lets go hands its excess on: where fronts of slipping run through a chain of contacts, the
first that still holds screens the others from the load, and one would be found per pass. So its neighbours,
those whose held speeds its own act on, are given their share of what is above its limit, and let go at
once if that is above theirs. And a front that ran through k contacts in the last step is expected to run
through most of as many in this one. Both are guesses; the guards judge what comes of them.
"""

from __future__ import annotations

from fairlead.integrate.events.least_index import keep_first, keep_worst, number_machines
from fairlead.integrate.events.patterns import note_pattern, remember_pattern
from fairlead.integrate.memory.foreign import compiled, copy, indices, reals, switch_at

HANDED_ON, RUNS_ON = 0.8, 0.7
"""Share of an excess that reaches a neighbour; share of a front's last advance that is taken for granted. Above
one, contacts are let go that must be caught again, and catching takes with it some that had to go."""
LONGEST_FRONT = 64
MET = 1
"""What `met` says of a machine that lets go. It is 0 of others, and the place in `fired` + 2 of one that was handed a
load in the round that is going on (`hand_on_from`). Between two passes all are 0."""


@compiled
def begin_set(run, settling, stepping):
    """Remember the zones at the start of the step."""
    rule, exchange = stepping.rule, stepping.exchange
    settling.passes = 0
    settling.one_by_one = 0
    settling.fewest = settling.n_guards + 1
    settling.stage_from = 0
    exchange.newly_held = 0
    caught, row = indices(exchange.at_caught, rule.n), indices(exchange.at_hold_mass_row, exchange.n_hold_mass)
    for e in range(exchange.n_hold_mass):
        caught[row[e]] = 0
    nz = settling.n_machines
    copy(indices(settling.at_zones, nz), indices(stepping.contacts.at_zones_at_start, nz))
    remember_pattern(run, settling)


@compiled
def expect_fronts(m, h):
    """Let go, before anything is solved, of contacts ahead of the fronts that ran in the last step."""
    problem, run, point, guards, stepping = m.problem, m.run, m.point, m.events.guards, m.stepping
    rule, contacts = m.stepping.rule, m.stepping.contacts
    contacts.expecting = 0
    if contacts.n_neighbours == 0 or rule.gap == 0.0 or rule.failed > 0 or rule.frozen == 1:
        return
    nz, ng = problem.n_machines, problem.n_guards
    released, slot = indices(contacts.at_released, nz), indices(contacts.at_released_by, nz)
    first = indices(contacts.at_first_guard, nz)
    starts = indices(contacts.at_neighbour_starts, nz + 1)
    neighbours = indices(contacts.at_neighbours, contacts.n_neighbours)
    fired, met, known = indices(guards.at_fired, ng), indices(contacts.at_met, nz), indices(contacts.at_continuous, ng)
    zones = indices(problem.at_zones, nz)
    guards.n_fired = 0
    for z in range(nz):
        if released[z] == run.steps and not still_holds(stepping, z):
            for e in range(starts[z], starts[z + 1]):
                w, behind = neighbours[e], z
                if not still_holds(stepping, w):
                    continue
                rest = int(RUNS_ON * h / (2.0 * rule.gap) * length_of_front(run, contacts, z, w))
                while rest > 0 and w >= 0 and still_holds(stepping, w) and met[w] == 0:
                    i = first[w] + slot[z]
                    if known[first[z] + slot[z]] != zones[w] + 1:
                        break
                    known[i] = zones[w] + 1
                    met[w] = 1
                    fired[guards.n_fired] = i
                    guards.n_fired += 1
                    rest -= 1
                    beyond = next_in_line(contacts, w, behind)
                    w, behind = beyond, w
    for k in range(guards.n_fired):
        w = indices(problem.at_guard_machine, ng)[fired[k]]
        met[w] = 0
        released[w] = run.steps + 1
        slot[w] = fired[k] - first[w]
    if guards.n_fired > 0:
        switch_at(problem.call_switch, (problem.context, point.t + h, point.at_y_end, guards.at_fired, guards.n_fired))
        m.stepping.exchange.zones_differ = 1
        contacts.expecting = 1
        m.events.settling.passes = 1
        remember_pattern(run, m.events.settling)


@compiled
def still_holds(stepping, z):
    """True if the row of machine z holds."""
    exchange = stepping.exchange
    row = indices(stepping.contacts.at_hold_row, exchange.n_machines)[z]
    return row >= 0 and indices(exchange.at_holds, exchange.n)[row] == 1


@compiled
def length_of_front(run, contacts, z, beyond):
    """How many contacts in line, z the last of them, let go in the last step."""
    released, length = indices(contacts.at_released, contacts.n_machines), 1
    while length < LONGEST_FRONT:
        behind = next_in_line(contacts, z, beyond)
        if behind < 0 or released[behind] != run.steps:
            break
        z, beyond = behind, z
        length += 1
    return length


@compiled
def next_in_line(contacts, z, before):
    """The neighbour of z on the other side than `before`, -1 at an end or a branch."""
    starts = indices(contacts.at_neighbour_starts, contacts.n_machines + 1)
    neighbours = indices(contacts.at_neighbours, contacts.n_neighbours)
    other, count = -1, 0
    for e in range(starts[z], starts[z + 1]):
        if neighbours[e] != before:
            other = neighbours[e]
            count += 1
    return other if count == 1 else -1


@compiled
def follow_guards(m, h, cascade):
    """Switch on `fired`, all, those half as wrong as the worst, or one; True if that changes unknowns (a rebound)."""
    problem, run, point, events, guards = m.problem, m.run, m.point, m.events, m.events.guards
    settling, contacts = m.events.settling, m.stepping.contacts
    if settling.passes >= run.max_passes:
        settling.passes += 1
        return False
    if guards.n_fired < settling.fewest:
        settling.fewest = guards.n_fired
        settling.one_by_one = 0
    if settling.one_by_one == 2:
        keep_first(events)
    elif settling.one_by_one == 1:
        find_how_wrong(events, contacts, h)
        keep_worst(events, True)
    elif cascade:
        hand_on(guards, contacts)
    note_released(run, guards, m.stepping)
    y, after = reals(point.at_y_end, problem.n), reals(point.at_y_probe, problem.n)
    copy(y, after)
    switch_at(problem.call_switch, (problem.context, point.t + h, point.at_y_probe, guards.at_fired, guards.n_fired))
    m.stepping.exchange.zones_differ = 1
    settling.passes += 1
    settling.settling_passes += 1
    if settling.one_by_one < 2 and note_pattern(run, settling):
        settling.one_by_one += 1
        number_machines(events, guards.at_g_end)
        settling.stage_from = settling.passes
    changed = False
    for k in range(problem.n):
        changed = changed or y[k] != after[k]
    return changed


@compiled
def find_how_wrong(events, contacts, h):
    """Set `wrong` of the guards in `fired`: the force that each is wrong by."""
    guards = events.guards
    fired, is_limit = indices(guards.at_fired, guards.n_guards), indices(contacts.at_limit_guard, guards.n_guards)
    g, inertia = reals(guards.at_g_end, guards.n_guards), reals(guards.at_guard_inertia, guards.n_guards)
    wrong = reals(events.settling.at_wrong, guards.n_guards)
    for k in range(guards.n_fired):
        i = fired[k]
        wrong[i] = g[i] if is_limit[i] == 1 else g[i] * max(inertia[i], 1e-30) / h


@compiled
def hand_on(guards, contacts):
    """Add to `fired` the limits of neighbours that still hold and will be handed too much.

    From neighbour to neighbour, all of one distance at once; who is handed something from two sides takes the larger,
    so that it does not matter from which side one begins.
    """
    ng, nz = guards.n_guards, contacts.n_machines
    fired, machine = indices(guards.at_fired, ng), indices(guards.at_guard_machine, ng)
    excess = reals(guards.at_g_probe, ng)
    g, met = reals(guards.at_g_end, ng), indices(contacts.at_met, nz)
    for k in range(guards.n_fired):
        excess[k] = g[fired[k]]
        if machine[fired[k]] >= 0:
            met[machine[fired[k]]] = MET
    begin = 0
    while begin < guards.n_fired:
        end = guards.n_fired
        for k in range(begin, end):
            hand_on_from(guards, contacts, k)
        for k in range(end, guards.n_fired):
            met[machine[fired[k]]] = MET
        begin = end
    for k in range(guards.n_fired):
        if machine[fired[k]] >= 0:
            met[machine[fired[k]]] = 0


@compiled
def hand_on_from(guards, contacts, k):
    """Hand what is too much for the contact of fired guard k to its neighbours; `met` of a new one is its place + 2."""
    ng, nz = guards.n_guards, contacts.n_machines
    fired, machine = indices(guards.at_fired, ng), indices(guards.at_guard_machine, ng)
    is_limit = indices(contacts.at_limit_guard, ng)
    g, tolerance = reals(guards.at_g_end, ng), reals(guards.at_guard_tolerance, ng)
    excess = reals(guards.at_g_probe, ng)
    first, starts = indices(contacts.at_first_guard, nz), indices(contacts.at_neighbour_starts, nz + 1)
    neighbours, zones = indices(contacts.at_neighbours, contacts.n_neighbours), indices(contacts.at_zones, nz)
    met = indices(contacts.at_met, nz)
    i, z = fired[k], machine[fired[k]]
    if z < 0 or is_limit[i] == 0:
        return
    slot, holding = i - first[z], 0
    for e in range(starts[z], starts[z + 1]):
        if met[neighbours[e]] != MET and zones[neighbours[e]] == zones[z]:
            holding += 1
    for e in range(starts[z], starts[z + 1]):
        w = neighbours[e]
        if met[w] == MET or zones[w] != zones[z]:
            continue
        j = first[w] + slot
        over = HANDED_ON * excess[k] / holding + g[j]
        if over <= tolerance[j]:
            continue
        at = met[w] - 2
        if met[w] == 0:
            at = guards.n_fired
            guards.n_fired += 1
            excess[at] = -1.0
            met[w] = at + 2
        if over > excess[at]:
            fired[at], excess[at] = j, over


@compiled
def note_released(run, guards, stepping):
    """Remember which contacts let go in this step, and by which guard."""
    contacts = stepping.contacts
    fired, machine = indices(guards.at_fired, guards.n_guards), indices(guards.at_guard_machine, guards.n_guards)
    is_limit = indices(contacts.at_limit_guard, guards.n_guards)
    first = indices(contacts.at_first_guard, contacts.n_machines)
    released = indices(contacts.at_released, contacts.n_machines)
    slot = indices(contacts.at_released_by, contacts.n_machines)
    for k in range(guards.n_fired):
        z = machine[fired[k]]
        if z >= 0 and is_limit[fired[k]] == 1 and still_holds(stepping, z):
            released[z] = run.steps + 1
            slot[z] = fired[k] - first[z]
    learn_from_neighbours(run, guards, contacts)


@compiled
def learn_from_neighbours(run, guards, contacts):
    """Limits in `fired` at which the law of a neighbour was seen to be continuous count as continuous here too."""
    known = indices(contacts.at_continuous, guards.n_guards)
    first = indices(contacts.at_first_guard, contacts.n_machines)
    released = indices(contacts.at_released, contacts.n_machines)
    slot = indices(contacts.at_released_by, contacts.n_machines)
    starts = indices(contacts.at_neighbour_starts, contacts.n_machines + 1)
    neighbours = indices(contacts.at_neighbours, contacts.n_neighbours)
    fired, machine = indices(guards.at_fired, guards.n_guards), indices(guards.at_guard_machine, guards.n_guards)
    is_limit, zones = indices(contacts.at_limit_guard, guards.n_guards), indices(contacts.at_zones, contacts.n_machines)
    found = guards.n_guards
    while found > 0:  # as often as one learns from another that has just learned
        found = 0
        for k in range(guards.n_fired):
            i, z = fired[k], machine[fired[k]]
            if z < 0 or is_limit[i] == 0 or known[i] == zones[z] + 1:
                continue
            for e in range(starts[z], starts[z + 1]):
                w = neighbours[e]
                if released[w] >= run.steps and slot[w] == i - first[z] and known[first[w] + slot[w]] == zones[z] + 1:
                    known[i] = zones[z] + 1
                    found += 1
                    break
