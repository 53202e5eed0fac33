"""The memory of a run that has not begun, as data: numbers as they are, addresses as places to be filled in.

    memory      of an instance: the arena first, whose beginning is the state; then what else has addresses in it, is
                written to, or follows a parameter (tuned.py). Only what is not zero is kept, in runs of bytes.
    shared      what no run changes and has no address in it
    links       (place in memory, kind, target): an address in memory, in shared, or of a function by number

Nothing else in memory is an address: a word that holds one of an array that is not known here raises ValueError.
"""

from __future__ import annotations

import bisect
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from fairlead.integrate.memory import layout as fields
from fairlead.integrate.memory.arena import BUFFERS, SCRATCH, Memory
from fairlead.kernels import layout
from fairlead.system.arrays.working import CHANGED
from fairlead.system.compiled.context import ADDRESSES
from fairlead.system.compiled.system import Instance

LINE = 64
"""Bytes of a line of the processor's cache; every array begins one."""
MEMORY, SHARED, FUNCTION = range(3)
"""Kinds of targets."""
GAP = 64
"""So many zero bytes end a run of bytes that are kept."""
WITH_ADDRESSES = ("context", "blocks", "kernels", "sample_kernels", "set_at")
"""Arrays of the problem that hold addresses."""
OF_BLOCK = (
    "parameters", "in_index", "in_coef", "in_offset", "machines", "table_base", "sig_index", "flow_index", "flow_coef",
    "ledger_index",
)  # fmt: skip
"""Arrays of a block, in the order of their addresses in its row (layout.py)."""
IN_CONTEXT = (*ADDRESSES, *(name.upper() for name in CHANGED), "SELECTED", "COUNTS", "SHOWN_FLOWS", "SET_AT")
"""Positions of the context that hold addresses."""


class Link(NamedTuple):
    """An address in the memory of an instance."""

    at: int
    kind: int
    target: int


@dataclass(frozen=True)
class Image:
    """The memory of an instance before its start."""

    size: int
    """Bytes of memory."""
    state: int
    """Bytes at its beginning that are the state of a run, once links are blotted out."""
    runs: Sequence[tuple[int, bytes]]
    """Where what is not zero lies, and what it is."""
    shared: bytes
    links: Sequence[Link]
    piece: int
    """Where in memory the piece lies that the callbacks change."""


class _Placed(NamedTuple):
    """An array with its place in memory or in shared."""

    begin: int
    end: int
    kind: int
    at: int
    name: str


class Laid(NamedTuple):
    """The same with the zeros, and with the names of what lies where."""

    memory: np.ndarray
    """Bytes, addresses blotted out."""
    shared: np.ndarray
    links: Sequence[Link]
    arrays: Mapping[str, np.ndarray]
    """By name, as they are in this process."""
    places: Mapping[str, _Placed]


def laid(memory: Memory, own: Instance, functions: Mapping[int, int], moved: Collection[str] = ()) -> Laid:
    """A run at its start; `functions` are the numbers of functions by address.

    `moved` names arrays that no run changes and that are to lie in the memory of an instance all the same. Raises
    ValueError for an address that is not known.
    """
    mine, others = _arrays(memory, own)
    mine |= {name: others.pop(name) for name in moved if name in others}
    placed, size = _laid_out(mine, MEMORY)
    of_others, length = _laid_out(others, SHARED)
    everything = sorted([*placed, *of_others])
    filled, shared = np.zeros(size, np.uint8), np.zeros(length, np.uint8)
    for target, arrays, places in ((filled, mine, placed), (shared, others, of_others)):
        for array, place in zip(arrays.values(), places, strict=True):
            target[place.at : place.at + array.nbytes] = array.reshape(-1).view(np.uint8)
    where = {place.name: place.at for place in placed}
    links = [
        Link(at, *_target(address, name, everything, functions))
        for at, address, name in _addresses(memory, own, where) if address
    ]  # fmt: skip
    words = filled.view(np.int64)
    words[[at // 8 for at, _, _ in _addresses(memory, own, where)]] = 0
    return Laid(filled, shared, links, {**mine, **others}, {place.name: place for place in everything})


def image_of(memory: Memory, own: Instance, found: Laid) -> Image:
    """The image of what was laid."""
    piece = int(own.piece.ctypes.data) - int(memory.arena.ctypes.data)
    return Image(
        found.memory.size, memory.arena.nbytes, list(_runs(found.memory)), found.shared.tobytes(), found.links, piece
    )


def _arrays(memory: Memory, own: Instance) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """What lies in the memory of an instance, and what instances share, by names that occur once."""
    mine = {"arena": memory.arena} | {f"memory {name}": memory.array[name] for name in (*SCRATCH, *BUFFERS)}
    mine |= {name: own.memory[name] for name in WITH_ADDRESSES}
    others = {f"memory {name}": array for name, array in memory.array.items() if f"memory {name}" not in mine}
    others |= {name: array for name, array in own.memory.items() if name not in mine}
    others |= {f"{name} {k}": getattr(block, name) for k, block in enumerate(own.blocks) for name in OF_BLOCK}
    others |= {"selected": own.record.selected, "counts": own.record.counts, "shown_flows": own.record.shown_flows}
    seen = {array.ctypes.data for array in mine.values()}
    begin, end = memory.arena.ctypes.data, memory.arena.ctypes.data + memory.arena.nbytes
    found: dict[str, np.ndarray] = {}
    for name, array in others.items():
        address = array.ctypes.data
        if array.size and address not in seen and not begin <= address < end:
            if not array.flags.c_contiguous:
                raise ValueError(f"{name} does not lie in one piece")
            found[name] = array
            seen.add(address)
    return {name: array for name, array in mine.items() if array.size}, found


def _laid_out(arrays: Mapping[str, np.ndarray], kind: int) -> tuple[list[_Placed], int]:
    """Arrays one after another, and how long that is."""
    placed, size = [], 0
    for name, array in arrays.items():
        begin = int(array.ctypes.data)
        placed.append(_Placed(begin, begin + array.nbytes, kind, size, name))
        size += -(-array.nbytes // LINE) * LINE
    return placed, size


def _addresses(memory: Memory, own: Instance, where: Mapping[str, int]) -> Iterator[tuple[int, int, str]]:
    """(place in memory, address or 0, name) of every word that is one."""
    words = memory.words
    for name, places in fields.PLACES.items():
        if name.startswith(fields.ADDRESSES):
            empty = name.startswith("at_") and memory.array[name[3:]].size == 0
            yield from ((at, 0 if empty else int(words[at // 8]), name) for at in places)
    context = own.memory["context"]
    for name in IN_CONTEXT:
        at = getattr(layout, name)
        yield where["context"] + 8 * at, _unless_empty(own, name.lower(), int(context[at])), name
    for k, block in enumerate(own.blocks):
        for j, name in enumerate(OF_BLOCK):
            empty = getattr(block, name).size == 0
            at, address = where["blocks"] + 8 * (k * layout.BLOCK + j), int(own.memory["blocks"][k, j])
            yield at, 0 if empty else address, f"{name} of {block.kernel.variant.label}"
    for name in ("kernels", "sample_kernels", "set_at"):
        for k, address in enumerate(own.memory[name].tolist()):
            yield where[name] + 8 * k, address, name


def _unless_empty(own: Instance, name: str, address: int) -> int:
    """The address of an array, 0 where it has no entries."""
    return 0 if name in own.memory and own.memory[name].size == 0 else address


def _target(address: int, name: str, placed: Sequence[_Placed], functions: Mapping[int, int]) -> tuple[int, int]:
    """What lies at an address: kind, and place or number."""
    if address in functions:
        return FUNCTION, functions[address]
    k = bisect.bisect_right(placed, address, key=lambda place: place.begin) - 1
    if k >= 0 and address < placed[k].end:
        return placed[k].kind, placed[k].at + address - placed[k].begin
    raise ValueError(f"{name} is at an address that is not known")


def _runs(filled: np.ndarray) -> Iterator[tuple[int, bytes]]:
    """Stretches of bytes that are not zero; few zeros between them are kept."""
    places = np.flatnonzero(filled.view(np.int64)) * 8
    if not len(places):
        return
    cuts = np.flatnonzero(np.diff(places) > GAP)
    for first, last in zip([places[0], *places[cuts + 1]], [*places[cuts], places[-1]], strict=True):
        yield int(first), filled[first : last + 8].tobytes()
