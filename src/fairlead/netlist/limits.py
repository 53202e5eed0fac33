"""How large a netlist may be, checked while its events stream in, before anything is composed.

A netlist of 3000 blocks written out in full has about 1 MB and 100 000 nodes. The bounds leave room above
that, and keep the worst input (nested aliases, a million anchors, a disk image) to a message within seconds.
"""

from __future__ import annotations

from dataclasses import dataclass

from fairlead.errors import FairleadError, Fault, Location

MOST_BYTES = 4_000_000
MOST_FILES = 64
MOST_ALIASES = 1000
MOST_NODES = 400_000
DEEPEST = 64
MOST_FAULTS = (
    200  # of one sort in one file: nobody mends more in one go, and each costs a search for a suggestion
)


class TooMuch(FairleadError):
    """A bound is passed; reading stops here, since what follows may be endless."""

    def __init__(self, fault: Fault) -> None:
        super().__init__(fault)
        self.fault = fault


@dataclass
class Meter:
    """Counts what all files of a scene use up; each method raises TooMuch where a bound is passed."""

    files: int = 0
    bytes: int = 0
    nodes: int = 0
    anchors: int = 0
    aliases: int = 0

    def file(self, where: Location, size: int) -> None:
        """Count one file of `size` bytes."""
        self.files += 1
        self.bytes += size
        if self.files > MOST_FILES or self.bytes > MOST_BYTES:
            advice = f"All files of a scene together are at most {MOST_FILES}, and {MOST_BYTES / 1e6:g} MB."
            raise TooMuch(Fault(where, "this is one file too many", advice))

    def node(self, where: Location, depth: int) -> None:
        """Count one node at a nesting depth."""
        self.nodes += 1
        self._fathom(where, depth)
        self._weigh(where)

    def anchor(self, where: Location) -> None:
        """Count one anchor (`&name`)."""
        self.anchors += 1
        if self.anchors > MOST_ALIASES:
            raise TooMuch(Fault(where, f"more than {MOST_ALIASES} anchors (&name)"))

    def alias(self, where: Location, size: int, depth: int) -> None:
        """Count one alias (`*name`), which stands for `size` nodes and reaches down to `depth`."""
        self.aliases += 1
        if self.aliases > MOST_ALIASES:
            raise TooMuch(Fault(where, f"more than {MOST_ALIASES} aliases (*name)"))
        self.nodes += size
        self._fathom(where, depth)
        self._weigh(where)

    def _fathom(self, where: Location, depth: int) -> None:
        if depth > DEEPEST:
            raise TooMuch(Fault(where, f"nested more than {DEEPEST} levels deep"))

    def _weigh(self, where: Location) -> None:
        if self.nodes > MOST_NODES:
            advice = "Aliases count for all they stand for."
            raise TooMuch(Fault(where, f"more than {MOST_NODES} values in a netlist", advice))
