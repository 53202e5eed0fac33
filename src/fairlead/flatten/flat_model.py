"""The flat model: nodes, kinematic groups and signal links of all leaves. Frozen, printable."""

from __future__ import annotations

import functools
import itertools
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from fairlead.brief import in_a_line
from fairlead.component.assembly import Assembly, Instance, Kind, PortRef
from fairlead.component.declare import Domain


@dataclass(frozen=True)
class Node:
    """Ports joined together: one motion, pressure or voltage; what they take in sums to zero."""

    ports: tuple[PortRef, ...]
    domain: Domain

    @property
    def name(self) -> str:
        """The ports in braces, as messages name a node."""
        shown = ", ".join(map(str, self.ports[:6]))
        return "{" + shown + (", ..." if len(self.ports) > 6 else "") + "}"


@dataclass(frozen=True)
class Prescribed:
    """Motion given by an instance: its outputs for position, rate and acceleration, or rest (None)."""

    by: PortRef
    outputs: tuple[str, str, str] | None


@dataclass(frozen=True)
class Group:
    """Nodes tied rigidly together: one degree of freedom.

    Node k moves with  ratio_k * group + offset_k,  and what its ports take in counts ratio_k times.
    """

    name: str
    domain: Domain
    nodes: tuple[int, ...]
    ratios: tuple[float, ...]
    offsets: tuple[float, ...]
    mass: float  # inertia at the group [kg, kg m^2, or capacity]
    start: tuple[float, float]  # position (or potential) and rate at the start
    prescribed: Prescribed | None
    given: tuple[bool, bool] = (False, False)  # whether a component gives that position, that rate
    free: bool = field(init=False, repr=False, compare=False)
    """True when the motion is unknown."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "free", self.prescribed is None)


@dataclass(frozen=True)
class SignalLoop:
    """Signals that decide one another at once: behind which output they are cut, and the instances in their order."""

    output: PortRef
    through: tuple[str, ...]


@dataclass(frozen=True)
class FlatModel:
    """All that is needed to write equations; `str()` lists it."""

    __repr__ = in_a_line

    assembly: Assembly
    instances: tuple[Instance, ...]
    nodes: tuple[Node, ...]
    groups: tuple[Group, ...]
    node_of: dict[PortRef, int]
    group_of: dict[int, tuple[int, float, float]]  # node -> group, ratio, offset
    sources: dict[PortRef, PortRef] = field(default_factory=dict)  # input -> output that feeds it
    loops: tuple[SignalLoop, ...] = ()  # of signals, cut when the model is compiled (system/numbering/loops.py)

    def place(self, port: PortRef) -> tuple[int, float, float]:
        """Group, ratio and offset of a port."""
        return self.places[port]

    @functools.cached_property
    def places(self) -> Mapping[tuple[str, str], tuple[int, float, float]]:
        """Group, ratio and offset of every port, by path and name: a PortRef, or the two, is what it is asked by."""
        return {port: self.group_of[node] for port, node in self.node_of.items()}

    def those(self, fits: Callable[[Kind], object]) -> list[Instance]:
        """The instances whose class fits, in their order; a class is asked once, and a long line has thousands."""
        chosen = [places for kind, places in self._of_class.items() if fits(kind)]
        return [self.instances[k] for k in (chosen[0] if len(chosen) == 1 else sorted(itertools.chain(*chosen)))]

    @functools.cached_property
    def _of_class(self) -> dict[Kind, list[int]]:
        found: dict[Kind, list[int]] = {}
        for k, instance in enumerate(self.instances):
            found.setdefault(instance.type, []).append(k)
        return found

    def __str__(self) -> str:
        free = sum(group.free for group in self.groups)
        lines = [f"{len(self.instances)} components, {len(self.nodes)} nodes, {free} free of {len(self.groups)} groups"]
        for group in self.groups:
            how = "free" if group.free else f"prescribed by {group.prescribed.by}"  # type: ignore[union-attr]
            nodes = "; ".join(self.nodes[n].name for n in group.nodes)
            lines.append(f"  {group.name}: {how}, inertia {group.mass:g}, {nodes}")
        lines += [f"  {target} <- {source}" for target, source in self.sources.items()]
        return "\n".join(lines)
