"""What is watched while a run goes on: rows go to a sink, and the figures of the summary are kept."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.record.below_weight import BelowWeight
from fairlead.analysis.record.creep import WorstCreep
from fairlead.analysis.record.energy import Ledger
from fairlead.analysis.record.event_rows import EventRows, Rows
from fairlead.analysis.record.extremes import Extremes
from fairlead.analysis.record.gave_way import GaveWay
from fairlead.analysis.record.limits import Limits
from fairlead.analysis.record.never_closed import NeverClosed
from fairlead.analysis.record.released_together import ReleasedTogether
from fairlead.analysis.record.rounded_off import RoundedOff
from fairlead.analysis.record.step_rows import Batches, Thinning, WholeSteps, on_grid
from fairlead.analysis.record.strains import Strains
from fairlead.analysis.record.used_up import UsedUp
from fairlead.analysis.record.went_round import WentRound
from fairlead.analysis.record.wind_up import WindUp
from fairlead.analysis.record.zone_changes import ZoneChanges
from fairlead.component.declare import PULL
from fairlead.integrate import Block, End
from fairlead.interruption import Interruption
from fairlead.results import Sink
from fairlead.results.curves import AFTER, BEFORE, INSIDE, ORDINARY

if TYPE_CHECKING:
    from fairlead.system.arrays.recording import OutputSignal, Recording
    from fairlead.system.compiled.system import System

SIDES = np.array([ORDINARY, BEFORE, AFTER, INSIDE], dtype=np.int8)  # by the side of a row of `integrate.problem.Block`
MOST_JUMPS_TOLD = 5
CONTINUOUS = 0.1  # times the accuracy, of the largest value so far: differences across an event that are none


@dataclass
class Watch:
    """Receives blocks of the engine: passes them on and keeps the figures of the summary."""

    system: System
    sink: Sink
    recording: Recording
    ledger: Ledger
    creep: WorstCreep
    limits: Limits
    strains: Strains
    used_up: UsedUp
    below: BelowWeight
    wind_up: WindUp
    rounded: RoundedOff
    open_: NeverClosed
    together: ReleasedTogether | None  # None: steps have no instants in which contacts let go
    gave_way: GaveWay
    went_round: WentRound
    progress: Callable[[float, float, Any], None] | None
    interruption: Interruption
    event_rows: EventRows | None  # what of events is kept; None: everything
    accuracy: float
    peaks: bool = True
    """Whether extremes are looked for."""
    columns: list[int] | None = None
    """Of the signals asked for, those of which rows are written, with all that the curves of steps go through; None:
    all, less the rows that others tell."""
    steps: WholeSteps = field(init=False)
    batches: Batches = field(init=False)
    begun: bool = field(init=False)
    extremes: Extremes = field(init=False)
    thinning: Thinning = field(init=False)
    changes: ZoneChanges = field(init=False)
    creeping: NDArray[np.int64] = field(init=False)  # columns of what `creep` watches
    metered: NDArray[np.int64] | None = field(init=False, default=None)  # and of what `ledger` does

    def __post_init__(self) -> None:
        """Find the columns."""
        self.steps, self.begun = WholeSteps(), False
        searched = told_extremes(self.recording, self.limits)
        self.batches, self.extremes = Batches(searched), Extremes(searched)
        self.thinning = Thinning(self.accuracy, len(self.recording.chosen))
        self.changes = ZoneChanges(self.system)
        columns = {signal.name: k for k, signal in enumerate(self.recording.recorded)}
        self.creeping = np.array([columns[name] for name in self.creep.names], dtype=np.int64)
        if "energy.supplied" in columns:
            self.metered = np.array([columns["energy.dissipated"], columns["energy.supplied"], -1])

    def __call__(self, block: Block) -> End | None:
        """Take one block, up to where its rows mean something, which ends the run.

        Raises KeyboardInterrupt when it is written, if that was asked for meanwhile.
        """
        self.interruption.between_blocks = True
        ends = (self.strains.end(block.t, block.values), self.used_up.end(block.t, block.values))
        found = min((end for end in ends if end is not None), key=lambda end: end[0], default=None)
        self._take(block if found is None else up_to(block, found[0]))
        self.interruption.due()
        return None if found is None else End(float(block.t[found[0]]), *found[1:])

    def _take(self, block: Block) -> None:
        rows = Rows(block.t, block.values, block.side)
        if self.peaks:
            for batch in self.batches.take(rows._replace(values=rows.values[:, : self.extremes.signals])):
                self.extremes.watch(batch)
        asked = slice(len(self.recording.chosen)) if self.columns is None else self.columns
        whole = self.steps.take(rows._replace(values=rows.values[:, asked]))
        if whole is not None:
            self._take_steps(whole)
        self.sink.events(self.changes.of(block.events))
        if self.together is not None:
            self.together.watch(block.events)
        self.gave_way.watch(block.events)
        self.went_round.watch(block.events)
        self.creep.watch(block.t, block.values[:, self.creeping])
        self.strains.watch(block.t, block.values)
        self.below.watch(block.values)
        self.rounded.watch(block.values)
        self.open_.watch(block.values, block.events)
        self.wind_up.watch(block.t, block.values, block.events)
        if self.metered is not None:
            self.ledger.watch(block.values[:, self.metered])
        if self.progress is not None:
            self.progress(block.fraction, block.reached, None)

    def _take_steps(self, rows: Rows) -> None:
        if self.event_rows is None and self.columns is not None:
            self._write(rows.where(slice(int(self.begun), None)))
        elif self.event_rows is None:
            self._write(self.thinning.take(rows, first=not self.begun))
        else:
            self._write(self.event_rows.take(on_grid(rows.where(slice(int(self.begun), None)))))
        self.begun = True

    def _write(self, rows: Rows) -> None:
        self.sink.append(rows.t, rows.values, SIDES[rows.side])

    def finish(self) -> None:
        """Write what still waits; no block follows."""
        self.gave_way.finish()
        self.went_round.finish()
        if (rest := self.steps.rest()) is not None and len(rest.t):
            self._take_steps(rest)
        if (rest := self.batches.rest()) is not None:
            self.extremes.watch(rest)
        self.limits.take(self.extremes)
        if self.event_rows is not None and (rest := self.event_rows.rest()) is not None:
            self._write(rest)

    def jumps(self) -> dict[str, Any]:
        """For run.json: events that have two rows on a grid, and the signals that jump at most of them."""
        if self.event_rows is None:
            return {"kept": 0, "most": {}}
        counts = self.event_rows.jumps
        first = [k for k in np.argsort(-counts, kind="stable")[:MOST_JUMPS_TOLD].tolist() if counts[k]]
        columns = range(len(counts)) if self.columns is None else self.columns
        most = {self.recording.recorded[columns[k]].name: int(counts[k]) for k in first}
        return {"kept": self.event_rows.kept, "most": most}


def told_extremes(recording: Recording, limits: Limits) -> int:
    """So many of the first recorded signals have extremes that are told: the chosen, pulls, and those limited."""
    pulls = [k for k, signal in enumerate(recording.recorded) if signal.role == PULL]
    limited = [int(column) for limit in limits.limits for column in limit.columns]
    return max([len(recording.chosen), *(k + 1 for k in [*pulls, *limited])])


def up_to(block: Block, row: int) -> Block:
    """The block with this row as its last."""
    rows, t = slice(row + 1), float(block.t[row])
    events = block.events[block.events["t"] <= t]
    return block._replace(t=block.t[rows], values=block.values[rows], side=block.side[rows], events=events, reached=t)


def least_jumps(system: System, chosen: Sequence[OutputSignal], accuracy: float) -> NDArray[np.float64]:
    """By recorded signal: the share of its largest value from which a difference across an event is a jump.

    What a sampler holds is a stair whose steps come by the clock: none of them has rows of its own (infinite).
    """
    held = set()
    for block in system.blocks:
        s = block.kernel.structure
        stairs = set(range(len(s.outputs))) - {k for k, _ in s.d_signals} if s.period else set()
        held |= {f"{instance.path}.{s.outputs[k]}" for instance in block.instances for k in stairs}
    return np.array([np.inf if one.name in held else CONTINUOUS * accuracy for one in chosen])
