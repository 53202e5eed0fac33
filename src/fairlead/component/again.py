"""The assembly of a netlist with other values, from one that is there.

Entries of the netlist that were given other values are read, and expanded, again. As long as that gives the same
children, connections and ports, nothing is connected anew. Lines are not laid anew either, as long as what the line
and its route say of each other is the same but for parts, such as curves of friction: laying hands them on to the
children it makes without a look inside (`Assembly.handed_on`), so those children are made again, and only those.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace

from fairlead.component.alike import Parts, agree
from fairlead.component.assembly import Assembly, HandedOn, Instance, Line, PortRef
from fairlead.component.base import Composite, Declared, Expansion
from fairlead.component.composition import expanded
from fairlead.component.instantiate import left_open, read_entry
from fairlead.component.levels import dimensions_of_levels
from fairlead.component.scene import Scene, Tally
from fairlead.component.values import Values, variant_of
from fairlead.errors import Fault, ModelError
from fairlead.netlist.netlist import Entry, Netlist, Value

OF_MOTION = ("inertia", "start", "ties", "prescribes", "starts_at")
"""Methods by which a component takes part in what moves with what: when its values change, that is found anew."""


class Unlike(Exception):
    """The netlist cannot be had by other values in an assembly that is there."""


@dataclass
class Again:
    """One assembly made from another: which leaves have other values, and what stands in the place of parts."""

    old: Assembly
    changed: dict[str, tuple[Values, Values]] = field(default_factory=dict)  # leaves: what they were expanded with
    expansions: dict[str, Expansion] = field(default_factory=dict)
    entries: dict[str, Values] = field(default_factory=dict)
    lines: dict[str, Line] = field(default_factory=dict)
    open_inputs: dict[PortRef, float] = field(default_factory=dict)
    parts: Parts = field(default_factory=dict)
    handed_on: list[HandedOn] = field(default_factory=list)
    swapped: dict[int, Values] = field(default_factory=dict)  # by the identity of what was made from parts

    def read(self, entry: Entry, kind: type[Declared], probe: Assembly) -> None:
        """An entry that was given other values, as the empty assembly `probe` reads it. Raises Unlike."""
        faults: list[Fault] = []
        known = dimensions_of_levels(kind, self.old.netlist.components[entry.name].parameters)
        levels = dimensions_of_levels(kind, entry.parameters)
        if any(known.get(name) != dimension for name, dimension in levels.items()):  # asked of the signal joined there
            raise Unlike
        values = read_entry(probe, kind, entry.parameters, entry.name, entry.where, faults)
        if faults or values is None:
            raise Unlike
        self.entries[entry.name] = values
        self.place(entry.name, self.old.entries[entry.name], values, probe.scene)

    def place(self, path: str, before: Values, values: Values, scene: Scene) -> None:
        """Values of a leaf or of a composite, however deep. Raises Unlike."""
        if before.type is not values.type or before.effects != values.effects:
            raise Unlike
        if not issubclass(values.type, Composite):
            self.leaf(path, before, values)
            return
        was: Expansion = self.old.expansions[path]
        now = expanded(values, scene)
        same = (was.connections, was.ports, was.outputs) == (now.connections, now.ports, now.outputs)
        if not same or list(was.children) != list(now.children):
            raise Unlike
        other = {name: child for name, child in now.children.items() if not agree(was.children[name], child)}
        self.expansions[path] = replace(now, children={**was.children, **other})
        for name, child in other.items():
            self.place(f"{path}.{name}", was.children[name], child, scene)
        gives = left_open(path, values, self.old.aliases)
        if gives.keys() != left_open(path, before, self.old.aliases).keys():  # another input has to be joined
            raise Unlike
        self.open_inputs |= gives
        if now.line is not None:
            found = was.line.handed_on(now.line)
            if found is None:
                raise Unlike
            self.parts |= found
            self.lines[path] = replace(self.old.lines[path], values=values, line=now.line)

    def leaf(self, path: str, before: Values, values: Values) -> None:
        """Other values of a leaf, which changes neither its code nor what moves with what. Raises Unlike."""
        takes_part = any(getattr(values.type.answers, name) is not None for name in OF_MOTION)
        if takes_part or variant_of(values) != variant_of(before):
            raise Unlike
        values.variant = before.variant
        self.changed[path] = (before, values)

    def hand_on(self, scene: Scene) -> None:
        """What was made from parts, made from what stands in their place. Raises Unlike when its code changes."""
        for record in self.old.handed_on:
            others = {name: self.parts[id(value)] for name, value in record.given.items() if id(value) in self.parts}
            given, made = {**record.given, **{name: other.now for name, other in others.items()}}, record.made
            if any(other.differs for other in others.values()):
                made = scene.make(record.kind, **given)
                if variant_of(made) != variant_of(record.made):
                    raise Unlike
                made.variant = record.made.variant
                self.swapped[id(record.made)] = made
            self.handed_on.append(HandedOn(made, record.kind, given))


def again(
    old: Assembly, instances: Iterable[Instance], netlist: Netlist, types: Mapping[str, type[Declared]]
) -> Assembly | None:
    """The assembly of `netlist`; None if it has to be made from the beginning.

    `instances` are the leaves of `old` before statics has cut lines.
    """
    was = old.netlist
    if old.broken or not (_same(was.friction, netlist.friction) and _same(was.effects, netlist.effects)):
        return None
    if [(e.name, e.type) for e in was.components.values()] != [(e.name, e.type) for e in netlist.components.values()]:
        return None
    scene = replace(old.scene, friction=netlist.friction, effects=netlist.effects, tally=Tally())
    made = Again(old)
    try:
        for name, entry in netlist.components.items():
            if not _same(was.components[name].parameters, entry.parameters):
                made.read(entry, types[entry.type], Assembly(netlist, scene))
        made.hand_on(scene)
    except (Unlike, ModelError):  # what is wrong is told when all is made anew
        return None
    leaves = {instance.path: instance for instance in instances}
    if any(path not in leaves or leaves[path].values is not before for path, (before, _) in made.changed.items()):
        return None  # others have taken the place of those that were expanded
    for path, (_, values) in made.changed.items():
        leaves[path] = replace(leaves[path], values=values)
    swapped = [leaf for leaf in leaves.values() if id(leaf.values) in made.swapped]
    leaves.update({leaf.path: replace(leaf, values=made.swapped[id(leaf.values)]) for leaf in swapped})
    return replace(
        old, netlist=netlist, scene=scene, instances=leaves, lines={**old.lines, **made.lines},
        expansions={**old.expansions, **made.expansions}, entries={**old.entries, **made.entries},
        handed_on=made.handed_on, open_inputs={**old.open_inputs, **made.open_inputs},
    )  # fmt: skip


def _same(one: Mapping[str, Value], other: Mapping[str, Value]) -> bool:
    """True for the same values, wherever they are written."""
    return one is other or ({n: v.plain() for n, v in one.items()} == {n: v.plain() for n, v in other.items()})
