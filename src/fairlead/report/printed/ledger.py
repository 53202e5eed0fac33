"""The energy ledger for print: bars of what came in, where it went, and what is missing."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fairlead.errors import UsageError
from fairlead.report.figures import WIDTH
from fairlead.report.measured import measured
from fairlead.report.page.ledger import ledger_rows

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from fairlead.results import Result

HUES = {"in": "#0072B2", "out": "#E69F00", "gap": "#D3261A"}


def ledger(result: Result) -> Figure:
    """A bar for each entry of the ledger [J]. Raises UsageError for a run that kept none."""
    from matplotlib.figure import Figure

    rows = ledger_rows(result)
    if not rows:
        name = result.run.get("name", "The run")
        raise UsageError(f"{name} has no energy ledger to draw: none was kept, or no energy passed.")
    figure: Figure = Figure(figsize=(WIDTH, 0.8 + 0.34 * len(rows)), layout="constrained")
    ax = figure.subplots()
    entries = [row["entry"] for row in rows]
    bars = ax.barh(entries, [row["energy"] for row in rows], color=[HUES[row["kind"]] for row in rows])
    ax.bar_label(bars, [measured(row["energy"], "J") for row in rows], padding=3, fontsize=8)
    ax.invert_yaxis()
    ax.margins(x=0.15)
    ax.grid(visible=False, axis="y")
    ax.set_xlabel("energy [J]")
    figure.suptitle(f"{result.run.get('name', '')}: energy", x=0.01, horizontalalignment="left", parse_math=False)
    return figure
