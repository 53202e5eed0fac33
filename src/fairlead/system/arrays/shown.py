"""Whose outputs are asked for in a row of the record: of what is recorded, and of what stores energy."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from fairlead.kernels.layout import STORED_ENERGY
from fairlead.system.arrays.blocks import Block, Integers
from fairlead.system.arrays.shares import Share


def what_to_ask(blocks: Sequence[Block], shares: Sequence[Share], shown: Integers) -> tuple[Integers, bool]:
    """By block: how many instances are asked for outputs, to record those at the places `shown` and the stored energy.

    And whether one of them reads what is known only after the forces: an acceleration or a reaction.
    """
    counts, late = np.zeros(len(blocks), dtype=np.int64), False
    for k, (block, share) in enumerate(zip(blocks, shares, strict=True)):
        s = block.kernel.structure
        mine = shown[(shown >= share.outputs) & (shown < share.outputs + block.count * len(s.all_outputs))]
        asked = set(((mine - share.outputs) % len(s.all_outputs)).tolist())
        if s.stores:
            asked.add(s.all_outputs.index(STORED_ENERGY))
        counts[k] = block.count if asked else 0
        late = late or bool(asked & set(s.late))
    return counts, late
