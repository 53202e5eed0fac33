"""A line laid on a route: what the route, and the framework, must know of it."""

from __future__ import annotations

import functools
import itertools
import math
from dataclasses import dataclass
from typing import Any

from fairlead.components.line.fits import fits
from fairlead.components.line.laying import Laying
from fairlead.components.line.mesh import Mesh
from fairlead.components.line.on_route import OnRoute
from fairlead.components.route.sea import LEAST_MARGIN
from fairlead.components.route.window import Reach

from fairlead.brief import in_a_line
from fairlead.component.alike import Parts, agree
from fairlead.component.along import OfLine
from fairlead.component.assembly import PortRef
from fairlead.errors import Fault


@dataclass(frozen=True)
class LaidLine(OfLine):
    """What a route must know of a line: its mesh, its bodies and what it is made of.

    Children of the line: `outer`[i] is the body of a node that touches the devices, `inner`[i] the one inside it (a
    body of its own at nodes that are no connectors), `layers`[k] the elements with their tensions, outer layer first.
    `bulkheads` tells which nodes have a contact between the two, and for what piece of line.
    """

    __repr__ = in_a_line

    mesh: Mesh
    values: Any
    outer: str
    layers: tuple[str, ...]
    inner: str = ""
    bulkheads: dict[int, Reach] | None = None
    meter: Any = None  # class of what counts slip and work of every contact
    pushes: bool = True

    @property
    def start(self) -> float:
        """Where its inboard end is on the route at the start [m]."""
        return float(self.values.start)

    @property
    def length(self) -> float:
        """Its length at the start [m]."""
        return float(self.values.length)

    @property
    def tension(self) -> float:
        """Its tension at the start [N]."""
        return float(self.values.tension)

    @property
    def begins_sliding(self) -> bool:
        """True with `profile: statics`."""
        return bool(self.values.profile == "statics")

    @property
    def diameter(self) -> float:
        """Outside diameter [m]."""
        return float(self.values.diameter)

    @functools.cached_property
    def weight(self) -> float:
        """Weight per length, if the scene has any [N/m]."""
        return float(self.values.weight) if self.values.gravity == "on" else 0.0

    @property
    def rigid(self) -> bool:
        """True when it, or its core, does not stretch: all that moves with the core is one body then."""
        return getattr(self.values, self.stretch, "on") == "off"

    @property
    def stretch(self) -> str:
        """The effect that says whether it stretches."""
        return "core_stretch" if "core" in self.layers else "line_stretch"

    @property
    def rubs(self) -> bool:
        """True when devices rub on it."""
        return bool(self.values.device_friction == "on")

    @functools.cached_property
    def lightened(self) -> bool:
        """True when it presses less on a bend for its speed."""
        return bool(self.values.centrifugal == "on")

    @property
    def ruck_force(self) -> float | None:
        """Compression above which it rucks [N]."""
        return self.values.ruck_force

    @property
    def side_wall(self) -> float | None:
        """Load per length that it bears in a bend [N/m]."""
        return self.values.side_wall

    @property
    def inner_curve(self) -> Any:
        """Friction of the bulkheads in the hose."""
        return self.values.bulkhead_friction if self.inner else None

    @property
    def masses(self) -> tuple[float, ...]:
        """Mass per length of every layer [kg/m]."""
        return tuple(float(layer.mass) for layer in self._made_of(self.layers))

    @property
    def stiffnesses(self) -> tuple[float, ...]:
        """EA of every layer [N]."""
        return tuple(float(layer.stiffness) for layer in self._made_of(self.layers))

    @property
    def slips(self) -> bool:
        """True when hose and core are bodies of their own."""
        return bool(self.inner)

    def is_one_body(self, node: int) -> bool:
        """True where its layers are one body: everywhere if they do not slip, else at the connectors."""
        return not self.inner or node in self.mesh.connectors

    def _made_of(self, layers: tuple[str, ...]) -> list[Any]:
        """The parameters of layers."""
        return [self.values if one == "line" else getattr(self.values, one) for one in layers]

    def heavy(self, layers: tuple[str, ...]) -> dict[str, float]:
        """Mass per length of some layers, as their lateral load takes it; nothing where it is not counted [kg/m]."""
        if not self.lightened:
            return {}
        return {"heavy": sum(float(one.mass) for one in self._made_of(layers))}

    def slips_over(self) -> float:
        """Length of the longest module in which the hose may slip on the core; 0 where it cannot [m]."""
        ends = [self.mesh.places[i] for i in sorted(self.mesh.connectors)]
        return max((b - a for a, b in itertools.pairwise(ends)), default=0.0) if self.inner else 0.0

    def rigid_from(self, begin: float, sea: Any) -> float:
        """Place on the route from which on the line moves as one body in a sea that begins at `begin` [m]."""
        return begin + self.margin(sea) if sea.moves_as_one() else math.inf

    def margin(self, sea: Any) -> float:
        """Line in a sea that moves by itself before the rest moves as one, if that is wanted [m]."""
        given = sea.keeps_apart()
        return float(self.slips_over() + LEAST_MARGIN if given is None else given)

    def handed_on(self, now: LaidLine) -> Parts | None:
        """Parts of which laying is to know nothing, and what stands in their place in `now`; None if more differs."""
        parts: Parts = {}
        return parts if agree(self.values, now.values, parts) else None

    def untold(self, to: Laying, line: Any) -> list[Fault]:
        """What does not stretch has its motion given, and friction acts on it between its ends.

        What holds a body whose motion is given has no force that is determined. Where hose and core may part, friction
        acts on that body at connectors alone.
        """
        inner = [i for i in range(1, self.mesh.elements) if self.is_one_body(i)]
        given = [i for i in inner if PortRef(f"{line.path}.{self.outer}[{i}]", "flange") in to.prescribed]
        if not (self.rigid and given):
            return []
        what = f"{line.path}.{self.stretch} is off and its motion is given"
        if self.slips:
            what += ", and its modules have connectors in between, which no friction could hold back."
            return [Fault(line.where, what, "Drive it over a Spring, take one module, or leave core_stretch on.")]
        what += ": it is one body, which no friction could hold back, nor change what its ends pull."
        return [Fault(line.where, what, f"Drive it over a SpringDamper, or leave {self.stretch} on.")]

    def lay(self, assembly: Any, line: Any, route: Any) -> list[Fault]:
        """Add to the assembly all that acts on the nodes on this route; returns what does not fit."""
        faults = fits(assembly, self, line, route)
        if faults:
            return faults
        add = OnRoute(self, Laying(assembly, line), route.path, route.line)
        if faults := self.untold(add.to, line):
            return faults
        for i in range(self.mesh.elements + 1):
            if PortRef(f"{line.path}.{self.outer}[{i}]", "flange") not in add.to.prescribed:  # friction changes nothing
                add.node(i)
        add.ends()
        add.loops()
        add.bare()
        return []
