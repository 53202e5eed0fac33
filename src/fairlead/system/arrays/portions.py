"""Which part of the common vectors every block fills, and the rows that tell its kernel so."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from fairlead.kernels import layout
from fairlead.system.arrays.blocks import Block, Floats, Memory

FIRST_PARTIAL = 1  # the vector of partial derivatives begins with a constant 1


class Portion(NamedTuple):
    """Where the numbers of a block begin: four kinds of partial derivatives in one vector, guards, outputs, swings."""

    signals: int
    flows: int
    ledger: int
    mass: int
    guards: int
    outputs: int
    swings: int


def portions(blocks: Sequence[Block]) -> tuple[list[Portion], Portion]:
    """The portion of every block, in order; and where the next one would begin."""
    found = []
    partials, guards, outputs, swings = FIRST_PARTIAL, 0, 0, 0
    for block in blocks:
        s = block.kernel.structure
        sizes = [block.count * len(pairs) for pairs in (s.d_signals, s.d_flows, s.d_ledger, s.mass)]
        first, second, third, fourth, partials = (partials + np.cumsum([0, *sizes])).tolist()
        found.append(Portion(first, second, third, fourth, guards, outputs, swings))
        guards += block.count * s.slots
        outputs += block.count * len(s.all_outputs)
        swings += block.count * len(s.swings)
    return found, Portion(partials, partials, partials, partials, guards, outputs, swings)


def rows(blocks: Sequence[Block], laid: Sequence[Portion], end: Portion) -> Memory:
    """The blocks' rows (see `layout.py`), and the vectors that the blocks share."""
    table = np.zeros((len(blocks), layout.BLOCK), dtype=np.int64)
    for row, block, portion in zip(table, blocks, laid, strict=True):
        arrays = (block.parameters, block.in_index, block.in_coef, block.in_offset, block.machines, block.table_base,
                  block.sig_index, block.flow_index, block.flow_coef, block.ledger_index)  # fmt: skip
        row[: len(arrays)] = [array.ctypes.data for array in arrays]
        row[layout.D_SIGNALS : layout.D_SIGNALS + len(portion)] = portion
        row[layout.IN_COEF_STEP :] = [_step(a) for a in (block.in_coef, block.in_offset, block.flow_coef)]
    return {"blocks": table, "partials": np.ones(end.mass), "outputs_all": np.zeros(end.outputs)}


def _step(table: Floats) -> int:
    """Numbers from one instance to the next; 0 where all have the same: the kernel then reads those of the first."""
    return 0 if bool((table == table[:1]).all()) else int(table.shape[1])
