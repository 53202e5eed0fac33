"""Rows that are known to fail, and rows that the tests leave to `make hard`, each with the reason.

`make hard` plays every row and ends with 1 when what fails is not what is listed here. A row that comes through must
leave the list: in the tests it fails otherwise. docs/stability.md shows the reasons beside what came of each row.
"""

from __future__ import annotations

import fnmatch
from collections.abc import Iterable, Iterator

from tests.hard.attempt import Attempt
from tests.hard.registry import Row

ROUNDED = "stepping: the instant of a switch inside a step is rounded to it, and the energy of a snap with it"
BETWEEN = "stepping: rows between steps lie on parabolas and show mean forces, where a motion is given or turns"
MIDPOINT = "stepping: the midpoint rule follows neither a growth nor a decay that is much faster than its step"
LEDGER = "the energy of contacts that creep or bend is missing by more than ten accuracies over long steps"
METERED = "stepping: the energy of a step is that at the mean of its way, which is of order two where a force bends"
CREEPS = "stepping: made for contacts that hold exactly; the laws of contacts that creep or bend turn inside its steps"
CAUSE = "ida: stops at the first break-away, and the cause it names is not the cause"
STUCK = "ida: creeps on with steps of nanoseconds"
SOUGHT = "ida: one of many random scenes fails, and the time does not suffice to find a small one"
BRIEF = "ida: bounces of less than a millimetre a second end early: its step sees neither their dip nor their return"
PASSES = "comes through since step sizes are rounded; it leaves the list above when docs/stability.md is written anew"
FOUND = "stepping: one of many random scenes fails; the cause is not known"

KNOWN: tuple[tuple[str, str, str, str], ...] = (
    ("stick slip cycles without drift, *", "stepping", "hold", ROUNDED),
    ("node without mass, slipping", "stepping", "hold", ROUNDED),
    ("end stop touched at the start, upper, outward", "stepping", "none", ROUNDED),
    ("normal force to zero and back, in ramps", "stepping", "hold", ROUNDED),
    ("normal force to zero and back, touching zero", "stepping", "hold", ROUNDED),
    ("normal force to zero and back, four times", "stepping", "hold", ROUNDED),
    ("slack to taut with a snap, into a tether of 1e8 N/m", "stepping", "hold", ROUNDED),
    ("core that goes slack", "stepping", "hold", ROUNDED),
    ("block on a shaken table, carried", "stepping", "hold", BETWEEN),
    ("two blocks on a belt that are shaken, 1e-[357]", "stepping", "hold", BETWEEN),
    ("two blocks on a belt that are shaken, 1e-9", "stepping", "hold", METERED),
    ("unit rescaled, lengths x 1e-2", "stepping", "hold", METERED),
    ("steep falling curve, tustin *", "stepping", "hold", MIDPOINT),
    ("steep falling curve, stribeck over 1e-0[57] m/s", "stepping", "hold", MIDPOINT),
    ("mirrored blocks stay mirrored, falling curve", "stepping", "hold", MIDPOINT),
    ("time constants over ten decades", "stepping", "*", MIDPOINT),
    ("steep falling curve, tustin over 1e-07 m/s", "ida", "[hb]*", CAUSE),
    ("steep falling curve, tustin over 1e-05 m/s", "ida", "binding", CAUSE),
    ("row of blocks pulled from both ends, ?00", "ida", "hold", LEDGER),
    ("node without mass that nothing determines", "ida", "lugre", STUCK),
    ("row of blocks pulled from both ends, ?00", "stepping", "binding", CREEPS),
    ("node without mass, slipping", "stepping", "[bl]*", CREEPS),
    ("pads side by side on one block, 3", "stepping", "binding", CREEPS),
    ("pads side by side on one block, 30", "stepping", "binding", CREEPS),
    ("steep falling curve, *", "stepping", "binding", CREEPS),
    ("feedback through a lag, mu k = 0.5", "stepping", "binding", CREEPS),
    ("two unequal pads catch one block at once", "stepping", "binding", CREEPS),
    ("cylinder that sticks and slips", "stepping", "binding", CREEPS),
    ("normal force to zero and back, [ift]*", "stepping", "binding", CREEPS),
    ("block on a shaken table, *", "stepping", "binding", CREEPS),
    ("block on a shaken table, carried", "stepping", "lugre", CREEPS),
    ("surface and body both prescribed", "stepping", "[bl]*", CREEPS),
    ("belt that jumps in speed, *", "stepping", "binding", CREEPS),
    ("slack to taut with a snap, into a tether of 1e8 N/m", "stepping", "[bl]*", CREEPS),
    ("slack to taut with a snap, into a tether of 1e4 N/m", "stepping", "binding", CREEPS),
    ("block thrown up a slope, it stays", "stepping", "binding", CREEPS),
    ("block thrown up a slope, at the limit", "stepping", "binding", CREEPS),
    ("block thrown up a slope, it slides back", "stepping", "lugre", CREEPS),
    ("load steps at the instant of the stop, holds", "stepping", "binding", CREEPS),
    ("shaken to and fro without sticking", "stepping", "binding", CREEPS),
    ("two blocks on a belt that are shaken, *", "stepping", "binding", CREEPS),
    ("blocks stop in one instant, *", "stepping", "binding", CREEPS),
    ("drive slower than the creep, 1e-4 m/s", "stepping", "binding", CREEPS),
    ("mirrored blocks stay mirrored, *", "stepping", "binding", CREEPS),
    ("time shifted, 1 s", "stepping", "binding", CREEPS),
    ("time shifted, 1e4 s", "stepping", "binding", CREEPS),
    ("unit rescaled, lengths x 1e-2", "stepping", "[bl]*", CREEPS),
    ("random networks, 20*", "stepping", "[bl]*", CREEPS),
    ("random networks, 200", "stepping", "hold", FOUND),
    ("random routes, 10", "stepping", "hold", FOUND),
    ("random routes, 10", "ida", "[hb]*", SOUGHT),
    ("ball that bounces until it lies, nine tenths", "ida", "none", BRIEF),
)
"""(case, engine, treatment, why); the first three as patterns."""

LEFT: tuple[tuple[str, str, str, str], ...] = (
    ("*", "stepping", "[bl]*", CREEPS),
    ("node without mass that nothing determines", "ida", "lugre", STUCK),
    ("steep falling curve, stribeck over 1e-05 m/s", "stepping", "hold", PASSES),
)
"""Rows that the tests leave to `make hard`, as in KNOWN; `left_out` adds those that take long."""


MENDED = {
    ("block on a shaken table, carried", "rodas3p", "lugre"),
    ("two blocks on a belt that are shaken, 1e-3", "rodas3p", "binding"),
    ("steep falling curve, tustin over 1e-05 m/s", "ida", "hold"),
    ("node without mass that nothing determines", "stepping", "binding"),
}
"""Rows that docs/stability.md shows as failing at its commit, and that come through or are of a case that is no more.

None once it is made anew.
"""


def known_failure(case: str, engine: str, treatment: str) -> str:
    """Why a row fails, if that is known; else nothing."""
    return _reason(KNOWN, (case, engine, treatment))


def left_out(row: Row) -> str:
    """Why the tests leave a row to `make hard`; nothing for a row that they play.

    They play all cheap rows; of a case that takes some seconds its first engine with its first treatment.
    """
    if why := _reason(LEFT, (row.case.name, row.engine, row.treatment)):
        return why
    if row.case.cost == "slow":
        return "takes more than some seconds"
    if row.case.cost == "fair" and (row.engine, row.treatment) != (row.case.engines[0], row.case.treatments[0]):
        return "takes some seconds; the tests play this case on its first engine with its first treatment"
    return ""


def disagreements(attempts: Iterable[Attempt]) -> Iterator[str]:
    """A sentence for every row that fails and is not listed, and for every listed one that came through."""
    for one in attempts:
        known = known_failure(one.case, one.engine, one.treatment)
        if (one.verdict != "ok") != bool(known):
            what = "comes through and must leave" if known else "fails and is not in"
            yield f"{one.case} / {one.engine} / {one.treatment} {what} tests/hard/known.py"


def _reason(listed: tuple[tuple[str, str, str, str], ...], name: tuple[str, str, str]) -> str:
    return next((why for *patterns, why in listed if all(map(fnmatch.fnmatch, name, patterns))), "")
