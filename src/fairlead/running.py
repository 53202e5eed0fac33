"""One run: the engine is started, what it records goes to disk or memory, and the summary is drawn up."""

from __future__ import annotations

import dataclasses
import pathlib
import time
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from fairlead.analysis.record.below_weight import BelowWeight
from fairlead.analysis.record.counts import unreasonable
from fairlead.analysis.record.creep import WorstCreep
from fairlead.analysis.record.energy import Ledger, judged, known_to, own_classes, resolved
from fairlead.analysis.record.event_rows import EventRows
from fairlead.analysis.record.gave_way import GaveWay
from fairlead.analysis.record.gone_with_effects import without_gone
from fairlead.analysis.record.impacts import changed_starts, lost_in_impacts
from fairlead.analysis.record.kept_time import overrun_remarks
from fairlead.analysis.record.limits import read_limits
from fairlead.analysis.record.met_together import met_together
from fairlead.analysis.record.met_together import remark as of_blows
from fairlead.analysis.record.names import unknown_signals
from fairlead.analysis.record.never_closed import NeverClosed
from fairlead.analysis.record.no_rebound import remark as no_rebound
from fairlead.analysis.record.pushes import pushes
from fairlead.analysis.record.released_together import ReleasedTogether
from fairlead.analysis.record.remedy import remedies
from fairlead.analysis.record.rounded_in_impacts import remark as rounded_in_impacts
from fairlead.analysis.record.rounded_off import RoundedOff
from fairlead.analysis.record.scene_record import scene_record, zone_record
from fairlead.analysis.record.strains import Strains
from fairlead.analysis.record.unsettled import with_way_out
from fairlead.analysis.record.used_up import UsedUp
from fairlead.analysis.record.went_round import WentRound
from fairlead.analysis.record.wind_up import WindUp
from fairlead.analysis.remarks.remarks import remarks
from fairlead.analysis.treatments.friction_record import friction_record
from fairlead.analysis.treatments.stepping_table import few
from fairlead.component.declare import CREEP
from fairlead.engine import engine_of, engine_remarks, engine_settings, refused
from fairlead.errors import Fault, ModelError, UsageError
from fairlead.integrate import Outcome, integrate
from fairlead.integrate.ida.solver import require_package
from fairlead.integrate.problem import Run, Status
from fairlead.integrate.underway import Underway
from fairlead.interruption import Interruption
from fairlead.netlist.netlist import Netlist
from fairlead.netlist.settings import RunSettings
from fairlead.outer import interface_faults
from fairlead.patterns import picked
from fairlead.processor import processor
from fairlead.result import Result
from fairlead.results import MemoryRun, RunDirectory, Signal, Sink
from fairlead.system.assembly.left_open import left_open
from fairlead.system.compiled.named_parts import kept_positions, undeclared
from fairlead.system.compiled.out_of_range import beyond_their_tables
from fairlead.versions import versions
from fairlead.watch import Watch, least_jumps

if TYPE_CHECKING:
    from fairlead.flatten.flat_model import FlatModel
    from fairlead.pacing import Pacer
    from fairlead.system.arrays.recording import OutputSignal
    from fairlead.system.compiled.system import System


def run(netlist: Netlist, settings: RunSettings, system: System, path: pathlib.Path | None, *, force: bool,
        progress: Callable[[float, float, Any], None] | None, profile: bool, begun: float,
        peaks: bool = True, told: bool = True, kept: Sequence[str] | None = None,
        pacer: Pacer | None = None) -> Result:  # fmt: skip
    """Run a compiled model and return its results, also of a run that fails. Raises ModelError, UsageError.

    They go to the directory `path`, or stay in memory when that is None. Without `peaks` extremes and limits are not
    looked for, and on a grid nothing between its rows; without `told` there are no remarks: both cost as much as the
    loop of a small model. Of signals that fit no pattern in `kept` the extremes are known and no row; None keeps all.
    A `pacer` keeps time with a clock.
    """
    faults = unreasonable(netlist, settings, system.flat)
    if faults := faults + interface_faults(netlist, system.flat.assembly.entries, system):
        raise ModelError(faults)
    if settings.engine == "ida":
        require_package()
    if (fault := refused(settings, system) or not_allowed(system)) is not None:
        raise UsageError(f"{fault.what} {fault.way_out}")
    patterns = patterns_of(netlist)
    recording = system.recording(patterns)
    names = {signal.name: None for signal in recording.chosen}
    if not all(picked(names, text) for text in patterns) and (faults := unknown_signals(system.flat.assembly)):
        raise ModelError(faults)
    wanted = names if kept is None else {name for one in kept for name in picked(names, one)}
    columns = [k for k, name in enumerate(names) if name in wanted]
    limits = read_limits(without_gone(system.flat.assembly, netlist.limits), recording.recorded)
    creeping = [signal.name for signal in recording.recorded if signal.role == CREEP]
    compiled = time.perf_counter() - begun
    engine = engine_of(settings, system)
    header = {**_header(netlist, settings, system, engine, told=told), "limits": limits.plain()}
    shown = [recording.chosen[k] for k in columns]
    with Interruption() as interruption, _sink(path, _signals(shown), header, force=force) as sink:
        least = least_jumps(system, shown, settings.accuracy)
        event_rows = EventRows(least) if netlist.record.every is not None else None
        strains = Strains.of(system, recording.recorded)
        asked = engine_settings(netlist, settings, system, patterns, between=peaks or bool(strains.names),
                                chosen=engine[0])  # fmt: skip
        together = ReleasedTogether(system) if asked.engine != "stepping" else None
        watch = Watch(system, sink, recording, Ledger(), WorstCreep(creeping), limits,
                      strains, UsedUp.of(system, recording.recorded),
                      BelowWeight.of(system, recording.chosen if told else [], settings.accuracy),
                      WindUp.of(system, recording.recorded if told else []),
                      RoundedOff.of(system, recording.recorded if told else []),
                      NeverClosed.of(system, recording.recorded if told else [], asked.start),
                      together, GaveWay(system, asked.start), WentRound(system), progress, interruption, event_rows,
                      settings.accuracy,
                      peaks, None if kept is None else columns)  # fmt: skip
        outcome = integrate(system, asked, watch, pacer or Underway.go_on)
        interruption.between_blocks = True  # also where there was no block: what there is gets written
        for controller in outcome.problem.controllers:
            controller.end()
        watch.finish()
        outcome = _explained(outcome, system, settings.engine)
        if outcome.status == Status.INTERRUPTED and interruption.ended_by is not None:
            said = outcome.sentence.replace("interrupted", f"ended by {interruption.ended_by.name}")
            outcome = dataclasses.replace(outcome, sentence=said)
        summary = _summary(outcome, watch, asked, compiled, time.perf_counter() - begun)
        summary["dwell"] = asked.longest_dwell
        summary["real_time"] = _kept_time(outcome, asked, pacer)
        inexact = [said for said in (rounded_in_impacts(system, summary["lost"]),
                                     no_rebound(system, outcome.not_given_back),
                                     of_blows(summary["met_together"])) if said]  # fmt: skip
        found = [*watch.below.remarks(), *watch.wind_up.remarks(), *watch.rounded.remarks(), *watch.open_.remarks(),
                 *watch.gave_way.remarks(), *watch.went_round.remarks(), *inexact,
                 *overrun_remarks(summary["real_time"])]  # fmt: skip
        summary["remarks"] = [*header["remarks"], *found] if told else []
        if profile:
            summary["profile"] = _profile(outcome, compiled, time.perf_counter() - begun)
        sink.finish(_status(outcome), summary)
        interruption.due()
    return Result.of(sink.result())


def _sink(path: pathlib.Path | None, signals: list[Signal], header: dict[str, Any], *, force: bool) -> Sink:
    if path is None:
        return MemoryRun(signals, header)
    return RunDirectory.create(path, signals, header, force=force)


def _explained(outcome: Outcome, system: System, engine: str) -> Outcome:
    """A run that ended since a controller in plain Python failed, or a table has no value there, says so.

    One whose zones did not settle, or switch without end, names the contacts that want another method, or engine.
    """
    if outcome.status in (Status.NOT_SETTLED, Status.CHATTER):
        said = with_way_out(outcome.sentence, system, engine, outcome.culprits)
        return dataclasses.replace(outcome, sentence=said)
    if said := open_at(outcome.problem, outcome.status, outcome.culprits, outcome.t):
        return dataclasses.replace(outcome, sentence=said)
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
        if isinstance(controller.failure, KeyboardInterrupt):
            raise controller.failure
        if controller.failure is not None:
            return str(controller.complaint)
    if status == Status.NOT_FINITE and (beyond := beyond_their_tables(problem)):
        return f"t = {t:.6g} s: {few(beyond)} moved beyond the range in which its law has values."
    return ""


def open_at(problem: Any, status: Status, culprits: Sequence[str], t: float) -> str:
    """Which part belongs where the equations leave a pressure, a voltage or a temperature open; or ""."""
    if status != Status.SINGULAR or len(culprits) != 1:
        return ""
    said = left_open(problem.flat, problem.numbering, culprits[0])
    return said and f"t = {t:.6g} s: {said}"


def chosen_signals(netlist: Netlist, system: System) -> list[OutputSignal]:
    """What a run records of what the netlist asks for."""
    return system.recording(patterns_of(netlist)).chosen


def patterns_of(netlist: Netlist) -> list[str]:
    """What to record: what is asked for, and what plots and limits need."""
    plotted = [pattern for plot in netlist.record.plots for pattern in (*plot.signals, plot.along) if pattern]
    return [*netlist.record.signals, *plotted, *netlist.limits]


def _signals(chosen: list[OutputSignal]) -> list[Signal]:
    return [Signal(signal.name, signal.unit, signal.doc) for signal in chosen]


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


def _header(netlist: Netlist, settings: RunSettings, system: System, chosen: tuple[str, str], *,
            told: bool) -> dict[str, Any]:  # fmt: skip
    odd = [*remarks(system.flat, settings), *engine_remarks(settings, system)] if told else []
    return {
        "name": netlist.name, "netlist": str(netlist.path), "digest": netlist.digest,
        "description": netlist.description, "settings": settings.model_dump(),
        "engine": chosen[0], "engine_reason": chosen[1],
        "effects": {name: value.plain() for name, value in netlist.effects.items()},
        "effects_in_force": system.flat.assembly.effects,
        "build": str(processor()), "versions": versions(),
        "unknowns": system.n, "machines": len(system.zones),
        "record_every": netlist.record.every, "friction": friction_record(system.flat),
        "remarks": [str(one) for one in odd],
        "routes": _routes(system.flat),
        "scene": scene_record(netlist, system.flat),
        "zones": zone_record(system.machine_names, system.machine_zones, system.zones),
    }  # fmt: skip


def _routes(flat: FlatModel) -> list[dict[str, Any]]:
    if not flat.assembly.routings:
        return []
    from fairlead.analysis.statics.route_record import route_records

    return route_records(flat)


def _summary(outcome: Outcome, watch: Watch, asked: Run, compiled: float, wall: float) -> dict[str, Any]:
    counters = outcome.counters
    counts = {n: v for n, v in vars(counters).items() if isinstance(v, int)}
    said = outcome.sentence
    if _status(outcome) in ("failed", "budget"):
        said = f"{said} {remedies(watch.system.flat.instances)}".rstrip()
    return {
        "end_time": outcome.t, "sentence": said, "culprits": list(outcome.culprits),
        "chattering": list(outcome.chattering),
        "wall_time": wall, "compile_time": compiled, "solve_time": outcome.loop_wall,
        "steps": counters.steps, "rejected": counters.rejected,
        "switches": counters.switches - watch.changes.inside, "counters": counts,
        "worst_creep": watch.creep.summary(), "energy": _energy(outcome, watch, asked),
        "extremes": watch.extremes.plain([one.name for one in watch.recording.chosen]),
        "limits_broken": watch.limits.broken(),
        "limits": watch.limits.plain(), "lost": lost_in_impacts(watch.system, outcome.lost),
        "projected": _projected(outcome, watch.system),
        "changed_starts": changed_starts(outcome.problem, outcome.begun),
        "released_together": None if watch.together is None else watch.together.plain(),
        "met_together": met_together(watch.system, outcome.joined, outcome.first_joined),
        "gave_way": watch.gave_way.plain(), "went_round": watch.went_round.plain(),
        "strains": watch.strains.summary(), "pushes": pushes(watch.extremes, watch.recording.recorded, watch.accuracy),
        "jumps": watch.jumps(), "below_weight": watch.below.summary(),
    }  # fmt: skip


def _energy(outcome: Outcome, watch: Watch, asked: Run) -> dict[str, Any]:
    """The ledger, and the energy that the error weights of the run resolve."""
    summary = watch.ledger.summary()
    if "throughput" in summary:
        summary["resolved"] = resolved(outcome.problem)
        summary["known_to"] = known_to(
            outcome.problem, watch.accuracy, outcome.counters.steps if asked.engine == "ida" else 0
        )
    return judged(summary, undeclared(watch.system), own_classes(watch.system))


def _projected(outcome: Outcome, system: System) -> dict[str, float] | None:
    """Steps brought back to relations of positions, and the farthest way in error weights; None where none are kept."""
    return {"steps": outcome.counters.projections, "most": outcome.most_moved} if kept_positions(system) else None


def _kept_time(outcome: Outcome, asked: Run, pacer: Pacer | None) -> dict[str, Any] | None:
    """How a run in real time went; None of any other."""
    if not asked.real_time:
        return None
    first = outcome.first_overrun
    return {
        "step": asked.fixed_step, "steps": outcome.counters.steps, "overruns": outcome.counters.overruns,
        "first": None if first is None else {"t": first[0], "what": first[1]},
        "clock": None if pacer is None else pacer.plain(),
    }  # fmt: skip


def _status(outcome: Outcome) -> str:
    if outcome.status == Status.INTERRUPTED:
        return "interrupted"
    if outcome.status.is_budget:
        return "budget"
    return "finished" if outcome.ok else "failed"


def _profile(outcome: Outcome, compiled: float, wall: float) -> str:
    from fairlead.analysis.record.profile import Times, profile

    return profile(outcome.problem, outcome.counters, Times(compiled, outcome.loop_wall, wall))
