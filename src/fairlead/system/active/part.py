"""A part of a System that an engine works on, and what it gives back to the whole."""

from __future__ import annotations

import dataclasses

import numpy as np

from fairlead.kernels import layout
from fairlead.system.active.entrained import Entrained
from fairlead.system.active.rest import Floats, Integers
from fairlead.system.arrays.working import Bytes
from fairlead.system.callbacks.table import SPREAD
from fairlead.system.compiled.asking import call
from fairlead.system.compiled.system import Instance, begun
from fairlead.system.numbering.tolerances import Weights


@dataclasses.dataclass(frozen=True)
class Part:
    """What moves, and where it lies in the whole."""

    problem: Instance
    unknowns: Integers
    machines: Integers
    guards: Integers
    boundary: Integers
    """By machine of the part: 1 if its change ends what is true of the part."""
    whole: Instance
    carried: Entrained

    @property
    def sure(self) -> bool:
        """True if what is left out cannot move by itself, however little the run has shown."""
        return bool(len(self.carried.unknowns))

    def placed(self, piece: Bytes, whole: Instance) -> Part:
        """The same part at work in another piece of memory, for the whole that is at work in its own."""
        mine = self.problem
        weights = Weights(mine.absolute, mine.relative, mine.cap, mine.guard_tolerance)
        shared = {block.kernel.address: block.parameters for block in whole.blocks}  # samples go to both
        blocks = [
            dataclasses.replace(b, parameters=shared[b.kernel.address]) if b.kernel.structure.period else b
            for b in mine.of.blocks  # of what samples, all instances stay
        ]
        made = begun(dataclasses.replace(mine.of, blocks=blocks), weights, mine.record, piece)
        piece[:] = mine.piece
        made.memory.update({name: np.array(mine.memory[name]) for name in TOLD})
        made.memory["context"][layout.SLIP_SHOWN] = mine.memory["context"][layout.SLIP_SHOWN]
        tie(made, whole)
        hand_over(mine, made)
        return dataclasses.replace(self, problem=made, whole=whole)

    def prolong(self, t: float, y: Floats) -> None:
        """Give the whole, whose unknowns are y [n], what is entrained at t, and what its controllers know."""
        call(self.problem, SPREAD, t, y[self.unknowns], y)
        hand_over(self.problem, self.whole)

    def carry(self, of_unknowns: Floats) -> None:
        """Give what is entrained the share of its carrier in numbers by unknown of the whole, such as slopes."""
        u, what = self.carried.unknowns, self.carried
        own = what.place[u] < self.whole.n
        of_unknowns[u[own]] = what.ratio[u[own]] * of_unknowns[what.place[u[own]]]


TOLD = ("whole_y", "kept", "kept_machines", "carried", "carried_coef")
"""Arrays of a part that `spread` works with, see layout.py."""


def tie(part: Instance, whole: Instance) -> None:
    """Write into the context of a part where these arrays are, and those of its whole."""
    context = part.memory["context"]
    for name in TOLD:
        part.memory[name] = np.ascontiguousarray(part.memory[name])
        context[getattr(layout, name.upper())] = part.memory[name].ctypes.data
    context[layout.N_KEPT_MACHINES], context[layout.N_CARRIED] = (
        len(part.memory[name]) for name in ("kept_machines", "carried")
    )  # fmt: skip
    context[layout.WHOLE] = whole.context
    context[layout.WHOLE_ZONES], context[layout.WHOLE_W] = (whole.memory[name].ctypes.data for name in ("zones", "w"))


def hand_over(one: Instance, other: Instance) -> None:
    """Give another System of the same sampled instances what they know: counts of samples, objects in Python."""
    for name in ("sample_count", "sample_start"):
        other.memory[name][:] = one.memory[name]
    for mine, its in zip(one.controllers, other.controllers, strict=True):
        its.take_over(mine)
