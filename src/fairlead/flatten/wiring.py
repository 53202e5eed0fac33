"""Connected components of the port graph: nodes, and the links of signals.

    vertices   ports, as PortRef; vertex data `declared` is the Port, Input or Output
    edges      written connections, with the place they were written
"""

from __future__ import annotations

import networkx as nx

from fairlead.component.declare import PATH, Input, Output, Port
from fairlead.component.instantiate import Assembly, PortRef
from fairlead.errors import Fault, Location
from fairlead.flatten.flat_model import Node


def port_graph(assembly: Assembly) -> nx.Graph:
    """The graph of all ports and of the joined signals, with an edge for every two that are joined."""
    graph = nx.Graph()
    for path, instance in assembly.instances.items():
        for name, port in instance.type.declaration.ports.items():
            graph.add_node(PortRef(path, name), declared=port, where=instance.where)
    for join in assembly.joins:
        for ref in join.ports:
            if ref not in graph:
                has, where = assembly.instances[ref.instance].type.declaration, assembly.instances[ref.instance].where
                graph.add_node(ref, declared=has.inputs.get(ref.port) or has.outputs[ref.port], where=where)
        for a, b in zip(join.ports, join.ports[1:], strict=False):
            graph.add_edge(a, b, where=join.where)
    return graph


def wire(assembly: Assembly, graph: nx.Graph) -> tuple[list[Node], dict[PortRef, PortRef], list[Fault]]:
    """Nodes and signal links, and everything wrong with the connections."""
    faults = [
        _to_itself(join.ports[0], join.where) for join in assembly.joins if len(set(join.ports)) < len(join.ports)
    ]
    nodes: list[Node] = []
    links: dict[PortRef, PortRef] = {}
    alone: dict[str, list[PortRef]] = {}
    for members in nx.connected_components(graph):
        ports = sorted(members, key=str) if len(members) < 50 else list(members)
        declared = {ref: graph.nodes[ref]["declared"] for ref in ports}
        if any(isinstance(d, Input | Output) for d in declared.values()):
            found, wrong = _signal(declared, _written(graph, ports))
            links |= found
            faults += wrong
            continue
        domains = {d.domain for d in declared.values()}
        if len(domains) > 1:
            faults.append(_mixed(declared, _written(graph, ports)))
        elif PATH not in domains:
            nodes.append(Node(tuple(ports), domains.pop()))
            if len(ports) == 1 and not declared[ports[0]].optional:
                alone.setdefault(ports[0].instance, []).append(ports[0])
    return nodes, links, faults + _dangling(assembly, alone)


def _written(graph: nx.Graph, ports: list[PortRef]) -> Location:
    for a in ports:
        for data in graph.adj[a].values():
            return data["where"]
    return graph.nodes[ports[0]]["where"]


def _signal(
    declared: dict[PortRef, Port | Input | Output], where: Location
) -> tuple[dict[PortRef, PortRef], list[Fault]]:
    """One output feeds any number of inputs."""
    outputs = [ref for ref, d in declared.items() if isinstance(d, Output)]
    inputs = [ref for ref, d in declared.items() if isinstance(d, Input)]
    ports = [ref for ref, d in declared.items() if isinstance(d, Port)]
    if len(declared) == 1:
        return {}, []
    if ports:
        what = f"{ports[0]} is a {declared[ports[0]].domain.name} port, {(outputs + inputs)[0]} a signal"
        return {}, [Fault(where, what, "A signal joins one output to inputs; a sensor turns motion into a signal.")]
    if len(outputs) != 1:
        names = ", ".join(map(str, outputs)) or "none"
        return {}, [
            Fault(where, f"{inputs[0] if inputs else outputs[0]}: a signal needs exactly one output, here: {names}")
        ]
    return {target: outputs[0] for target in inputs}, []


def _mixed(declared: dict[PortRef, Port], where: Location) -> Fault:
    first: dict[str, PortRef] = {}
    for ref, port in declared.items():
        first.setdefault(port.domain.name, ref)
    (one, a), (two, b) = list(first.items())[:2]
    return Fault(where, f"{a} is a {one} port, {b} a {two} one; they cannot be joined.",
                 f"Join {a} with another {one} port, or put a component with both kinds between them.")  # fmt: skip


def _to_itself(port: PortRef, where: Location) -> Fault:
    return Fault(where, f"{port} is connected to itself.", "Name the port it belongs to, or remove the connection.")


def _dangling(assembly: Assembly, alone: dict[str, list[PortRef]]) -> list[Fault]:
    """Ports that lead nowhere; a component none of whose ports is connected is one mistake, not many."""
    faults = []
    for path, ports in alone.items():
        instance = assembly.instances[path]
        if len(ports) == len(instance.type.declaration.ports) and path in assembly.netlist.components:
            what, way_out = (
                f"{path} is connected to nothing.",
                f"Connect {', '.join(map(str, ports))}, or remove {path}.",
            )
        else:
            what, way_out = (
                f"{ports[0]} is connected to nothing.",
                "Connect it; a free end needs a Mass, a fixed one a Ground.",
            )
            what = f"{', '.join(map(str, ports))}: connected to nothing." if len(ports) > 1 else what
        faults.append(Fault(instance.where, what, way_out))
    return faults
