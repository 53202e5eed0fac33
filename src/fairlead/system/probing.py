"""What the guards of a System say of laws that are to be left out: whether they must stay, and when that ends.

They are asked with what stands in z displaced: positions and speeds of what moves, signals and states that vary. No
state of the model need belong to what they are told.
"""

from __future__ import annotations

import ctypes

import numpy as np

from fairlead.component.instantiate import PortRef
from fairlead.system import layout
from fairlead.system.blocks import place_of_motion
from fairlead.system.moving import Following, Rider
from fairlead.system.rest import Booleans, Floats, Integers
from fairlead.system.system import Instance

KERNEL = ctypes.CFUNCTYPE(None, *(ctypes.c_int64, ctypes.c_void_p), *2 * (ctypes.c_int64,), *4 * (ctypes.c_void_p,))
TRAVEL = 1e-4
"""m or rad by which carried nodes are displaced to see which guards they reach."""
JOLTS = (1e-3, 1.0, 1e6, -1e6)
"""What signals and states are displaced by, over their size, to see whether a guard reads them."""
ROUNDING = 1e-7
"""Share of its size and its tolerance that a guard must change by to have changed."""
FAST = 10.0
"""m/s or rad/s; at the speeds from this to its opposite nothing may happen to what is left out."""
FEW = 3
"""Times that everything that moves is displaced, and moved, by chance."""
NEAR, AT = 2.0, 1000
"""m or rad; what comes upon something within this way stays in: of a whole with so many unknowns.

The way to the next look grows with the root of their number, as a look costs the more the more there are, and what
stays in costs the same.
"""


class Guards:
    """All guards for what stands in z, be it consistent or not; those of circles are not among them."""

    def __init__(self, system: Instance) -> None:
        """Find the kernels and what they want to be told."""
        memory = system.memory
        self._count = len(system.guard_tolerance)
        self._last = [memory[name].ctypes.data for name in ("zones", "tables")]
        self._asked = [
            (KERNEL(block.kernel.address), row.ctypes.data, block.count)
            for block, row in zip(system.blocks, memory["blocks"], strict=True)
            if block.kernel.structure.slots
        ]

    def at(self, z: Floats) -> Floats:
        """Guards [k] for z."""
        made = np.zeros(self._count)
        place, out = z.ctypes.data, made.ctypes.data
        for ask, row, count in self._asked:
            ask(layout.GUARD, row, 0, count, place, *self._last, out)
        return made


class Probe:
    """Asks the guards at one state of a System, with some of it carried."""

    def __init__(self, system: Instance, guards: Guards, riders: list[Rider], what: Following, z: Floats) -> None:
        """What stands in z is consistent."""
        self.system, self.guards, self.riders, self.following, self.z = system, guards, riders, what, z
        self.now = guards.at(z)
        self.size = ROUNDING * (np.abs(self.now) + system.guard_tolerance)
        self.law, self.has_unknowns = laws_of_guards(system), laws_with_unknowns(system)
        self.near = NEAR * max(system.n / AT, 1.0) ** 0.5

    def judged(self, laws: Booleans, moves: Booleans, kept: Booleans) -> tuple[Booleans, Integers]:
        """By law that is left out (not in `laws`): whether it must stay; and those that say when that ends.

        It must stay if a guard answers to a signal or a state that varies (`moves` by place in z) or to how far apart
        things are that move, if one fires at other speeds, or within a short way. One that fires further on ends the
        part.
        """
        rates_carried = self.following.unknowns[len(self.riders) :]
        position, rate = self._motions(kept)
        varies = moves[: self.system.numbering.first_reaction].copy()
        varies[: self.system.n] &= kept
        varies[[*position, *rate]] = False
        others = np.flatnonzero(varies)
        stays, watched = np.zeros(len(self.now), dtype=bool), np.zeros(len(self.now), dtype=bool)
        for jolt in JOLTS:
            stays |= self._ask(others, self.z[others] + jolt * (1.0 + np.abs(self.z[others])))[0]
        speeds, ratio = np.concatenate([rate, rates_carried]), np.ones(len(self.z))
        ratio[rates_carried] = self.following.ratio[rates_carried]
        chance = np.random.default_rng(2)
        for speed in (-FAST, 0.0, FAST):
            changes, fires = self._ask(speeds, speed * ratio[speeds])
            stays |= changes & fires
        for _ in range(FEW):
            changes, fires = self._ask(rate, FAST * chance.uniform(-1, 1, len(rate)))
            stays |= changes & fires
            changes, _ = self._ask(position, self.z[position] + self.near * chance.uniform(-1, 1, len(position)))
            stays |= changes & self._between(position)[self.law]
        for way in (-self.near, self.near):
            changes, fires = self._ask(position, self.z[position] + way)
            stays |= changes & fires
            watched |= changes
        left_out = ~laws[self.law]
        watches, must = self._laws_of(watched & left_out), self._laws_of(stays & left_out)
        return must | (watches & self.has_unknowns), np.flatnonzero(watches)

    def _between(self, position: Integers) -> Booleans:
        """By law: whether it reads several of these places, and so how far they are apart."""
        among = np.zeros(len(self.z), dtype=np.int64)
        among[position] = 1
        return np.concatenate([among[block.in_index].sum(axis=1) for block in self.system.blocks]) > 1

    def _ask(self, where: Integers, what: Floats) -> tuple[Booleans, Booleans]:
        """By guard: whether it changes when this stands there, and whether it fires then."""
        z = self.z.copy()
        z[where] = what
        then = self.guards.at(z)
        return ~(np.abs(then - self.now) <= self.size), ~(then < 0)

    def _laws_of(self, guards: Booleans) -> Booleans:
        made = np.zeros(len(self.has_unknowns), dtype=bool)
        made[self.law[guards]] = True
        return made

    def _motions(self, kept: Booleans) -> tuple[Integers, Integers]:
        """Where in z positions and rates stand that stay unknowns, or are prescribed."""
        numbering, signals = self.system.numbering, self.system.numbering.signals
        pairs = [(x, v) for x, v in numbering.pairs if kept[x] and kept[v]]
        for group in self.system.flat.groups:
            if group.prescribed is not None and group.prescribed.outputs is not None:
                x, v, _ = (signals[PortRef(group.prescribed.by.instance, name)] for name in group.prescribed.outputs)
                pairs.append((self.system.n + x, self.system.n + v))
        made = np.array(pairs, dtype=np.int64).reshape(-1, 2)
        return made[:, 0], made[:, 1]

    def first_reached(self, laws: Booleans) -> Integers:
        """Of the laws left out (not in `laws`) the first to change, forward and backward, by every carrier."""
        system, numbering = self.system, self.system.numbering
        ridden, law, by = self.z.copy(), self.law, self._carrier_of_law()
        for rider in {rider.by: rider for rider in self.riders}.values():
            place, coef, _ = place_of_motion(system.flat, numbering, rider.by, 1.0, 0.0, "x")
            ridden[place] += coef * TRAVEL / rider.ratio
        ridden[self.following.unknowns[: len(self.riders)]] += TRAVEL
        now, after = self.now, self.guards.at(ridden)
        reached = (np.abs(after - now) > self.size) & ~laws[law]
        travel = np.full(len(now), np.inf)
        travel[reached] = -now[reached] * TRAVEL / (after - now)[reached]
        found = law[reached & (by[law] < 0)].tolist()
        for carrier in {rider.by for rider in self.riders}:
            for way in (1, -1):
                mine = np.flatnonzero(reached & (by[law] == carrier) & (way * travel >= 0))
                if len(mine):
                    found.append(int(law[mine[np.argmin(way * travel[mine])]]))
        return np.unique(np.array(found, dtype=np.int64))

    def _carrier_of_law(self) -> Integers:
        """By law: the group that carries all it reads of what is carried; -1 if there is none, or several."""
        of_place = np.full(len(self.following.place), -1)
        for rider in self.riders:
            of_place[self.system.numbering.position[rider.group]] = rider.by
        made = []
        for block in self.system.blocks:
            read = of_place[block.in_index]
            most = read.max(axis=1, initial=-1)
            alone = ((read == most[:, None]) | (read < 0)).all(axis=1)
            made.append(np.where(alone, most, -1))
        return np.concatenate(made)


def laws_of_guards(system: Instance) -> Integers:
    """By guard: its law, counted over all blocks."""
    made, start = [], 0
    for block in system.blocks:
        made.append(np.repeat(start + np.arange(block.count), block.kernel.structure.slots))
        start += block.count
    return np.concatenate(made)


def laws_with_unknowns(system: Instance) -> Booleans:
    """By law, counted over all blocks: whether it has unknowns of its own."""
    owns = [any(t.startswith("own:") for t in block.kernel.structure.targets) for block in system.blocks]
    return np.repeat(owns, [block.count for block in system.blocks])
