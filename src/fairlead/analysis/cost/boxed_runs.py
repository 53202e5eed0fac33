"""The runs of a study of cost within its budget: kept ones at once, new ones while there is time.

Compiling an engine or the laws of a scene, once for this machine, is outside the budget.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from fairlead.analysis.cost.kept_runs import KeptRuns, key_of
from fairlead.analysis.cost.ladder import Equations
from fairlead.analysis.cost.timed_run import Load, Timed, timed_run

LONGEST = 0.2  # share of the budget that one run may take
SHORTEST = 0.2  # s; with less time left no run is begun
SLOWER = 8.0  # times the scene as it is: a run that takes longer is cut off and called slow
WORTH_WAITING = 1.0  # s; no run is called slow that takes less
COMPILED = 8.0  # s; a first step that takes longer has compiled an engine or laws, which is outside the budget
Note = Callable[[str], None]


@dataclass
class BoxedRuns:
    """How a study runs its scene: `names` are the outputs it compares, `tight` the accuracy of its references."""

    load: Load
    digest: str
    names: list[str]
    span: tuple[float, float]
    budget: float
    tight: float
    kept: KeptRuns
    libraries: Iterable[str] = ()
    full: bool = False
    note: Note = lambda _: None
    usual: float = 0.0  # s that the scene as it is takes
    end: float = math.inf
    warm: set[tuple[tuple[str, str], ...]] = field(default_factory=set)

    def run(self, settings: Mapping[str, str], cap: float, names: Sequence[str] | None = None,
            members: Mapping[str, Sequence[str]] | None = None) -> Timed | None:  # fmt: skip
        """A run, kept or new; None when there is no time left to begin it."""
        cap = min(cap, LONGEST * self.budget) if not self.full else cap
        key = key_of(self.digest, (sorted(settings.items()), names or self.names, members, self.span), self.libraries)
        found = self.kept.get(key, cap)
        if found is not None:
            return found
        self._warm_up(settings)
        left = round(self.end - time.perf_counter(), 3)
        if left < SHORTEST:
            return None
        timed = timed_run(self.load, settings, names or self.names, self.span, min(cap, left), members)
        if timed.status == "budget" and left < cap:
            return None  # not slow, but begun too late
        self.kept.put(key, timed)
        return timed

    def tightly(self, equations: Equations, engine: str, cap: float = math.inf, **more: Any) -> Timed | None:
        """A run at the accuracy of references; the engine rodas3p is the other method of rodas."""
        settings = {**equations.settings, "run.engine": engine, "run.accuracy": f"{self.tight:g}"}
        if engine == "rodas3p":
            settings |= {"run.engine": "rodas", "run.method": "rodas3p"}
        self.note(f"reference {equations.label} with {engine}".replace("  ", " "))
        return self.run(settings, cap, **more)

    def patience(self) -> float:
        """Seconds that a line may take."""
        return math.inf if self.full else max(WORTH_WAITING, SLOWER * self.usual)

    def _warm_up(self, settings: Mapping[str, str]) -> None:
        """One step of an engine or of equations that are new to this study."""
        kind = tuple(sorted((name, value) for name, value in settings.items() if name != "run.accuracy"))
        if kind in self.warm:
            return
        self.warm.add(kind)
        begun = time.perf_counter()
        self.note(f"loading {settings.get('run.engine', 'rodas')}")
        start = self.span[0]
        timed_run(self.load, {**settings, "run.max_steps": "1"}, [], (start, start + 1e-3), 600.0)
        took = time.perf_counter() - begun
        if took > COMPILED:
            self.end += took
