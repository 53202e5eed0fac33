"""A part of a System that an engine works on, and what it gives back to the whole."""

from __future__ import annotations

import dataclasses

from fairlead.system.asking import call
from fairlead.system.driver import SPREAD
from fairlead.system.entrained import Entrained
from fairlead.system.rest import Floats, Integers
from fairlead.system.system import Instance


@dataclasses.dataclass(frozen=True)
class Part:
    """What moves, and where it lies in the whole."""

    problem: Instance
    unknowns: Integers
    machines: Integers
    guards: Integers
    rim: Integers
    """By machine of the part: 1 if its change ends what is true of the part."""
    whole: Instance
    carried: Entrained

    @property
    def sure(self) -> bool:
        """True if what is left out cannot move by itself, however little the run has shown."""
        return bool(len(self.carried.unknowns))

    def give_back(self, t: float, y: Floats) -> None:
        """Give the whole, whose unknowns are y [n], what is entrained at t, and what its controllers know."""
        call(self.problem, SPREAD, t, y[self.unknowns], y)
        hand_over(self.problem, self.whole)

    def carry(self, of_unknowns: Floats) -> None:
        """Give what is entrained the share of its carrier in numbers by unknown of the whole, such as slopes."""
        u, what = self.carried.unknowns, self.carried
        own = what.place[u] < self.whole.n
        of_unknowns[u[own]] = what.ratio[u[own]] * of_unknowns[what.place[u[own]]]


def hand_over(one: Instance, other: Instance) -> None:
    """Give another System of the same sampled instances what they know: counts of samples, objects in Python."""
    for name in ("sample_count", "sample_start"):
        other.memory[name][:] = one.memory[name]
    for mine, its in zip(one.controllers, other.controllers, strict=True):
        its.take_over(mine)
