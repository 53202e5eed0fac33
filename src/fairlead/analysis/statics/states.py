"""One steady state of a line on its route: tensions along it, and what its drives give."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.statics.laid_route import Device, LaidRoute
from fairlead.analysis.statics.sliding import Piece, beyond
from fairlead.brief import in_a_line


@dataclass(frozen=True)
class Passage:
    """The line in one device, or in the span between two (`device` None): tension [N] over the route [m]."""

    __repr__ = in_a_line

    name: str
    device: Device | None
    piece: Piece
    friction: float  # d mu
    places: NDArray[np.float64]
    tension: NDArray[np.float64]

    @property
    def inboard(self) -> float:
        """Tension at its inboard end [N]."""
        return float(self.tension[0])

    @property
    def outboard(self) -> float:
        """Tension at its outboard end [N]."""
        return float(self.tension[-1])

    @property
    def side_wall(self) -> float:
        """Largest load per length on the wall, T/R [N/m]."""
        return float(np.abs(self.tension - self.piece.lightened).max() * self.piece.curvature)


@dataclass(frozen=True)
class Drive:
    """What a drive gives: force outboard on the line [N], and for a clamp what it can hold.

    `own` is the force that speeding up the drive itself takes beside, with what is stored on a drum [N].
    """

    name: str
    force: float
    speed: float
    capacity: float | None = None  # N
    lever: float | None = None  # m, of the shaft
    own: float = 0.0

    @property
    def torque(self) -> float | None:
        """Torque at the shaft, paying out positive [N m]; None where there is no shaft."""
        return (self.force + self.own) * self.lever if self.lever is not None else None

    @property
    def factor(self) -> float | None:
        """Capacity over force."""
        if self.capacity is None:
            return None
        return self.capacity / abs(self.force) if self.force else math.inf

    @property
    def power(self) -> float:
        """Power given to the line [W]."""
        return self.force * self.speed


@dataclass(frozen=True)
class State:
    """One steady state. `speed` and `acceleration` outboard positive; `way` is what was paid out since the start."""

    __repr__ = in_a_line

    route: LaidRoute
    t: float
    speed: float
    way: float
    passages: tuple[Passage, ...]
    drives: tuple[Drive, ...]
    acceleration: float = 0.0
    remarks: tuple[str, ...] = ()

    @property
    def ends(self) -> tuple[float, float]:
        """Where the line begins (or leaves the drum) and ends on the route [m]."""
        return self.route.ends(self.way)

    @property
    def in_sea(self) -> float:
        """Line in the sea [m]."""
        end = self.ends[1]
        return sum(max(end - sea.begin, 0.0) for sea in self.route.seas)

    def tension(self, place: float) -> float:
        """Tension [N] at a place of the route [m]."""
        for one in self.passages:
            if one.piece.begin <= place <= one.piece.end:
                stands = one.device is None or one.device.machine is None
                run = place - one.piece.begin
                if stands and run:
                    return beyond(one.piece, one.inboard, one.friction, run)
                return float(np.interp(place, one.places, one.tension))
        return math.nan
