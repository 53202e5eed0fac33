"""One run of a study: what it computed on a common grid of times, its switches, and what it cost.

    timed = timed_run(load, {"run.engine": "rodas"}, names, span=(0, 8), cap=10.0)
    timed.values                                             (GRID + 1, len(names)), in SI

Set-up (reading, tracing, compiling or loading kernels) is apart from stepping. The CPU time of the stepping is its
wall time times the share of the processor that the process had during the run, so that a busy machine does not
make an engine look slow; of repeats the median counts.
"""

from __future__ import annotations

import math
import statistics
import time
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.errors import FairleadError, RunWarning
from fairlead.native import spent_compiling

GRID = 1000  # intervals between the common times
REPEATS = 5
OF_A_RUN = ("run.engine", "run.accuracy", "run.method")  # settings that one compiled model can be run with
AT_HAND = 5  # models that are kept compiled
ANOTHER = 2.0  # times what the others took: another model, which may have more elements
BRIEF = 0.2  # s; when the runs together took longer, their time is known well enough
TURNS, FEWEST_TURNS = 9, 3
SCATTER = 0.15  # of the ratio of two times that were taken one after the other, on a machine that others share
Load = Callable[[Mapping[str, str]], Any]  # settings -> Model
Left = Callable[[float], float]  # s that it took to make a model -> s that a run of it may take
Members = Mapping[str, Sequence[str]]  # an output -> the signals whose mean it is, where it is of another mesh


@dataclass(frozen=True)
class Timed:
    """A run that finished, or why it did not. `values` is (GRID + 1, m), empty when it did not finish."""

    status: str
    reason: str = ""
    cap: float = 0.0  # s of wall time that it was given
    setup: float = 0.0  # s, wall: netlist to compiled system
    cpu: float = 0.0  # s, stepping
    wall: float = 0.0  # s, stepping
    steps: int = 0
    switches: int = 0
    reached: float = 0.0  # s, simulated
    creep: float | None = None  # m/s, the worst of all contacts
    ties: str = ""  # which contacts leave open what follows, when and why; nothing where none do
    repeats: int = 1
    beside: float | None = None  # s, CPU time of the scene as it is when it was run in turns with this
    scatter: float = SCATTER  # of the ratio of the two times
    values: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 0)), repr=False)
    events: tuple[tuple[float, str, str, str], ...] = field(default=(), repr=False)  # t, component, from, to

    @property
    def finished(self) -> bool:
        """True when there are values to compare."""
        return self.status == "finished"

    def plain(self) -> dict[str, Any]:
        """All but values and events, for JSON."""
        return {name: value for name, value in asdict(replace(self, values=np.empty(0), events=())).items()
                if name not in ("values", "events")}  # fmt: skip


def grid(span: tuple[float, float]) -> NDArray[np.float64]:
    """The common times (GRID + 1,) [s] of a span."""
    return np.linspace(span[0], span[1], GRID + 1)


def on_grid(settings: Mapping[str, str], span: tuple[float, float]) -> dict[str, str]:
    """The settings, with a run over the span that is recorded on the grid."""
    every = (span[1] - span[0]) / GRID
    return {**settings, "run.stop": repr(span[1]), "record.every": repr(every)}


class Models:
    """The compiled models of a study: one for all engines and accuracies, the few that were used last."""

    def __init__(self, load: Load) -> None:
        self.load = load
        self.made: dict[tuple[object, ...], tuple[Any, float]] = {}

    def __call__(self, settings: Mapping[str, str], span: tuple[float, float]) -> tuple[Any, float]:
        """The model with these settings but those of a run, over a span; and the seconds it took, compiling apart.

        Raises FairleadError for a scene that cannot be built.
        """
        key = _key(settings, span)
        if key not in self.made:
            begun, compiled = time.perf_counter(), spent_compiling()
            others = {name: value for name, value in settings.items() if name not in OF_A_RUN}
            model = self.load(on_grid(others, span))
            assert model.system is not None  # compiled here, so that it counts as set-up
            setup = time.perf_counter() - begun - (spent_compiling() - compiled)
            self.made[key] = model, setup
        self.made[key] = found = self.made.pop(key)
        while len(self.made) > AT_HAND:
            del self.made[next(iter(self.made))]
        return found

    def takes(self, settings: Mapping[str, str], span: tuple[float, float]) -> float:
        """Seconds that making it may take, by what others took: 0 where it is at hand."""
        if _key(settings, span) in self.made:
            return 0.0
        return ANOTHER * max((setup for _, setup in self.made.values()), default=0.0)


def _key(settings: Mapping[str, str], span: tuple[float, float]) -> tuple[object, ...]:
    return (span, *sorted((name, value) for name, value in settings.items() if name not in OF_A_RUN))


def timed_run(
    load: Load | Models, settings: Mapping[str, str], names: Sequence[str], span: tuple[float, float], cap: float,
    members: Members | None = None, repeats: int = REPEATS, left: Left = lambda _: math.inf,
) -> Timed:  # fmt: skip
    """Run a scene over a span with at most `cap` seconds of wall time; repeat it when it is brief.

    `left` tells how long a run may take yet, given what it took to make the model: no run begins after that, and one
    that is under way stops. A scene that cannot be built is a Timed with the reason. KeyboardInterrupt passes
    through, also when a run was interrupted in its middle.
    """
    begun = time.perf_counter()
    models = load if isinstance(load, Models) else Models(load)
    try:
        model, setup = models(settings, span)
    except FairleadError as error:
        return Timed("not started", _first_line(error), cap)
    first, walls, cpus = None, [], []
    for _ in range(repeats):
        allowed = min(cap, left(setup))
        if allowed <= 0:
            break
        result, cpu = _once(model, allowed, settings)
        if isinstance(result, str):
            return Timed("not started", result, cap, setup)
        walls.append(result.run["solve_time"])
        cpus.append(result.run["solve_time"] * cpu)
        first = first or _summary(result, names, span, members or {})
        if not first.finished or sum(walls) > BRIEF or (time.perf_counter() - begun) > cap:
            break
    if first is None:
        return Timed("budget", "the budget was used up before", 0.0, setup)
    return replace(
        first, cap=min(cap, allowed) if not first.finished else cap, setup=setup, wall=statistics.median(walls),
        cpu=statistics.median(cpus), repeats=len(walls),
    )  # fmt: skip


def in_turns(
    load: Load, settings: Mapping[str, str], span: tuple[float, float], cap: float, allowed: float = math.inf
) -> tuple[float, float, float]:
    """CPU time with settings and as the scene is, run in turns, so that whatever else the machine does slows both.

    Medians in s, and half the range between the quartiles of their ratio. No turn begins after `allowed` seconds, but
    for the first few.
    """
    begun = time.perf_counter()
    models = [load(on_grid(one, span)) for one in (settings, {})]
    cpus: list[list[float]] = [[], []]
    for turn in range(TURNS):
        if turn >= FEWEST_TURNS and time.perf_counter() - begun > allowed:
            break
        for model, times in zip(models, cpus, strict=True):
            result, share = _once(model, cap, {})
            if isinstance(result, str):
                return math.nan, math.nan, math.inf
            times.append(result.run["solve_time"] * share)
    ratios = [one / other for one, other in zip(*cpus, strict=True)]
    low, middle, high = statistics.quantiles(ratios, n=4)
    beside = statistics.median(cpus[1])
    return middle * beside, beside, (high - low) / 2


def _once(model: Any, cap: float, settings: Mapping[str, str]) -> tuple[Any, float]:
    """The result of one run, all of it in memory, and the share of the processor it had; or why there is none."""
    words: dict[str, Any] = {name.partition(".")[2]: value for name, value in settings.items() if name in OF_A_RUN}
    words |= {"accuracy": float(words["accuracy"])} if "accuracy" in words else {}
    wall, cpu = time.perf_counter(), time.process_time()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RunWarning)
            result = model.run(out=None, max_wall=cap, check=False, **words)
    except FairleadError as error:
        return _first_line(error), 0.0
    share = (time.process_time() - cpu) / max(time.perf_counter() - wall, 1e-9)
    if result.status == "interrupted":
        raise KeyboardInterrupt
    return result, min(share, 1.0)


def _summary(result: Any, names: Sequence[str], span: tuple[float, float], members: Members) -> Timed:
    run = result.run
    creep = (run.get("worst_creep") or {}).get("value")
    reached = float(run.get("end_time") or span[0])
    done = Timed(result.status, steps=run["steps"], switches=run["switches"], reached=reached, creep=creep)
    if result.status != "finished":
        return replace(done, reason=str(run.get("sentence", "")))
    done = replace(done, ties=_ties(run.get("released_together")) or _gave_way(run.get("gave_way")))
    events = tuple((event.t, event.component, event.zone_from, event.zone_to) for event in result.events)
    return replace(done, values=sampled(result, names, span, members), events=events)


def _ties(found: Mapping[str, Any] | None) -> str:
    if not found or not found["count"]:
        return ""
    first = found["first"][0]
    named = f"{', '.join(first['contacts'])} at t = {first['t']:.4g} s"
    return f"{named} came to their limits together, and had one been first, others might hold."


def _gave_way(found: Mapping[str, Any] | None) -> str:
    if not found or not found["count"]:
        return ""
    first = found["first"][0]
    named = f"{first['contact']} at t = {first['t']:.4g} s"
    return f"{named} gave way while others held it in place, and how they share a load is not determined."


def sampled(result: Any, names: Sequence[str], span: tuple[float, float], members: Members) -> NDArray[np.float64]:
    """The outputs (GRID + 1, m) of a result on the common times; NaN where it has no such output."""
    t = np.clip(grid(span), result.t[0], result.t[-1])
    values = np.full((len(t), len(names)), np.nan)
    for column, name in enumerate(names):
        found = [one for one in members.get(name, (name,)) if one in result]
        if found:
            values[:, column] = np.mean([result.at(one, t) for one in found], axis=0)
    return values


def _first_line(error: FairleadError) -> str:
    return str(error).splitlines()[0]
