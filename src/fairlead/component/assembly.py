"""What the stage of components hands to the next: the leaves of a model, their numbers, and who is joined to whom."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple, TypeVar, cast

from fairlead.brief import in_a_line
from fairlead.component.base import Declared, Expansion
from fairlead.component.scene import Scene, TooManyParts
from fairlead.component.values import Values, Variant, variant_of
from fairlead.errors import Location
from fairlead.netlist.netlist import Netlist

Kind = type[Declared]
V = TypeVar("V")


@dataclass(frozen=True)
class Instance:
    """One leaf component: its path in the model, its class and numbers, and where it was written."""

    path: str
    values: Values
    where: Location
    variant: Variant
    type: Kind = field(init=False, repr=False, compare=False)
    """The component class."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "type", self.values.type)

    def __str__(self) -> str:
        return f"{self.path}: {self.variant.label}    {self.where}"


def of_classes(instances: Iterable[Instance], fits: Callable[[Kind], object]) -> list[Instance]:
    """Those whose class fits, in their order; a class is asked once, as a long line has thousands of each."""
    asked: dict[Kind, object] = {}
    found = []
    for instance in instances:
        kind = instance.type
        if kind not in asked:
            asked[kind] = fits(kind)
        if asked[kind]:
            found.append(instance)
    return found


def with_other(instance: Instance, **given: Any) -> Instance:
    """The same component with some other values, of the same variant."""
    old = instance.values
    values = Values(old.type, {**old.given, **given})
    values.variant, values.effects = old.variant, old.effects
    return replace(instance, values=values)


class PortRef(NamedTuple):
    """A port, input or output of a leaf."""

    instance: str
    port: str

    def __str__(self) -> str:
        return f"{self.instance}.{self.port}"


def asked_by_two(known: Mapping[PortRef, V]) -> Mapping[tuple[str, str], V]:
    """The same map, to be asked by (path, name): that equals the PortRef, and is made in a tenth of the time."""
    return cast(Any, known)


class Join(NamedTuple):
    """Ports that were written as connected, and where."""

    ports: tuple[PortRef, ...]
    where: Location


@dataclass(frozen=True)
class Line:
    """A composite that runs along a route: its path, what it says of itself, and where it was written."""

    __repr__ = in_a_line

    path: str
    values: Values
    line: Any
    where: Location


@dataclass(frozen=True)
class HandedOn:
    """Values of a child that were made with parts of a line or a route, such as a curve: of what kind, from what."""

    made: Values
    kind: type[Declared]
    given: dict[str, Any]


@dataclass
class Assembly:
    """All leaves of a model with their joins; lines and routes wait for the flattening."""

    netlist: Netlist
    scene: Scene
    types: Mapping[str, type[Declared]] = field(default_factory=dict)
    instances: dict[str, Instance] = field(default_factory=dict)
    joins: list[Join] = field(default_factory=list)
    lines: dict[str, Line] = field(default_factory=dict)
    routings: list[tuple[str, str, Location]] = field(default_factory=list)  # the two ends of a `path` connection
    aliases: dict[str, PortRef] = field(default_factory=dict)  # outer name of an output or port -> the inner one
    effects: dict[str, dict[str, str]] = field(default_factory=dict)  # component -> its effects, on or off
    broken: set[str] = field(default_factory=set)  # components of the netlist that could not be made
    stand_ins: set[str] = field(default_factory=set)  # made with other values, for there are mistakes in their own
    entries: dict[str, Values] = field(default_factory=dict)  # of the components of the netlist
    expansions: dict[str, Expansion] = field(default_factory=dict)  # of composites, however deep
    handed_on: list[HandedOn] = field(default_factory=list)  # where laying passed on parts as they are
    open_inputs: dict[PortRef, float] = field(default_factory=dict)  # what composites give to inputs left open
    excused: set[PortRef] = field(
        default_factory=set
    )  # ports joined to what could not be read: not open, if unconnected

    def add(self, path: str, values: Values, where: Location) -> None:
        """Add a leaf. Raises TooManyParts."""
        if self.crowded:
            raise TooManyParts
        self.instances[path] = Instance(path, values, where, variant_of(values))

    @property
    def crowded(self) -> bool:
        """Whether the scene has as many parts as it may have."""
        return self.scene.tally.full(len(self.instances))

    def excuse(self, paths: Iterable[str]) -> None:
        """Blame no port of these instances for being open: what is written about them could not be read."""
        for path in paths:
            if path in self.instances:
                has = self.instances[path].type.declaration
                self.excused.update(PortRef(path, name) for name in (*has.ports, *has.inputs))

    def named(self, ref: PortRef) -> str:
        """A port by the name that a netlist has for it: that of the outermost component that hands it out."""
        names = [alias for alias, inner in self.aliases.items() if inner == ref]
        return min((*names, str(ref)), key=lambda name: (name.count("."), name not in names))

    def __str__(self) -> str:
        joins = (f"{' -- '.join(map(str, join.ports))}    {join.where}" for join in self.joins)
        effects = (
            f"effects of {path}: {', '.join(f'{name} {word}' for name, word in switches.items())}"
            for path, switches in self.effects.items()
        )
        return "\n".join([*map(str, self.instances.values()), *joins, *effects])
