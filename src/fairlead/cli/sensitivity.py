"""`fairlead sensitivity`: derivatives of figures to parameters, or the switch that leaves a figure without one."""

import json
import pathlib
from typing import TYPE_CHECKING, Annotated

import typer

import fairlead.cli.completion as completion
from fairlead.cli.options import AsJson, Libraries, Netlist, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.places import place, refuse_place
from fairlead.cli.terminal import echo
from fairlead.errors import UsageError, shown

if TYPE_CHECKING:
    from fairlead.cases.figures import Function
    from fairlead.studies.sensitivities.table import Sensitivities


def sensitivity(
    netlist: Netlist,
    settings: Settings,
    libraries: Libraries,
    of: Annotated[
        list[str] | None,
        typer.Option(metavar="FIGURE", help="peak(block.x), NAME=FIGURE, file.py:f. Repeatable. Default: of a sweep."),
    ] = None,
    to: Annotated[
        list[str] | None,
        typer.Option(
            metavar="NAMES",
            help="Parameters: mu,pad.normal_force, or NAME=SIZE of one that is 0. Repeatable.",
            autocompletion=completion.parameters,
        ),
    ] = None,
    max_steps: Annotated[int | None, typer.Option(min=1, help="Steps after which a run ends.")] = None,
    csv: Annotated[pathlib.Path | None, typer.Option(metavar="FILE", help="Write the table here as well.")] = None,
    as_json: AsJson = False,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Tell how figures of a run change with parameters: derivative, elasticity, error; or where the outcome jumps."""
    import fairlead
    from fairlead.cli.study import say
    from fairlead.cli.tables import finite
    from fairlead.studies.sensitivities.sensitivity import sensitivity as study
    from fairlead.studies.sensitivities.told import as_csv, record_of

    refuse_place("--csv", csv)
    model = fairlead.load(netlist, set=parse_settings(settings), libraries=libraries)
    found = study(model, _figures(of or []), _parameters(to or []), max_steps=max_steps, told=None if quiet else say)
    if csv is not None:
        place(csv, as_csv(found))
    if as_json:
        echo(json.dumps(finite(record_of(found)), indent=2))
    elif not quiet:
        _print(found)
        if csv is not None:
            echo(f"wrote {csv}")


def _figures(texts: list[str]) -> "dict[str, str | Function] | None":
    from fairlead.studies.sweeps.plan import figures_of_options

    return figures_of_options(texts, "--of") or None


def _parameters(texts: list[str]) -> dict[str, str | None] | None:
    """`["mu,speed", "offset=1 mm"]` as names with sizes. Raises UsageError for a name that comes twice."""
    found: dict[str, str | None] = {}
    for one in (one for text in texts for one in text.split(",") if one.strip()):
        name, _, size = (part.strip() for part in one.partition("="))
        if name in found:
            raise UsageError(f"--to names {shown(name)} twice.")
        found[name] = size or None
    return found or None


def _print(found: "Sensitivities") -> None:
    from fairlead.cli.study import print_table
    from fairlead.studies.sensitivities.table import COLUMNS, cells, notes

    print_table(COLUMNS, COLUMNS[:2], map(cells, found), 140)
    for line in notes(found):
        echo(line)
    echo(f"{found.runs} runs")
