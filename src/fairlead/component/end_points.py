"""Which port an end of a connection names; of one that names none, what was meant."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from fairlead.component.assembly import Assembly, PortRef
from fairlead.component.declaration import Declaration
from fairlead.component.declare import PATH, Input, Output, Port
from fairlead.errors import Fault, did_you_mean, listing, shown
from fairlead.netlist.netlist import EndPoint
from fairlead.renamed import OUTPUTS, word_of_today

ENDS = ("flange", "shaft", "port")
"""Ports of many parts with one end, taken for one that is called otherwise."""


def resolve(assembly: Assembly, end: EndPoint) -> PortRef | str | Fault:
    """The port an end point names; the component's path alone when it is a `path` port."""
    owner, _, port = end.text.rpartition(".")
    line = assembly.lines.get(owner)
    declared = line.values.type.declaration.ports.get(port) if line is not None else None
    port = as_today(assembly, owner, port)
    end = replace(end, text=f"{owner}.{port}") if owner else end
    if declared is not None and declared.domain == PATH:
        return owner
    if end.text in assembly.aliases:
        return assembly.aliases[end.text]
    instance = assembly.instances.get(owner)
    if instance is None:
        return _no_such(assembly, end, owner, port)
    has = instance.type.declaration
    connectable = {**has.ports, **has.inputs, **has.outputs}
    if port not in connectable:
        what = f"{end.text}: {instance.type.__name__} has {_listing(connectable)}."
        free = _only_free(assembly, owner, has.ports)
        near = did_you_mean(port, connectable) or free
        if port in ENDS and not any(f"mean {one}?" in near for one in has.ports):
            near = free or near  # what joins bodies is meant, not a signal
        return Fault(end.where, f"{what} {near.replace('mean ', f'mean {owner}.')}".rstrip())
    return PortRef(owner, port)


def as_today(assembly: Assembly, owner: str, port: str) -> str:
    """What a component calls an output that the netlist gives its old name; else the name as it is."""
    if port not in OUTPUTS or f"{owner}.{port}" in assembly.aliases:
        return port
    has = assembly.instances[owner].type.declaration if owner in assembly.instances else Declaration()
    known = {**has.ports, **has.inputs, **has.outputs}
    outer = {today for today in OUTPUTS[port] if f"{owner}.{today}" in assembly.aliases}
    return port if port in known else word_of_today(port, {*known, *outer}) or port


def _only_free(assembly: Assembly, owner: str, ports: Iterable[str]) -> str:
    """The sentence that offers the one port of a component that no connection names."""
    used = {end.text for ends in assembly.netlist.connections for end in ends}
    free = [port for port in ports if f"{owner}.{port}" not in used]
    return f"Did you mean {free[0]}?" if len(free) == 1 else ""


def _listing(connectable: Mapping[str, Any]) -> str:
    kinds = {"ports": Port, "inputs": Input, "outputs": Output}
    parts = []
    for word, kind in kinds.items():
        names = [n for n, d in connectable.items() if isinstance(d, kind)]
        if names:
            parts.append(f"{word} {listing(names)}")
    return "; ".join(parts) or "no ports"


def _no_such(assembly: Assembly, end: EndPoint, owner: str, port: str) -> Fault:
    if not owner:
        entry = assembly.netlist.components.get(end.text)
        ports = [t.rpartition(".")[2] for t in assembly.aliases if t.startswith(end.text + ".")]
        if end.text in assembly.instances:
            ports = list(assembly.instances[end.text].type.declaration.ports)
        if entry is not None:
            return Fault(end.where, f"{end.text}: a port is missing; {entry.type} has {listing(ports)}.",
                         f"Write {end.text}.{ports[0] if ports else 'port'}.")  # fmt: skip
    outer = [name for name in assembly.aliases if name.rpartition(".")[0] == owner]
    if owner in assembly.netlist.components:
        kind = assembly.netlist.components[owner].type
        known = [name.rpartition(".")[2] for name in outer]
        known += list(assembly.lines[owner].values.type.declaration.ports) if owner in assembly.lines else []
        known = list(dict.fromkeys(known))
        near = did_you_mean(port, known).replace("mean ", f"mean {owner}.")
        if owner in assembly.entries and port in assembly.entries[owner].type.declaration.outputs:
            near = f"It has {port} with other values or effects only, see `fairlead describe {kind}`."
        return Fault(end.where, f"{end.text}: {kind} has ports {listing(known)}. {near}".rstrip())
    names = [*assembly.netlist.components, *assembly.instances]
    near = did_you_mean(owner or end.text, names)
    return Fault(end.where, f"{end.text}: there is no component {shown(owner or end.text)}. {near}".rstrip(),
                 "" if near else f"There are {listing(assembly.netlist.components)}.")  # fmt: skip
