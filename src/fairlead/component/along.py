"""What a composite with a path says of itself: a line that is laid along a route, or a route that lines are laid on.

It stands in `Expansion.line`. The framework reads what is declared here and nothing else of a line or a route, so that
a library may bring its own.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from typing import Any

from fairlead.component.alike import Parts
from fairlead.errors import Fault


class Along(ABC):
    """A line or a route."""

    @abstractmethod
    def handed_on(self, now: Any) -> Parts | None:
        """Parts of which laying knows nothing, and what stands in their place in `now`; None if more differs."""


class OfLine(Along):
    """A line: `mesh` places its nodes, `layers` names its elements, the outer ones first."""

    mesh: Any
    layers: tuple[str, ...]
    outer: str
    """Name of the bodies that touch the devices."""
    pushes: bool
    """True when it can carry compression."""
    start_from: str = "start"
    """The parameter that says where it begins, to which messages point."""

    @abstractmethod
    def lay(self, assembly: Any, line: Any, route: Any) -> list[Fault]:
        """Add to an assembly all that acts on the nodes on a route; returns what does not fit."""

    @property
    @abstractmethod
    def start(self) -> float:
        """Where its inboard end is on the route at the start [m]."""

    @property
    @abstractmethod
    def length(self) -> float:
        """Its length at the start [m]."""

    @property
    @abstractmethod
    def tension(self) -> float:
        """Its tension at the start [N]."""

    @property
    def begins_sliding(self) -> bool:
        """True when it starts under the tensions of steady sliding, which statics gives, and not under `tension`."""
        return False

    @property
    @abstractmethod
    def diameter(self) -> float:
        """Outside diameter [m]."""

    @property
    def weight(self) -> float:
        """Weight per length, as far as it is counted [N/m]."""
        return 0.0

    @property
    def rubs(self) -> bool:
        """True when devices rub on it."""
        return True

    @property
    def lightened(self) -> bool:
        """True when mass times speed squared, which the line needs to follow a bend, does not press on the bend."""
        return False

    @property
    def ruck_force(self) -> float | None:
        """Compression above which it rucks [N]; None when nobody watches."""
        return None

    @property
    def side_wall(self) -> float | None:
        """Load per length that it bears in a bend [N/m]; None when nobody told."""
        return None

    @property
    def inner_curve(self) -> Any:
        """Friction of one layer on the other; None when there is none."""
        return None

    def slips_over(self) -> float:
        """Length of the longest piece over which layers may slip on each other; 0 where they cannot [m]."""
        return 0.0

    def rigid_from(self, begin: float, sea: Any) -> float:
        """Place on the route from which on it moves as one body in a sea that begins at `begin` [m]; else infinite."""
        return math.inf

    def margin(self, sea: Any) -> float:
        """Line in a sea that moves by itself before the rest moves as one, if that is wanted [m]."""
        return math.inf

    @property
    @abstractmethod
    def masses(self) -> tuple[float, ...]:
        """Mass per length of every layer [kg/m]."""

    @property
    def mass(self) -> float:
        """Mass per length of all layers [kg/m]."""
        return sum(self.masses)

    @property
    @abstractmethod
    def stiffnesses(self) -> tuple[float, ...]:
        """EA of every layer [N]."""

    @property
    @abstractmethod
    def slips(self) -> bool:
        """True when its layers may slip on each other."""


class OfRoute(Along):
    """A route: `placed` are its devices in their places, `machinery` the bodies of those that move, by name."""

    placed: Sequence[Any]
    machinery: Mapping[str, Any]

    @property
    @abstractmethod
    def surfaces(self) -> Sequence[Any]:
        """What the line rubs on: surfaces that stand, and that of each device that moves."""
