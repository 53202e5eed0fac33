"""Symmetry: bodies that are mirror images of each other, or equal, move so.

It sees decisions that hang on order or rounding, ties of which one side is let go and the other kept. It cannot see
what is wrong on both sides alike.
"""

from __future__ import annotations

import numpy as np

from tests.scenes.observed import Observed
from tests.scenes.ties import Twins

PER_ACCURACY = 30.0


def symmetry(run: Observed, twins: Twins) -> str:
    """Which twins part; nothing if none do."""
    for one, (other, sign) in twins.items():
        for end in ("v", "speed"):
            if f"{one}.{end}" not in run.columns:
                continue
            a, b = run.columns[f"{one}.{end}"], sign * run.columns[f"{other}.{end}"]
            off = np.abs(a - b)
            size = run.size(f"{one}.{end}")
            if off.max() > PER_ACCURACY * run.accuracy * size:
                at = run.t[int(np.argmax(off > PER_ACCURACY * run.accuracy * size))]
                return f"symmetry: {one} and {other} differ by {off.max():.2g} of {size:.2g}, from {at:.4g} s on"
    return ""
