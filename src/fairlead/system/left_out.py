"""What is left of a System when what is carried goes along with its carrier (see carried.py).

An unknown of a component's own rests unless its row answers to something that moves; a law is left out if nothing
that it gives does. Who answers is found from the partial derivatives at two states (influence.py), then the
guards are asked (probing.py); what they want kept moves too, until nothing changes any more.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from fairlead.system.asking import aligned, call, partials_at
from fairlead.system.influence import Influence, answers, paths, spread
from fairlead.system.moving import Following, Moving, Rider
from fairlead.system.probing import Guards, Probe
from fairlead.system.rest import Booleans, Floats, Integers
from fairlead.system.system import Instance

JOLT = 1e-3
"""Share of its size by which everything that moves is displaced, to see what answers to it."""
STEADY = 1e-3
"""Share of its error weight that a state of the component's own may change in a second and count as at rest."""


class Look:
    """One look at a System at (t, y) with some riders: what is left of it, and which laws say when that ends."""

    def __init__(
        self, system: Instance, found: Influence, guards: Guards, circles: Integers, riders: list[Rider],
        what: Following, t: float, y: Floats,
    ) -> None:  # fmt: skip
        """Let go of more and more until nothing left out answers to anything that is not.

        `circles` are the unknowns of the contacts that may close one, in the order of the numbering.
        """
        self._circles = circles
        self.system, self.riders, self.t = system, riders, t
        self.following = what
        self.y = aligned(system, self.following, t, y)
        may_rest, varies = self._may_rest(), np.zeros(len(found.restless), dtype=bool)
        here, along = partials_at(system, t, self.y), paths(found, self.following.place, self.following.ratio)
        probe = Probe(system, guards, riders, self.following, system.memory["z"].copy())
        while True:
            there = partials_at(system, t, self._jolted(may_rest))
            which = answers(along, [here, there])
            self.moves, self.laws = spread(found, which, self._moving(may_rest), may_rest, varies)
            self.varying = found.gives[which.value[self.moves[which.z]]]
            fewer = may_rest & ~self.moves[: system.n]
            if (fewer == may_rest).all():
                self.kept = self._kept(may_rest)
                stays, self.watched = probe.judged(self.laws, self.moves, self.kept)
                if not (stays & ~varies).any():
                    break
                varies |= stays
            may_rest = fewer
        self.watched = np.union1d(self.watched, probe.first_reached(self.laws))
        self.kept = self._kept(may_rest)

    def _may_rest(self) -> Booleans:
        """Unknowns of components' own that rest unless something moves them."""
        system, numbering = self.system, self.system.numbering
        f = np.zeros(system.n)
        call(system, "rhs", self.t, self.y, f)
        still = ~system.differential | (np.abs(f) <= STEADY * system.absolute)
        made = np.zeros(system.n, dtype=bool)
        own = np.array(list(numbering.own.values()), dtype=np.int64)
        made[own] = still[own]
        return made

    def _moving(self, may_rest: Booleans) -> Booleans:
        """By place in z: whether it is taken to move at first; signals are if something moves them."""
        numbering, n = self.system.numbering, self.system.n
        moves = np.ones(len(self.following.place), dtype=bool)
        moves[:n] = ~may_rest
        moves[self.following.unknowns] = False
        moves[n : numbering.first_reaction] = moves[numbering.zero] = False
        return moves

    def _jolted(self, may_rest: Booleans) -> Floats:
        """Y with all that moves displaced, and what is carried along with it; nothing as far as its next guard."""
        system = self.system
        move = JOLT * (np.abs(self.y) + system.absolute) * np.random.default_rng(1).uniform(-1, 1, system.n)
        move[may_rest | system.quadrature] = 0.0
        return aligned(system, self.following, self.t, self.y + move)

    def _kept(self, may_rest: Booleans) -> Booleans:
        """Unknowns that stay: all that move, those of laws that stay, shares of contacts that do."""
        system, numbering, start = self.system, self.system.numbering, 0
        kept = ~may_rest
        kept[self.following.unknowns] = False
        for block in system.blocks:
            mine = self.laws[start : start + block.count]
            for k, target in enumerate(block.kernel.structure.targets):
                if target.startswith("own:"):
                    kept[block.flow_index[mine, k]] = True
            start += block.count
        sharing = {group for group, _ in self._ends_of_circles(kept)}
        for group, share in numbering.share.items():
            kept[share] = group in sharing
        return kept

    def hindered(self) -> set[int]:
        """Groups that cannot be left out: a contact of a circle that stays holds them, or their ratio varies."""
        if np.isin(self._signals_of_bonds(), self.varying).any():  # as the radius of a drum from one layer to the next
            return set(self.following.groups)
        return {group for group, _ in self._ends_of_circles(self.kept) if group in self.following.groups}

    def _ends_of_circles(self, kept: Booleans) -> Iterator[tuple[int, float]]:
        """Ends of the contacts that may close a circle and are kept."""
        for k in np.flatnonzero(kept[self._circles]).tolist():
            yield from self.system.numbering.circles[k].ends

    def moving(self) -> Moving:
        """What stays, and whose change ends it."""
        system, start = self.system, 0
        rim, machines = np.zeros(len(system.zones), dtype=bool), [np.zeros(0, np.int64)]
        laws, watched = [], []
        watches = np.zeros(len(self.laws), dtype=bool)
        watches[self.watched] = True
        signals = self._signals_of_bonds()
        for block in system.blocks:
            mine = slice(start, start + block.count)
            laws.append(self.laws[mine].copy())
            watched.append(watches[mine] & ~laws[-1])
            machines.append(block.machines[laws[-1] | watched[-1]].ravel())
            rim[block.machines[watched[-1] | np.isin(block.sig_index, signals).any(axis=1)].ravel()] = True
            start += block.count
        of_all = np.sort(np.concatenate(machines)).astype(np.int64)
        return Moving(self.kept, laws, watched, of_all, rim, self.following)

    def _signals_of_bonds(self) -> Integers:
        """Where in z the signals stand from which the bonds have their ratio, such as the radius of a drum."""
        bonds, found, start = np.array([rider.law for rider in self.riders]), [np.zeros(0, np.int64)], 0
        for block in self.system.blocks:
            mine = bonds[(bonds >= start) & (bonds < start + block.count)] - start
            read = [key.startswith("in:") for key in block.kernel.structure.inputs]
            found.append(block.in_index[mine][:, read].ravel())
            start += block.count
        at = np.unique(np.concatenate(found))
        return at[at < self.system.numbering.first_reaction]
