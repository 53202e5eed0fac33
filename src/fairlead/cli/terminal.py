"""What reaches the terminal: text whose control characters are taken out, whoever wrote it.

Names, descriptions, paths and run.json come from files of others. An escape in them could colour, hide or overwrite
what stands there, so every verb prints with `echo` and `console` and with nothing else.
"""

from typing import TYPE_CHECKING, Any

import typer

from fairlead.errors import printable

if TYPE_CHECKING:
    from rich.console import Console
    from rich.text import Text


def echo(text: str, *, err: bool = False) -> None:
    """Print lines on standard output, or with `err` on standard error."""
    typer.echo(printable(text), err=err)


def console(**given: Any) -> "Console":
    """A console of rich's whose own styles are all the escapes that it writes."""
    from rich.console import Console

    class Printable(Console):
        def render_str(self, text: str, **styled: Any) -> "Text":
            """A text given to the console, alone or in the cell of a table."""
            return super().render_str(printable(text), **styled)

    return Printable(highlight=False, **given)
