"""Names of signals in a netlist that no signal has: what is recorded, plotted or limited in vain."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import replace

from fairlead.analysis.record.declared_signals import signals_of
from fairlead.analysis.record.gone_with_effects import gone
from fairlead.analysis.record.limits import read_limits
from fairlead.analysis.record.suggestion import inside, suggest
from fairlead.component.assembly import Assembly
from fairlead.errors import Fault, ModelError
from fairlead.netlist.limits import MOST_FAULTS
from fairlead.netlist.netlist import Value
from fairlead.patterns import picked


def unknown_signals(assembly: Assembly) -> list[Fault]:
    """Mistakes in `record` and `limits`, told from what the components declare; nothing is compiled for it."""
    signals = signals_of(assembly)
    names = {signal.name: None for signal in signals}
    unknown = [(value, text) for value, text in recorded_names(assembly) if not picked(names, text)]
    left_out = set(gone(assembly, [*(text for _, text in unknown), *assembly.netlist.limits]))
    unknown = [(value, text) for value, text in unknown if text not in left_out]
    faults = [_no_such(assembly, value, text, [*names]) for value, text in unknown[:MOST_FAULTS]]
    limits = assembly.netlist.limits.items()
    judged = {text: value for text, value in limits if not _excused(assembly, text) and text not in left_out}
    try:
        read_limits(judged, signals)
    except ModelError as error:
        ways = {f"limits.{text}: no signal": way for text in judged if (way := inside(assembly, text))}
        for one in error.faults:
            way = next((way for begin, way in ways.items() if one.what.startswith(begin)), "")
            faults.append(replace(one, way_out=f"{way} {one.way_out}".strip()))
    return faults


def recorded_names(assembly: Assembly) -> Iterator[tuple[Value, str]]:
    """The patterns under record.signals and record.plots, each with its place."""
    block = assembly.netlist.written["record"]
    lists = [block.get("signals")]
    plots = block["plots"].content if "plots" in block else []
    plots = plots if isinstance(plots, list) else []
    lists += [plot.entries.get("signals") for plot in plots]
    listed = [one.content for one in lists if one is not None and isinstance(one.content, list)]
    listed.append([along for plot in plots if (along := plot.entries.get("along")) is not None])
    for values in listed:
        for value in values:
            if isinstance(value.content, str) and not _excused(assembly, value.content):
                yield value, value.content


def _excused(assembly: Assembly, pattern: str) -> bool:
    """True when the name may be one of a component that could not be made, or of its contacts with one."""
    first = re.split(r"[.\[]", pattern)[0]
    if first in assembly.netlist.unread:
        return True
    laid = [(one, two) for one, two, _ in assembly.routings if not {one, two} & assembly.stand_ins]
    routed = {path for both in laid for path in both}
    if first in {path.split(".")[0] for path in assembly.lines if path not in routed}:
        return True
    return bool(assembly.broken) and (first in assembly.broken or any(c in first for c in "*?"))


def _no_such(assembly: Assembly, value: Value, pattern: str, names: list[str]) -> Fault:
    near, way_out = suggest(pattern, names)
    way_out = f"{inside(assembly, pattern)} {way_out}".strip()
    return Fault(value.where, f"record: no signal has the name {pattern}. {near}".rstrip(), way_out)
