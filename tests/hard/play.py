"""What a case plays with: it runs scenes on one engine with one treatment, and says what is wrong with the answer."""

from __future__ import annotations

import textwrap
import time
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

import fairlead
from fairlead.errors import FairleadError, RunWarning
from fairlead.results import Result
from tests.hard import invariants

SCENES = Path(fairlead.__file__).parents[2] / "models" / "hard"
CREEP = 1e-5  # m/s, of binding contacts where a case does not say otherwise
PRESLIDING = 2e-5  # m, of bristles: what Contact takes when nothing is said
RELAXATION = 2e-3  # s, of LuGre, likewise: who starts to slide at once is pushed back by the friction times this
Verdict = Literal["ok", "stopped", "wrong", "stuck", "crashed"]


class Broken(AssertionError):
    """A row that did not come through: stopped with a message, wrong, or stuck."""

    def __init__(self, verdict: Verdict, reason: str) -> None:
        super().__init__(f"{verdict}: {reason}")
        self.verdict, self.reason = verdict, reason


@dataclass
class Play:
    """One engine, one treatment, a folder to work in, and the figures of what was run."""

    engine: str
    treatment: str
    folder: Path
    budget: float
    creep: float = CREEP
    solve_time: float = 0.0
    switches: int = 0
    steps: int = 0
    closure: float | None = None
    auto: bool = True
    """Whether `auto` would have taken this engine for every scene of the case."""
    begun: float = field(default_factory=time.perf_counter)
    runs: int = 0

    def run(self, scene: str | Path, *, lenient: Mapping[str, float] | None = None, **overrides: Any) -> Result:
        """Run a scene to its stop; `overrides` as for --set, a dot written as two underscores.

        `lenient` widens invariants by name for a stated reason. Raises Broken when the run does not finish, or breaks
        what every run must keep.
        """
        result = self.ended(scene, **overrides)
        sentence = result.run["sentence"]
        if result.status == "budget":
            raise Broken("stuck", sentence)
        if result.status != "finished":
            raise Broken("stopped", sentence)
        try:
            invariants.check(result, self.treatment, lenient or {})
        except AssertionError as error:
            raise Broken("wrong", str(error)) from None
        return result

    def ended(self, scene: str | Path, **overrides: Any) -> Result:
        """Run a scene however it ends. Raises Broken when it is refused."""
        settings = {name.replace("__", "."): str(value) for name, value in overrides.items()}
        left = max(self.budget - (time.perf_counter() - self.begun), 1.0)
        try:
            model = fairlead.load(self._file(scene), set={**self._treatment(), **settings})
            self._would_auto(model)
            self.runs += 1
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", RunWarning)  # invariants ask what remarks would say
                result = model.run(out=self.folder / f"run{self.runs}", max_wall=left, check=False, **self._engine())
        except FairleadError as error:
            raise Broken("stopped", f"refused: {error}") from None
        if result.status == "interrupted":
            raise KeyboardInterrupt
        self._take(result)
        return result

    def near(self, what: str, measured: ArrayLike, exact: ArrayLike, within: float) -> None:
        """Raise Broken unless the greatest difference is `within`."""
        measured, exact = np.broadcast_arrays(np.asarray(measured, float), np.asarray(exact, float))
        miss = np.abs(measured - exact)
        if not (miss <= within).all():
            k = int(np.nanargmax(np.where(np.isnan(miss), np.inf, miss)))
            told = f"{what} is {measured.flat[k]:.10g}, must be {exact.flat[k]:.10g} within {within:.2g}"
            raise Broken("wrong", told)

    def check(self, holds: Any, otherwise: str) -> None:
        """Raise Broken with a sentence unless something holds."""
        if not holds:
            raise Broken("wrong", otherwise)

    def by(self, hold: Any, binding: Any, lugre: Any = None) -> Any:
        """What goes with the treatment."""
        return {"hold": hold, "binding": binding, "lugre": lugre, "none": hold}[self.treatment]

    def _file(self, scene: str | Path) -> Path:
        if isinstance(scene, Path):
            return scene
        path = self.folder / f"scene{self.runs}.yaml"
        path.write_text("schema: 1\nname: scene\n" + textwrap.dedent(scene), encoding="utf-8")
        return path

    def _treatment(self) -> dict[str, str]:
        if self.treatment == "none":
            return {}
        more = {"friction.creep": f"{self.creep!r} m/s"} if self.treatment == "binding" else {}
        return {"friction.method": self.treatment, **more}

    def _engine(self) -> dict[str, str]:
        if self.engine == "rodas3p":
            return {"engine": "rodas", "method": "rodas3p"}
        return {"engine": self.engine}

    def _would_auto(self, model: Any) -> None:
        from fairlead.engine import engine_of

        asked = model.netlist.run.model_copy(update={"engine": "auto"})
        self.auto = self.auto and engine_of(asked, model.system)[0] == self.engine

    def _take(self, result: Result) -> None:
        run = result.run
        self.solve_time += run["solve_time"]
        self.switches += run["switches"]
        self.steps += run["steps"]
        closure = run["energy"]["closure"]
        if closure is not None:
            self.closure = max(closure, self.closure or 0.0)


def scene(name: str) -> Path:
    """A scene that has a file of its own."""
    return SCENES / f"{name}.yaml"
