"""Tables of numbers as the verbs print them, and numbers as JSON wants them."""

import math
from typing import TYPE_CHECKING, Any

from fairlead.cli.terminal import console

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table


def wide_console() -> "Console":
    """A console that is as wide as the terminal, or wide enough for our tables where there is none."""
    import sys

    return console(width=None if sys.stdout.isatty() else 120)


def finite(value: Any) -> Any:
    """The same with null where a number is infinite, as JSON wants it."""
    if isinstance(value, dict):
        return {name: finite(one) for name, one in value.items()}
    if isinstance(value, list | tuple):
        return [finite(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def plain_table(*columns: str, left: int = 1) -> "Table":
    """A table with the first columns to the left and numbers to the right."""
    from rich import box
    from rich.table import Table

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for place, column in enumerate(columns):
        table.add_column(column, justify="left" if place < left else "right", no_wrap=True)
    return table


def number(value: float | None) -> str:
    """Whole numbers from 100 on, else one decimal; nothing for None."""
    if value is None:
        return ""
    if not math.isfinite(value):
        return "any"
    return f"{value:.0f}" if abs(value) >= 99.95 else f"{value + 0.0:.1f}".replace("-0.0", "0.0")


def times(value: float | None) -> str:
    """A factor: two digits, a dash where nothing is asked of it."""
    if value is None:
        return ""
    return f"{value:.2g}" if value < 100 else "-" if math.isinf(value) else "> 100"
