"""What one case leaves: values, how it ended, figures, counters, seconds."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

FINISHED, FAILED, BUDGET, REFUSED, ERROR, KILLED = "finished", "failed", "budget", "refused", "error", "killed"
"""How a case ends: the run reached its stop; the engine could not go on; a budget was used up; the model has no such
values, or the engine asked for does not run it; a function of the user raised, or fairlead itself did; the process
that computed it is gone."""
COUNTED = ("steps", "rejected", "switches")
Value = float | str


@dataclass(frozen=True)
class Row:
    """One case: what was asked, how it ended, and what was found.

    `figures` is empty unless the run finished; a figure that does not exist (an event that never came) is NaN.
    `seconds` is the time of the whole case [s], `loop` that inside the engine.
    """

    key: str
    values: Mapping[str, Value]
    status: str
    sentence: str = ""
    figures: Mapping[str, float] = field(default_factory=dict)
    counters: Mapping[str, int] = field(default_factory=dict)
    broken: tuple[str, ...] = ()
    """Limits of the netlist that the run broke, each in a sentence."""
    seconds: float = 0.0
    loop: float = 0.0
    host: str = ""

    @property
    def ok(self) -> bool:
        """True if the run reached its stop and every figure could be told."""
        return self.status == FINISHED
