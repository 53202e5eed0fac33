"""Patterns of zones: whether those in force were met before, in a settlement or in a step that looks for its zones.

A settlement, or such a step, that comes upon a pattern again goes in a circle, and changes fewer zones at a time from
there on. Patterns are compared by one number each; two share one by accident once in 10^15. The zones themselves are
kept as well, for the sentence of a run that ends because they did not settle.
"""

from __future__ import annotations

from fairlead.integrate.memory.foreign import compiled, copy, indices, reals


@compiled
def number_of_zones(settling):
    """A number that stands for the zones in force."""
    zones, number = indices(settling.at_zones, settling.n_machines), 0
    for z in range(settling.n_machines):
        number = (number * 1099511628211 + zones[z] + 1) & 0xFFFFFFFFFFFFF
    return float(number)


@compiled
def remember_pattern(run, settling):
    """Keep the zones in force as those after `passes` passes."""
    keep(run, settling, number_of_zones(settling))


@compiled
def keep(run, settling, number):
    """Keep the zones in force, and the number that stands for them."""
    nz = settling.n_machines
    if settling.passes <= run.max_passes:
        reals(settling.at_patterns_met, run.max_passes + 1)[settling.passes] = number
        copy(indices(settling.at_zones, nz), indices(settling.at_zones_history + 8 * settling.passes * nz, nz))


@compiled
def note_pattern(run, settling):
    """Remember the zones in force; True if they were so after an earlier pass of this stage."""
    met, now, found = reals(settling.at_patterns_met, run.max_passes + 1), number_of_zones(settling), False
    for k in range(settling.stage_from, min(settling.passes, run.max_passes)):
        found = found or met[k] == now
    keep(run, settling, now)
    return found
