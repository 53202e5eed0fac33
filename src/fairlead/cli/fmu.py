"""`fairlead fmu`: a model as a functional mock-up unit."""

import enum
import pathlib
import warnings
from typing import Annotated

import typer

import fairlead.cli.completion as completion
from fairlead.cli.options import Libraries, Netlist, Quiet, Settings, Verbose, parse_settings
from fairlead.cli.terminal import echo


class Action(enum.StrEnum):
    """What is to be done."""

    EXPORT = "export"
    LIBRARY = "library"


class Version(enum.StrEnum):
    """Versions of the standard."""

    TWO = "2"
    THREE = "3"


Inputs = Annotated[
    list[str],
    typer.Option("--in", metavar="SIGNAL", help="A signal input that is set from outside. Repeatable.",
                 default_factory=list, show_default=False),
]  # fmt: skip
Outputs = Annotated[
    list[str],
    typer.Option("--out", metavar="SIGNAL", help="A signal that is read from outside; * and ? as in plots. Repeatable.",
                 default_factory=list, show_default=False, autocompletion=completion.signals),
]  # fmt: skip

Tunable = Annotated[
    list[str],
    typer.Option("--tunable", metavar="PARAMETER", help="A parameter that can be set while it runs. Repeatable.",
                 default_factory=list, show_default=False),
]  # fmt: skip

Platforms = Annotated[
    list[str],
    typer.Option("--platform", metavar="NAME", help="A system that it is to run on, as aarch64-linux; all but "
                 "x86_64-linux are linked by ziglang. Repeatable.",
                 default_factory=list, show_default="x86_64-linux", autocompletion=completion.platforms),
]  # fmt: skip


def fmu(
    action: Annotated[
        Action, typer.Argument(help="export: write the FMU. library: a shared library with a C header instead.")
    ],
    netlist: Netlist,
    settings: Settings,
    libraries: Libraries,
    inputs: Inputs,
    outputs: Outputs,
    tunable: Tunable,
    platforms: Platforms,
    version: Annotated[
        Version | None, typer.Option("--fmi", help="Version of the standard, of an FMU.", show_default="3")
    ] = None,
    out: Annotated[
        pathlib.Path | None,
        typer.Option("-o", metavar="PATH", help="Write this file, or folder of a library. Default: NAME.fmu, NAME."),
    ] = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Write a model as a co-simulation FMU (docs/fmu.md) or as a C library (docs/coupling.md).

    Neither needs Python where it runs. Inputs, outputs and tunable parameters are those of the netlist's interface
    block and of --in, --out and --tunable. A C compiler links it.
    """
    import fairlead
    from fairlead.errors import RunWarning, UsageError
    from fairlead.fmu import export, export_library

    if action is Action.LIBRARY and version is not None:
        raise UsageError(
            f"--fmi {version.value} is of an FMU, and a library has no version of that standard.\n"
            f"    Leave it out, or write `fairlead fmu export {netlist} --fmi {version.value}`."
        )
    model = fairlead.load(netlist, set=parse_settings(settings), libraries=libraries)
    if action is Action.LIBRARY:
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always", RunWarning)
            folder = export_library(model, out, inputs=inputs, outputs=outputs, tunable=tunable, platforms=platforms)
        if not quiet:
            echo(f"Library, header and an example in {folder}/")
            for one in told:
                echo(str(one.message))
        return
    version = version or Version.THREE
    written = export(model, out, version=int(version.value), inputs=inputs, outputs=outputs, tunable=tunable,
                     platforms=platforms)  # fmt: skip
    if not quiet:
        echo(f"FMI {version.value}.0 for co-simulation in {written}")
