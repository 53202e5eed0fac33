"""When a signal is at its extreme: the first time at which it is as near to it as rounding leaves it.

A wheel that has stopped warms its disc no more, and the last digit of the temperature goes on changing. Which of these
instants has the largest number says nothing; when the disc was as warm first does.

    |value - extreme| <= NEAR (highest - lowest) + ROUNDED |extreme|
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

NEAR = 1e-9
"""Share of the range of a signal: far above what rounding does to a plateau, and 60 us of a sine of 1 rad/s."""
ROUNDED = 4 * float(np.finfo(float).eps)


def tolerance(highest: Any, lowest: Any) -> Any:
    """How near to an extreme a value has to be to count as it; 0 of a signal of which nothing is known yet."""
    with np.errstate(invalid="ignore"):
        near = NEAR * (highest - lowest) + ROUNDED * np.maximum(np.abs(highest), np.abs(lowest))
    return np.where(np.isfinite(near), near, 0.0)


def first_of(values: Sequence[float], *, least: bool) -> int:
    """Which of several is the lowest or the highest: the first of those that differ by rounding alone."""
    return first_row(np.array(values), least=least)


def first_row(values: NDArray[np.float64], *, least: bool) -> int:
    """The first row of a signal at its lowest or its highest value; NaN is none."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    near = float(tolerance(high, low))
    return int(np.argmax(values <= low + near if least else values >= high - near))
