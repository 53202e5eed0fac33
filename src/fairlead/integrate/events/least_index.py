"""One zone at a time, in a fixed order of the contacts: what ends a search that goes in a circle.

For the complementarity problem that stick and slip pose (a matrix with positive principal minors) changing the
violator of least index never returns to a pattern of zones (Murty, Opsearch 11:123, 1974). Any numbering of the
contacts will do, as long as it stays the same. The order in which they happen to be stored is none of the scene's,
so they are numbered by how far their guards are from zero when the search begins: the least far above it first, since
to change the most wrong alone has been tried (settling.py). Rounded, for the last digits of a guard hang on the order
of sums. Contacts that are equal even so stand in the order stored.
"""

from __future__ import annotations

from math import sqrt

from fairlead.integrate.events.limits import AT_LIMIT
from fairlead.integrate.memory.foreign import compiled, indices, reals
from fairlead.integrate.point.even_steps import FINE, rounded

HALF = 0.499
"""Of the worst, before it comes to one at a time: a little less than half, so that of loads in the ratio of two to one
no last digit decides."""


@compiled
def number_machines(events, at_g):
    """Set `rank` of every machine from these guards, in units of their tolerances; the root lets all of them count."""
    guards, settling = events.guards, events.settling
    g, tolerance = reals(at_g, guards.n_guards), reals(guards.at_guard_tolerance, guards.n_guards)
    rank, machine = reals(settling.at_rank, settling.n_machines), indices(guards.at_guard_machine, guards.n_guards)
    for z in range(settling.n_machines):
        rank[z] = 0.0
    for i in range(guards.n_guards):
        far = g[i] / tolerance[i]
        if machine[i] >= 0 and abs(far) > AT_LIMIT:
            rank[machine[i]] += sqrt(far) if far > 0.0 else -sqrt(-far)
    for z in range(settling.n_machines):
        rank[z] = rounded(rank[z], FINE)


@compiled
def keep_first(events):
    """Of the violators in `fired` keep the one whose machine comes first; guards without a machine come last."""
    guards, settling = events.guards, events.settling
    fired, machine = indices(guards.at_fired, guards.n_guards), indices(guards.at_guard_machine, guards.n_guards)
    rank = reals(settling.at_rank, settling.n_machines)
    first, lowest = fired[0], 1e308
    for k in range(guards.n_fired):
        z = machine[fired[k]]
        if z >= 0 and rank[z] < lowest:
            first, lowest = fired[k], rank[z]
    fired[0] = first
    guards.n_fired = 1


@compiled
def keep_worst(events, half):
    """Of the violators in `fired` keep the one whose guard is most `wrong`; with `half` all at least HALF as wrong."""
    guards = events.guards
    fired, wrong = indices(guards.at_fired, guards.n_guards), reals(events.settling.at_wrong, guards.n_guards)
    worst = fired[0]
    for k in range(guards.n_fired):
        if wrong[fired[k]] > wrong[worst]:
            worst = fired[k]
    kept = 0
    for k in range(guards.n_fired):
        if fired[k] == worst or (half and wrong[fired[k]] >= HALF * wrong[worst]):
            fired[kept] = fired[k]
            kept += 1
    guards.n_fired = kept
