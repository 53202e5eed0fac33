"""What `fairlead cost` and `fairlead effects` share: options, notes while they work, where they write, the table."""

import json
import pathlib
from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, Any

import typer

import fairlead.cli.completion as completion
from fairlead.cli.options import with_space
from fairlead.cli.places import place
from fairlead.cli.terminal import console

if TYPE_CHECKING:
    from rich.console import Console

Budget = Annotated[str, typer.Option(metavar="TIME", help="Time the study may take, compiling apart.")]
Outputs = Annotated[
    list[str] | None,
    typer.Option(
        "--output", metavar="PATTERN", help="Recorded outputs to compare. Repeatable.",
        autocompletion=completion.signals,
    ),
]
Fresh = Annotated[bool, typer.Option("--fresh", help="Do not use runs kept from an earlier study.")]


def number(option: str, text: str, unit: str, *, zero: bool = False) -> float:
    """A number of an option. `60s` is as good as `60 s` on a command line."""
    from fairlead.quantities import QuantityError, si

    try:
        value = si(with_space(text), unit)
    except QuantityError as error:
        raise typer.BadParameter(f"{option}: {error}") from None
    if value < 0 or (value == 0 and not zero):
        raise typer.BadParameter(f"{option} {text}: it must {'not be below' if zero else 'be above'} zero.")
    return value


def say(text: str) -> None:
    """What is being done, over the last such line, where somebody watches."""
    import sys

    if sys.stderr.isatty():
        sys.stderr.write(f"\r\033[K{text} ...\r")
        sys.stderr.flush()


def write_record(folder: pathlib.Path, name: str, record: dict[str, Any]) -> pathlib.Path:
    """Write all of a study as JSON. Returns the file."""
    path = folder / name
    place(path, json.dumps(record, indent=1) + "\n")
    return path


def print_table(columns: Iterable[str], left: Iterable[str], rows: Iterable[list[str]], width: int) -> "Console":
    """Print a table whose columns in `left` are text, as wide as it is where nobody watches. Returns the console."""
    from rich import box
    from rich.table import Table

    screen = console(width=None if typer.get_text_stream("stdout").isatty() else width)
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for name in columns:
        table.add_column(name, no_wrap=True, justify="left" if name in left else "right")
    for row in rows:
        table.add_row(*row)
    screen.print(table)
    return screen
