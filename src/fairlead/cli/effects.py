"""`fairlead effects`: what each effect of a scene costs and what it changes, as a table and a sentence each."""

import json
import pathlib
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fairlead.cli.exit_codes import INTERRUPTED
from fairlead.cli.options import AllowFmu, AsJson, Libraries, Netlist, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.places import refuse_place
from fairlead.cli.study import Budget, Fresh, Outputs, number, print_table, say, write_record
from fairlead.cli.terminal import echo

if TYPE_CHECKING:
    from fairlead.analysis.effects.effect_row import Row, Size
    from fairlead.analysis.effects.effects import Effects

COLUMNS = (
    "switched", "unknowns", "terms", "zones", "guards", "kernels", "switches", "CPU", "saved", "changes by", "as",
    "of", "in the start",
)  # fmt: skip

BARELY = 0.05  # of the time of a run: what was judged over less is said to be that


def effects(
    netlist: Netlist,
    settings: Settings,
    libraries: Libraries,
    budget: Budget = "60 s",
    outputs: Outputs = None,
    begin: Annotated[
        str | None, typer.Option("--from", metavar="TIME", help="Judge from here on. Default: after a tenth.")
    ] = None,
    end: Annotated[
        str | None, typer.Option("--to", metavar="TIME", help="Run and judge to here. Default: what the budget allows.")
    ] = None,
    fresh: Fresh = False,
    out: Annotated[
        pathlib.Path | None,
        typer.Option("--out", "-o", metavar="DIR", help="effects.json goes here. Default: results/NAME-effects."),
    ] = None,
    allow_fmu: AllowFmu = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Switch each effect of a scene: what it costs, what it changes, and what could be left out."""
    import fairlead
    from fairlead.analysis.cost.kept_runs import KeptRuns, default_folder
    from fairlead.analysis.effects.effects import effects as switch_all

    refuse_place("--out", out or pathlib.Path("results") / f"{pathlib.Path(netlist).stem}-effects", folder=True)
    fixed = parse_settings(settings)
    found = switch_all(
        lambda more: fairlead.load(netlist, set={**fixed, **more}, libraries=libraries, allow_fmu=allow_fmu),
        budget=number("--budget", budget, "s"), signals=outputs or ["*"],
        kept=KeptRuns(None if fresh else default_folder()), libraries=libraries,
        note=None if quiet or as_json else say, window=(_moment("--from", begin), _moment("--to", end)),
    )  # fmt: skip
    folder = out or pathlib.Path("results") / f"{found.name}-effects"
    record = _record(found)
    written = write_record(folder, "effects.json", record)
    if as_json:
        echo(json.dumps(record, indent=1))
    elif not quiet:
        _print(found)
        echo(f"wrote {written} (every output by itself)")
    if found.interrupted:
        raise typer.Exit(INTERRUPTED)


def _moment(option: str, text: str | None) -> float | None:
    """A time of the run, which may be zero."""
    return None if text is None else number(option, text, "s", zero=True)


def _print(found: "Effects") -> None:
    from fairlead.analysis.cost.choice import percent

    first = ["the scene as it is", *_sizes(found.size), str(found.base.switches), _time(found.base.cpu)]
    empty = [""] * (len(COLUMNS) - len(first))
    console = print_table(COLUMNS, ("switched", "as", "of"), ([*first, *empty], *map(_cells, found.rows)), 170)
    cut = "" if found.whole else f"; run is to {found.span[1]:g} s, --to or a larger --budget takes more"
    console.print(f"Judged is t = {found.begin:g} ... {found.span[1]:g} s, the start before that apart{cut}.")
    if 0 < found.studied < BARELY:
        told = f"That is {percent(found.studied)} of the run: what is said below may be otherwise later."
        console.print(f"{told} Give a larger --budget, or --to.")
    for row in found.rows:
        console.print(row.sentence, markup=False)
    if found.untouched:
        console.print(f"Nothing in the scene is concerned by: {', '.join(found.untouched)}.", markup=False)
    if found.left_out:
        missing = ", ".join(found.left_out)
        console.print(f"Not judged for lack of time: {missing}. The same command goes on from here.", markup=False)


def _cells(row: "Row") -> list[str]:
    from fairlead.analysis.cost.choice import percent

    sizes = _sizes(row.size) if row.size is not None else [""] * 5
    if row.change is None or row.saved is None:
        return [row.switch.label, *sizes, row.timed.status, *[""] * (len(COLUMNS) - 7)]
    return [
        row.switch.label, *sizes, str(row.timed.switches), _time(row.timed.cpu),
        f"{100 * row.saved:.0f} %" if row.measurable else "same",
        percent(row.change), row.worst.measure if row.worst is not None else "",
        row.most.name if row.most is not None else "",
        percent(row.worst_starting.value) if row.worst_starting is not None else "",
    ]  # fmt: skip


def _sizes(size: "Size") -> list[str]:
    return [str(one) for one in (size.unknowns, size.entries, size.zones, size.guards, size.kernels)]


def _time(value: float) -> str:
    from fairlead.analysis.cost.choice import seconds

    return seconds(value)


def _record(found: "Effects") -> dict[str, Any]:
    from dataclasses import asdict

    rows = [
        {
            "name": row.switch.name, "now": row.switch.now, "then": row.switch.then, "kind": row.switch.kind,
            "settings": dict(row.switch.settings), "size": asdict(row.size) if row.size else None,
            "saved": row.saved, "change": row.change, "of": row.most.name if row.most else None,
            "measure": row.worst.measure if row.worst else None, "sentence": row.sentence, "run": row.timed.plain(),
            "outputs": [asdict(one) for one in row.changes], "start": [asdict(one) for one in row.starting],
        }
        for row in found.rows
    ]  # fmt: skip
    return {
        "name": found.name, "span": found.span, "begin": found.begin, "whole": found.whole,
        "floors": {f"{name} {measure}": value for (name, measure), value in found.floors.items()},
        "interrupted": found.interrupted, "untouched": found.untouched, "left_out": found.left_out,
        "size": asdict(found.size), "run": found.base.plain(), "rows": rows,
    }  # fmt: skip
