"""What a run records: outputs chosen by name, and what the callbacks must know of the choice."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from fairlead.component.declare import CREEP, INTEGRAL, PULL, STRAIN, USED_UP
from fairlead.kernels import layout
from fairlead.patterns import picked
from fairlead.system.arrays.blocks import Block, Integers, Memory
from fairlead.system.arrays.portions import portions
from fairlead.system.arrays.shown import flows_to_ask, what_to_ask
from fairlead.system.numbering.unknowns import Numbering

WATCHED = (CREEP, STRAIN, PULL, INTEGRAL, USED_UP)
"""Roles of outputs that every run looks at, whatever is recorded."""


class OutputSignal(NamedTuple):
    """One recordable output."""

    name: str
    unit: str
    doc: str
    at: int  # position among all outputs, or -1 - position in z
    role: str = ""  # what it means to the framework, as its Output declares
    rounded_by: str = ""  # likewise, the parameter over which its corner at zero is rounded off


@dataclass(frozen=True, eq=False)
class Recording:
    """What was chosen by name; and all that is recorded: that, then the ledger and what every run watches."""

    chosen: list[OutputSignal]
    recorded: list[OutputSignal]
    selected: Integers
    """Where what is recorded comes from, see layout.py."""
    counts: Integers
    """By mode and block: instances to ask."""
    rates: int
    """RATES_SHOWN: what of it is known only after the forces."""
    shown_flows: Integers
    """Calls for the flows that this takes, if not all."""

    @property
    def late(self) -> bool:
        """Whether some of it is known only after the forces."""
        return self.rates != layout.NO_RATES

    def tell(self, context: Integers) -> None:
        """Write the choice into a context."""
        context[layout.N_SELECTED] = len(self.selected)
        context[layout.SELECTED] = self.selected.ctypes.data
        context[layout.COUNTS] = self.counts.ctypes.data
        context[layout.RATES_SHOWN] = self.rates
        context[layout.N_SHOWN_FLOWS] = len(self.shown_flows)
        context[layout.SHOWN_FLOWS] = self.shown_flows.ctypes.data if len(self.shown_flows) else 0


def choose(
    signals: Sequence[OutputSignal], patterns: Collection[str], blocks: Sequence[Block], numbering: Numbering,
    memory: Memory, also: Collection[str] = (),
) -> Recording:  # fmt: skip
    """The signals of a System whose names fit a pattern with * and ?; a run watches those in `also`, too."""
    if "*" in patterns:
        return recording(list(signals), list(signals), blocks, numbering, memory)
    known = {s.name: None for s in signals}
    names = {name for pattern in patterns for name in picked(known, pattern)}
    chosen = [s for s in signals if s.name in names]
    watched = [s for s in signals if s.role in WATCHED or s.rounded_by or s.at < 0 or s.name in also]
    hidden = [s for s in watched if s.name not in names]
    return recording(chosen, chosen + hidden, blocks, numbering, memory)


def recording(
    chosen: list[OutputSignal], recorded: list[OutputSignal], blocks: Sequence[Block], numbering: Numbering,
    memory: Memory,
) -> Recording:  # fmt: skip
    """What the callbacks must know to record this; the counts of other modes are those of the System."""
    selected = np.array([s.at for s in recorded], dtype=np.int64)
    counts = memory["counts"].copy()
    counts[layout.OUTPUT], late = what_to_ask(blocks, portions(blocks)[0], selected)
    flows = flows_to_ask(blocks, numbering, memory, late) if len(late) else np.zeros((0, layout.CALL), dtype=np.int64)
    rates = layout.NO_RATES if not len(late) else layout.ALL_RATES if flows is None else layout.SOME_RATES
    if flows is None:
        flows = np.zeros((0, layout.CALL), dtype=np.int64)
    return Recording(chosen, recorded, selected, counts, rates, flows)

