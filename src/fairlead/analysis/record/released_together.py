"""Held contacts that came to their limits together, where one that lets go changes what the others carry.

They let go together, because nothing tells which of them is the first; had one been, its friction would have fallen and
others might hold. Told are contacts whose friction falls, that let go in one pass of a settlement and hang together: by
bodies with mass, and by contacts that hold or may hold there.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.system.compiled.system import System

MOST_TOLD, MOST_NAMED = 20, 10


@dataclass
class ReleasedTogether:
    """Watches the zone changes of a run."""

    system: System
    count: int = 0
    first: list[dict[str, Any]] = field(default_factory=list)

    def watch(self, events: NDArray[Any]) -> None:
        """Take zone changes, dtype EVENT; those of one pass come together."""
        some = events[(events["guard"] >= 0) & (events["before"] != events["after"])]
        some = some[(self.system.limit_guard[some["guard"]] == 1) & (self.system.falls[some["machine"]] == 1)]
        if not ((some["t"][1:] == some["t"][:-1]) & (some["position"][1:] == some["position"][:-1])).any():
            return
        keys = np.column_stack([some["t"], some["position"], self._together[some["machine"]]])
        _, first, which, sizes = np.unique(keys, axis=0, return_index=True, return_inverse=True, return_counts=True)
        for k in np.argsort(first, kind="stable").tolist():
            if sizes[k] > 1:
                self._tell(some[which.ravel() == k])

    def _tell(self, some: NDArray[Any]) -> None:
        self.count += 1
        if len(self.first) < MOST_TOLD:
            names = [self.system.machine_names[m] for m in some["machine"].tolist()]
            self.first.append({"t": float(some["t"][0]), "contacts": names[:MOST_NAMED], "of": len(names)})

    @functools.cached_property
    def _together(self) -> NDArray[np.int64]:
        """By machine: equal for contacts that hang together by bodies with mass and other contacts."""
        from scipy.sparse import coo_array
        from scipy.sparse.csgraph import connected_components

        system = self.system
        columns = np.repeat(np.arange(system.n), np.diff(system.mass_pattern.starts))
        ties = system.holder[system.mass_pattern.rows] >= 0
        row, column = system.mass_pattern.rows[ties], columns[ties]
        _, label = connected_components(coo_array((np.ones(len(row)), (row, column)), shape=(system.n, system.n)))
        made = np.full(len(system.zones), -1, dtype=np.int64)
        holds = np.flatnonzero(system.holder >= 0)
        made[system.holder[holds]] = label[holds]
        return made

    def plain(self) -> dict[str, Any]:
        """For run.json: how often, and the first of them: `t` [s], `contacts` by name, `of` how many."""
        return {"count": self.count, "first": self.first}
