"""Cases of one model in memory: compiled once, run many times, and only what is wanted is recorded.

cases = Cases(fairlead.load("belt"), {"peak": "peak(block.x)", "slips": "switches(pad)"}, max_steps=10_000)
cases.row({"pad.normal_force": "12 N"}).figures["peak"]
"""

from __future__ import annotations

import math
import platform
import time
import traceback
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fairlead.arguments import Arguments, keywords_told, told_of
from fairlead.cases.figures import Figure, Function, default_figures, read_figures
from fairlead.cases.identity import key_of, scene_digest
from fairlead.cases.row import BUDGET, COUNTED, ERROR, FAILED, FINISHED, REFUSED, Row, Value
from fairlead.cases.values_of import value_of
from fairlead.component.numbers import told_numbers
from fairlead.errors import FairleadError, Location, ModelError, UsageError
from fairlead.netlist.settings import RecordSettings
from fairlead.running import patterns_of, run

if TYPE_CHECKING:
    from fairlead.model import Model
    from fairlead.result import Result
    from fairlead.results.events import Event

Floats = NDArray[np.float64]
Take = Callable[["Result"], None]
PLACE = Location("values")
"""What is wrong with values of a case is told as of this, by whatever call they came."""
EXAMPLE = '{"peak": "peak(block.x)"}'
OF_THE_RUN = {f"run.{name}": ("s", "") for name in ("start", "stop", "first_step", "max_step")}
MOST_STRUCTURES = 4
"""Compiled structures that are kept; a sweep over words has a few, and one over sizes comes back to none."""


class Cases:
    """Cases of a model: figures asked of it, and the structures compiled so far. It pickles as its model does."""

    @keywords_told
    def __init__(self, model: Model, figures: Mapping[str, str | Function] | None = None, *,
                 max_steps: int | None = None) -> None:  # fmt: skip
        """`figures` by name (see `figures.py`), None for those of the netlist; `max_steps` ends a case that takes more.

        Raises ModelError for a model or figures that are wrong.
        """
        asked = Arguments("Cases")
        asked.model(model)
        if figures is not None:
            asked.map_of("figures", figures, EXAMPLE, (str, Callable), "is neither a text nor a function")
        if max_steps is not None:
            asked.whole("max_steps", max_steps, 1)
        asked.refuse()
        self.model, self.max_steps = model, max_steps
        self.wanted = dict(default_figures(model) if figures is None else figures)
        self.figures: tuple[Figure, ...] = read_figures(self.wanted, model)
        self.scene = scene_digest(model, (sorted((f.name, f.text) for f in self.figures), max_steps))
        self._structures: dict[tuple[str, ...], Model] = {}

    @property
    def name(self) -> str:
        """The name of the model."""
        return self.model.netlist.name

    @property
    def about(self) -> dict[str, tuple[str, str]]:
        """Unit and description of every number of the model that may be varied, by name."""
        return {**OF_THE_RUN, **told_numbers(self.model.netlist, self.model.assembly.entries)}

    @property
    def units(self) -> dict[str, str]:
        """Unit of each figure by its name."""
        return {figure.name: figure.unit for figure in self.figures}

    def __getstate__(self) -> dict[str, object]:
        """What a pickle holds: no compiled structure."""
        return {**vars(self), "_structures": {}}

    @property
    def limited(self) -> bool:
        """Whether the netlist has limits."""
        return bool(self.model.netlist.limits)

    def key(self, values: Mapping[str, Value]) -> str:
        """What the case of these values is known by."""
        return key_of(self.scene, values)

    def check(self, values: Mapping[str, Value]) -> None:
        """Raise ModelError if the model has no such values; nothing is run or compiled."""
        _refuse_no_map("Cases.check", values)
        assert self._beside(values).assembly is not None

    def row(self, values: Mapping[str, Value]) -> Row:
        """Run the case of these values. What goes wrong in it is told by its status and sentence.

        Raises ModelError where `values` is no map.
        """
        _refuse_no_map("Cases.row", values)
        return self._told_row(values)

    def _told_row(self, values: Mapping[str, Value], also: tuple[str, ...] = (), take: Take | None = None) -> Row:
        begun = time.perf_counter()
        start = Row(self.key(values), dict(values), ERROR, host=platform.node())
        try:
            made = self._run(start, values, also, take)
        except ModelError as error:
            made = replace(start, status=REFUSED, sentence=_in_a_line(error))
        except FairleadError as error:
            made = replace(start, sentence=_in_a_line(error))
        except Exception as error:  # noqa: BLE001 - a function of the user, or fairlead itself: it costs one row
            made = replace(start, sentence=_told(error))
        return replace(made, seconds=time.perf_counter() - begun)

    def result(self, values: Mapping[str, Value], out: object = None) -> Result:
        """The case of `values` with all that the netlist records, in memory or in folder `out`. Raises ModelError."""
        _refuse_no_map("Cases.result", values)
        with told_of("Cases.result", "Model.with_values"):
            model = self.model.with_values(values)
        with told_of("Cases.result", "Model.run"):
            return model.run(out=out, force=True, check=False)  # type: ignore[arg-type]

    def curves(self, values: Mapping[str, Value], signals: Sequence[str], times: Floats) -> tuple[Row, Floats]:
        """The row of the case of `values`, and `signals` at `times` [s], shape (signals, times); NaN where it has none.

        Values are those along the curves of the steps. Never raises for what happens in the run.
        """
        found: list[Floats] = []

        def take(result: Result) -> None:
            found.append(np.array([result.at(name, times) for name in signals]))

        row = self._told_row(values, tuple(signals), take)
        return row, found[0] if found else np.full((len(signals), len(times)), math.nan)

    def followed(self, values: Mapping[str, Value]) -> tuple[Row, tuple[Event, ...]]:
        """The row of the case of `values` and its zone changes in order; none where it did not finish."""
        found: list[Event] = []
        row = self._told_row(values, (), lambda result: found.extend(result.events))
        return row, tuple(found)

    def _run(self, start: Row, values: Mapping[str, Value], also: tuple[str, ...], take: Take | None) -> Row:
        model = self._model(values)
        row, found = start, dict[str, float]()
        for record in self._records(model, also):
            try:
                result = self._result(model, record)
            except UsageError as error:  # the engine that was asked for does not run such a model, or is not installed
                return replace(start, status=REFUSED, sentence=_in_a_line(error))
            if result.status == "interrupted":
                raise KeyboardInterrupt
            row = self._ended(start, result, row.loop)
            if not result.ok:
                return row
            if take is not None:
                take(result)
                take = None
            found |= {one.name: value_of(one, result) for one in record.figures}
        return replace(row, figures={one.name: found[one.name] for one in self.figures})

    @staticmethod
    def _ended(start: Row, result: Result, before: float) -> Row:
        """How a run ended; `before` it the engine was busy so long [s]."""
        run = result.run
        status = FINISHED if result.ok else BUDGET if result.status == "budget" else FAILED
        return replace(start, status=status, sentence=str(run["sentence"]), broken=tuple(run["limits_broken"]),
                       counters={name: int(run[name]) for name in COUNTED},
                       loop=before + float(run["solve_time"]))  # fmt: skip

    def _model(self, values: Mapping[str, Value]) -> Model:
        """The model of these values, on a structure that is compiled already where there is one that fits."""
        asked = Arguments("Cases.row")
        asked.values_by_name("values", values)
        asked.refuse()
        words = tuple(f"{name}={values[name]}" for name in sorted(values) if not _is_number(values[name]))
        near = self._structures.pop(words, self.model)
        model = self._beside(values, near)
        near = model if model.rebuilt or near is self.model else near
        self._structures[words] = near
        if len(self._structures) > MOST_STRUCTURES:
            del self._structures[next(iter(self._structures))]
        return model

    def _beside(self, values: Mapping[str, Value], near: Model | None = None) -> Model:
        with told_of(PLACE.file, "Model.beside"):
            return self.model.beside(values, near)

    def _result(self, model: Model, record: _Record) -> Result:
        netlist = replace(model.netlist, record=record.settings)
        settings = netlist.run
        if self.max_steps is not None:
            settings = settings.model_copy(update={"max_steps": self.max_steps})
        peaks = bool(netlist.limits) or any(one.wants_extremes for one in record.figures)
        return run(netlist, settings, model.system, None, force=False, progress=None, profile=False,
                   begun=time.perf_counter(), peaks=peaks, told=False, kept=record.kept)  # fmt: skip

    def _records(self, model: Model, also: tuple[str, ...]) -> list[_Record]:
        """What the figures need, as often as they need it; a run for each.

        What is told from rows of all steps and what is told from those of the netlist come of two runs, for the rows of
        one are too few for the other, or too many to keep. Nothing else depends on the rows.
        """
        own, settings = model.netlist.record, model.netlist.run
        as_written = [one for one in self.figures if one.wants_record]
        others = [one for one in self.figures if not one.wants_record]
        on_curves = [one for one in others if one.wants_curves]
        two = bool(as_written and (on_curves or also))
        made = []
        if not as_written or two:
            between = also or model.netlist.limits or any(one.wants_curves or one.wants_extremes for one in others)
            every = None if between else settings.stop - settings.start
            made.append(_Record.of(others, [*also, *_signals_of(one for one in others if one.wants_rows)], every))
        if as_written:
            kept = _signals_of(as_written)
            if any(one.kind == "function" for one in as_written):
                kept += patterns_of(model.netlist)
            beside = [] if two else others
            kept += _signals_of(one for one in beside if one.wants_rows)
            made.append(_Record.of([*as_written, *beside], kept, own.every))
        return made


@dataclass(frozen=True)
class _Record:
    """What one run is to record: for which figures, and of which signals rows are kept."""

    figures: tuple[Figure, ...]
    kept: tuple[str, ...]
    settings: RecordSettings

    @classmethod
    def of(cls, figures: Iterable[Figure], kept: Iterable[str], every: float | None) -> _Record:
        """Rows of `kept`, `every` so often [s] or of all steps (None), and the extremes that the figures want."""
        figures, kept = tuple(figures), tuple(dict.fromkeys(kept))
        patterns = list(dict.fromkeys([*kept, *_signals_of(figures)]))
        return cls(figures, kept, RecordSettings.model_construct(signals=patterns, every=every, plots=[]))


def _signals_of(figures: Iterable[Figure]) -> list[str]:
    return [pattern for one in figures for pattern in one.signals]


def _refuse_no_map(called: str, values: object) -> None:
    """Raise ModelError for values that have no names; what is wrong with one of them is the row's to tell."""
    asked = Arguments(called)
    asked.map_of("values", values, '{"pad.normal_force": "12 N"}')
    asked.refuse()


def _is_number(value: Value) -> bool:
    from fairlead.quantities import QuantityError, quantity

    if not isinstance(value, str):
        return not isinstance(value, bool) and math.isfinite(value)
    try:
        quantity(value)
    except QuantityError:
        return False
    return True


def _in_a_line(error: FairleadError) -> str:
    return " ".join(str(error).split())


def _told(error: Exception) -> str:
    last = traceback.extract_tb(error.__traceback__)[-1]
    return f"{type(error).__name__}: {error} ({last.filename.rpartition('/')[2]}:{last.lineno})"
