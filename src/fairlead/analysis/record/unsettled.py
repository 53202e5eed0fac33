"""Zones that do not settle since a contact of method karnopp cannot take its slip to zero: what to write instead.

Inside its band such a contact takes the slip to zero, but friction gives no impulse. Where a relation of positions or
another contact keeps the body moving, as at the dead centre of a crank, it sticks and lets go again at once.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from fairlead.analysis.record.chattering import MOST_NAMED
from fairlead.errors import listing
from fairlead.system.compiled.system import System

BANDED = "karnopp"
CAUSE = re.compile("Two laws contradict each other|Its zones have no consistent choice")
"""Where the cause and the way out begin in the sentence of a run that ends so (`integrate/sentences.py`)."""


def with_way_out(sentence: str, system: System, engine: str, cycling: Iterable[str]) -> str:
    """The sentence of the run, of which `cycling` are the contacts; as it is where none of them is of this method."""
    wanted = set(cycling)
    if engine == "ida" and (shaken := sorted(wanted.intersection(system.on_given_motion))):
        why = "lie on what moves as given, to which ida does not bring bodies back"
        return f"{CAUSE.split(sentence)[0]}Bodies at {listing(shaken[:MOST_NAMED])} {why}. Take run.engine: rodas."
    banded = [instance.path for instance in system.flat.instances
              if instance.path in wanted and getattr(instance.type, "word", "") == BANDED]  # fmt: skip
    if not banded:
        return sentence
    told, its = listing(banded[:MOST_NAMED]), "its band" if len(banded) == 1 else "their bands"
    positions = any(block.kernel.structure.positions for block in system.blocks)
    keeps = "a relation of positions, as that of a crank or a cam, or " if positions else ""
    return (
        f"{CAUSE.split(sentence)[0]}{told} should stick inside {its} (method: {BANDED}), but {keeps}what else is "
        f"held there keeps the slip going. Write method: hold for {told}, or binding."
    )
