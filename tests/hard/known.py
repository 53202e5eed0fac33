"""Rows that are known to fail, with the reason; the scoreboard shows them too. One that passes must leave this list."""

from __future__ import annotations

import fnmatch

ROUNDED = "stepping: the instant of a switch inside a step is rounded to it, and the energy of a snap with it"
BETWEEN = "stepping: rows between steps lie on parabolas and show mean forces, where a motion is given or turns"
MIDPOINT = "stepping: the midpoint rule follows neither a growth nor a decay that is much faster than its step"
LEDGER = "the energy of contacts that creep or bend is missing by more than ten accuracies over long steps"
METERED = "stepping: the energy of a step is that at the mean of its way, which is of order two where a force bends"
LOOSE = "at loose accuracy the slip of what binds is known to a tenth of its creep, its force to as much"
CAUSE = "ida: stops at the first break-away, and the cause it names is not the cause"
STUCK = "ida: creeps on with steps of nanoseconds"

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
    ("time constants over ten decades", "stepping", "hold", MIDPOINT),
    ("steep falling curve, tustin over 1e-0[57] m/s", "ida", "[hb]*", CAUSE),
    ("row of blocks pulled from both ends, ?00", "ida", "hold", LEDGER),
    ("block on a shaken table, carried", "rodas3p", "lugre", LEDGER),
    ("two blocks on a belt that are shaken, 1e-3", "rodas3p", "binding", LOOSE),
    ("node without mass that nothing determines", "ida", "lugre", STUCK),
)
"""(case, engine, treatment, why); the first three as patterns."""


def known_failure(case: str, engine: str, treatment: str) -> str:
    """Why a row fails, if that is known; else nothing."""
    for *patterns, reason in KNOWN:
        if all(fnmatch.fnmatch(word, pattern) for word, pattern in zip((case, engine, treatment), patterns)):
            return reason
    return ""
