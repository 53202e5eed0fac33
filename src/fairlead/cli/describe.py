"""`fairlead describe`: what a netlist has become after a stage, or what a component type is."""

import enum
import pathlib
from typing import Annotated

import typer

from fairlead.cli.options import Libraries, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.terminal import echo


class Stage(enum.StrEnum):
    """The stages of the pipeline whose output can be looked at."""

    NETLIST = "netlist"
    COMPONENT = "component"
    FLATTEN = "flatten"
    SYSTEM = "system"


def describe(
    subject: Annotated[
        str,
        typer.Argument(
            help="A netlist, a bundled model, a component type such as Spring, or `types` for the list."
        ),
    ],
    settings: Settings,
    libraries: Libraries,
    stage: Annotated[Stage, typer.Option(help="For a netlist: the stage to look at.")] = Stage.FLATTEN,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Print a netlist as a stage left it, or a component type: ports, parameters, zones, equations."""
    import fairlead

    if is_type_name(subject):
        text = fairlead.describe_type(subject, libraries)
    else:
        text = fairlead.load(subject, set=parse_settings(settings), libraries=libraries).describe(stage.value)
    echo(text)


def is_type_name(subject: str) -> bool:
    """Types are CamelCase words, and `types` means all; models are lower_snake names or paths to files."""
    named = subject == "types" or (subject.isidentifier() and subject[0].isupper())
    return named and not pathlib.Path(subject).exists()
