"""Signals made small enough for a page, without losing an extreme.

A value becomes one of 65,535 levels between the lowest and the highest of its signal, zero being one of them if the
signal passes it. Rows are kept as they are while the page stays small. When it would not, every `k` rows become one
bucket of three values: the first, the lowest, the highest. So what a zoomed-out plot shows never lacks an extreme;
coarser levels of that pyramid are made by the page itself.
"""

from __future__ import annotations

import base64
import zlib
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

NAN = 65535
LEVELS = 65534
MOST_BYTES = 3_200_000
"""Compressed, of the signals of a page; in the page they take a third more."""


@dataclass(frozen=True)
class Chunk:
    """Signals of one family, compressed: `data` holds 16 bit differences, low bytes before high bytes."""

    data: bytes
    low: list[float]
    step: list[float]

    def plain(self) -> dict[str, Any]:
        """For the page."""
        return {"b": base64.b64encode(self.data).decode(), "lo": self.low, "st": self.step}


def bucketed(values: NDArray[np.float64], k: int) -> NDArray[np.float64]:
    """Rows (n, m) as buckets (3, ceil(n / k), m) of first, lowest and highest; for k = 1 the rows (1, n, m)."""
    if k <= 1:
        return values[np.newaxis]
    starts = np.arange(0, len(values), k)
    with np.errstate(invalid="ignore"):
        low, high = np.fmin.reduceat(values, starts), np.fmax.reduceat(values, starts)
    return np.stack([values[starts], low, high])


def packed(values: NDArray[np.float64], k: int) -> Chunk:
    """Pack signals side by side (n, m), `k` rows to a bucket."""
    codes, low, step = quantised(values)
    shaped = bucketed(codes, k)  # (3 or 1, rows, m): by signal, then first, lowest, highest
    flat = np.nan_to_num(shaped, nan=NAN).astype(np.uint16).transpose(2, 0, 1).reshape(values.shape[1], -1)
    moved = np.diff(flat, axis=1, prepend=np.zeros((len(flat), 1), np.uint16)).astype("<u2")
    planes = moved.ravel().view(np.uint8).reshape(-1, 2).T
    return Chunk(zlib.compress(np.ascontiguousarray(planes).tobytes(), 6), low.tolist(), step.tolist())


def quantised(values: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Levels (n, m), nan where there is no value, with the value of level zero and of a step, by signal."""
    known = np.isfinite(values)
    low = np.min(values, axis=0, where=known, initial=np.inf)
    high = np.max(values, axis=0, where=known, initial=-np.inf)
    low, high = np.where(low > high, 0.0, low), np.where(low > high, 0.0, high)
    step = np.where(high > low, (high / (LEVELS - 1) - low / (LEVELS - 1)), 1.0)
    step = np.where(step > 0, step, 1.0)
    through_zero = (low < 0) & (high > 0)
    low = np.where(through_zero, -np.ceil(-low / step) * step, low)
    with np.errstate(invalid="ignore", over="ignore"):
        codes = np.round((values - low) / step)
    return np.where(known, np.clip(codes, 0, LEVELS), np.nan), low, step


def packed_times(times: NDArray[np.float64]) -> str:
    """Times as doubles, compressed."""
    return base64.b64encode(zlib.compress(np.ascontiguousarray(times, dtype="<f8").tobytes(), 6)).decode()


def packed_numbers(values: NDArray[Any], kind: str) -> str:
    """Numbers of a numpy `kind` (`<f4`, `<u2`, ...), compressed."""
    return base64.b64encode(zlib.compress(np.ascontiguousarray(values).astype(kind).tobytes(), 6)).decode()
