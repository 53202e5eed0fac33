"""What of a System an engine works on: what is kept of it, what changes end that, and what is entrained."""

from __future__ import annotations

from typing import NamedTuple

from fairlead.system.active.entrained import Entrained
from fairlead.system.active.rest import Booleans, Integers


class Moving(NamedTuple):
    """What moves and a margin around it."""

    kept: Booleans
    """By unknown."""
    laws: list[Booleans]
    """By block: its instances that have to do with what is kept."""
    watched: list[Booleans]
    """By block: those that are monitored only: they say when what is left out no longer can be."""
    machines: Integers
    """Theirs."""
    boundary: Booleans
    """By machine of the whole: its change may set in motion what is not kept."""
    carried: Entrained

    @property
    def sure(self) -> bool:
        """True if what is left out cannot move by itself, however little the run has shown yet."""
        return bool(len(self.carried.unknowns))
