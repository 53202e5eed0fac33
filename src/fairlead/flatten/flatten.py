"""Third stage: from component instances to nodes, groups and links; a chain of named passes.

flat = flatten(assembly)       route -> wire -> group -> check
"""

from __future__ import annotations

import re

from fairlead.component.assembly import Assembly, Instance, Kind, PortRef, asked_by_two
from fairlead.component.base import Family
from fairlead.component.friction_block import unheard
from fairlead.component.values import input_given
from fairlead.errors import Fault, Location, ModelError
from fairlead.flatten.collection import collected_later
from fairlead.flatten.flat_model import FlatModel, Group
from fairlead.flatten.kinematics import group
from fairlead.flatten.levels import unlike
from fairlead.flatten.never_slips import never_slips
from fairlead.flatten.routing import lay
from fairlead.flatten.wiring import port_graph, wire


@collected_later
def flatten(assembly: Assembly) -> FlatModel:
    """Nodes, groups and links of all leaves. Raises ModelError with everything wrong with the graph."""
    flat, faults = survey(assembly)
    if faults:
        raise ModelError(faults)
    return flat


def survey(assembly: Assembly) -> tuple[FlatModel, list[Fault]]:
    """The flat model as far as it can be made, and everything wrong with the graph."""
    try:
        faults = lay(assembly)
    except ModelError as error:  # settings of the scene that no contact can be made with
        faults = list(error.faults)
    if faults:  # their contacts are missing, which is not to be told as well
        assembly.broken.update(path.split(".")[0] for path in assembly.lines)
        assembly.excuse(path for path in assembly.instances if path.split(".")[0] in assembly.broken)
    nodes, links, wrong = wire(assembly, port_graph(assembly))
    faults += wrong
    node_of = {port: number for number, node in enumerate(nodes) for port in node.ports}
    groups, group_of, wrong = group(assembly, nodes, node_of)
    faults += [fault for fault in wrong if not _of_a_stand_in(assembly, fault)]
    instances = tuple(assembly.instances.values())
    flat = FlatModel(assembly, instances, tuple(nodes), tuple(groups), node_of, group_of, links)
    if not faults and not assembly.broken:
        faults += unheard(assembly.netlist, (instance.type for instance in instances))
    faults += _without_effect(flat) + _always_held(flat) + _held_between_prescribed(flat) + _missing_inputs(flat)
    faults += unlike(flat)
    _start_sources(flat)
    return flat, sorted(set(faults), key=lambda f: (f.where is None, f.where, f.what))


def _of_a_stand_in(assembly: Assembly, fault: Fault) -> bool:
    """True for what is said of lengths, ratios and starts of a component whose numbers are not the user's."""
    return any(re.search(rf"\b{name}\b", fault.what) for name in assembly.stand_ins)


def _without_effect(flat: FlatModel) -> list[Fault]:
    """Components whose two mechanical ends are one node: they can neither stretch nor slip."""
    faults = []
    moving: dict[Kind, list[str]] = {}
    for instance in flat.those(lambda kind: len(_moving(kind)) > 1):
        if instance.type not in moving:
            moving[instance.type] = _moving(instance.type)
        first, *others = moving[instance.type]
        path, node_of = instance.path, asked_by_two(flat.node_of)
        one = node_of.get((path, first))
        if one is not None and node_of.get((path, others[-1]), one) != one:
            continue
        ports = [PortRef(path, name) for name in moving[instance.type]]
        if len({flat.node_of[port] for port in ports if port in flat.node_of}) == 1:
            both = " and ".join(map(flat.assembly.named, ports))
            what = f"{both} are joined with each other, so {instance.path} has no effect."
            faults.append(Fault(_where_joined(flat, ports), what, "Join them to different bodies."))
    return faults


def _moving(kind: Kind) -> list[str]:
    """Mechanical ports of a class."""
    return [name for name, port in kind.declaration.ports.items() if port.domain.mechanical]


def _where_joined(flat: FlatModel, ports: list[PortRef]) -> Location:
    """The connection that names the last of the ports."""
    named = [join.where for join in flat.assembly.joins if ports[-1] in join.ports]
    return named[-1] if named else flat.assembly.instances[ports[0].instance].where


def _always_held(flat: FlatModel) -> list[Fault]:
    """What holds a slip that no motion of its one body can change: its force is not determined."""
    faults = []
    for instance in flat.those(lambda kind: kind.declaration.unknowns):
        held = never_slips(flat, instance)
        if held is not None:
            body, ports = held
            sides, *_, last = (str(PortRef(instance.path, port)) for port in ports)
            many = "both" if len(ports) == 2 else "all"
            what = f"{instance.path} has {many} sides on one rigid body ({body.name}); they can never slip."
            faults.append(Fault(instance.where, what, f"Remove {instance.path}, or what ties {sides} to {last}."))
    return faults


def _held_between_prescribed(flat: FlatModel) -> list[Fault]:
    """What may hold two sides together needs one whose motion is unknown, else its force is not determined."""
    faults, node_of = [], asked_by_two(flat.node_of)
    for instance in flat.those(_may_hold_two_sides):
        a, b = (instance.path, "a"), (instance.path, "b")
        sides = flat.groups[flat.places[a][0]], flat.groups[flat.places[b][0]]
        if sides[0].free or sides[1].free or node_of[a] == node_of[b]:
            continue
        if never_slips(flat, instance) is None:
            who = " and ".join(dict.fromkeys(str(side.prescribed.by) for side in sides if side.prescribed))
            between = "between two prescribed motions" if sides[0] is not sides[1] else "across a prescribed motion"
            what = f"{instance.path} lies {between} ({who}); no law determines its force."
            other = ", or write friction: {method: binding}" if issubclass(instance.type, Family) else ""
            other += _or_switch_off(flat, instance)
            turns = sides[0].domain.name == sides[1].domain.name == "rotational"
            bodies = "an Inertia and a TorsionSpring" if turns else "a Mass and a Spring"
            faults.append(Fault(instance.where, what, f"Put {bodies} between{other}."))
    return faults


def _may_hold_two_sides(kind: Kind) -> bool:
    """Whether a class has a force of its own between `a` and `b` that no part of a body tells (`bears`)."""
    has = kind.declaration
    return bool(has.unknowns) and {"a", "b"} <= set(has.ports) and not kind.answers.bears


def _or_switch_off(flat: FlatModel, instance: Instance) -> str:
    """Of a child of a component with effects that are on: that one of them may be what brings it in."""
    of, inside, _ = instance.path.partition(".")
    entry = flat.assembly.entries.get(of)
    on = [name for name, state in entry.effects.items() if state == "on"] if inside and entry is not None else []
    return f", or switch off the effect of {of} that brings it in ({', '.join(on)})" if on else ""


def _missing_inputs(flat: FlatModel) -> list[Fault]:
    faults, sources = [], asked_by_two(flat.sources)
    for instance in flat.those(lambda kind: kind.declaration.inputs):
        for name, declared in instance.type.declaration.inputs.items():
            if (instance.path, name) in sources:
                continue
            ref = PortRef(instance.path, name)
            if ref in flat.assembly.excused or ref in flat.assembly.open_inputs:
                continue
            if input_given(instance.values, declared.default) is None:
                give = f", or give {declared.default}" if isinstance(declared.default, str) else ""
                what = f"{flat.assembly.named(ref)}: nothing is connected to this input [{declared.unit}]."
                faults.append(Fault(instance.where, what, f"Connect an output to it{give}."))
    return faults


def _start_sources(flat: FlatModel) -> None:
    """A velocity without a given origin starts where the driven body is."""
    for made in flat.groups:
        if made.prescribed is not None and made.prescribed.outputs is not None:
            _shift(flat, made)


def begins_otherwise(flat: FlatModel, start: float) -> bool:
    """Whether a motion is another one in a run that starts at this time [s].

    It is if it is given by its velocity alone: it begins where the driven body is, when the run starts.
    """
    if start == flat.assembly.netlist.run.start:
        return False
    sources = [flat.assembly.instances[one.prescribed.by.instance] for one in flat.groups if one.prescribed is not None]
    return any(source.type.answers.starts_at is not None for source in sources)


def _shift(flat: FlatModel, made: Group) -> None:
    assert made.prescribed is not None
    source = flat.assembly.instances[made.prescribed.by.instance]
    shift = source.type.answers.starts_at
    if shift is not None:
        _, ratio, offset = flat.place(made.prescribed.by)
        shift(source.values, ratio * made.start[0] + offset, flat.assembly.netlist.run.start)
