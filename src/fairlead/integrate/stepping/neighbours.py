"""Which contacts hand their load to which: the neighbours of every machine, for the active set of `stepping`."""

from __future__ import annotations

import numpy as np

from fairlead.integrate.linear.condensing import columns_of, lay_out, reduced_entries
from fairlead.integrate.problem import Floats, Instance, Integers, Problem

MOST_NEIGHBOURS = 8
"""A machine with more neighbours than this hands nothing on: a big body that many contacts act on."""


def held_entries(problem: Problem) -> dict[str, Integers]:
    """Entries of M and of J in rows that may hold, by their names in memory/of_methods.py.

    Those of J are slopes to what moves, which `stepping` takes out, or to other forces: contacts that close a
    circle share a load.
    """
    rows, slopes = problem.mass_pattern.rows, problem.pattern.rows
    may_hold = ~np.asarray(problem.differential, dtype=bool)
    mass = np.flatnonzero(may_hold[rows]) if problem.callbacks.get("slip") else np.zeros(0, np.int64)
    holds = np.zeros(len(may_hold), dtype=bool)
    holds[rows[mass]] = True
    columns = columns_of(problem.pattern)
    in_mass = set(zip(rows[mass].tolist(), columns_of(problem.mass_pattern)[mass].tolist(), strict=True))
    of_hold = np.flatnonzero(holds[slopes])
    pairs = zip(slopes[of_hold].tolist(), columns[of_hold].tolist(), strict=True)
    moves = np.array([not may_hold[j] or (i, j) in in_mass for i, j in pairs], dtype=bool)
    slope, share = of_hold[moves], of_hold[~moves]
    return {
        "hold_mass": mass, "hold_mass_row": rows[mass], "hold_mass_column": columns_of(problem.mass_pattern)[mass],
        "hold_slope": slope, "hold_slope_row": slopes[slope],
        "hold_share": share, "hold_share_row": slopes[share], "hold_share_column": columns[share],
    }  # fmt: skip


def neighbours(problem: Problem) -> dict[str, Integers]:
    """Neighbours of every machine, its first guard, and the guards that limit a held force.

    Two machines are neighbours when a speed that one holds is a speed the other holds, or acts on one. A problem
    that does not say which machine holds which row (`holder`), or which guards are limits, has none.
    """
    nz = len(problem.zones)
    holder = np.asarray(problem.holder)
    limits = np.asarray(problem.limit_guard, dtype=np.int64)
    found = _found(problem, holder) if limits.any() else [[] for _ in range(nz)]
    first = np.full(nz, -1, dtype=np.int64)
    for i in range(len(problem.guard_machine) - 1, -1, -1):
        if problem.guard_machine[i] >= 0:
            first[problem.guard_machine[i]] = i
    row = np.full(nz, -1, dtype=np.int64)
    held = np.flatnonzero(holder >= 0)
    row[holder[held[::-1]]] = held[::-1]
    return {
        "may_jump": limits if limits.any() else np.ones(len(limits), dtype=np.int64),
        "first_guard": first, "hold_row": row, "latches": machines_with(problem.latch_guard, problem),
        "neighbour_starts": np.cumsum([0, *map(len, found)]).astype(np.int64),
        "neighbours": np.array([w for others in found for w in others], dtype=np.int64),
    }  # fmt: skip


def known_rows(problem: Problem) -> dict[str, Floats | Integers]:
    """Entries of J and M in the row each machine holds.

    A machine that holds no row, or more than one, has none; nor has one whose switch changes other rows too, as that of
    a contact in a circle changes how the others share (`beyond_row`).
    """
    nz = len(problem.zones)
    holder = np.asarray(problem.holder)
    rows: list[list[int]] = [[] for _ in range(nz)]
    for k in np.flatnonzero(holder >= 0).tolist():
        rows[holder[k]].append(k)
    row = np.array([own[0] if len(own) == 1 else -1 for own in rows], dtype=np.int64)
    row[np.asarray(problem.beyond_row, dtype=np.int64)] = -1
    found: dict[str, Floats | Integers] = {"own_row": row}
    for name, pattern in (("own_slope", problem.pattern), ("own_mass", problem.mass_pattern)):
        machine = np.full(len(problem.initial), -1, dtype=np.int64)
        machine[row[row >= 0]] = np.flatnonzero(row >= 0)
        owner = machine[pattern.rows]
        entries = np.flatnonzero(owner >= 0)
        entries = entries[np.argsort(owner[entries], kind="stable")]
        found[f"{name}_starts"] = np.concatenate([[0], np.cumsum(np.bincount(owner[entries], minlength=nz))])
        found["own_slopes" if name == "own_slope" else "own_masses"] = entries
        found[f"{name}_columns"] = columns_of(pattern)[entries]
    found["own_kind"] = own_kinds(problem, np.diff(found["own_slope_starts"]), np.diff(found["own_mass_starts"]))
    found["only_kinks"] = only_kinks(problem)
    return found


def own_kinds(problem: Problem, slopes: Integers, masses: Integers) -> Integers:
    """The kind of every machine: rows of one kind have as many entries in J (`slopes`) and in M (`masses`).

    The problem says which machines follow the same laws (`machine_kind`). Of one that does not, every machine is
    a kind of its own: what is learnt of one then says nothing about others, which is safe.
    """
    laws = np.asarray(problem.machine_kind, dtype=np.int64)
    numbers: dict[tuple[int, ...], int] = {}
    shapes = zip(laws.tolist(), slopes.tolist(), masses.tolist(), strict=True)
    return np.array([numbers.setdefault(shape, len(numbers)) for shape in shapes], dtype=np.int64)


def machines_with(guards: Integers, problem: Problem) -> Integers:
    """[nz]: 1 for machines one of whose guards is marked."""
    machine, marked = np.asarray(problem.guard_machine), np.asarray(guards, dtype=bool)
    return (np.bincount(machine[(machine >= 0) & marked], minlength=len(problem.zones)) > 0).astype(np.int64)


def only_kinks(problem: Problem) -> Integers:
    """1 for machines whose guards lead only from one piece of a continuous table to the next."""
    nz, machine = len(problem.zones), np.asarray(problem.guard_machine)
    kink = np.asarray(problem.kink_guard, dtype=bool)
    guards = np.bincount(machine[machine >= 0], minlength=nz)
    kinks = np.bincount(machine[(machine >= 0) & kink], minlength=nz)
    return ((guards > 0) & (guards == kinks)).astype(np.int64)


def held_inertia(problem: Instance) -> Floats:
    """[nz]: the inertia that resists the force of a machine that may hold; 0 where it is not known."""
    inertia, machines = np.zeros(len(problem.zones)), np.asarray(problem.guard_machine)
    given = np.asarray(problem.guard_inertia)
    np.maximum.at(inertia, machines[machines >= 0], given[machines >= 0])
    return inertia


def held_bodies(problem: Problem) -> dict[str, Integers]:
    """The speeds that each machine holds, and the positions that go with them (-1: none).

    Those without a position are left out where another has one. Which of the others counts is for the loop to say.
    """
    nz = len(problem.zones)
    position_of = {v: x for x, v in lay_out(problem).positions.items() if v >= 0}
    holder = np.asarray(problem.holder)
    rows, columns = problem.mass_pattern.rows, columns_of(problem.mass_pattern)
    speeds: list[list[int]] = [[] for _ in range(nz)]
    for e in np.flatnonzero(holder[rows] >= 0).tolist():
        speeds[holder[rows[e]]].append(int(columns[e]))
    kept = [[v for v in own if v in position_of] or own for own in speeds]
    every = [v for own in kept for v in own]
    return {
        "body_starts": np.cumsum([0, *map(len, kept)]).astype(np.int64), "body_speed": np.array(every, dtype=np.int64),
        "body_position": np.array([position_of.get(v, -1) for v in every], dtype=np.int64),
    }  # fmt: skip


def _found(problem: Problem, holder: Integers) -> list[list[int]]:
    """Neighbours of every machine, ascending."""
    rows, columns = problem.mass_pattern.rows, columns_of(problem.mass_pattern)
    held = holder[rows] >= 0
    speeds: dict[int, set[int]] = {}
    machines: dict[int, set[int]] = {}
    for machine, speed in zip(holder[rows[held]].tolist(), columns[held].tolist(), strict=True):
        speeds.setdefault(machine, set()).add(speed)
        machines.setdefault(speed, set()).add(machine)
    acts: dict[int, set[int]] = {speed: {speed} for speed in machines}
    entries = reduced_entries(problem, lay_out(problem))
    for i, j in zip(entries.row.tolist(), entries.column.tolist(), strict=True):
        if i in machines and j in machines:
            acts[i].add(j)
    found: list[list[int]] = [[] for _ in range(len(problem.zones))]
    for machine, own in speeds.items():
        others = {other for speed in own for near in acts[speed] for other in machines[near]} - {machine}
        if len(others) <= MOST_NEIGHBOURS:
            found[machine] = sorted(others)
    return found
