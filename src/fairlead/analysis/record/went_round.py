"""Contacts whose order of release went in a circle at one instant: a sentence on what that leaves open.

Where friction falls as contacts let go, and they close a circle, the order in which a fast ramp of the load would
release them may not come to an end (docs/integrator.md, "Order of release"). All that are beyond their limits then let
go at once. That is one outcome; a ramp, however fast, may lead to another.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.record.chattering import MOST_NAMED
from fairlead.system.compiled.system import System

ROUNDS = 16
"""Changes of zone of one contact at one instant that are a circle: an order that ends takes two or three of each."""
MOST_TOLD = 20


@dataclass
class WentRound:
    """Watches the zone changes of a run."""

    system: System
    count: int = 0
    first: list[dict[str, Any]] = field(default_factory=list)
    _t: float = -np.inf
    _changes: Counter[int] = field(default_factory=Counter)

    def watch(self, events: NDArray[Any]) -> None:
        """Take zone changes, dtype EVENT, in the order of time."""
        falls = self.system.falls
        if not np.any(falls):
            return
        for t, machine in zip(events["t"].tolist(), events["machine"].tolist(), strict=True):
            if t > self._t:
                self.finish()
                self._t = t
            if machine >= 0 and falls[machine] == 1:
                self._changes[machine] += 1

    def finish(self) -> None:
        """Judge the changes of the last instant: no more of them follow."""
        round_and_round = sorted(m for m, times in self._changes.items() if times >= ROUNDS)
        self._changes = Counter()
        if not round_and_round:
            return
        self.count += 1
        if len(self.first) < MOST_TOLD:
            names = [self.system.machine_names[m] for m in round_and_round]
            self.first.append({"t": self._t, "contacts": names})

    def plain(self) -> dict[str, Any]:
        """For run.json: at how many instants, and the first of them, each with `t` [s] and the names of `contacts`."""
        return {"count": self.count, "first": self.first}

    def remarks(self) -> list[str]:
        """A sentence on the first and the way out; none where every order came to an end."""
        if not self.count:
            return []
        one = self.first[0]
        names = one["contacts"]
        more = f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else ""
        times = f" (and at {self.count - 1} other instants)" if self.count > 1 else ""
        return [
            f"At t = {one['t']:.6g} s{times} the order in which contacts let go came to no end "
            f"({', '.join(names[:MOST_NAMED])}{more} among them): their friction falls as they let go, and they close "
            "a circle. All that were beyond their limits let go at once, and a load that jumps less suddenly may lead "
            "to another outcome. If it matters, give the load a short ramp, or take a law with a stiffness of its own "
            "(method: lugre, or binding)."
        ]
