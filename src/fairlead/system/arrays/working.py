"""The working memory of a System: what its callbacks write to, one array after another in one piece of memory.

Every run has a piece of its own, and everything else is shared: indices, coefficients, tables, plans, code. In the
piece there are numbers only. Addresses lie apart, in a context and rows of blocks that are made for a piece, so that a
copy of a piece is the state of the callbacks, whatever piece it is put into.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fairlead.brief import in_a_line
from fairlead.kernels import layout
from fairlead.system.arrays.blocks import Block, Memory

CHANGED = (
    "z", "w", "zones", "partials", "work", "moving_base", "fixed_done", "outputs_all", "f_rest", "sample_count",
    "sample_start", "set_due", "set_values", "circle_seen", "circle_still", "circle_nodes", "circle_ratio",
    "guard_inertia", "rated_known", "rated_root", "rated_mode", "given_mean", "mean", "light_work",
    "light_given", "zones_kept", "guards_now", "told_fired",
)  # fmt: skip
"""Arrays that callbacks write to, by their names in `layout.py`; and the discrete variables of sampled blocks, and the
inputs of blocks that are set from outside."""
LINE = 64  # bytes: every array begins a line of the processor's cache
Bytes = NDArray[np.uint8]


class Place(NamedTuple):
    """Where an array lies in the piece of memory, in bytes, and what it is."""

    at: int
    shape: tuple[int, ...]
    kind: np.dtype[Any]

    def of(self, piece: Bytes) -> NDArray[Any]:
        """The array in a piece."""
        length = int(np.prod(self.shape, dtype=np.int64))
        return piece[self.at : self.at + 8 * length].view(self.kind).reshape(self.shape)


@dataclass(frozen=True, eq=False)
class Working:
    """Where every array lies that a run changes, and what it is at first unless zero."""

    __repr__ = in_a_line

    size: int
    places: dict[str, Place]
    begin: Memory

    def arrays(self, piece: Bytes) -> Memory:
        """The arrays in a piece."""
        return {name: place.of(piece) for name, place in self.places.items()}

    def new(self) -> Bytes:
        """A piece for one run."""
        room = np.zeros(self.size + LINE, dtype=np.uint8)
        skip = -room.ctypes.data % LINE
        return room[skip : skip + self.size]


def discrete(number: int) -> str:
    """The name of the parameters of a sampled block, of which some are its discrete variables."""
    return f"parameters {number}"


def offsets(number: int) -> str:
    """The name of the offsets of a block of which some inputs are set from outside."""
    return f"offsets {number}"


def with_more(working: Working, more: Memory) -> Working:
    """The same with these arrays behind, or in place of arrays of other lengths."""
    places, size = dict(working.places), working.size
    for name, array in more.items():
        places[name] = Place(size, array.shape, array.dtype)
        size += -(-8 * array.size // LINE) * LINE
    return Working(size, places, working.begin | {name: array for name, array in more.items() if array.any()})


def set_apart(memory: Memory, blocks: list[Block], *, samples: bool) -> Working:
    """Take what a run changes out of `memory`, and say where it lies; there its first values remain, not to be changed.

    Without `samples` the discrete variables stay where they are: a part of a model samples for the whole.
    """
    changed = {name: memory[name] for name in CHANGED}
    if samples:
        changed |= {discrete(k): b.parameters for k, b in enumerate(blocks) if b.kernel.structure.period}
    places, size = {}, 0
    for name, array in changed.items():
        places[name] = Place(size, array.shape, array.dtype)
        size += -(-8 * array.size // LINE) * LINE
        array.flags.writeable = False
    return Working(size, places, {name: array for name, array in changed.items() if array.any()})


def addressed(memory: Memory, own: Memory, blocks: list[Block]) -> Memory:
    """Context and rows of blocks for the arrays `own` of a piece; the vectors to keep as long as it is used."""
    context, rows = memory["context"].copy(), memory["blocks"]
    for name in CHANGED:
        context[getattr(layout, name.upper())] = own[name].ctypes.data
    sampled = [k for k, block in enumerate(blocks) if block.kernel.structure.period]
    set_ = [k for k in range(len(blocks)) if offsets(k) in own]
    if sampled or set_:
        rows = rows.copy()
        rows[sampled, layout.PAR] = [blocks[k].parameters.ctypes.data for k in sampled]
        context[layout.BLOCKS] = rows.ctypes.data
    for k in set_:
        own_offset = blocks[k].in_offset
        rows[k, [layout.IN_OFFSET, layout.IN_OFFSET_STEP]] = own_offset.ctypes.data, own_offset.shape[1]
    at = [blocks[k].in_offset[i : i + 1, j].ctypes.data for k, i, j in memory["set_places"].tolist()]
    addresses = np.array(at, dtype=np.int64)
    context[layout.N_SET], context[layout.SET_AT] = len(addresses), addresses.ctypes.data
    return {"context": context, "blocks": rows, "set_at": addresses}
