"""Rows that are known to fail, and rows that the tests leave to `make hard`, each with the reason.

`make hard` plays every row and ends with 1 when what fails is not what is listed here. A row that comes through must
leave the list: in the tests it fails otherwise. docs/stability.md shows the reasons beside what came of each row.
"""

from __future__ import annotations

import fnmatch
from collections.abc import Iterable, Iterator

from tests.hard.attempt import Attempt
from tests.hard.registry import Row

LEDGER = "the energy of contacts that creep or bend is missing by more than ten accuracies over long steps"
SLOW = "ida: takes 27 of its 30 s"
BRIEF = "ida: bounces of less than a millimetre a second end early: its step sees neither their dip nor their return"
CREEPS = "a row inside a step shows a contact that creeps at its limit 1.03e-5 above it at 1e-5; 1e-5 is allowed"
TOUCHED = "stepping: a contact that begins to creep beside one that does is shown 4e-5 above its limit at that instant"
ASIDE = "ida: a body that is put back to what moves as given is not in its history; it ends and names rodas"
ROUTE = "stepping: 1.4e-3 of the energy of one short route is missing where 1e-3 is allowed; the run remarks it"
QUADRATURES = "1.1e-5 of the energy is missing where 1e-5 is allowed, since steps may miss that much together"
PASSED = "stepping: a core is shown 3e-5 of its largest tension below zero in the row before it goes slack, at 1e-4"
ELSEWHERE = "played by `make hard`: the tests play these laws on `rodas`, and this engine with hold"

KNOWN: tuple[tuple[str, str, str, str], ...] = (
    ("row of blocks pulled from both ends, ?00", "ida", "hold", LEDGER),
    ("ball that bounces until it lies, nine tenths", "ida", "none", BRIEF),
    ("block on a shaken table, carried", "rodas3p", "binding", QUADRATURES),
    ("random networks, 20*", "stepping", "binding", TOUCHED),
    ("random networks, 200", "rodas", "binding", CREEPS),
    ("random routes, 10", "stepping", "hold", ROUTE),
    ("body that a shaking plate throws, 8 Hz", "ida", "none", ASIDE),
    ("core that goes slack", "stepping", "hold", PASSED),
)
"""(case, engine, treatment, why); the first three as patterns."""

LEFT: tuple[tuple[str, str, str, str], ...] = (
    ("*", "stepping", "[bl]*", ELSEWHERE),
    ("node without mass that nothing determines", "ida", "lugre", SLOW),
)
"""Rows that the tests leave to `make hard`, as in KNOWN; `left_out` adds those that take long."""


MENDED: tuple[tuple[str, str, str], ...] = (
    ("random networks, 200", "rodas", "hold"),
    ("random networks, 200", "stepping", "[hl]*"),
    ("block on a shaken table, carried", "stepping", "lugre"),
)
"""Rows, as patterns, that docs/stability.md shows as failing at its commit, and that come through; none once it is made
anew."""

WORSE: tuple[tuple[str, str, str, str], ...] = ()
"""Rows that docs/stability.md shows as coming through at its commit, and that fail; as in KNOWN, where they belong once
it is made anew. None."""


def known_failure(case: str, engine: str, treatment: str) -> str:
    """Why a row fails, if that is known; else nothing."""
    return _reason((*KNOWN, *WORSE), (case, engine, treatment))


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
