"""`fairlead margins`: how near a run came to the limits of its line, and whether it broke those of its netlist."""

import json
import pathlib
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fairlead.cli.exit_codes import LIMIT_BROKEN
from fairlead.cli.options import AsJson, Quiet, Verbose
from fairlead.cli.tables import finite, number, plain_table, times, wide_console
from fairlead.cli.terminal import echo

if TYPE_CHECKING:
    from fairlead.analysis.margins.limits_again import Judged
    from fairlead.analysis.margins.margins import LineMargins, StationMargins, Worst
    from fairlead.results import Result

NAMES = {
    "peak": "peak tension", "lowest": "lowest tension", "core": "lowest core tension", "hose": "lowest hose tension",
    "side_wall": "side-wall load", "scuffed": "scuffed on a device", "inner_scuffed": "scuffed in the hose",
    "slipped": "slid on belts, wheels", "registration": "de-registration",
}  # fmt: skip
BOTH = ("peak", "lowest")
"""Of all layers of a line together."""
UNITS = {"side_wall": "N/m", "scuffed": "m", "inner_scuffed": "m", "slipped": "m", "registration": "m"}


def margins(
    results: Annotated[pathlib.Path, typer.Argument(help="A folder with results of a run, or a file in it.")],
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Peak tensions, ruck, side-wall load and slip of a run, with time and place; 5 when a limit is broken."""
    from fairlead.analysis.margins.limits_again import judged
    from fairlead.analysis.margins.margins import margins as of_lines
    from fairlead.results import Result

    result = Result.open(results.parent if results.is_file() else results)
    lines, limits = of_lines(result), judged(result)
    broken = [_broken(one) for one in limits if one.broken]
    if as_json:
        echo(json.dumps(_record(result, lines, limits, broken), indent=2))
    elif not quiet:
        _print(result, lines, limits)
    for text in broken:
        echo(f"limit broken: {text}", err=True)
    if broken:
        raise typer.Exit(LIMIT_BROKEN)


def _broken(one: "Judged") -> str:
    return f"{one.signal} = {one.value:.6g} {one.unit} at t = {one.t:.6g} s, allowed: {one.text}"


def _print(result: "Result", lines: list["LineMargins"], limits: list["Judged"]) -> None:
    console = wide_console()
    reached = f"{result.t[-1]:.4g} s" if len(result.t) else "no row"
    console.print(f"{result.run.get('name', result.path)}: {result.status}, {reached}", style="bold", markup=False)
    if not lines:
        known = "routes" in result.run
        console.print("No line on a route was in this run." if known else "This run keeps no route: it is of an "
                      "earlier version. Run it again.")  # fmt: skip
    for line in lines:
        if len(lines) > 1:
            console.print(line.line, style="bold", markup=False)
        if line.stations:
            console.print(_by_station(line))
        console.print(_worst(line))
        for text in line.missing:
            console.print(f"note: record {text}.", markup=False)
    if limits:
        table = plain_table("limit", "allowed", "worst", "at s", "", left=2)
        for one in limits:
            cells = [one.signal, one.text, f"{one.value:.4g} {one.unit}", f"{one.t:.4g}"]
            cells.append("broken" if one.broken else "kept")
            table.add_row(*cells, style="bold red" if one.broken else None)
        console.print(table)


def _by_station(line: "LineMargins") -> Any:
    two, ruck = any(one.core for one in line.stations), line.ruck_force is not None
    slid = any(one.slipped for one in line.stations)
    columns = ["station", "lowest N", "peak N", *(["core N", "hose N"] if two else [])]
    columns += (["ruck margin"] if ruck else []) + ["T/R N/m", "scuffed m"]
    columns += (["in hose m"] if two else []) + (["slid m"] if slid else [])
    table = plain_table(*columns)
    for one in line.stations:
        margin = line.ruck_margin(one)
        cells = [one.name, *(number(_value(each)) for each in (one.lowest, one.peak))]
        cells += [number(_value(each)) for each in (one.core, one.hose)] if two else []
        cells += [times(margin)] if ruck else []
        cells += [number(_value(one.side_wall)), _length(one.scuffed)]
        cells += ([_length(one.inner_scuffed)] if two else []) + ([_length(one.slipped)] if slid else [])
        low = [each for each in (margin, line.side_wall_margin(one)) if each is not None and each < 1]
        table.add_row(*cells, style="bold red" if low else None)
    return table


def _worst(line: "LineMargins") -> Any:
    margins = {line.of_hose: line.ruck_margin(line.whole), "side_wall": line.side_wall_margin(line.whole)}
    table = plain_table("over the run", "", "margin", "at s", "where", "station")
    table.columns[4].justify = table.columns[5].justify = "left"
    for key, name in NAMES.items():
        one: Worst | None = getattr(line.whole, key)
        if one is None or (key == "hose" and line.of_hose != "hose"):
            continue
        place = "" if one.place is None else f", {one.place:.4g} m"
        signal = one.signal
        if key in BOTH and line.whole.core is not None:  # the sum, which is no signal of either
            name, signal = f"{name}, hose + core", f"{line.line}, element {signal.rpartition('[')[2].rstrip(']')}"
        value = _length(one) if UNITS.get(key) == "m" else f"{one.value:.4g}"
        table.add_row(name, f"{value} {UNITS.get(key, 'N')}", times(margins.get(key)), f"{one.t:.4g}",
                      f"{signal}{place}", station_of(line, key, one))  # fmt: skip
    return table


def station_of(line: "LineMargins", key: str, worst: "Worst") -> str:
    """The station in which the worst of all happened; nothing when it was between stations."""
    return next((one.name for one in line.stations if getattr(one, key) == worst), "")


def _value(one: "Worst | None") -> float | None:
    return None if one is None else one.value


def _length(one: "Worst | None") -> str:
    return "" if one is None else f"{one.value:.2g}" if one.value < 1 else f"{one.value:.2f}"


def _record(result: "Result", lines: list["LineMargins"], limits: list["Judged"], broken: list[str]) -> dict[str, Any]:
    def plain(line: "LineMargins", one: "StationMargins") -> dict[str, Any]:
        return {**asdict(one), "ruck_margin": line.ruck_margin(one), "side_wall_margin": line.side_wall_margin(one)}

    told = [
        {"line": line.line, "stations": [plain(line, one) for one in line.stations], "whole": plain(line, line.whole),
         "missing": line.missing}
        for line in lines
    ]  # fmt: skip
    reached = float(result.t[-1]) if len(result.t) else None
    return finite({
        "name": result.run.get("name"), "status": result.status, "reached": reached, "lines": told,
        "limits": [asdict(one) for one in limits], "limits_broken": broken,
    })  # fmt: skip
