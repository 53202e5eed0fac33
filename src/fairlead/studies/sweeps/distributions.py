"""Distributions of one parameter, as a text, with the unit at one of the numbers.

uniform(8 N, 12 N)          between two ends
loguniform(1e-3, 1)         the logarithm is uniform
normal(0.4, 0.05)           mean, standard deviation
normal(0.4, 0.05, 0.2, 0.6) the same, cut off at two ends
lognormal(0.4, 0.1)         median, standard deviation of the natural logarithm
triangular(8 N, 9 N, 12 N)  lowest, most likely, highest
choice(hold, binding)       words, equally likely
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.errors import did_you_mean, listing
from fairlead.studies.sweeps.ranges import RangeError, _numbers

COUNTS = {"uniform": (2,), "loguniform": (2,), "normal": (2, 4), "lognormal": (2,), "triangular": (3,)}
BOUNDED = ("uniform", "loguniform")
EXAMPLE = "Write it as in uniform(8 N, 12 N), normal(0.4, 0.05) or choice(hold, binding)."


@dataclass(frozen=True)
class Distribution:
    """A distribution with its numbers in `unit`, or the words of a choice."""

    kind: str
    numbers: tuple[float, ...] = ()
    unit: str = ""
    words: tuple[str, ...] = ()

    def texts(self, shares: NDArray[np.float64]) -> list[str]:
        """Values at cumulative probabilities in (0, 1), with their unit."""
        if self.words:
            at = np.minimum((shares * len(self.words)).astype(int), len(self.words) - 1)
            return [self.words[k] for k in at.tolist()]
        return [f"{value!r} {self.unit}".strip() for value in self._law().ppf(shares).tolist()]

    def _law(self) -> Any:
        from scipy import stats

        a, b, *more = self.numbers
        if self.kind == "uniform":
            return stats.uniform(a, b - a)
        if self.kind == "loguniform":
            return stats.loguniform(a, b)
        if self.kind == "lognormal":
            return stats.lognorm(b, scale=a)
        if self.kind == "triangular":
            return stats.triang((b - a) / (more[0] - a), loc=a, scale=more[0] - a)
        return stats.truncnorm((more[0] - a) / b, (more[1] - a) / b, loc=a, scale=b) if more else stats.norm(a, b)


def read_distribution(text: str) -> Distribution:
    """Raises RangeError with what is wrong."""
    parts = re.fullmatch(r"\s*(\w+)\s*\((.*)\)\s*", text)
    kinds = (*COUNTS, "choice")
    if parts is None or parts[1] not in kinds:
        near = did_you_mean(parts[1], kinds) if parts else ""
        raise RangeError(f"this is no distribution. {near}".rstrip(), f"{EXAMPLE} There are {listing(kinds)}.")
    kind, given = parts[1], [one.strip() for one in parts[2].split(",") if one.strip()]
    if kind == "choice":
        if not given:
            raise RangeError("choice has no words", EXAMPLE)
        return Distribution(kind, words=tuple(given))
    if len(given) not in COUNTS[kind]:
        raise RangeError(f"{kind} takes {' or '.join(map(str, COUNTS[kind]))} numbers, not {len(given)}", EXAMPLE)
    decimals, unit = _numbers(given)
    numbers = tuple(map(float, decimals))
    _refuse(kind, numbers)
    return Distribution(kind, numbers, unit)


def _refuse(kind: str, numbers: tuple[float, ...]) -> None:
    ends = numbers[2:] if kind == "normal" and len(numbers) == 4 else (numbers[0], numbers[-1])
    bounded = kind in (*BOUNDED, "triangular") or len(numbers) == 4
    if bounded and not ends[0] < ends[1]:
        raise RangeError(f"from {ends[0]:g} to {ends[1]:g} the range is empty", "The first end is below the second.")
    if kind == "triangular" and not numbers[0] <= numbers[1] <= numbers[2]:
        raise RangeError("the most likely value is not between the ends", EXAMPLE)
    if kind in ("normal", "lognormal") and numbers[1] <= 0:
        raise RangeError("the standard deviation is not above zero", EXAMPLE)
    if kind in ("loguniform", "lognormal") and numbers[0] <= 0:
        raise RangeError(f"{kind} takes numbers above zero", EXAMPLE)
