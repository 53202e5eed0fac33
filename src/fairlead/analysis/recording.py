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
    written = netlist.recorded.get("every")
    where = written.where if written is not None else Location(str(netlist.path))
    return [Fault(where, what, f"At most {MOST_ROWS} rows; record less often, or stop earlier.")]


def sparse(netlist: Netlist) -> list[Fault]:
    """A remark on a recording grid that is longer than the run, in which nothing but both ends is recorded."""
    every, lasts = netlist.record.every, netlist.run.stop - netlist.run.start
    written = netlist.recorded.get("every")
    if every is None or every <= lasts or written is None:
        return []
    what = f"record.every = {every:g} s is longer than the run of {lasts:g} s, of which only both ends are recorded."
    return [Fault(written.where, what, "Record more often, or leave it out to have every step.")]
