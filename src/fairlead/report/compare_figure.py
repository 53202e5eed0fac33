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
    figure.suptitle(f"Against {comparison.reference}", x=0.01, horizontalalignment="left", parse_math=False)
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
    ax.set_xscale("log")
    ax.set_xlim(left=least)
    ax.xaxis.set_major_locator(LogLocator(numticks=MOST_TICKS))
    ax.xaxis.set_minor_formatter(NullFormatter())
