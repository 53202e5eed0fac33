"""How a result shows itself in a notebook."""

from __future__ import annotations

from collections import Counter
from html import escape
from typing import TYPE_CHECKING

from fairlead.results.signal import family

if TYPE_CHECKING:
    from fairlead.results.trajectory import Result

MOST_FAMILIES = 20


def as_html(result: Result) -> str:
    """Return a small table: how the run went, and the recorded signals, elements of a line in one row."""
    facts = [
        ("status", result.status),
        ("directory", str(result.path)),
        ("rows", f"{len(result.t)}" + (f", up to {result.t[-1]:g} s" if len(result.t) else "")),
        ("zone changes", str(len(result.events))),
    ]
    counts = Counter((family(signal.name)[0], signal.unit) for signal in result.signals)
    shown = list(counts.items())[:MOST_FAMILIES]
    signals = [
        (name, f"{count} &times; " * (count > 1) + f"[{escape(unit)}]") for (name, unit), count in shown
    ]
    left_out = len(counts) - len(shown)
    body = "".join(_row(key, escape(value)) for key, value in facts)
    body += "".join(_row(name, value) for name, value in signals)
    body += _row("...", f"{left_out} more") if left_out else ""
    return f"<table><caption><b>{escape(str(result.run.get('name', 'run')))}</b></caption>{body}</table>"


def _row(key: str, value: str) -> str:
    left = 'style="text-align:left"'
    return f"<tr><th {left}>{escape(key)}</th><td {left}>{value}</td></tr>"
