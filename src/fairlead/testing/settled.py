"""Random instants in the zones that the guards lead to: found once, asked by several properties of a law."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from fairlead.testing.world import CircleError, Instant, World


class Settled:
    """Instances of one form of a law, instants of each, and where each zone leads to there, found when first asked for.

    An instance has random numbers of its own, so that who asks for fewer is given the first of them.
    """

    def __init__(self, make: Callable[[np.random.Generator], World], seed: tuple[int, ...]) -> None:
        """`make` an instance of the form with random numbers."""
        self._make, self._seed = make, seed
        self._instances: list[tuple[World, np.random.Generator, list[Instant]]] = []
        self._ends: dict[tuple[int, int, str], Instant | CircleError] = {}

    def __call__(self, instances: int, instants: int) -> Iterator[tuple[World, Instant | CircleError]]:
        """From every zone at each of so many instants of so many instances: the end, or the circle that there is."""
        for k in range(instances):
            if k == len(self._instances):
                rng = np.random.default_rng((*self._seed, k))
                self._instances.append((self._make(rng), rng, []))
            world, rng, drawn = self._instances[k]
            for j in range(instants):
                if j == len(drawn):
                    drawn.append(in_pieces(world, world.draw(rng), rng))
                for zone in world.structure.zones:
                    yield world, self._end(k, j, zone)

    def _end(self, k: int, j: int, zone: str) -> Instant | CircleError:
        found = self._ends.get((k, j, zone))
        if found is None:
            world, _, drawn = self._instances[k]
            try:
                found = world.settle(drawn[j], zone)
            except CircleError as circle:
                found = circle
            self._ends[k, j, zone] = found
        return found


@dataclass(frozen=True)
class Maker:
    """Makes random instances of one form of a law, with the random numbers of one property; `settled` has its own."""

    make: Callable[[np.random.Generator], World]
    rng: np.random.Generator
    settled: Settled

    def __call__(self) -> World:
        """One more instance."""
        return self.make(self.rng)


def in_pieces(world: World, at: Instant, rng: np.random.Generator) -> Instant:
    """Tables of time in the piece that holds; others anywhere, their guards lead to the right one."""
    s, zones = world.structure, list(at.zones)
    first = s.machines - len(s.tables)
    for k, name in enumerate(s.tables):
        table: Any = world.rig.pieces[0][k]
        usable = np.flatnonzero(np.isfinite(table.rows).all(axis=1))  # others end a run
        zones[first + k] = table.piece_at(at.values["t"]) if name in s.time_tables else int(rng.choice(usable))
    return at.but(zones)
