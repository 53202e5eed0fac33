"""Which engine `run.engine: auto` takes, and why: by the laws, the number of contacts and the accuracy asked for."""

from __future__ import annotations

from typing import Literal

STEPPING_FROM: tuple[tuple[float, int], ...] = ((1e-6, 100),)
"""(accuracy, contacts): at this accuracy and looser ones `stepping` keeps what is asked and is the faster engine from
so many contacts on. Measured by `benchmarks/engine_choice.py` on the belt and the chains, which allow ten contacts from
1e-4 on; there what is gained are milliseconds, and what is lost the instants of the switches."""


def choose(contacts: int, linear: bool, accuracy: float) -> tuple[Literal["rodas", "stepping"], str]:
    """The engine for a run, and the reason; `contacts` hold exactly, `linear` are the laws between switches.

    Between two accuracies of the table the tighter one counts: who keeps that keeps a looser one too.
    """
    if contacts > 0 and not linear:
        return "rodas", "auto: it locates every switch, and the laws are not linear between switches"
    measured = [row for row in STEPPING_FROM if row[0] <= accuracy * (1 + 1e-9)]
    if not measured or contacts < max(measured)[1]:
        return "rodas", "auto: it locates every switch, and serves every law"
    return "stepping", f"auto: {contacts} contacts that hold exactly, laws linear between switches"
