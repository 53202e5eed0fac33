"""A System of which some inputs are set from outside while it runs: signal inputs that nothing is connected to.

    opened(system, inputs)      the System with these inputs, set by `Instance.memory["set_values"]` and `set_due`

What is set takes effect at the next time event (`at_time` in switching.py), so that zones settle anew on it as after
any jump. It lies in the memory of the run, and goes along with a copy of that.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from fairlead.component.assembly import PortRef
from fairlead.component.declare import Input
from fairlead.component.keys import INPUT, RATE, key
from fairlead.system.arrays.blocks import Memory
from fairlead.system.arrays.working import offsets, with_more
from fairlead.system.compiled.system import System


class FreeInput(NamedTuple):
    """A signal input that nothing is connected to: its names, where it lies, and what it is until it is set."""

    names: Sequence[str]
    declared: Input
    place: tuple[int, int, int]
    """Block, instance in it, and input of that."""
    value: float


def nothing_set() -> Memory:
    """What a System has of this that is closed."""
    return {"set_due": np.zeros(1, np.int64), "set_values": np.zeros(0), "set_places": np.zeros((0, 3), np.int64)}


def free_inputs(system: System) -> Iterator[FreeInput]:
    """All inputs that can be set, those of composites under their outer names too."""
    outer: dict[PortRef, list[str]] = {}
    for name, inner in system.flat.assembly.aliases.items():
        outer.setdefault(inner, []).append(name)
    for k, block in enumerate(system.blocks):
        keys = map(key, block.kernel.structure.inputs)
        read = {one.name: j for j, one in enumerate(keys) if one.kind == INPUT and one.part != RATE}
        for i, instance in enumerate(block.instances):
            for name, declared in instance.type.declaration.inputs.items():
                ref = PortRef(instance.path, name)
                if name in read and ref not in system.flat.sources:
                    value = float(block.in_offset[i, read[name]])
                    yield FreeInput([str(ref), *outer.get(ref, ())], declared, (k, i, read[name]), value)


def opened(system: System, inputs: Sequence[FreeInput]) -> System:
    """The System in whose runs these are set; it shares the rest with `system`, which stays as it is."""
    places = np.array([one.place for one in inputs], dtype=np.int64).reshape(-1, 3)
    more = {offsets(k): system.blocks[k].in_offset for k in np.unique(places[:, 0]).tolist()}
    more["set_values"] = np.array([one.value for one in inputs], dtype=float)
    return replace(system, memory=system.memory | {"set_places": places}, working=with_more(system.working, more))
