"""The elements of a scene: how it is told to take smaller ones, and which outputs of two meshes are the same thing.

A family of m signals at the ends of elements has k (m - 1) + 1 of them with elements k times as fine: number i becomes
number k i. A family of m elements has k m: element i becomes the mean of elements k i ... k i + k - 1. What an
element or a node takes in (the friction of one contact) belongs to its length and is not compared (`role` of outputs).
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from fairlead.quantities import QuantityError, si
from fairlead.results.signal import family

SIZES, COUNTS = ("element",), ("elements", "blocks")  # how netlists and components call the size and the number
GRADED, SIZE = "graded", 1  # rows of a place and the size of elements there


@dataclass(frozen=True)
class Mesh:
    """A size or number of elements: settings that give it, and how much finer than the scene's it is."""

    label: str
    settings: Mapping[str, str] = field(hash=False)
    finer: float


def mesh_settings(model: Any) -> dict[str, float]:
    """Parameters of scene or components that say how fine the elements are, with their values in SI.

    A parameter of the scene is taken for what its components say by it; a graded line has a size for every place.
    """
    netlist = model.netlist
    entries = netlist.components.values()
    found = {name: value.content for name, value in netlist.parameters.items() if name in (*SIZES, *COUNTS)}
    if not found:
        found = {
            f"{entry.name}.{name}": value.content
            for entry in entries if GRADED not in entry.parameters
            for name, value in entry.parameters.items() if name in (*SIZES, *COUNTS)
        }  # fmt: skip
    rows = [
        (f"{entry.name}.{GRADED}.{number}.{SIZE}", row.content[SIZE].content)
        for entry in entries if isinstance(getattr(entry.parameters.get(GRADED), "content", None), list)
        for number, row in enumerate(entry.parameters[GRADED].content)
        if isinstance(row.content, list) and len(row.content) > SIZE
    ]  # fmt: skip
    return _numbers(found | dict(rows))


def meshes(model: Any, factors: Sequence[float]) -> list[Mesh]:
    """Meshes finer by these factors (0.5 is half as fine); none for a scene without elements."""
    now = mesh_settings(model)
    found = []
    for factor in factors if now else ():
        settings = {name: _scaled(name, value, factor) for name, value in now.items()}
        name, text = next(iter(settings.items()))
        known = name.rpartition(".")[2] in (*SIZES, *COUNTS)
        label = f"{name.rpartition('.')[2]} {text}" if known else f"elements / {factor:g}"
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


def _numbers(found: Mapping[str, Any]) -> dict[str, float]:
    numbers = {}
    for name, content in found.items():
        try:
            numbers[name] = si(content, "1" if name.rpartition(".")[2] in COUNTS else "m")
        except QuantityError:  # not a size of elements after all
            continue
    return numbers


def _scaled(name: str, value: float, factor: float) -> str:
    if name.rpartition(".")[2] in COUNTS:
        return str(max(1, round(value * factor)))
    return f"{value / factor:.10g}"
