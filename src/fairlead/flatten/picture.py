"""A flat model as a picture would show it: boxes, wires between them, arrows of signals.

Instances that differ in indices only (`line.hose[0]`, `line.hose[1]`, ...) share a box with a count, and what
then joins the same ports of the same boxes is one wire, so a line of a thousand elements stays a small picture.
"""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass

from fairlead.component.assembly import Instance, PortRef
from fairlead.component.base import Declared
from fairlead.component.scene import is_head
from fairlead.flatten.flat_model import FlatModel

INDEX = re.compile(r"\[(\d+)\]")
End = tuple[int, str]  # number of a box, port of it


@dataclass(frozen=True)
class Box:
    """One component, or several that differ in their indices only."""

    name: str  # "spring", "line.hose[0..59]"
    type: str
    count: int
    anchored: bool  # its motion is given

    @property
    def caption(self) -> str:
        """What it is, below its name."""
        return self.type if self.count == 1 else f"{self.count} x {self.type}"


@dataclass(frozen=True)
class Wire:
    """Ports that are joined, in one domain."""

    ends: tuple[End, ...]
    domain: str
    count: int


@dataclass(frozen=True)
class Arrow:
    """A signal from an output to an input."""

    source: End
    target: End
    count: int


@dataclass(frozen=True)
class Picture:
    """What there is to draw."""

    name: str
    boxes: tuple[Box, ...]
    wires: tuple[Wire, ...]
    arrows: tuple[Arrow, ...]


def picture(flat: FlatModel) -> Picture:
    """The boxes, wires and arrows of a model."""
    alike: dict[str, list[Instance]] = {}
    for instance in flat.instances:
        alike.setdefault(_pattern(instance.path), []).append(instance)
    number = {pattern: k for k, pattern in enumerate(alike)}

    def end(port: PortRef) -> End:
        return number[_pattern(port.instance)], port.port

    wires = Counter((_ends(map(end, node.ports)), node.domain.name) for node in flat.nodes if len(node.ports) > 1)
    arrows = Counter((end(source), end(target)) for target, source in flat.sources.items())
    return Picture(
        flat.assembly.netlist.name,
        tuple(_box(flat, instances) for instances in alike.values()),
        tuple(Wire(ends, domain, count) for (ends, domain), count in _without_parts(wires).items()),
        tuple(Arrow(source, target, count) for (source, target), count in arrows.items()),
    )


def _pattern(path: str) -> str:
    return INDEX.sub("[]", path)


def _ends(ends: object) -> tuple[End, ...]:
    return tuple(sorted(set(ends)))  # type: ignore[call-overload]


def _box(flat: FlatModel, instances: list[Instance]) -> Box:
    first = instances[0]
    anchored = first.type.answers.prescribes is not None
    return Box(_ranged([i.path for i in instances]), _type(first.type), len(instances), anchored)


def _type(kind: type[Declared]) -> str:
    """The type as the netlist names it: `Contact, hold` for a kind of a family."""
    head = next((base for base in kind.__mro__ if issubclass(base, Declared) and is_head(base)), None)
    return kind.__name__ if head is None else f"{head.__name__}, {kind.word}"  # type: ignore[attr-defined]


def _ranged(paths: list[str]) -> str:
    """`line.hose[0..59]` for the paths of all elements."""
    if len(paths) == 1:
        return paths[0]
    columns = zip(*([int(k) for k in INDEX.findall(path)] for path in paths), strict=True)
    ranges = iter(f"[{min(c)}..{max(c)}]" if min(c) < max(c) else f"[{min(c)}]" for c in map(list, columns))
    return INDEX.sub(lambda _: next(ranges), paths[0])


def _without_parts(wires: Counter[tuple[tuple[End, ...], str]]) -> Counter[tuple[tuple[End, ...], str]]:
    """Without wires that are part of another: the ends of a line join fewer ports than its middle."""
    kept: Counter[tuple[tuple[End, ...], str]] = Counter()
    for (ends, domain), count in sorted(wires.items(), key=lambda item: -len(item[0][0])):
        whole = next((key for key in kept if set(ends) <= set(key[0])), (ends, domain))
        kept[whole] += count
    return kept
