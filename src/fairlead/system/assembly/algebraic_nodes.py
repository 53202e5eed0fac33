"""Nodes without inertia whose speed no force tells in some zones: which they are, and what callbacks read of them.

Between a spring and a contact that slides the balance of a node says where it is, and not how fast it moves. Such a
node is *rated*: the rates of all flows there are added up beside its balance, d = tau dg/dt, and its row is

    0 = g + sum of share * d        over the nodes that move with it (its own share is 1 where nothing holds it)

What joins the speeds of nodes in the zones in force (rows that hold, forces that depend on a speed) decides the
shares, in `share_rates`: a node that is joined to what is known has none. docs/integrator.md, "Nodes
without inertia", has the page.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from fairlead.component.assembly import Instance, PortRef
from fairlead.component.keys import OWN, PORT, RATE, key, rate_of
from fairlead.distinct import distinct
from fairlead.errors import Fault
from fairlead.flatten.flat_model import FlatModel
from fairlead.flatten.graph import connected_parts, of_paths
from fairlead.kernels import layout
from fairlead.kernels.break_away import number_of
from fairlead.kernels.structure import Structure
from fairlead.system.arrays.blocks import Block, Integers, Memory
from fairlead.system.assembly.program import Entries
from fairlead.system.numbering.unknowns import Numbering

HELD, FIRM, SOFT = 0, 1, 2
"""What joins speeds: a row that holds, a force in proportion to a speed, one that depends on it in another way."""


class SpeedJoin(NamedTuple):
    """What joins the speeds of rated groups in one zone of an instance."""

    path: str
    zone: str
    kind: int
    groups: tuple[int, ...]
    weights: tuple[float, ...]  # what it takes in there over what it does at others; 0 where that is no number


def rated_groups(flat: FlatModel, structures: Mapping[str, Structure]) -> set[int]:
    """Groups without inertia or damping of which a law reads the speed, and whose forces know the position."""
    light = _without_inertia(flat)
    if not light:
        return set()
    read, sprung, damped = set[int](), set[int](), set[int]()
    ends: dict[int, set[int]] = {k: set() for k in light}  # groups whose motion a force at a group follows
    for instance in flat.instances:
        s = structures[instance.path]
        at = {port: flat.place(PortRef(instance.path, port))[0] for port in _ports(instance, flat)}
        if light.isdisjoint(at.values()):
            continue
        read |= {at[port] for port in _speeds_read(s) if port in at}
        for port, others in _followed(s, set(instance.type.declaration.states)).items():
            if at.get(port) in light:
                sprung.add(at[port])
                ends[at[port]] |= {at[other] for other in others if other in at}
        damped |= {at[port] for port, text in s.dampings.items() if port in at and number_of(text, instance.values)}
    found = list((read & sprung & light) - damped)
    for k in found:
        found += (ends[k] & light) - damped - set(found)
    return set(found)


def without_damping(flat: FlatModel, structures: Mapping[str, Structure]) -> set[tuple[str, str]]:
    """What would follow a speed at a node without inertia, were its coefficient not zero: component, port or zone.

    These zeros decide, with the connections, which groups are rated and which joins hold: with others, a model is of
    another structure.
    """
    light = _without_inertia(flat)
    if not light:
        return set()
    found = set()
    for instance in flat.instances:
        s = structures[instance.path]
        texts = [(port, text) for port, text in s.dampings.items()
                 if flat.place(PortRef(instance.path, port))[0] in light]  # fmt: skip
        texts += [(zone, one["slope"]) for zone, here in s.joins.items() for one in here if _kind(one) == FIRM]
        found |= {(instance.path, where) for where, text in texts if not number_of(text, instance.values)}
    return found


def _without_inertia(flat: FlatModel) -> set[int]:
    return {k for k, g in enumerate(flat.groups) if g.free and g.mass == 0 and g.domain.mechanical}


def geared_groups(flat: FlatModel, structures: Mapping[str, Structure]) -> set[int]:
    """Groups without inertia whose speed a row gives that always holds, as that of a gear."""
    found = set()
    for instance in flat.instances:
        s = structures[instance.path]
        for unknown, j in s.mass:
            ref = PortRef(instance.path, key(s.inputs[j]).name)
            if len(s.holds[unknown]) == len(s.zones) and len(s.pairs.get(unknown, ())) != 2 and ref in flat.node_of:
                index = flat.place(ref)[0]
                if flat.groups[index].free and flat.groups[index].mass == 0:
                    found.add(index)
    return found


def _ports(instance: Instance, flat: FlatModel) -> Iterator[str]:
    return (name for name in instance.type.declaration.ports if PortRef(instance.path, name) in flat.node_of)


def _speeds_read(s: Structure) -> set[str]:
    """Ports whose speeds laws read (not guards and outputs alone)."""
    held = {key(s.inputs[j]).name for _, j in s.mass}
    flows = (one for uses in s.flow_inputs.values() for keys in uses.values() for one in map(key, keys))
    return held | {one.name for one in flows if one.is_speed}


def _followed(s: Structure, states: set[str]) -> dict[str, set[str]]:
    """By port whose force a position or a state of the component's own decides: the ports whose motion it follows."""
    found: dict[str, set[str]] = {}
    for uses in s.flow_inputs.values():
        for target, keys in uses.items():
            read = [key(one) for one in keys]
            places = {one.name for one in read if one.kind == PORT and one.part == "x"}
            own = {one.name for one in read if one.kind == OWN} & states
            if key(target).kind == PORT and (places or own):
                found.setdefault(key(target).name, set()).update(places)
    return found


def touching(flat: FlatModel, groups: set[int]) -> set[str]:
    """Instances with a port in one of these groups."""
    return {ref.instance for k in groups for node in flat.groups[k].nodes for ref in flat.nodes[node].ports}


def joins(flat: FlatModel, structures: Mapping[str, Structure], groups: set[int]) -> list[SpeedJoin]:
    """All that may join the speeds of rated groups to one another, or to what is known."""
    found = []
    for instance in flat.instances:
        s = structures[instance.path]
        for zone, here in s.joins.items():
            for one in here:
                kind = _kind(one)
                if kind == FIRM and not number_of(one["slope"], instance.values):
                    continue
                weighed: dict[int, float] = {}
                for port, weight in zip(one["ports"], one["weights"], strict=True):
                    index, ratio, _ = flat.place(PortRef(instance.path, port))
                    if index in groups:
                        weighed[index] = weighed.get(index, 0.0) + ratio * weight
                if weighed:
                    found.append(SpeedJoin(instance.path, zone, kind, tuple(weighed), tuple(weighed.values())))
    return found


def _kind(join: Mapping[str, Any]) -> int:
    """What sort of join this is, as `flow_rates.joins` has written it."""
    return HELD if join["slope"] == "held" else SOFT if not join["slope"] else FIRM


def unfit_nodes(
    flat: FlatModel, structures: Mapping[str, Structure], groups: set[int]
) -> tuple[set[int], list[Fault]]:
    """Of the rated groups those that cannot be rated; where a contact may hold, a fault says why.

    Others stay as they are: bristles that are damped give the speed as long as their bend follows the slip.
    """
    holding = _holding(flat, structures, groups)
    why: dict[int, tuple[str, str]] = {}
    for instance in flat.instances:
        s = structures[instance.path]
        at = {port: flat.place(PortRef(instance.path, port))[0] for port in _ports(instance, flat)}
        for port, what in s.unrated.items():
            if at[port] in groups:
                why.setdefault(at[port], (instance.path, f"follows {what}, whose rate no law tells"))
        for source in rates_read(flat, instance, s):
            for index in groups.intersection(at.values()) if not _told(flat, structures, source) else ():
                why.setdefault(index, (instance.path, f"follows the signal {source}, whose rate no law tells"))
    for one in joins(flat, structures, groups):
        if one.kind == SOFT and (structures[one.path].holds or structures[one.path].yields):
            for index in one.groups:
                why.setdefault(index, (one.path, "varies with its slip, and where it falls the node would jump"))
    faults = [_unfit(flat, index, *told) for index, told in why.items() if index in holding]
    return set(why) - holding, faults


def _unfit(flat: FlatModel, index: int, path: str, said: str) -> Fault:
    body = "a Mass" if flat.groups[index].domain.name == "translational" else "an Inertia"
    node = flat.nodes[flat.groups[index].nodes[0]]
    what = f"node {node.name} has no mass and no damping, and the force of {path} {said}."
    way_out = f"Add {body} there, or damping beside the spring"
    if "slip" in said:
        way_out += ", or take a curve that is constant (coulomb) or grows in proportion (viscous)"
    return Fault(flat.assembly.instances[path].where, what, way_out + ".")


def rates_read(flat: FlatModel, instance: Instance, s: Structure, output: str = "") -> list[PortRef]:
    """Outputs of others whose rates a rated kernel reads, for a certain output if one is named."""
    every = list(range(len(s.inputs)))
    reads = [j for k, j in s.d_signals if s.outputs[k] == output] if output else every
    asked = (PortRef(instance.path, one.name) for one in (key(s.inputs[j]) for j in reads) if one.part == RATE)
    return sorted({flat.sources[ref] for ref in asked if ref in flat.sources}, key=str)


def _told(flat: FlatModel, structures: Mapping[str, Structure], source: PortRef) -> bool:
    """True if it is known how fast an output changes."""
    s, name = structures[source.instance], rate_of(source.port)
    instance = flat.assembly.instances[source.instance]
    return name in s.outputs and all(_told(flat, structures, one) for one in rates_read(flat, instance, s, name))


def _holding(flat: FlatModel, structures: Mapping[str, Structure], groups: set[int]) -> set[int]:
    """Rated groups at which a row may hold, and what moves with them."""
    paths: list[list[int]] = []
    found = set()
    for instance in flat.instances:
        s = structures[instance.path]
        at = {flat.place(PortRef(instance.path, port))[0] for port in _ports(instance, flat)} & groups
        paths.append(sorted(at))
        found |= {flat.place(PortRef(instance.path, key(s.inputs[j]).name))[0] for _, j in s.mass} & groups
    return {k for part in connected_parts(of_paths(sorted(groups), paths)) if found.intersection(part) for k in part}


def rated_rows(flat: FlatModel, numbering: Numbering, blocks: Sequence[Block]) -> Memory:
    """What the callbacks read of rated nodes (the names are explained in layout.py)."""
    number = {index: k for k, index in enumerate(numbering.rated)}
    structures = {i.path: block.kernel.structure for block in blocks for i in block.instances}
    machine = {i.path: block.machines[k] for block in blocks for k, i in enumerate(block.instances)}
    found = joins(flat, structures, set(number)) if number else []
    rows: list[tuple[int, ...]] = []
    members: list[int] = []
    weights: list[float] = []
    for one in found:
        zones = structures[one.path].zones
        at = machine[one.path][0] if len(zones) > 1 else -1
        rows.append((at, zones.index(one.zone), int(one.kind == SOFT), len(members), len(members) + len(one.groups)))
        members += [number[index] for index in one.groups]
        weights += one.weights
    rated, yielding = numbering.rated.items(), _yielding(flat, structures, set(number))
    places = [(numbering.balance[k], numbering.first_rate + r, int(k not in yielding)) for k, r in rated]
    return {
        "rated": np.array(places, dtype=np.int64).reshape(-1, layout.RATED_NODE),
        "rated_joins": np.array(rows, dtype=np.int64).reshape(-1, layout.JOIN),
        "rated_members": np.array(members, dtype=np.int64), "rated_weights": np.array(weights, dtype=float),
        "rated_terms": np.array(rated_terms(numbering, found), dtype=np.int64).reshape(-1, layout.TERM),
        "rated_known": np.zeros(len(number), dtype=np.int64), "rated_root": np.zeros(len(number), dtype=np.int64),
        "rated_mode": np.zeros(len(number)),
    }  # fmt: skip


def _yielding(flat: FlatModel, structures: Mapping[str, Structure], groups: set[int]) -> set[int]:
    """Rated groups at which a state yields to the motion."""
    refs = (PortRef(i.path, port) for i in flat.instances for port in structures[i.path].yields) if groups else ()
    return {flat.place(ref)[0] for ref in refs}


def rated_terms(numbering: Numbering, found: Sequence[SpeedJoin]) -> list[tuple[int, int]]:
    """Pairs (i, j) of rated nodes: the row of i may have the rate of the balance of j."""
    number = {index: k for k, index in enumerate(numbering.rated)}
    joined = connected_parts(of_paths(range(len(number)), ([number[index] for index in one.groups] for one in found)))
    return [(i, j) for part in joined for i in sorted(part) for j in sorted(part)]


def add_rated_entries(entries: Entries, memory: Memory, m: int, first: int) -> None:
    """Add what df/dy has more: rates of balances in rows of nodes; at `first` among the partials begin the shares."""
    for k, (i, j) in enumerate(memory["rated_terms"].tolist()):
        row, z = memory["rated"][i, layout.RATED_ROW] + m, memory["rated"][j, layout.RATED_RATE]
        entries.add(np.array([row]), np.array([z]), np.array([first + k]), np.ones(1))


def rows_without_rates(blocks: Sequence[Block], numbering: Numbering) -> Integers:
    """Rows that hold a node whose speed they give at once: they are not in M."""
    light = np.array(sorted({numbering.rate[k] for k in (*numbering.rated, *numbering.geared)}), dtype=np.int64)
    rows = [np.zeros(0, np.int64)]
    for block in blocks:
        s = block.kernel.structure
        for unknown, j in s.mass:
            rows.append(block.flow_index[np.isin(block.in_index[:, j], light), s.targets.index(f"own:{unknown}")])
    return distinct(np.concatenate(rows))


def still_supports(blocks: Sequence[Block], numbering: Numbering, eliminated: set[int]) -> None:
    """Let rows that are not in M read no accelerations of supports either: their slip is zero as it stands.

    Those `eliminated` are left out, of which elimination decides with the zones whether they are in M (light_holds.py).
    """
    rows = rows_without_rates(blocks, numbering).tolist()
    without = np.array([row for row in rows if row not in eliminated], dtype=np.int64)
    if not len(without):
        return
    for block in blocks:
        s = block.kernel.structure
        for j, one in enumerate(map(key, s.inputs)):
            if one.kind == PORT and one.part == "A":
                for unknown in s.holds:
                    of = np.isin(block.flow_index[:, s.targets.index(f"own:{unknown}")], without)
                    block.in_index[of, j], block.in_coef[of, j], block.in_offset[of, j] = numbering.zero, 0.0, 0.0
