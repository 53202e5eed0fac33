"""`fairlead effects`: what each effect of a scene costs and what it changes, as a table and a sentence each."""

import json
import pathlib
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fairlead.cli.cost import INTERRUPTED, number, say
from fairlead.cli.options import AsJson, Libraries, Netlist, Quiet, Settings, Verbose, parse_settings

if TYPE_CHECKING:
    from fairlead.analysis.effects import Effects, Row, Size

COLUMNS = (
    "switched", "unknowns", "terms", "zones", "guards", "kernels", "switches", "CPU", "saved", "changes by", "of",
    "peak",
)  # fmt: skip


def effects(
    netlist: Netlist,
    settings: Settings,
    libraries: Libraries,
    budget: Annotated[str, typer.Option(metavar="TIME", help="Time the study may take.")] = "60 s",
    outputs: Annotated[
        list[str] | None, typer.Option("--output", metavar="PATTERN", help="Recorded outputs to compare. Repeatable.")
    ] = None,
    fresh: Annotated[bool, typer.Option("--fresh", help="Do not use runs kept from an earlier study.")] = False,
    out: Annotated[
        pathlib.Path | None, typer.Option(metavar="DIR", help="effects.json goes here. Default: results/NAME-effects.")
    ] = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Switch each effect of a scene: what it costs, what it changes, and what could be left out."""
    import fairlead
    from fairlead.analysis.effects import effects as switch_all
    from fairlead.analysis.kept_runs import KeptRuns, default_folder

    fixed = parse_settings(settings)
    found = switch_all(
        lambda more: fairlead.load(netlist, set={**fixed, **more}, libraries=libraries),
        budget=number("--budget", budget, "s"), signals=outputs or ["*"],
        kept=KeptRuns(None if fresh else default_folder()), libraries=libraries,
        note=None if quiet or as_json else say,
    )  # fmt: skip
    folder = out or pathlib.Path("results") / f"{found.name}-effects"
    folder.mkdir(parents=True, exist_ok=True)
    record = _record(found)
    (folder / "effects.json").write_text(json.dumps(record, indent=1) + "\n", encoding="utf-8")
    if as_json:
        typer.echo(json.dumps(record, indent=1))
    elif not quiet:
        _print(found)
        typer.echo(f"wrote {folder / 'effects.json'} (every output by itself)")
    if found.interrupted:
        raise typer.Exit(INTERRUPTED)


def _print(found: "Effects") -> None:
    from rich import box
    from rich.console import Console
    from rich.table import Table

    console = Console(highlight=False, width=None if typer.get_text_stream("stdout").isatty() else 170)
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for name in COLUMNS:
        table.add_column(name, justify="left" if name in ("switched", "of") else "right")
    table.add_row("the scene as it is", *_sizes(found.size), str(found.base.switches), _time(found.base.cpu))
    for row in found.rows:
        table.add_row(*_cells(row))
    console.print(table)
    if not found.whole:
        console.print(f"Studied is t = {found.span[0]:g} ... {found.span[1]:g} s only, to keep within the budget.")
    for row in found.rows:
        console.print(row.sentence, markup=False)
    if found.left_out:
        console.print(f"Not begun: {', '.join(found.left_out)}. The same command goes on from here.", markup=False)


def _cells(row: "Row") -> list[str]:
    from fairlead.analysis.choice import percent

    sizes = _sizes(row.size) if row.size is not None else [""] * 5
    if row.change is None or row.saved is None:
        return [row.switch.label, *sizes, row.timed.status]
    return [
        row.switch.label, *sizes, str(row.timed.switches), _time(row.timed.cpu), f"{100 * row.saved:.0f} %",
        percent(row.change), row.most.name if row.most is not None else "", percent(row.peak),
    ]  # fmt: skip


def _sizes(size: "Size") -> list[str]:
    return [str(one) for one in (size.unknowns, size.entries, size.zones, size.guards, size.kernels)]


def _time(value: float) -> str:
    from fairlead.analysis.choice import seconds

    return seconds(value)


def _record(found: "Effects") -> dict[str, Any]:
    from dataclasses import asdict

    rows = [
        {
            "name": row.switch.name, "now": row.switch.now, "then": row.switch.then, "kind": row.switch.kind,
            "settings": dict(row.switch.settings), "size": asdict(row.size) if row.size else None,
            "saved": row.saved, "change": row.change, "of": row.most.name if row.most else None, "peak": row.peak,
            "sentence": row.sentence, "run": row.timed.plain(), "outputs": [asdict(one) for one in row.errors],
        }
        for row in found.rows
    ]  # fmt: skip
    return {
        "name": found.name, "span": found.span, "whole": found.whole, "floor": found.floor,
        "interrupted": found.interrupted, "left_out": found.left_out, "size": asdict(found.size),
        "run": found.base.plain(), "rows": rows,
    }  # fmt: skip
