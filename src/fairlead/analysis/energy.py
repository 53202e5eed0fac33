"""Does the energy add up? The ledger of a run, integrated with it.

    closure = |stored change + dissipated - supplied| / throughput

Throughput is what the model has dealt with: the largest of supplied, dissipated and stored energy at any time.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

NOTHING = 1e-20
"""Throughput [J] below which nothing has passed: the thermal motion of one particle is as much (Boltzmann's k T)."""


@dataclass
class Ledger:
    """Watches the stored energy and the two integrals [J] as a run records them."""

    first: NDArray[np.float64] | None = None  # dissipated, supplied, stored
    last: NDArray[np.float64] | None = None
    most: float = 0.0

    def watch(self, rows: NDArray[np.float64]) -> None:
        """Take recorded rows (k, 3): dissipated, supplied, stored."""
        if not len(rows):
            return
        if self.first is None:
            self.first = rows[0].copy()
        self.last = rows[-1].copy()
        for sizes in (np.abs(rows - self.first), np.abs(rows[:, 2])):
            self.most = max(self.most, float(np.fmax.reduce(sizes, axis=None)))  # what is no number says nothing

    def summary(self) -> dict[str, float | None]:
        """For run.json; closure is None when nothing passed through."""
        if self.first is None or self.last is None:
            return {"closure": None}
        dissipated, supplied, stored = (float(x) for x in self.last - self.first)
        missing = abs(stored + dissipated - supplied)
        return {
            "closure": missing / self.most if self.most > NOTHING else None,
            "supplied": supplied, "dissipated": dissipated, "stored_change": stored,
        }  # fmt: skip
