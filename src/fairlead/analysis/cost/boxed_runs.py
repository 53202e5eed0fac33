"""The runs of a study of cost within its budget: kept ones at once, new ones while there is time.

What a run takes is planned by what the last ones took: the making of the model, the steps, and all beside them, such as
starting the engine and reading the results. A run for whose beginning and end there is no time is not begun, and one
that is under way stops in time for both. So a busy machine makes fewer runs, and not a longer study.

Compiling an engine or the laws of a scene, once for this machine, is outside the budget.
"""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from fairlead.analysis.cost.kept_runs import KeptRuns, key_of
from fairlead.analysis.cost.ladder import Equations
from fairlead.analysis.cost.timed_run import Load, Models, Timed, timed_run
from fairlead.native import spent_compiling

LONGEST = 0.2  # share of the budget that one run may take
SHORTEST = 0.2  # s; with less time left no run is begun
SLOWER = 8.0  # times the scene as it is: a run that takes longer is cut off and called slow
USUAL = "rodas"  # the engine that runs the scene as it is
LEAST_SHARE = 0.05  # of the processor that a run is taken to have
WORTH_WAITING = 1.0  # s; no run is called slow that takes less
BESIDE = 1.0  # times what a model took to make: what a run takes beside its steps, while none has been made
LASTS = 3  # runs: the longest that the last of them took beside their steps is what the next is given
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
    usual: float = 0.0  # s, CPU time of the scene as it is
    shares: deque[float] = field(default_factory=lambda: deque([1.0], maxlen=LASTS))  # of the processor, of runs
    whole: bool = True  # all of the time of the scene is studied
    end: float = math.inf
    compiled: float = field(default_factory=spent_compiling)  # s, when the study began
    made: dict[str, Timed] = field(default_factory=dict)
    beside: deque[float] = field(default_factory=lambda: deque(maxlen=LASTS))  # over what the model took to make
    models: Models = field(init=False)
    begun: float = math.nan  # when the model of the run that is under way was made

    def __post_init__(self) -> None:
        self.models = Models(self.load)

    def run(self, settings: Mapping[str, str], cap: float, names: Sequence[str] | None = None,
            members: Mapping[str, Sequence[str]] | None = None) -> Timed | None:  # fmt: skip
        """A run, kept or new; None when there is no time left to begin it."""
        cap = min(cap, LONGEST * self.budget) if not self.full else cap
        key = key_of(self.digest, (sorted(settings.items()), names or self.names, members, self.span), self.libraries)
        found = self.made.get(key) or self.kept.get(key, cap)
        if found is not None and (found.finished or found.status != "budget" or found.cap >= cap):
            return found
        if not self.has_time_for(settings):
            return None
        self.begun = math.nan
        timed = timed_run(self.models, settings, names or self.names, self.span, cap, members, left=self._for_steps)
        if timed.repeats and timed.setup:
            took = time.perf_counter() - self.begun
            self.beside.append(max(0.0, took / timed.repeats - timed.wall) / timed.setup)
            self.shares.append(timed.cpu / timed.wall if timed.wall else 1.0)
        if timed.status == "budget" and timed.cap < cap:
            return None  # not slow, but begun too late
        self.made[key] = timed
        self.kept.put(key, timed)
        return timed

    def has_time_for(self, settings: Mapping[str, str]) -> bool:
        """Whether a model with these settings can be made yet."""
        return self.left() - self.models.takes(settings, self.span) >= SHORTEST

    def left(self) -> float:
        """Seconds of the budget; compiling is outside it."""
        return self.end + spent_compiling() - self.compiled - time.perf_counter()

    def _for_steps(self, setup: float) -> float:
        """Seconds that a run of a model may step, `setup` being what the model took to make; 0 when it is too late."""
        if math.isnan(self.begun):
            self.begun = time.perf_counter()
        steps = round(self.left() - setup * max(self.beside, default=BESIDE), 3)
        return steps if steps >= SHORTEST else 0.0

    def tightly(self, equations: Equations, engine: str, cap: float = math.inf, **more: Any) -> Timed | None:
        """A run at the accuracy of references; the engine rodas3p is the other method of rodas."""
        settings = {**equations.settings, "run.engine": engine, "run.accuracy": f"{self.tight:g}"}
        if engine == "rodas3p":
            settings |= {"run.engine": "rodas", "run.method": "rodas3p"}
        self.note(f"reference {equations.label} with {engine}".replace("  ", " "))
        return self.run(settings, cap, **more)

    def patience(self, engine: str = "") -> float:
        """Seconds that a line may take: an engine is slow by its CPU time, not because the machine has other work."""
        if self.full or engine == USUAL:
            return math.inf
        return max(WORTH_WAITING, SLOWER * self.usual) / max(min(self.shares), LEAST_SHARE)
