"""Controllers that wind up: the integral grows although what follows has given all it has.

An output of role `integral` is what a controller has gathered, and `saturates_in` are the zones of a part in which a
larger input gives no larger output: a valve that is fully open, a limiter, an amplifier at its voltage; or, input by
input, the smaller of two signals while the other one passes. Where such a part is fed by the controller, at once or
through other signals, the time is added up in which it is in one of these zones and the integral grows in size. More
than half of a run is told, with the way out.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fairlead.component.declare import INTEGRAL
from fairlead.flatten.flat_model import FlatModel
from fairlead.system.arrays.recording import OutputSignal
from fairlead.system.compiled.system import System

MOST = 0.5
"""Share of the run from which on it is told."""
NOTHING = 1e-12
"""Of the integral; a smaller change is taken for rounding."""
GIVES_ALL, PASSES_ANOTHER = "already gives all it has", "passes another signal"
Floats = NDArray[np.float64]
Events = NDArray[np.void]


@dataclass
class Watched:
    """An integral and the part behind it."""

    controller: str
    part: str
    column: int
    """Of the integral, in the rows of a run."""
    machine: int
    saturated: frozenset[int]
    """Zones in which the part gives all it has."""
    zone: int
    how: str = GIVES_ALL
    grows: bool = False
    t: float = np.nan
    size: float = np.nan
    """Time and size of the integral in the row before."""
    wound: float = 0.0
    """[s]: how long the integral has grown while the part was saturated."""

    def watch(self, t: Floats, size: Floats, events: Events) -> None:
        """Take rows and the zone changes among them."""
        mine = events[events["machine"] == self.machine]
        zones = np.concatenate([[self.zone], mine["after"]])
        saturated = np.isin(zones, list(self.saturated))[np.searchsorted(mine["t"], t[:-1], side="right")]
        grows = self._growing(np.diff(size), size[1:])
        self.wound += float(np.sum(np.diff(t)[saturated & grows]))
        self.zone = int(zones[-1])

    def _growing(self, change: Floats, size: Floats) -> NDArray[np.bool_]:
        """Whether it grows between two rows; where nothing changes, as between samples, what was so before."""
        moves = np.abs(change) > NOTHING * size
        last = np.maximum.accumulate(np.where(moves, np.arange(len(change)), -1))
        grows = np.where(last >= 0, change[last] > 0.0, self.grows)
        if len(grows):
            self.grows = bool(grows[-1])
        return np.asarray(grows, dtype=bool)


@dataclass
class WindUp:
    """Watches all of a run."""

    watched: list[Watched]
    first: float = np.nan
    last: tuple[float, Floats] | None = field(default=None)

    @classmethod
    def of(cls, system: System, recorded: Sequence[OutputSignal]) -> WindUp:
        """Every part that saturates with every controller that feeds it; without signals none."""
        integrals = {s.name.rpartition(".")[0]: k for k, s in enumerate(recorded) if s.role == INTEGRAL}
        return cls([*_watched(system, integrals)] if integrals else [])

    def watch(self, t: Floats, rows: Floats, events: Events) -> None:
        """Take recorded rows, shape (k, recorded), and the zone changes among them."""
        if not self.watched or not len(t):
            return
        if self.last is None:
            self.first = float(t[0])
        else:
            t, rows = np.concatenate([[self.last[0]], t]), np.concatenate([self.last[1][None], rows])
        for one in self.watched:
            one.watch(t, np.abs(rows[:, one.column]), events)
        self.last = float(t[-1]), rows[-1].copy()

    def remarks(self) -> list[str]:
        """A sentence on each controller that winds up for most of the run."""
        span = self.last[0] - self.first if self.last is not None else 0.0
        return [
            f"{one.controller} winds up: its integral grows during {100 * one.wound / span:.0f} % of the run while "
            f"{one.part} {one.how}, and the controller answers late when the error turns. Give "
            f"{one.controller} the limits `low` and `high` that {one.part} has, or a command that it can follow."
            for one in self.watched
            if one.wound > MOST * span
        ]


def _watched(system: System, integrals: dict[str, int]) -> Iterator[Watched]:
    by_path = {instance.path: instance for instance in system.flat.instances}
    for machine, path in enumerate(system.machine_names):
        says = by_path[path].type.answers.saturates_in if path in by_path else ()
        names, at = list(system.zone_names(machine)) if says else [], int(system.zones[machine])
        ways = says if isinstance(says, Mapping) else {"": says} if says else {}
        fed = {own: set(_fed_by(system.flat, path, integrals, own)) for own in ways}
        for own, zones in ways.items():
            saturated = frozenset(names.index(zone) for zone in zones if zone in names)
            others = set().union(*(fed[other] for other in ways if other != own))
            for controller in sorted(fed[own] - others):  # of a signal against itself each way is its own
                how = PASSES_ANOTHER if own else GIVES_ALL
                yield Watched(controller, path, integrals[controller], machine, saturated, at, how)


def _fed_by(flat: FlatModel, path: str, integrals: dict[str, int], own: str = "") -> Iterator[str]:
    """The controllers whose signal comes to a part, or to one input of it, not looking behind a controller."""
    sources: dict[str, set[str]] = {}
    for target, source in flat.sources.items():
        if not own or target.instance != path or target.port == own:
            sources.setdefault(target.instance, set()).add(source.instance)
    seen, waiting = {path}, [*sorted(sources.get(path, ()))]
    while waiting:
        one = waiting.pop()
        if one in seen:
            continue
        seen.add(one)
        if one in integrals:
            yield one
        else:
            waiting += sorted(sources.get(one, ()))
