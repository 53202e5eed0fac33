"""Positions at the start that relations tie together: what nobody gave follows, what contradicts is refused.

A relation g(x) = 0 (`hold_position`) holds from the start. The positions that nobody gave, and that such relations
read, move to where all g are zero, the least way that the masses allow (Newton: x -= W J' (J W J')^-1 g with W = 1/M).
What then is not zero contradicts what was given. Relations that are not independent there leave a force open, which is
refused as well: J W J' is singular then.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from fairlead.component.assembly import Instance as Part
from fairlead.component.assembly import PortRef
from fairlead.errors import Fault, ModelError
from fairlead.flatten.flat_model import FlatModel
from fairlead.kernels.structure import Structure
from fairlead.system.compiled.asking import call
from fairlead.system.compiled.system import Floats, Instance, System

AGREES = 1e-6
"""Share of the terms of a relation that its gap may be: numbers in a netlist are rounded. The run begins on it."""
ITERATIONS, CLOSED = 60, 1e-12
"""Newton steps at most, and the share of its terms at which a gap counts as closed."""
BEGINNINGS = (0.0, 0.5, 2.0)
"""Angles [rad] added in turn to those that nobody gave, where a relation is not met: 0 may be a dead centre."""
DEPENDENT = 1e-9
"""Least eigenvalue of J W J', scaled to ones on its diagonal, below which relations are not independent."""


class Kept(NamedTuple):
    """One relation of positions: who keeps it, its row, and the ports it reads."""

    part: Part
    row: int
    ports: tuple[str, ...]


def unfit(flat: FlatModel, structures: Mapping[str, Structure]) -> list[Fault]:
    """Relations of positions between ports of which one has no mass, or none may move."""
    faults = []
    for part in flat.instances:
        if not structures[part.path].positions:
            continue
        ports = dict.fromkeys(port for ports in structures[part.path].positions.values() for port in ports)
        free = [port for port in ports if flat.groups[flat.place(PortRef(part.path, port))[0]].free]
        light = [port for port in free if flat.groups[flat.place(PortRef(part.path, port))[0]].mass == 0]
        if ports and not free:
            what = f"{part.path} keeps a relation between {_and(ports)}, and all of these motions are given."
            faults.append(Fault(part.where, what, "Leave one of them free, with a mass, or leave out what keeps them."))
        for port in light:
            rotates = part.type.declaration.ports[port].domain.name == "rotational"
            body = "an Inertia" if rotates else "a Mass"
            what = f"{part.path} keeps the position of its {port}, which has no mass."
            faults.append(Fault(part.where, what, f"Add {body} there: the force that keeps it follows from that."))
    return faults


def placed(system: System, initially: Collection[int]) -> System:
    """The System with the positions that follow at the start; `initially` are the unknowns that `initial` names.

    Raises ModelError where positions contradict each other, or relations are not independent.
    """
    rows = kept(system)
    if not rows:
        return system
    here = system.instance()
    given = {x for k, x in system.numbering.position.items() if system.flat.groups[k].given[0]} | set(initially)
    groups = list(system.numbering.accelerated)
    x = np.array([system.numbering.position[k] for k in groups])
    ease = np.array([1 / system.flat.groups[k].mass for k in groups])
    movable = np.array([one not in given for one in x.tolist()])
    at = np.array([one.row for one in rows])
    turns = np.array([system.flat.groups[k].domain.name == "rotational" for k in groups])
    for begin in BEGINNINGS:
        y = system.initial.copy()
        y[x] += begin * (turns & movable)
        _close(here, y, x, at, ease * movable)
        ratios, gap = ratios_at(here, y)[at], _gap(here, y)[at]
        wrong = np.abs(gap) > AGREES * _size(ratios, y[x], gap)
        if not wrong.any():
            break
    else:
        y = system.initial
    faults = [_contradiction(system, rows[k], y, float(gap[k])) for k in np.flatnonzero(wrong).tolist()]
    faults = faults or _dependent(rows, ratios, ease)
    if faults:
        raise ModelError(faults)
    return replace(system, initial=y)


def kept(system: System) -> list[Kept]:
    """All relations of positions."""
    found = []
    for block in system.blocks:
        s = block.kernel.structure
        for unknown, ports in s.positions.items():
            column = block.flow_index[:, s.targets.index(f"own:{unknown}")].tolist()
            found += [Kept(part, row, tuple(ports)) for part, row in zip(block.instances, column, strict=True)]
    return found


def ratios_at(here: Instance, y: Floats) -> Floats:
    """J [n, accelerated]: by row and by body the rate of the gap by its position; zero in other rows."""
    values, ft = np.zeros(len(here.pattern.rows)), np.zeros(here.n)
    call(here, "jacobian", here.start, y, values, ft)
    made = np.zeros((here.n, len(here.numbering.accelerated)))
    rows = np.array([one.row for one in kept(here)], dtype=np.int64)
    for k, a in enumerate(here.numbering.accelerated.values()):
        part = slice(here.pattern.starts[a], here.pattern.starts[a + 1])
        of_kept = np.isin(here.pattern.rows[part], rows)
        made[here.pattern.rows[part][of_kept], k] = -values[part][of_kept]
    return made


def _gap(here: Instance, y: Floats) -> Floats:
    made = np.zeros(here.n)
    call(here, "gap", here.start, y, made)
    return -made


def _size(ratios: Floats, x: Floats, gap: Floats) -> Floats:
    """The largest of the terms that a gap adds up, to first order."""
    return np.maximum(np.abs(ratios * x).max(axis=1, initial=0.0), np.abs(gap - ratios @ x))


def _close(here: Instance, y: Floats, x: np.ndarray, at: np.ndarray, ease: Floats) -> None:
    """Move positions x in y until the gaps in rows `at` are closed, as far as those with ease can."""
    for _ in range(ITERATIONS):
        ratios, gap = ratios_at(here, y)[at], _gap(here, y)[at]
        system = (ratios * ease) @ ratios.T
        able = np.diag(system) > 0
        if not able.any() or (np.abs(gap[able]) <= CLOSED * _size(ratios, y[x], gap)[able]).all():
            return
        scale = 1 / np.sqrt(np.diag(system)[able])
        scaled = system[np.ix_(able, able)] * np.outer(scale, scale)
        force = scale * (np.linalg.pinv(scaled, rcond=DEPENDENT, hermitian=True) @ (scale * gap[able]))
        way, before = -ease * (ratios[able].T @ force), np.abs(scale * gap[able]).max()
        for _ in range(20):  # halves of it, until it leads nearer
            moved = y.copy()
            moved[x] += way
            now = np.abs(scale * _gap(here, moved)[at][able]).max()
            if now < before:
                break
            way = way / 2
        else:
            return
        y[x] += way


def _contradiction(system: System, one: Kept, y: Floats, gap: float) -> Fault:
    ends = " and ".join(_end(system, one.part, port, y) for port in one.ports)
    what = f"{one.part.path} keeps a relation of positions, but they start {abs(gap):.3g} off it, with {ends}."
    return Fault(one.part.where, what, "Give positions that agree, or leave out all but one of them.")


def _end(system: System, part: Part, port: str, y: Floats) -> str:
    ref = PortRef(part.path, port)
    index, ratio, offset = system.flat.place(ref)
    if index not in system.numbering.position:
        prescribed = system.flat.groups[index].prescribed
        return f"{ref} prescribed by {'nobody' if prescribed is None else prescribed.by.instance}"
    unit = system.flat.groups[index].domain.across[0][1]
    return f"{ref} at {ratio * y[system.numbering.position[index]] + offset:.9g} {unit}"


def _dependent(rows: list[Kept], ratios: Floats, ease: Floats) -> list[Fault]:
    """Relations of which one says what others say, or that nothing can keep."""
    system = (ratios * ease) @ ratios.T
    size = np.sqrt(np.diag(system))
    stuck = [one for one, most in zip(rows, size.tolist(), strict=True) if most == 0.0]
    if stuck:
        what = f"{_and(one.part.path for one in stuck)}: at the start no free motion changes what is kept."
        return [Fault(stuck[0].part.where, what, "Start at another position: this is a dead centre.")]
    value, vector = np.linalg.eigh(system / np.outer(size, size))
    if value[0] > DEPENDENT:
        return []
    said = [one for one, share in zip(rows, np.abs(vector[:, 0]).tolist(), strict=True) if share > 1e-3]
    what = f"{_and(one.part.path for one in said)} keep relations of positions that are not independent at the start."
    way_out = "How they share the force is not known: leave one out, put a spring in series, or start elsewhere."
    return [Fault(said[0].part.where, what, way_out)]


def _and(names: Iterable[str]) -> str:
    *first, last = dict.fromkeys(names)
    return f"{', '.join(first)} and {last}" if first else last
