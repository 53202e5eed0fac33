"""A pattern of zones that leaves an unknown open is no outcome: another one near it is tried.

No law gives the speed of a node without inertia when all its contacts slide, and all that are beyond their limits let
go at once. What would really happen is told by a node with a little inertia: the stronger contacts accelerate it
until one of the others is caught. So of the patterns

    after a pass in which several changed     only one of them changed
    after a pass in which one changed         one that changed before goes back: the two exchange their places

the first one that determines all unknowns is taken, and judged as any other. Only contacts change so. The second is the
exchange of Lemke's method, whose pivot of one vanishes where that of two does not (Cottle, Pang, Stone, The Linear
Complementarity Problem, 1992, section 4.4). Where there is none, the run ends and names what is open.
"""

from __future__ import annotations

from fairlead.integrate.events.consistent import prepare_consistent
from fairlead.integrate.linear.systems import SINGULAR
from fairlead.integrate.memory.foreign import compiled, indices, mass_at


@compiled
def change_to_near_pattern(m):
    """Put a pattern in force near the one that leaves an unknown open; False, and the same as before, without one."""
    nz, settling = m.problem.n_zones, m.events.settling
    zones, before = indices(settling.at_zones, nz), indices(settling.at_zones_before, nz)
    changed = 0
    for z in range(nz):
        if zones[z] != before[z]:
            changed += 1
            if not may_hold(m.problem, z):
                return False
    if changed == 0 or determines(m):
        return False
    return change_one(m) if changed > 1 else exchange_one(m)


@compiled
def may_hold(problem, z):
    """True if machine z is a contact that may hold."""
    machine = indices(problem.at_guard_machine, problem.n_guards)
    holding, found = indices(problem.at_may_hold, problem.n_guards), False
    for i in range(problem.n_guards):
        found = found or (machine[i] == z and holding[i] > 0)
    return found


@compiled
def determines(m):
    """True if the zones in force leave no unknown open, be it with other pivots."""
    problem, matrices = m.problem, m.linear.matrices
    mass_at(problem.call_mass, (problem.context, matrices.at_mass))
    return prepare_consistent(problem, m.point, m.linear) != SINGULAR


@compiled
def change_one(m):
    """Of several that changed only one does; False, and all of them, where no one determines all."""
    nz, settling = m.problem.n_zones, m.events.settling
    zones, before = indices(settling.at_zones, nz), indices(settling.at_zones_before, nz)
    wanted = indices(settling.at_zones_history + 8 * settling.passes * nz, nz)
    for kept in range(nz):
        if wanted[kept] != before[kept]:
            for z in range(nz):
                zones[z] = wanted[z] if z == kept else before[z]
            if determines(m):
                for z in range(nz):
                    before[z] = wanted[z]
                return True
    for z in range(nz):
        zones[z] = wanted[z]
    return False


@compiled
def exchange_one(m):
    """One that changed before goes back to the zone it began in, and the last one stays; False without one."""
    nz, settling = m.problem.n_zones, m.events.settling
    zones, before = indices(settling.at_zones, nz), indices(settling.at_zones_before, nz)
    first = indices(settling.at_zones_history, nz)
    for z in range(nz):
        if zones[z] == before[z] and zones[z] != first[z] and may_hold(m.problem, z):
            left = zones[z]
            zones[z] = first[z]
            if determines(m):
                for k in range(nz):
                    before[k] = zones[k]
                before[z] = left
                return True
            zones[z] = left
    return False
