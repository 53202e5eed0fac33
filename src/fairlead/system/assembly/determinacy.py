"""Whether the equations determine the unknowns: a matching of unknowns with equations, by structure alone.

Each unknown needs an equation of its own that contains it: incidence.py says which may, in the zones a run begins in,
the first of each component, and matching.py finds what is left over. That part is blamed here, by the names of its
nodes or components, with a way out. Where all are matched, parts that ask for differences of potentials alone are left,
see common_level.py.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from fairlead.component.assembly import PortRef
from fairlead.component.base import Family
from fairlead.component.declare import ELECTRICAL, ROTATIONAL
from fairlead.component.keys import INPUT, OWN, PORT, key
from fairlead.component.replies import is_bundled
from fairlead.errors import Fault, Location
from fairlead.flatten.flat_model import FlatModel, Node
from fairlead.flatten.graph import connected_parts, of_paths
from fairlead.system.arrays.blocks import Block
from fairlead.system.assembly.begin_open import holding, may_open, never_sharing
from fairlead.system.assembly.common_level import Levelless, said_of, without_level
from fairlead.system.assembly.incidence import incidence
from fairlead.system.assembly.left_open import WORDS, as_written
from fairlead.system.assembly.matching import unmatched
from fairlead.system.numbering.unknowns import Numbering

IN_SERIES = (
    "Write their inductances as one: give one of them the sum, and take the other out (or a Resistor in its place). A "
    "Resistor or a Capacitor from the node to an Earth would do, too."
)
MOST_NAMED = 4  # nodes or components in one message
THROUGH = {"translational": "force", "rotational": "torque", "hydraulic": "pressure", "electrical": "voltage",
           "thermal": "temperature"}  # fmt: skip


def undetermined(
    flat: FlatModel, numbering: Numbering, blocks: list[Block]
) -> tuple[list[Fault], frozenset[str]]:
    """Parts of the model that its equations leave open, each with its nodes and a way out; and contacts to begin open.

    Those are of circles with a gear of three shafts that move, if all contacts of them hold: how they would share is
    not known, and seldom asked. Clutches and brakes of an automatic gearbox, pressed in turn, never hold all at once.
    """
    faults = [*_unknown_speeds(flat, numbering, blocks), *_floating(flat, blocks)]
    if faults or all(unknown.differential for unknown in numbering.unknowns):
        return faults, frozenset()
    parts = unmatched(incidence(flat, numbering, blocks, start=True))
    if not parts:
        return [_levelless(flat, one) for one in without_level(flat, blocks)], frozenset()
    always = set().union(*unmatched(incidence(flat, numbering, blocks, start=False)))
    to_open: set[str] = set()
    for part in parts:
        contacts = set() if part & always else may_open(flat, numbering, blocks, part)
        to_open |= contacts
        if not contacts:
            faults.append(_open(flat, numbering, blocks, part, always=bool(part & always)))
    return faults, frozenset(to_open)


def _unknown_speeds(flat: FlatModel, numbering: Numbering, blocks: list[Block]) -> Iterator[Fault]:
    """A node held by springs alone has a position and no speed; whoever reads its speed would read nothing."""
    readers: dict[int, list[PortRef]] = {}
    holders: dict[int, list[str]] = {}
    without = {k for k, one in enumerate(flat.groups) if one.free and one.domain.mechanical and k not in numbering.rate}
    for block in blocks if without else ():
        s = block.kernel.structure
        holds = any(s.zones[0] in zones for zones in s.holds.values())
        ports = [one.name for one in map(key, s.inputs) if one.is_speed]
        for port in (PortRef(instance.path, name) for instance in block.instances for name in ports):
            if flat.place(port)[0] in without:
                readers.setdefault(flat.node_of[port], []).append(port)
                holders.setdefault(flat.node_of[port], []).extend([port.instance] if holds else [])
    for number, ports_ in readers.items():
        node = flat.nodes[number]
        if holders[number]:
            what = f"has no mass and no law determines its {THROUGH[node.domain.name]} while {_hold(holders[number])}"
        else:
            what = f"has no mass and no damping, so its speed is not determined; {_and(map(str, ports_))} would read it"
        joined = len(holders[number]) == len(node.ports) == 2
        yield Fault(_written(flat, node), f"node {node.name} {what}.", _way_out(node, joined))


def _floating(flat: FlatModel, blocks: list[Block]) -> Iterator[Fault]:
    """Parts without any mass that hang on nothing whose motion is known: only their shape is determined."""
    anchors = [k for k, group in enumerate(flat.groups) if not group.free or group.mass > 0]
    if len(anchors) == len(flat.groups):
        return
    joints: list[list[int]] = []
    for block in blocks:
        has, moved = block.kernel.variant.type.declaration, _depends_on_motion(block)
        for instance in block.instances:
            ports = (PortRef(instance.path, name) for name in has.ports)
            joined = [flat.place(port)[0] for port in ports if port in flat.node_of]
            joints.append(joined)
            anchors += joined[:1] if has.states or (len(joined) == 1 and moved) else []
    held = set(anchors)
    for groups in connected_parts(of_paths(range(len(flat.groups)), joints)):
        if held.isdisjoint(groups):
            nodes = [flat.nodes[number] for k in sorted(groups) for number in flat.groups[k].nodes]
            hangs = "hang together without any mass, and on no fixed or driven point"
            turning = all(node.domain.name == "rotational" for node in nodes)
            way_out = f"Join one of them to {'a Housing' if turning else 'a Ground'} or a source of motion, "
            way_out += "or add an Inertia." if turning else "or add a Mass."
            if not any(node.domain.mechanical for node in nodes):
                hangs, way_out = WORDS[nodes[0].domain.name].hangs, WORDS[nodes[0].domain.name].anchor
            yield Fault(_written(flat, nodes[0]), f"{_named(flat, nodes)} {hangs}.", way_out)


def _levelless(flat: FlatModel, one: Levelless) -> Fault:
    """The fault of a part whose common level nothing determines."""
    nodes = [flat.nodes[number] for k in one.groups for number in flat.groups[k].nodes]
    words = WORDS[nodes[0].domain.name]
    plain = said_of(one.keeping, words.quantity)
    if len(nodes) == 1:
        plain = plain.replace("are joined", "is joined", 1).replace("of their", "of its")
    return Fault(_written(flat, nodes[0]), f"{_named(flat, nodes)} {plain}.", words.level)


def _depends_on_motion(block: Block) -> bool:
    """True when what a component takes in depends on its ports, or on a signal."""
    uses = [keys for zone in block.kernel.structure.flow_inputs.values() for keys in zone.values()]
    return any(key(one).kind in (PORT, INPUT) for keys in uses for one in keys)


def _open(flat: FlatModel, numbering: Numbering, blocks: list[Block], part: set[int], *, always: bool) -> Fault:
    """The fault of one underdetermined part."""
    groups = [k for k, at in {**numbering.position, **numbering.rate}.items() if part & {at, numbering.balance[k]}]
    nodes = [flat.nodes[number] for k in groups if not flat.groups[k].mass for number in flat.groups[k].nodes]
    owners = dict.fromkeys(path for (path, _), at in numbering.own.items() if at in part)
    near = dict.fromkeys([*owners, *(port.instance for node in nodes for port in node.ports)])
    while_ = "" if always else _zones_at_start(blocks, set(near))
    if coils := _in_series(nodes, blocks):
        what = f"{_named(flat, nodes[:1])} joins {_and(coils)} in series, and each has a current of its own: no law "
        what += f"determines the voltage between them{while_}."
        return Fault(_written(flat, nodes[0]), what, IN_SERIES)
    if nodes:
        lacks = "has no mass and no" if nodes[0].domain.mechanical else "has nothing that gives way, and no"
        what = f"{_named(flat, nodes)} {lacks} law determines its {THROUGH[nodes[0].domain.name]}{while_}."
        return Fault(_written(flat, nodes[0]), what, _way_out(nodes[0], joined=False))
    if owners and owners.keys() <= holding(blocks):
        what = f"{_hold(owners)} in a closed circle, and {_unequal(blocks, owners)}, so how they share is not known."
        way_out = _apart(flat, owners)
        return Fault(flat.assembly.instances[next(iter(owners))].where, what, way_out)
    names = [f"{path}.{name}" for (path, name), at in numbering.own.items() if at in part]
    what = f"{_and(names)}: no equation determines {'it' if len(names) == 1 else 'them'}{while_}."
    if index := max((_index(block, owners) for block in blocks), default=1) - 1:
        motion = ("speeds", "positions")[index - 1]
        what = f"{what[:-1]}: what must be zero reads {motion} and not the unknown, so the index is {index + 1}, not 1."
        way_out = (
            "Write hold(slip) for a sum of speeds that stays zero, hold_position(gap) for a relation of positions that "
            "does, or a stiff spring and a damper for the force."
        )
        return Fault(flat.assembly.instances[next(iter(owners))].where, what, way_out)
    way_out = "Its law must say what is zero for it, or hold(slip), and that must depend on it or on a free motion."
    return Fault(flat.assembly.instances[next(iter(owners))].where, what, way_out)


def _in_series(nodes: list[Node], blocks: list[Block]) -> list[str]:
    """The parts at the first of these nodes, if they are electrical and the current of each is a state of its own."""
    if not nodes or nodes[0].domain.name != ELECTRICAL.name:
        return []
    kept = {port for block in blocks for port in _kept_flows(block)}
    found = [port.instance for port in nodes[0].ports]
    return found if len(set(found)) > 1 and set(nodes[0].ports) <= kept else []


def _kept_flows(block: Block) -> Iterator[PortRef]:
    """Ports whose flow is a state of the part, and nothing else."""
    uses = block.kernel.structure.flow_inputs[block.kernel.structure.zones[0]]
    states = set(block.kernel.variant.type.declaration.states)
    for target, keys in uses.items():
        if key(target).kind == PORT and keys and all(key(k).kind == OWN and key(k).name in states for k in keys):
            yield from (PortRef(instance.path, key(target).name) for instance in block.instances)


def _index(block: Block, owners: Iterable[str]) -> int:
    """Index of the equations if a law of these asks for motions alone: 2 for speeds, 3 for positions; else 1."""
    s = block.kernel.structure
    if not set(owners) & {instance.path for instance in block.instances}:
        return 1
    asked = [keys for target, keys in s.flow_inputs[s.zones[0]].items() if key(target).kind == OWN]
    of_motion = [keys for keys in asked if keys and all(key(one).kind == PORT for one in keys)]
    return max((2 if any(key(one).is_speed for one in keys) else 3 for keys in of_motion), default=1)


def _unequal(blocks: list[Block], owners: Iterable[str]) -> str:
    """The words for holds that cannot share: force and slip are not joined by numbers (see `held_pairs`)."""
    wanted = set(owners)
    cannot, many = never_sharing(blocks, wanted)
    if many and not cannot:
        return f"{_and(many)} join{'s' if len(many) == 1 else ''} more than two bodies that move"
    return f"the force of {_and(cannot or wanted)} does not act on its ports with fixed numbers, those of its slip"


def _apart(flat: FlatModel, owners: Iterable[str]) -> str:
    """What to do where these hold in a closed circle: with the parts as they are, and with a law of one's own."""
    mine = [flat.assembly.instances[path] for path in owners]
    contacts = [part.path for part in mine if issubclass(part.type, Family)]
    gears = [part for part in mine if part.path not in contacts] or mine  # a contact of shafts lies between two rims
    domains = {port.domain.name for part in gears for port in part.type.declaration.ports.values()}
    turning = domains == {ROTATIONAL.name}
    spring, body = ("a TorsionSpring", "an Inertia") if turning else ("a Spring", "a Mass")
    one = f"one of {_and(contacts)}" if len(contacts) > 1 else contacts[0] if contacts else ""
    ways = [f"write method: binding for {one} (friction: {{method: binding}} for all)"] if contacts else []
    ways += [f"put {spring} between one of them and its body", f"{body} where a node has none"]
    said = f"{', '.join(ways[:-1])}, or {ways[-1]}."
    if not all(is_bundled(part.type) for part in mine):
        said += " In a law of your own, leave ratios to a Gear or a Rack and write hold(b.v - a.v)."
    return said[0].upper() + said[1:]


def _zones_at_start(blocks: list[Block], paths: set[str]) -> str:
    """The words that say in which zones those of the components that have some begin."""
    said = []
    for block in blocks:
        zones = block.kernel.structure.zones
        said += [f"{i.path} is {zones[0]}" for i in block.instances if len(zones) > 1 and i.path in paths]
    return f" while {_and(said)}" if said else ""


def _written(flat: FlatModel, node: Node) -> Location:
    """Where a connection of the node is written, else its first component."""
    for join in flat.assembly.joins:
        if join.ports[0] in node.ports:
            return join.where
    return flat.assembly.instances[node.ports[0].instance].where


def _way_out(node: Node, joined: bool) -> str:
    if not node.domain.mechanical:
        return WORDS[node.domain.name].way_out
    body = "a Mass" if node.domain.name == "translational" else "an Inertia"
    if joined:
        return f"Add {body} there, join the two contacts into one, or write friction: {{method: binding}}."
    return f"Add {body} there, or a damper to something that moves freely."


def _ports(flat: FlatModel, node: Node) -> str:
    names = as_written(flat, node)
    return ", ".join(names[:6]) + (", ..." if len(names) > 6 else "")


def _named(flat: FlatModel, nodes: list[Node]) -> str:
    names = [f"{{{_ports(flat, node)}}}" for node in nodes[:MOST_NAMED]]
    return f"node{'s' if len(names) > 1 else ''} {_and(names)}{' and more' if len(nodes) > MOST_NAMED else ''}"


def _hold(paths: Iterable[str]) -> str:
    names = list(dict.fromkeys(paths))
    return f"{_and(names)} hold{'s' if len(names) == 1 else ''}"


def _and(names: Iterable[str]) -> str:
    *first, last = list(names)[: 2 * MOST_NAMED]
    return f"{', '.join(first)} and {last}" if first else last
