"""Rows inside a step of the stepping engine show its end zones: what holds at the end is shown without slip.

It would else seem to creep: a body that is caught in the step has a slip at its start, and one that is carried along
follows its parabola where the surface follows its own law. Of two bodies that hold on to each other the lighter moves.
"""

from __future__ import annotations

from fairlead.integrate.foreign import compiled, copy, field_at, indices, reals
from fairlead.integrate.meters import inertia_of

PASSES = 4
"""First what holds on to surfaces of given motion, then what holds on to that, then what holds on to each other."""

@compiled
def prepare_rows(m):
    """Of an accepted step: a body that was caught goes with what caught it from the start of the step."""
    y, bend = reals(m.at_y, m.n), reals(m.at_D, m.n)
    entry, row = indices(m.at_hold_mass, m.n_hold_mass), indices(m.at_hold_mass_row, m.n_hold_mass)
    column, partner = indices(m.at_hold_mass_column, m.n_hold_mass), indices(m.at_hold_mass_partner, m.n_hold_mass)
    values, holds, caught = reals(m.at_mass, m.n_mass), indices(m.at_holds, m.n), indices(m.at_caught, m.n)
    rested, slip = indices(m.at_rested, m.n), reals(m.at_residual, m.n)
    any_caught, pairs = False, False
    for e in range(m.n_hold_mass):
        any_caught = any_caught or (holds[row[e]] == 1 and caught[row[e]] == 1)
        pairs = pairs or (holds[row[e]] == 1 and partner[e] >= 0)
    m.rows_slip = 1 if pairs or any_caught or m.driven == 1 else 0
    if any_caught:
        field_at(m.call_drift, (m.context, m.t, m.at_y, m.at_residual))
    for e in range(m.n_hold_mass):
        j, k, other = column[e], row[e], partner[e]
        if holds[k] == 0 or values[entry[e]] == 0.0:
            continue
        if is_heavier(m, j, other):
            continue
        if caught[k] == 1:
            y[j] += slip[k] / values[entry[e]]
        if other >= 0:
            bend[j] = -values[entry[other]] / values[entry[e]] * bend[column[other]]
        elif caught[k] == 1 or m.driven == 0 or rested[k] == 0:
            bend[j] = 0.0


@compiled
def take_slip_away(m, t, at_y):
    """Correct the speeds at (t, y) by the slip that contacts show which hold; each body once.

    A body that one contact has put right is not moved by the next, which then moves the other one.
    """
    y, before, slip = reals(at_y, m.n), reals(m.at_u, m.n), reals(m.at_residual, m.n)
    entry, row = indices(m.at_hold_mass, m.n_hold_mass), indices(m.at_hold_mass_row, m.n_hold_mass)
    column, partner = indices(m.at_hold_mass_column, m.n_hold_mass), indices(m.at_hold_mass_partner, m.n_hold_mass)
    values, holds = reals(m.at_mass, m.n_mass), indices(m.at_holds, m.n)
    copy(y, before)
    for some in range(PASSES):
        field_at(m.call_drift, (m.context, t, at_y, m.at_residual))
        for e in range(m.n_hold_mass):
            j, k, other = column[e], row[e], partner[e]
            if holds[k] == 0 or values[entry[e]] == 0.0 or slip[k] == 0.0 or y[j] != before[j]:
                continue
            if other >= 0 and some == 0:
                continue
            if other < 0 or (is_heavier(m, column[other], e) and some > 1) or y[column[other]] != before[column[other]]:
                y[j] += slip[k] / values[entry[e]]
                slip[k] = 0.0


@compiled
def is_heavier(m, j, other):
    """True if the speed of entry `other` (-1: none) is that of a lighter body than j."""
    if other < 0:
        return False
    column = indices(m.at_hold_mass_column, m.n_hold_mass)
    return (inertia_of(m, j), j) > (inertia_of(m, column[other]), column[other])
