"""Everything a run can record: the outputs of all instances under their names, and the energy ledger."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from fairlead.flatten.flat_model import FlatModel
from fairlead.kernels.layout import STORED_ENERGY
from fairlead.system.arrays.blocks import Block, Integers
from fairlead.system.arrays.portions import Portion
from fairlead.system.arrays.recording import OutputSignal
from fairlead.system.numbering.unknowns import Numbering


def stored(blocks: Sequence[Block], portions: Sequence[Portion]) -> Integers:
    """Where among all outputs the stored energy of every instance lies that may have some."""
    found: list[int] = []
    for block, portion in zip(blocks, portions, strict=True):
        names = block.kernel.structure.all_outputs
        if block.kernel.structure.stores:
            found += [portion.outputs + i * len(names) + names.index(STORED_ENERGY) for i in range(block.count)]
    return np.array(found, dtype=np.int64)


def signals(
    flat: FlatModel, blocks: Sequence[Block], portions: Sequence[Portion], numbering: Numbering
) -> list[OutputSignal]:
    """Every output of every instance, also under the outer names of composites, and the ledger."""
    found = [signal for pair in zip(blocks, portions, strict=True) for signal in _of_block(*pair)]
    by_name = {signal.name: signal for signal in found}
    for outer, inner in flat.assembly.aliases.items():
        if str(inner) in by_name and outer != str(inner):
            signal = by_name[str(inner)]
            found.append(replace(signal, name=outer))
    order = {instance.path: place for place, instance in enumerate(flat.instances)}
    found.sort(key=lambda signal: order.get(signal.name.rpartition(".")[0], -1))
    ledger = [OutputSignal(f"energy.{line}", "J", f"Energy {line}.", -1 - at) for line, at in numbering.ledger.items()]
    return found + ledger


def _of_block(block: Block, portion: Portion) -> list[OutputSignal]:
    s, has = block.kernel.structure, block.kernel.variant.type.declaration
    return [
        OutputSignal(
            f"{instance.path}.{name}", has.outputs[name].unit, has.outputs[name].doc,
            portion.outputs + i * len(s.all_outputs) + k, has.outputs[name].role, has.outputs[name].rounded_by,
        )
        for i, instance in enumerate(block.instances)
        for k, name in enumerate(s.outputs)
        if name in has.outputs
    ]  # fmt: skip
