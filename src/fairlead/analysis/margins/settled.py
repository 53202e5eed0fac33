"""Whether a line at constant speed has settled: a stretch of the run is halved, and the halves are compared.

Constant speed alone does not make a motion steady: layers may go on sliding on each other for the whole of a run, and
then its greatest compression depends on when it ends. Compared are, for the outer layer,

    lowest, highest    over its elements, of the tension, as a mean over instants of each half [N]
    rucking            share of its elements that ruck, as a mean over the time of each half

Means of the extremes of every instant are taken, not the extremes of a half: a single peak of stick-slip would decide.
Line on a drum is left out: it keeps the tension that it was wound on with, and leaves with it.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from fairlead.analysis.margins.ruck import BEYOND
from fairlead.analysis.margins.ruck_words import figure, moment
from fairlead.analysis.record.recorded_line import Floats, RecordedLine
from fairlead.analysis.statics.schedule import Stretch
from fairlead.results import Result

SMALL = 0.05
"""Change between the halves that counts as none: the share that the page also lets tensions differ from statics by."""
LOOKS = 100  # instants of a half at which a run is asked, as in hose_against_statics.py


def drift(line: RecordedLine, stretch: Stretch) -> dict[str, Any] | None:
    """What changes between the halves of a stretch, and `settled`; None where tensions were not recorded.

    `change` is the largest of the three: of tensions relative to their range in the stretch, but to no less than the
    force at which the layer rucks.
    """
    record = line.record
    layer = f"{record['line']}.{record['layers'][0]}"
    tension = line.layers[0] if line.layers else None
    if tension is None:
        return None
    middle = (stretch.begin + stretch.end) / 2
    halves = [(stretch.begin, middle), (middle, stretch.end)]
    lowest, highest = zip(*(_extremes(line, tension, *half) for half in halves), strict=True)
    rucking = [_rucking(line.result, layer, record["nodes"] - 1, *half) for half in halves]
    scale = max(max(highest) - min(lowest), record["ruck_force"] or 0.0)
    moved = max(abs(lowest[1] - lowest[0]), abs(highest[1] - highest[0]))
    change = max(moved / scale if scale > 0 else 0.0, abs(rucking[1] - rucking[0]))
    return {
        "line": record["line"], "layer": record["layers"][0], "from": stretch.begin, "to": stretch.end,
        "lowest": list(lowest), "highest": list(highest), "rucking": rucking, "change": change, "beside": scale,
        "settled": change <= SMALL,
    }  # fmt: skip


def _extremes(line: RecordedLine, tension: Floats, begin: float, end: float) -> tuple[float, float]:
    """Lowest and highest of all elements, as means over instants."""
    rows = np.searchsorted(line.result.t, np.linspace(begin, end, LOOKS)).clip(max=len(line.result.t) - 1)
    seen = tension[rows]
    drum = max((one["end"] for one in line.record["stations"] if one["type"] == "Winch"), default=-np.inf)
    if line.places is not None:
        off = line.places[rows] >= drum
        seen = np.where(off | ~off.any(axis=1, keepdims=True), seen, np.nan)
    return float(np.nanmin(seen, axis=1).mean()), float(np.nanmax(seen, axis=1).mean())


def _rucking(result: Result, layer: str, count: int, begin: float, end: float) -> float:
    """Share of the elements that ruck between two times."""
    spent = sum(min(until, end) - max(since, begin) for since, until in _spells(result, layer)
                if until > begin and since < end)  # fmt: skip
    return float(spent / (count * (end - begin)))


def _spells(result: Result, layer: str) -> Iterator[tuple[float, float]]:
    """From when to when single elements ruck."""
    since: dict[str, float] = {}
    for one in result.events:
        if not one.component.startswith(f"{layer}["):
            continue
        if one.zone_to in BEYOND:
            since.setdefault(one.component, one.t)
        elif one.component in since:
            yield since.pop(one.component), one.t
    yield from ((begin, float(result.t[-1])) for begin in since.values())


def much(found: dict[str, Any]) -> str:
    """How much changes, with what that is a share of; of runs of old the share alone."""
    share = f"{100 * found['change']:.2g} %"
    moved = max(abs(found[key][1] - found[key][0]) for key in ("lowest", "highest"))
    beside = found.get("beside")
    if not beside or moved / beside < found["change"]:  # the share of elements that ruck changes more
        return share
    return f"{figure(moved)} N, {share} of {figure(beside)} N"


def sentence(found: dict[str, Any]) -> str:
    """What changes, in words; empty of a motion that has settled."""
    if found["settled"]:
        return ""
    begin, end, layer = found["from"], found["to"], found["layer"]
    first, second = ([found[key][k] for key in ("lowest", "highest")] for k in (0, 1))
    rucks = ""
    if max(found["rucking"]) > 0:
        rucks = f" {_percent(found['rucking'][0])}, then {_percent(found['rucking'][1])} of its elements ruck."
    return (
        f"The speed is constant from {moment(begin)} to {moment(end)} s, but the {layer} still changes. In the first "
        f"half of that time its tension lies between {figure(first[0])} and {figure(first[1])} N, in the second "
        f"between {figure(second[0])} and {figure(second[1])} N (means of the extremes).{rucks}"
    )


def _percent(share: float) -> str:
    return f"{100 * share:.2g} %"

