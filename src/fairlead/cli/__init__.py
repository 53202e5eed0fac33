"""The command `fairlead`: one file per verb, each a thin caller of the Python API.

Exit codes are in `exit_codes.py`. Results go to standard output, progress, warnings and errors to
standard error. A verb imports what it needs when it runs, so that `--help` stays quick.
"""

import io
import os
import sys

import typer

from fairlead.cli import (
    check,
    compare,
    cost,
    describe,
    doctor,
    effects,
    fit,
    fmu,
    friction,
    graph,
    margins,
    modes,
    new,
    plot,
    report,
    run,
    schema,
    sensitivity,
    statics,
    sweep,
)  # fmt: skip
from fairlead.cli.terminal import echo
from fairlead.cli.verb import Verb, Verbs

__all__ = ["app", "main"]

app = typer.Typer(
    name="fairlead",
    cls=Verbs,
    help="System models in which dry friction sticks and slips at many places at once.",
    epilog="Start with: fairlead run single_bend --report",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
for verb in (
    check.check, describe.describe, graph.graph, statics.statics, run.run, report.report, plot.plot, friction.friction,
    margins.margins, compare.compare, sweep.sweep, fit.fit, sensitivity.sensitivity, modes.modes, cost.cost,
    effects.effects, fmu.fmu, schema.schema, new.new, doctor.doctor,
):  # fmt: skip
    app.command(cls=Verb)(verb)


def _print_version(wanted: bool) -> None:
    if wanted:
        import importlib.metadata

        echo(f"fairlead {importlib.metadata.version('fairlead')}")
        raise typer.Exit


@app.callback()
def _options(
    version: bool = typer.Option(
        False, "--version", help="Print the version.", callback=_print_version, is_eager=True
    ),
) -> None:
    """System models in which dry friction sticks and slips at many places at once."""


def main() -> None:
    """Run the command line with the arguments of this process; does not return."""
    if isinstance(sys.stdout, io.TextIOWrapper):  # what it cannot write, such as ° in ASCII, is no reason to fail
        sys.stdout.reconfigure(errors="replace")
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")  # to find some, pydantic reads a file of every package
    app(prog_name="fairlead")
