"""Connected components of the port graph: nodes, and the links of signals."""

from __future__ import annotations

import functools
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from fairlead.component.assembly import Assembly, Join, PortRef
from fairlead.component.declare import PATH, Domain, Input, Output, Port
from fairlead.errors import Fault, Location
from fairlead.flatten.flat_model import Node
from fairlead.flatten.graph import connected_parts
from fairlead.quantities import NONE, article, parse_unit

ENDS = {
    "translational": "a free end needs a Mass, a fixed one a Ground",
    "rotational": "a free shaft needs an Inertia, a fixed one a Housing",
    "hydraulic": "a closed end needs a Volume, an open one a Tank",
    "electrical": "what has no voltage of its own needs an Earth",
    "thermal": "a body that is warmed needs a HeatCapacity, the surroundings a FixedTemperature",
}
"""By domain, what is joined to a port that leads nowhere."""
SIGNAL = {"signal"}


@dataclass(frozen=True)
class PortGraph:
    """All ports, and the signals that are joined: who each is and what it is, by number, and the numbers joined."""

    joins: Sequence[Join]
    refs: list[PortRef]
    declared: list[Port | Input | Output]
    beside: dict[int, list[int]]

    @functools.cached_property
    def joined(self) -> dict[PortRef, dict[PortRef, Location]]:
        """For every two that are joined, both ways, where that is written; only mistakes ask for it."""
        found: dict[PortRef, dict[PortRef, Location]] = {ref: {} for ref in self.refs}
        for join in self.joins:
            for a, b in pairwise(join.ports):
                found[a][b] = found[b][a] = join.where
        return found


def port_graph(assembly: Assembly) -> PortGraph:
    """The graph of all ports and of the joined signals, with an edge for every two that are joined."""
    instances = assembly.instances
    refs = [PortRef(path, name) for path, one in instances.items() for name in one.type.declaration.ports]
    declared: list[Port | Input | Output] = []
    for one in instances.values():
        declared += one.type.declaration.ports.values()
    number = {ref: k for k, ref in enumerate(refs)}
    beside: dict[int, list[int]] = {k: [] for k in range(len(refs))}
    for join in assembly.joins:
        before = -1
        for ref in join.ports:
            at = number.get(ref)
            if at is None:
                has = instances[ref.instance].type.declaration
                at = number[ref] = len(refs)
                refs.append(ref)
                declared.append(has.inputs.get(ref.port) or has.outputs[ref.port])
                beside[at] = []
            if before >= 0:
                beside[before].append(at)
                beside[at].append(before)
            before = at
    return PortGraph(assembly.joins, refs, declared, beside)


def wire(assembly: Assembly, graph: PortGraph) -> tuple[list[Node], dict[PortRef, PortRef], list[Fault]]:
    """Nodes and signal links, and everything wrong with the connections."""
    faults = [_to_itself(assembly, join) for join in assembly.joins if _named_twice(join.ports)]
    nodes: list[Node] = []
    links: dict[PortRef, PortRef] = {}
    alone: dict[str, list[PortRef]] = {}
    for numbers in connected_parts(graph.beside):
        kinds = {_kind(graph.declared[k]) for k in numbers}
        if kinds == SIGNAL and (plain := _plain_links(graph, numbers)):  # most of a long line
            links |= plain
            continue
        each = {graph.refs[k]: graph.declared[k] for k in numbers}
        ports = sorted(each, key=".".join) if 1 < len(each) < 50 else list(each)
        declared: dict[PortRef, Any] = {ref: each[ref] for ref in ports}
        if len(kinds) > 1:
            faults.append(_mixed(assembly, graph, declared))
            assembly.excuse({ref.instance for ref, d in declared.items() if not isinstance(d, Port)})
        elif kinds == SIGNAL:
            found, wrong = _signal(assembly, graph, declared)
            links |= found
            faults += wrong
            assembly.excused.update(ports if wrong else ())
        for domain, there in _by_domain(declared):
            if domain != PATH:  # there are several only beside a fault, so that the other mistakes are found too
                nodes.append(Node(there, domain))
                if len(ports) == 1 and not declared[ports[0]].optional:
                    alone.setdefault(ports[0].instance, []).append(ports[0])
    return nodes, links, faults + _dangling(assembly, alone)


def _named_twice(ports: tuple[PortRef, ...]) -> bool:
    return ports[0] == ports[1] if len(ports) == 2 else len(set(ports)) < len(ports)


def _plain_links(graph: PortGraph, numbers: list[int]) -> dict[PortRef, PortRef]:
    """Inputs and the one output, all of one unit, that they are joined with; nothing for anything else."""
    outputs = [k for k in numbers if isinstance(graph.declared[k], Output)]
    units = {graph.declared[k].unit for k in numbers}  # type: ignore[union-attr]  # all are signals
    if len(outputs) != 1 or len(units) > 1:
        return {}
    inputs = [graph.refs[k] for k in numbers if k != outputs[0]]
    if len(inputs) > 1 and len(numbers) < 50:
        inputs.sort(key=".".join)
    return dict.fromkeys(inputs, graph.refs[outputs[0]])


def _by_domain(declared: dict[PortRef, Any]) -> Iterator[tuple[Domain, tuple[PortRef, ...]]]:
    """The ports among what is joined, by domain; the name tells one, as in `_kind`: to compare all of it takes long."""
    found: dict[str, list[PortRef]] = {}
    for ref, one in declared.items():
        if isinstance(one, Port):
            found.setdefault(one.domain.name, []).append(ref)
    for there in found.values():
        yield declared[there[0]].domain, tuple(there)


def _kind(declared: Port | Input | Output) -> str:
    """What can be joined with what: the name of a domain, or "signal"."""
    return declared.domain.name if isinstance(declared, Port) else "signal"


def _written(graph: PortGraph, ports: Iterable[PortRef]) -> Location:
    """Where the first of the connections between them is written; there is one, as one signal alone is no mistake."""
    return next(where for a in ports for where in graph.joined[a].values())


def _signal(
    assembly: Assembly, graph: PortGraph, declared: dict[PortRef, Input | Output]
) -> tuple[dict[PortRef, PortRef], list[Fault]]:
    """One output feeds any number of inputs."""
    outputs = [ref for ref, d in declared.items() if isinstance(d, Output)]
    inputs = [ref for ref, d in declared.items() if isinstance(d, Input)]
    odd = _other_unit(declared, outputs[0]) if len(outputs) == 1 else None
    if len(declared) == 1 or (len(outputs) == 1 and odd is None):
        return dict.fromkeys(inputs, outputs[0]) if outputs else {}, []
    where = _written(graph, declared)
    if odd is not None:
        of = declared[outputs[0]].unit
        what = f"{assembly.named(outputs[0])} is in {of}, {assembly.named(odd)} wants {declared[odd].unit}."
        return {}, [Fault(where, what, "Join an output with inputs of its unit.")]
    if outputs:
        what = f"{' and '.join(map(assembly.named, outputs))} are outputs; a signal has one source."
        return {}, [Fault(where, what, "Keep one of them.")]
    what = f"{' and '.join(map(assembly.named, inputs))} are inputs, and nothing gives the signal."
    return {}, [Fault(where, what, "Add the output that they are to read to this connection.")]


def _other_unit(declared: dict[PortRef, Input | Output], output: PortRef) -> PortRef | None:
    """An input that wants another kind of quantity than the output gives; a plain number fits anything."""
    given = parse_unit(declared[output].unit).dimension
    for ref, read in declared.items():
        if isinstance(read, Input) and parse_unit(read.unit).dimension not in (given, NONE) and given != NONE:
            return ref
    return None


def _mixed(assembly: Assembly, graph: PortGraph, declared: dict[PortRef, Port | Input | Output]) -> Fault:
    """Told where the two kinds meet."""
    unlike = ((a, b) for a in declared for b in graph.joined[a] if _kind(declared[a]) != _kind(declared[b]))
    a, b = min((a, b) for a, b in unlike if a < b)
    one, two, where = _kind(declared[a]), _kind(declared[b]), graph.joined[a][b]
    first, second = assembly.named(a), assembly.named(b)
    if "signal" in (one, two):
        first, second, one = (second, first, two) if one == "signal" else (first, second, one)
        return Fault(where, f"{first} is {article(one)} port, {second} a signal; they cannot be joined.",
                     "A signal joins one output to inputs; a sensor turns a motion into a signal.")  # fmt: skip
    return Fault(where, f"{first} is {article(one)} port, {second} {article(two)} one; they cannot be joined.",
                 f"Join {first} with another {one} port, or put a component with both kinds between them.")  # fmt: skip


def _to_itself(assembly: Assembly, join: Join) -> Fault:
    port = next(port for port in join.ports if join.ports.count(port) > 1)
    what = f"{assembly.named(port)} is connected to itself."
    return Fault(join.where, what, "Name the port it belongs to, or remove the connection.")


def _dangling(assembly: Assembly, alone: dict[str, list[PortRef]]) -> list[Fault]:
    """Ports that lead nowhere; a component none of whose ports is connected is one mistake, not many."""
    faults = []
    for path, open_ports in alone.items():
        ports = [port for port in open_ports if port not in assembly.excused]
        if not ports:
            continue
        instance = assembly.instances[path]
        if len(ports) == len(instance.type.declaration.ports) and path in assembly.netlist.components:
            what = f"{path} is connected to nothing."
            way_out = f"Connect {', '.join(map(assembly.named, ports))}, or remove {path}."
        else:
            names = " and ".join(map(assembly.named, ports))
            what = f"{names} {'are' if len(ports) > 1 else 'is'} connected to nothing."
            domains = {instance.type.declaration.ports[port.port].domain.name for port in ports}
            ends = [said for domain, said in ENDS.items() if domain in domains]
            way_out = f"Connect it{'; ' if ends else ''}{'; '.join(ends)}."
        faults.append(Fault(instance.where, what, way_out))
    return faults
