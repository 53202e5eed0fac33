"""`fairlead compare`: the same scene under several treatments, as a table and a figure."""

import json
import pathlib
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated

import typer

import fairlead.cli.completion as completion
from fairlead.cli.exit_codes import MODEL_ERROR
from fairlead.cli.options import AllowFmu, AsJson, Libraries, Netlist, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.places import refuse_place
from fairlead.cli.terminal import console, echo

if TYPE_CHECKING:
    from fairlead.analysis.cost.compare import Comparison, Row

"""How the process ends when no treatment could be started."""


def compare(
    netlist: Netlist,
    settings: Settings,
    libraries: Libraries,
    vary: Annotated[
        list[str],
        typer.Option(
            metavar="NAME=A,B,C",
            help="What to vary: pad.method=hold,binding,tanh. Repeatable: all pairs.",
            autocompletion=completion.settings,
        ),
    ],
    signals: Annotated[
        str,
        typer.Option(help="Positions that the error is taken from, as a pattern.", autocompletion=completion.signals),
    ] = "*",
    out: Annotated[
        pathlib.Path | None,
        typer.Option("--out", "-o", metavar="DIR", help="Leave runs and figure here. Default: results/NAME-compare."),
    ] = None,
    max_wall: Annotated[float, typer.Option(help="Seconds after which each run is ended.")] = 60.0,
    allow_fmu: AllowFmu = False,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Run a netlist under several treatments: error against exact hold, creep, steps, switches, time."""
    import fairlead
    from fairlead.analysis.cost.compare import compare as run_all
    from fairlead.report.compare_figure import draw

    folder = out or pathlib.Path("results") / f"{pathlib.Path(netlist).stem}-compare"
    refuse_place("--out", folder, folder=True)
    found = run_all(
        lambda chosen: fairlead.load(netlist, set=chosen, libraries=libraries, allow_fmu=allow_fmu),
        parse_variations(vary),
        settings=parse_settings(settings), out=folder, signals=signals, max_wall=max_wall,
    )  # fmt: skip
    figure = draw(found, folder / "compare.png")
    if as_json:
        record = {"reference": found.reference, "figure": str(figure), "rows": [asdict(row) for row in found.rows]}
        echo(json.dumps(record, indent=2))
    elif not quiet:
        _print(found)
        echo(f"wrote {figure}")
    if all(row.status == "not started" for row in found.rows):
        raise typer.Exit(MODEL_ERROR)


def parse_variations(texts: list[str]) -> dict[str, list[str]]:
    """`["pad.method=hold,tanh"]` as `{"pad.method": ["hold", "tanh"]}`.

    Raises:
        typer.BadParameter: a text is not NAME=A,B, or has an empty value.
    """
    found = {}
    for name, text in parse_settings(texts).items():
        found[name] = [value.strip() for value in text.split(",")]
        if not all(found[name]):
            raise typer.BadParameter(f"--vary wants NAME=A,B,C without empty values; it got {text!r}.")
    return found


def _print(found: "Comparison") -> None:
    from rich import box
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for name in ("treatment", "status", "error", "creep [m/s]", "steps", "switches", "stepping [s]"):
        table.add_column(name.replace("[", "\\["), justify="left" if name in ("treatment", "status") else "right")
    for row in found.rows:
        table.add_row(*_cells(row))
    screen = console()
    screen.print(table)
    worst = sorted({row.worst for row in found.rows if row.worst})
    of = f"of the range of {', '.join(worst)}" if worst else "none can be told: nothing compared moves there"
    screen.print(f"error against {found.reference}, {of}")
    for row in found.rows:
        if row.reason:
            screen.print(f"{row.label}: {row.reason}", markup=False)


def _cells(row: "Row") -> list[str]:
    numbers = (row.error, row.creep, row.steps, row.switches, row.seconds)
    formats = ("{:.2g}", "{:.2g}", "{}", "{}", "{:.2g}")
    texts = ["-" if n is None else form.format(n) for form, n in zip(formats, numbers, strict=True)]
    return [row.label, row.status, *texts]
