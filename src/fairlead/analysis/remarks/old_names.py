"""Remarks on outputs that a netlist calls by a name they no longer have; it still works."""

from __future__ import annotations

from collections.abc import Iterator

from fairlead.analysis.record.declared_signals import signals_of
from fairlead.analysis.record.names import recorded_names
from fairlead.component.assembly import Assembly
from fairlead.errors import Fault, Location
from fairlead.patterns import as_today
from fairlead.renamed import of_today


def old_names(assembly: Assembly) -> list[Fault]:
    """A remark for each, with the name of today."""
    suspects = [(where, text) for where, text in _named(assembly) if of_today(text)]
    known = {signal.name: None for signal in signals_of(assembly)} if suspects else {}
    found = {(where, text): as_today(known, text) for where, text in suspects}
    return [
        Fault(where, f"{text} is called {_or(today)} now; the old name still works.", f"Write {_or(today)}.")
        for (where, text), today in found.items()
        if today
    ]


def _or(names: list[str]) -> str:
    return " or ".join(names)


def _named(assembly: Assembly) -> Iterator[tuple[Location, str]]:
    """What the netlist records, limits, hands out and joins, with its place."""
    netlist = assembly.netlist
    yield from ((value.where, text) for value, text in recorded_names(assembly))
    yield from ((value.named_at, text) for text, value in netlist.limits.items())
    for end in (end for ends in netlist.connections for end in ends):
        owner, _, last = end.text.rpartition(".")
        has = assembly.instances[owner].type.declaration if owner in assembly.instances else None
        if has is None or last not in {**has.ports, **has.inputs}:
            yield end.where, end.text
