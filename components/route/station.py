"""Devices along a route: the family of stations."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from fairlead.component import Name, Parameter
from fairlead.component.base import Family


@dataclass(frozen=True)
class Machinery:
    """The bodies of a device that moves: what stands below `route.<name>` when it is expanded.

    `surface` is the flange that moves with the surface the line touches; `clamp` the output that gives the load
    with which belts squeeze the line [N/m]: on each of them `load` as given in time, and what the input `added` adds.
    `ports` and `outputs` give inner ones an outer name.
    """

    children: dict[str, Any]
    joins: tuple[tuple[str, ...], ...] = ()
    ports: dict[str, str] = field(default_factory=dict)
    outputs: dict[str, str] = field(default_factory=dict)
    surface: str = ""
    clamp: str = ""
    load: Any = None
    added: str = ""
    total: str = ""  # port that is told the load of every node on the device


class Station(Family, abstract=True):
    """A device on [start, start + extent()] of the route; what it does, its members say.

    A device without `start` begins where the one before it ends, so a route is a list of lengths, of positions,
    or of both. How much of a node is in a device is the share of its piece of line that lies inside; `edge`
    replaces that by a piece of another length.
    """

    key = "type"
    name = Name("What the device is called: route.<name>; its type in small letters when not given.", default=None)
    start = Parameter("m", "Where the device begins; at the end of the one before when not given.", default=None)
    edge = Parameter("m", "Length over which it takes hold of a node; its own piece of line when not given.",
                     default=None, above=0)  # fmt: skip
    slope = Parameter("rad", "How steeply the route goes down towards the sea.", default=0.0)

    def extent(p):
        """Length of the device along the route [m]."""
        raise NotImplementedError

    def span(p, start):
        """Where the device begins and ends [m]; either may be infinite."""
        return start, start + p.extent()

    def bend_radius(p):
        """Radius of the route inside [m]; None when straight."""
        return None

    def rubs(p):
        """Curve of friction of the surface; None when the line touches nothing."""
        return None

    def all_round(p):
        """True when the line is held from all sides, so that a line in compression presses too."""
        return False

    def bears_weight(p):
        """True when the line lies on it."""
        return False

    def squeeze(p):
        """Load with which it presses on the line all round [N/m]."""
        return 0.0

    def reads(p):
        """What a metre of line counts in a mean of tensions that the device tells [1/m]; 0 when it tells none."""
        return 0.0

    def stores(p):
        """True for a drum (`Winch`): the line inboard of its end is wound on it and moves with it."""
        return False

    def leaves_at(p, stored, diameter):
        """Radius of a drum at which a line of this diameter [m] leaves it, with `stored` [m] of it on the drum [m]."""
        raise NotImplementedError

    def layer_at(p, stored, diameter):
        """The layer of a drum that the line leaves, from 1; None of one without layers."""
        return None

    def takes(p, diameter):
        """How much of the model's line, of this diameter [m], a drum takes [m]."""
        return math.inf

    def immerses(p):
        """True for a water (`Sea`) that drags the line outboard of its start."""
        return False

    def flow(p):
        """Speed at which a water flows past the route, a quantity in time [m/s]; None when it rests."""
        return None

    def drags(p, diameter):
        """Drag of a water along a line of that diameter, per length and speed squared [kg/m^2]."""
        return 0.0

    def tows(p, diameter, begin, place, way):
        """What a water and what is in it pull at the outboard end when `way` [m] has been paid out.

        The station begins at `begin`, the end was at `place` at the start [m]. A steady pull [N], and a drag per speed
        squared [kg/m].
        """
        return 0.0, 0.0

    def moves_as_one(p):
        """True when the line far out in a water moves as one body with its end; see `as_one`."""
        return p.type.answers.as_one is not None and p.path(p.type.answers.as_one[0]) == p.type.answers.as_one[1]

    def keeps_apart(p):
        """Line in such a water that moves by itself all the same [m]; None when the line is to say."""
        return None

    def lever(p):
        """Radius from the surface to the shaft that drives it [m]; None where no shaft does."""
        return None

    def taken_by_bearing(p):
        """Part of the tension that the bearing of a wheel takes."""
        return 0.0

    def draws(p, t):
        """Force that draws a loop of line out [N]; None for a device without a loop."""
        return None

    def loosest(p, t):
        """Least tension with a loop drawn out as far as it goes, short of its stop [N]; asked where `draws` is told."""
        return 0.0

    def machinery(p, scene):
        """The bodies that move; None for a device that stands."""
        return None
