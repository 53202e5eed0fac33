"""Draws a comparison of treatments: bars of error, creep, steps, switches and time, failures marked."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fairlead.report.figures import DOTS_PER_INCH, STYLE
from fairlead.report.panel import COLOURS

if TYPE_CHECKING:
    from fairlead.analysis.cost.compare import Comparison

PANELS = (
    ("error", "error"), ("creep", "worst creep [m/s]"), ("steps", "steps"), ("switches", "switches"),
    ("seconds", "stepping [s]"),
)  # fmt: skip
MOST_TICKS = 5  # with more, the labels of a narrow panel lie over one another
ROOM = 0.3  # of the way to the longest bar, behind it, for its number
LEAST = 1e-12  # below it is rounding, and a logarithm has no place for zero


def draw(comparison: Comparison, path: Path) -> Path:
    """Write the figure to `path` (PNG). Returns it."""
    import matplotlib

    with matplotlib.rc_context({**STYLE, "backend": "agg"}):
        figure = figure_of(comparison)
        path.parent.mkdir(parents=True, exist_ok=True)  # no run has, if none could be started
        figure.savefig(path, dpi=DOTS_PER_INCH)
    return path


def figure_of(comparison: Comparison) -> Any:
    """The matplotlib Figure: a panel each for error, creep, steps, switches and time, a bar for each run."""
    from matplotlib.figure import Figure

    rows = comparison.rows
    figure = Figure(figsize=(11, 1.4 + 0.32 * len(rows)), layout="constrained")
    axes = figure.subplots(1, len(PANELS), sharey=True)
    for number, (ax, (name, title)) in enumerate(zip(axes, PANELS, strict=True)):
        _bars(ax, [getattr(row, name) for row in rows], COLOURS[number])
        ax.set_title(title, fontsize=9, loc="left")
    axes[0].set_yticks(range(len(rows)), [row.label for row in rows])
    axes[0].invert_yaxis()
    for place, row in enumerate(rows):
        if row.status != "finished":
            axes[0].annotate(
                row.status, (0.02, place), xycoords=("axes fraction", "data"), va="center", color=COLOURS[1]
            )
    told = f"Error against {comparison.reference}, as a share of the range of a signal"
    if comparison.reference.startswith("none"):
        told = f"Reference: {comparison.reference}"
    figure.suptitle(told, x=0.01, horizontalalignment="left", parse_math=False)
    return figure


def _bars(ax: Any, values: list[float | None], colour: str) -> None:
    """Horizontal bars on a logarithmic axis; what is zero or below rounding is a dot at the left edge."""
    from matplotlib.ticker import LogLocator, NullFormatter

    known = [value for value in values if value is not None and value > LEAST]
    least = 10.0 ** (math.floor(math.log10(min(known))) - 1) if known else 0.1
    for place, value in enumerate(values):
        if value is None:
            continue
        if value > LEAST:
            ax.barh(place, value - least, left=least, height=0.6, color=colour)
        else:
            ax.plot([least], [place], marker="o", markersize=3, color=colour, clip_on=False)
        told = f"{value:.2g}" if isinstance(value, float) else str(value)
        ax.annotate(told if value > LEAST or value == 0 else "rounding", (max(value, least), place), fontsize=7,
                    xytext=(4, 0), textcoords="offset points", va="center")  # fmt: skip
    ax.set_xscale("log")
    most = max(known, default=10 * least)
    ax.set_xlim(least, most * (most / least) ** ROOM)
    ax.xaxis.set_major_locator(LogLocator(numticks=MOST_TICKS))
    ax.xaxis.set_minor_formatter(NullFormatter())
