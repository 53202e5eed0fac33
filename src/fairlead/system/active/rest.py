"""What stands still as long as what holds goes on holding: found from the equations, not from their values.

An unknown rests if one equation says so in which everything else rests, and no time:

    a contact that holds         its slip is zero: the one speed in it that is not known to rest does
    x' = v                       a position whose speed rests
    the balance of a body        an algebraic unknown, as a force that holds, that alone could vary in it
    any algebraic equation       the same

Whatever a law may depend on in any zone counts (the pattern of df/dy), so that only the letting go of a contact
can make a false statement of it. Which contacts those are is kept: what found every unknown.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.system.compiled.system import Booleans, Floats, Instance, System

Integers = NDArray[np.int64]

STILL = 1e-6
"""A speed below this share of its error weight is that of a contact that holds: rounding."""


@dataclass(frozen=True)
class HoldRows:
    """Rows that hold in some zones: entry k says that `row` does while `machine` (-1: always) is in `zone`."""

    row: Integers
    machine: Integers
    zone: Integers
    given: Booleans  # by unknown: its slip contains a speed that is prescribed


@dataclass(frozen=True)
class Anatomy:
    """What depends on what: entries (row, column) of the equations and of the slips, and rows that nothing proves."""

    row: Integers
    column: Integers
    slip_row: Integers
    slip_column: Integers
    positions: Integers
    speeds: Integers
    holds: HoldRows
    proves_nothing: Booleans


@dataclass(frozen=True)
class Rest:
    """Which unknowns rest, by which row every one was found (-1: it moves), and which rows hold by which machine."""

    still: Booleans
    found_by: Integers
    held_by: Integers  # by row: the machine, -1 for none or for one that always holds
    row: Integers  # the entries that say so
    column: Integers


def anatomy(system: System) -> Anatomy:
    """What depends on what in a System, in any zone."""
    n, pairs = system.n, np.asarray(system.numbering.pairs, dtype=np.int64).reshape(-1, 2)
    row, column = np.asarray(system.pattern.rows), np.repeat(np.arange(n), np.diff(system.pattern.starts))
    own = np.flatnonzero(system.differential)
    kinematic = np.zeros(n, dtype=bool)
    kinematic[pairs[:, 0]] = True
    row, column = np.concatenate([row, own]), np.concatenate([column, own])
    kept = ~kinematic[row] & ~system.quadrature[row]
    holds = _hold_rows(system)
    in_slip = np.zeros(n, dtype=bool)
    in_slip[holds.row] = True
    mass_row = np.asarray(system.mass_pattern.rows)
    mass_column = np.repeat(np.arange(n), np.diff(system.mass_pattern.starts))
    slip = in_slip[mass_row]
    return Anatomy(
        row[kept], column[kept], mass_row[slip], mass_column[slip], pairs[:, 0], pairs[:, 1], holds,
        system.timed | system.quadrature | kinematic,
    )  # fmt: skip


def _hold_rows(system: System) -> HoldRows:
    rows, machines, zones = [], [], []
    given = np.zeros(system.n, dtype=bool)
    for block in system.blocks:
        s = block.kernel.structure
        for unknown, holding in s.holds.items():
            own = block.flow_index[:, s.targets.index(f"own:{unknown}")]
            for zone in holding:
                rows.append(own)
                machines.append(block.machines[:, 0] if len(s.zones) > 1 else np.full(block.count, -1))
                zones.append(np.full(block.count, s.zones.index(zone)))
            for speed in (j for name, j in s.mass if name == unknown):
                at = block.in_index[:, speed]
                given[own[(at >= system.n) & (at != system.numbering.zero)]] = True
    row, machine, in_zone = (np.array(np.concatenate([*part, []]), dtype=np.int64) for part in (rows, machines, zones))
    return HoldRows(row, machine, in_zone, given)


def at_rest(parts: Anatomy, system: Instance, y: Floats) -> Rest:
    """What rests in the zones in force; y [n] tells which speeds are zero up to rounding."""
    n, holds = system.n, parts.holds
    now = (holds.machine < 0) | (system.zones[holds.machine] == holds.zone)
    held, held_by = np.zeros(n, dtype=bool), np.full(n, -1, dtype=np.int64)
    held[holds.row[now]] = True
    held_by[holds.row[now]] = holds.machine[now]
    usual, slips = ~held[parts.row], held[parts.slip_row]
    row = np.concatenate([parts.row[usual], parts.slip_row[slips]])
    column = np.concatenate([parts.column[usual], parts.slip_column[slips]])
    shut = np.where(held, holds.given, parts.proves_nothing)
    may_rest = ~system.differential
    may_rest[parts.speeds] = np.abs(y[parts.speeds]) <= STILL * system.absolute[parts.speeds]
    still, found_by = np.zeros(n, dtype=bool), np.full(n, -1, dtype=np.int64)
    while True:
        moving = ~still[column]
        alone = (np.bincount(row[moving], minlength=n) == 1) & ~shut
        which = np.bincount(row[moving], weights=column[moving], minlength=n).astype(np.int64)
        rows = np.flatnonzero(alone)
        rows = rows[may_rest[which[rows]] & (held[rows] | ~system.differential[which[rows]])]
        found, first = np.unique(which[rows], return_index=True)
        still[found], found_by[found] = True, rows[first]
        shut[rows[first]] = True
        follow = parts.positions[still[parts.speeds] & ~still[parts.positions]]
        still[follow], found_by[follow] = True, follow
        if not len(found) and not len(follow):
            row, column = np.concatenate([row, parts.positions]), np.concatenate([column, parts.speeds])
            return Rest(still, found_by, held_by, row, column)


def leaning_on(rest: Rest, unknowns: Booleans, machines: int) -> Booleans:
    """Machines whose letting go would take away what shows that these unknowns rest; shape (machines,)."""
    reached, wanted = unknowns & rest.still, np.zeros(len(unknowns), dtype=bool)
    while True:
        wanted[:] = False
        wanted[rest.found_by[reached]] = True
        more = np.zeros(len(unknowns), dtype=bool)
        more[rest.column[wanted[rest.row]]] = True
        more |= reached
        if (more == reached).all():
            break
        reached = more
    held = rest.held_by[rest.found_by[reached]]
    found = np.zeros(machines, dtype=bool)
    found[held[held >= 0]] = True
    return found
