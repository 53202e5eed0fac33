"""What a study of cost found: references, lines with their errors, and what could not be told."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from fairlead.analysis.cost.deviation import OutputError, Switching, worst
from fairlead.analysis.cost.ladder import Equations, Rung
from fairlead.analysis.cost.timed_run import Timed

AGREE = 1e-3  # spread of two references that are one solution


@dataclass(frozen=True)
class Reference:
    """Tight runs of one set of equations. `spread` is None when there is only one."""

    label: str
    timed: Timed
    spread: float | None = None
    spread_of: str = ""
    sensitive: bool = False
    dissent: str = ""  # an engine that two others outvote, and by how much

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

    def floor_of(self, equations: Equations) -> float:
        """The same for some equations: where a scene is sensitive, what their most exact half of lines still has.

        Statistics of runs that part from each other scatter, however exact the runs: what does not become less with
        the accuracy is no numerical error.
        """
        if not self.sensitive:
            return self.floor
        rows = [row for row in self.rows if row.rung.equations == equations and row.numerical is not None]
        accuracies = sorted({row.rung.accuracy for row in rows})
        exact = accuracies[: max(1, len(accuracies) // 2)]
        sizes = [self.size(row.numerical) or 0.0 for row in rows if row.rung.accuracy in exact]
        return max([self.floor, *sizes])

    def told(self, errors: Sequence[OutputError] | None, row: Row) -> tuple[float | None, bool]:
        """The size of some errors of a line, or the floor where it is not above it, and whether it is not."""
        size, floor = self.size(errors), self.floor_of(row.rung.equations)
        below = size is not None and math.isfinite(floor) and size <= floor and bool(floor)
        return (floor if below else size), below

    def unfinished(self) -> Iterator[str]:
        """Why lines have no numbers."""
        for row in self.rows:
            if not row.timed.finished:
                yield f"{row.rung.label}: {row.timed.reason or row.timed.status}"
