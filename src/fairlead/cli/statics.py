"""`fairlead statics`: a line on its route solved for steady hauling and for standing still, without a run."""

import json
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fairlead.cli.options import AsJson, Libraries, Netlist, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.tables import finite, number, plain_table, times, wide_console
from fairlead.cli.terminal import echo

if TYPE_CHECKING:
    from rich.table import Table

ESTIMATE = "~"
HOW_FAR_OFF = (
    "is an estimate, for an array that comes from rest: runs of bundled scenes had up to 4 times the compression of "
    "the hose, where bulkheads slip (docs/routes.md, Hose and core). A margin below 4 is no evidence: take it from a "
    "run."
)


def statics(
    netlist: Netlist,
    settings: Settings,
    libraries: Libraries,
    speed: Annotated[
        str | None, typer.Option(metavar="SPEED", help="Speed of the line instead of that of the references.")
    ] = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Tensions, clamp, drives and ruck margin of a line on its route, paying out, hauling and at rest; no run."""
    import fairlead
    from fairlead.analysis.remarks.statics_record import record
    from fairlead.cli.study import number as given

    wanted = None if speed is None else given("--speed", speed, "m/s")
    model = fairlead.load(netlist, set=parse_settings(settings), libraries=libraries)
    found = [record(one) for one in model.statics(wanted)]
    if as_json:
        echo(json.dumps(finite(found), indent=2))
    elif not quiet:
        print_statics(model.netlist.name, found)


def print_statics(name: str, found: list[dict[str, Any]]) -> None:
    """A table for each state, one of the drives, and remarks."""
    console = wide_console()
    for one in found:
        several = f", {one['line']} on {one['route']}" if len(found) > 1 else ""
        for state in one["states"]:
            console.print(_title(f"{name}{several}", state), style="bold", markup=False)
            console.print(_moving(state, one["limits"]))
        console.print(_rest(f"{name}{several}", one["standing"]), style="bold", markup=False)
        console.print(_standing(one["standing"]))
        if one["drives"]:
            console.print(_drives(one["drives"]))
        if any(state["estimated"] for state in one["states"]):
            console.print(f"{ESTIMATE} {HOW_FAR_OFF}", markup=False)
        for text in one["remarks"]:
            console.print(f"note: {text}.", markup=False)


def _title(name: str, state: dict[str, Any]) -> str:
    sea = f", {state['in_sea']:.4g} m in the sea" if state["in_sea"] else ""
    return f"{name}: {_at_speed(state)}, {_way(state['paid_out'])}{sea}"


def _at_speed(state: dict[str, Any]) -> str:
    """Which way the line moves, how fast, and on which layer of its drum."""
    way, comma, layer = state["state"].partition(",")
    return f"{way} at {abs(state['speed']):.3g} m/s{comma}{layer}"


def _way(paid_out: float) -> str:
    """Line that has gone out, or come in, since the start."""
    return f"{abs(paid_out):.4g} m {'hauled in' if paid_out < 0 else 'paid out'}"


def _rest(name: str, standing: dict[str, Any]) -> str:
    text = f"{name}: standing still, {_way(standing['paid_out'])}; tensions that friction can hold"
    return text if standing["holds"] else f"{text}: none, {standing['missing']:.4g} N are missing"


def _moving(state: dict[str, Any], limits: dict[str, Any]) -> "Table":
    rows = state["stations"]
    two = any("core" in row for row in rows)
    ruck, wall = limits["ruck_force"] is not None, limits["side_wall"] is not None
    columns = ["station", "at m", "inboard N", "outboard N", "T/R N/m", *(["of limit"] if wall else [])]
    columns += (["core N", "hose N"] if two else []) + (["ruck margin"] if ruck else [])
    table = plain_table(*columns, left=2)
    for row in rows:
        cells = [row["station"], _at(row), *(number(row.get(key)) for key in ("inboard", "outboard", "side_wall"))]
        margin = row.get("side_wall_margin")
        cells += ([f"{1 / margin:.0%}" if margin else ""]) if wall else []
        slips = " slips" if row.get("bulkheads_slip") else ""
        cells += [_estimate(number(row.get("core"))), _estimate(number(row.get("hose")) + slips)] if two else []
        of_hose = _estimate if "hose" in row else str
        cells += [of_hose(times(row.get("ruck_margin")))] if ruck else []
        low = [one for one in (margin, row.get("ruck_margin")) if one is not None and one < 1]
        table.add_row(*cells, style="bold red" if low else None)
    return table


def _estimate(cell: str) -> str:
    """The text of a cell marked as an estimate."""
    return f"{ESTIMATE}{cell}" if cell.strip("- ") else cell


def _standing(standing: dict[str, Any]) -> "Table":
    table = plain_table("station", "at m", "inboard N", "outboard N", left=2)
    for row in standing["stations"]:
        table.add_row(row["station"], _at(row), *(_range(*row[key]) for key in ("inboard", "outboard")))
    return table


def _drives(rows: list[dict[str, Any]]) -> "Table":
    clamped = any(row["clamp"] is not None for row in rows)
    more = ["clamp holds N", "factor"] if clamped else []
    table = plain_table("drive", "while", "force N", "torque N m", "power W", *more, left=2)
    last = ""
    for row in sorted(rows, key=lambda row: [one["drive"] for one in rows].index(row["drive"])):
        cells = [row["drive"] if row["drive"] != last else "", row["state"]]
        cells += [number(row[key]) for key in ("force", "torque", "power")]
        cells += [number(row["clamp"]), times(row["factor"])] if clamped else []
        low = row["factor"] is not None and row["factor"] < 1.5
        table.add_row(*cells, style="bold red" if low else None)
        last = row["drive"]
    return table


def _range(low: float, high: float) -> str:
    return number(low) if low == high else f"{number(low)} ... {number(high)}"


def _at(row: dict[str, Any]) -> str:
    begin, end = (f"{row[key]:.3f}".rstrip("0").rstrip(".") for key in ("from", "to"))
    return begin if begin == end else f"{begin} ... {end}"
