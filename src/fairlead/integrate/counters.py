"""What a run cost, in counts that do not depend on the machine."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

COUNTS = (
    "steps",
    "rejected_error",
    "rejected_nan",
    "rejected_inconsistent",
    "rejected_switch",
    "rejected_cycling",
    "rejected_diverged",
    "rejected_singular",
    "rhs",
    "jacobians",
    "factorisations",
    "solves",
    "guards",
    "switches",
    "located",
    "settling_passes",
    "time_events",
    "replans",
    "partial_steps",
    "projections",
    "overruns",
)
"""Counters kept by the compiled loop, each in the struct of its owner (memory/of_*.py)."""


@dataclass(frozen=True)
class Counters:
    """Counts of one run."""

    steps: int
    """Accepted steps, each up to its end or to the first switch inside it."""
    rejected_error: int
    """Steps tried in vain because their error was too large."""
    rejected_nan: int
    """The same because it was not a finite number."""
    rejected_inconsistent: int
    """Steps given up because a guard turned out positive without having crossed."""
    rejected_switch: int
    """Steps taken again to end at a switch. Where steps end at every switch, as those of `rodas`: the piece up to there
    did not satisfy the equations (one_step.py). Of `stepping` with switches inside: a law jumps there, or an impulse
    was missed. Where such a law jumps at the start of the step, that was settled, and counts here too."""
    rejected_cycling: int
    """Steps of `stepping` whose zones went in a circle."""
    rejected_diverged: int
    """Steps of `stepping` whose iteration did not converge."""
    rejected_singular: int
    """Steps with a matrix that could not be factorised."""
    rhs: int
    jacobians: int
    factorisations: int
    solves: int
    guards: int
    """Evaluations of the vector of all guards."""
    switches: int
    """Zone changes, all machines."""
    located: int
    """Ends of pieces at which zones were settled: where guards fired inside a step, and of `stepping` also where it
    ends at the jump of a law, or at a sample."""
    settling_passes: int
    time_events: int
    replans: int
    """Fresh pivot orders computed because the planned one lost accuracy."""
    partial_steps: int
    """Steps in which only what moves was computed, see parts.py."""
    projections: int
    """Ends of steps brought back to relations of positions that are kept, see position.py."""
    overruns: int
    """Steps of a run in real time that met the cap on their work, or were taken again (stepping/frames.py)."""
    switches_by_machine: NDArray[np.int64]
    """[machines]: zone changes of each."""
    rejections_by_unknown: NDArray[np.int64]
    """[n]: how often each unknown had the largest error of a step that was rejected, or ended at a switch, for its
    error."""

    @property
    def rejected(self) -> int:
        """Steps tried in vain, for any reason."""
        return (
            self.rejected_error + self.rejected_nan + self.rejected_inconsistent + self.rejected_switch + self.unsolved
        )

    @property
    def unsolved(self) -> int:
        """Steps tried in vain because their equations, zones among them, were not solved."""
        return self.rejected_cycling + self.rejected_diverged + self.rejected_singular
