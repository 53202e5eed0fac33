"""One scene under several treatments: what each costs, and how far it is from the exact one.

    comparison = compare(lambda settings: fairlead.load("belt", settings), {"pad.method": ["hold", "tanh"]})
    print(comparison.rows[0].error)

Error is the root mean square difference from the reference over the common time, relative to the range of the signal
in the reference, or to a thousandth of the widest range of its unit where that is more; the worst signal counts, and
none that stands still there. Both are taken from the curves of their steps: lines between rows would be the larger
error of a run with few of them. So every step is recorded, unless `settings` say otherwise. Runs that end early or do
not start are rows with a reason.
"""

from __future__ import annotations

import itertools
import pathlib
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from fairlead.analysis.record.declared_signals import signals_of
from fairlead.analysis.record.suggestion import suggest
from fairlead.analysis.treatments.treatments import kinds_of_treatment
from fairlead.arguments import Arguments
from fairlead.errors import FairleadError, Fault, Location, ModelError, RunWarning, listing
from fairlead.netlist.settings_file import Setting
from fairlead.patterns import picked

if TYPE_CHECKING:
    from fairlead.results import Result

FINER = 1e-2  # accuracy of the reference, relative to that of the scene
GRID = 4001  # common times at which signals are compared
Load = Callable[[Mapping[str, str]], Any]  # settings -> Model
LEAST = 1e-3  # of the widest range of a unit: what hardly moves is measured by that
STILL = 1e-12  # m or rad, or of its place: a range of rounding
EVERY, ACCURACY = "record.every", "run.accuracy"
VARIED = Location("--vary")


@dataclass(frozen=True)
class Row:
    """One run. Numbers are None where the run did not get that far; `reason` is empty when it finished."""

    label: str
    status: str
    reason: str = ""
    error: float | None = None  # relative to the range of the worst signal
    worst: str = ""  # that signal
    creep: float | None = None  # m/s
    steps: int | None = None
    switches: int | None = None
    seconds: float | None = None  # stepping alone; compiling happens once


@dataclass(frozen=True)
class Comparison:
    """All rows, and what the errors are measured against."""

    rows: tuple[Row, ...]
    reference: str
    directory: pathlib.Path


def compare(
    load: Load, vary: Mapping[str, Sequence[str]], *, settings: Mapping[str, str] | None = None,
    out: str | pathlib.Path = "results/compare", signals: str = "*",
    max_wall: float | str = 60.0,
) -> Comparison:  # fmt: skip
    """Run every combination of the values in `vary` on the model that `load(settings)` gives.

    A run ends after `max_wall` (`"2 min"`, or seconds) at the latest.

    The reference is exact hold where the treatment is varied, and of anything else the first value, at a hundredth of
    the finest accuracy of all combinations. Raises ModelError for every mistake in what is varied, before it runs
    anything.
    """
    asked = Arguments("compare")
    asked.path("out", out)
    wall = asked.above_zero("max_wall", max_wall, "s")
    asked.refuse()
    folder, fixed = pathlib.Path(out), {EVERY: "null", **(settings or {})}
    vary = {name: [Setting(value, VARIED) for value in values] for name, values in vary.items()}
    chosen = [dict(zip(vary, values, strict=True)) for values in itertools.product(*vary.values())]
    _refuse_mistakes(load, fixed, chosen)
    first = {**fixed, **chosen[0]}
    _refuse_unknown(load(first), signals)
    kinds = kinds_of_treatment(load(first))
    exact = {name: kinds.exact if name.split(".")[-1] == kinds.key else _finest(load, first, name, values)
             for name, values in vary.items()}  # fmt: skip
    accuracy = min(load({**fixed, **values}).netlist.run.accuracy for values in (exact, *chosen))
    reference, failed = _run(load, {**fixed, **exact}, folder / "reference", wall, accuracy * FINER)
    if reference is not None and reference.status != "finished":
        reference = None
    rows = []
    for number, values in enumerate(chosen):
        result, row = _run(load, {**fixed, **values}, folder / f"run{number}", wall, None)
        rows.append(_row(", ".join(values.values()), result, row, reference, signals))
    told = ", ".join(value for name, value in exact.items() if name != ACCURACY) or "the scene"
    label = f"{told} at accuracy {max(accuracy * FINER, 1e-12):g}"
    return Comparison(
        tuple(rows), label if reference is not None else f"none: {failed or 'the reference failed'}", folder
    )


def _finest(load: Load, settings: Mapping[str, str], name: str, values: Sequence[str]) -> str:
    """The value with which the scene has the finest accuracy; the first where that does not depend on it."""
    return min(values, key=lambda value: load({**settings, name: value}).netlist.run.accuracy)


def _refuse_mistakes(load: Load, fixed: Mapping[str, str], chosen: Sequence[Mapping[str, str]]) -> None:
    """Tell of all combinations what the netlist and its components refuse; what only fails to run is a row."""
    faults: dict[Fault, None] = {}
    for values in chosen:
        try:
            load({**fixed, **values}).assembly  # noqa: B018 - making it is what refuses
        except ModelError as error:
            faults |= dict.fromkeys(error.faults)
    if faults:
        raise ModelError(faults)


def _refuse_unknown(model: Any, pattern: str) -> None:
    """Raise ModelError when no recorded signal fits the pattern that the error is to be taken from."""
    names = dict.fromkeys(signal.name for signal in signals_of(model.flat.assembly))
    recorded = [name for one in model.netlist.record.signals for name in picked(names, one)]
    if not picked(dict.fromkeys(recorded), pattern):
        near, way_out = suggest(pattern, recorded)
        what = f"--signals: no recorded signal has the name {pattern}. {near}".rstrip()
        raise ModelError([Fault(None, what, way_out or f"Recorded are {listing(recorded)}.")])


def _run(
    load: Load, settings: Mapping[str, str], out: pathlib.Path, max_wall: float, accuracy: float | None
) -> tuple[Result | None, str]:  # fmt: skip
    """The result, or None and why there is none; a result that ended early comes with why."""
    more = {} if accuracy is None else {"accuracy": max(accuracy, 1e-12)}
    try:
        model = load(settings)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RunWarning)
            result = model.run(out=out, force=True, max_wall=max_wall, check=False, **more)
    except FairleadError as error:
        return None, str(error)
    if result.status == "finished":
        return result, ""
    return result, result.run["sentence"]


def _row(label: str, result: Result | None, reason: str, reference: Result | None, signals: str) -> Row:
    if result is None:
        return Row(label, "not started", reason)
    run, error, worst = result.run, None, ""
    if result.status == "finished" and reference is not None:
        error, worst = _error(result, reference, signals)
    creep = run.get("worst_creep") or {}
    return Row(
        label, result.status, reason, error, worst, creep.get("value"), run["steps"], run["switches"], run["solve_time"]
    )


def _error(result: Result, reference: Result, pattern: str) -> tuple[float | None, str]:
    """Largest relative difference over the signals that are positions or forces in both."""
    t = np.linspace(max(result.t[0], reference.t[0]), min(result.t[-1], reference.t[-1]), GRID)
    worst, name = None, ""
    common = set(reference.match(pattern)) & set(result.match(pattern))
    compared = [
        signal for signal in reference.signals
        if signal.name in common and signal.unit in ("m", "rad")
    ]  # fmt: skip
    right = {signal.name: reference.at(signal.name, t) for signal in compared}
    widest = {unit: max((float(np.ptp(right[s.name])) for s in compared if s.unit == unit), default=0.0)
              for unit in ("m", "rad")}  # fmt: skip
    for signal in compared:
        span = max(float(np.ptp(right[signal.name])), LEAST * widest[signal.unit])
        if span <= STILL * max(1.0, float(np.abs(right[signal.name]).max())):
            continue
        difference = result.at(signal.name, t) - right[signal.name]
        share = float(np.sqrt(np.mean(difference**2))) / span
        if worst is None or share > worst:
            worst, name = share, signal.name
    return worst, name
