"""Stops with a restitution that took one blow together, where one after the other they may have ended elsewhere.

Moreau's law gives what an impulse joins one common rebound (`integrate/events/rebound.py`). Balls with gaps between
them pass a blow on one by one, and end elsewhere. Which of the two it is, is decided by gaps: one within the tolerance
of its guard is none, and a rebound too slow to count leaves none. Then the run tells.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from fairlead.analysis.record.chattering import MOST_NAMED
from fairlead.system.compiled.system import System
from fairlead.system.numbering.tolerances import Floats

MOST_TOLD = 20
"""Stops in run.json; `count` has them all. A remark names the first few."""


def met_together(system: System, times: Floats, first: Floats) -> dict[str, Any]:
    """For run.json: of how many stops, and the first: `t` of the first blow [s], `stop` by name, `times` how often.

    `times` and `first` are by row, shape (n,).
    """
    told = [(float(first[k]), _name(system, k), int(times[k])) for k in _in_order(system, times, first)]
    told.sort()
    return {
        "count": len(told),
        "first": [{"t": t, "stop": name, "times": many} for t, name, many in told[:MOST_TOLD]],
    }


def _in_order(system: System, times: Floats, first: Floats) -> list[int]:
    """The rows, but not those whose first blow was shared with stops between the same bodies: these have no order.

    A row that was the only one to begin at an instant shared its blow with one that had begun before.
    """
    starts, rows = system.mass_pattern.starts, system.mass_pattern.rows
    columns = np.repeat(np.arange(system.n), np.diff(starts))
    bodies = {k: frozenset(columns[rows == k].tolist()) for k in np.flatnonzero(times > 0.0).tolist()}
    together: dict[float, list[frozenset[int]]] = {}
    for k, between in bodies.items():
        together.setdefault(float(first[k]), []).append(between)
    return [k for k in bodies if len(together[float(first[k])]) == 1 or len(set(together[float(first[k])])) > 1]


def _name(system: System, row: int) -> str:
    return system.numbering.unknowns[row].name.rpartition(".")[0]


def remark(found: dict[str, Any]) -> str:
    """What to tell of them; "" for nothing."""
    if not found["count"]:
        return ""
    told: Sequence[dict[str, Any]] = found["first"]
    begin = told[0]["t"]
    names = [one["stop"] for one in told if one["t"] == begin][:MOST_NAMED]
    others = found["count"] - len(names)
    more = f" (and {others} more, then or later)" if others else ""
    return (
        f"t = {begin:.6g} s: {', '.join(names)}{more} took a blow together and gave it back together. "
        "One after the other they may end elsewhere, and nothing tells the order where bodies touch: as given, or "
        "since a rebound below ten error weights is none. Gaps between them decide it; met_together in run.json has "
        f"the first {MOST_TOLD} of them."
    )
