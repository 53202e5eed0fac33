"""What can only pull in a machine, as the core of a line, and pushed in a run: an output of role `pull` below zero."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from fairlead.analysis.record.extremes import Extremes
from fairlead.component.declare import PULL
from fairlead.system.arrays.recording import OutputSignal
from fairlead.system.numbering.tolerances import roundings


def pushes(extremes: Extremes, recorded: Sequence[OutputSignal], accuracy: float) -> dict[str, Any] | None:
    """For run.json: the largest push, whose and when, and how many push; None where nothing does.

    A push below the accuracy of the largest pull, or below what a force is known to, is what is left of zero.
    """
    columns = [k for k, signal in enumerate(recorded) if signal.role == PULL and k < len(extremes.lowest)]
    least, most = extremes.lowest[columns], extremes.highest[columns]
    left = accuracy * np.max(most, initial=0.0) + roundings([recorded[k].unit for k in columns])
    pushed = np.flatnonzero(np.isfinite(least) & (least < -left))
    if not len(pushed):
        return None
    worst = int(pushed[least[pushed].argmin()])
    one = recorded[columns[worst]]
    return {"most": -float(least[worst]), "unit": one.unit, "component": one.name.rpartition(".")[0],
            "t": float(extremes.t_lowest[columns[worst]]), "count": len(pushed)}  # fmt: skip


def remark(found: Mapping[str, Any] | None) -> str:
    """A sentence on them, and what to do; nothing where nothing pushed."""
    if not found:
        return ""
    others = f", and {found['count'] - 1} more" if found["count"] > 1 else ""
    what = f"{found['component']} pushes with {found['most']:.4g} {found['unit']} at t = {found['t']:.6g} s{others}"
    why = "a core pushes only where it cannot stretch, and a rope never does"
    way_out = "Leave it its stretch (core_stretch or line_stretch: on); for microseconds take run.engine: stepping."
    return f"{what}: {why}. {way_out}"
