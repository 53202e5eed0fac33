"""What each effect of a scene costs and what it changes: every one switched by itself, and all of them off.

    found = effects(load, budget=60.0, window=(24.0, 34.0))
    found.rows[0].change, found.rows[0].saved

`change` is the worst of what the outputs do at the end, as rms and at their peaks (`changes.py`), after the start
transient: from the first of `window`, or a tenth of the time that is studied; what happens in the start is told apart.
A change below the floor, which is what a run at a tenth of the accuracy changes, is no change. `saved` is the share of
the stepping time that the switch saves, negative when it costs more; brief runs are timed in turns with the scene as
it is. Lines are sorted by what is gained for what is lost: the cheapest simplification first. A switch that leaves
every equation as it was is not run (`sameness.py`).

The time that is studied is such that all switches can be judged in the budget, but no shorter than what the scene
comes to in a fiftieth of it: how a line behaves says nothing that is only seen at rest. With the last of `window` given
it is that. What is likely to matter most goes first (`weights.py`), and what was not judged is named.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from fairlead.analysis.cost.compared_outputs import outputs, without_shares
from fairlead.analysis.cost.kept_runs import KeptRuns, key_of
from fairlead.analysis.cost.timed_run import (
    BRIEF,
    FEWEST_TURNS,
    GRID,
    REPEATS,
    Load,
    Timed,
    grid,
    in_turns,
    on_grid,
    timed_run,
)
from fairlead.analysis.effects.changes import Change, Floors, changes, floors
from fairlead.analysis.effects.effect_row import Row, Size
from fairlead.analysis.effects.sameness import same
from fairlead.analysis.effects.switches import Switch, all_off, switches
from fairlead.analysis.effects.weights import by_weight
from fairlead.arguments import Arguments
from fairlead.errors import FairleadError, NumericalError, UsageError
from fairlead.native import spent_compiling

START = 0.1  # of the time that is studied is the start transient, where no other is given
FEWEST = 20  # common times that a window must have
AT_MOST = 0.5  # of the time left is for the scene as it is, or its more exact run, so that switches are judged too
AT_LEAST = 0.02  # of the budget is for the scene as it is, also where that leaves no time for all switches
SHORTEST = 0.2  # s; with less time left no run is begun
SLOWER, WORTH_WAITING = 5.0, 1.0  # times the scene as it is, s; a switch that takes longer is cut off
KEPT, CLOSING = 0.97, 1.5  # of the budget is for runs; times what reading the scene took is for start and table
FINER = 0.1  # accuracy of the run that tells the floor
PLANNED, USUAL, EXACT, BESIDE = 0.8, 1.3, 5.0, 1.5
"""What the span is planned with: the share of the budget; what a switch, and the scene as it is with its more exact
run, take over the scene; what there is to a run beside its steps over that of one without any."""
Note = Callable[[str], None]
Window = tuple[float | str | None, float | str | None]


@dataclass
class Effects:
    """All switches of a scene. `left_out` names those that the budget or Ctrl-C did not let be judged.

    `span` was run, and judged from `begin` on.
    """

    name: str
    span: tuple[float, float]
    begin: float
    whole: bool
    base: Timed
    size: Size
    floors: Floors = field(default_factory=dict)
    floors_starting: Floors = field(default_factory=dict)
    rows: list[Row] = field(default_factory=list)
    untouched: list[str] = field(default_factory=list)  # switches that leave every equation as it was
    left_out: list[str] = field(default_factory=list)
    interrupted: bool = False
    studied: float = 1.0  # of the time of the run, that was run


def effects(
    load: Load, *, budget: float | str = 60.0, signals: Sequence[str] = ("*",), kept: KeptRuns | None = None,
    libraries: Iterable[str] = (), note: Note | None = None, window: Window = (None, None),
) -> Effects:  # fmt: skip
    """Switch all that a scene can switch, within `budget` (`"2 min"`, or seconds), beside compiling new laws.

    Judged is what happens in `window` (texts like `"24 s"`, or seconds; None: all). Raises ModelError, UsageError for a
    wrong scene, pattern or window, NumericalError when the scene as it is does not run.
    """
    asked = Arguments("effects")
    seconds = asked.above_zero("budget", budget, "s")
    first, last = (None if one is None else asked.quantity("window", one, "s") for one in window)
    asked.refuse()
    begun, compiled = time.perf_counter(), spent_compiling()
    model = load({})
    names, units, _ = outputs(model, signals)
    if "*" in signals:
        kept_names = set(without_shares(model, names))
        units = [unit for name, unit in zip(names, units, strict=True) if name in kept_names]
        names = [name for name in names if name in kept_names]
    run = model.netlist.run
    _check(first, last, run.start, run.stop)
    note = note or (lambda _: None)
    note("the scene as it is")
    every = by_weight(model, switches(model))
    span = (run.start, run.stop if last is None else last)
    assert model.system is not None  # compiled here
    loaded = time.perf_counter() - begun - (spent_compiling() - compiled)
    end = begun + seconds - max((1 - KEPT) * seconds, CLOSING * loaded)
    runner = _Runner(load, kept or KeptRuns(None), model.netlist.digest, tuple(libraries), names, span, end, compiled)
    base = runner.base(seconds, len(every) + 1, given=last is not None)
    if not base.finished:
        raise NumericalError(f"{model.netlist.name} itself does not run: {base.reason or base.status}")
    begin = runner.span[0] + START * (runner.span[1] - runner.span[0]) if first is None else first
    whole = runner.span == (run.start, run.stop)
    found = Effects(model.netlist.name, runner.span, begin, whole, base, Size.of(model.system),
                    studied=(runner.span[1] - runner.span[0]) / (run.stop - run.start))  # fmt: skip
    judge = _Judge(model, runner, found, units, note)
    try:
        finer = {"run.accuracy": f"{max(FINER * run.accuracy, 1e-12):g}"}
        tight = runner.run(finer, max(AT_MOST * runner.left, SHORTEST), allowed=0.0)
        if tight.finished:
            found.floors_starting, found.floors = (floors(each) for each in judge.changed(tight))
        for k, switch in enumerate(every):
            judge.switch(switch, len(every) + 1 - k)
        together = all_off(load, [one for one in every if one.label not in found.untouched])
        if together is not None:
            judge.switch(together, 1)
    except KeyboardInterrupt:
        found.interrupted = True
    found.rows.sort(key=lambda row: -row.gain)
    return found


def _check(first: float | None, last: float | None, start: float, stop: float) -> None:
    """Raise UsageError where a window is not in the run, or has too few common times."""
    begin, end = start if first is None else first, stop if last is None else last
    if not (start <= begin < end <= stop):
        raise UsageError(f"--from, --to: {begin:g} ... {end:g} s is no time of a run of {start:g} ... {stop:g} s.\n"
                         f"    Write --from '{start:g} s' --to '{stop:g} s', or less.")  # fmt: skip
    if first is not None and (end - begin) * GRID < FEWEST * (end - start):
        least = begin + (begin - start) * FEWEST / (GRID - FEWEST)
        raise UsageError(f"--from, --to: {end - begin:g} s after {begin - start:g} s are too few to compare.\n"
                         f"    Write --to '{least:.3g} s', or later.")  # fmt: skip


def rounded_down(span: float) -> float:
    """A span of one digit that is not longer, so that what was reached in time is reached again."""
    unit = 10.0 ** math.floor(math.log10(span))
    return float(f"{math.floor(span / unit + 1e-9) * unit:.1g}")


@dataclass
class _Judge:
    """Makes the rows of `found`."""

    model: Any
    runner: _Runner
    found: Effects
    units: list[str]
    note: Note

    def switch(self, switch: Switch, waiting: int) -> None:
        """Make the row of a switch, or say why there is none; `waiting` are to be judged, with this one."""
        runner, found = self.runner, self.found
        if runner.left < SHORTEST + runner.beside:
            found.left_out.append(switch.label)
            return
        self.note(switch.label)
        try:
            made = runner.loaded(switch.settings)
            untouched = same(self.model.system, made.system)
        except FairleadError as error:
            found.rows.append(Row(switch, Timed("cannot be", str(error).splitlines()[0])))
            return
        if untouched:
            found.untouched.append(switch.label)
            return
        patience = max(WORTH_WAITING, SLOWER * found.base.wall)
        left = runner.left
        timed = runner.run(switch.settings, min(max(left - runner.closing, SHORTEST), patience), made, left / waiting)
        if timed.status == "budget":
            if left - runner.closing < patience:  # not slow, but begun too late
                found.left_out.append(switch.label)
                return
            timed = replace(timed, reason=f"takes more than {SLOWER:g} times as long; not worth a change.")
        found.rows.append(self.row(switch, timed, Size.of(made.system)))

    def row(self, switch: Switch, timed: Timed, size: Size) -> Row:
        """The row of a run with a switch."""
        if not timed.finished:
            return Row(switch, timed, size)
        starting, after = self.changed(timed)
        beside = timed.beside if timed.beside is not None else self.found.base.cpu
        saved = 1 - timed.cpu / beside if beside > 0 else 0.0
        return Row(switch, timed, size, saved, after, self.found.floors, starting, self.found.floors_starting,
                   self.found.begin)  # fmt: skip

    def changed(self, timed: Timed) -> tuple[list[Change], list[Change]]:
        """What a run changes in the start, and after it."""
        after = grid(self.runner.span) >= self.found.begin
        both = self.runner.names, self.units, timed.values, self.found.base.values
        return changes(*both, ~after), changes(*both, after)


@dataclass
class _Runner:
    """Runs with settings, or takes them from those kept."""

    load: Load
    kept: KeptRuns
    digest: str
    libraries: tuple[str, ...]
    names: list[str]
    span: tuple[float, float]
    end: float
    compiled: float  # s, spent compiling when the study began
    beside: float = 0.0  # s that a run takes beside its steps
    loading: float = 0.0  # s of that, to load and compile the scene

    @property
    def left(self) -> float:
        """Seconds of the budget; compiling, once for this machine, is outside it."""
        return self.end + spent_compiling() - self.compiled - time.perf_counter()

    @property
    def closing(self) -> float:
        """Seconds that a run takes when its scene is loaded, beside its steps."""
        return max(0.0, self.beside - self.loading)

    def base(self, budget: float, switched: int, *, given: bool) -> Timed:
        """The scene as it is: over its span when that is given, else over what leaves time for all switches."""
        begun, compiled = time.perf_counter(), spent_compiling()
        self.loading = timed_run(self.load, {"run.max_steps": "1"}, [], self.span, budget).setup
        self.beside = time.perf_counter() - begun - (spent_compiling() - compiled)
        if given:
            base = self.run({}, budget)
            if base.status == "budget":
                came = f"the scene as it is comes to {base.reached:.3g} s in the budget of {budget:g} s"
                raise UsageError(f"--to {self.span[1]:g} s: {came}.\n    Give a larger --budget, or an earlier --to.")
            return base
        share = (PLANNED * budget - BESIDE * self.beside * switched) / (USUAL * switched + EXACT)
        key = key_of(self.digest, ("span of effects", budget, self.names, self.span), self.libraries)
        base = self.kept.get(key, 0.0) or self.run({}, max(share, AT_LEAST * budget, SHORTEST))
        self.kept.put(key, base)
        start = self.span[0]
        while base.status == "budget" and base.reached > start:  # again where the machine has become slower meanwhile
            self.span = (start, start + rounded_down(0.9 * (base.reached - start)))
            base = self.run({}, max(AT_MOST * self.left, SHORTEST))
        return base

    def loaded(self, settings: Any) -> Any:
        """The scene with settings, compiled."""
        model = self.load(on_grid(settings, self.span))
        assert model.system is not None  # compiled here
        return model

    def run(self, settings: Any, cap: float, made: Any = None, allowed: float = math.inf) -> Timed:
        """A run; `made` is the scene with these settings when it has been loaded already.

        A brief one is timed again in turns with the scene as it is, for `allowed` seconds at most.
        """
        key = key_of(self.digest, ("effects", sorted(settings.items()), self.names, self.span), self.libraries)
        timed = self.kept.get(key, cap)  # a run cut off at less than `cap` is made again
        if timed is None:
            begun = time.perf_counter()
            load = self.load if made is None else lambda _: made
            repeats = REPEATS if (REPEATS + 1) * self.beside < allowed else 1
            timed = timed_run(load, settings, self.names, self.span, cap, repeats=repeats)
            took = (time.perf_counter() - begun) / timed.repeats
            if settings and timed.finished and timed.wall < BRIEF and 2 * FEWEST_TURNS * took < allowed:
                cpu, beside, scatter = in_turns(self.load, settings, self.span, cap, allowed)
                timed = replace(timed, cpu=cpu, beside=beside, scatter=scatter)
            self.kept.put(key, timed)
        return timed
