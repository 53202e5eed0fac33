"""The discretisation errors of a study: every mesh against the finest, at a tenth of the scene's accuracy.

Elements of twice and of half the size (1.5 times, where a device is too short for twice) tell by two refinements
whether they approach one solution. Of order p, with a coarse mesh of q h and the finest of h/f, the errors against the
finest are

    e(q h)/e(h) = (q^p - f^-p)/(1 - f^-p)        and the whole error of h is e(h)/(1 - f^-p)
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from fairlead.analysis.cost.boxed_runs import BoxedRuns
from fairlead.analysis.cost.choice import percent
from fairlead.analysis.cost.compared_outputs import recorded_of_meshes, thinned
from fairlead.analysis.cost.deviation import OutputError, output_errors, switching
from fairlead.analysis.cost.ladder import Equations, Ladder, other_meshes, rungs
from fairlead.analysis.cost.meshes import Mesh, correspondence, meshes
from fairlead.analysis.cost.references import References
from fairlead.analysis.cost.study import Row, Study
from fairlead.analysis.cost.timed_run import Timed
from fairlead.errors import FairleadError
from fairlead.results.signal import family

EXACT = 0.1  # accuracy of these runs over that of the scene: what elements leave is far above either
LEAST_ORDER, MOST_ORDER = 0.25, 6.0  # with less, halving does not bring the solution closer
LESS_COARSE = 2 / 3  # of the fineness, where half of it cannot be


def order_of(ratio: float, coarse: float, fine: float) -> float | None:
    """The order p for which errors have that ratio (above), by halving an interval; None where they do not approach."""

    def of(order: float) -> float:
        return float((coarse**order - fine**-order) / (1 - fine**-order))

    low, high = LEAST_ORDER, MOST_ORDER
    if ratio < of(low):
        return None
    while high - low > 1e-6:
        middle = (low + high) / 2
        low, high = (middle, high) if of(middle) < ratio else (low, middle)
    return low


@dataclass
class MeshErrors:
    """Adds to a study the lines of other meshes, and to all lines what their elements leave."""

    study: Study
    runs: BoxedRuns
    references: References
    model: Any
    ladder: Ladder
    all_names: list[str]

    def measure(self, own: Equations) -> None:
        """The discretisation error of the scene's elements, and lines of other meshes with theirs."""
        possible = self._possible()
        found = list(possible)
        if not found or found[-1].finer <= 1:
            if other_meshes(self.model, self.ladder) and not self.runs.has_time_for({"": ""}):
                self.references.complain("other elements", None)
            return
        finest, coarser = found[-1], [Mesh("", {}, 1.0), *found[:-1]]
        kept, columns = self._shared(coarser, possible, finest)
        fine = Equations(finest.label, finest.settings, "mesh")
        reference = self._run(fine, list(columns), columns)
        if reference is None or not reference.finished:
            self.references.complain(finest.label, reference)
            return
        for mesh in coarser:
            places = [list(columns).index(f"{mesh.label}|{name}") for name in kept[mesh.label]]
            self._mesh(mesh, own, kept[mesh.label], reference.values[:, places])
        self._tell_order(found)

    def _run(self, equations: Equations, names: list[str], members: Any = None) -> Timed | None:
        """A run of a mesh that others are compared with, or compared itself."""
        accuracy = max(self.runs.tight, EXACT * self.model.netlist.run.accuracy)
        self.runs.note(f"mesh {equations.label}")
        settings = {**equations.settings, "run.engine": "rodas", "run.accuracy": f"{accuracy:g}"}
        return self.runs.run(settings, math.inf, names, members)

    def _possible(self) -> dict[Mesh, list[str]]:
        """Meshes with what they record; of coarser ones the next that the scene can have."""
        found = {mesh: has for mesh in other_meshes(self.model, self.ladder) if (has := self._names_of(mesh))}
        if self.ladder.finer is None and found and not any(mesh.finer < 1 for mesh in found):
            found = {mesh: has for mesh in meshes(self.model, [LESS_COARSE]) if (has := self._names_of(mesh))} | found
        return found

    def _tell_order(self, found: list[Mesh]) -> None:
        """Say whether two refinements approach one solution; `found` are the other meshes, the finest last.

        Compared is the output, or the mean over the elements of a line, of which the scene's elements leave most.
        """
        rows = {row.rung.equations.label: row.discretisation for row in self.study.rows}
        here, finest = self._by_family(self.study.elements), found[-1]
        coarse = next((mesh for mesh in found if mesh.finer < 1 and rows.get(mesh.label)), None)
        if coarse is None:
            return
        there = self._by_family(rows[coarse.label])
        worst = max((name for name in here if name in there), key=here.__getitem__, default="")
        if not worst or not here[worst]:
            return
        both = f"{percent(there[worst])} with {coarse.label}, {percent(here[worst])} with the scene's elements"
        order = order_of(there[worst] / here[worst], 1 / coarse.finer, finest.finer)
        rest = "no convergence: the error of the elements is unknown, take the larger error"
        if order is not None:
            whole = percent(here[worst] / (1 - finest.finer**-order))
            rest = f"order {order:.2g}, so the whole error of the scene's elements is {whole}"
        self.study.remarks.append(f"{worst}: {both}, both relative to {finest.label}; {rest}.")

    def _by_family(self, errors: Sequence[OutputError] | None) -> dict[str, float]:
        """The error of every output, of the elements of a line in the mean over them."""
        sizes: dict[str, list[float]] = {}
        for one in errors or ():
            sizes.setdefault(family(one.name)[0], []).append(self.study.size([one]) or 0.0)
        return {name: math.sqrt(sum(size**2 for size in each) / len(each)) for name, each in sizes.items()}

    def _shared(self, coarser: list[Mesh], possible: Mapping[Mesh, list[str]], finest: Mesh) -> Any:
        """Per mesh the outputs that the finest has too; and the columns "mesh|output" with what they are in it."""
        kept: dict[str, list[str]] = {}
        columns: dict[str, list[str]] = {}
        for mesh in coarser:
            pairs = correspondence(possible.get(mesh, self.all_names), possible[finest])
            wanted = self.runs.names if mesh.finer == 1.0 else thinned(list(pairs))
            kept[mesh.label] = [name for name in wanted if name in pairs]
            columns |= {f"{mesh.label}|{name}": pairs[name] for name in kept[mesh.label]}
        return kept, columns

    def _names_of(self, mesh: Mesh) -> list[str]:
        """What a mesh records; nothing, and a remark, where a scene cannot be divided so."""
        if not self.runs.has_time_for(mesh.settings):
            return []
        try:
            return recorded_of_meshes(self.runs.models(mesh.settings, self.runs.span)[0])
        except FairleadError as error:
            self.study.remarks.append(f"{mesh.label} is left out. {str(error).splitlines()[0]}")
            return []

    def _mesh(self, mesh: Mesh, own: Equations, names: list[str], fine: Any) -> None:
        equations = own if mesh.finer == 1.0 else Equations(mesh.label, mesh.settings, "mesh", own.exact)
        units = [self._unit(name) for name in names]
        tight = self._run(equations, names)
        if tight is None or not tight.finished:
            self.references.complain(mesh.label or "the scene", tight)
            return
        errors = output_errors(names, units, tight.values, fine)
        if mesh.finer != 1.0:
            self._line(equations, names, units, tight)
        for row in self.study.rows:
            if row.rung.equations == equations:
                row.discretisation = errors
        if mesh.finer == 1.0:
            self.study.elements = errors

    def _line(self, equations: Equations, names: list[str], units: list[str], tight: Timed) -> None:
        """One run of another mesh."""
        scene = [row for row in self.study.rows if row.rung.equations.axis == "scene"]
        for rung in list(rungs(equations, self.ladder, self.model))[:1]:
            self.runs.note(rung.label)
            timed = self.runs.run(rung.settings, self.runs.patience(), names)
            if timed is None:
                self.study.left_out.append(rung.label)
                continue
            row = Row(rung, timed, modelling=scene[0].modelling if scene else None)
            if timed.finished:
                row.numerical = output_errors(names, units, timed.values, tight.values)
                row.switching = switching(timed.events, tight.events)
            self.study.rows.append(row)

    def _unit(self, name: str) -> str:
        known = dict(zip((family(one)[0] for one in self.study.outputs), self.study.units, strict=True))
        return known.get(family(name)[0], "")
