"""Held contacts that reached stiction while others kept their two sides together: a sentence on what that leaves open.

Rigid contacts side by side leave open how they share a load; they share it by least squares, as equally stiff ones do.
One whose share comes to its stiction first falls to sliding friction without moving, and the others carry the rest.
Had it held until all had come to theirs, they would carry more. What real contacts do depends on how stiff they are.
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
from fairlead.system.compiled.system import System
from fairlead.system.numbering.contact_cycles import AGREES, REST, HeldPair

MOST_TOLD = 20


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
    count: int = 0
    first: list[dict[str, Any]] = field(default_factory=list)
    _t: float = -np.inf
    _let_go: set[int] = field(default_factory=set)

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
        for row in events[np.isin(events["machine"], list(self._contacts))]:
            t, machine = float(row["t"]), int(row["machine"])
            if t > self._t:
                self.finish()
                self._t = t
            contact = self._contacts[machine]
            if int(row["before"]) in contact.holding and contact.left < 1.0:
                self._let_go.add(machine)
            self._zones[machine] = int(row["after"])

    def finish(self) -> None:
        """Judge the changes of the last instant: no more of them follow."""
        let_go = [m for m in sorted(self._let_go)
                  if self._zones[m] not in self._contacts[m].holding | self._contacts[m].keeps]  # fmt: skip
        self._let_go = set()
        if not let_go:
            return
        held = _Unions(one.pair for m, one in self._contacts.items() if self._zones[m] in one.holding)
        for machine in let_go:
            contact = self._contacts[machine]
            if held.keep_together(contact.pair):
                self.count += 1
                if len(self.first) < MOST_TOLD:
                    name = self.system.machine_names[machine]
                    self.first.append({"t": self._t, "contact": name, "left": contact.left})

    def plain(self) -> dict[str, Any]:
        """For run.json: how often, and the first of them: `t` [s], `contact`, the share of friction `left` to it."""
        return {"count": self.count, "first": self.first}

    def remarks(self) -> list[str]:
        """A sentence on them and the way out; none where none gave way."""
        if not self.count:
            return []
        names = list(dict.fromkeys(one["contact"] for one in self.first))
        one = self.first[0]
        more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
        who = f"{', '.join(names[:MOST_NAMED])}{more} came to stiction (first {one['contact']} at t = {one['t']:.6g} s)"
        return [
            f"{who} while other contacts held both its sides together, and fell to {100 * one['left']:.3g} % of it "
            "without moving: rigid contacts side by side share a load as equally stiff ones do, and others may let go "
            "later. If it matters, make them one contact with the sum of their friction, or give each its stiffness "
            "(method: lugre, or a spring between)."
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
    return [("gave way in place", f"{one['contact']} at t = {one['t']:.6g} s, {found['count']} in all")]
