"""What each effect of a scene costs and what it changes: every one switched by itself, and all of them off.

    found = effects(load)
    found.rows[0].change, found.rows[0].saved

`change` is how far the outputs go, rms over time relative to their range (`deviation.py`), the worst one counting;
`peak` is the relative change of its largest magnitude. A change below the floor, which is what a run at a tenth of
the accuracy changes, is no change. `saved` is the share of the stepping time that the switch saves, negative when it
costs more; brief runs are timed in turns with the scene as it is. Lines are sorted by what is gained for what is
lost: the cheapest simplification first. A switch that leaves every equation as it was is not run (`sameness.py`).
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from fairlead.analysis.compared_outputs import outputs
from fairlead.analysis.deviation import output_errors, worst
from fairlead.analysis.effect_row import Row, Size
from fairlead.analysis.kept_runs import KeptRuns, key_of
from fairlead.analysis.sameness import same
from fairlead.analysis.switches import Switch, all_off, switches
from fairlead.analysis.timed_run import BRIEF, Load, Timed, in_turns, on_grid, timed_run
from fairlead.arguments import Arguments
from fairlead.errors import FairleadError, NumericalError

SHARE = 0.1  # of the budget that the scene as it is may take; a longer one is looked at over less time
SHORTEST = 0.2  # s; with less time left no run is begun
SLOWER, WORTH_WAITING = 5.0, 1.0  # times the scene as it is, s; a switch that takes longer is cut off
FINER = 0.1  # accuracy of the run that tells the floor
Note = Callable[[str], None]


@dataclass
class Effects:
    """All switches of a scene. `left_out` names those that the budget or Ctrl-C did not let begin."""

    name: str
    span: tuple[float, float]
    whole: bool
    base: Timed
    size: Size
    floor: float
    rows: list[Row] = field(default_factory=list)
    untouched: list[str] = field(default_factory=list)  # switches that leave every equation as it was
    left_out: list[str] = field(default_factory=list)
    interrupted: bool = False


def effects(
    load: Load, *, budget: float | str = 60.0, signals: Sequence[str] = ("*",), kept: KeptRuns | None = None,
    libraries: Iterable[str] = (), note: Note | None = None,
) -> Effects:  # fmt: skip
    """Switch all that a scene can switch, within `budget` (`"2 min"`, or seconds), beside compiling new laws.

    Raises ModelError, UsageError for a wrong scene or pattern, NumericalError when the scene as it is does not run.
    """
    asked = Arguments("effects")
    seconds = asked.above_zero("budget", budget, "s")
    asked.refuse()
    model = load({})
    names, units, _ = outputs(model, signals)
    run = model.netlist.run
    note = note or (lambda _: None)
    note("the scene as it is")
    runner = _Runner(load, kept or KeptRuns(None), model.netlist.digest, tuple(libraries), names, (run.start, run.stop))
    base, whole = runner.run({}, SHARE * seconds), True
    runner.end = time.perf_counter() + seconds
    runner.compiled = {block.kernel.variant for block in model.system.blocks}
    if base.status == "budget" and base.reached > run.start:
        runner.span = (run.start, run.start + float(f"{0.9 * (base.reached - run.start):.1g}"))
        base, whole = runner.run({}, seconds), False
    if not base.finished:
        raise NumericalError(f"{model.netlist.name} itself does not run: {base.reason or base.status}")
    found = Effects(model.netlist.name, runner.span, whole, base, Size.of(model.system), 0.0)
    try:
        tight = runner.run({"run.accuracy": f"{max(FINER * run.accuracy, 1e-12):g}"}, seconds)
        if tight.finished:
            off = worst(output_errors(names, units, base.values, tight.values))
            found.floor = off.relative if off is not None else 0.0
        every = switches(model)
        for switch in every:
            _try(switch, runner, model, found, units, note)
        together = all_off(load, [one for one in every if one.label not in found.untouched])
        if together is not None:
            _try(together, runner, model, found, units, note)
    except KeyboardInterrupt:
        found.interrupted = True
    found.rows.sort(key=lambda row: -row.gain)
    return found


def _try(switch: Switch, runner: _Runner, model: Any, found: Effects, units: list[str], note: Note) -> None:
    """Make the row of a switch, or say why there is none."""
    if runner.left < SHORTEST:
        found.left_out.append(switch.label)
        return
    note(switch.label)
    try:
        made = runner.loaded(switch.settings)
        untouched = same(model.system, made.system)
    except FairleadError as error:
        found.rows.append(Row(switch, Timed("cannot be", str(error).splitlines()[0])))
        return
    if untouched:
        found.untouched.append(switch.label)
        return
    patience = max(WORTH_WAITING, SLOWER * found.base.wall)
    left = runner.left
    timed = runner.run(switch.settings, min(left, patience), made)
    if timed.status == "budget":
        if left < patience:  # not slow, but begun too late
            found.left_out.append(switch.label)
            return
        timed = replace(timed, reason=f"takes more than {SLOWER:g} times as long; not worth a change.")
    found.rows.append(_row(switch, timed, Size.of(made.system), found, runner.names, units))


def _row(switch: Switch, timed: Timed, size: Size, found: Effects, names: list[str], units: list[str]) -> Row:
    if not timed.finished:
        return Row(switch, timed, size)
    errors = output_errors(names, units, timed.values, found.base.values)
    most, peak = worst(errors), None
    if most is not None and most.rms > 0:
        column = names.index(most.name)
        mine, theirs = (float(np.abs(values[:, column]).max()) for values in (timed.values, found.base.values))
        peak = abs(mine - theirs) / max(mine, theirs)
    beside = timed.beside if timed.beside is not None else found.base.cpu
    saved = 1 - timed.cpu / beside if beside > 0 else 0.0
    return Row(switch, timed, size, saved, errors, peak, found.floor)


@dataclass
class _Runner:
    """Runs with settings, or takes them from those kept."""

    load: Load
    kept: KeptRuns
    digest: str
    libraries: tuple[str, ...]
    names: list[str]
    span: tuple[float, float]
    end: float = 0.0
    compiled: set[Any] = field(default_factory=set)  # variants of laws, in this process

    @property
    def left(self) -> float:
        """Seconds of the budget."""
        return self.end - time.perf_counter()

    def loaded(self, settings: Any) -> Any:
        """The scene with settings; laws that are compiled for the first time on this machine are not counted."""
        begun = time.perf_counter()
        model = self.load(on_grid(settings, self.span))
        fresh = {block.kernel.variant for block in model.system.blocks if not block.kernel.native.cached}
        if not fresh <= self.compiled:
            self.end += time.perf_counter() - begun
            self.compiled |= fresh
        return model

    def run(self, settings: Any, cap: float, made: Any = None) -> Timed:
        """A run; `made` is the scene with these settings when it has been loaded already."""
        key = key_of(self.digest, ("effects", sorted(settings.items()), self.names, self.span), self.libraries)
        timed = self.kept.get(key, cap)  # a run cut off at less than `cap` is made again
        if timed is None:
            if made is None:  # the first one loads or compiles the engine
                timed_run(self.load, {**settings, "run.max_steps": "1"}, [], self.span, cap)
            timed = timed_run(self.load if made is None else lambda _: made, settings, self.names, self.span, cap)
            if settings and timed.finished and timed.wall < BRIEF:
                cpu, beside, scatter = in_turns(self.load, settings, self.span, cap)
                timed = replace(timed, cpu=cpu, beside=beside, scatter=scatter)
            self.kept.put(key, timed)
        return timed
