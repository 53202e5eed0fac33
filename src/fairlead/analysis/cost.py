"""What accuracy costs in time: a ladder of runs against references that the study makes itself.

    study = cost(load, Ladder(), budget=60.0)
    study.rows[0].numerical, study.rows[0].timed.cpu

Three errors that are never summed, each the rms over time of the output that is known worst, relative to its range
(`deviation.py`; every output is in the row's lists):

    numerical       the run against tight runs of the same equations
    modelling       tight runs of the same elements, against contacts that hold exactly
    discretisation  tight runs of the same treatment, against the finest elements

The reference of the scene are two runs by independent engines, or failing that methods, at tight accuracy. Their
spread is the floor: no error below it can be told. Runs that do not come closer when they are made tighter are
sensitive to everything; then means and standard deviations over time are compared instead.

A scene that takes more than a twenty-fifth of the budget is studied over the part of its time that it reaches in that.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fairlead.analysis.deviation import OutputError, Switching, output_errors, switching, worst
from fairlead.analysis.kept_runs import KeptRuns, key_of
from fairlead.analysis.ladder import (
    Equations,
    Ladder,
    Rung,
    checked,
    engines_here,
    exact_equations,
    other_equations,
    other_meshes,
    own_equations,
    rungs,
)
from fairlead.analysis.meshes import Mesh, correspondence
from fairlead.analysis.timed_run import Load, Timed, timed_run
from fairlead.errors import FairleadError
from fairlead.results.signal import family, matching

TIGHTER = 1e-2  # accuracy of references over the smallest of the ladder
TIGHTEST = 1e-9
PROBE = 0.04  # share of the budget in which a scene must finish, or else it is studied over less time
LONGEST = 0.2  # share of the budget that one run may take
SHORTEST = 0.2  # s; with less time left no run is begun
SLOWER = 8.0  # times the scene as it is: a run that takes longer is cut off and called slow
WORTH_WAITING = 1.0  # s; no run is called slow that takes less
BDF = 0.01  # share of the budget that the scene may take for ida to be tried as a reference: it is slow at switches
AGREE = 1e-3  # spread of two references that are one solution
CONVERGING = 0.5  # the spread of tight runs over that of less tight ones; with more they do not converge
MOST_MEMBERS = 16  # of a family of signals that are compared
Note = Callable[[str], None]


@dataclass(frozen=True)
class Reference:
    """Tight runs of one set of equations. `spread` is None when there is only one."""

    label: str
    timed: Timed
    spread: float | None = None
    spread_of: str = ""
    sensitive: bool = False

    @property
    def agrees(self) -> bool:
        """True when two independent runs came to the same solution."""
        return self.spread is not None and self.spread <= AGREE


@dataclass
class Row:
    """One line: a run, and its errors by output. A list is None where the error was not measured."""

    rung: Rung
    timed: Timed
    numerical: list[OutputError] | None = None
    modelling: list[OutputError] | None = None
    discretisation: list[OutputError] | None = None
    switching: Switching | None = None


@dataclass
class Study:
    """All that was measured. `left_out` names what the budget or Ctrl-C did not let begin."""

    name: str
    span: tuple[float, float]
    whole: bool  # the span is all of the scene's time
    outputs: list[str] = field(default_factory=list)
    units: list[str] = field(default_factory=list)
    reference: Reference | None = None
    rows: list[Row] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    interrupted: bool = False
    elements: list[OutputError] | None = None  # the discretisation error of the scene's own mesh

    @property
    def sensitive(self) -> bool:
        """True when tight runs do not converge, so that only statistics mean something."""
        return self.reference is not None and self.reference.sensitive

    @property
    def floor(self) -> float:
        """The relative error below which nothing can be told; infinite without two references."""
        if self.reference is None or self.reference.spread is None:
            return math.inf
        return self.reference.spread

    def size(self, errors: Sequence[OutputError] | None) -> float | None:
        """The error of the output known worst, as the study counts it; None when it was not measured."""
        if errors is None:
            return None
        found = worst(errors, statistical=self.sensitive)
        return 0.0 if found is None else (found.statistical if self.sensitive else found.relative)


def cost(
    load: Load, ladder: Ladder | None = None, *, budget: float = 60.0, signals: Sequence[str] = ("*",),
    kept: KeptRuns | None = None, libraries: Iterable[str] = (), full: bool = False, note: Note | None = None,
) -> Study:  # fmt: skip
    """Study a scene within `budget` seconds. Raises ModelError, UsageError when the scene or the ladder is wrong.

    `signals` are patterns of the recorded outputs to compare; `kept` holds runs made before; with `full` the span is
    never shortened; `note` is told what is being done.
    """
    maker = _Maker(load, checked(ladder or Ladder()), budget, signals, kept or KeptRuns(None), tuple(libraries), full,
                   note or (lambda _: None))  # fmt: skip
    return maker.study()


class _Maker:
    """One study while it is being made."""

    def __init__(self, load: Load, ladder: Ladder, budget: float, signals: Sequence[str], kept: KeptRuns,
                 libraries: tuple[str, ...], full: bool, note: Note) -> None:  # fmt: skip
        self.load, self.ladder, self.budget, self.kept = load, ladder, budget, kept
        self.libraries, self.full, self.note = libraries, full, note
        self.model = load({})
        self.warm: set[tuple[str, str]] = set()
        self.exact: Reference | None = None
        self.usual = 0.0  # s that the scene as it is takes
        self.end = math.inf
        self.names, self.units, self.all_names = outputs(self.model, signals)
        run = self.model.netlist.run
        self.made = Study(self.model.netlist.name, (run.start, run.stop), True, self.names, self.units)
        self.tight = max(TIGHTEST, TIGHTER * min(ladder.accuracies))

    def study(self) -> Study:
        self.end = time.perf_counter() + self.budget
        try:
            self._study()
        except KeyboardInterrupt:
            self.made.interrupted = True
        for row in self.made.rows:
            if row.rung.equations.axis != "mesh":
                row.discretisation = self.made.elements
        return self.made

    def _study(self) -> None:
        own, others = own_equations(self.model), other_equations(self.model, self.ladder)
        self._choose_span()
        self.made.reference = self._two_references(own)
        lines = list(rungs(own, self.ladder, self.model))
        self._climb(own, self.made.reference, [rung for rung in lines if rung.engine != "ida"])
        self._exact(own)
        for equations in others:
            if equations.exact:
                self._climb(equations, self.exact)
        self._meshes(own)
        for equations in others:
            if not equations.exact:
                self._climb(equations, self._reference(equations))
                self._model_errors(equations)
        self._climb(own, self.made.reference, [rung for rung in lines if rung.engine == "ida"])
        self._model_errors(own)

    # --- runs

    def _run(self, settings: Mapping[str, str], cap: float, names: Sequence[str] | None = None,
             members: Mapping[str, Sequence[str]] | None = None) -> Timed | None:  # fmt: skip
        """A run, kept or new; None when there is no time left to begin it."""
        cap = min(cap, LONGEST * self.budget) if not self.full else cap
        key = self._key(settings, names, members)
        found = self.kept.get(key, cap)
        if found is not None:
            return found
        self._warm_up(settings)
        left = round(self.end - time.perf_counter(), 3)
        if left < SHORTEST:
            return None
        timed = timed_run(self.load, settings, names or self.names, self.made.span, min(cap, left), members)
        if timed.status == "budget" and left < cap:
            return None  # not slow, but begun too late
        self.kept.put(key, timed)
        return timed

    def _key(self, settings: Mapping[str, str], names: Sequence[str] | None, members: object) -> str:
        parts = (sorted(settings.items()), names or self.names, members, self.made.span)
        return key_of(self.model.netlist.digest, parts, self.libraries)

    def _warm_up(self, settings: Mapping[str, str]) -> None:
        """Have an engine loaded, or compiled once for this machine, before its time is taken; outside the budget."""
        kind = (settings.get("run.engine", "rodas"), settings.get("run.method", ""))
        if kind in self.warm:
            return
        self.warm.add(kind)
        begun = time.perf_counter()
        self.note(f"loading {kind[0]}")
        start = self.made.span[0]
        timed_run(self.load, {**settings, "run.max_steps": "1"}, [], (start, start + 1e-3), 600.0)
        self.end += time.perf_counter() - begun

    def _tight(self, equations: Equations, engine: str, **more: Any) -> Timed | None:
        settings = {**equations.settings, "run.engine": engine, "run.accuracy": f"{self.tight:g}"}
        if engine == "rodas3p":
            settings |= {"run.engine": "rodas", "run.method": "rodas3p"}
        self.note(f"reference {equations.label} with {engine}".replace("  ", " "))
        return self._run(settings, math.inf, **more)

    # --- what the study is made of

    def _choose_span(self) -> None:
        """Shorten the time that is studied when the scene as it is takes too long."""
        self.note("the scene as it is")
        if self.full:
            return
        probe = self._run({"run.engine": "rodas"}, PROBE * self.budget)
        start, stop = self.made.span
        self.usual = probe.wall if probe is not None else 0.0
        if probe is None or probe.status != "budget" or probe.reached <= start:
            return
        reached = float(f"{0.9 * (probe.reached - start):.1g}")
        self.made.span, self.made.whole = (start, min(start + reached, stop)), False

    def _two_references(self, equations: Equations) -> Reference | None:
        """Tight runs by rodas and by the first of the others that manages."""
        first = self._tight(equations, "rodas")
        if first is None or not first.finished:
            self._complain("rodas", first)
            return None
        usable = [e for e in reversed(engines_here()) if e == "stepping" or (e == "ida" and self._brief())]
        for engine in [*usable, "rodas3p"]:
            second = self._tight(equations, engine)
            if second is not None and second.finished:
                return self._compared(equations, first, engine, second)
        self.made.remarks.append("Only one tight run finished in its share of the budget: the floor is not known.")
        return Reference(f"rodas at accuracy {self.tight:g}", first)

    def _brief(self) -> bool:
        return self.full or self.usual < BDF * self.budget

    def _compared(self, equations: Equations, first: Timed, engine: str, second: Timed) -> Reference:
        """The reference with its spread; whether runs converge is asked when the spread is wide."""
        label = f"rodas and {engine} at accuracy {self.tight:g}"
        apart = worst(output_errors(self.names, self.units, second.values, first.values))
        spread, name = (apart.relative, apart.name) if apart else (0.0, "")
        if spread <= AGREE:
            return Reference(label, first, spread, name)
        if not self._converges(equations, first, spread):
            errors = output_errors(self.names, self.units, second.values, first.values)
            statistical = worst(errors, statistical=True)
            spread = statistical.statistical if statistical else 0.0
            return Reference(label, first, spread, statistical.name if statistical else "", sensitive=True)
        return Reference(label, first, spread, name)

    def _converges(self, equations: Equations, first: Timed, spread: float) -> bool:
        """Whether less tight runs are farther apart than tight ones; of two tight ones of the same engine."""
        looser = {**equations.settings, "run.engine": "rodas", "run.accuracy": f"{min(1e2 * self.tight, 1e-2):g}"}
        tighter = {**looser, "run.accuracy": f"{min(1e1 * self.tight, 1e-2):g}"}
        runs = [self._run(settings, math.inf) for settings in (looser, tighter)]
        if any(one is None or not one.finished for one in runs):
            return True
        apart = [output_errors(self.names, self.units, one.values, first.values) for one in runs if one is not None]
        far, near = (found.relative if (found := worst(errors)) else 0.0 for errors in apart)
        return near <= AGREE or near < CONVERGING * far

    def _reference(self, equations: Equations) -> Reference | None:
        tight = self._tight(equations, "rodas")
        if tight is None or not tight.finished:
            self._complain(equations.label, tight)
            return None
        spread = None if self.made.reference is None else self.made.reference.spread
        return Reference(f"rodas at accuracy {self.tight:g}", tight, spread, sensitive=self.made.sensitive)

    def _climb(self, equations: Equations, reference: Reference | None, lines: Sequence[Rung] | None = None) -> None:
        """All lines of one set of equations; an engine that was too slow is not asked to be more exact."""
        slow: set[str] = set()
        for rung in rungs(equations, self.ladder, self.model) if lines is None else lines:
            self.note(rung.label)
            timed = None if rung.engine in slow else self._run(rung.settings, self._patience())
            if timed is None:
                if rung.engine not in slow:
                    self.made.left_out.append(rung.label)
                continue
            row = Row(rung, timed)
            if timed.finished and reference is not None:
                row.numerical = output_errors(self.names, self.units, timed.values, reference.timed.values)
                row.switching = switching(timed.events, reference.timed.events)
            elif timed.status == "budget":
                slow.add(rung.engine)
            if equations.exact:
                row.modelling = []
            self.made.rows.append(row)

    def _patience(self) -> float:
        """Seconds that a line may take."""
        return math.inf if self.full else max(WORTH_WAITING, SLOWER * self.usual)

    def _exact(self, own: Equations) -> None:
        """Tight runs in which contacts hold exactly, and the modelling error of the scene against them."""
        if own.exact or self.made.reference is None:
            self.exact = self.made.reference
        else:
            self.exact = self._reference(exact_equations(self.model))
        self._model_errors(own)

    def _model_errors(self, equations: Equations) -> None:
        mine = [row for row in self.made.rows if row.rung.equations == equations and row.modelling is None]
        if self.exact is None or not mine:
            return
        tight = self.made.reference if equations.axis == "scene" else self._reference(equations)
        if tight is not None:
            errors = output_errors(self.names, self.units, tight.timed.values, self.exact.timed.values)
            for row in mine:
                row.modelling = errors

    def _meshes(self, own: Equations) -> None:
        """The discretisation error of the scene's elements, and lines of other meshes with theirs."""
        possible = {mesh: has for mesh in other_meshes(self.model, self.ladder) if (has := self._names_of(mesh))}
        found = list(possible)
        if not found or found[-1].finer <= 1:
            return
        finest, coarser = found[-1], [Mesh("", {}, 1.0), *found[:-1]]
        names: dict[str, list[str]] = {}
        kept: dict[str, list[str]] = {}
        for mesh in coarser:
            pairs = correspondence(possible.get(mesh, self.all_names), possible[finest])
            wanted = self.names if mesh.finer == 1.0 else _thinned(list(pairs))
            kept[mesh.label] = [name for name in wanted if name in pairs]
            names |= {f"{mesh.label}|{name}": pairs[name] for name in kept[mesh.label]}
        fine = Equations(finest.label, finest.settings, "mesh")
        reference = self._tight(fine, "rodas", names=list(names), members=names)
        if reference is None or not reference.finished:
            self._complain(finest.label, reference)
            return
        for mesh in coarser:
            self._mesh(mesh, own, kept[mesh.label], list(names), reference)

    def _names_of(self, mesh: Mesh) -> list[str]:
        """What a mesh records; nothing, and a remark, where a scene cannot be divided so."""
        try:
            return _recorded(self.load(mesh.settings))
        except FairleadError as error:
            self.made.remarks.append(f"{mesh.label} is left out. {str(error).splitlines()[0]}")
            return []

    def _mesh(self, mesh: Mesh, own: Equations, names: list[str], columns: list[str], reference: Timed) -> None:
        equations = own if mesh.finer == 1.0 else Equations(mesh.label, mesh.settings, "mesh", own.exact)
        units = [self._unit(name) for name in names]
        tight = self._tight(equations, "rodas", names=names)
        if tight is None or not tight.finished:
            self._complain(mesh.label or "the scene", tight)
            return
        places = [columns.index(f"{mesh.label}|{name}") for name in names]
        errors = output_errors(names, units, tight.values, reference.values[:, places])
        if mesh.finer != 1.0:
            self._climb_mesh(equations, names, units, tight)
        for row in self.made.rows:
            if row.rung.equations == equations:
                row.discretisation = errors
        if mesh.finer == 1.0:
            self.made.elements = errors

    def _climb_mesh(self, equations: Equations, names: list[str], units: list[str], tight: Timed) -> None:
        scene = [row for row in self.made.rows if row.rung.equations.axis == "scene"]
        for rung in list(rungs(equations, self.ladder, self.model))[:1]:
            self.note(rung.label)
            timed = self._run(rung.settings, self._patience(), names)
            if timed is None:
                self.made.left_out.append(rung.label)
                continue
            row = Row(rung, timed, modelling=scene[0].modelling if scene else None)
            if timed.finished:
                row.numerical = output_errors(names, units, timed.values, tight.values)
                row.switching = switching(timed.events, tight.events)
            self.made.rows.append(row)

    def _unit(self, name: str) -> str:
        known = dict(zip((family(one)[0] for one in self.names), self.units, strict=True))
        return known.get(family(name)[0], "")

    def _complain(self, what: str, timed: Timed | None) -> None:
        why = "the budget was used up before" if timed is None else timed.reason or timed.status
        self.made.remarks.append(f"No reference ({what}): {why}")


def outputs(model: Any, patterns: Sequence[str]) -> tuple[list[str], list[str], list[str]]:
    """The outputs to compare with their units, and all that the scene records."""
    from fairlead.errors import UsageError, did_you_mean, listing

    recorded = _recorded(model)
    chosen: dict[str, None] = {}
    for pattern in patterns:
        found = matching(recorded, pattern)
        if not found:
            near = did_you_mean(pattern, recorded) or f"Recorded are {listing(recorded)}."
            raise UsageError(f"--output {pattern}: the netlist records no such signal. {near}")
        chosen |= dict.fromkeys(found)
    names = _thinned(list(chosen))
    units = {signal.name: signal.unit for signal in model.system.signals}
    return names, [units[name] for name in names], recorded


def _recorded(model: Any) -> list[str]:
    """What the netlist records, without the creep, which is an error measure itself."""
    recorded = model.system.record(model.netlist.record.signals)
    return [signal.name for signal in recorded if not signal.name.endswith(".creep_rate")]


def _thinned(names: list[str]) -> list[str]:
    """The names, but of a family only some, equally far apart, the first and the last among them."""
    members: dict[str, list[str]] = {}
    for name in names:
        members.setdefault(family(name)[0], []).append(name)
    kept: set[str] = set()
    for group in members.values():
        places = np.unique(np.linspace(0, len(group) - 1, min(len(group), MOST_MEMBERS)).round().astype(int))
        kept |= {group[place] for place in places}
    return [name for name in names if name in kept]


def reasons(study: Study) -> Iterator[str]:
    """Why lines have no numbers."""
    for row in study.rows:
        if not row.timed.finished:
            yield f"{row.rung.label}: {row.timed.reason or row.timed.status}"

