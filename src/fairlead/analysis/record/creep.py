"""The fastest slip of a contact that should have been stuck."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass
class WorstCreep:
    """Watches the creep of every contact [m/s] as a run records it."""

    names: Sequence[str]
    worst: NDArray[np.float64] = field(init=False)
    at: NDArray[np.float64] = field(init=False)

    def __post_init__(self) -> None:
        """Nothing seen yet."""
        self.worst = np.zeros(len(self.names))
        self.at = np.zeros(len(self.names))

    def watch(self, t: NDArray[np.float64], rows: NDArray[np.float64]) -> None:
        """Take recorded rows (k, contacts) of slip speeds, zero where a contact is not stuck."""
        if not rows.size:
            return
        speed = np.abs(rows)
        speed[np.isnan(speed)] = 0.0  # says nothing, and must not hide the rows handed over with it
        k = speed.argmax(axis=0)
        now = speed[k, np.arange(len(k))]
        higher = now > self.worst
        self.worst[higher], self.at[higher] = now[higher], t[k[higher]]

    def summary(self) -> dict[str, Any] | None:
        """The worst contact for run.json; None without contacts."""
        if not len(self.worst):
            return None
        k = int(self.worst.argmax())
        return {
            "value": float(self.worst[k]),
            "contact": self.names[k].rpartition(".")[0],
            "t": float(self.at[k]),
        }
