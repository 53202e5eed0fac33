"""Parts of a circuit whose common level nothing determines: their laws ask for differences alone.

A circuit that is joined to no Earth, a bridge that hangs on coils, oil between two lines whose oil keeps moving: each
unknown has an equation, and the equations of one part add up to one without any of them. In the domains of potentials
(pressure, voltage, temperature), in the zones in which a run begins:

1. groups of nodes without capacity are joined by the parts whose flow there reads a potential of one of them; a coil,
   whose current is a state, joins nothing
2. a part that reaches a known potential or a capacity has a level
3. so has one with a law that reads an unknown of its own or a signal, or whose flow changes when all potentials of the
   part rise alike, as that of a chamber behind its bore; laws are asked for that where 2. has left a part over
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

from fairlead.component.assembly import PortRef
from fairlead.component.keys import INPUT, OWN, PORT, key
from fairlead.errors import listing
from fairlead.flatten.flat_model import FlatModel
from fairlead.flatten.graph import connected_parts, of_paths
from fairlead.system.arrays.blocks import Block
from fairlead.system.assembly.left_open import WORDS

SAME = 1e-9
"""Share of its terms by which a sum of derivatives may differ from zero; rounding leaves less."""
AT = (0.7, 1.9, 0.3, 2.3, 1.1, 0.5, 3.1)
"""Numbers at which derivatives are compared, far from each other."""


class Levelless(NamedTuple):
    """Groups whose common level nothing determines, and the parts whose flow into them is a state."""

    groups: list[int]
    keeping: list[str]


class _Reads(NamedTuple):
    """Of one law in one domain: the ports whose potentials it joins, and those whose flow is a state alone."""

    joined: tuple[str, ...]
    keeping: tuple[str, ...]
    anchored: bool


def without_level(flat: FlatModel, blocks: list[Block]) -> Iterator[Levelless]:
    """Parts of the model that nothing gives a level, by groups of nodes."""
    light = {k for k, one in enumerate(flat.groups) if one.free and one.mass == 0 and one.domain.name in WORDS}
    if not light:
        return
    joints, anchors, keeping = [], set(range(len(flat.groups))) - light, list[tuple[int, str]]()
    laws: list[tuple[Block, str, set[int]]] = []
    for block in blocks:
        for domain in WORDS:
            said = _reads(block, domain)
            for instance in block.instances if said.joined or said.keeping else ():
                at = {name: _group(flat, instance.path, name) for name in (*said.joined, *said.keeping)}
                joined = [group for name in said.joined if (group := at[name]) is not None]
                joints.append(joined)
                laws.append((block, domain, set(joined)))
                anchors |= set(joined) if said.anchored else set()
                keeping += [(group, instance.path) for name in said.keeping if (group := at[name]) is not None]
    for found in connected_parts(of_paths(range(len(flat.groups)), joints)):
        part = set(found)
        if part <= light and part.isdisjoint(anchors) and not any(
            part & groups and not _by_differences(block, domain) for block, domain, groups in laws
        ):  # fmt: skip
            yield Levelless(sorted(part), list(dict.fromkeys(path for group, path in keeping if group in part)))


def _group(flat: FlatModel, path: str, port: str) -> int | None:
    ref = PortRef(path, port)
    return flat.place(ref)[0] if ref in flat.node_of else None


def _reads(block: Block, domain: str) -> _Reads:
    """What the flows of a law in its first zone read, in one domain."""
    s, has = block.kernel.structure, block.kernel.variant.type.declaration
    ports = {name for name, port in has.ports.items() if port.domain.name == domain}
    joined, keeping, anchored = set[str](), list[str](), False
    for target, keys in s.flow_inputs[s.zones[0]].items():
        of, read = key(target), [key(one) for one in keys]
        if of.kind != PORT or of.name not in ports:
            continue
        levels = {one.name for one in read if one.kind == PORT and one.name in ports}
        free = any(one.kind == INPUT or (one.kind == OWN and one.name not in has.states) for one in read)
        if levels or free:
            joined |= {of.name, *levels}
            anchored = anchored or free
        elif read:
            keeping.append(of.name)
    return _Reads(tuple(sorted(joined)), tuple(keeping), anchored)


def _by_differences(block: Block, domain: str) -> bool:
    """Whether no flow of a law in its first zone changes when all potentials of a domain rise alike."""
    from fairlead.component.trace import TraceError, trace  # needs SymPy; few scenes come here

    has, zone = block.kernel.variant.type.declaration, block.kernel.structure.zones[0]
    ports = {name for name, port in has.ports.items() if port.domain.name == domain}
    try:
        flows = trace(block.kernel.variant).zones[zone].flows
        return all(_unmoved(flow, ports) for name, flow in flows.items() if name in ports)
    except (TraceError, TypeError, ValueError):  # a law that cannot be asked so may have a level
        return False


def _unmoved(flow: Any, ports: set[str]) -> bool:
    free = sorted(getattr(flow, "free_symbols", ()), key=lambda one: one.name)
    numbers = {one: AT[k % len(AT)] * (1 + k // len(AT)) for k, one in enumerate(free)}
    levels = [one for one in free if key(one.name).kind == PORT and key(one.name).name in ports]
    slopes = [complex(flow.diff(one).subs(numbers).evalf()) for one in levels]
    return abs(sum(slopes)) <= SAME * sum(map(abs, slopes))


def said_of(keeping: list[str], quantity: str) -> str:
    """What is wrong with a part without a level."""
    if not keeping:
        return f"are joined with each other, and to no place whose {quantity} is known"
    each = "flow is a state of its own" if len(keeping) == 1 else "flows are states of their own"
    what = f"are joined with the rest by {listing(keeping, 6)} alone, whose {each}"
    return f"{what}: no law determines the level of their {quantity}"
