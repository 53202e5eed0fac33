"""Refuses to write down more than anybody can want."""

from __future__ import annotations

from fairlead.errors import Fault, Location
from fairlead.netlist.netlist import Netlist
from fairlead.netlist.settings import RunSettings

MOST_ROWS = 20_000_000  # at one signal 320 MB; more is a slip of the unit, and fills the disk


def unreasonable(netlist: Netlist, settings: RunSettings) -> list[Fault]:
    """A recording grid with more rows than can be meant, told with its number of rows."""
    every = netlist.record.every
    rows = (settings.stop - settings.start) / every if every else 0.0
    if rows <= MOST_ROWS:
        return []
    what = f"record.every = {every:g} s makes {rows:.3g} rows in {settings.stop - settings.start:g} s."
    return [Fault(Location(str(netlist.path)), what, f"At most {MOST_ROWS} rows; record less often, or stop earlier.")]
