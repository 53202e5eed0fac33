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
of the budget, or a fiftieth where it has elements, is studied over the part of its time that it reaches in that; over
half of it, where its references do not finish.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any

from fairlead.analysis.cost.boxed_runs import USUAL, BoxedRuns, Note
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
from fairlead.analysis.cost.references import FIRST_TIGHT, References
from fairlead.analysis.cost.study import Reference, Row, Study
from fairlead.analysis.cost.timed_run import Load
from fairlead.arguments import Arguments
from fairlead.native import spent_compiling

TIGHTER = 1e-2  # accuracy of references over the smallest of the ladder
TIGHTEST = 1e-9
PROBE, PROBE_OF_ELEMENTS = 0.04, 0.02  # share of the budget in which a scene must finish, or it is studied over less
KEPT = 0.97  # of the budget is for runs, the rest for reading, the table and the figure
CLOSING = 1.5  # times what reading the scene took: what these and the start take on a machine that has other work
FIRST = 2  # lines of the scene as it is, its own accuracy and the loosest, come before all columns
HALVINGS = 2  # how often less time is studied, to half of it or to about what the first tight run REACHED
REACHED = 0.8  # of that


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
    begun, compiled = time.perf_counter(), spent_compiling()
    ladder = checked(ladder or Ladder())
    model = load({})
    names, units, all_names = outputs(model, signals)
    loaded = time.perf_counter() - (spent_compiling() - compiled)
    end = begun + seconds - max((1 - KEPT) * seconds, CLOSING * (loaded - begun))
    span = (model.netlist.run.start, model.netlist.run.stop)
    tight = max(TIGHTEST, TIGHTER * min(ladder.accuracies))
    runs = BoxedRuns(load, model.netlist.digest, names, span, seconds, tight, kept or KeptRuns(None),
                     tuple(libraries), full, note or (lambda _: None), end=end, compiled=compiled)  # fmt: skip
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
        mine = [rung for rung in lines if rung.engine == first]
        self._climb(own, self.made.reference, mine[:FIRST])
        self._exact(own)
        if not own.exact:
            for equations in [one for one in others if one.axis == "creep"][-1:]:
                self._begin(equations)
        self.meshes.measure(own)
        for equations in others:
            self._begin(equations)
        self._climb(own, self.made.reference, mine)
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
        for attempt in range(HALVINGS + 1):
            first = attempt < HALVINGS and not self.runs.full
            found = self.references.of_scene(own, FIRST_TIGHT * self.runs.budget if first else math.inf)
            if found is not None or not first or self.runs.left() < self.runs.budget / 2:
                return found
            self.references.remarks.pop()  # why there is none
            start, stop = self.runs.span
            reached = REACHED * (self.references.reached - start)
            self._shorten(start + min((stop - start) / 2, reached if reached > 0 else math.inf))
        return None

    def _shorten(self, stop: float) -> None:
        """Study the time up to about there only."""
        start, before = self.runs.span
        self.runs.span = self.made.span = (start, min(before, start + float(f"{stop - start:.1g}")))
        self.made.whole = self.runs.whole = False

    def _choose_span(self) -> None:
        """Shorten the time that is studied when the scene as it is takes too long."""
        self.runs.note("the scene as it is")
        if self.runs.full:
            return
        share = PROBE_OF_ELEMENTS if mesh_settings(self.model) else PROBE
        probe = self.runs.run({"run.engine": USUAL}, share * self.runs.budget)
        start, stop = self.runs.span
        self.runs.usual = probe.cpu if probe is not None else 0.0
        if probe is None or probe.status != "budget" or probe.reached <= start:
            return
        self._shorten(min(start + 0.9 * (probe.reached - start), stop))

    def _climb(self, equations: Equations, reference: Reference | None, lines: Sequence[Rung] | None = None) -> None:
        """All lines of one set of equations; an engine that was too slow is not asked to be more exact."""
        before = [row for row in self.made.rows if row.rung.equations == equations]
        slow = {row.rung.engine for row in before if row.timed.status == "budget"}
        for rung in rungs(equations, self.ladder, self.model) if lines is None else lines:
            if any(row.rung == rung for row in self.made.rows):
                continue
            self.runs.note(rung.label)
            timed = None if rung.engine in slow else self.runs.run(rung.settings, self.runs.patience(rung.engine))
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
