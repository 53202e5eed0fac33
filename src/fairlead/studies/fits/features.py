"""Features: numbers worked out alike from measured and from computed curves at the same times.

    period(S)                       mean time between upward crossings of the mean
    amplitude(S)                    half of what lies between lowest and highest
    mean(S), rms(S), peak(S), lowest(S), largest(S)
    breakaway(FORCE, SLIP, v)       largest |force| before |slip| first exceeds v, the break-away force
    at_speed(FORCE, SLIP, v1, v2)   mean force where v1 <= slip < v2; several of them are friction over speed
    quantile(S, q), spread(S)       for scenes whose course cannot be foretold

Noise alone gives false crossings of the mean: a crossing counts when the signal has been below by a tenth of its range.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.errors import did_you_mean, listing, shown
from fairlead.quantities import QuantityError, quantity

Floats = NDArray[np.float64]
SIGNALS = {"period": 1, "amplitude": 1, "mean": 1, "rms": 1, "peak": 1, "lowest": 1, "largest": 1, "spread": 1,
           "breakaway": 2, "at_speed": 2, "quantile": 1}  # fmt: skip
NUMBERS = {"breakaway": 1, "at_speed": 2, "quantile": 1}
HYSTERESIS = 0.1
BLOCKS = 8
"""Parts of a record from whose differences the noise of a feature is estimated."""
STATISTICS = ("mean({0})", "spread({0})", "quantile({0}, 0.05)", "quantile({0}, 0.25)", "quantile({0}, 0.75)",
              "quantile({0}, 0.95)")  # fmt: skip


class FeatureError(ValueError):
    """A text that is no feature: what is wrong and a way out."""

    def __init__(self, what: str, way_out: str = "Write it as in period(block.x).") -> None:
        super().__init__(what)
        self.what, self.way_out = what, way_out


@dataclass(frozen=True)
class Feature:
    """A feature: its name, its kind, the signals and the numbers [SI] it asks for."""

    name: str
    kind: str
    signals: tuple[str, ...]
    numbers: tuple[float, ...] = ()
    noise: float | None = None

    @property
    def text(self) -> str:
        """As it is written in a fit file."""
        return f"{self.kind}({', '.join([*self.signals, *(f'{one:g}' for one in self.numbers)])})"

    def of(self, times: Floats, values: Mapping[str, Floats]) -> float:
        """Its value in a record; NaN where it does not occur."""
        return _OF[self.kind](times, [values[name] for name in self.signals], self.numbers)

    def noise_in(self, times: Floats, values: Mapping[str, Floats]) -> float:
        """Standard deviation of its value, from those in parts of the record."""
        parts = np.array_split(np.arange(len(times)), BLOCKS)
        found = [self.of(times[p], {name: values[name][p] for name in self.signals}) for p in parts if len(p) > 1]
        found = [one for one in found if np.isfinite(one)]
        own = self.of(times, values)
        least = max(abs(own) if np.isfinite(own) else 0.0, 1e-12) * 1e-3
        return max(float(np.std(found, ddof=1)) / len(found) ** 0.5, least) if len(found) > 2 else least


def read_feature(name: str, text: str, noise: float | None = None) -> Feature:
    """The feature of a text. Raises FeatureError."""
    parts = re.fullmatch(r"\s*(\w+)\s*\(([^()]*)\)\s*", text)
    if parts is None:
        raise FeatureError("this is no feature")
    kind, given = parts[1], [one.strip() for one in parts[2].split(",")]
    if kind not in SIGNALS:
        what = f"there is no feature {kind}. {did_you_mean(kind, SIGNALS)}".rstrip()
        raise FeatureError(what, f"There are {listing(SIGNALS)}.")
    count, more = SIGNALS[kind], NUMBERS.get(kind, 0)
    if len(given) != count + more or not all(given):
        words = f"{count} signal{'s' * (count > 1)}" + (f" and {more} number{'s' * (more > 1)}" if more else "")
        raise FeatureError(f"{kind} takes {words}")
    try:
        numbers = tuple(quantity(one).value for one in given[count:])
    except QuantityError as error:
        raise FeatureError(error.what, error.allowed) from None
    if kind == "quantile" and not 0 <= numbers[0] <= 1:
        raise FeatureError(f"{shown(given[1])} is no share", "Write a share between 0 and 1.")
    return Feature(name, kind, tuple(given[:count]), numbers, noise)


def _period(times: Floats, values: list[Floats], _: tuple[float, ...]) -> float:
    around = values[0] - values[0].mean()
    low, armed, found = -HYSTERESIS * np.ptp(around), False, []
    for k in range(1, len(around)):
        armed = armed or around[k - 1] < low
        if armed and around[k - 1] < 0 <= around[k]:
            share = around[k - 1] / (around[k - 1] - around[k])
            found.append(times[k - 1] + share * (times[k] - times[k - 1]))
            armed = False
    return float((found[-1] - found[0]) / (len(found) - 1)) if len(found) > 1 else np.nan


def _breakaway(_: Floats, values: list[Floats], numbers: tuple[float, ...]) -> float:
    moving = np.flatnonzero(np.abs(values[1]) > numbers[0])
    return float(np.abs(values[0][: moving[0] + 1]).max()) if len(moving) else np.nan


def _at_speed(_: Floats, values: list[Floats], numbers: tuple[float, ...]) -> float:
    inside = (values[1] >= numbers[0]) & (values[1] < numbers[1])
    return float(values[0][inside].mean()) if inside.any() else np.nan


_OF = {
    "period": _period, "breakaway": _breakaway, "at_speed": _at_speed,
    "amplitude": lambda t, v, n: float(np.ptp(v[0])) / 2, "mean": lambda t, v, n: float(v[0].mean()),
    "rms": lambda t, v, n: float(np.sqrt((v[0] ** 2).mean())), "peak": lambda t, v, n: float(v[0].max()),
    "lowest": lambda t, v, n: float(v[0].min()), "largest": lambda t, v, n: float(np.abs(v[0]).max()),
    "spread": lambda t, v, n: float(v[0].std()), "quantile": lambda t, v, n: float(np.quantile(v[0], n[0])),
}  # fmt: skip
