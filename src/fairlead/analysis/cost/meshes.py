"""The elements of a scene: how it is told to take smaller ones, and which outputs of two meshes are the same thing.

A family of m signals at the ends of elements has k (m - 1) + 1 of them with elements k times as fine: number i becomes
number k i. A family of m elements has k m: element i becomes the mean of elements k i ... k i + k - 1. What an
element or a node takes in (the friction of one contact) belongs to its length and is not compared (`role` of outputs).
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from fairlead.analysis.treatments.written import components, scene_parameter
from fairlead.component.given import REQUIRED, Count, Parameter, Table
from fairlead.netlist.netlist import Entry, Value
from fairlead.quantities import si
from fairlead.results.signal import family


@dataclass(frozen=True)
class Fineness:
    """What says how fine the elements are somewhere: the setting that changes it, its value in SI."""

    setting: str
    value: float
    counts: bool  # it is a number of elements, not their size
    alone: bool = True  # it is one of all of them, not that of a place in a line

    def finer(self, factor: float) -> str:
        """The value of a mesh finer by a factor."""
        if self.counts:
            return str(max(1, round(self.value * factor)))
        return f"{self.value / factor:.10g}"


@dataclass(frozen=True)
class Mesh:
    """A size or number of elements: settings that give it, and how much finer than the scene's it is."""

    label: str
    settings: Mapping[str, str] = field(hash=False)
    finer: float


def mesh_settings(model: Any) -> list[Fineness]:
    """What the components of a scene are given for their elements, as their classes declare it (`mesh=True`).

    A parameter of the scene that a component takes as it stands is set in its place, for the scene may use it
    elsewhere too. A table of sizes has one for every place, and then decides.
    """
    found: dict[str, Fineness] = {}
    for entry, kind in components(model):
        mine = {name: one for name, one in kind.declaration.parameters.items() if _is_mesh(one)}
        tables = [name for name, one in mine.items() if isinstance(one, Table) and _given(entry, name) is not None]
        for name in tables or mine:
            said = _graded if name in tables else _single
            for each in said(model, entry, name, mine[name]):
                found.setdefault(each.setting, each)
    return list(found.values())


def _is_mesh(declared: Any) -> bool:
    return isinstance(declared, Parameter | Count | Table) and declared.mesh


def _given(entry: Entry, name: str) -> Value | None:
    value = entry.parameters.get(name)
    return value if value is not None and value.content is not None else None


def _single(model: Any, entry: Entry, name: str, declared: Any) -> Iterator[Fineness]:
    """One size or number; that which it is by default can be set as well."""
    given, counts = _given(entry, name), isinstance(declared, Count)
    setting = (scene_parameter(model, given) if given is not None else None) or f"{entry.name}.{name}"
    content = given.content if given is not None else declared.default
    if content is not REQUIRED and content is not None:
        yield Fineness(setting, si(content, "1" if counts else declared.unit), counts)


def _graded(model: Any, entry: Entry, name: str, declared: Any) -> Iterator[Fineness]:
    """The sizes of a table that is written as rows, or as a list for each column; not those of a file."""
    path, value = f"{entry.name}.{name}", entry.parameters[name]
    sizes = {f"{path}.{k}.1": row.content[1] for k, row in _listed(value) if len(row.content or ()) > 1}
    if not sizes and "y" in value.entries:
        sizes = {f"{path}.y.{k}": one for k, one in _listed(value.entries["y"])}
    for setting, one in sizes.items():
        yield Fineness(scene_parameter(model, one) or setting, si(one.content, declared.y), counts=False, alone=False)


def _listed(value: Value) -> list[tuple[int, Any]]:
    return list(enumerate(value.content)) if isinstance(value.content, list) else []


def meshes(model: Any, factors: Sequence[float]) -> list[Mesh]:
    """Meshes finer by these factors (0.5 is half as fine); none for a scene without elements."""
    now = mesh_settings(model)
    found = []
    for factor in factors if now else ():
        settings = {one.setting: one.finer(factor) for one in now}
        first = now[0]
        name = first.setting.rpartition(".")[2]
        label = f"{name} {first.finer(factor)}" if first.alone else f"elements / {factor:g}"
        found.append(Mesh(label, settings, factor))
    return found


def correspondence(coarse: Sequence[str], fine: Sequence[str]) -> dict[str, list[str]]:
    """Output of the coarse mesh -> signals of the fine one whose mean it is; what has no counterpart is left out."""
    ours, theirs = _families(coarse), _families(fine)
    found = {name: [name] for name in coarse if family(name)[1] is None and name in set(fine)}
    for key, mine in ours.items():
        other = theirs.get(key, [])
        if len(mine) < 2 or not other:
            continue
        first, last, start, end = mine[0], mine[-1], other[0], other[-1]
        nodes, elements = (end - start) / (last - first), (end - start + 1) / (last - first + 1)
        if nodes == int(nodes):
            pairs = {i: [start + int(nodes) * (i - first)] for i in mine}
        elif elements == int(elements):
            k = int(elements)
            pairs = {i: list(range(start + k * (i - first), start + k * (i - first) + k)) for i in mine}
        else:
            continue
        known = set(other)
        for i, others in pairs.items():
            if known.issuperset(others):
                found[key.replace("[*]", f"[{i}]")] = [key.replace("[*]", f"[{j}]") for j in others]
    return found


def _families(names: Sequence[str]) -> dict[str, list[int]]:
    found = defaultdict(list)
    for name in names:
        key, index = family(name)
        if index is not None and "[*]" in key:
            found[key].append(index)
    return {key: sorted(numbers) for key, numbers in found.items()}
