"""What of a System moves: what is kept of it, what changes end that, and what is carried along."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from fairlead.system.rest import Booleans, Floats, Integers
from fairlead.system.system import System


class Rider(NamedTuple):
    """A node that is carried: its group, the carrier's, the ratio of their speeds, the bond's law and its damping."""

    group: int
    by: int
    ratio: float
    law: int
    bond: float


class Following(NamedTuple):
    """What is carried, see carried.py: by place in z and by row of w what stands for it, how much of it.

    z[i] = ratio z[place] + offset;  what would be added to w[i] is added, `share` times, to w[row]
    """

    place: Integers
    ratio: Floats
    offset: Floats
    row: Integers
    share: Floats
    unknowns: Integers
    """Positions that are carried, then their rates."""
    mass: Floats
    """By node that is carried: its own inertia."""
    bond: Floats
    """Likewise: how strongly it is tied, force over slip."""
    masses: dict[int, float]
    """By group: the inertia that it carries."""
    groups: frozenset[int]

    def added_up(self, w: Floats) -> Floats:
        """Rows of w with those of what is carried added to what carries it."""
        rates, made = self.unknowns[len(self.mass) :], w.copy()
        np.add.at(made, self.row[rates], self.share[rates] * w[rates])
        return made


class Moving(NamedTuple):
    """What moves and a margin around it."""

    kept: Booleans
    """By unknown."""
    laws: list[Booleans]
    """By block: its instances that have to do with what is kept."""
    watched: list[Booleans]
    """By block: those that only say when what is left out no longer can be."""
    machines: Integers
    """Theirs."""
    rim: Booleans
    """By machine of the whole: its change may set in motion what is not kept."""
    carried: Following

    @property
    def sure(self) -> bool:
        """True if what is left out cannot move by itself, however little the run has shown yet."""
        return bool(len(self.carried.unknowns))


def nothing_carried(system: System) -> Following:
    """Every place stands for itself."""
    places, rows = system.numbering.dump + 1, system.numbering.w_dump + 1
    return Following(
        np.arange(places), np.ones(places), np.zeros(places), np.arange(rows), np.ones(rows),
        np.zeros(0, np.int64), np.zeros(0), np.zeros(0), {}, frozenset(),
    )  # fmt: skip
