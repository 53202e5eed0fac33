"""What a composite with a path says of itself: a line that is laid along a route, or a route that lines are laid on.

It stands in `Expansion.line`. The framework reads what is declared here and nothing else of a line or a route, so that
a library may bring its own.
"""

from __future__ import annotations

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
    pushes: bool
    """True when it can carry compression."""

    @abstractmethod
    def lay(self, assembly: Any, line: Any, route: Any) -> list[Fault]:
        """Add to an assembly all that acts on the nodes on a route; returns what does not fit."""

    @property
    @abstractmethod
    def mass(self) -> float:
        """Mass per length of all layers [kg/m]."""

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
