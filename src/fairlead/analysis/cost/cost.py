"""What accuracy costs in time: a ladder of runs against references that the study makes itself.

    study = cost(load, Ladder(), budget=60.0)
    study.rows[0].numerical, study.rows[0].timed.cpu

Three errors that are never summed, each the rms over time of the output that is known worst, relative to its range
(`deviation.py`; every output is in the row's lists):

    numerical       the run against tight runs of the same equations (`references.py`)
    modelling       tight runs of the same elements, against contacts that hold exactly
    discretisation  tight runs of the same treatment, against the finest elements (`mesh_errors.py`)

The spread of the references is the floor: no error below it can be told. Runs that do not come closer when they are
made tighter are sensitive to everything; then means and standard deviations over time are compared instead.

All columns come first, each from two refinements at least: references at two accuracies or by two engines, a creep and
a tenth of it, elements of twice and of half the size; then the other lines. A scene that takes more than a twenty-fifth
of the budget, or an eightieth where it has elements, is studied over the part of its time that it reaches in that; over
half of it, where its references do not finish.
"""

from __future__ import annotations

import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from fairlead.analysis.cost.boxed_runs import BoxedRuns, Note
from fairlead.analysis.cost.compared_outputs import outputs
from fairlead.analysis.cost.deviation import switching
from fairlead.analysis.cost.kept_runs import KeptRuns
from fairlead.analysis.cost.ladder import (
    Equations,
    Ladder,
    Rung,
    checked,
    exact_equations,
    other_equations,
    own_equations,
    rungs,
)
from fairlead.analysis.cost.mesh_errors import MeshErrors
from fairlead.analysis.cost.meshes import mesh_settings
from fairlead.analysis.cost.references import References
from fairlead.analysis.cost.study import Reference, Row, Study
from fairlead.analysis.cost.timed_run import Load
from fairlead.arguments import Arguments

TIGHTER = 1e-2  # accuracy of references over the smallest of the ladder
TIGHTEST = 1e-9
PROBE, PROBE_OF_ELEMENTS = 0.04, 0.0125  # share of the budget in which a scene must finish, or it is studied over less
KEPT = 0.97  # of the budget is for runs, the rest for reading, the table and the figure
HALVINGS = 2  # of the time that is studied, while no reference finishes


def cost(
    load: Load, ladder: Ladder | None = None, *, budget: float | str = 60.0, signals: Sequence[str] = ("*",),
    kept: KeptRuns | None = None, libraries: Iterable[str] = (), full: bool = False, note: Note | None = None,
) -> Study:  # fmt: skip
    """Study a scene within `budget` (`"2 min"`, or seconds).

    Raises ModelError, UsageError when the scene, the ladder or the budget is wrong.
    `signals` are patterns of the recorded outputs to compare; `kept` holds runs made before; with `full` the span is
    never shortened; `note` is told what is being done.
    """
    asked = Arguments("cost")
    seconds = asked.above_zero("budget", budget, "s")
    asked.refuse()
    end = time.perf_counter() + KEPT * seconds
    ladder = checked(ladder or Ladder())
    model = load({})
    names, units, all_names = outputs(model, signals)
    span = (model.netlist.run.start, model.netlist.run.stop)
    tight = max(TIGHTEST, TIGHTER * min(ladder.accuracies))
    runs = BoxedRuns(load, model.netlist.digest, names, span, seconds, tight, kept or KeptRuns(None),
                     tuple(libraries), full, note or (lambda _: None), end=end)  # fmt: skip
    made = Study(model.netlist.name, span, True, names, units)
    references = References(runs, units, made.remarks)
    meshes = MeshErrors(made, runs, references, model, ladder, all_names)
    return _Climb(made, runs, references, meshes, model, ladder).study()


@dataclass
class _Climb:
    """One study while it is being made: the order of things, what matters most first."""

    made: Study
    runs: BoxedRuns
    references: References
    meshes: MeshErrors
    model: Any
    ladder: Ladder
    exact: Reference | None = field(default=None)

    def study(self) -> Study:
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
        self.made.reference = self._reference(own)
        lines = list(rungs(own, self.ladder, self.model))
        first = lines[0].engine if lines else ""
        self._climb(own, self.made.reference, [rung for rung in lines if rung.engine == first])
        self._exact(own)
        if not own.exact:
            for equations in [one for one in others if one.axis == "creep"][-1:]:
                self._begin(equations)
        self.meshes.measure(own)
        for equations in others:
            self._begin(equations)
        self._climb(own, self.made.reference, [rung for rung in lines if rung.engine not in (first, "ida")])
        for equations in others:
            self._climb(equations, self._reference_of(equations))
            if not equations.exact:
                self._model_errors(equations)
        self._climb(own, self.made.reference, [rung for rung in lines if rung.engine == "ida" != first])
        self._model_errors(own)

    def _reference_of(self, equations: Equations) -> Reference | None:
        return self.exact if equations.exact else self.references.of_variant(equations, self.made.reference)

    def _begin(self, equations: Equations) -> None:
        """The first line of other equations, with its errors."""
        self._climb(equations, self._reference_of(equations), list(rungs(equations, self.ladder, self.model))[:1])
        if not equations.exact:
            self._model_errors(equations)

    def _reference(self, own: Equations) -> Reference | None:
        """That of the scene; over less time where it takes too long."""
        found = self.references.of_scene(own)
        for _ in range(HALVINGS):
            left = self.runs.end - time.perf_counter()
            if found is not None or self.runs.full or left < self.runs.budget / 2:
                break
            self.references.remarks.pop()  # why there is none
            start, stop = self.runs.span
            self._shorten(start + (stop - start) / 2)
            found = self.references.of_scene(own)
        return found

    def _shorten(self, stop: float) -> None:
        """Study the time up to there only."""
        self.runs.span = self.made.span = (self.runs.span[0], stop)
        self.made.whole = False

    def _choose_span(self) -> None:
        """Shorten the time that is studied when the scene as it is takes too long."""
        self.runs.note("the scene as it is")
        if self.runs.full:
            return
        share = PROBE_OF_ELEMENTS if mesh_settings(self.model) else PROBE
        probe = self.runs.run({"run.engine": "rodas"}, share * self.runs.budget)
        start, stop = self.runs.span
        self.runs.usual = probe.wall if probe is not None else 0.0
        if probe is None or probe.status != "budget" or probe.reached <= start:
            return
        reached = float(f"{0.9 * (probe.reached - start):.1g}")
        self._shorten(min(start + reached, stop))

    def _climb(self, equations: Equations, reference: Reference | None, lines: Sequence[Rung] | None = None) -> None:
        """All lines of one set of equations; an engine that was too slow is not asked to be more exact."""
        slow: set[str] = set()
        for rung in rungs(equations, self.ladder, self.model) if lines is None else lines:
            if any(row.rung == rung for row in self.made.rows):
                continue
            self.runs.note(rung.label)
            timed = None if rung.engine in slow else self.runs.run(rung.settings, self.runs.patience())
            if timed is None:
                if rung.engine not in slow and rung.label not in self.made.left_out:
                    self.made.left_out.append(rung.label)
                continue
            row = Row(rung, timed)
            if timed.finished and reference is not None:
                row.numerical = self.references.errors(timed, reference.timed)
                row.switching = switching(timed.events, reference.timed.events)
            elif timed.status == "budget":
                slow.add(rung.engine)
            if equations.exact:
                row.modelling = []
            self.made.rows.append(row)

    def _exact(self, own: Equations) -> None:
        """Tight runs in which contacts hold exactly, and the modelling error of the scene against them."""
        if own.exact or self.made.reference is None:
            self.exact = self.made.reference
        else:
            self.exact = self.references.of_variant(exact_equations(self.model), self.made.reference)
        self._model_errors(own)

    def _model_errors(self, equations: Equations) -> None:
        mine = [row for row in self.made.rows if row.rung.equations == equations and row.modelling is None]
        if self.exact is None or not mine:
            return
        tight = self.made.reference
        if equations.axis != "scene":
            tight = self.references.of_variant(equations, self.made.reference)
        if tight is not None:
            errors = self.references.errors(tight.timed, self.exact.timed)
            for row in mine:
                row.modelling = errors
