"""How likely a limit of the netlist is broken: the share of a sample, with its 95 % interval.

The interval is that of Clopper and Pearson (Biometrika 26, 1934), which holds for independent cases whatever the
probability; for Latin hypercubes and Sobol's points it is wider than it need be. Cases that did not finish may be
either: they are counted once as kept and once as broken.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from fairlead.cases.row import FINISHED

if TYPE_CHECKING:
    import pandas

LEVEL = 0.95
SAMPLES = ("latin_hypercube", "sobol", "monte_carlo")
"""Samples whose shares are probabilities; points for indices are none, and a grid has no distribution."""


@dataclass(frozen=True)
class Breach:
    """Cases, those that broke a limit, those that did not finish; the share and its interval."""

    cases: int
    broken: int
    unknown: int
    low: float
    high: float

    def __str__(self) -> str:
        share = self.broken / max(self.cases - self.unknown, 1)
        told = f"a limit is broken with a probability of {share:.3g} (95 %: {self.low:.3g} to {self.high:.3g}"
        unknown = f", {self.unknown} cases that did not finish counted both ways" if self.unknown else ""
        return f"{told}; {self.broken} of {self.cases} cases{unknown})"


def breach(frame: pandas.DataFrame) -> Breach | None:
    """Of the rows of a sample; None without rows."""
    from scipy.stats import binomtest

    if not len(frame):
        return None
    finished = frame["status"] == FINISHED
    broken, unknown = int((frame["limits_broken"][finished] > 0).sum()), int((~finished).sum())
    low = binomtest(broken, len(frame)).proportion_ci(LEVEL, "exact").low
    high = binomtest(broken + unknown, len(frame)).proportion_ci(LEVEL, "exact").high
    return Breach(len(frame), broken, unknown, float(low), float(high))
