"""What of a System moves, as long as what holds goes on holding: with a margin, so that motion may spread.

The contacts that hold the rest in place make up its rim: when the zone of one changes, the rest must wake. What
moves is then cut out as a System of its own (cutting.py), which an engine runs instead of the whole.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fairlead.system.carried import Carriage
from fairlead.system.cutting import cut
from fairlead.system.moving import Moving, nothing_carried
from fairlead.system.part import Part
from fairlead.system.rest import Anatomy, Booleans, Floats, Integers, Rest, anatomy, at_rest, leaning_on
from fairlead.system.system import Instance

HUB = 64
"""An unknown in more equations than this passes no motion on: what hangs on it moves anyway, or hangs on a rest."""
MORE = 1.1
"""Nodes that are carried, over those at the last look, from which on another look is worth it."""
HOLDING = 0.2
"""Contacts that hold, over the unknowns that have to rest, below which it is not worth a look."""


class Narrowing:
    """Cuts parts that move out of one System."""

    def __init__(self, system: Instance) -> None:
        """Look at a whole System; nothing is cut yet."""
        self.system = system
        self._anatomy: Anatomy | None = None
        self._loud: tuple[Integers, Integers] | None = None
        self._givers: list[Booleans] = []
        self._carriage = Carriage(system)
        self._carried = 0

    @property
    def possible(self) -> bool:
        """True if something may be left out."""
        return bool(self._carriage.bonds) or self._may_rest

    @property
    def _may_rest(self) -> bool:
        """True if something holds, and nothing but time and the unknowns sets what moves."""
        memory = self.system.memory
        return bool(len(memory["holds"]) and not len(memory["sampled"]) and not len(memory["circle_pairs"]))

    def moving(self, t: float, y: Floats, margin: int, most: float, now: Part | None = None) -> Moving | None:
        """What is left at (t, y [n]) without what rests or is carried; None if that is not worth while.

        What rests is left out but for a margin of as many equations, if what stays is at most a share of `most`.
        `now` is the part that is in force: less of what is carried is then not worth a look.
        """
        count = self._carriage.count
        if now is not None and now.sure and count < MORE * self._carried:
            return None
        found = self._carriage.moving(t, y)
        if found is not None:
            self._carried = count
            return found
        return self._not_at_rest(y, margin, most) if self._may_rest else None

    def _not_at_rest(self, y: Floats, margin: int, most: float) -> Moving | None:
        system = self.system
        holds = system.memory["holds"]
        if np.count_nonzero(system.zones[holds[:, 0]] == holds[:, 1]) < HOLDING * (1.0 - most) * system.n:
            return None
        if self._anatomy is None:
            self._anatomy, self._loud, self._givers = anatomy(system), _reached_by(system), _givers(system)
        rest = at_rest(self._anatomy, system, y)
        if np.count_nonzero(rest.still) < (1.0 - most) * system.n:
            return None
        kept = self._with_margin(~rest.still, margin)
        while True:
            laws = self._laws(kept, ~rest.still)
            left_out = _as_whole_rows(rest, ~(kept | self._own_unknowns(laws)))
            if (left_out == ~kept).all():
                break
            kept = ~left_out
        if np.count_nonzero(kept) > most * system.n:
            return None
        of_blocks = [block.machines[chosen].ravel() for block, chosen in zip(system.blocks, laws, strict=True)]
        machines = np.sort(np.concatenate([*of_blocks, np.zeros(0, np.int64)]).astype(np.int64))
        nothing = [np.zeros(block.count, dtype=bool) for block in system.blocks]
        rim = leaning_on(rest, left_out, len(system.zones))
        return Moving(kept, laws, nothing, machines, rim, nothing_carried(system))

    def part(self, t: float, y: Floats, moving: Moving) -> Part | None:
        """The System of what moves, with the numbers of the rest at (t, y); None if its equations differ there."""
        return cut(self.system, t, y, moving)

    def _with_margin(self, moving: Booleans, margin: int) -> Booleans:
        """What moves, and what is at most `margin` equations away from it."""
        assert self._loud is not None
        row, column = self._loud
        reached = moving.copy()
        for _ in range(margin):
            near = reached.copy()
            near[row[reached[column]]] = True
            near[column[reached[row]]] = True
            if (near == reached).all():
                break
            reached = near
        return reached

    def _laws(self, kept: Booleans, moving: Booleans) -> list[Booleans]:
        """By block: the instances that read or move what is kept, or read what varies."""
        system = self.system
        numbering, n = system.numbering, system.n
        z = np.zeros(numbering.dump + 1, dtype=bool)
        z[:n] = kept | moving
        z[numbering.acceleration : numbering.acceleration + n] = kept
        z[numbering.first_reaction : numbering.zero] = z[numbering.time] = True
        w = np.zeros(numbering.w_dump + 1, dtype=bool)
        w[:n] = kept & ~system.quadrature
        laws = [gives.copy() for gives in self._givers]
        while True:
            before = sum(int(np.count_nonzero(chosen)) for chosen in laws)
            for block, chosen in zip(system.blocks, laws, strict=True):
                chosen |= z[block.in_index].any(axis=1) | w[block.flow_index].any(axis=1)
                given = block.sig_index[chosen].ravel()
                z[given[given != numbering.dump]] = True
            if before == sum(int(np.count_nonzero(chosen)) for chosen in laws):
                return laws

    def _own_unknowns(self, laws: Sequence[Booleans]) -> Booleans:
        """Unknowns that belong to these instances: they stay with them."""
        found = np.zeros(self.system.n, dtype=bool)
        for block, chosen in zip(self.system.blocks, laws, strict=True):
            for k, target in enumerate(block.kernel.structure.targets):
                if target.startswith("own:"):
                    found[block.flow_index[chosen, k]] = True
        return found


def _reached_by(system: Instance) -> tuple[Integers, Integers]:
    """Entries (row, column) along which motion spreads: all but those of hubs and of the ledger."""
    n = system.n
    row = np.concatenate([system.pattern.rows, system.mass_pattern.rows])
    column = np.concatenate([np.repeat(np.arange(n), np.diff(p.starts)) for p in (system.pattern, system.mass_pattern)])
    degree = np.bincount(row, minlength=n) + np.bincount(column, minlength=n)
    near = (degree[row] <= HUB) & (degree[column] <= HUB) & ~system.quadrature[row]
    return row[near], column[near]


def _givers(system: Instance) -> list[Booleans]:
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
