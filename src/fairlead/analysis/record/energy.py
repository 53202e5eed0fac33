"""Does the energy add up? The ledger of a run, integrated with it.

    closure = |stored change + dissipated - supplied| / throughput

Throughput is what the model has dealt with: the largest of supplied, dissipated and stored energy at any time.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

MOST_NAMED = 3
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


def judged(summary: dict[str, float | None], undeclared: list[str]) -> dict[str, Any]:
    """The summary; without a closure, and with their names, where components declare no energy of what they do."""
    return {**summary, "closure": None, "undeclared": undeclared} if undeclared else dict(summary)


def unjudged(energy: Mapping[str, Any] | None) -> str:
    """What to say of components that declare no energy; nothing where there are none."""
    names = (energy or {}).get("undeclared") or []
    if not names:
        return ""
    few = ", ".join(names[:MOST_NAMED]) + (f" and {len(names) - MOST_NAMED} more" if len(names) > MOST_NAMED else "")
    return (
        f"{few}: the class declares no energy of the forces it gives, so whether the energy adds up is not judged. "
        "Let its law say what becomes of it: Law(..., stored=... J) or Law(..., dissipated=... W, supplied=... W)."
    )
