"""One row played to its end: what came of it, in plain numbers that go into a file."""

from __future__ import annotations

import tempfile
import time
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from fairlead.integrate.engines import RODAS, STEPPING
from fairlead.integrate.machine_code import compiled_loop
from tests.hard.play import Broken, Play, Verdict
from tests.hard.registry import Row

OVER = 1.5  # of its budget; what a run may take beside its loop before it counts as stuck


@dataclass(frozen=True)
class Attempt:
    """The verdict on a row, and what it cost."""

    case: str
    engine: str
    treatment: str
    verdict: Verdict
    reason: str = ""
    auto: bool = False
    seconds: float = 0.0
    """Wall time of it all."""
    solving: float = 0.0
    """Wall time in the loop of the engine [s]."""
    steps: int = 0
    switches: int = 0
    closure: float | None = None
    version: str = ""
    """Key of the content it goes with."""
    commit: str = ""
    """The commit it was played at."""

    def plain(self) -> dict[str, Any]:
        """For JSON."""
        return asdict(self)


def attempt(row: Row, patience: float = 1.0) -> Attempt:
    """Play a row, in `patience` times its budget. What an engine throws counts as a crash; KeyboardInterrupt passes."""
    budget = patience * row.case.budget
    compiled_loop(STEPPING if row.engine == "stepping" else RODAS)  # not on the budget of the first row
    begun = time.perf_counter()
    with tempfile.TemporaryDirectory(prefix="fairlead-hard-") as folder:
        play = Play(row.engine, row.treatment, Path(folder), budget)
        verdict: Verdict
        try:
            row.case.play(play)
            verdict, reason = "ok", ""
        except Broken as broken:
            verdict, reason = broken.verdict, broken.reason
        except Exception as error:  # noqa: BLE001  a row that throws is a row that failed, and is shown as such
            verdict, reason = "crashed", f"{type(error).__name__}: {error}"
    seconds = time.perf_counter() - begun
    if verdict == "ok" and seconds > OVER * budget:
        verdict, reason = "stuck", f"took {seconds:.0f} s of a budget of {budget:.0f} s"
    return Attempt(
        row.case.name, row.engine, row.treatment, verdict, " ".join(reason.split()), play.auto, round(seconds, 3),
        round(play.solve_time, 4), play.steps, play.switches, play.closure,
    )  # fmt: skip
