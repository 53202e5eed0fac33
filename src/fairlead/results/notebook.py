"""How a result shows itself in a notebook."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from html import escape

from fairlead.results.signal import Signal, family

MOST_FAMILIES = 20


def as_html(title: str, facts: Iterable[tuple[str, str]], signals: Iterable[Signal]) -> str:
    """Return a small table: facts about the run, then its signals, the elements of a line in one row."""
    counts = Counter((family(signal.name)[0], signal.unit) for signal in signals)
    shown = list(counts.items())[:MOST_FAMILIES]
    body = "".join(_row(key, escape(value)) for key, value in facts)
    for (name, unit), count in shown:
        body += _row(name, f"{count} &times; " * (count > 1) + f"[{escape(unit)}]")
    left_out = len(counts) - len(shown)
    body += _row("...", f"{left_out} more") if left_out else ""
    return f"<table><caption><b>{escape(title)}</b></caption>{body}</table>"


def _row(key: str, value: str) -> str:
    left = 'style="text-align:left"'
    return f"<tr><th {left}>{escape(key)}</th><td {left}>{value}</td></tr>"
