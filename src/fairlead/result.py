"""What a run computed, and the questions that are asked of it.

    result = fairlead.load("belt").run()
    result["block.x"]           everything of `fairlead.results.Result`: signals, events, exports
    result.remarks              what the run has to say beside its numbers
"""

from __future__ import annotations

import fairlead.results as results
from fairlead.analysis.told import remarks


class Result(results.Result):
    """One run: its signals, and what is worked out from them.

    `model.run()` gives it, `Result.open("results/belt")` opens that of an earlier run.
    """

    @classmethod
    def of(cls, recorded: results.Result) -> Result:
        """The same run, with more to ask."""
        return cls(recorded.path, recorded.run, recorded._series, recorded._given_events)

    @property
    def remarks(self) -> tuple[str, ...]:
        """What the run has to say: what `check` would remark, chatter, an open energy ledger, broken limits."""
        return remarks(self.run)
