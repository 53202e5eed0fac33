"""How near a run came to the limits of its line: per station and over the run, with time and place of the worst.

    margins(result)      from what was recorded; what is missing is named with the signal that would tell it
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.record.recorded_line import Floats, RecordedLine
from fairlead.results import Result
from fairlead.results.plateau import first_row
from fairlead.results.run_file import RUN_FILE
from fairlead.results.run_schema import routes

MISSED = 0.05
"""Share of the largest tension of a line that recorded rows may miss without a word."""


@dataclass(frozen=True)
class Worst:
    """A value with its time [s], its element or node, and where that is on the route [m] (None: not recorded)."""

    value: float
    t: float
    signal: str
    place: float | None = None


@dataclass(frozen=True)
class StationMargins:
    """What the line went through in one station (or, named "line", everywhere); None where nothing tells it.

    Tensions [N]; `side_wall` [N/m]; `scuffed` and `inner_scuffed` [m]: how far one node slid there at most, on the
    device and bulkhead in hose; `slipped` [m]: how far the line as a whole slid on belts or a wheel;
    `registration` [m].
    """

    name: str
    peak: Worst | None = None
    lowest: Worst | None = None
    hose: Worst | None = None
    core: Worst | None = None
    side_wall: Worst | None = None
    scuffed: Worst | None = None
    inner_scuffed: Worst | None = None
    slipped: Worst | None = None
    registration: Worst | None = None


@dataclass(frozen=True)
class LineMargins:
    """One line: all its stations that it was in, the whole, what it bears, and what should have been recorded."""

    line: str
    stations: tuple[StationMargins, ...]
    whole: StationMargins
    ruck_force: float | None
    side_wall: float | None
    missing: tuple[str, ...] = field(default=())

    @property
    def of_hose(self) -> str:
        """The quantity that the margin to rucking belongs to: of a single layer, hose and line are one."""
        return "lowest" if self.whole.core is None else "hose"

    def ruck_margin(self, one: StationMargins) -> float | None:
        """Compression that it bears over that which it had; infinite when it had none."""
        if self.ruck_force is None or one.hose is None:
            return None
        return self.ruck_force / -one.hose.value if one.hose.value < 0 else math.inf

    def side_wall_margin(self, one: StationMargins) -> float | None:
        """Load per length that it bears over that which it had."""
        if self.side_wall is None or one.side_wall is None or not one.side_wall.value:
            return None
        return self.side_wall / one.side_wall.value


def margins(result: Result) -> list[LineMargins]:
    """Margins of every line on a route, of a finished or an unfinished run. Raises DamagedResultsError."""
    return [_Judge(result, record).margins() for record in routes(result.named(RUN_FILE), result.run)]


@dataclass(frozen=True)
class _Judge(RecordedLine):
    """One line of a run and its margins."""

    def margins(self) -> LineMargins:
        """All of it."""
        stations = [self._station(each) for each in self.record["stations"]] if self.places is not None else []
        found = tuple(one for one in stations if one is not None)
        return LineMargins(
            self.record["line"], found, self._whole(found), self.record["ruck_force"], self.record["side_wall"],
            (*self._missing(), *self._too_coarse()),
        )  # fmt: skip

    def _station(self, station: dict[str, Any]) -> StationMargins | None:
        """None for a station the line was never in, or that does nothing to it."""
        begin = -math.inf if station["begin"] is None else station["begin"]
        end = math.inf if station["end"] is None else station["end"]
        assert self.nodes is not None
        assert self.places is not None
        inside = (self.places >= begin) & (self.places <= end)
        if not inside.any() or station["type"] == "Straight":
            return None
        found: dict[str, Worst | None] = dict(self._tensions(inside))
        if station["curvature"] and self.total is not None:
            found["side_wall"] = self._side_wall(station["curvature"], inside, found)
        held: NDArray[np.bool_] = (self.nodes >= begin) & (self.nodes <= end)
        if station["contact"]:
            found |= self._slips(station["contact"], "scuffed", held)
            found |= self._slips("inner", "inner_scuffed", held)
            if station["moves"]:
                found["slipped"] = self._slipped(station["contact"], held)
        return StationMargins(station["name"], **found)

    def _side_wall(self, curvature: float, inside: NDArray[np.bool_], found: Mapping[str, Worst | None]) -> Worst:
        """Load per length of what is inside; of a line of one layer that of its extremes, between rows as well."""
        assert self.total is not None
        ends = [found[name] for name in ("peak", "lowest")] if self.layers is not None and len(self.layers) == 1 else []
        known = [one for one in ends if one is not None]
        if not known:
            return self._worst(np.abs(self.total) * curvature, inside, self._element)
        worst = max(known, key=lambda one: abs(one.value))
        return Worst(abs(worst.value) * curvature, worst.t, worst.signal, worst.place)

    def _whole(self, stations: tuple[StationMargins, ...]) -> StationMargins:
        """Over all of the line, drum and sea as well, but for what moves as one body out there and has no waves."""
        found: dict[str, Worst | None] = {}
        if self.total is not None and len(self.total):
            judged, end = np.ones(self.total.shape, dtype=bool), self.record.get("rigid_from")
            if end is not None and self.places is not None:
                judged = self.places <= end
            found |= self._tensions(judged)
        for name in ("side_wall", "scuffed", "inner_scuffed", "slipped"):
            here = [one for each in stations if (one := getattr(each, name)) is not None]
            found[name] = max(here, key=lambda one: one.value, default=None)
        apart = self.some("registration", "d")
        if apart is not None and len(apart[1]):
            names, values = apart
            found["registration"] = self._worst(np.abs(values), np.ones(values.shape, dtype=bool), names.__getitem__)
        return StationMargins("line", **found)

    def _tensions(self, inside: NDArray[np.bool_]) -> Iterator[tuple[str, Worst]]:
        if self.layers is None or self.total is None:
            return
        alone = len(self.layers) == 1  # else the sum of two signals, of which no row is known but those recorded
        yield "peak", self._worst(self.total, inside, self._element, recorded=alone)
        yield "lowest", self._worst(self.total, inside, self._element, least=True, recorded=alone)
        yield "hose", self._worst(self.layers[0], inside, self._element, least=True, recorded=True)
        if not alone:
            inner = self.record["layers"][1]
            yield "core", self._worst(
                self.layers[1], inside, lambda k: self.name(inner, k), least=True, recorded=True
            )

    def _worst(
        self, values: Floats, inside: NDArray[np.bool_], name: Any, *, least: bool = False, recorded: bool = False
    ) -> Worst:
        """The extreme among what is inside, and where it was; of signals as recorded also between their rows."""
        worst = self._worst_row(values, inside, name, least)
        return self._between_rows(worst, values, inside, name, least) if recorded else worst

    def _between_rows(self, worst: Worst, values: Floats, inside: NDArray[np.bool_], name: Any, least: bool) -> Worst:
        """A worse extreme of a signal over the run, if what it belongs to was inside in the rows round it."""
        for k in range(values.shape[1]):
            one = self.result.extremes(f"{name(k)}.tension")
            value, t = (one.lowest, one.t_lowest) if least else (one.highest, one.t_highest)
            if not (value < worst.value if least else value > worst.value):
                continue
            row = int(np.searchsorted(self.result.t, t))
            rows = [max(row - 1, 0), min(row, len(values) - 1)]
            if inside[rows, k].all():
                place = None
                if self.places is not None and values.shape[1] == self.places.shape[1]:
                    place = float(np.interp(t, self.result.t, self.places[:, k]))
                worst = Worst(value, t, name(k), place)
        return worst

    def _worst_row(self, values: Floats, inside: NDArray[np.bool_], name: Any, least: bool) -> Worst:
        """The extreme among rows of what is inside, and where it was."""
        masked = np.where(inside, values, math.inf if least else -math.inf)
        row, k = divmod(int(masked.argmin() if least else masked.argmax()), masked.shape[1])
        if inside[row, k]:
            row = first_row(np.where(inside[:, k], values[:, k], np.nan), least=least)
        place = None
        if self.places is not None:
            where = self.places if values.shape[1] == self.places.shape[1] else self.nodes
            place = float(where[row, k]) if where is not None and values.shape[1] == where.shape[1] else None
        return Worst(float(values[row, k]), float(self.result.t[row]), name(int(k)), place)

    def _element(self, k: int) -> str:
        return self.name(self.record["layers"][0], k)

    def _slips(self, child: str, key: str, held: NDArray[np.bool_]) -> Iterator[tuple[str, Worst]]:
        """The node that slid furthest while it was there."""
        found = self.of_nodes(child, "slip")
        if found is None or not len(self.result.t):
            return
        gone = np.cumsum(self._over_time(np.abs(found) * held), axis=0)
        k = int(gone[-1].argmax())
        if gone[-1, k] > 0:
            row = int(np.searchsorted(gone[:, k], gone[-1, k] * (1 - 1e-9)))
            place = float(self.nodes[row, k]) if self.nodes is not None else None
            yield key, Worst(float(gone[-1, k]), float(self.result.t[row]), self.name(child, k), place)

    def _slipped(self, child: str, held: NDArray[np.bool_]) -> Worst | None:
        """How far the line slid on a surface that moves: the mean slip of what is there, over time."""
        found = self.of_nodes(child, "slip")
        if found is None:
            return None
        mean = np.abs((found * held).sum(axis=1)) / np.maximum(held.sum(axis=1), 1)
        gone = self._over_time(mean)
        row = first_row(mean, least=False)
        return Worst(float(gone.sum()), float(self.result.t[row]), f"{self.record['line']}.{child}", None)

    def _over_time(self, rate: Floats) -> Floats:
        """Contribution of every row to the integral over time, by trapezoids."""
        span = np.diff(self.result.t, prepend=self.result.t[0])
        before = np.vstack([rate[:1], rate[:-1]]) if rate.ndim > 1 else np.concatenate([rate[:1], rate[:-1]])
        return (rate + before) / 2 * (span[:, None] if rate.ndim > 1 else span)

    def _too_coarse(self) -> Iterator[str]:
        """Where rows miss much of what a layer had between them: sums of layers, and slides, are known in rows only."""
        if self.layers is None or len(self.layers) < 2 or len(self.result.t) < 2:
            return
        names = [self.name(layer, k) for layer, of in zip(self.record["layers"], self.layers, strict=True)
                 for k in range(of.shape[1])]  # fmt: skip
        seen = np.concatenate([np.abs(one).max(axis=0) for one in self.layers])
        extremes = [self.result.extremes(f"{name}.tension") for name in names]
        had = np.array([max(abs(one.lowest), abs(one.highest)) for one in extremes])
        k = int((had - seen).argmax())
        if had[k] - seen[k] > MISSED * had.max():
            yield (
                f"more often than every {float(np.diff(self.result.t).max()):.3g} s: tension of all layers, side_wall "
                f"and scuffed are those of recorded rows, and between them {names[k]} had {had[k]:.4g} N, in them "
                f"{seen[k]:.4g} N"
            )

    def _missing(self) -> Iterator[str]:
        """What to record, and what that would tell."""
        line = self.record["line"]
        for layer in self.record["layers"]:
            if self.every(layer, "tension", self.record["nodes"] - 1) is None:
                yield f"{line}.{layer}[*].tension for the tensions"
        if self.nodes is None:
            yield f"{line}.{self.record['outer']}[*].x for the station that an element is in"
        for child in dict.fromkeys(each["contact"] for each in self.record["stations"] if each["contact"]):
            if self.some(child, "slip") is None:
                there = [each["name"] for each in self.record["stations"] if each["contact"] == child]
                yield f"{line}.{child}[*].slip for how far the line slides in {', '.join(there)}"
        if len(self.record["layers"]) > 1 and self.some("inner", "slip") is None:
            yield f"{line}.inner[*].slip for how far bulkheads slide in the hose"
        if len(self.record["layers"]) > 1 and self.some("registration", "d") is None:
            yield f"{line}.registration[*].d for the de-registration"
