"""Whose outputs are asked for in a row of the record: of what is recorded, and of what stores energy.

Some read what is known only after the forces: accelerations and reactions. Mostly few of them do, as the force of one
source. Then no laws are asked but those that add to what these read: of a line that is paid out the contacts with the
surface that the source moves, a tenth of all. In the sums that are read they add up in the order in which all would.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fairlead.distinct import distinct
from fairlead.kernels import layout
from fairlead.kernels.layout import STORED_ENERGY
from fairlead.system.arrays.blocks import Block, Integers, Memory
from fairlead.system.arrays.following import runs
from fairlead.system.arrays.portions import Portion
from fairlead.system.numbering.unknowns import Numbering


def what_to_ask(blocks: Sequence[Block], portions: Sequence[Portion], shown: Integers) -> tuple[Integers, Integers]:
    """By block: how many instances are asked for outputs, to record those at the places `shown` and the stored energy.

    And where in z lies what is read by those of them that read what is known only after the forces.
    """
    counts, late = np.zeros(len(blocks), dtype=np.int64), [np.zeros(0, dtype=np.int64)]
    for k, (block, portion) in enumerate(zip(blocks, portions, strict=True)):
        s = block.kernel.structure
        mine = shown[(shown >= portion.outputs) & (shown < portion.outputs + block.count * len(s.all_outputs))]
        instance, output = np.divmod(mine - portion.outputs, len(s.all_outputs))
        stores = np.flatnonzero(np.full(block.count, s.stores))
        instance = np.concatenate([instance, stores])
        output = np.concatenate([output, np.full(len(stores), s.all_outputs.index(STORED_ENERGY))])
        counts[k] = block.count if len(output) else 0
        late.append(block.in_index[instance[_marked(s.late, len(s.all_outputs))[output]]].ravel())
    return counts, distinct(np.concatenate(late)).astype(np.int64)


def flows_to_ask(blocks: Sequence[Block], numbering: Numbering, memory: Memory, read: Integers) -> Integers | None:
    """Calls for the flows that give the accelerations and reactions among the places `read` in z; None: ask for all.

    All it takes where rows of w are no sums of flows: of bodies with parts, of nodes without inertia.
    """
    n, first = len(numbering.unknowns), numbering.acceleration
    rows = read[(read >= first) & (read < first + n)] - first
    reactions = read[(read >= numbering.first_reaction) & (read < numbering.zero)] - numbering.first_reaction
    sums = not (len(memory["parts"]) or len(memory["rated"])) and bool(np.all(memory["inverse_mass"][rows] > 0.0))
    if not sums or bool(_marked(memory["accelerated"][:, layout.ACCELERATED_V], n)[rows].any()):
        return None
    wanted = _marked(np.concatenate([rows, n + reactions]), len(memory["w"]))
    calls = [
        call
        for place, block in enumerate(blocks)
        if block.acts and layout.FLOWS in block.kernel.structure.modes
        for call in runs(place, np.flatnonzero(wanted[block.flow_index].any(axis=1)))
    ]
    return np.array(calls, dtype=np.int64).reshape(-1, layout.CALL)


def _marked(places: Sequence[int] | Integers, length: int) -> NDArray[np.bool_]:
    """[length]: True at these places; np.isin reads in numpy.ma (distinct.py)."""
    found = np.zeros(length, dtype=bool)
    found[places] = True
    return found
