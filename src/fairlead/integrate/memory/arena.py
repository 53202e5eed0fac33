"""The memory of a run: everything that it changes in one arena, and the addresses of what it needs.

    structs    numbers of each owner, and addresses: of arrays, of the C functions of the problem, of their context
    arrays     one after another, then what the callbacks of the problem change
    behind     scratch arrays, which hold nothing between two steps

The compiled loop takes the address of the structs and nothing else. So it compiles once for every problem, allocates
nothing, and a run can leave it at any step and come back. What no run changes (plans, patterns, the method) lies
elsewhere, and runs share it; so do the buffers for what is recorded, which Python empties.

A copy of the arena, addresses blotted out, is the state of a run: copied to the same arena it takes the run back, to
the arena of another run of the same problem it makes that go on from here. Addresses are made once, when an arena is;
an index in the loop then costs what it does in any array. Everything here is eight bytes wide.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fairlead.integrate.memory.layout import FLAT, INDICES, LAYOUT, LINKED, LINKED_NAMES, LINKS, PLACES, VECTORS

BUFFERS = ("row_t", "row_values", "row_side", *(f"event_{of}" for of in ("t", "machine", "before", "after", "guard",
           "position")))  # fmt: skip
"""Arrays for what is recorded."""
OF_INSTANCE = ("zones", "guard_inertia", "rebound", "absolute", "relative", "cap", "column_scale")
"""Arrays that the instance of the problem has, and no step writes to but for its zones."""
SCRATCH = (
    "zones_history", "patterns_met", "bump_left", "bump_left_g", "bump_top", "bump_top_g", "bump_right",
    "bump_right_g", "bump_asks", "bump_rise", "bump_fall", "bump_guard", "bump_places",
)  # fmt: skip
"""Arrays that hold nothing between two steps, and are long."""
LINE = 64
"""Bytes of a line of the processor's cache; every array begins one."""


class State(NamedTuple):
    """Where a run is: a copy of its arena, and of the arrays that a replan put in place of others."""

    arena: NDArray[np.uint8]
    replaced: dict[str, NDArray[Any]]


class _Arrays(dict[str, np.ndarray]):
    """Arrays by name; those of the arena are views of it, made when first asked for."""

    def __init__(self, memory: NDArray[np.uint8], places: Mapping[str, int], lengths: Mapping[str, int]) -> None:
        super().__init__()
        self._memory, self._places, self._lengths = memory, places, lengths

    def __missing__(self, name: str) -> np.ndarray:
        at = self._places[name]
        kind = np.float64 if name in VECTORS else np.int64
        self[name] = self._memory[at : at + 8 * self._lengths[name]].view(kind)
        return self[name]


class Memory:
    """Structs, arrays and scratch of one run, owned by Python, and views of all of them.

    `number[...]` reads and writes single values, `array[...]` the arrays, `piece` is what the problem changes.
    """

    def __init__(self, lengths: Mapping[str, int], given: Mapping[str, np.ndarray], room: int = 0) -> None:
        """Arrays by `lengths` (as named in VECTORS and INDICES), with `room` bytes for the problem.

        Arrays in `given` are used as they are and not changed; buffers, and what the instance has, wait for `point`.
        """
        length_of = {name: lengths[length] for name, length in (VECTORS | INDICES).items()}
        places, size = {}, _lines(LAYOUT.itemsize)
        elsewhere = {*given, *BUFFERS, *OF_INSTANCE, *SCRATCH}
        for name, length in length_of.items():
            if name not in elsewhere:
                places[name], size = size, size + _lines(8 * length)
        piece, size = size, size + _lines(room)
        for name in SCRATCH:
            places[name], size = size, size + _lines(8 * length_of[name])
        memory = np.zeros(size + LINE, dtype=np.uint8)
        memory = memory[-memory.ctypes.data % LINE :][:size]
        self.struct = memory[: LAYOUT.itemsize].view(FLAT)
        self.words = memory[: LAYOUT.itemsize].view(np.int64)
        self.arena, self.piece = memory[: piece + room], memory[piece : piece + room]
        self.array: dict[str, np.ndarray] = _Arrays(memory, places, length_of)
        self.replaced: dict[str, np.ndarray] = {}
        self._first: dict[str, np.ndarray] = {}  # what stood where something was replaced
        self.words[LINKED] = memory.ctypes.data + np.array([places.get(name, 0) for name in LINKED_NAMES])
        for name, array in given.items():
            self.point(name, array, np.float64 if name in VECTORS else np.int64)

    def _link(self, name: str, address: int) -> None:
        """Write the address of an array, for all owners that have it."""
        for at in PLACES[f"at_{name}"]:
            self.words[at // 8] = address

    def point(self, name: str, array: np.ndarray, kind: Any) -> None:
        """Make `name` stand for `array`, in place if it already has the right type."""
        fitting = np.ascontiguousarray(array, dtype=kind)
        if fitting.size == 0:
            fitting = np.zeros(1, kind)[:0]
        self.array[name] = fitting
        self._link(name, fitting.ctypes.data)

    def spread(self) -> None:
        """Give every owner the sizes of which it has a copy."""
        for name, (home, *others) in PLACES.items():
            if not name.startswith("at_"):
                for at in others:
                    self.words[at // 8] = self.words[home // 8]

    def replace(self, arrays: Mapping[str, np.ndarray]) -> None:
        """Put these in place of arrays of other lengths: an order of pivots that the run has come upon."""
        for name, array in arrays.items():
            self._first.setdefault(name, self.array[name])
            self.replaced[name] = array
            self.point(name, array, array.dtype)

    def save(self) -> State:
        """A copy of where the run is, between two steps."""
        arena = self.arena.copy()
        arena[: LAYOUT.itemsize].view(np.int64)[LINKS] = 0
        return State(arena, {name: array.copy() for name, array in self.replaced.items()})

    def restore(self, state: State) -> None:
        """Go to where a run was that has the same problem and settings."""
        links = self.words[LINKS]
        self.arena[:] = state.arena
        self.words[LINKS] = links
        for name, array in self._first.items():
            self.point(name, array, array.dtype)
        self.replaced = {}
        self.replace({name: array.copy() for name, array in state.replaced.items()})

    @property
    def number(self) -> Any:
        """All single values as a record: number["t"]."""
        return self.struct[0]

    @property
    def address(self) -> int:
        """Where the structs are."""
        return int(self.struct.ctypes.data)


def _lines(size: int) -> int:
    """Bytes of so many whole lines that hold `size`."""
    return -(-size // LINE) * LINE
