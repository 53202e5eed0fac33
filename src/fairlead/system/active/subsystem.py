"""The active subsystem: what of a System must be computed for a while; an engine then runs that instead of the whole.

Left out is what is entrained, with all that then depends on nothing (partition.py); or, where nothing is, what rests as
long as what holds goes on holding (rest.py), but for a margin, so that motion may spread. Either says at its boundary
when it ends: by the guards that are monitored, or by the contacts on which the rest leans. restriction.py makes a
System of what is left.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fairlead.component.keys import OWN, key
from fairlead.kernels import layout
from fairlead.system.active.dependences import Laws, laws
from fairlead.system.active.entrained import Bonds, entrained, nothing_entrained
from fairlead.system.active.moving import Moving
from fairlead.system.active.part import Part
from fairlead.system.active.partition import Partition
from fairlead.system.active.rest import Anatomy, Booleans, Floats, Integers, Rest, anatomy, at_rest, leaning_on
from fairlead.system.active.restriction import cut
from fairlead.system.compiled.system import Instance

HUB = 64
"""An unknown in more equations than this passes no motion on: what hangs on it moves anyway, or hangs on a rest."""
MORE = 1.1
"""Nodes that are entrained, over those at the last look, from which on another look is worth it."""
MOST = 0.9
"""Share of the unknowns that may be left of a whole with entrained nodes; more is not worth it."""
LEAST_ENTRAINED = 16
"""Fewer nodes than this are not worth it."""
HOLDING = 0.2
"""Contacts that hold, over the unknowns that have to rest, below which it is not worth a look."""


class Subsystem:
    """Cuts parts that move out of one System."""

    def __init__(self, system: Instance) -> None:
        """Look at a whole System; nothing is cut yet."""
        self.system = system
        self._facts: tuple[Anatomy, tuple[Integers, Integers], list[Booleans]] | None = None
        self._laws: Laws | None = None
        self._bonds = Bonds(system)
        self.looked = 0

    @property
    def possible(self) -> bool:
        """True if something may be left out."""
        return bool(self._bonds.blocks) or self._may_rest

    @property
    def _may_rest(self) -> bool:
        """True if something holds, and nothing but time and the unknowns sets what moves."""
        memory = self.system.memory
        return bool(len(memory["holds"]) and not len(memory["sampled"]) and not len(memory["circle_pairs"]))

    def moving(self, t: float, y: Floats, margin: int, most: float, now: Part | None = None) -> Moving | None:
        """What is left at (t, y [n]) without what rests or is entrained; None if that is not worth while.

        What rests is left out but for a margin of as many equations, if what stays is at most a share of `most`.
        `now` is the part that is in force: less of what is entrained is then not worth a look.
        """
        count = self._bonds.count
        if now is not None and now.sure and count < MORE * self.looked:
            return None
        found = self._without_entrained(t, y, margin)
        if found is not None:
            self.looked = count
            return found
        return self._not_at_rest(y, margin, most) if self._may_rest else None

    def _without_entrained(self, t: float, y: Floats, margin: int) -> Moving | None:
        """What is left without the nodes that are entrained; those that hinder that stay unknowns."""
        if self._bonds.count < LEAST_ENTRAINED:
            return None
        if self._laws is None:
            self._laws = laws(self.system)
        nodes = self._bonds.nodes(t, y)
        while len(nodes) >= LEAST_ENTRAINED:
            found = Partition(self.system, self._laws, entrained(self.system, nodes, t, y), margin, t, y)
            hindered = found.hindered()
            if not hindered:
                return found.moving() if np.count_nonzero(found.kept) <= MOST * self.system.n else None
            nodes = [node for node in nodes if node.group not in hindered]
        return None

    def _not_at_rest(self, y: Floats, margin: int, most: float) -> Moving | None:
        """What is left without what rests and a margin around what moves."""
        system = self.system
        holds = system.memory["holds"]
        now = system.zones[holds[:, layout.HOLD_PLACE]] == holds[:, layout.HOLD_ZONE]
        if np.count_nonzero(now) < HOLDING * (1.0 - most) * system.n:
            return None
        if self._facts is None:
            self._facts = anatomy(system), _reached_by(system), _sources(system)
        parts, reached, sources = self._facts
        rest = at_rest(parts, system, y)
        if np.count_nonzero(rest.still) < (1.0 - most) * system.n:
            return None
        kept = _with_margin(~rest.still, margin, *reached)
        while True:
            laws = _laws(system, sources, kept, ~rest.still)
            left_out = _as_whole_rows(rest, ~(kept | _own_unknowns(system, laws)))
            if (left_out == ~kept).all():
                break
            kept = ~left_out
        if np.count_nonzero(kept) > most * system.n:
            return None
        of_blocks = [block.machines[chosen].ravel() for block, chosen in zip(system.blocks, laws, strict=True)]
        machines = np.sort(np.concatenate([*of_blocks, np.zeros(0, np.int64)]).astype(np.int64))
        nothing = [np.zeros(block.count, dtype=bool) for block in system.blocks]
        boundary = leaning_on(rest, left_out, len(system.zones))
        return Moving(kept, laws, nothing, machines, boundary, nothing_entrained(system))

    def part(self, t: float, y: Floats, moving: Moving) -> Part:
        """The System of what moves, with the numbers of the rest at (t, y)."""
        return cut(self.system, t, y, moving)


def _with_margin(moving: Booleans, margin: int, row: Integers, column: Integers) -> Booleans:
    """What moves, and what is at most `margin` equations away from it, by entries (row, column)."""
    reached = moving.copy()
    for _ in range(margin):
        near = reached.copy()
        near[row[reached[column]]] = True
        near[column[reached[row]]] = True
        if (near == reached).all():
            break
        reached = near
    return reached


def _laws(system: Instance, sources: Sequence[Booleans], kept: Booleans, moving: Booleans) -> list[Booleans]:
    """By block: the instances that read or move what is kept, or read what varies."""
    numbering, n = system.numbering, system.n
    z = np.zeros(numbering.dump + 1, dtype=bool)
    z[:n] = kept | moving
    z[numbering.acceleration : numbering.acceleration + n] = kept
    z[numbering.first_reaction : numbering.zero] = z[numbering.time] = True
    w = np.zeros(numbering.w_dump + 1, dtype=bool)
    w[:n] = kept & ~system.quadrature
    laws = [gives.copy() for gives in sources]
    while True:
        before = sum(int(np.count_nonzero(chosen)) for chosen in laws)
        for block, chosen in zip(system.blocks, laws, strict=True):
            chosen |= z[block.in_index].any(axis=1) | w[block.flow_index].any(axis=1)
            given = block.sig_index[chosen].ravel()
            z[given[given != numbering.dump]] = True
        if before == sum(int(np.count_nonzero(chosen)) for chosen in laws):
            return laws


def _own_unknowns(system: Instance, laws: Sequence[Booleans]) -> Booleans:
    """Unknowns that belong to these instances: they stay with them."""
    found = np.zeros(system.n, dtype=bool)
    for block, chosen in zip(system.blocks, laws, strict=True):
        for k, target in enumerate(block.kernel.structure.targets):
            if key(target).kind == OWN:
                found[block.flow_index[chosen, k]] = True
    return found


def _reached_by(system: Instance) -> tuple[Integers, Integers]:
    """Entries (row, column) along which motion spreads: all but those of dense rows and of the ledger."""
    n = system.n
    row = np.concatenate([system.pattern.rows, system.mass_pattern.rows])
    column = np.concatenate([np.repeat(np.arange(n), np.diff(p.starts)) for p in (system.pattern, system.mass_pattern)])
    degree = np.bincount(row, minlength=n) + np.bincount(column, minlength=n)
    near = (degree[row] <= HUB) & (degree[column] <= HUB) & ~system.quadrature[row]
    return row[near], column[near]


def _sources(system: Instance) -> list[Booleans]:
    """By block: instances that prescribe a motion."""
    paths = {g.prescribed.by.instance for g in system.flat.groups if g.prescribed and g.prescribed.outputs}
    return [np.array([i.path in paths for i in block.instances], dtype=bool) for block in system.blocks]


def _as_whole_rows(rest: Rest, left_out: Booleans) -> Booleans:
    """Of the unknowns to leave out those whose equations are left out with them."""
    out = left_out & rest.still
    while True:
        fewer = out.copy()
        fewer[out] = out[rest.found_by[out]]
        if (fewer == out).all():
            return out
        out = fewer
