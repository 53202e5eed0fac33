"""What reaches the terminal: text whose control characters are taken out, whoever wrote it.

Names, descriptions, paths and run.json come from files of others. An escape in them could colour, hide or overwrite
what stands there, so every verb prints with `echo`, `two_columns` and `console` and with nothing else.
"""

import shutil
import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import typer

from fairlead.errors import printable

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text

NARROWEST = 20
"""Columns of text that a value has, however narrow the terminal is."""


def echo(text: str, *, err: bool = False) -> None:
    """Print lines on standard output, or with `err` on standard error."""
    typer.echo(printable(text), err=err)


def two_columns(rows: Sequence[tuple[str, str]]) -> None:
    """Print names in bold and values beside them, wrapped to the terminal; loads no library of tables for it."""
    shown = [(printable(name), printable(value)) for name, value in rows]
    wide = max(len(name) for name, _ in shown)
    room = max(shutil.get_terminal_size().columns - wide - 4, NARROWEST)
    typer.echo("")
    for name, value in shown:
        first, *more = textwrap.wrap(value, room, break_on_hyphens=False) or [""]
        typer.echo(f" {typer.style(name.ljust(wide), bold=True)}  {first}")
        for line in more:
            typer.echo(f" {' ' * wide}  {line}")
    typer.echo("")


def console(**given: Any) -> "Console":
    """A console of rich's whose own styles are all the escapes that it writes."""
    from rich.console import Console

    class Printable(Console):
        def render_str(self, text: str, **styled: Any) -> "Text":
            """A text given to the console, alone or in the cell of a table."""
            return super().render_str(printable(text), **styled)

    return Printable(highlight=False, **given)
