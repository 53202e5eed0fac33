"""One run: the engine is started, what it records goes to disk or memory, and the summary is drawn up."""

from __future__ import annotations

import dataclasses
import pathlib
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from fairlead.analysis.record.below_weight import BelowWeight
from fairlead.analysis.record.counts import unreasonable
from fairlead.analysis.record.creep import WorstCreep
from fairlead.analysis.record.energy import Ledger, judged
from fairlead.analysis.record.event_rows import EventRows, Rows
from fairlead.analysis.record.extremes import Extremes
from fairlead.analysis.record.impacts import changed_starts, lost_in_impacts
from fairlead.analysis.record.limits import Limits, read_limits
from fairlead.analysis.record.released_together import ReleasedTogether
from fairlead.analysis.record.remedy import budget, remedies
from fairlead.analysis.record.scene_record import scene_record, zone_record
from fairlead.analysis.record.step_rows import Batches, Thinning, WholeSteps, on_grid
from fairlead.analysis.record.strains import Strains
from fairlead.analysis.remarks.remarks import remarks
from fairlead.analysis.statics.route_record import route_records
from fairlead.analysis.treatments.friction_record import friction_record
from fairlead.analysis.treatments.stepping_table import INSIDE, beyond, few, handling, most_located, refusal, remark
from fairlead.choice import choose
from fairlead.component.declare import CREEP
from fairlead.errors import Fault, ModelError, UsageError
from fairlead.integrate import Block, End, Outcome, Run, integrate
from fairlead.integrate.ida.solver import require_package
from fairlead.integrate.problem import Status
from fairlead.interruption import Interruption
from fairlead.netlist.netlist import Netlist
from fairlead.netlist.settings import RunSettings
from fairlead.processor import processor
from fairlead.result import Result
from fairlead.results import MemoryRun, RunDirectory, Signal, Sink
from fairlead.system.compiled.out_of_range import beyond_their_tables

if TYPE_CHECKING:
    from fairlead.system.arrays.recording import OutputSignal, Recording
    from fairlead.system.compiled.system import System

SIDES = np.array([0, -1, +1, 2], dtype=np.int8)  # as the results do: ordinary, before an event, after it, inside a step
MOST_JUMPS_TOLD = 5
ZoneChange = tuple[float, str, str, str, str]  # when [s], whose, zones before and after, guard
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
    below: BelowWeight
    together: ReleasedTogether | None  # None: steps have no instants in which contacts let go
    progress: Callable[[float, float, Any], None] | None
    interruption: Interruption
    event_rows: EventRows | None  # what of events is kept; None: everything
    accuracy: float
    peaks: bool = True
    """Whether extremes are looked for."""
    steps: WholeSteps = field(init=False)
    batches: Batches = field(init=False)
    begun: bool = field(init=False)
    extremes: Extremes = field(init=False)
    thinning: Thinning = field(init=False)
    names: dict[tuple[int, ...], tuple[str, str, str, str]] = field(init=False)  # by machine, zones and guard
    creeping: NDArray[np.int64] = field(init=False)  # columns of what `creep` watches
    metered: NDArray[np.int64] | None = field(init=False, default=None)  # and of what `ledger` does

    def __post_init__(self) -> None:
        """Find the columns."""
        self.steps, self.batches, self.begun = WholeSteps(), Batches(len(self.recording.recorded)), False
        self.extremes = Extremes(len(self.recording.recorded))
        self.thinning, self.names = Thinning(self.accuracy, self.chosen), {}
        columns = {signal.name: k for k, signal in enumerate(self.recording.recorded)}
        self.creeping = np.array([columns[name] for name in self.creep.names], dtype=np.int64)
        if "energy.supplied" in columns:
            self.metered = np.array([columns["energy.dissipated"], columns["energy.supplied"], -1])

    @property
    def chosen(self) -> int:
        """How many of the recorded signals were asked for: the first ones."""
        return len(self.recording.chosen)

    def __call__(self, block: Block) -> End | None:
        """Take one block, up to where its rows mean something, which ends the run.

        Raises KeyboardInterrupt when it is written, if that was asked for meanwhile.
        """
        self.interruption.between_blocks = True
        found = self.strains.end(block.t, block.values)
        self._take(block if found is None else up_to(block, found[0]))
        self.interruption.due()
        return None if found is None else End(float(block.t[found[0]]), *found[1:])

    def _take(self, block: Block) -> None:
        rows = Rows(block.t, block.values, block.side)
        if self.peaks:
            for batch in self.batches.take(rows):
                self.extremes.watch(batch)
        whole = self.steps.take(rows._replace(values=rows.values[:, : self.chosen]))
        if whole is not None:
            self._take_steps(whole)
        self.sink.events(self._named(block.events))
        if self.together is not None:
            self.together.watch(block.events)
        self.creep.watch(block.t, block.values[:, self.creeping])
        self.strains.watch(block.t, block.values)
        self.below.watch(block.values)
        if self.metered is not None:
            self.ledger.watch(block.values[:, self.metered])
        if self.progress is not None:
            self.progress(block.fraction, block.reached, None)

    def _named(self, events: NDArray[Any]) -> Iterator[ZoneChange]:
        """Zone changes with names; those of a change are looked up once."""
        for row in events.tolist():
            change = row[1:5]
            if change not in self.names:
                self.names[change] = names_of_change(self.system, *change)
            yield row[0], *self.names[change]

    def _take_steps(self, rows: Rows) -> None:
        if self.event_rows is None:
            self._write(self.thinning.take(rows, first=not self.begun))
        else:
            self._write(self.event_rows.take(on_grid(rows.where(slice(int(self.begun), None)))))
        self.begun = True

    def _write(self, rows: Rows) -> None:
        self.sink.append(rows.t, rows.values, SIDES[rows.side])

    def finish(self) -> None:
        """Write what still waits; no block follows."""
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
        most = [k for k in np.argsort(-counts, kind="stable")[:MOST_JUMPS_TOLD].tolist() if counts[k]]
        return {"kept": self.event_rows.kept, "most": {self.recording.recorded[k].name: int(counts[k]) for k in most}}


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


def run(netlist: Netlist, settings: RunSettings, system: System, path: pathlib.Path | None, *, force: bool,
        progress: Callable[[float, float, Any], None] | None, profile: bool, begun: float,
        peaks: bool = True, told: bool = True) -> Result:  # fmt: skip
    """Run a compiled model and return its results, also of a run that fails. Raises ModelError, UsageError.

    They go to the directory `path`, or stay in memory when that is None. Without `peaks` extremes and limits are not
    looked for, and on a grid nothing between its rows; without `told` there are no remarks: both cost as much as the
    loop of a small model.
    """
    if faults := unreasonable(netlist, settings, system.flat):
        raise ModelError(faults)
    if settings.engine == "ida":
        require_package()
    if (fault := refused(settings, system) or not_allowed(system)) is not None:
        raise UsageError(f"{fault.what} {fault.way_out}")
    patterns = _patterns(netlist)
    recording = system.recording(patterns)
    limits = read_limits(netlist.limits, recording.recorded)
    creeping = [signal.name for signal in recording.recorded if signal.role == CREEP]
    compiled = time.perf_counter() - begun
    header = {**_header(netlist, settings, system, told=told), "limits": limits.plain()}
    with Interruption() as interruption, _sink(path, _signals(recording.chosen), header, force=force) as sink:
        least = least_jumps(system, recording.chosen, settings.accuracy)
        event_rows = EventRows(least) if netlist.record.every is not None else None
        strains = Strains.of(system, recording.recorded)
        asked = engine_settings(netlist, settings, system, patterns, between=peaks or bool(strains.names))
        together = ReleasedTogether(system) if asked.engine != "stepping" else None
        watch = Watch(system, sink, recording, Ledger(), WorstCreep(creeping), limits,
                      strains, BelowWeight.of(system, recording.chosen if told else [], settings.accuracy),
                      together, progress, interruption, event_rows, settings.accuracy, peaks)  # fmt: skip
        outcome = integrate(system, asked, watch)
        for controller in outcome.problem.controllers:
            controller.end()
        watch.finish()
        interruption.between_blocks = False
        outcome = _explained(outcome)
        if outcome.status == Status.INTERRUPTED and interruption.ended_by is not None:
            said = outcome.sentence.replace("interrupted", f"ended by {interruption.ended_by.name}")
            outcome = dataclasses.replace(outcome, sentence=said)
        summary = _summary(outcome, watch, compiled, time.perf_counter() - begun)
        summary["dwell"] = asked.dwell
        summary["remarks"] = [*header["remarks"], *watch.below.remarks()] if told else []
        if profile:
            summary["profile"] = _profile(outcome, compiled, time.perf_counter() - begun)
        sink.finish(_status(outcome), summary)
    return Result.of(sink.result())


def _sink(path: pathlib.Path | None, signals: list[Signal], header: dict[str, Any], *, force: bool) -> Sink:
    if path is None:
        return MemoryRun(signals, header)
    return RunDirectory.create(path, signals, header, force=force)


def _explained(outcome: Outcome) -> Outcome:
    """A run that ended since a controller in plain Python failed, or a table has no value there, says so."""
    said = failure_of(outcome.problem, outcome.status, outcome.t)
    if not said:
        return outcome
    culprits = tuple(beyond_their_tables(outcome.problem)) if outcome.status == Status.NOT_FINITE else ()
    culprits = outcome.culprits if failed(outcome.problem) else culprits
    return dataclasses.replace(outcome, status=Status.NOT_FINITE, sentence=said, culprits=culprits)


def failed(problem: Any) -> bool:
    """Whether a controller in plain Python or an FMU failed, which need not reach any unknown."""
    return any(controller.failure is not None for controller in problem.controllers)


def failure_of(problem: Any, status: Status, t: float) -> str:
    """What the components say of the end of a run: a controller that failed, a table without a value there; or ""."""
    for controller in problem.controllers:
        if isinstance(controller.failure, KeyboardInterrupt | SystemExit):
            raise controller.failure
        if controller.failure is not None:
            return str(controller.complaint)
    if status == Status.NOT_FINITE and (beyond := beyond_their_tables(problem)):
        return f"t = {t:.6g} s: {few(beyond)} moved beyond the range in which its law has values."
    return ""


def _patterns(netlist: Netlist) -> list[str]:
    """What to record: what is asked for, and what plots and limits need."""
    plotted = [pattern for plot in netlist.record.plots for pattern in (*plot.signals, plot.along) if pattern]
    return [*netlist.record.signals, *plotted, *netlist.limits]


def _signals(chosen: list[OutputSignal]) -> list[Signal]:
    return [Signal(signal.name, signal.unit, signal.doc) for signal in chosen]


def engine_of(settings: RunSettings, system: System) -> tuple[Literal["rodas", "stepping", "ida"], str]:
    """The engine of a run and why, as run.json tells them."""
    if settings.engine != "auto":
        return settings.engine, "chosen by run.engine"
    if (reason := beyond(system, settings)) is not None:
        return "rodas", f"auto: {reason}"
    contacts = int(np.count_nonzero(system.holder >= 0))
    smooth = system.linear and system.least_left >= 1 - settings.accuracy  # of order one at a larger jump
    engine, reason = choose(contacts, smooth, settings.accuracy)
    if engine == "stepping" and ((found := handling(system, settings)).way != INSIDE or found.of.auto):
        return "rodas", f"auto: it locates every switch, and {found.why}"
    return engine, reason


def engine_remarks(settings: RunSettings, system: System) -> list[Fault]:
    """What the engine that `run.engine` asks for cannot do well in this model. Raises ModelError if it refuses."""
    if (fault := refused(settings, system)) is not None:
        raise ModelError([fault])
    return list(remark(system, settings))


def refused(settings: RunSettings, system: System) -> Fault | None:
    """Why the engine that `run.engine` asks for does not run this model, None where it does."""
    if settings.engine == "ida" and (kept := system.kept_positions):
        what = f"run.engine: ida does not bring positions back to what {few(kept)} keeps after every step"
        return Fault(None, f"{what}, so they would drift.", "Take run.engine: rodas (or auto).")
    return refusal(system, settings)


def not_allowed(system: System) -> Fault | None:
    """Why FMUs of the model may not run, None where there are none or they may."""
    called = [instance for instance in system.flat.instances if instance.type.declaration.python]
    if not called:
        return None
    from fairlead.foreign.block import NOT_ALLOWED
    from fairlead.foreign.block import not_allowed as file_of

    named = [f"{one.path.rpartition('.')[0]} ({file_of(one.type)})" for one in called if file_of(one.type)]
    if not named:
        return None
    return Fault(None, f"{few(named)} {'is an FMU' if len(named) == 1 else 'are FMUs'} and not run.", NOT_ALLOWED)


def engine_settings(netlist: Netlist, settings: RunSettings, system: System, patterns: list[str], *,
                    between: bool = True) -> Run:  # fmt: skip
    """The settings of a run as the engine takes them; `between`: with what happens between the rows of a grid."""
    method = "rodas5p" if settings.method == "auto" else settings.method
    types = [instance.type for instance in system.flat.instances]
    engine = engine_of(settings, system)[0]
    located = {"most_located": most_located(system, settings)} if engine == "stepping" else {}
    return Run(
        stop=settings.stop, start=settings.start, every=netlist.record.every, method=method,
        accuracy=settings.accuracy, record=patterns,
        between=between or netlist.record.every is None,  # the curve of a step goes through its rows inside
        engine=engine, **located,
        first_step=settings.first_step, max_step=settings.max_step or np.inf, step_floor=settings.step_floor,
        max_steps=budget(types, "max_steps", settings.max_steps),
        max_events=budget(types, "max_events", settings.max_events), max_wall=settings.max_wall,
        dwell=settings.shortest_zone, on_chatter=settings.chatter,
    )  # fmt: skip


def _header(netlist: Netlist, settings: RunSettings, system: System, *, told: bool) -> dict[str, Any]:
    engine, reason = engine_of(settings, system)
    return {
        "name": netlist.name, "netlist": str(netlist.path), "digest": netlist.digest,
        "description": netlist.description, "settings": settings.model_dump(),
        "engine": engine, "engine_reason": reason,
        "effects": {name: value.plain() for name, value in netlist.effects.items()},
        "effects_in_force": system.flat.assembly.effects,
        "build": str(processor()),
        "unknowns": system.n, "machines": len(system.zones),
        "record_every": netlist.record.every, "friction": friction_record(system.flat),
        "remarks": [str(one) for one in (*remarks(system.flat), *engine_remarks(settings, system))] if told else [],
        "routes": route_records(system.flat),
        "scene": scene_record(netlist, system.flat),
        "zones": zone_record(system.machine_names, system.machine_zones, system.zones),
    }  # fmt: skip


def _summary(outcome: Outcome, watch: Watch, compiled: float, wall: float) -> dict[str, Any]:
    counters = outcome.counters
    counts = {n: v for n, v in vars(counters).items() if isinstance(v, int)}
    said = outcome.sentence
    if _status(outcome) in ("failed", "budget"):
        said = f"{said} {remedies(watch.system.flat.instances)}".rstrip()
    return {
        "end_time": outcome.t, "sentence": said, "culprits": list(outcome.culprits),
        "chattering": list(outcome.chattering),
        "wall_time": wall, "compile_time": compiled, "solve_time": outcome.loop_wall,
        "steps": counters.steps, "rejected": counters.rejected, "switches": counters.switches, "counters": counts,
        "worst_creep": watch.creep.summary(), "energy": judged(watch.ledger.summary(), watch.system.undeclared),
        "extremes": watch.extremes.plain([one.name for one in watch.recording.chosen]),
        "limits_broken": watch.limits.broken(),
        "limits": watch.limits.plain(), "lost": lost_in_impacts(watch.system, outcome.lost),
        "projected": _projected(outcome, watch.system),
        "changed_starts": changed_starts(outcome.problem, outcome.begun),
        "released_together": None if watch.together is None else watch.together.plain(),
        "strains": watch.strains.summary(),
        "jumps": watch.jumps(), "below_weight": watch.below.summary(),
    }  # fmt: skip


def _projected(outcome: Outcome, system: System) -> dict[str, float] | None:
    """Steps brought back to relations of positions, and the farthest way in error weights; None where none are kept."""
    return {"steps": outcome.counters.projections, "most": outcome.most_moved} if system.kept_positions else None


def _status(outcome: Outcome) -> str:
    if outcome.status == Status.INTERRUPTED:
        return "interrupted"
    if outcome.status.is_budget:
        return "budget"
    return "finished" if outcome.ok else "failed"


def named_change(system: System, row: Any) -> ZoneChange:
    """One zone change with names."""
    change = (int(row[name]) for name in ("machine", "before", "after", "guard"))
    return float(row["t"]), *names_of_change(system, *change)


def names_of_change(system: System, machine: int, before: int, after: int, guard: int) -> tuple[str, str, str, str]:
    """Contact, zones before and after, and guard of a change."""
    zones = system.zone_names(machine)
    return system.machine_names[machine], zones[before], zones[after], system.guard_name(guard, machine, before)


def _profile(outcome: Outcome, compiled: float, wall: float) -> str:
    from fairlead.analysis.record.profile import Times, profile

    return profile(outcome.problem, outcome.counters, Times(compiled, outcome.loop_wall, wall))
