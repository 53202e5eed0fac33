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

from fairlead.integrate.foreign import compiled, copy, indices, reals, switch_at
from fairlead.integrate.least_index import HALF, keep_first, number_machines

HANDED_ON, RUNS_ON = 0.8, 0.7
"""Share of an excess that reaches a neighbour; share of a front's last advance that is taken for granted. Above
one, contacts are let go that must be caught again, and catching takes with it some that had to go."""
LONGEST_FRONT = 64
MET = 1
"""What `met` says of a machine that lets go; 0 of others."""


@compiled
def begin_set(m):
    """Remember the zones at the start of the step."""
    m.passes = 0
    m.one_by_one = 0
    m.fewest = m.n_guards + 1
    m.stage_from = 0
    m.newly_held = 0
    caught, row = indices(m.at_caught, m.n), indices(m.at_hold_mass_row, m.n_hold_mass)
    for e in range(m.n_hold_mass):
        caught[row[e]] = 0
    copy(indices(m.at_zones, m.n_zones), indices(m.at_zones_at_start, m.n_zones))
    reals(m.at_patterns_met, m.max_passes + 1)[0] = pattern_of_zones(m)


@compiled
def expect_fronts(m, h):
    """Let go, before anything is solved, of contacts ahead of the fronts that ran in the last step."""
    m.expecting = 0
    if m.n_neighbours == 0 or m.gap == 0.0 or m.failed > 0:
        return
    nz, ng = m.n_zones, m.n_guards
    released, slot, first = indices(m.at_released, nz), indices(m.at_released_by, nz), indices(m.at_first_guard, nz)
    starts, neighbours = indices(m.at_neighbour_starts, nz + 1), indices(m.at_neighbours, m.n_neighbours)
    fired, met, known = indices(m.at_fired, ng), indices(m.at_met, nz), indices(m.at_continuous, ng)
    zones = indices(m.at_zones, nz)
    m.n_fired = 0
    for z in range(nz):
        if released[z] == m.steps and not still_holds(m, z):
            for e in range(starts[z], starts[z + 1]):
                w, behind = neighbours[e], z
                if not still_holds(m, w):
                    continue
                rest = int(RUNS_ON * h / (2.0 * m.gap) * length_of_front(m, z, w))
                while rest > 0 and w >= 0 and still_holds(m, w) and met[w] == 0:
                    i = first[w] + slot[z]
                    if known[first[z] + slot[z]] != zones[w] + 1:
                        break
                    known[i] = zones[w] + 1
                    met[w] = 1
                    fired[m.n_fired] = i
                    m.n_fired += 1
                    rest -= 1
                    ahead = next_in_line(m, w, behind)
                    w, behind = ahead, w
    for k in range(m.n_fired):
        w = indices(m.at_guard_machine, ng)[fired[k]]
        met[w] = 0
        released[w] = m.steps + 1
        slot[w] = fired[k] - first[w]
    if m.n_fired > 0:
        switch_at(m.call_switch, (m.context, m.t + h, m.at_y_end, m.at_fired, m.n_fired))
        m.zones_differ = 1
        m.expecting = 1
        m.passes = 1
        reals(m.at_patterns_met, m.max_passes + 1)[1] = pattern_of_zones(m)


@compiled
def still_holds(m, z):
    """True if the row of machine z holds."""
    row = indices(m.at_hold_row, m.n_zones)[z]
    return row >= 0 and indices(m.at_holds, m.n)[row] == 1


@compiled
def length_of_front(m, z, ahead):
    """How many contacts in line, z the last of them, let go in the last step."""
    released, length = indices(m.at_released, m.n_zones), 1
    while length < LONGEST_FRONT:
        behind = next_in_line(m, z, ahead)
        if behind < 0 or released[behind] != m.steps:
            break
        z, ahead = behind, z
        length += 1
    return length


@compiled
def next_in_line(m, z, before):
    """The neighbour of z on the other side than `before`, -1 at an end or a branch."""
    starts, neighbours = indices(m.at_neighbour_starts, m.n_zones + 1), indices(m.at_neighbours, m.n_neighbours)
    other, count = -1, 0
    for e in range(starts[z], starts[z + 1]):
        if neighbours[e] != before:
            other = neighbours[e]
            count += 1
    return other if count == 1 else -1


@compiled
def violators(m):
    """Fill `fired` with the guards above their tolerance at the end of the step."""
    g, tolerance = reals(m.at_g_end, m.n_guards), reals(m.at_guard_tolerance, m.n_guards)
    fired = indices(m.at_fired, m.n_guards)
    m.n_fired = 0
    for i in range(m.n_guards):
        if g[i] > tolerance[i]:
            fired[m.n_fired] = i
            m.n_fired += 1


@compiled
def follow_guards(m, h, cascade):
    """Switch on `fired`, all or the first; True if the switch changes unknowns (a rebound)."""
    if m.passes >= m.max_passes:
        m.passes += 1
        return False
    if m.n_fired < m.fewest:
        m.fewest = m.n_fired
        m.one_by_one = 0
    if m.one_by_one == 2:
        keep_first(m)
    elif m.one_by_one == 1:
        keep_worst(m, h)
    elif cascade:
        hand_on(m)
    note_released(m)
    y, after = reals(m.at_y_end, m.n), reals(m.at_y_probe, m.n)
    copy(y, after)
    switch_at(m.call_switch, (m.context, m.t + h, m.at_y_probe, m.at_fired, m.n_fired))
    m.zones_differ = 1
    m.passes += 1
    m.settling_passes += 1
    if m.one_by_one < 2 and recurs(m):
        m.one_by_one += 1
        number_machines(m, m.at_g_end)
        m.stage_from = m.passes
    changed = False
    for k in range(m.n):
        changed = changed or y[k] != after[k]
    return changed


@compiled
def keep_worst(m, h):
    """Of the violators in `fired` keep those at least half as wrong as the worst, by the force each is wrong by."""
    fired, is_limit = indices(m.at_fired, m.n_guards), indices(m.at_limit_guard, m.n_guards)
    g, inertia = reals(m.at_g_end, m.n_guards), reals(m.at_guard_inertia, m.n_guards)
    wrong, worst = reals(m.at_wrong, m.n_guards), 0.0
    for k in range(m.n_fired):
        i = fired[k]
        wrong[k] = g[i] if is_limit[i] == 1 else g[i] * max(inertia[i], 1e-30) / h
        worst = max(worst, wrong[k])
    count = 0
    for k in range(m.n_fired):
        if wrong[k] >= HALF * worst:
            fired[count] = fired[k]
            count += 1
    m.n_fired = count


@compiled
def hand_on(m):
    """Add to `fired` the limits of neighbours that still hold and will be handed too much.

    From neighbour to neighbour, all of one distance at once; who is handed something from two sides takes the larger,
    so that it does not matter from which side one begins.
    """
    ng, nz = m.n_guards, m.n_zones
    fired, machine, excess = indices(m.at_fired, ng), indices(m.at_guard_machine, ng), reals(m.at_g_probe, ng)
    g, met = reals(m.at_g_end, ng), indices(m.at_met, nz)
    for k in range(m.n_fired):
        excess[k] = g[fired[k]]
        if machine[fired[k]] >= 0:
            met[machine[fired[k]]] = MET
    begin = 0
    while begin < m.n_fired:
        end = m.n_fired
        for k in range(begin, end):
            hand_on_from(m, k)
        for k in range(end, m.n_fired):
            met[machine[fired[k]]] = MET
        begin = end
    for k in range(m.n_fired):
        if machine[fired[k]] >= 0:
            met[machine[fired[k]]] = 0


@compiled
def hand_on_from(m, k):
    """Hand what is too much for the contact of fired guard k to its neighbours; `met` of a new one is its place + 2."""
    ng, nz = m.n_guards, m.n_zones
    fired, machine, is_limit = indices(m.at_fired, ng), indices(m.at_guard_machine, ng), indices(m.at_limit_guard, ng)
    g, tolerance, excess = reals(m.at_g_end, ng), reals(m.at_guard_tolerance, ng), reals(m.at_g_probe, ng)
    first, starts = indices(m.at_first_guard, nz), indices(m.at_neighbour_starts, nz + 1)
    neighbours, zones, met = indices(m.at_neighbours, m.n_neighbours), indices(m.at_zones, nz), indices(m.at_met, nz)
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
            at = m.n_fired
            m.n_fired += 1
            excess[at] = -1.0
            met[w] = at + 2
        if over > excess[at]:
            fired[at], excess[at] = j, over


@compiled
def note_released(m):
    """Remember which contacts let go in this step, and by which guard."""
    fired, machine = indices(m.at_fired, m.n_guards), indices(m.at_guard_machine, m.n_guards)
    is_limit, first = indices(m.at_limit_guard, m.n_guards), indices(m.at_first_guard, m.n_zones)
    released, slot = indices(m.at_released, m.n_zones), indices(m.at_released_by, m.n_zones)
    for k in range(m.n_fired):
        z = machine[fired[k]]
        if z >= 0 and is_limit[fired[k]] == 1 and still_holds(m, z):
            released[z] = m.steps + 1
            slot[z] = fired[k] - first[z]
    learn_from_neighbours(m)


@compiled
def learn_from_neighbours(m):
    """Limits in `fired` at which the law of a neighbour was seen to be continuous count as continuous here too."""
    known, first = indices(m.at_continuous, m.n_guards), indices(m.at_first_guard, m.n_zones)
    released, slot = indices(m.at_released, m.n_zones), indices(m.at_released_by, m.n_zones)
    starts, neighbours = indices(m.at_neighbour_starts, m.n_zones + 1), indices(m.at_neighbours, m.n_neighbours)
    fired, machine = indices(m.at_fired, m.n_guards), indices(m.at_guard_machine, m.n_guards)
    is_limit, zones = indices(m.at_limit_guard, m.n_guards), indices(m.at_zones, m.n_zones)
    found = m.n_guards
    while found > 0:  # as often as one learns from another that has just learned
        found = 0
        for k in range(m.n_fired):
            i, z = fired[k], machine[fired[k]]
            if z < 0 or is_limit[i] == 0 or known[i] == zones[z] + 1:
                continue
            for e in range(starts[z], starts[z + 1]):
                w = neighbours[e]
                if released[w] >= m.steps and slot[w] == i - first[z] and known[first[w] + slot[w]] == zones[z] + 1:
                    known[i] = zones[z] + 1
                    found += 1
                    break


@compiled
def pattern_of_zones(m):
    """A number that stands for the zones in force; two patterns share one by accident once in 10^15."""
    zones = indices(m.at_zones, m.n_zones)
    number = 0
    for z in range(m.n_zones):
        number = (number * 1099511628211 + zones[z] + 1) & 0xFFFFFFFFFFFFF
    return float(number)


@compiled
def recurs(m):
    """True if the zones now in force were already in force in this step; remembers them."""
    met, now = reals(m.at_patterns_met, m.max_passes + 1), pattern_of_zones(m)
    found = False
    for k in range(m.stage_from, m.passes):
        found = found or met[k] == now
    met[m.passes] = now
    return found
