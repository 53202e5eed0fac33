"""Lines on routes for the page: stations in their places, and which signals go along the line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from fairlead.report.page.signals import families
from fairlead.results import run_file, run_schema
from fairlead.results.signal import family

if TYPE_CHECKING:
    from fairlead.results import Result

FIRST = ("tension", "torque", "d", "slip")
"""What a line is coloured by at first: of what the plots of the netlist show, else of all, the first of these."""


def line_data(result: Result) -> list[dict[str, Any]]:
    """By line on a route: nodes, stations, the family of its positions (or None), families along it.

    Raises DamagedResultsError.
    """
    known = families(result)
    plots = (result.run.get("scene") or {}).get("plots") or ()
    asked = {family(name)[0] for plot in plots for pattern in plot["signals"] for name in result.match(pattern)}
    return [_line(record, known, asked) for record in run_schema.routes(result.named(run_file.RUN_FILE), result.run)]


def _line(record: dict[str, Any], known: dict[str, Any], asked: set[str]) -> dict[str, Any]:
    line = record["line"]
    where = f"{line}.{record['outer']}[*].x"
    along = [name for name, each in known.items()
             if name.startswith(f"{line}.") and "[*]" in name and name != where and len(each) > 2]  # fmt: skip
    return {
        "line": line, "route": record["route"], "nodes": record["nodes"], "places": record["places"],
        "layers": record["layers"], "ruck_force": record["ruck_force"], "stations": record["stations"],
        "positions": where if len(known.get(where, ())) == record["nodes"] else None,
        "along": sorted(along, key=lambda name: (name not in asked, *_rank(name, record["layers"]))),
    }  # fmt: skip


def _rank(name: str, layers: list[str]) -> tuple[int, int]:
    quantity = name.rpartition(".")[2]
    child = name.rpartition(".")[0].rpartition(".")[2].partition("[")[0]
    return FIRST.index(quantity) if quantity in FIRST else len(FIRST), 0 if child in layers[:1] else 1
