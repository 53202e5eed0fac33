"""`fairlead modes`: a model linearised in its zones: frequencies, damping, who takes part, responses, squeal."""

import json
import pathlib
from typing import TYPE_CHECKING, Annotated

import typer

import fairlead.cli.completion as completion
from fairlead.cli.options import AsJson, Libraries, Netlist, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.places import FIGURES, place, refuse_place
from fairlead.cli.terminal import echo
from fairlead.errors import UsageError, shown

if TYPE_CHECKING:
    from fairlead.studies.modes.table import Modes


def modes(
    netlist: Netlist,
    settings: Settings,
    libraries: Libraries,
    at: Annotated[str, typer.Option(metavar="TIME", help="Run until then. Default: the settled start.")] = "",
    zones: Annotated[
        list[str] | None,
        typer.Option(metavar="PART=ZONE", help="Freeze in zones: 'pad=held,c*=sliding'. Repeatable."),
    ] = None,
    acting: Annotated[
        str, typer.Option("--in", metavar="WHERE", help="A force at a part or port, or a free signal input.")
    ] = "",
    out: Annotated[
        str, typer.Option(metavar="SIGNAL", help="Whose answer over frequency.", autocompletion=completion.signals)
    ] = "",
    frequencies: Annotated[str, typer.Option(metavar="LOW:HIGH", help="Range of the response [Hz].")] = "",
    change: Annotated[
        int, typer.Option(metavar="K", min=0, help="All patterns with up to K contacts changed, least damped first.")
    ] = 0,
    plot: Annotated[pathlib.Path | None, typer.Option(metavar="FILE", help="Draw it: PNG, SVG or PDF.")] = None,
    csv: Annotated[pathlib.Path | None, typer.Option(metavar="FILE", help="Write the modes here as well.")] = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Linearise a model with its zones frozen: modes with frequency and damping, who takes part, where it squeals."""
    import fairlead
    from fairlead.cli.tables import finite
    from fairlead.studies.modes.modes import modes as study
    from fairlead.studies.modes.told import as_csv, record_of

    refuse_place("--plot", plot, endings=FIGURES)
    refuse_place("--csv", csv)
    model = fairlead.load(netlist, set=parse_settings(settings), libraries=libraries)
    found = study(model, at or None, _zones(zones or []), acting=acting, out=out, frequencies=_range(frequencies),
                  change=change)  # fmt: skip
    written = [path for path in (plot, csv) if path is not None]
    if plot is not None:
        from fairlead.studies.modes.picture import draw

        draw(found, plot)
    if csv is not None:
        place(csv, as_csv(found))
    if as_json:
        echo(json.dumps(finite(record_of(found)), indent=2))
    elif not quiet:
        _print(found)
        for path in written:
            echo(f"wrote {path}")


def _zones(texts: list[str]) -> dict[str, str]:
    """`["pad=held,c*=sliding"]` by name. Raises UsageError for what is no NAME=ZONE, or a name that comes twice."""
    found: dict[str, str] = {}
    for one in (one.strip() for text in texts for one in text.split(",")):
        name, equals, zone = (part.strip() for part in one.partition("="))
        if not (name and equals and zone):
            raise UsageError(f"--zones {shown(one)}: PART=ZONE is wanted, such as --zones pad=held.")
        if name in found:
            raise UsageError(f"--zones gives {shown(name)} twice: {shown(found[name])} and {shown(zone)}.")
        found[name] = zone
    return found


def _range(text: str) -> tuple[str, str] | None:
    if not text:
        return None
    low, colon, high = (part.strip() for part in text.partition(":"))
    if not (low and colon and high):
        raise UsageError(f"--frequencies {shown(text)}: LOW:HIGH is wanted, such as --frequencies 0.1:100.")
    return low, high


def _print(found: "Modes") -> None:
    from fairlead.cli.study import print_table
    from fairlead.studies.modes.table import COLUMNS, MOST_ROWS, RANKED, cells, notes, ranked_cells

    echo(f"{found.model} at {found.t:.6g} s")
    for line in notes(found):
        echo(line)
    if found.modes:
        rows = (cells(k, one) for k, one in enumerate(found.modes[:MOST_ROWS], 1))
        print_table(COLUMNS, COLUMNS[-1:], rows, 140)
    else:
        echo("There is no mode: nothing that is free to move swings, creeps back or runs away.")
    if len(found.modes) > MOST_ROWS:
        echo(f"... and {len(found.modes) - MOST_ROWS} more")
    if found.patterns:
        print_table(RANKED, (RANKED[0], RANKED[-1]), map(ranked_cells, found.patterns[:MOST_ROWS]), 140)
