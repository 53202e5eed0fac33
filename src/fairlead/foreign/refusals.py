"""What is wrong with an FMU, or with what a netlist says of one, and what went wrong in its process."""

from __future__ import annotations

from fairlead.errors import NumericalError

FAILED = b"\x1e\n"
"""What the process of an FMU puts behind all that was printed before an error, on standard error."""


class Refused(ValueError):
    """Something that cannot be used: what, as a sentence without its end, and a way out."""

    def __init__(self, what: str, way_out: str = "") -> None:
        super().__init__(what, way_out)
        self.what, self.way_out = what, way_out


class ForeignError(NumericalError):
    """The code of an FMU failed, ended, or did not come back; a sentence or two with the way out."""
