"""The public function of the stage: a path and overrides in, a frozen `Netlist` out, or all its mistakes."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from fairlead.errors import Fault, ModelError, did_you_mean, listing, shown, without_echoes
from fairlead.netlist.braces import in_braces
from fairlead.netlist.files import find
from fairlead.netlist.includes import Sources, gather
from fairlead.netlist.interface import Interface
from fairlead.netlist.limits import MOST_FAULTS
from fairlead.netlist.netlist import EndPoint, Entry, Netlist, Value
from fairlead.netlist.overrides import BLOCKS, override
from fairlead.netlist.schema import Document, Part
from fairlead.netlist.settings import RecordSettings, RunSettings
from fairlead.netlist.substitution import fill_tree
from fairlead.netlist.translate import validate


def load(path: str | os.PathLike[str], overrides: Mapping[str, str] | None = None) -> Netlist:
    """Read a netlist, by path or by the name of a bundled model.

    `overrides` maps a scene parameter (`mu`) or a dotted path (`pad.normal_force`, `run.stop`) to text.
    Raises ModelError with every mistake found.
    """
    netlist, faults = survey(path, overrides)
    if netlist is None or faults:
        raise ModelError(faults)
    return netlist


def survey(
    path: str | os.PathLike[str], overrides: Mapping[str, str] | None = None
) -> tuple[Netlist | None, tuple[Fault, ...]]:
    """What can be read of a netlist in spite of its mistakes, and the mistakes.

    For `check`, so that the next stages add theirs to the same list. The netlist is None when nothing of it
    can be used; entries that are broken are left out of it.
    """
    sources, faults = read(path)
    return (None, faults) if sources is None else worked_out(sources, overrides or {})


def read(path: str | os.PathLike[str], draft: str | None = None) -> tuple[Sources | None, tuple[Fault, ...]]:
    """The files of a netlist; None, and why, when nothing can be read. `draft` is read instead of the first of them."""
    try:
        sources = gather(find(path), draft)
    except ModelError as error:
        return None, error.faults
    return (None, tuple(sources.faults)) if sources.tree is None else (sources, ())


def worked_out(sources: Sources, overrides: Mapping[str, str]) -> tuple[Netlist | None, tuple[Fault, ...]]:
    """The netlist of these files with `overrides`, and its mistakes. The sources stay as they are."""
    if sources.tree is None:
        return None, tuple(sources.faults)
    tree, faults = override(sources.tree, overrides)
    tree, more = fill_tree(tree)
    faults = [*sources.faults, *faults, *more]
    document, wrong = validate(Document, tree)
    for part in sources.parts:
        wrong += validate(Part, part)[1]
    wrong += _named_like_blocks(tree) + _loose_ends(tree)
    faults += in_braces(without_echoes(wrong, faults), _block(tree, "parameters"))
    netlist = _netlist(sources.top, tree, document, sources.digest(overrides))
    kept = replace(netlist, texts=dict(sources.texts), given=dict(overrides))
    return kept, tuple(sorted(dict.fromkeys(faults), key=_place))


def _netlist(file: Path, tree: Value, document: Document | None, digest: str) -> Netlist:
    """The netlist of a tree; broken entries are left out, and a broken run or record block is a default."""
    run = document.run if document else RunSettings(stop=1.0)
    record = document.record if document else RecordSettings()
    name = tree.entries["name"].content if "name" in tree.entries else None
    description = tree.entries["description"].content if "description" in tree.entries else None
    names = ("effects", "friction", "initial", "nominal", "limits")
    blocks: dict[str, Any] = {block: _block(tree, block) for block in names}
    components = _components(tree)
    return Netlist(
        path=file,
        name=str(name or file.stem),
        description=str(description or ""),
        parameters=_block(tree, "parameters"),
        components=components,
        connections=tuple(ends for ends, _ in _connections(tree) if len(ends) > 1),
        run=run,
        record=record,
        interface=document.interface if document else _interface(tree),
        **blocks,
        digest=digest,
        unread=tuple(name for name in _block(tree, "components") if name not in components),
        written={block: _block(tree, block) for block in ("run", "record", "interface")},
    )


def _interface(tree: Value) -> Interface:
    """The block `interface` of a tree in which something else is wrong; nothing if it is wrong itself."""
    block = tree.entries.get("interface")
    return (validate(Interface, block)[0] if block is not None else None) or Interface()


def _components(tree: Value) -> dict[str, Entry]:
    entries = {}
    for name, block in _block(tree, "components").items():
        kind = block.entries.get("type")
        if kind and isinstance(kind.content, str):
            parameters = {key: value for key, value in block.entries.items() if key != "type"}
            entries[name] = Entry(name, kind.content, parameters, block.named_at, kind.where)
    return entries


def _connections(tree: Value) -> list[tuple[tuple[EndPoint, ...], Value]]:
    """Each connection as its usable ends, with the value it comes from."""
    listed = tree.entries["connections"].content if "connections" in tree.entries else None
    known = _components(tree)
    found = []
    for item in listed if isinstance(listed, list) else []:
        ends = item.content if isinstance(item.content, list) else []
        points = [EndPoint(end.content, end.where) for end in ends if isinstance(end.content, str)]
        found.append((tuple(point for point in points if point.port and _owner(point) in known), item))
    return found


def _named_like_blocks(tree: Value) -> list[Fault]:
    """Components that are called like a block which `--set` reaches: `run.stop` would mean both."""
    return [
        Fault(component.named_at, f"{name} is no name for a component: --set {name}.NAME means the block {name}",
              f"Give it another name, such as {name}_1, here and in the connections.")
        for name, component in _block(tree, "components").items() if name in (*BLOCKS, "parameters")
    ]  # fmt: skip


def _loose_ends(tree: Value) -> list[Fault]:
    """Connections that name no component of the netlist, or join a port to itself; a netlist without any."""
    known = _block(tree, "components")
    faults: list[Fault] = []
    if not known:
        faults.append(
            Fault(tree.where, "the netlist has no components", "Name at least one under components:.")
        )
    listed = tree.entries["connections"].content if "connections" in tree.entries else None
    for item in listed if isinstance(listed, list) else []:
        seen: dict[Any, Value] = {}
        for end in item.content if isinstance(item.content, list) else []:
            if not isinstance(end.content, str) or len(faults) > MOST_FAULTS:
                continue
            faults += _unknown_owner(end, known)
            if end.content in seen:
                faults.append(
                    Fault(end.where, f"{shown(end.content)} is connected to itself", "Name two ports.")
                )
            seen[end.content] = end
    return faults


def _unknown_owner(end: Value, known: Mapping[str, Value]) -> list[Fault]:
    owner = _owner(EndPoint(str(end.content), end.where))
    if owner in known or not owner:
        return []
    advice = f"{did_you_mean(owner, known)} Components are {listing(known)}.".strip() if known else ""
    return [Fault(end.where, f"{shown(end.content)}: there is no component {shown(owner)}", advice)]


def _owner(end: EndPoint) -> str:
    return end.component.partition("[")[0]


def _block(tree: Value, name: str) -> dict[str, Value]:
    return tree.entries[name].entries if name in tree.entries else {}


def _place(fault: Fault) -> tuple[bool, str, int, int]:
    where = fault.where
    return (where is None, where.file, where.line, where.column) if where else (True, "", 0, 0)
