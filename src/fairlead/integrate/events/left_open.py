"""A pattern of zones that leaves an unknown open is no outcome: another one near it is tried.

No law gives the speed of a node without inertia when all its contacts slide, and all that are beyond their limits let
go at once. What would really happen is told by a node with a little inertia: the stronger contacts accelerate it
until one of the others is caught. So of the patterns

    after a pass in which several changed     only one of them changed
    after a pass in which one changed         one that changed before goes back: the two exchange their places
                                              another that holds lets go, of these the one nearest to its limit

the first one that determines all unknowns is taken, and judged as any other. Only contacts change so. The second is the
exchange of Lemke's method, whose pivot of one vanishes where that of two does not (Cottle, Pang, Stone, The Linear
Complementarity Problem, 1992, section 4.4); so is the third, for a row that holds more than there is to hold: a gear
has its ring on a backstop, a given motion at its sun, and another catches up with its carrier. Where there is none, the
run ends and names what is open.
"""

from __future__ import annotations

from fairlead.integrate.codes import DONE, SINGULAR
from fairlead.integrate.events.consistent import prepare_consistent
from fairlead.integrate.events.guards import evaluate_guards
from fairlead.integrate.memory.foreign import compiled, indices, mass_at, reals, switch_at

NOT_IN_FORCE = -1.0
"""The value of a guard that the zone in force does not have."""


@compiled
def change_to_near_pattern(m):
    """Put a pattern in force near the one that leaves an unknown open; False, and the same as before, without one."""
    nz, settling = m.problem.n_machines, m.events.settling
    zones, before = indices(settling.at_zones, nz), indices(settling.at_zones_before, nz)
    changed = 0
    for z in range(nz):
        if zones[z] != before[z]:
            changed += 1
            if not may_hold(m.problem, z):
                return False
    if changed == 0 or determines(m.problem, m.point, m.linear, True):
        return False
    return change_few(m, changed, True) or change_few(m, changed, False)


@compiled
def change_few(m, changed, surely):
    """One of `changed` machines, an exchange or another that lets go, in this order; see `determines`."""
    if changed > 1:
        return change_one(m.problem, m.point, m.linear, m.events.settling, surely)
    return exchange_one(m.problem, m.point, m.linear, m.events.settling, surely) or open_one(m, surely)


@compiled
def may_hold(problem, z):
    """True if machine z is a contact that may hold."""
    machine = indices(problem.at_guard_machine, problem.n_guards)
    holding, found = indices(problem.at_may_hold, problem.n_guards), False
    for i in range(problem.n_guards):
        found = found or (machine[i] == z and holding[i] > 0)
    return found


@compiled
def determines(problem, point, linear, surely):
    """True if the zones in force leave no unknown open; if not `surely`, also if only other pivots would tell.

    Of a full matrix it is always sure. A pattern that turns out to leave one open with other pivots too is left again.
    """
    matrices = linear.matrices
    mass_at(problem.call_mass, (problem.context, matrices.at_mass))
    status = prepare_consistent(problem, point, linear)
    return status == DONE if surely else status != SINGULAR


@compiled
def change_one(problem, point, linear, settling, surely):
    """Of several that changed only one does; False, and all of them, where no one determines all."""
    nz = problem.n_machines
    zones, before = indices(settling.at_zones, nz), indices(settling.at_zones_before, nz)
    wanted = indices(settling.at_zones_history + 8 * settling.passes * nz, nz)
    for kept in range(nz):
        if wanted[kept] != before[kept]:
            for z in range(nz):
                zones[z] = wanted[z] if z == kept else before[z]
            if determines(problem, point, linear, surely):
                for z in range(nz):
                    before[z] = wanted[z]
                return True
    for z in range(nz):
        zones[z] = wanted[z]
    return False


@compiled
def exchange_one(problem, point, linear, settling, surely):
    """One that changed before goes back to the zone it began in, and the last one stays; False without one."""
    nz = problem.n_machines
    zones, before = indices(settling.at_zones, nz), indices(settling.at_zones_before, nz)
    first = indices(settling.at_zones_history, nz)
    for z in range(nz):
        if zones[z] == before[z] and zones[z] != first[z] and may_hold(problem, z):
            left = zones[z]
            zones[z] = first[z]
            if determines(problem, point, linear, surely):
                for k in range(nz):
                    before[k] = zones[k]
                before[z] = left
                return True
            zones[z] = left
    return False


@compiled
def open_one(m, surely):
    """Another that holds lets go, by the guard nearest to its limit of those that determine all; False without one."""
    problem, run, point, guards, settling = m.problem, m.run, m.point, m.events.guards, m.events.settling
    nz, ng = problem.n_machines, guards.n_guards
    zones, before = indices(settling.at_zones, nz), indices(settling.at_zones_before, nz)
    machine, may_let_go = indices(guards.at_guard_machine, ng), indices(problem.at_may_hold, ng)
    g, tolerance = reals(guards.at_g_probe, ng), reals(guards.at_guard_tolerance, ng)
    evaluate_guards(problem, run, guards, point.t, point.at_y, guards.at_g_probe)
    opens, best, nearest = -1, 0, -1e308
    for i in range(ng):
        z = machine[i]
        if z < 0 or may_let_go[i] == 0 or g[i] == NOT_IN_FORCE or g[i] / tolerance[i] <= nearest:
            continue
        if zones[z] != before[z]:
            continue
        left = zones[z]
        follow(problem, point, guards, i)
        if zones[z] != left and determines(problem, point, m.linear, surely):
            opens, best, nearest = z, zones[z], g[i] / tolerance[i]
        zones[z] = left
    if opens < 0:
        return False
    left = zones[opens]
    zones[opens] = best
    for k in range(nz):
        before[k] = zones[k]
    before[opens] = left
    return determines(problem, point, m.linear, surely)


@compiled
def follow(problem, point, guards, i):
    """Follow guard i alone."""
    indices(guards.at_fired, guards.n_guards)[0] = i
    switch_at(problem.call_switch, (problem.context, point.t, point.at_y, guards.at_fired, 1))
