"""Whether the equations determine the unknowns: a matching of unknowns with equations, by structure alone.

At a point with its zones frozen the rates of differential unknowns and the values of algebraic ones are to be
found. Each needs an equation of its own that contains it: a perfect matching in the graph

    differential unknown j -- row i    M_ij may be non-zero in the zones in force
    algebraic unknown j    -- row i    df_i/dy_j may be non-zero in them

The zones are those a run begins in, the first of each component. An unknown left over, with all that
alternating paths lead to from it, is the underdetermined part (Dulmage and Mendelsohn 1958), named by its nodes.
Where all are matched, parts that ask for differences of potentials alone are left, see common_level.py.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable, Iterator

import numpy as np

from fairlead.component.base import Family
from fairlead.component.declare import ELECTRICAL, ROTATIONAL
from fairlead.component.instantiate import PortRef
from fairlead.component.keys import INPUT, OWN, PORT, key
from fairlead.component.replies import is_bundled
from fairlead.errors import Fault, Location
from fairlead.flatten.flat_model import FlatModel, Node
from fairlead.flatten.graph import connected_parts, of_paths
from fairlead.system.arrays.blocks import Block
from fairlead.system.arrays.shares import shares
from fairlead.system.assembly.algebraic_nodes import rows_without_rates
from fairlead.system.assembly.begin_open import holding, may_open, sharing
from fairlead.system.assembly.common_level import Open as WithoutLevel
from fairlead.system.assembly.common_level import said_of, without_level
from fairlead.system.assembly.left_open import OPEN, as_written
from fairlead.system.assembly.light_holds import held_entries, light_parts, relations
from fairlead.system.numbering.unknowns import Numbering, part_rows

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
    parts = _unmatched(_incidence(flat, numbering, blocks, start=True))
    if not parts:
        return [_levelless(flat, one) for one in without_level(flat, blocks)], frozenset()
    always = set().union(*_unmatched(_incidence(flat, numbering, blocks, start=False)))
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
    for block in blocks:
        s = block.kernel.structure
        holds = any(s.zones[0] in zones for zones in s.holds.values())
        ports = [one.name for one in map(key, s.inputs) if one.is_speed]
        for port in (PortRef(instance.path, name) for instance in block.instances for name in ports):
            index, _, _ = flat.place(port)
            group = flat.groups[index]
            if group.free and group.domain.mechanical and index not in numbering.rate:
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
                hangs, way_out = OPEN[nodes[0].domain.name].hangs, OPEN[nodes[0].domain.name].anchor
            yield Fault(_written(flat, nodes[0]), f"{_named(flat, nodes)} {hangs}.", way_out)


def _levelless(flat: FlatModel, one: WithoutLevel) -> Fault:
    """The fault of a part whose common level nothing determines."""
    nodes = [flat.nodes[number] for k in one.groups for number in flat.groups[k].nodes]
    words = OPEN[nodes[0].domain.name]
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
    cannot, many = sharing(blocks, wanted)
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
        return OPEN[node.domain.name].way_out
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


def _incidence(flat: FlatModel, numbering: Numbering, blocks: list[Block], *, start: bool) -> list[set[int]]:
    """Per unknown the rows that may contain it: its rate if it is differential, else itself."""
    rows_of: list[set[int]] = [{j} if u.differential else set() for j, u in enumerate(numbering.unknowns)]
    algebraic = np.array([not u.differential for u in numbering.unknowns])
    rated = {numbering.rate[index] for index in numbering.rated}
    for x, v in numbering.pairs:
        if algebraic[v]:
            rows_of[v] |= {x, v} if v in rated else {x}
    for index, a in numbering.accelerated.items():
        rows_of[a] |= {a, numbering.rate[index]}
    balances = part_rows(flat, numbering)
    for part in balances:
        if part.acceleration < numbering.n and part.mass > 0:
            rows_of[part.acceleration].add(part.row)
    to_whole = {part.row: part.whole for part in balances if part.whole < numbering.n}
    signals = _Signals(numbering, blocks, algebraic)
    for block in blocks:
        s = block.kernel.structure
        for zone in s.zones[:1] if start else s.zones:
            for k, target in enumerate(s.targets):
                for one in s.flow_inputs[zone].get(target, ()):
                    _enter(rows_of, block, k, s.inputs.index(one), signals, to_whole)
    _enter_rates(rows_of, numbering, blocks, algebraic, start=start)
    for pair in numbering.circles:
        force = numbering.own[pair.path, pair.unknown]
        sharing = {force, *(numbering.share[index] for index, _ in pair.ends if index in numbering.share)}
        for at in sharing:
            rows_of[at] |= sharing
    return rows_of


def _enter_rates(
    rows_of: list[set[int]], numbering: Numbering, blocks: list[Block], algebraic: np.ndarray, *, start: bool
) -> None:
    """Rows that hold contain the rates of the speeds they hold, also those they hold through nodes without inertia."""
    without, held = rows_without_rates(blocks, numbering), set[int]()
    for block in blocks:
        s = block.kernel.structure
        for unknown, j in s.mass:
            if s.zones[0] in s.holds[unknown] or not start:
                row, column = block.flow_index[:, s.targets.index(f"own:{unknown}")], block.in_index[:, j]
                held.update(row.tolist())
                in_mass = (column < numbering.n) & ~np.isin(row, without)
                for r, c in zip(row[in_mass].tolist(), column[in_mass].tolist(), strict=True):
                    if not algebraic[c]:
                        rows_of[c].add(r)
    for r, c in relations(light_parts(blocks, held_entries(blocks, shares(blocks)[0], numbering), numbering)):
        if r in held:
            rows_of[c].add(r)


def _enter(rows_of: list[set[int]], block: Block, k: int, j: int, signals: _Signals, to_whole: dict[int, int]) -> None:
    """Target k of every instance contains input j; with the balance of a part, that of its body too."""
    n, algebraic = signals.n, signals.algebraic
    for row, z in zip(block.flow_index[:, k].tolist(), block.in_index[:, j].tolist(), strict=True):
        if row < n:
            for column in (z,) if z < n else signals.columns(z - n):
                if algebraic[column]:
                    rows_of[column] |= {row, to_whole.get(row, row)}


class _Signals:
    """Which algebraic unknowns the value of a signal depends on, through other signals too."""

    def __init__(self, numbering: Numbering, blocks: list[Block], algebraic: np.ndarray) -> None:
        self.n, self.dump, self.algebraic = numbering.n, numbering.dump, algebraic
        self.blocks = blocks
        self.known: dict[int, set[int]] = {}

    @functools.cached_property
    def inputs(self) -> dict[int, list[int]]:
        """Per signal, the places in z that it reads."""
        found: dict[int, list[int]] = {}
        for block in self.blocks:
            for k, j in block.kernel.structure.d_signals:
                for signal, z in zip(block.sig_index[:, k].tolist(), block.in_index[:, j].tolist(), strict=True):
                    if signal != self.dump:
                        found.setdefault(signal - self.n, []).append(z)
        return found

    def columns(self, signal: int) -> set[int]:
        """The unknowns a signal depends on; empty for reactions, zero and time."""
        if signal not in self.known:
            self.known[signal] = set()
            for z in self.inputs.get(signal, ()):
                self.known[signal] |= ({z} if self.algebraic[z] else set()) if z < self.n else self.columns(z - self.n)
        return self.known[signal]


def _unmatched(rows_of: list[set[int]]) -> list[set[int]]:
    """Unknowns that a maximum matching leaves over, each with all that alternating paths lead to; disjoint parts."""
    row_of = {column: column for column, rows in enumerate(rows_of) if column in rows}
    column_of = dict(row_of)
    parts: list[set[int]] = []
    for column in range(len(rows_of)):
        reached = set() if column in row_of else _augment(column, rows_of, row_of, column_of)
        if reached:
            joined = [part for part in parts if part & reached]
            parts = [part for part in parts if not part & reached] + [reached.union(*joined)]
    return parts


def _augment(column: int, rows_of: list[set[int]], row_of: dict[int, int], column_of: dict[int, int]) -> set[int]:
    """Match one more unknown along an alternating path (breadth first), or return the unknowns it could reach."""
    came_from: dict[int, int] = {}  # row -> the unknown it was reached from
    reached, queue = {column}, [column]
    for current in queue:
        for row in rows_of[current] - came_from.keys():
            came_from[row] = current
            if row not in column_of:
                _flip(row, column, came_from, row_of, column_of)
                return set()
            if column_of[row] not in reached:
                reached.add(column_of[row])
                queue.append(column_of[row])
    return reached


def _flip(row: int, column: int, came_from: dict[int, int], row_of: dict[int, int], column_of: dict[int, int]) -> None:
    """Give every unknown on the path back to `column` the row it was reached through."""
    while True:
        owner = came_from[row]
        before = row_of.get(owner)
        row_of[owner], column_of[row] = row, owner
        if owner == column or before is None:
            return
        row = before
