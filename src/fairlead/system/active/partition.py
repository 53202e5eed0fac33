"""What of a System must be computed while nodes are entrained; the rest is a number as long as that is true.

Left out may be

    an entrained node       it stands for its carrier, see entrained.py
    an unknown of a law     whose rate is settled, or that is algebraic, and whose row depends on nothing that varies
    a law                   of which no value depends on anything that varies, and no guard either

What varies is found from what every value depends on (dependences.py). It begins with all other unknowns, with time and
with what samples, and ends when nothing more is found. A law that stays may change its zone: all its values vary.

A guard of a law that is left out may depend on one position alone, and be straight in it. Then the place at which it
fires is known. Of the guards of one position only the next ahead and the next behind are *monitored*: they are
evaluated in every step, and when one fires, the whole goes on. The others cannot fire before them. Where the position
varies by itself, the laws nearest to firing stay, `margin` of them at every border: monitored guards seldom fire then.

A guard that is a group cannot fire while a member is negative that depends on nothing that varies.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from fairlead.component.assembly import PortRef
from fairlead.component.keys import OWN, key
from fairlead.system.active.dependences import Laws, dependences
from fairlead.system.active.entrained import Entrained
from fairlead.system.active.moving import Moving
from fairlead.system.active.rest import Booleans, Floats, Integers
from fairlead.system.compiled.asking import call, guards_at
from fairlead.system.compiled.system import Instance

SETTLED = 1e-3
"""Share of its error weight that a state may be from where it settles by itself."""


class Partition:
    """One look at a System at (t, y) with some nodes entrained: what varies, and which laws say when that ends."""

    def __init__(self, system: Instance, of: Laws, along: Entrained, margin: int, t: float, y: Floats) -> None:
        """Find all that varies."""
        self.system, self.of, self.along = system, of, along
        y = along.aligned(system, t, y)
        self._may_rest = _may_rest(system, t, y)
        self._guards = guards_at(system, t, y)
        self._found = dependences(system, of, along, self._guards)
        self._position = _positions(system)
        self.varies, self.laws = self._beginning(), of.restless.copy()
        self._spread()
        self.laws |= self._nearest(margin)
        self._spread()
        self.kept = self._kept()
        self.monitored = self._monitored()

    def _beginning(self) -> Booleans:
        """By place in z: what varies in any case; signals do if something makes them."""
        numbering, n = self.system.numbering, self.system.n
        varies = np.ones(len(self.along.place), dtype=bool)
        varies[:n] = ~self._may_rest
        varies[self.along.unknowns] = False
        varies[n : numbering.first_reaction] = varies[numbering.zero] = False
        return varies

    def _spread(self) -> None:
        """Let vary what depends on what varies."""
        of, found, n = self.of, self._found, self.system.n
        while True:
            value = (of.restless | (self.laws & of.zoned))[of.law]
            value[found.value[self.varies[found.value_z]]] = True
            varies = self.varies.copy()
            varies[of.gives[value & (of.gives >= 0)]] = True
            row = of.row[value & (of.row >= 0) & (of.row < n)]
            varies[row[self._may_rest[row]]] = True
            now = self.laws | self._kept_by_guards()
            now[of.law[value]] = True
            if (varies == self.varies).all() and (now == self.laws).all():
                return
            self.varies, self.laws = varies, now

    def _awake(self) -> tuple[Booleans, Booleans]:
        """By member: whether it depends on something that varies and its guard may fire; and whether it is straight.

        A straight one is that in one position, and in nothing else that varies.
        """
        found, members = self._found, self._found.members
        some = self.varies[found.member_z]
        moves = np.bincount(found.member[some], minlength=len(members.guard))
        shut = np.zeros(len(self._guards), dtype=bool)
        shut[members.guard[(moves == 0) & (members.now < 0)]] = True
        places = np.bincount(found.member[some & self._position[found.member_z]], minlength=len(members.guard))
        straight = (members.straight != 0) & (places == 1) & (moves == 1) & ~self.of.unknowns[members.law]
        return (moves > 0) & ~shut[members.guard], straight

    def _kept_by_guards(self) -> Booleans:
        """By law: whether a guard of it may fire and cannot be monitored."""
        awake, straight = self._awake()
        made = np.zeros(len(self.laws), dtype=bool)
        made[self._found.members.law[awake & ~straight]] = True
        return made

    def _travels(self) -> tuple[Integers, Integers, Floats]:
        """Of laws left out the members that may fire: number, place in z, and the way of that place until then."""
        found, (awake, straight) = self._found, self._awake()
        some = (awake & straight & ~self.laws[found.members.law])[found.member] & self.varies[found.member_z]
        member, place = found.member[some], found.member_z[some]
        return member, place, -found.members.now[member] / found.slope[some]

    def _nearest(self, margin: int) -> Booleans:
        """Laws that are nearest to firing as something varies by itself, so many of every border."""
        member, place, _ = self._travels()
        member, members = member[~np.isin(place, self.along.carriers)], self._found.members
        way, border = np.abs(members.now[member] / members.straight[member]), members.border[member]
        order = member[np.lexsort((way, border))]
        _, first, size = np.unique(members.border[order], return_index=True, return_counts=True)
        made = np.zeros(len(self.laws), dtype=bool)
        made[members.law[order[np.arange(len(order)) - np.repeat(first, size) < margin]]] = True
        return made

    def _monitored(self) -> Integers:
        """Laws left out whose guards fire first, ahead and behind, by every position."""
        member, place, travel = self._travels()
        found = []
        for ahead in (True, False):
            mine = np.flatnonzero((travel >= 0) == ahead)
            order = mine[np.lexsort((np.abs(travel[mine]), place[mine]))]
            _, first = np.unique(place[order], return_index=True)
            found.append(self._found.members.law[member[order[first]]])
        return np.unique(np.concatenate(found))

    def _kept(self) -> Booleans:
        """Unknowns that stay: all that vary, those of laws that stay, shares of contacts that do."""
        system, numbering, start = self.system, self.system.numbering, 0
        kept = self.varies[: system.n] | ~self._may_rest
        kept[self.along.unknowns] = False
        for block in system.blocks:
            mine = self.laws[start : start + block.count]
            for k, target in enumerate(block.kernel.structure.targets):
                if key(target).kind == OWN:
                    kept[block.flow_index[mine, k]] = True
            start += block.count
        sharing = {group for group, _ in self._ends_of_circles(kept)}
        for group, share in numbering.share.items():
            kept[share] = group in sharing
        return kept

    def _ends_of_circles(self, kept: Booleans) -> Iterator[tuple[int, float]]:
        """Ends of the contacts that may close a circle and are kept."""
        for pair in self.system.numbering.circles:
            if kept[self.system.numbering.own[pair.path, pair.unknown]]:
                yield from pair.ends

    def hindered(self) -> set[int]:
        """Groups that cannot be entrained: a contact of a circle that stays holds them, or their ratio varies."""
        varying = {n.group for n in self.along.nodes if self.varies[list(n.read)].any()}  # as between layers of a drum
        taken_along = self.along.groups
        return varying | {group for group, _ in self._ends_of_circles(self.kept) if group in taken_along}

    def moving(self) -> Moving:
        """What stays, and whose change ends it."""
        system, start = self.system, 0
        boundary, machines = np.zeros(len(system.zones), dtype=bool), [np.zeros(0, np.int64)]
        laws, watched = [], []
        watches = np.zeros(len(self.laws), dtype=bool)
        watches[self.monitored] = True
        ratios = np.unique([place for node in self.along.nodes for place in node.read]).astype(np.int64)
        for block in system.blocks:
            mine = slice(start, start + block.count)
            laws.append(self.laws[mine].copy())
            watched.append(watches[mine] & ~laws[-1])
            machines.append(block.machines[laws[-1] | watched[-1]].ravel())
            boundary[block.machines[watched[-1] | np.isin(block.sig_index, ratios).any(axis=1)].ravel()] = True
            start += block.count
        of_all = np.sort(np.concatenate(machines)).astype(np.int64)
        return Moving(self.kept, laws, watched, of_all, boundary, self.along)


def _may_rest(system: Instance, t: float, y: Floats) -> Booleans:
    """Unknowns of components' own that rest unless something moves them: algebraic ones, and states that settled.

    A state settles at f/(-df/ds) from where it is; one without such a place rests where its rate is zero.
    """
    f = np.zeros(system.n)
    call(system, "rhs", t, y, f)
    rates = np.zeros(len(system.pattern.rows))
    call(system, "jacobian", t, y, rates, np.zeros(system.n))
    column = np.repeat(np.arange(system.n), np.diff(system.pattern.starts))
    own = system.pattern.rows == column
    pace = np.zeros(system.n)
    pace[column[own]] = np.maximum(-rates[own], 0.0)
    still = ~system.differential | (np.abs(f) <= SETTLED * system.absolute * pace)
    made = np.zeros(system.n, dtype=bool)
    states = np.array(list(system.numbering.own.values()), dtype=np.int64)
    made[states] = still[states]
    return made


def _positions(system: Instance) -> Booleans:
    """By place in z: whether a position stands there, of what is free or of what is prescribed."""
    numbering, made = system.numbering, np.zeros(system.numbering.dump + 1, dtype=bool)
    made[[x for x, _ in numbering.pairs]] = True
    for group in system.flat.groups:
        if group.prescribed is not None and group.prescribed.outputs is not None:
            output = PortRef(group.prescribed.by.instance, group.prescribed.outputs[0])
            made[system.n + numbering.signals[output]] = True
    return made
