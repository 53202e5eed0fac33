"""Whether two compiled systems are the same equations, so that a switch between them is no switch of this scene."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

from fairlead.kernels.kernel import Kernel, write_source


def same(one: Any, other: Any) -> bool:
    """True when two Systems have equal components, joined alike, with equal parameters and laws that say the same."""
    mine, its = _parts(one), _parts(other)
    if mine.keys() != its.keys() or _wiring(one.flat) != _wiring(other.flat):
        return False
    if sorted(one.unknown_names) != sorted(other.unknown_names):  # the energy ledger belongs to no component
        return False
    return all(mine[path][1] == its[path][1] and _same_law(mine[path][0], its[path][0]) for path in mine)


def _parts(system: Any) -> dict[str, tuple[Kernel, str]]:
    """Path of a component -> its law, and what it was given besides its effects."""
    return {
        instance.path: (block.kernel, repr(_numbers(instance))) for block in system.blocks
        for instance in block.instances
    }  # fmt: skip


def _numbers(instance: Any) -> dict[str, Any]:
    effects = instance.type.declaration.effects
    return {name: repr(value) for name, value in instance.values.given.items() if name not in effects}


def _wiring(flat: Any) -> tuple[Any, ...]:
    return {frozenset(node.ports) for node in flat.nodes}, dict(flat.sources), len(flat.groups)


def _same_law(mine: Kernel, its: Kernel) -> bool:
    """Two variants of a class may come out as the same text: an effect that none of its given parameters enters."""
    if mine.variant == its.variant:
        return True
    if mine.variant.type is not its.variant.type or _facts(mine) != _facts(its):
        return False
    return write_source(mine.variant, 0)[0] == write_source(its.variant, 0)[0]


def _facts(kernel: Kernel) -> str:
    """Its structure, whether it was just traced (tuples) or comes from the cache (lists)."""
    return json.dumps(asdict(kernel.structure), sort_keys=True)
