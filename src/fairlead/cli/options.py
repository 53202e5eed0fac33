"""The options that several verbs take, spelled and explained once."""

from typing import Annotated

import typer

import fairlead.cli.completion as completion
from fairlead.errors import shown

Netlist = Annotated[
    str, typer.Argument(help="A netlist file, or the name of a bundled model.", autocompletion=completion.netlists)
]
Settings = Annotated[
    list[str],
    typer.Option(
        "--set",
        metavar="NAME=VALUE",
        help="Override a value of the netlist: mu=0.6, pad.normal_force='12 N', run.stop=5. Repeatable.",
        default_factory=list,
        show_default=False,
        autocompletion=completion.settings,
    ),
]
Libraries = Annotated[
    list[str],
    typer.Option(
        "--library",
        metavar="PATH",
        help="A Python file or folder with components of your own; its code is run. Repeatable.",
        default_factory=list,
        show_default=False,
    ),
]
AllowFmu = Annotated[
    bool, typer.Option("--allow-fmu", help="Run the code of FMUs that the netlist names; it is foreign code.")
]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON on standard output.")]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="Print errors only.")]
Verbose = Annotated[bool, typer.Option("--verbose", "-v", help="Print more, and tracebacks.")]


def with_space(text: str) -> str:
    """A quantity as netlists have it: `1ms` is as good as `1 ms` on a command line."""
    import re

    return re.sub(r"(?<=[0-9.])(?=(?![eE][-+]?[0-9])[a-zA-Z%])", " ", text.strip())


def parse_settings(texts: list[str]) -> dict[str, str]:
    """`["mu=0.6"]` as `{"mu": "0.6"}`; the values stay text, the netlist stage knows their units.

    Raises:
        typer.BadParameter: a text is not NAME=VALUE, or a name comes twice.
    """
    from fairlead.netlist.overrides import PLACE
    from fairlead.netlist.settings_file import Setting

    settings: dict[str, str] = {}
    for text in texts:
        name, equals, value = (part.strip() for part in text.partition("="))
        if not (name and equals and value):
            raise typer.BadParameter(f"--set wants NAME=VALUE, such as --set mu=0.6; it got {text!r}.")
        if name in settings:
            raise typer.BadParameter(f"--set gives {shown(name)} twice: {settings[name]!r} and {value!r}.")
        settings[name] = Setting(value, PLACE)
    return settings
