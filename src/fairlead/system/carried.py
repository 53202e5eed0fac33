"""What something else carries along, such as line on a drum: it then counts as part of what carries it.

A component that says so (`Carries`) ties the speed of a node to that of another in one of its zones. A node deep
in that zone is left out of the unknowns: it stands where the carrier takes it, its inertia is the carrier's, and what
acts on it acts on the carrier. Laws that answer to nothing else (see influence.py) are left out with it:

    z[i] = ratio z[carrier] + offset        w[carrier] += ratio w[i]

The first guards that would change that, forward and backward, are kept: when one of their machines changes, the
whole goes on. So are those of what the ratio comes from, such as the layers of a drum.
"""

from __future__ import annotations

import ctypes
from collections import defaultdict
from typing import NamedTuple

import numpy as np

from fairlead.component.declare import Carries
from fairlead.component.instantiate import PortRef
from fairlead.system import layout
from fairlead.system.blocks import place_of_motion
from fairlead.system.cutting import aligned, call
from fairlead.system.influence import Influence, answers, influence, spread
from fairlead.system.moving import Following, Moving
from fairlead.system.rest import Booleans, Floats, Integers
from fairlead.system.shares import shares
from fairlead.system.system import System

KEPT_FREE = 24
"""Carried nodes nearest to where they are let go that stay unknowns: they come off before the next look."""
MOST = 0.9
"""Share of the unknowns that may be left; more is not worth it."""
LEAST_CARRIED = 16
"""Fewer nodes than this are not worth it."""
TRAVEL = 1e-4
"""m or rad by which carried nodes are displaced to see which guards they reach."""
JOLT = 1e-3
"""Share of its size by which everything that moves is displaced, to see what answers to it."""
FAR = 1e6
"""What signals are displaced by to see whether a guard reads them at all."""
KERNEL = ctypes.CFUNCTYPE(None, *(ctypes.c_int64, ctypes.c_void_p), *2 * (ctypes.c_int64,), *4 * (ctypes.c_void_p,))
ROUNDING = 1e-7
"""Share of its size and its tolerance that a guard must change by to have changed."""
FAST = 10.0
"""m/s or rad/s; at the speeds from this to its opposite nothing may happen to what is left out."""
NEAR = 2.0
"""m or rad; what comes upon something within this way stays in."""
STEADY = 1e-3
"""Share of its error weight that a state of the component's own may change in a second and count as at rest."""


class Rider(NamedTuple):
    """A node that is carried: its group, the carrier's, the ratio of their speeds, the bond's law and its damping."""

    group: int
    by: int
    ratio: float
    law: int
    bond: float


class Carriage:
    """Finds what is carried in one System."""

    def __init__(self, system: System) -> None:
        """Look at the whole; nothing is evaluated yet."""
        self.system = system
        self.bonds = [b for b in system.blocks if b.kernel.variant.type.declaration.carries is not None]
        self._known: tuple[Influence, Guards] | None = None

    @property
    def count(self) -> int:
        """Nodes that are in the zone in which they are carried."""
        found = 0
        for block in self.bonds:
            says = block.kernel.variant.type.declaration.carries
            assert says is not None
            zone = block.kernel.structure.zones.index(says.zone)
            found += int(np.count_nonzero(self.system.zones[block.machines[:, 0]] == zone))
        return found

    def moving(self, t: float, y: Floats) -> Moving | None:
        """What is left of the unknowns at (t, y [n]) without what is carried; None if hardly less."""
        if not self.bonds:
            return None
        if self._known is None:
            self._known = influence(self.system), Guards(self.system)
        riders = self._riders(t, y)
        while len(riders) >= LEAST_CARRIED:
            found = _Look(self.system, *self._known, riders, t, y)
            hindered = found.hindered()
            if not hindered:
                return found.moving() if np.count_nonzero(found.kept) <= MOST * self.system.n else None
            riders = [rider for rider in riders if rider.group not in hindered]
        return None

    def _riders(self, t: float, y: Floats) -> list[Rider]:
        """Nodes that are carried now, but those that come off soon."""
        partials, guards = partials_at(self.system, t, y), guards_at(self.system, t, y)
        first_law = 0
        found: dict[int, list[tuple[float, Rider]]] = defaultdict(list)
        for block, share in zip(self.system.blocks, shares(self.system.blocks)[0], strict=True):
            s, says = block.kernel.structure, block.kernel.variant.type.declaration.carries
            if says is not None:
                zone = s.zones.index(says.zone)
                for i in np.flatnonzero(self.system.zones[block.machines[:, 0]] == zone).tolist():
                    d = partials[share.flows + i * len(s.d_flows) : share.flows + (i + 1) * len(s.d_flows)]
                    slopes = {(s.targets[k], s.inputs[j]): d[e] for e, (k, j) in enumerate(s.d_flows)}
                    own, other = (slopes[f"port:{says.node}", f"port:{port}:v"] for port in (says.node, says.by))
                    rider = self._rider(block.instances[i].path, says, -other / own, first_law + i, abs(own))
                    if rider is not None:
                        at = share.guards + i * s.slots
                        nearest = guards[at : at + len(s.guards[says.zone])].max()
                        found[rider.by].append((nearest, rider))
            first_law += block.count
        return [
            rider for of_one in found.values()
            for _, rider in sorted(of_one, key=lambda pair: pair[0])[: max(len(of_one) - KEPT_FREE, 0)]
        ]  # fmt: skip

    def _rider(self, path: str, says: Carries, ratio: float, law: int, bond: float) -> Rider | None:
        flat, numbering = self.system.flat, self.system.numbering
        group, of_node, _ = flat.place(PortRef(path, says.node))
        by, of_by, _ = flat.place(PortRef(path, says.by))
        if group == by or not flat.groups[group].free or group not in numbering.rate:
            return None
        if flat.groups[by].free and by not in numbering.rate:
            return None
        return Rider(group, by, ratio * of_by / of_node, law, bond * of_node**2)


class _Look:
    """One look at a System at (t, y) with some riders: what is left of it, and which laws say when that ends."""

    def __init__(
        self, system: System, found: Influence, guards: Guards, riders: list[Rider], t: float, y: Floats
    ) -> None:
        """Let go of more and more until nothing left out answers to anything that is not."""
        self.guards = guards
        self.system, self.riders, self.t, self.found = system, riders, t, found
        self.following = following(system, riders, t, y)
        self.y = aligned(system, self.following, t, y)
        self.law_of_guard, self.has_unknowns = laws_of_guards(system), laws_with_unknowns(system)
        may_rest, varies = self._may_rest(), np.zeros(len(found.restless), dtype=bool)
        here, self.z = partials_at(system, t, self.y), system.memory["z"].copy()
        while True:
            there = partials_at(system, t, self._jolted(may_rest))
            which = answers(found, [here, there], self.following.place, self.following.ratio)
            self.moves, self.laws = spread(found, which, self._moving(may_rest), may_rest, varies)
            fewer = may_rest & ~self.moves[: system.n]
            if (fewer == may_rest).all():
                self.kept = self._kept(may_rest)
                stays, self.watched = self._probed()
                if not (stays & ~varies).any():
                    break
                varies |= stays
            may_rest = fewer
        self.watched = np.union1d(self.watched, self._first_reached())
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
        sharing = {g for p in numbering.circles if kept[numbering.own[p.path, p.unknown]] for g, _ in p.ends}
        for group, share in numbering.share.items():
            kept[share] = group in sharing
        return kept

    def _probed(self) -> tuple[Booleans, Integers]:
        """By law that is left out: whether its guards say that it must stay; and those that say when that ends.

        It must stay if a guard answers to a signal or a state that varies, if one fires at other speeds, or within
        a short way. One that fires further on ends the part.
        """
        numbering, rides = self.system.numbering, self.following.unknowns
        position, rate = self._motions()
        now = self.guards.at(self.z)
        size = ROUNDING * (np.abs(now) + self.system.guard_tolerance)

        def probe(where: Integers, what: Floats | float) -> tuple[Booleans, Booleans]:
            z = self.z.copy()
            z[where] = what
            then = self.guards.at(z)
            return ~(np.abs(then - now) <= size), ~(then < 0)

        varies = self.moves[: numbering.first_reaction].copy()
        varies[: self.system.n] &= self.kept
        varies[[*position, *rate]] = False
        others = np.flatnonzero(varies)
        stays = np.zeros(len(now), dtype=bool)
        for jolt in (JOLT, 1.0, FAR, -FAR):
            stays |= probe(others, self.z[others] + jolt * (1.0 + np.abs(self.z[others])))[0]
        speeds, ratio = np.concatenate([rate, rides[len(self.riders) :]]), np.ones(len(self.z))
        ratio[rides] = self.following.ratio[rides]
        for speed in (-FAST, 0.0, FAST):
            changes, fires = probe(speeds, speed * ratio[speeds])
            stays |= changes & fires
        watched = np.zeros_like(stays)
        for way in (-NEAR, NEAR):
            changes, fires = probe(position, self.z[position] + way)
            stays |= changes & fires
            watched |= changes
        left_out = ~self.laws[self.law_of_guard]
        watches, must = self._laws_of(watched & left_out), self._laws_of(stays & left_out)
        return must | (watches & self.has_unknowns), np.flatnonzero(watches)

    def _motions(self) -> tuple[Integers, Integers]:
        """Where in z positions and rates stand that stay unknowns, or are prescribed."""
        numbering, signals = self.system.numbering, self.system.numbering.signals
        pairs = [(x, v) for x, v in numbering.pairs if self.kept[x] and self.kept[v]]
        for group in self.system.flat.groups:
            if group.prescribed is not None and group.prescribed.outputs is not None:
                x, v, _ = (signals[PortRef(group.prescribed.by.instance, name)] for name in group.prescribed.outputs)
                pairs.append((self.system.n + x, self.system.n + v))
        made = np.array(pairs, dtype=np.int64).reshape(-1, 2)
        return made[:, 0], made[:, 1]

    def _laws_of(self, guards: Booleans) -> Booleans:
        made = np.zeros(len(self.laws), dtype=bool)
        made[self.law_of_guard[guards]] = True
        return made

    def _first_reached(self) -> Integers:
        """Of the laws left out those that would be the first to change, forward and backward, by every carrier."""
        system, numbering = self.system, self.system.numbering
        ridden, law, by = self.z.copy(), self.law_of_guard, self._carrier_of_law()
        for rider in {rider.by: rider for rider in self.riders}.values():
            place, coef, _ = place_of_motion(system.flat, numbering, rider.by, 1.0, 0.0, "x")
            ridden[place] += coef * TRAVEL / rider.ratio
        ridden[self.following.unknowns[: len(self.riders)]] += TRAVEL
        now, after = self.guards.at(self.z), self.guards.at(ridden)
        reached = (np.abs(after - now) > ROUNDING * (np.abs(now) + system.guard_tolerance)) & ~self.laws[law]
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

    def hindered(self) -> set[int]:
        """Groups that cannot be left out: a contact of a circle that stays holds them."""
        numbering = self.system.numbering
        return {
            group for pair in numbering.circles if self.kept[numbering.own[pair.path, pair.unknown]]
            for group, _ in pair.ends if group in self.following.groups
        }  # fmt: skip

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


def following(system: System, riders: list[Rider], t: float, y: Floats) -> Following:
    """What stands where for what is carried at (t, y [n])."""
    numbering, flat = system.numbering, system.flat
    call(system, "rhs", t, y, np.zeros(system.n))
    z = system.memory["z"]
    place, ratio, offset = np.arange(len(z)), np.ones(len(z)), np.zeros(len(z))
    row, share = np.arange(numbering.w_dump + 1), np.ones(numbering.w_dump + 1)
    masses: dict[int, float] = defaultdict(float)
    for rider in riders:
        x, v = numbering.position[rider.group], numbering.rate[rider.group]
        for own, variable in ((x, "x"), (v, "v"), (numbering.acceleration + v, "a")):
            at, coef, _ = place_of_motion(flat, numbering, rider.by, 1.0, 0.0, variable)
            place[own], ratio[own] = at, rider.ratio * coef
        offset[x] = y[x] - ratio[x] * z[place[x]]
        free = flat.groups[rider.by].free
        row[v] = numbering.balance[rider.by] if free else system.n + numbering.reactions[rider.by]
        row[x], share[v] = numbering.w_dump, rider.ratio if free else -rider.ratio
        masses[rider.by] += rider.ratio**2 * flat.groups[rider.group].mass
    groups = [rider.group for rider in riders]
    unknowns = np.array([*(numbering.position[g] for g in groups), *(numbering.rate[g] for g in groups)])
    mass = np.array([flat.groups[group].mass for group in groups])
    bond = np.array([rider.bond for rider in riders])
    return Following(
        place, ratio, offset, row, share, unknowns, mass, bond, dict(masses), frozenset(groups)
    )  # fmt: skip


def partials_at(system: System, t: float, y: Floats) -> Floats:
    """All partial derivatives of laws at (t, y)."""
    call(system, "jacobian", t, y, np.zeros(len(system.pattern.rows)), np.zeros(system.n))
    return system.memory["partials"].copy()


def guards_at(system: System, t: float, y: Floats) -> Floats:
    """All guards at (t, y)."""
    made = np.zeros(len(system.guard_tolerance))
    call(system, "guards", t, y, made)
    return made


class Guards:
    """All guards for what stands in z, be it consistent or not; those of circles are not among them."""

    def __init__(self, system: System) -> None:
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


def laws_of_guards(system: System) -> Integers:
    """By guard: its law, counted over all blocks."""
    made, start = [], 0
    for block in system.blocks:
        made.append(np.repeat(start + np.arange(block.count), block.kernel.structure.slots))
        start += block.count
    return np.concatenate(made)


def laws_with_unknowns(system: System) -> Booleans:
    """By law, counted over all blocks: whether it has unknowns of its own."""
    owns = [any(t.startswith("own:") for t in block.kernel.structure.targets) for block in system.blocks]
    return np.repeat(owns, [block.count for block in system.blocks])
