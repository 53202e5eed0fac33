"""Second stage: entries of a netlist become component instances with parameters in SI.

    assembly, faults = instantiate(netlist, types)

Composites are expanded here, so that the next stage sees leaves only. All mistakes are reported at once.
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping

from fairlead.component.assembly import Assembly, Join, Line, PortRef
from fairlead.component.base import Composite, Declared
from fairlead.component.called_elsewhere import similar_type
from fairlead.component.composition import expanded
from fairlead.component.declare import PATH
from fairlead.component.effects import switch
from fairlead.component.end_points import as_today, resolve
from fairlead.component.friction_block import sound
from fairlead.component.given import SWITCH
from fairlead.component.parameters import read
from fairlead.component.replies import AnswerError
from fairlead.component.scene import FRAMEWORK_EFFECTS, TooManyParts, is_head
from fairlead.component.stand_in import stand_in
from fairlead.component.values import Values, input_given
from fairlead.errors import Fault, Location, ModelError, did_you_mean, listing, shown
from fairlead.netlist.braces import in_braces
from fairlead.netlist.limits import MOST_FAULTS
from fairlead.netlist.netlist import EndPoint, Netlist, Value


def instantiate(
    netlist: Netlist, types: Mapping[str, type[Declared]], *, whole: bool = True
) -> tuple[Assembly, list[Fault]]:
    """What can be made of a netlist in spite of its mistakes, and the mistakes, for `check`.

    Of one that is not `whole`, connections may be missing, so lines and routes that lead nowhere are only echoes.
    """
    scene, faults = sound(netlist, types)
    assembly = Assembly(netlist, scene, types)
    for entry in netlist.components.values():
        if len(faults) > MOST_FAULTS:  # nobody mends more in one go
            assembly.broken.add(entry.name)
            continue
        kind = types.get(entry.type)
        if kind is None:
            near = similar_type(entry.type, types) or f"There are {listing(sorted(types), 30)}."
            what = f"{entry.name}: there is no component type {shown(entry.type)}. {near}"
            faults.append(Fault(entry.type_where, what, "--library adds types from a file of yours."))
        found = read_entry(assembly, kind, entry.parameters, entry.name, entry.where, faults) if kind else None
        if found is None:
            assembly.broken.add(entry.name)
        else:
            assembly.entries[entry.name] = found
            faults += _expanded(assembly, entry.name, found, entry.where)
    faults += _unknown_effects(assembly, types)
    for ends in netlist.connections:
        if len(faults) > MOST_FAULTS:
            assembly.excuse(assembly.instances)
            break
        faults += _connect(assembly, ends)
    open_paths = _open_paths(assembly)
    faults += open_paths if whole else []
    return assembly, sorted(faults, key=lambda f: (f.where is None, f.where))


def read_entry(
    assembly: Assembly, kind: type[Declared], given: Mapping[str, Value], name: str, where: Location,
    faults: list[Fault],
) -> Values | None:  # fmt: skip
    """Values of an entry of the netlist; its mistakes are added to `faults`."""
    scene = assembly.scene
    member = scene.member(kind, given)
    if is_head(member):
        key, words = member.key, list(member.members)
        chosen = given.get(key) or scene.friction[key]
        what = f"{name}.{key}: there is no {key} {shown(chosen.plain())}. {did_you_mean(str(chosen.plain()), words)}"
        faults.append(Fault(chosen.where, what.rstrip(), f"There are {listing(words)}."))
        return None
    whole = scene.complete(kind, given)
    values, found = read(member, whole, name, where, scene.folder)
    faults += in_braces(found, assembly.netlist.parameters)
    if not found:
        return values
    assembly.stand_ins.add(name)
    return stand_in(member, {key: value.plain() for key, value in whole.items()}, scene.folder)


def _expanded(assembly: Assembly, path: str, values: Values, where: Location) -> list[Fault]:
    """Place an entry; what its children cannot be made with is told, and the entry left out."""
    full = assembly.crowded
    try:
        _place(assembly, path, values, where)
    except TooManyParts:
        assembly.broken.add(path)
        return [] if full else [*TooManyParts(where, path).faults]
    except AnswerError as error:
        assembly.broken.add(path)
        return error.at(where, path)
    except ModelError as error:
        assembly.broken.add(path)
        return [fault if fault.where else Fault(where, f"{path}.{fault.what}", fault.way_out) for fault in error.faults]
    return []


def _place(assembly: Assembly, path: str, values: Values, where: Location) -> None:
    """Add a leaf, or expand a composite into its children, however deep."""
    if values.effects:
        assembly.effects[path] = values.effects
    if not issubclass(values.type, Composite):
        assembly.add(path, values, where)
        return
    expansion = expanded(values, assembly.scene)
    assembly.expansions[path] = expansion
    for name, child in expansion.children.items():
        _place(assembly, f"{path}.{name}", child, where)
    for ends in expansion.connections:
        refs = tuple(_inner(assembly, f"{path}.{end}") for end in ends)
        assembly.joins.append(Join(refs, where))
    for outer, inner in {**expansion.ports, **expansion.outputs}.items():
        assembly.aliases[f"{path}.{outer}"] = _inner(assembly, f"{path}.{inner}")
    assembly.open_inputs |= left_open(path, values, assembly.aliases)  # the outermost composite has the last word
    if expansion.line is not None:
        assembly.lines[path] = Line(path, values, expansion.line, where)


def left_open(path: str, values: Values, aliases: Mapping[str, PortRef]) -> dict[PortRef, float]:
    """What a composite gives to its inputs while nothing is joined to them, by the input of the leaf inside."""
    given = {name: input_given(values, declared.default) for name, declared in values.type.declaration.inputs.items()}
    return {aliases[at]: one for name, one in given.items() if one is not None and (at := f"{path}.{name}") in aliases}


def _inner(assembly: Assembly, text: str) -> PortRef:
    owner, _, port = text.rpartition(".")
    if (today := as_today(assembly, owner, port)) != port:
        port, text = today, f"{owner}.{today}"
    return assembly.aliases.get(text) or PortRef(owner, port)


def _connect(assembly: Assembly, ends: tuple[EndPoint, ...]) -> list[Fault]:
    """Resolve the ends of one connection; a path connection is noted for the flattening."""
    ends = tuple({end.text: end for end in ends}.values())  # one joined to itself is told by the netlist stage
    found = [resolve(assembly, end) for end in ends if end.component not in assembly.broken]
    faults = [end for end in found if isinstance(end, Fault)]
    paths = [end for end in found if isinstance(end, str)]
    refs = [end for end in found if isinstance(end, PortRef)]
    where = ends[0].where
    if len(paths) + len(refs) < max(len(ends), 2):  # the rest is joined, and nobody blamed for what is missing
        assembly.excused.update(refs)
        assembly.excuse(
            {end.text.rpartition(".")[0] for end, it in zip(ends, found, strict=False) if isinstance(it, Fault)}
        )
    elif paths and refs:
        what = f"{ends[0].text} -- {ends[1].text}: a path can only be joined with a path."
        return [Fault(where, what, "A path joins a line with the route it runs along; flanges join bodies.")]
    elif len(paths) > 2:
        what = f"a path joins one line with one route, here are {len(paths)} ends: {', '.join(paths)}."
        way_out = "Write a connection for each line. Two lines in a row take two routes with the same bends."
        return [Fault(where, what, way_out)]
    elif paths:
        assembly.routings.append((paths[0], paths[1], where))
    if len(refs) > 1:
        assembly.joins.append(Join(tuple(refs), where))
    return faults


def _open_paths(assembly: Assembly) -> list[Fault]:
    """Lines and routes that lead nowhere; what they are made of is not blamed for it as well."""
    named = {end.text for ends in assembly.netlist.connections for end in ends}
    joined = {path for one, two, _ in assembly.routings for path in (one, two)}
    faults = []
    for path, line in assembly.lines.items():
        if path in joined:
            continue
        assembly.excuse(inner for inner in assembly.instances if inner.startswith(f"{path}."))
        ports = [f"{path}.{name}" for name, port in line.values.type.declaration.ports.items() if port.domain == PATH]
        if not assembly.broken and not named & set(ports):
            what, way_out = f"{ports[0]} is connected to nothing.", "Join it with the path of a line or of a route."
            faults.append(Fault(line.where, what, way_out))
    return faults


def _unknown_effects(assembly: Assembly, types: Mapping[str, type[Declared]]) -> list[Fault]:
    """Effects that nothing in the scene knows, and values that are not on or off."""
    named = [types[entry.type] for entry in assembly.netlist.components.values() if entry.type in types]
    declared = {name for switches in assembly.effects.values() for name in switches}
    declared |= {name for kind in named for name in kind.declaration.effects}  # of those too that could not be made
    known = sorted({*FRAMEWORK_EFFECTS, *declared})
    faults = []
    for name, value in itertools.islice(assembly.netlist.effects.items(), MOST_FAULTS):
        if name not in known:
            what = f"effects.{name}: nothing in this scene has such an effect. {did_you_mean(name, known)}"
            faults.append(Fault(value.named_at, what.rstrip(), f"It has {listing(known)}."))
        elif switch(value.plain()) not in SWITCH:
            what = f"effects.{name} = {shown(value.plain())} is not a switch."
            faults.append(Fault(value.where, what, "Write on or off."))
    return faults
