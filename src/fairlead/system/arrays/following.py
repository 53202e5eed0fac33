"""Who follows a given motion: the instances that read one, or read a signal of one that does.

A step of `stepping` asks what f has more with given motions on the chord of the step than where they are in its middle.
All other laws give the same there twice, so they are not asked.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fairlead.kernels import layout
from fairlead.system.arrays.blocks import Block, Integers, Memory

Booleans = NDArray[np.bool_]


def followers(blocks: Sequence[Block], schedule: Integers, given: Integers, dump: int) -> Memory:
    """Calls for the signals of those that follow, in the order of `schedule`, and for their flows.

    `given` are the places in z of motions that are given; signals that nothing reads go to `dump`.
    """
    followed = np.zeros(dump + 1, dtype=bool)
    followed[given] = True
    signals: list[list[int]] = []
    for place, first, end in schedule.tolist():
        found = first + np.flatnonzero(_reads(blocks[place], followed)[first:end])
        signals += runs(place, found)
        followed[blocks[place].sig_index[found]] = True
        followed[dump] = False
    flows = [
        call
        for place, block in enumerate(blocks)
        if block.acts and layout.FLOWS in block.kernel.structure.modes
        for call in runs(place, np.flatnonzero(_reads(block, followed)))
    ]
    return {
        "following": np.array(signals, dtype=np.int64).reshape(-1, layout.CALL),
        "following_flows": np.array(flows, dtype=np.int64).reshape(-1, layout.CALL),
    }


def _reads(block: Block, followed: Booleans) -> Booleans:
    """By instance: whether it reads one of these places in z."""
    inside = block.in_index < len(followed)
    return np.any(inside & followed[np.where(inside, block.in_index, 0)], axis=1)


def runs(place: int, found: Integers) -> list[list[int]]:
    """Calls of block `place` for these instances, those next to each other together."""
    runs = np.split(found, np.flatnonzero(np.diff(found) > 1) + 1)
    return [[place, int(run[0]), int(run[-1]) + 1] for run in runs if len(run)]
