"""Speeds at the start that rigid rows tie together: what nobody gave follows, what contradicts is refused.

A row that takes any impulse (a torque sensor, a rigid stop that touches) joins the speeds of what it holds. Where
one of them is not given it follows from the others, row by row until nothing new follows. Where all are given and the
row slips, an impulse would have to start the run: that is a contradiction. Friction is no such row: it slips.

Rows may be left that know too little, as that of a gear of three shafts of which one has a speed. What is given stays:
of the speeds that fit, the others take those of least energy, as if what is given had been brought to its speed at once
while they were at rest.
"""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import replace

import numpy as np

from fairlead.component.assembly import PortRef
from fairlead.errors import Fault, ModelError
from fairlead.flatten.flat_model import FlatModel
from fairlead.system.arrays.blocks import Block
from fairlead.system.compiled.asking import call, mass_of
from fairlead.system.compiled.named_parts import kept_positions
from fairlead.system.compiled.system import Floats, Instance, System
from fairlead.system.start.places import ratios_at

RIGID = 2
AGREES = 1e-9
"""Share of the speeds in a row that its slip may be: numbers in a netlist are rounded."""
LIGHT = 1e-9
"""Inertia of a speed without any, as a share of the least that there is."""
LEVER = 1e-9
"""Ratio [m, or 1] below which a motion is in its dead centre: its speed does not follow from others."""


def started(system: System, initially: Collection[int]) -> System:
    """The System with the speeds that follow at the start; `initially` are the unknowns that `initial` names.

    Raises ModelError where speeds contradict each other.
    """
    begin, faults = start_speeds(system, initially)
    if faults:
        raise ModelError(faults)
    return replace(system, initial=begin)


def start_speeds(system: System, initially: Collection[int]) -> tuple[Floats, list[Fault]]:
    """The unknowns at the start (n,) with speeds that follow, and what contradicts."""
    if not (system.takes_impulse >= RIGID).any():
        return system.initial, []
    here, y = system.instance(), system.initial.copy()
    rows, missing = _light_rows(here, y) | _rows(here) | _moving_rows(here, y), _missing(system, initially)
    left = dict.fromkeys(rows)
    while left:
        free = {k: [j for j in rows[k] if missing[j]] for k in left}
        k = next((k for k in left if len(free[k]) <= 1), None)
        if k is None:
            break
        del left[k]
        if free[k]:
            (j,) = free[k]
            y[j] -= _slip(here, y)[k] / rows[k][j]
            missing[j] = False
    if left:
        y = _of_least_energy(here, y, [rows[k] for k in left], list(left), missing)
    slip = _slip(here, y)
    wrong = {k for k, row in rows.items() if k not in left and abs(slip[k]) > AGREES * _size(row, y, slip[k])}
    return y, [fault for block in system.blocks for fault in _faults(system, block, y, wrong)]


def _of_least_energy(
    here: Instance, y: Floats, rows: list[dict[int, float]], numbers: list[int], missing: list[bool]
) -> Floats:
    """The unknowns with missing speeds that bring rows with several of them to rest: of all, those of least energy.

    As they were where none fit. A speed without inertia counts as one with hardly any.
    """
    speeds = sorted({j for row in rows for j in row if missing[j]})
    mass = dict.fromkeys(speeds, 0.0)
    mass |= {j: here.flat.groups[k].mass for k, j in here.numbering.rate.items() if j in mass}
    least = min((m for m in mass.values() if m > 0.0), default=1.0)
    scale = np.array([1.0 / np.sqrt(mass[j] if mass[j] > 0.0 else LIGHT * least) for j in speeds])
    slip = _slip(here, y)[numbers]
    if not slip.any():
        return y
    a = np.array([[row.get(j, 0.0) for j in speeds] for row in rows]) * scale
    size = np.abs(a).max(axis=1)
    change = np.linalg.lstsq(a / size[:, None], -slip / size, rcond=None)[0] * scale
    moved = y.copy()
    moved[speeds] += change
    fits = np.abs(_slip(here, moved)[numbers]) <= [AGREES * _size(row, moved, 0.0) for row in rows]
    return moved if fits.all() else y


def _rows(here: Instance) -> dict[int, dict[int, float]]:
    """By rigid row in force: the speeds it reads, and their coefficients in its slip."""
    columns = np.repeat(np.arange(here.n), np.diff(here.mass_pattern.starts))
    entries = zip(here.mass_pattern.rows.tolist(), columns.tolist(), mass_of(here).tolist(), strict=True)
    rows: dict[int, dict[int, float]] = {}
    for k, j, value in entries:
        if here.takes_impulse[k] == RIGID and value != 0.0:
            rows.setdefault(k, {})[j] = value
    return rows


def _light_rows(here: Instance, y: Floats) -> dict[int, dict[int, float]]:
    """The same of rows that give a node without inertia its speed, which M does not have: slip is linear."""
    columns, speeds = np.repeat(np.arange(here.n), np.diff(here.pattern.starts)), set(here.numbering.rate.values())
    read: dict[int, list[int]] = {}
    for k, j in zip(here.pattern.rows.tolist(), columns.tolist(), strict=True):
        if here.takes_impulse[k] == RIGID and j in speeds:
            read.setdefault(k, []).append(j)
    light = {k: of for k, of in read.items() if not all(here.differential[of])}
    rows: dict[int, dict[int, float]] = {}
    if light:
        moving = y.copy()
        moving[list(speeds)] = 0.0
        slip = _slip(here, moving)
        for j in dict.fromkeys(j for of in light.values() for j in of):
            moving[j] = 1.0
            for k in np.flatnonzero(change := _slip(here, moving) - slip).tolist():
                if j in light.get(k, ()):
                    rows.setdefault(k, {})[j] = float(change[k])
            moving[j] = 0.0
    return rows


def _moving_rows(here: Instance, y: Floats) -> dict[int, dict[int, float]]:
    """The same of the rows of relations of positions, whose ratios are those at the positions in y."""
    if not kept_positions(here):
        return {}
    ratios = ratios_at(here, y)
    speeds = [here.numbering.rate[index] for index in here.numbering.accelerated]
    of_row = {k: zip(speeds, ratios[k].tolist(), strict=True) for k in np.flatnonzero(ratios.any(axis=1)).tolist()}
    return {k: {j: ratio for j, ratio in pairs if abs(ratio) > LEVER} for k, pairs in of_row.items()}


def _missing(system: System, initially: Collection[int]) -> list[bool]:
    """By unknown: True for a speed that nobody gave."""
    missing = [False] * system.n
    for index, v in system.numbering.rate.items():
        missing[v] = not system.flat.groups[index].given[1] and v not in initially
    return missing


def _slip(here: Instance, y: Floats) -> Floats:
    made = np.zeros(here.n)
    call(here, "slip", here.start, y, made)
    return -made


def _size(row: dict[int, float], y: Floats, slip: float) -> float:
    """The largest speed that a row adds up; that of a support is what the others leave."""
    terms = [coef * y[j] for j, coef in row.items()]
    return max(*map(abs, terms), abs(slip - sum(terms)))


def _faults(system: System, block: Block, y: Floats, wrong: set[int]) -> list[Fault]:
    """What is wrong with the instances of a block: rows in `wrong` are theirs."""
    s, faults = block.kernel.structure, []
    for unknown in s.rigid:
        at = block.flow_index[:, s.targets.index(f"own:{unknown}")].tolist()
        for instance, k in zip(block.instances, at, strict=True):
            if k in wrong:
                names = s.pairs.get(unknown, instance.type.declaration.ports)
                inner = [PortRef(instance.path, port) for port in names]
                who, ends = _as_written(system.flat, instance.path, inner)
                told = [_end(system.flat, end, y, system.numbering.rate) for end in ends]
                kept = "at one speed" if len(ends) == 2 else f"at {len(ends)} speeds of which one follows"
                kept = "in a relation of positions" if unknown in s.positions else kept
                fits = ""
                if unknown not in s.positions and _turned(system.flat, inner, ends):
                    kept = "at speeds of a fixed ratio"
                    fits = _partner(system.flat, inner, ends, y, system.numbering.rate)
                what = f"{who} keeps its ends {kept}, but they start with {' and '.join(told)}{fits}."
                which = "all but one of them" if len(ends) == 2 else "one of them"
                faults.append(Fault(instance.where, what, f"Give speeds that agree, or leave out {which}."))
    return faults


def _as_written(flat: FlatModel, path: str, inner: list[PortRef]) -> tuple[str, list[PortRef]]:
    """The outermost component that is made of the instance at `path` and has ports that move with its ends; and these.

    They are named as that hands them out. The instance itself where there is none.
    """
    steps = path.split(".")
    for depth in range(1, len(steps)):
        outer = ".".join(steps[:depth])
        expansion = flat.assembly.expansions.get(outer)
        names = expansion.ports if expansion is not None else ()
        there = {PortRef(outer, name): flat.assembly.aliases[f"{outer}.{name}"] for name in names}
        moving = {flat.place(ref)[0]: end for end, ref in there.items() if ref in flat.node_of}
        if all(flat.place(end)[0] in moving for end in inner):
            return outer, [moving[flat.place(end)[0]] for end in inner]
    return path, inner


def _place(flat: FlatModel, ref: PortRef) -> tuple[int, float, str]:
    """Group, ratio and unit of the speed of a port, also where a component hands it out."""
    leaf = flat.assembly.aliases.get(str(ref), ref)
    index, ratio, _ = flat.place(leaf)
    port = flat.assembly.instances[leaf.instance].type.declaration.ports[leaf.port]
    return index, ratio, port.domain.across[-1][1]


def _turned(flat: FlatModel, inner: list[PortRef], ends: list[PortRef]) -> bool:
    """Whether the ends that are named move otherwise, to each other, than those that are kept at one speed."""
    ratios = [(_place(flat, one)[1], _place(flat, end)[1]) for one, end in zip(inner, ends, strict=True)]
    (first, of_first), *others = ratios
    return not all(math.isclose(first * of_end, of_first * ratio) for ratio, of_end in others)


def _partner(flat: FlatModel, inner: list[PortRef], ends: list[PortRef], y: Floats, rates: dict[int, int]) -> str:
    """Of two ends: the speed of the second that belongs to that of the first; empty where that is prescribed."""
    index, ratio, unit = _place(flat, ends[0])
    (_, by_one, _), (_, by_other, _) = (_place(flat, one) for one in inner[:2])
    if len(ends) != 2 or index not in rates or by_other == 0.0:
        return ""
    _, turned, other = _place(flat, ends[1])
    speed = y[rates[index]]
    return f", and {by_one * turned / by_other * speed:g} {other} belongs to {ratio * speed:g} {unit}"


def _end(flat: FlatModel, ref: PortRef, y: Floats, rates: dict[int, int]) -> str:
    index, ratio, unit = _place(flat, ref)
    who = flat.groups[index].name
    if index not in rates:
        return f"{ref} prescribed by {who}"
    return f"{ref} ({who}) at {ratio * y[rates[index]]:g} {unit}"
