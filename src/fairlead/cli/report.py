"""`fairlead report`: one page about a run or several, that opens from disk without a network."""

import pathlib
from typing import Annotated

import typer

from fairlead.cli.options import Quiet, Verbose
from fairlead.cli.places import refuse_place
from fairlead.cli.terminal import echo


def report(
    results: Annotated[
        list[pathlib.Path],
        typer.Argument(metavar="RUN...", help="Folders with results; of several, the signals are overlaid."),
    ],
    out: Annotated[
        pathlib.Path | None,
        typer.Option("--out", "-o", metavar="FILE",
                     help="Write the page here. Default: report.html in the first folder."),
    ] = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Make a page with the line moving on its route, signals, zones, maps, energy and cost of a run."""
    from fairlead.report import page
    from fairlead.results import Result

    refuse_place("--out", out, endings=(".html", ".htm"))
    runs = [Result.open(each.parent if each.is_file() else each) for each in results]
    if out is not None:
        out.parent.mkdir(parents=True, exist_ok=True)
    written = page.write(runs, out)
    if not quiet:
        echo(f"wrote {written}")
