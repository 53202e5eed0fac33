"""Contacts that stayed open all through a run although a signal pressed them: their `lift` was above all of it.

A contact is open below a normal force `lift`, 1 uN where nobody gives it. That is nothing in a machine, and much in a
scene of milligrams. A normal force that is given as a number makes it smaller; a signal cannot.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.kernels.structure import Structure
from fairlead.system.arrays.pressing import Pressed, pressed
from fairlead.system.arrays.recording import OutputSignal
from fairlead.system.compiled.system import System

OPEN = "off"
NO_LOAD = 1e-6
"""Of `lift`; a smaller normal force is taken for rounding."""
MOST_TOLD = 5
Floats = NDArray[np.float64]


@dataclass
class NeverClosed:
    """Watches m contacts, whose normal forces are in columns `columns` of the rows of a run."""

    contacts: Sequence[Pressed]
    columns: NDArray[np.int64]
    machines: NDArray[np.int64]
    open_: NDArray[np.int64]
    """[m]: the number of the zone in which each is open."""
    start: float
    closed: NDArray[np.bool_] = field(init=False)
    """[m]: whether it was in another zone, but for those of the start that no time passes in."""
    most: Floats = field(init=False)
    """[m]: its largest normal force so far."""

    def __post_init__(self) -> None:
        """Nothing seen yet."""
        self.closed, self.most = np.ones(len(self.contacts), dtype=bool), np.zeros(len(self.contacts))

    @classmethod
    def of(cls, system: System, recorded: Sequence[OutputSignal], start: float) -> NeverClosed:
        """Those of a System, and where the forces are among the recorded signals."""
        contacts = {one.path: one for one in pressed(system.flat)}
        columns = {signal.name: k for k, signal in enumerate(recorded)}
        rows = [
            (contacts[i.path], columns[contacts[i.path].signal], int(machines[0]), s.zones.index(OPEN))
            for block in system.blocks if contacts and _opens(s := block.kernel.structure)
            for i, machines in zip(block.instances, block.machines, strict=True)
            if i.path in contacts and contacts[i.path].signal in columns
        ]  # fmt: skip
        table = np.array([row[1:] for row in rows], dtype=np.int64).reshape(-1, 3)
        at, machines, open_ = table.T
        return cls([row[0] for row in rows], at, machines, open_, start)

    def watch(self, rows: Floats, events: NDArray[Any]) -> None:
        """Take recorded rows, shape (k, recorded), and the zone changes among them."""
        if not len(self.contacts) or not len(rows):
            return
        np.maximum(self.most, np.nanmax(rows[:, self.columns], axis=0, initial=0.0), out=self.most)
        for row in events[np.isin(events["machine"], self.machines)]:
            k = int(np.flatnonzero(self.machines == row["machine"])[0])
            opened = bool(row["after"] == self.open_[k])
            self.closed[k] = not opened if row["t"] <= self.start else True

    def remarks(self) -> list[str]:
        """A sentence on each that was never closed, and the way out."""
        found = [
            f"{one.path} was never closed although its normal force was above zero, up to {most:.3g} N: it is open "
            f"below lift = {one.lift:.3g} N. Give it a `lift` far below that force."
            for one, most, closed in zip(self.contacts, self.most.tolist(), self.closed.tolist(), strict=True)
            if not closed and NO_LOAD * one.lift < most < one.lift
        ]
        more = [f"{len(found) - MOST_TOLD} more contacts were never closed."] if len(found) > MOST_TOLD else []
        return found[:MOST_TOLD] + more


def _opens(s: Structure) -> bool:
    return len(s.zones) > 1 and OPEN in s.zones
