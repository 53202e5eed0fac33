"""Remarks on what is recorded."""

from __future__ import annotations

from fairlead.analysis.record.gone_with_effects import gone, switched
from fairlead.analysis.record.names import recorded_names
from fairlead.component.assembly import Assembly
from fairlead.errors import Fault, listing
from fairlead.netlist.netlist import Netlist


def sparse(netlist: Netlist) -> list[Fault]:
    """A remark on a recording grid that is longer than the run, in which nothing but both ends is recorded."""
    every, lasts = netlist.record.every, netlist.run.stop - netlist.run.start
    written = netlist.written["record"].get("every")
    if every is None or every <= lasts or written is None:
        return []
    what = f"record.every = {every:g} s is longer than the run of {lasts:g} s, of which only both ends are recorded."
    return [Fault(written.where, what, "Record more often, or leave it out to have every step.")]


def left_out(assembly: Assembly) -> list[Fault]:
    """A remark on names in `record` and `limits` that are no signals with the effects and values that are given."""
    places = {text: value.where for value, text in recorded_names(assembly)}
    places |= {text: value.where for text, value in assembly.netlist.limits.items()}
    if not (found := gone(assembly, places)):
        return []
    if not switched(assembly.netlist):
        what = f"{listing(found, 3)}: no signal with the values as they are, so left out of record and limits."
        return [Fault(places[found[0]], what, "The part has it with other values or effects, see `fairlead describe`.")]
    by = listing(switched(assembly.netlist), 3)
    what = f"{listing(found, 3)}: no signal with the effects as they are switched, so left out of record and limits."
    return [Fault(places[found[0]], what, f"What is switched: {by}. Without that they are there again.")]
