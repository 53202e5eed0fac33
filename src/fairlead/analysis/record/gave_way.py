"""Held contacts that reached stiction while others kept their two sides together: a sentence on what that leaves open.

Rigid contacts side by side leave open how they share a load; they share it by least squares, as equally stiff ones do.
One whose share comes to its stiction first falls to sliding friction without moving, and the others carry the rest.
Had it held until all had come to theirs, they would carry more. What real contacts do depends on how stiff they are.
The same holds where the others cannot carry the rest and let go at the same instant, so that the body moves: told is
then the first, unless the load may have jumped there to what none of them bears.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.record.chattering import MOST_NAMED
from fairlead.kernels.break_away import least_left
from fairlead.system.arrays.timing import tables
from fairlead.system.compiled.system import System
from fairlead.system.numbering.contact_cycles import AGREES, REST, HeldPair

MOST_TOLD = 20
ROUNDING = 1e-9
"""Share of the time within which two instants are one."""


class _Contact(NamedTuple):
    """A contact that may close a circle."""

    pair: HeldPair
    holding: frozenset[int]
    """Zones in which it holds."""
    left: float
    """Share of friction that is left when it lets go; 1 where it goes over without a jump."""
    keeps: frozenset[int]
    """Zones in which it lets go with all its stiction, until it has moved (karnopp)."""


@dataclass
class GaveWay:
    """Watches the zone changes of a run."""

    system: System
    start: float = 0.0
    """When the run begins, and samples are first taken [s]."""
    count: int = 0
    first: list[dict[str, Any]] = field(default_factory=list)
    _t: float = -np.inf
    _let_go: set[int] = field(default_factory=set)
    _sudden: bool = False
    """Whether a load may have jumped at this instant, or anything else came first."""
    _first: list[int] = field(default_factory=list)
    """Contacts that let go at their limits in the first pass of an instant."""
    _held: frozenset[int] = frozenset()
    """Those that held after that pass."""

    @functools.cached_property
    def _contacts(self) -> dict[int, _Contact]:
        """By machine; empty where none of them has a friction that falls."""
        pairs = {pair.path: pair for pair in self.system.numbering.circles}
        found = {
            int(machines[0]): _Contact(pairs[instance.path], _holding(s, pairs[instance.path].unknown),
                                       least_left(s.shares_left, instance.values),
                                       frozenset(map(s.zones.index, instance.type.declaration.zones.latched)))
            for block in self.system.blocks if pairs and len((s := block.kernel.structure).zones) > 1
            for instance, machines in zip(block.instances, block.machines, strict=True) if instance.path in pairs
        }  # fmt: skip
        return found if any(one.left < 1.0 for one in found.values()) else {}

    @functools.cached_property
    def _zones(self) -> dict[int, int]:
        return {machine: int(self.system.zones[machine]) for machine in self._contacts}

    def watch(self, events: NDArray[Any]) -> None:
        """Take zone changes, dtype EVENT, in the order of time."""
        if not self._contacts or not len(events):
            return
        mine = np.isin(events["machine"], list(self._contacts))
        near = np.isin(events["t"], events["t"][mine])
        for row, is_one in zip(events[near], mine[near].tolist(), strict=True):
            t, machine = float(row["t"]), int(row["machine"])
            if t > self._t:
                self.finish()
                self._t, self._sudden, self._first, self._held = t, self._may_jump(t), [], frozenset()
            self._note_first(row, mine=is_one)
            if not is_one:
                continue
            contact = self._contacts[machine]
            if int(row["before"]) in contact.holding and contact.left < 1.0:
                self._let_go.add(machine)
            self._zones[machine] = int(row["after"])

    @functools.cached_property
    def _corners(self) -> NDArray[np.float64]:
        """Instants at which a piece of what is given in time, with jumps, begins."""
        found = [table.polynomial.left for table in tables(self.system.blocks)
                 if table.timed and not table.polynomial.is_continuous]  # fmt: skip
        return np.unique(np.concatenate([*found, np.zeros(0)]))

    def _may_jump(self, t: float) -> bool:
        """Whether a load may jump at an instant: where a piece begins, or a sample is taken."""
        little, period = ROUNDING * max(1.0, abs(t)), np.unique(self.system.memory["sample_period"])
        samples = self.start + period * np.round((t - self.start) / np.maximum(period, little))
        return bool((np.abs(np.concatenate([self._corners, samples]) - t) <= little).any())

    def _note_first(self, row: Any, *, mine: bool) -> None:
        """Keep who lets go in the first pass of an instant, and who holds then."""
        machine, guard = int(row["machine"]), int(row["guard"])
        at_limit = guard >= 0 and self.system.limit_guard[guard] == 1
        if guard < 0 or (row["position"] == 0 and not (mine and at_limit)):
            self._sudden = True
        elif row["position"] == 0:
            self._first.append(machine)
        elif self._first and not self._held:
            self._held = frozenset(m for m, one in self._contacts.items() if self._zones[m] in one.holding)

    def finish(self) -> None:
        """Judge the changes of the last instant: no more of them follow."""
        let_go = [m for m in sorted(self._let_go)
                  if self._zones[m] not in self._contacts[m].holding | self._contacts[m].keeps]  # fmt: skip
        self._let_go = set()
        if not let_go:
            return
        held = _Unions(one.pair for m, one in self._contacts.items() if self._zones[m] in one.holding)
        before = _Unions(self._contacts[m].pair for m in sorted(self._held)) if not self._sudden else None
        for machine in let_go:
            pair = self._contacts[machine].pair
            if held.keep_together(pair):
                self._tell(machine, moved=False)
            elif before is not None and machine in self._first and before.keep_together(pair):
                self._tell(machine, moved=True)

    def _tell(self, machine: int, *, moved: bool) -> None:
        self.count += 1
        if len(self.first) < MOST_TOLD:
            name, left = self.system.machine_names[machine], self._contacts[machine].left
            self.first.append({"t": self._t, "contact": name, "left": left, "moved": moved})

    def plain(self) -> dict[str, Any]:
        """For run.json: how often, and the first of them.

        Each with `t` [s], `contact`, the share of friction `left` to it, and whether it `moved`.
        """
        return {"count": self.count, "first": self.first}

    def remarks(self) -> list[str]:
        """A sentence on them and the way out; none where none gave way."""
        if not self.count:
            return []
        names = list(dict.fromkeys(one["contact"] for one in self.first))
        one = self.first[0]
        more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
        when = f"(first {one['contact']} at t = {one['t']:.6g} s)"
        who = f"{', '.join(names[:MOST_NAMED])}{more} came to stiction {when}"
        fell = f"and fell to {100 * one['left']:.3g} % of it"
        then = f"{fell} without moving"
        if one["moved"]:
            then = f"{fell}; they could not carry the rest, and let go with it"
        return [
            f"{who} while other contacts held both its sides together, {then}: rigid contacts side by side share a "
            "load as equally stiff ones do, and others may let go later. If it matters, make them one contact with the "
            "sum of their friction, or give each its stiffness (method: lugre, or a spring between)."
        ]


def _holding(structure: Any, unknown: str) -> frozenset[int]:
    return frozenset(structure.zones.index(zone) for zone in structure.holds[unknown])


class _Unions:
    """Bodies that contacts hold together, with their speeds in terms of each other (union-find)."""

    def __init__(self, pairs: Iterable[HeldPair]) -> None:
        self.above: dict[int, tuple[int, float]] = {}  # of a body: one above it, its own speed over that of the other
        self.rest = {REST}
        for pair in pairs:
            (one, slip_one), (other, slip_other) = (self._top(*end) for end in pair.ends)
            if one == other:
                if not _agree(slip_one, slip_other):
                    self.rest.add(one)
                continue
            if other in self.rest:
                (one, slip_one), (other, slip_other) = (other, slip_other), (one, slip_one)
            self.above[other] = one, -slip_one / slip_other

    def keep_together(self, pair: HeldPair) -> bool:
        """Whether the two sides of a contact cannot slip."""
        (one, slip_one), (other, slip_other) = (self._top(*end) for end in pair.ends)
        return {one, other} <= self.rest or (one == other and _agree(slip_one, slip_other))

    def _top(self, node: int, slip: float) -> tuple[int, float]:
        """The body at the top, and the slip by its speed."""
        while node in self.above:
            node, ratio = self.above[node]
            slip *= ratio
        return node, slip


def _agree(slip: float, other: float) -> bool:
    return abs(slip + other) <= AGREES * (abs(slip) + abs(other))


def rows_of_table(found: Mapping[str, Any] | None) -> list[tuple[str, str]]:
    """(what, value) for the closing table of a run; nothing where none gave way."""
    if not found or not found["count"]:
        return []
    one = found["first"][0]
    what = "gave way" if one.get("moved") else "gave way in place"
    return [(what, f"{one['contact']} at t = {one['t']:.6g} s, {found['count']} in all")]
