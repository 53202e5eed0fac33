"""What a run keeps of its scene in `run.json`, so that a report shows it as its user wrote it, without the netlist.

    scene    the files as they were read, values given from outside, parameters, components, connections, plots
    zones    the zones of everything that changes zone, and in which each was at the start
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

from fairlead.flatten.flat_model import FlatModel
from fairlead.netlist.netlist import Netlist
from fairlead.results.signal import family

MOST_TEXT = 400_000
"""Letters of a file that are kept; a longer one (of tables) is kept up to there, and says so."""


def scene_record(netlist: Netlist, flat: FlatModel) -> dict[str, Any]:
    """The scene at the level of the netlist; texts and plain values only."""
    anchored = {one.path for one in flat.instances if one.type.answers.prescribes is not None}
    domains = {join.where: _domain(flat, join.ports[0]) for join in flat.assembly.joins}
    return {
        "files": {name: _shortened(text) for name, text in netlist.texts.items()},
        "set": dict(netlist.given),
        "parameters": {name: value.plain() for name, value in netlist.parameters.items()},
        "components": {
            one.name: {"type": one.type, "line": one.where.line, "file": one.where.file, "fixed": one.name in anchored,
                       "parameters": {name: value.plain() for name, value in one.parameters.items()}}
            for one in netlist.components.values()
        },
        "connections": [
            {"ends": [end.text for end in ends], "domain": domains.get(ends[0].where, "")}
            for ends in netlist.connections
        ],
        "effects": {name: value.plain() for name, value in netlist.effects.items()},
        "friction": {name: value.plain() for name, value in netlist.friction.items()},
        "plots": [{"title": plot.title or ", ".join(plot.signals), "signals": list(plot.signals)}
                  for plot in netlist.record.plots],
    }  # fmt: skip


def _shortened(text: str) -> str:
    return text if len(text) <= MOST_TEXT else f"{text[:MOST_TEXT]}\n... and {len(text) - MOST_TEXT} more letters"


def _domain(flat: FlatModel, port: Any) -> str:
    """`rotational`, `signal`, ...; the first port of a connection tells it."""
    declared = flat.assembly.instances[port.instance].type.declaration.ports.get(port.port)
    return "signal" if declared is None else str(declared.domain.name)


def zone_record(names: Sequence[str], zones: Sequence[Sequence[str]], start: Iterable[int]) -> list[dict[str, Any]]:
    """What changes zone, elements of a line together: `family`, `zones`, `elements`, `start` by element.

    `names` and `zones` tell what changes zone and its zones, `start` the number of the zone each is in at first. Who
    has one zone only is left out.
    """
    found: dict[tuple[str, tuple[str, ...]], dict[str, Any]] = {}
    for name, has, first in zip(names, zones, start, strict=True):
        if len(has) > 1:
            one, number = family(name)
            entry: dict[str, Any] = {"family": one, "zones": list(has), "elements": [], "start": []}
            entry = found.setdefault((one, tuple(has)), entry)
            entry["elements"].append(number)
            entry["start"].append(int(first))
    return list(found.values())
