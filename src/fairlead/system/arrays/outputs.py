"""Everything a run can record: the outputs of all instances under their names, and the energy ledger."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

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
    of: dict[str, list[OutputSignal]] = {}
    for block, portion in zip(blocks, portions, strict=True):
        of |= _of_block(block, portion)
    outer_ones: list[OutputSignal] = []
    for outer, inner in flat.assembly.aliases.items():
        if outer != (name := str(inner)):
            again = [one._replace(name=outer) for one in of.get(inner.instance, ()) if one.name == name]
            of.get(outer.rpartition(".")[0], outer_ones).extend(again)
    found = outer_ones + [signal for instance in flat.instances for signal in of[instance.path]]
    ledger = [OutputSignal(f"energy.{line}", "J", f"Energy {line}.", -1 - at) for line, at in numbering.ledger.items()]
    return found + ledger


def _of_block(block: Block, portion: Portion) -> dict[str, list[OutputSignal]]:
    """The outputs of every instance of a block, by its path."""
    s, has = block.kernel.structure, block.kernel.variant.type.declaration
    told = [(k, name, has.outputs[name]) for k, name in enumerate(s.outputs) if name in has.outputs]
    each = len(s.all_outputs)
    return {
        instance.path: [
            OutputSignal(f"{instance.path}.{name}", one.unit, one.doc, first + k, one.role, one.rounded_by)
            for k, name, one in told
        ]
        for first, instance in zip(itertools.count(portion.outputs, each), block.instances, strict=False)
    }
