"""Connected components of the port graph: nodes, and the links of signals."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
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


@dataclass(frozen=True)
class PortGraph:
    """All ports, and the signals that are joined."""

    declared: dict[PortRef, Port | Input | Output] = field(default_factory=dict)
    where: dict[PortRef, Location] = field(default_factory=dict)
    joined: dict[PortRef, dict[PortRef, Location]] = field(default_factory=dict)
    """For every two that are joined, both ways, where that is written."""

    def add(self, ref: PortRef, declared: Port | Input | Output, where: Location) -> None:
        """Add one, joined with nothing yet."""
        self.declared[ref], self.where[ref] = declared, where
        self.joined[ref] = {}


def port_graph(assembly: Assembly) -> PortGraph:
    """The graph of all ports and of the joined signals, with an edge for every two that are joined."""
    graph = PortGraph()
    for path, instance in assembly.instances.items():
        for name, port in instance.type.declaration.ports.items():
            graph.add(PortRef(path, name), port, instance.where)
    for join in assembly.joins:
        for ref in join.ports:
            if ref not in graph.declared:
                has, where = assembly.instances[ref.instance].type.declaration, assembly.instances[ref.instance].where
                graph.add(ref, has.inputs.get(ref.port) or has.outputs[ref.port], where)
        for a, b in zip(join.ports, join.ports[1:], strict=False):
            graph.joined[a][b] = graph.joined[b][a] = join.where
    return graph


def wire(assembly: Assembly, graph: PortGraph) -> tuple[list[Node], dict[PortRef, PortRef], list[Fault]]:
    """Nodes and signal links, and everything wrong with the connections."""
    faults = [_to_itself(assembly, join) for join in assembly.joins if len(set(join.ports)) < len(join.ports)]
    nodes: list[Node] = []
    links: dict[PortRef, PortRef] = {}
    alone: dict[str, list[PortRef]] = {}
    for members in connected_parts(graph.joined):
        ports = sorted(members, key=str) if 1 < len(members) < 50 else members
        declared: dict[PortRef, Any] = {ref: graph.declared[ref] for ref in ports}
        if len({_kind(d) for d in declared.values()}) > 1:
            faults.append(_mixed(assembly, graph, declared))
            assembly.excuse({ref.instance for ref, d in declared.items() if not isinstance(d, Port)})
        elif isinstance(declared[ports[0]], Input | Output):
            found, wrong = _signal(assembly, declared, _written(graph, ports))
            links |= found
            faults += wrong
            assembly.excused.update(ports if wrong else ())
        for domain, there in _by_domain(declared):
            if domain != PATH:  # there are several only beside a fault, so that the other mistakes are found too
                nodes.append(Node(there, domain))
                if len(ports) == 1 and not declared[ports[0]].optional:
                    alone.setdefault(ports[0].instance, []).append(ports[0])
    return nodes, links, faults + _dangling(assembly, alone)


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


def _written(graph: PortGraph, ports: list[PortRef]) -> Location:
    return next((where for a in ports for where in graph.joined[a].values()), graph.where[ports[0]])


def _signal(
    assembly: Assembly, declared: dict[PortRef, Input | Output], where: Location
) -> tuple[dict[PortRef, PortRef], list[Fault]]:
    """One output feeds any number of inputs."""
    outputs = [ref for ref, d in declared.items() if isinstance(d, Output)]
    inputs = [ref for ref, d in declared.items() if isinstance(d, Input)]
    odd = _other_unit(declared, outputs[0]) if len(outputs) == 1 else None
    if len(declared) == 1 or (len(outputs) == 1 and odd is None):
        return dict.fromkeys(inputs, outputs[0]) if outputs else {}, []
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
