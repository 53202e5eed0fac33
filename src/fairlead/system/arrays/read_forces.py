"""Forces of rigid parts that other laws read, as the friction of a screw reads what presses its flanks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fairlead.kernels.structure import Structure
from fairlead.system.arrays.blocks import Block, Integers
from fairlead.system.numbering.unknowns import Numbering


def pressing(blocks: Sequence[Block], numbering: Numbering) -> Integers:
    """[k, 2]: rows that hold for ever whose force a law reads through signals, and the sign of its answer to a push.

    A body p takes in  sense c_p force  of a row that keeps  sum c_p v_p  at zero. So what pushes that sum up by itself
    is answered by a force of the sign of -sense.
    """
    read = _read_by_laws(blocks, numbering)
    found: list[tuple[int, int]] = []
    for block in blocks:
        s = block.kernel.structure
        for unknown in s.rigid:
            if not _holds_for_ever(s, unknown):
                continue
            at, row = s.inputs.index(f"own:{unknown}"), s.targets.index(f"own:{unknown}")
            sign = -int(np.sign(s.senses[unknown]))
            found += [(k, sign) for k in block.flow_index[read[block.in_index[:, at]], row].tolist()]
    return np.array(found, dtype=np.int64).reshape(-1, 2)


def _holds_for_ever(s: Structure, unknown: str) -> bool:
    """Whether a row holds in all zones, keeps speeds together, and is read."""
    known = unknown in s.senses and unknown not in s.positions and f"own:{unknown}" in s.inputs
    return known and set(s.holds[unknown]) == set(s.zones)


def _read_by_laws(blocks: Sequence[Block], numbering: Numbering) -> NDArray[np.bool_]:
    """Places in z of signals that flows depend on, and of what those signals are made of."""
    n, dump, end = numbering.n, numbering.dump, numbering.first_reaction
    size = 1 + max([dump, *(int(block.in_index.max(initial=0)) for block in blocks)])
    read = np.zeros(size, dtype=bool)
    results, sources = [], []
    for block in blocks:
        s = block.kernel.structure
        for i in {i for _, i in s.d_flows}:
            read[block.in_index[:, i]] = True
        for o, i in s.d_signals:
            results.append(block.sig_index[:, o])
            sources.append(block.in_index[:, i])
    read[:n] = read[end:] = False
    result, source = (np.concatenate(many) if many else np.zeros(0, dtype=np.int64) for many in (results, sources))
    result, source = result[result != dump], source[result != dump]
    before = -1
    while (now := int(read.sum())) > before:
        before = now
        read[source[read[result]]] = True
    return read
