"""Remarks on what is recorded."""

from __future__ import annotations

from fairlead.errors import Fault
from fairlead.netlist.netlist import Netlist


def sparse(netlist: Netlist) -> list[Fault]:
    """A remark on a recording grid that is longer than the run, in which nothing but both ends is recorded."""
    every, lasts = netlist.record.every, netlist.run.stop - netlist.run.start
    written = netlist.written["record"].get("every")
    if every is None or every <= lasts or written is None:
        return []
    what = f"record.every = {every:g} s is longer than the run of {lasts:g} s, of which only both ends are recorded."
    return [Fault(written.where, what, "Record more often, or leave it out to have every step.")]
