"""A two-layer line laid on a route: the contacts of every node with the devices and inside the line."""

import functools
from dataclasses import dataclass, field
from typing import Any

from fairlead.components.friction.contact import Contact
from fairlead.components.line.lateral_load import LateralLoad

from fairlead.component.declare import Input
from fairlead.component.instantiate import Join, PortRef
from fairlead.component.piecewise import PiecewisePolynomial
from fairlead.errors import Fault

FIXED_DEVICE = 1e9  # kg; what a hose node bound to a fixed device counts as


@dataclass(frozen=True)
class ArrayLine:
    """What a route must know of an array: how many elements, how long, and its parameters."""

    elements: int
    element: float
    values: Any

    def lay(self, assembly: Any, line: Any, route: Any) -> list[Fault]:
        """Add the contacts: `outer` between device and hose, `inner` between hose and bulkheads."""
        laid = route.line
        faults = laid.faults(self.element, route)
        if faults:
            return faults
        curvature = laid.curvature(self.element)
        add = _Adder(assembly, line)
        for i in range(self.elements + 1):
            if f"{line.path}.hose_node[{i}]" in add.prescribed:
                continue  # its motion is given: friction could not change it
            add.node(self, i, curvature, f"{route.path}.surface", laid.friction)
        return []


@dataclass(frozen=True)
class _Adder:
    """Adds instances and joins below the path of a line."""

    assembly: Any
    line: Any
    shared: dict[Any, Any] = field(default_factory=dict)

    def node(self, array: ArrayLine, i: int, curvature: PiecewisePolynomial, surface: str, friction: Any) -> None:
        """Loads and contacts of one node; a connector has no inner contact."""
        n, path = array.elements, self.line.path
        inside = 0 < i < n
        length = array.element if inside else array.element / 2
        self.load(f"outer_load[{i}]", f"hose_node[{i}]", i, n, ("hose", "core"), curvature, length)
        masses = {"partner_mass_b": self.mass(f"core_node[{i}]")} if inside else {}
        self.contact(f"outer[{i}]", surface, f"{path}.hose_node[{i}]", f"outer_load[{i}]", friction, masses)
        if not inside:
            return
        self.load(f"inner_load[{i}]", f"core_node[{i}]", i, n, ("core",), curvature, length)
        self.contact(f"inner[{i}]", f"{path}.hose_node[{i}]", f"{path}.core_node[{i}]", f"inner_load[{i}]",
                     array.values.bulkhead_friction, {"partner_mass_a": FIXED_DEVICE})  # fmt: skip
        self.exchange(f"outer[{i}]", "bound_b", f"inner[{i}]")
        self.exchange(f"inner[{i}]", "bound_a", f"outer[{i}]")

    def load(
        self, name: str, node: str, i: int, n: int, layers: tuple[str, ...], curvature: Any, length: float
    ) -> None:
        """A LateralLoad fed by the tensions of the adjacent elements."""
        share = 0.5 if 0 < i < n else 1.0
        self.add(name, self.made(LateralLoad, curvature=curvature, length=length, share=share))
        self.join(f"{name}.flange", f"{node}.flange")
        for layer in layers:
            if i > 0:
                self.join(f"{layer}[{i - 1}].tension", f"{name}.{layer}_in")
            if i < n:
                self.join(f"{layer}[{i}].tension", f"{name}.{layer}_out")

    def contact(self, name: str, a: str, b: str, load: str, curve: Any, masses: dict[str, float]) -> None:
        """A contact as the scene's friction block treats it."""
        scene = self.assembly.scene
        declared = scene.member(Contact, {}).declaration.parameters
        known = {key: value for key, value in masses.items() if key in declared}
        self.add(name, self.made(Contact, curve=curve, **known))
        path = self.line.path
        self.assembly.joins.append(Join((PortRef(a, "flange"), PortRef(f"{path}.{name}", "a")), self.line.where))
        self.assembly.joins.append(Join((PortRef(b, "flange"), PortRef(f"{path}.{name}", "b")), self.line.where))
        self.join(f"{load}.force", f"{name}.normal")

    def made(self, kind: type, **given: Any) -> Any:
        """Values of a child; equal children of a line share theirs."""
        key = (kind, *((name, value if isinstance(value, float) else id(value)) for name, value in given.items()))
        if key not in self.shared:
            self.shared[key] = self.assembly.scene.make(kind, **given)
        return self.shared[key]

    def exchange(self, name: str, entry: str, other: str) -> None:
        """Tell a contact whether the other one of its body is bound, if its treatment asks."""
        has = self.assembly.instances[f"{self.line.path}.{name}"].type.declaration
        if isinstance(has.inputs.get(entry), Input):
            self.join(f"{other}.bound", f"{name}.{entry}")

    def add(self, name: str, values: Any) -> None:
        """A child of the line."""
        self.assembly.add(f"{self.line.path}.{name}", values, self.line.where)

    def join(self, one: str, two: str) -> None:
        """Connect two children."""
        refs = []
        for text in (one, two):
            child, _, port = text.rpartition(".")
            refs.append(PortRef(f"{self.line.path}.{child}", port))
        self.assembly.joins.append(Join(tuple(refs), self.line.where))

    def mass(self, name: str) -> float:
        """Mass of a node [kg]."""
        return float(self.assembly.instances[f"{self.line.path}.{name}"].values.mass)

    @functools.cached_property
    def prescribed(self) -> set[str]:
        """Paths of all instances that a motion source drives directly."""
        instances = self.assembly.instances
        driven = (
            join.ports
            for join in self.assembly.joins
            if any(hasattr(instances[r.instance].type, "prescribes") for r in join.ports)
        )
        return {ref.instance for ports in driven for ref in ports}
