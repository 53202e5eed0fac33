"""Recorded signals as a result reads them: from a file, or from memory."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from fairlead.results.signal import Signal


class Series(Protocol):
    """Recorded signals, wherever they lie."""

    signals: tuple[Signal, ...]

    def time(self) -> NDArray[np.float64]:
        """Return the recorded times (n,) [s]."""

    def side(self) -> NDArray[np.int8]:
        """Return the side of an event of every row (n,)."""

    def values(self, names: list[str]) -> NDArray[np.float64]:
        """Return the values (n, len(names)) of recorded signals."""
