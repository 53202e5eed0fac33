"""Second stage: entries of a netlist become component instances with parameters in SI.

    assembly = instantiate(netlist, types)

Composites are expanded here, so that the next stage sees leaves only. All mistakes are reported at once.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

from fairlead.component.base import Composite, Declared, Expansion
from fairlead.component.called_elsewhere import similar_type
from fairlead.component.composition import expanded
from fairlead.component.declaration import Declaration
from fairlead.component.declare import PATH, Input, Output, Port
from fairlead.component.effects import switch
from fairlead.component.friction_block import sound
from fairlead.component.given import SWITCH
from fairlead.component.parameters import read
from fairlead.component.replies import AnswerError
from fairlead.component.scene import FRAMEWORK_EFFECTS, Scene, TooManyParts, is_head
from fairlead.component.stand_in import stand_in
from fairlead.component.values import Values, Variant, input_given, variant_of
from fairlead.errors import Fault, Location, ModelError, did_you_mean, listing, shown
from fairlead.netlist.braces import in_braces
from fairlead.netlist.limits import MOST_FAULTS
from fairlead.netlist.netlist import EndPoint, Netlist, Value
from fairlead.renamed import OUTPUTS, word_of_today

ENDS = ("flange", "shaft", "port")
"""Ports of many parts with one end, taken for one that is called otherwise."""


@dataclass(frozen=True)
class Instance:
    """One leaf component: its path in the model, its class and numbers, and where it was written."""

    path: str
    values: Values
    where: Location
    variant: Variant

    @property
    def type(self) -> type[Declared]:
        """The component class."""
        return self.values.type

    def __str__(self) -> str:
        return f"{self.path}: {self.variant.label}    {self.where}"


def with_other(instance: Instance, **given: Any) -> Instance:
    """The same component with some other values, of the same variant."""
    old = instance.values
    values = Values(old.type, {**old.given, **given})
    values.variant, values.effects = old.variant, old.effects
    return replace(instance, values=values)


class PortRef(NamedTuple):
    """A port, input or output of a leaf."""

    instance: str
    port: str

    def __str__(self) -> str:
        return f"{self.instance}.{self.port}"


class Join(NamedTuple):
    """Ports that were written as connected, and where."""

    ports: tuple[PortRef, ...]
    where: Location


@dataclass(frozen=True)
class Line:
    """A composite that runs along a route: its path, what it says of itself, and where it was written."""

    path: str
    values: Values
    line: Any
    where: Location


@dataclass(frozen=True)
class HandedOn:
    """Values of a child that were made with parts of a line or a route, such as a curve: of what kind, from what."""

    made: Values
    kind: type[Declared]
    given: dict[str, Any]


@dataclass
class Assembly:
    """All leaves of a model with their joins; lines and routes wait for the flattening."""

    netlist: Netlist
    scene: Scene
    types: Mapping[str, type[Declared]] = field(default_factory=dict)
    instances: dict[str, Instance] = field(default_factory=dict)
    joins: list[Join] = field(default_factory=list)
    lines: dict[str, Line] = field(default_factory=dict)
    routings: list[tuple[str, str, Location]] = field(default_factory=list)  # the two ends of a `path` connection
    aliases: dict[str, PortRef] = field(default_factory=dict)  # outer name of an output or port -> the inner one
    effects: dict[str, dict[str, str]] = field(default_factory=dict)  # component -> its effects, on or off
    broken: set[str] = field(default_factory=set)  # components of the netlist that could not be made
    stand_ins: set[str] = field(default_factory=set)  # made with other values, for there are mistakes in their own
    entries: dict[str, Values] = field(default_factory=dict)  # of the components of the netlist
    expansions: dict[str, Expansion] = field(default_factory=dict)  # of composites, however deep
    handed_on: list[HandedOn] = field(default_factory=list)  # where laying passed on parts as they are
    open_inputs: dict[PortRef, float] = field(default_factory=dict)  # what composites give to inputs left open
    excused: set[PortRef] = field(
        default_factory=set
    )  # ports joined to what could not be read: not open, if unconnected

    def add(self, path: str, values: Values, where: Location) -> None:
        """Add a leaf. Raises TooManyParts."""
        if self.crowded:
            raise TooManyParts
        self.instances[path] = Instance(path, values, where, variant_of(values))

    @property
    def crowded(self) -> bool:
        """Whether the scene has as many parts as it may have."""
        return self.scene.tally.full(len(self.instances))

    def excuse(self, paths: Iterable[str]) -> None:
        """Blame no port of these instances for being open: what is written about them could not be read."""
        for path in paths:
            if path in self.instances:
                has = self.instances[path].type.declaration
                self.excused.update(PortRef(path, name) for name in (*has.ports, *has.inputs))

    def named(self, ref: PortRef) -> str:
        """A port by the name that a netlist has for it: that of the outermost component that hands it out."""
        names = [alias for alias, inner in self.aliases.items() if inner == ref]
        return min((*names, str(ref)), key=lambda name: (name.count("."), name not in names))

    def __str__(self) -> str:
        joins = (f"{' -- '.join(map(str, join.ports))}    {join.where}" for join in self.joins)
        effects = (
            f"effects of {path}: {', '.join(f'{name} {word}' for name, word in switches.items())}"
            for path, switches in self.effects.items()
        )
        return "\n".join([*map(str, self.instances.values()), *joins, *effects])


def instantiate(netlist: Netlist, types: Mapping[str, type[Declared]]) -> Assembly:
    """Build all instances. Raises ModelError with every mistake of the netlist."""
    assembly, faults = survey(netlist, types)
    if faults:
        raise ModelError(faults)
    return assembly


def survey(
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
    port = _as_today(assembly, owner, port)
    return assembly.aliases.get(f"{owner}.{port}") or PortRef(owner, port)


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


def resolve(assembly: Assembly, end: EndPoint) -> PortRef | str | Fault:
    """The port an end point names; the component's path alone when it is a `path` port."""
    owner, _, port = end.text.rpartition(".")
    line = assembly.lines.get(owner)
    declared = line.values.type.declaration.ports.get(port) if line is not None else None
    port = _as_today(assembly, owner, port)
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


def _as_today(assembly: Assembly, owner: str, port: str) -> str:
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
