"""A netlist on its way to results: the pipeline, in order; the table of contents of fairlead.

netlist      load(path)             Netlist      validated, every value knows its line
component    instantiate(netlist)   Assembly     component instances, parameters in SI
flatten      flatten(assembly)      FlatModel    nodes, kinematic groups, links
system       compile(flat)          System       index arrays, kernels, patterns
integrate    integrate(system)      Outcome      steps, switches, counters
results      run(...)               Result       a directory, written as the run goes

Each stage is made when it is first asked for, and kept.
"""

from __future__ import annotations

import enum
import functools
import os
import pathlib
import time
import warnings
from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Any, TypeVar, Unpack

from fairlead.arguments import Arguments, keywords_told, told_of
from fairlead.brief import in_a_line
from fairlead.errors import (
    Fault,
    Location,
    ModelError,
    RunError,
    RunInterrupted,
    RunWarning,
    UsageError,
    no_attribute,
    shown,
)
from fairlead.found import all_beside, in_order, of_start_and_border, with_origin

if TYPE_CHECKING:
    from fairlead.component.assembly import Assembly
    from fairlead.flatten.flat_model import FlatModel
    from fairlead.netlist.includes import Sources
    from fairlead.netlist.keywords import RunKeywords
    from fairlead.netlist.netlist import Netlist
    from fairlead.netlist.settings import RunSettings
    from fairlead.outside import Stepping
    from fairlead.pacing import Pacer
    from fairlead.result import Result
    from fairlead.statics import StaticsOfLines
    from fairlead.system.compiled.system import System

STAGES = ("netlist", "component", "flatten", "system")
DRAWINGS = ("mermaid", "dot", "svg")
LONGEST_NAME = 60
GIVEN = Location("set")
"""The argument, in messages about values that were given by it."""
Progress = Callable[[float, float, Any], None]
S = TypeVar("S")


class Place(enum.Enum):
    """Where results go when nobody says."""

    RESULTS = "results/NAME"


CALLED = {"simulate": "run()", "solve": "run()", "parameters": "netlist.parameters", "set": "with_values(...)",
          "replace": "with_values(...)", "components": "netlist.components", "step": "start()"}  # fmt: skip
"""What others call what a Model has."""


class Model:
    """A netlist and the stages it passes through; each stage is made when first asked for.

    A model pickles: what goes along is the netlist with its values and the paths of the libraries. Stages are made
    again where it arrives, and tables in files read again.
    """

    def __init__(
        self, sources: Sources, overrides: Mapping[str, str] | None = None, libraries: tuple[str, ...] = (), *,
        allow_fmu: bool = False,
    ) -> None:  # fmt: skip
        """Work out the netlist of `sources`; nothing is instantiated yet. `load` reads them."""
        from fairlead.netlist.includes import Sources
        from fairlead.netlist.load import worked_out

        if not isinstance(sources, Sources):
            said = f'"{os.fspath(sources)}"' if isinstance(sources, str | os.PathLike) else "PATH"
            what = f"Model: sources = {shown(sources)} is no netlist that was read."
            raise UsageError(f"{what} Write fairlead.load({said}), which gives a Model.")
        overrides = overrides or {}
        self.libraries, self.allow_fmu = libraries, allow_fmu
        self.rebuilt = ""
        """Of a model made by `with_values`: why it shares no structure with the one it comes from, if it does not."""
        self._sources, self._overrides = sources, overrides
        netlist, self._faults = worked_out(sources, overrides)
        if netlist is None:
            raise ModelError(self._faults)
        self.netlist: Netlist = _shown_in_a_line(replace(netlist, foreign_code=allow_fmu))

    if not TYPE_CHECKING:  # a type checker would take it for leave to ask for anything

        def __getattr__(self, name: str) -> Any:
            """What is not there is told with what was meant. Raises AttributeError."""
            if name.startswith("_") or hasattr(type(self), name):
                return object.__getattribute__(self, name)
            raise no_attribute(self, name, CALLED)

        __iter__ = None  # or Python would take __getitem__ for it

        def __getitem__(self, name: object) -> Any:
            """A model is not asked by name; what is meant is said. Raises TypeError."""
            said = f'"{name}"' if isinstance(name, str) else shown(repr(name))
            ways = f"A part is model.netlist.components[{said}], a signal model.run()[{said}]"
            raise TypeError(f"a Model has no [{said}]. {ways}, a new value model.with_values({{...}}).")

    @functools.cached_property
    def assembly(self) -> Assembly:
        """Component instances. Raises ModelError with everything that `check` would tell."""
        from fairlead.component.instantiate import instantiate
        from fairlead.component.registry import known_types
        from fairlead.flatten.collection import collected_later

        assembly, faults = collected_later(instantiate)(self.netlist, known_types(self.libraries))
        if faults or self._faults:
            self.check()
        return _shown_in_a_line(assembly)

    @functools.cached_property
    def flattened(self) -> FlatModel:
        """Nodes, groups and links as they are before lines are cut for `profile: statics`."""
        from fairlead.flatten.flatten import flatten

        return flatten(self.assembly)

    @functools.cached_property
    def flat(self) -> FlatModel:
        """Nodes, groups and links. Raises ModelError with everything that `check` would tell."""
        if not self.flattened.assembly.routings:
            return self.flattened
        from fairlead.analysis.statics.start_profile import laid_under_statics

        try:
            return laid_under_statics(self.flattened)
        except ModelError:
            self.check()
            raise

    @functools.cached_property
    def system(self) -> System:
        """The compiled model."""
        from fairlead.flatten.collection import collected_later
        from fairlead.system.compile import compile

        return _shown_in_a_line(collected_later(lambda: compile(self.flat))())  # once for the stages before it too

    def check(self) -> list[Fault]:
        """Go through all stages without running; returns warnings, raises ModelError for mistakes.

        A stage that finds mistakes is passed on to the next as far as it goes, so that one call tells as many
        as can be told.
        """
        from fairlead.analysis.record.counts import unreasonable
        from fairlead.analysis.record.names import unknown_signals
        from fairlead.analysis.remarks.remarks import remarks
        from fairlead.analysis.statics.start_profile import laid_under_statics
        from fairlead.component.instantiate import instantiate
        from fairlead.component.registry import known_types
        from fairlead.engine import engine_remarks
        from fairlead.errors import without_echoes
        from fairlead.flatten.flatten import survey as flatten
        from fairlead.outer import interface_faults
        from fairlead.system.compile import untraceable

        faults = list(self._faults)
        assembly, found = instantiate(self.netlist, known_types(self.libraries), whole=not self._faults)
        faults += without_echoes(found, faults)
        if self._faults:  # connections may be missing, so that open ports are only echoes
            assembly.excuse(assembly.instances)
        sound = not found
        flat, found = flatten(assembly)
        faults += without_echoes(found, faults)
        sound = sound and not found
        faults += unknown_signals(assembly) + unreasonable(self.netlist, self.netlist.run, flat)
        if faults:
            faults += without_echoes(untraceable(flat), faults)
            if sound and all_beside(self._faults, self.netlist.texts):
                faults += without_echoes(of_start_and_border(self.netlist, assembly, flat), faults)
        else:
            self.assembly, self.flattened = _shown_in_a_line(assembly), flat
            try:
                self.flat = laid_under_statics(flat)
                faults += interface_faults(self.netlist, assembly.entries, self.system)
            except ModelError as error:
                faults += error.faults
        if faults:
            raise ModelError(with_origin(in_order(faults), self._overrides))
        return [*remarks(self.flat), *engine_remarks(self.netlist.run, self.system)]

    def describe(self, stage: str = "flatten") -> str:
        """What the model has become after a stage: netlist, component, flatten or system. Raises ModelError."""
        _one_of("Model.describe", "stage", stage, STAGES)
        return str({"netlist": lambda: self.netlist, "component": lambda: self.assembly,
                    "flatten": lambda: self.flat, "system": lambda: self.system}[stage]())  # fmt: skip

    def graph(self, format: str = "mermaid") -> str:
        """The wiring as text of `format` mermaid, dot or svg. Raises ModelError; UsageError for another format."""
        _one_of("Model.graph", "format", format, DRAWINGS)
        from fairlead.flatten.drawing import draw

        return draw(self.flat, format)

    def statics(self, speed: float | str | None = None) -> StaticsOfLines:
        """Every line on a route, solved for steady motion and for rest; nothing is compiled.

        `speed` (`"0.5 m/s"`, or a number of m/s) is taken both ways instead of what the references say. Raises
        UsageError without such a line.
        """
        from fairlead.analysis.statics.solution import statics
        from fairlead.statics import Statics, StaticsOfLines

        asked = Arguments("Model.statics")
        given = None if speed is None else asked.above_zero("speed", speed, "m/s")
        asked.refuse()
        found = statics(self.flat, given)
        if not found:
            what = f"{self.netlist.name} has no line on a route, so there is nothing to solve."
            raise UsageError(f"{what}\n    A line is laid on a route by joining their paths; see docs/routes.md.")
        return StaticsOfLines(map(Statics.of, found))

    def run(self, out: str | os.PathLike[str] | Place | None = Place.RESULTS, force: bool = False,
            progress: Progress | None = None, profile: bool = False, check: bool = True,
            **settings: Unpack[RunKeywords]) -> Result:  # fmt: skip
        """Simulate; results go to the directory `out` (results/NAME when it is not given) as the run goes.

        `out=None` touches no disk: the result stays in memory. `settings` replace those of the netlist's `run`
        block (`stop="5 s"`, `accuracy=1e-6`, ...): quantities, or numbers in SI. The model is compiled once, whatever
        they are and however often it is run. `force` replaces results that are in the directory already; `progress`
        is called as the run goes with the share of it that is done, the time reached [s] and None; `profile` adds to
        `result.run` where the time went.

        A run that fails or is cut short raises RunError, whose `result` holds what was computed; with `check=False`
        that result is returned, and `result.ok`, `.status` and `.run["sentence"]` tell how it ended. Remarks on the
        run (`result.remarks`) are given to `warnings` as RunWarning. Raises ModelError for settings that a netlist
        could not have, and for those that the model cannot be run with; UsageError where the results may not go.
        """
        return self._run(out, force, progress, profile, check, settings, "Model.run")

    def _run(
        self, out: str | os.PathLike[str] | Place | None, force: bool, progress: Progress | None, profile: bool,
        check: bool, settings: RunKeywords, called: str, pacer: Pacer | None = None,
    ) -> Result:  # fmt: skip
        """`run`, whichever of the two was called; a `pacer` keeps time with a clock."""
        from fairlead.netlist.keywords import with_keywords
        from fairlead.running import run

        begun = time.perf_counter()
        asked = Arguments(called)
        asked.folder("out", "results" if isinstance(out, Place) else out, none="None to keep the result in memory")
        for name, value in (("force", force), ("profile", profile), ("check", check)):
            asked.yes_or_no(name, value)
        asked.function("progress", progress, ("the fraction done", "the time reached [s]", "None"))
        try:
            netlist = with_keywords(self.netlist.run, settings, self.netlist.parameters, called)
        except ModelError as error:
            raise ModelError([*asked.faults, *error.faults]) from None
        asked.refuse()
        system = self._beginning_with(netlist).system
        path = pathlib.Path("results") / self.netlist.name if isinstance(out, Place) else out
        result = run(
            self.netlist, netlist, system, None if path is None else pathlib.Path(path),
            force=force, progress=progress, profile=profile, begun=begun, pacer=pacer,
        )  # fmt: skip
        for remark in result.remarks:
            warnings.warn(remark, RunWarning, stacklevel=3)
        if check and not result.ok:
            raise (RunInterrupted if result.status == "interrupted" else RunError)(result)
        return result

    def start(
        self, inputs: Iterable[str] = (), *, tunable: Iterable[str] = (), **settings: Unpack[RunKeywords]
    ) -> Stepping:
        """A run that is stepped from outside: `set`, `advance`, `get`, `save`, `restore` (docs/coupling.md).

        What can be set: the inputs of the netlist's `interface` block, and signal inputs named by `inputs`, which are
        connected to nothing; and parameters that the block has as `tunable` or that are named so here, such as
        `pad.normal_force`. `settings` are those of `run`. Raises ModelError and UsageError as `run` does.
        """
        from fairlead.netlist.keywords import with_keywords
        from fairlead.outside import Stepping
        from fairlead.tuning import Tunable

        asked = Arguments("Model.start")
        asked.texts("inputs", inputs, '"valve.command"', "name")
        asked.texts("tunable", tunable, '"pad.normal_force"', "name")
        asked.refuse()
        chosen = with_keywords(self.netlist.run, settings, self.netlist.parameters, "Model.start")
        model = self._beginning_with(chosen)
        model._refuse_names_that_nothing_has()
        return Stepping(self.netlist, chosen, model.system, inputs, tunable=Tunable.of(model, tunable))

    def _refuse_names_that_nothing_has(self) -> None:
        """Raise ModelError for mistakes in blocks that a stepped run does not need: `check` refuses them."""
        from fairlead.analysis.record.names import unknown_signals
        from fairlead.outer import interface_faults

        faults = unknown_signals(self.assembly) + interface_faults(self.netlist, self.assembly.entries, self.system)
        if faults:
            raise ModelError(in_order(faults))

    def _beginning_with(self, settings: RunSettings) -> Model:
        """The model for a run that starts when these settings say: another one if a motion begins there."""
        from fairlead.flatten.flatten import begins_otherwise

        given = {"run.start": f"{settings.start!r} s", "run.stop": f"{settings.stop!r} s"}
        return self._renewed(given, self) if begins_otherwise(self.system.flat, settings.start) else self

    @keywords_told
    def with_values(self, values: Mapping[str, float | str] | None = None, /, **more: float | str) -> Model:
        """A model with other `values` of settings (`{"pad.normal_force": "20 N"}`), `more` of parameters (`mu=0.6`).

        Numbers are in SI, texts are as `load(path, set=...)` takes them, and the model is the one that `load` would
        give. It shares structure and kernels with this one, which stays as it is; if the structure depends on the
        values, all is made anew, and `rebuilt` says why. This model is compiled if it is not yet. Raises ModelError
        for names and values as `load` and `check` do.
        """
        asked = Arguments("Model.with_values")
        asked.values_by_name("values", values)
        asked.values_by_name("values", more)
        asked.nothing_twice("values", values if isinstance(values, Mapping) else (), more)
        asked.refuse()
        with told_of("Model.with_values", GIVEN.file):
            return self._renewed({**(values or {}), **more}, self)

    def beside(self, values: Mapping[str, float | str], near: Model | None = None) -> Model:
        """This model with other values, on what `near` has compiled; with None nothing is compiled.

        `near` is this model, or one made from it, whatever its values are. Raises ModelError as `with_values` does.
        """
        asked = Arguments("Model.beside")
        asked.values_by_name("values", values, none=False)
        asked.refuse()
        with told_of("Model.beside", GIVEN.file):
            return self._renewed(values, near)

    def _renewed(self, values: Mapping[str, float | str], near: Model | None) -> Model:
        """`beside`, with arguments that are sound."""
        from fairlead.netlist.settings_file import as_settings
        from fairlead.renewal import renew

        given = {**self._overrides, **as_settings(values, GIVEN)}
        new = Model(self._sources, given, self.libraries, allow_fmu=self.allow_fmu)
        if new._faults:
            new.check()
        if near is not None:
            renew(near, new)  # type: ignore[arg-type]  # mypy takes cached properties for read-only
        else:
            new.assembly  # noqa: B018 - a value that does not fit is told here
        return new

    @property
    def sources(self) -> Sources:
        """The files that the netlist was read from, as they were."""
        return self._sources

    @property
    def overrides(self) -> Mapping[str, str]:
        """Values that were given from outside, by name, as texts."""
        return self._overrides

    def __getstate__(self) -> dict[str, Any]:
        """What a pickle holds: no stage, and of the libraries where they lie."""
        kept = ("netlist", "allow_fmu", "rebuilt", "_sources", "_overrides", "_faults")
        return {"libraries": tuple(map(os.path.abspath, self.libraries)), **{name: vars(self)[name] for name in kept}}

    def __repr__(self) -> str:
        """Name and size of the netlist."""
        return f"<Model {self.netlist.name[:LONGEST_NAME]}: {len(self.netlist.components)} components>"

    def _repr_html_(self) -> str:
        from fairlead.model_page import as_html

        return as_html(self.netlist)


def _shown_in_a_line(stage: S) -> S:
    """The same stage; its class shows itself in a line from now on, since its fields fill many screens."""
    type(stage).__repr__ = in_a_line  # type: ignore[method-assign]
    return stage


def _one_of(call: str, name: str, value: str, allowed: Collection[str]) -> None:
    """Raise ModelError for a word that is not among those allowed."""
    asked = Arguments(call)
    asked.one_of(name, value, allowed)
    asked.refuse()
