"""How a run in real time went: steps that overran the bound on their work, and with a clock, frames that were late."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any


def overrun_remarks(kept: Mapping[str, Any] | None) -> list[str]:
    """What is to be known of results whose steps did not get all their work done."""
    if not kept or not kept["overruns"]:
        return []
    what = f"run.real_time: {_overran(kept)}, first at t = {kept['first']['t']:.6g} s: {kept['first']['what']}."
    return [f"{what} What such a step leaves undone is an error of the results; compare with a shorter step."]


def rows_of_table(kept: Mapping[str, Any] | None) -> list[tuple[str, str]]:
    """Rows of the table that a run ends with; none of a run that is none in real time."""
    if not kept:
        return []
    rows = [("real time", _overran(kept))]
    if clock := kept["clock"]:
        late = f"{clock['late']} of {clock['frames']} were late"
        late += f", by {_milliseconds(clock['most_late'])} at most" if clock["late"] else ""
        took = f"the longest step took {_milliseconds(clock['longest'])} of {_milliseconds(kept['step'])}"
        mean = f"mean {_milliseconds(clock['mean'])}"
        rows.append(("clock", f"{took} (at {clock['longest_at']:.4g} s; {mean}); {late}"))
    return rows


def _overran(kept: Mapping[str, Any]) -> str:
    steps = f"{kept['overruns']} of {kept['steps']} steps of {_milliseconds(kept['step'])}"
    return f"{steps} overran the bound on their work"


def _milliseconds(seconds: float) -> str:
    return f"{1e3 * seconds:.3g} ms"
