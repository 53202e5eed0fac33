"""Includes: the files of a scene are read once each, and merged into one tree."""

from __future__ import annotations

import hashlib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from fairlead.brief import in_a_line
from fairlead.errors import Fault, Location, ModelError, shown
from fairlead.netlist.files import display, inside, read_text, text_of
from fairlead.netlist.limits import Meter, TooMuch
from fairlead.netlist.netlist import Value
from fairlead.netlist.yaml12 import read_yaml

MERGED = ("parameters", "components", "connections")


@dataclass
class Sources:
    """Every file of a scene: one merged tree, the trees of the included files, the faults, all bytes read."""

    top: Path
    tree: Value | None = None
    parts: list[Value] = field(default_factory=list)
    faults: list[Fault] = field(default_factory=list)
    data: bytes = b""  # of every file in the order of reading, each after its length
    texts: dict[str, str] = field(default_factory=dict)  # by the name that messages call a file
    meter: Meter = field(default_factory=Meter)
    seen: set[Path] = field(default_factory=set)
    draft: str | None = None
    """The text of the top netlist as an editor has it, which need not be that of the file."""

    def __repr__(self) -> str:
        return in_a_line(self)

    @property
    def folder(self) -> Path:
        """The folder of the top netlist, which no include may leave."""
        return self.top.resolve().parent

    def digest(self, overrides: Mapping[str, str]) -> str:
        """A hash over the bytes of every file and the overrides, whatever their order."""
        said = "".join(f"{name}={overrides[name]}\0" for name in sorted(overrides))
        return hashlib.sha256(self.data + said.encode("utf-8", "surrogatepass")).hexdigest()


def gather(top: Path, draft: str | None = None) -> Sources:
    """Read a netlist (or take its text) and what it includes; faults are collected, never raised."""
    sources = Sources(top, draft=draft)
    sources.tree = _read(sources, top, None, (top.resolve(),))
    return sources


def _read(sources: Sources, file: Path, named_at: Location | None, chain: tuple[Path, ...]) -> Value | None:
    """The tree of one file with its includes merged in; `chain` leads from the top to this file."""
    sources.seen.add(file.resolve())
    try:
        if sources.draft is not None and len(chain) == 1:
            data = sources.draft.encode()
            text = text_of(data, Location(display(file)))
        else:
            text, data = read_text(file, named_at)
        sources.meter.file(named_at or Location(display(file)), len(data))
    except ModelError as error:
        sources.faults += error.faults
        return None
    except TooMuch as error:
        sources.faults.append(error.fault)
        return None
    sources.data += len(data).to_bytes(8, "little") + data
    sources.texts[display(file)] = text
    tree, faults = read_yaml(text, display(file), sources.meter)
    sources.faults += faults
    if tree is None or not isinstance(tree.content, dict):
        if not faults:
            sources.faults.append(_not_a_map(tree, display(file)))
        return None
    return _with_includes(sources, tree, file, chain)


def _with_includes(sources: Sources, tree: Value, file: Path, chain: tuple[Path, ...]) -> Value:
    """The tree with the parts of the files it includes put before its own."""
    entry = tree.entries.get("include")
    listed = entry.content if entry and isinstance(entry.content, list) else []
    parts = []
    for item in listed:
        if isinstance(item.content, str) and (found := _follow(sources, item, file, chain)):
            part = _read(sources, found, item.where, (*chain, found))
            parts += [part] if part else []
    sources.parts += parts
    return _merge(tree, parts, sources.faults) if parts else tree


def _follow(sources: Sources, item: Value, file: Path, chain: tuple[Path, ...]) -> Path | None:
    """The file an include names, or None: when it cannot be used (a fault) or has been read already."""
    try:
        found = inside(sources.folder, file.resolve().parent, str(item.content), item.where)
    except ModelError as error:
        sources.faults += error.faults
        return None
    if found in chain:
        circle = " -> ".join(display(link) for link in (*chain[chain.index(found) :], found))
        sources.faults.append(Fault(item.where, f"include goes round in a circle: {circle}"))
        return None
    return None if found in sources.seen else found


def _merge(tree: Value, parts: list[Value], faults: list[Fault]) -> Value:
    """The tree with components, connections and parameters of its parts; the tree's own parameters win."""
    entries = dict(tree.entries)
    for section in MERGED:
        blocks = [block for part in (*parts, tree) if (block := part.entries.get(section))]
        if section == "connections":
            lists = [block for block in blocks if isinstance(block.content, list)]
            joined: object = [item for block in lists for item in block.content]  # type: ignore[union-attr]
        else:
            own = tree.entries.get(section) if section == "parameters" else None
            joined = _join([block for block in blocks if isinstance(block.content, dict)], own, faults)
        wrong = any(
            not isinstance(block.content, (dict, list)) and block.content is not None for block in blocks
        )
        if blocks and not wrong:
            entries[section] = replace(blocks[-1], content=joined)  # type: ignore[arg-type]
    return replace(tree, content=entries)


def _join(blocks: list[Value], winner: Value | None, faults: list[Fault]) -> dict[str, Value]:
    joined: dict[str, Value] = {}
    for block in blocks:
        for name, value in block.entries.items():
            first = joined.get(name)
            if first and first.key_where != value.key_where and block is not winner:
                way_out = f"It stands at {first.named_at} already; names are shared by all included files."
                faults.append(Fault(value.named_at, f"{shown(name)} is given twice", way_out))
            else:
                joined[name] = value
    return joined


def _not_a_map(tree: Value | None, file: str) -> Fault:
    if tree is None or tree.content is None:
        return Fault(Location(file), "this file is empty", "A netlist begins with schema: 1.")
    holds = shown(tree.content) if isinstance(tree.content, list) else f"the text {shown(tree.content)}"
    return Fault(
        tree.where, f"this is not a netlist: the file holds {holds}", "A netlist begins with schema: 1."
    )
