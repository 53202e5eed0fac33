"""Slip fronts: what contacts will do that a pass does not show yet. Guesses, which the guards judge; they save passes.

A contact that lets go hands its excess on. Where fronts of slipping run through a chain of contacts, the first that
still holds screens the others from the load, and one would be found per pass, each with a solve through all factors:

    redistribution   neighbours, those whose held speeds its own act on, are given their share of what is above its
                     limit, and let go at once if that is above theirs, and hand on what is above that
    prediction       a front that ran through k contacts in the last step is expected to run through most of as many
                     in this one: they let go before anything is solved
    learning         contacts that let go so were never asked whether their laws jump; they count as continuous where
                     that of a neighbour was seen to be, which keeps redistribution going from one to the next

docs/stepping.md says how much of the work each saves ("Slip fronts").
"""

from __future__ import annotations

from fairlead.integrate.events.patterns import remember_pattern
from fairlead.integrate.memory.foreign import compiled, indices, reals, switch_at

HANDED_ON, RUNS_ON = 0.8, 0.7
"""Share of an excess that reaches a neighbour; share of a front's last advance that is taken for granted. Above
one, contacts are let go that must be captured again, and catching takes with it some that had to go."""
LONGEST_FRONT = 64
MET = 1
"""What `met` says of a machine that lets go. It is 0 of others, and the place in `fired` + 2 of one that was handed a
load in the round that is going on (`redistribute_from`). Between two passes all are 0."""


@compiled
def predict_fronts(m, h):
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
def redistribute_load(guards, contacts):
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
            redistribute_from(guards, contacts, k)
        for k in range(end, guards.n_fired):
            met[machine[fired[k]]] = MET
        begin = end
    for k in range(guards.n_fired):
        if machine[fired[k]] >= 0:
            met[machine[fired[k]]] = 0


@compiled
def redistribute_from(guards, contacts, k):
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
