"""Rows that are known to fail, with the reason; the scoreboard shows them too. One that passes must leave this list."""

from __future__ import annotations

import fnmatch

JUMPED_OVER = "under a load that grows evenly it steps over the break-away: nothing bends while all holds"
ORDER_ONE = "order one where a contact is caught: switch times are rounded to steps (docs/integrator.md)"
AT_A_CORNER = "break-away at the corner of a ramp: not a finite number, whatever the step"
LEDGER = "the energy of creeping and bending contacts is missing by more than ten accuracies over long steps"

KNOWN: tuple[tuple[str, str, str, str], ...] = (
    ("stick slip at accuracy, 1e-[56789]", "stepping", "hold", ORDER_ONE),
    ("stick slip at accuracy, 1e-10", "stepping", "hold", ORDER_ONE),
    ("blocks let go in one instant, *", "stepping", "hold", JUMPED_OVER),
    ("load grows for an hour until it lets go", "stepping", "hold", JUMPED_OVER),
    ("blocks let go in one instant with a jump, *", "stepping", "binding", ORDER_ONE),
    ("blocks stop in one instant, *", "stepping", "binding", LEDGER),
    ("load grows for an hour until it lets go", "stepping", "lugre", LEDGER),
    ("load grows for an hour until it lets go", "rodas3p", "lugre", LEDGER),
    ("load comes up to stiction and stays, exactly", "rodas", "binding", AT_A_CORNER),
)
"""(case, engine, treatment, why); cases and treatments as patterns."""


def known_failure(case: str, engine: str, treatment: str) -> str:
    """Why a row fails, if that is known; else nothing."""
    for pattern, its_engine, its_treatment, reason in KNOWN:
        if engine == its_engine and fnmatch.fnmatch(case, pattern) and fnmatch.fnmatch(treatment, its_treatment):
            return reason
    return ""
