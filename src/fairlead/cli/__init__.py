"""The command `fairlead`: one file per verb, each a thin caller of the Python API.

Exit codes are in `exit_codes.py`. Results go to standard output, progress, warnings and errors to
standard error. A verb imports what it needs when it runs, so that `--help` stays quick.
"""

import importlib
import io
import os
import sys
from collections.abc import Iterable
from typing import Any

import typer

from fairlead.cli.terminal import echo
from fairlead.cli.verb import Verb, Verbs

__all__ = ["VERBS", "app", "main"]

VERBS = (
    "check", "describe", "graph", "statics", "run", "view", "report", "plot", "friction", "margins", "compare", "sweep",
    "fit", "sensitivity", "modes", "cost", "effects", "fmu", "schema", "new", "doctor",
)  # fmt: skip
"""In the order in which `--help` lists them; each is a function in a module of its name."""


def with_verbs(names: Iterable[str]) -> typer.Typer:
    """The command with these verbs. To read in one of them and its options takes as long as a short run's loop."""
    made = typer.Typer(
        name="fairlead",
        cls=Verbs,
        help="System models in which dry friction sticks and slips at many places at once.",
        epilog="Start with: fairlead run single_bend --report",
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        context_settings={"help_option_names": ["-h", "--help"]},
    )
    for name in names:
        made.command(cls=Verb)(getattr(importlib.import_module(f"{__name__}.{name}"), name))
    made.callback()(_options)
    return made


def __getattr__(name: str) -> Any:
    """`app`, the command with all verbs, is made when somebody wants it. Raises AttributeError for other names."""
    if name != "app":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    globals()[name] = made = with_verbs(VERBS)
    return made


def _print_version(wanted: bool) -> None:
    if wanted:
        import importlib.metadata

        echo(f"fairlead {importlib.metadata.version('fairlead')}")
        raise typer.Exit


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
    verb = sys.argv[1:2]  # what else may stand first needs all verbs: an option, a mistake, nothing
    if verb == ["run"]:  # which has no work for the threads that numpy starts when it is read in, one a processor
        os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    with_verbs(verb if verb and verb[0] in VERBS else VERBS)(prog_name="fairlead")
