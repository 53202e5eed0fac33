"""What a run records besides, when it is to be looked at: where things are, and what the parts of a line bear.

A page that shows a line moving needs the places of its nodes, and one that shows a mechanism needs positions and
angles. Both are outputs like any other, so recording them is a matter of naming them.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from fairlead.analysis.statics.laid_route import laid_routes
from fairlead.analysis.statics.route_record import route_records
from fairlead.results.signal import family

POSITIONS = {"m": "x", "rad": "angle"}
"""By unit, the outputs that tell where something is, as the library calls them."""
OF_LINES = ("tension", "torque", "d", "slip", "angle")
"""Outputs of the parts of a line that are looked at along it, by last name."""
MOST_ADDED = 6000
"""Signals that are recorded besides; of more, only those of single parts."""


def names_to_show(model: Any) -> list[str]:
    """The signals that a page about a run of a Model wants, asked for or not. Raises ModelError."""
    wanted = _positions(model)
    for record in route_records(model.flat):
        wanted += [f"{record['line']}.{record['outer']}[{k}].x" for k in range(record["nodes"])]
        wanted += [one.name for one in model.system.signals
                   if one.name.startswith(f"{record['line']}.") and _along(one.name, record["layers"])]  # fmt: skip
    wanted += ["energy.supplied", "energy.dissipated"]
    wanted = list(dict.fromkeys(wanted))
    return wanted if len(wanted) <= MOST_ADDED else [name for name in wanted if family(name)[1] is None]


def _positions(model: Any) -> list[str]:
    """Places and angles of what stands in the netlist, and of the elements of what is made of many; not of lines."""
    lines = {laid.line.path for laid in laid_routes(model.flat)}
    found = (one for one in model.system.signals if POSITIONS.get(one.unit) == one.name.rpartition(".")[2])
    return [one.name for one in found if one.name.partition(".")[0] not in lines]


def _along(name: str, layers: list[str]) -> bool:
    """Whether a signal of a line is looked at along it: of a layer, of the fit of two, or of a contact."""
    child = name.rpartition(".")[0].rpartition(".")[2].partition("[")[0]
    kind = name.rpartition(".")[2]
    return kind in OF_LINES and (
        child in (*layers, "registration", "inner", "torsion", "twist") or child.startswith("outer")
    )


def shown_besides(model: Any) -> None:
    """Let runs of `model` record what a page wants besides what its netlist asks for. Raises ModelError."""
    record = model.netlist.record
    names = [*record.signals, *names_to_show(model)]
    model.netlist = replace(model.netlist, record=record.model_copy(update={"signals": names}))
