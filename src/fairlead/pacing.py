"""A run that keeps time with the clock: `fairlead run --real-time`. Results do not depend on it: only waiting does.

    frame k    begins when the clock shows k - 1 steps since the start, and is late if it is not done when it shows k.
               After a late one the next begins at once, until the run has caught up

The start is settled before the clock begins. What was recorded is handed over between two frames, some at a time, while
there is nothing else to do; where there is not, that makes frames late as well.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from fairlead.integrate.codes import EVEN, TRY
from fairlead.integrate.underway import SLICE, Underway


@dataclass
class Pacer:
    """Has a run do a frame when it is due (`integrate(..., go_on=Pacer(...))`), and keeps how that went."""

    step: float
    """[s] of a frame."""
    clock: Callable[[], float] = time.perf_counter
    sleep: Callable[[float], None] = time.sleep
    frames: int = field(default=0, init=False)
    late: int = field(default=0, init=False)
    most_late: float = field(default=0.0, init=False)
    longest: float = field(default=0.0, init=False)
    longest_at: float = field(default=0.0, init=False)
    spent: float = field(default=0.0, init=False)
    _zero: float | None = field(default=None, init=False)
    _waiting: float = field(default=0.0, init=False)

    def __call__(self, going: Underway) -> None:
        """One frame, and before the first what comes before any."""
        number = going.active.memory.number
        start = float(number["start"])
        if self._zero is None:
            while going.served and number["phase"] != TRY:
                going.go_on(0)
            self._zero = self.clock() - (float(number["t"]) - start)
        elif self._waiting >= SLICE:
            self._hand_over(going)
        t = float(number["t"])
        end = min(start + (math.floor((t - start) / self.step + EVEN) + 1.0) * self.step, float(number["stop"]))
        self._wait(going, self._zero + (t - start))
        begun = self.clock()
        while going.served and number["t"] < end:
            going.go_on(1, hand_over=False)
        done = self.clock()
        self._note(t, done - begun, done - (self._zero + (float(number["t"]) - start)))
        self._waiting += float(number["t"]) - t
        if going.served and number["t"] >= number["stop"]:
            going.go_on(0)
        if not going.served:
            self._hand_over(going)

    def _wait(self, going: Underway, until: float) -> None:
        """Sleep until then, and see now and then whether the run is to end."""
        while (rest := until - self.clock()) > 0.0:
            self.sleep(min(rest, SLICE))
            if rest > SLICE:
                self._hand_over(going)

    def _hand_over(self, going: Underway) -> None:
        going.flush()
        self._waiting = 0.0

    def _note(self, t: float, took: float, lateness: float) -> None:
        self.frames += 1
        self.spent += took
        if took > self.longest:
            self.longest, self.longest_at = took, t
        if lateness > 0.0:
            self.late += 1
            self.most_late = max(self.most_late, lateness)

    def plain(self) -> dict[str, Any]:
        """For run.json; times in s."""
        return {
            "frames": self.frames, "late": self.late, "most_late": self.most_late, "longest": self.longest,
            "longest_at": self.longest_at, "mean": self.spent / max(self.frames, 1),
        }  # fmt: skip
