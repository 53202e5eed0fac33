"""Ramps: a load that jumps changes the speeds as loads do that rise in 10 and 1 us and are met contact by contact.

It sees the wrong contacts let go, or held, at a jump. It cannot see what goes wrong at a ramp as well, nor where the
two ramps themselves disagree: such a scene is set aside. Stacks, trees and rings of tests/scenes/jumps.py.
"""

from __future__ import annotations

import numpy as np

from tests.scenes.jumps import AT
from tests.scenes.observed import Observed


def changes(run: Observed) -> np.ndarray:
    """By how much the load changes the speeds of the bodies."""
    before = max(0, int(np.searchsorted(run.t, AT - 1e-9)) - 1)
    speeds = sorted(name for name in run.columns if name.endswith(".v"))
    return np.array([run.columns[name][-1] - run.columns[name][before] for name in speeds])


def ramps(run: Observed, slow: Observed, fast: Observed) -> str | None:
    """What is wrong with a jump; nothing if it is the limit of the ramps, None where they disagree."""
    jump, slowly, quickly = changes(run), changes(slow), changes(fast)
    largest = max(float(np.abs(quickly).max()), 1e-6)
    if np.abs(slowly - quickly).max() > 0.15 * largest:  # of 100 us the slow ramp takes 10: a twentieth is its own
        return None
    off = float(np.abs(jump - quickly).max())
    if off > 0.015 * largest + 1e-7:
        return f"ramps: the jump makes {off:.2g} of {largest:.2g} m/s more or less than a ramp of 1 us"
    return ""
