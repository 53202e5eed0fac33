"""Modes drawn: eigenvalues in the complex plane, and amplitude and phase of a response where one was asked for."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from fairlead.report.figures import DOTS_PER_INCH, STYLE
from fairlead.report.panel import COLOURS
from fairlead.studies.modes.table import Modes

MOST_NUMBERED = 12
"""Modes that have their numbers beside them; of more they would lie over one another."""


def draw(found: Modes, path: Path) -> Path:
    """Write the figure to `path` (PNG, SVG or PDF by its ending). Returns it."""
    import matplotlib

    with matplotlib.rc_context({**STYLE, "backend": "agg"}):
        from matplotlib.figure import Figure

        figure = Figure(figsize=(9, 4.5), layout="constrained")
        if found.response is None:
            _eigenvalues(figure.subplots(), found)
        else:
            left, right = figure.subfigures(1, 2, squeeze=False)[0]
            _eigenvalues(left.subplots(), found)
            _response(right.subplots(2, 1, sharex=True), found)
        figure.suptitle(f"{found.model} at {found.t:.4g} s. {found.pattern}", x=0.01, horizontalalignment="left",
                        parse_math=False)  # fmt: skip
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, dpi=DOTS_PER_INCH)
    return path


def _eigenvalues(ax: Any, found: Modes) -> None:
    """Growth to the right of zero; squares are modes that grow. Of few modes with their numbers in the table."""
    for grows, mark, colour in ((False, "o", COLOURS[0]), (True, "s", "crimson")):
        values = [one for one in found.modes if (one.growth > 0) is grows]
        ax.plot([one.growth for one in values], [one.frequency for one in values], mark, color=colour,
                markerfacecolor="none")  # fmt: skip
    ax.axvline(0.0, color="grey", linewidth=0.8)
    if len(found.modes) <= MOST_NUMBERED:
        for number, one in enumerate(found.modes, 1):
            ax.annotate(f" {number}", (one.growth, one.frequency), ha="left", va="bottom", fontsize=8)
    if not found.modes:
        ax.text(0.5, 0.5, "no mode", ha="center", va="center", transform=ax.transAxes)
    ax.set_xlabel("growth [1/s]: left of 0 a mode dies out, right of it it grows")
    ax.set_ylabel("frequency [Hz]")


def _response(axes: Any, found: Modes) -> None:
    one = found.response
    assert one is not None
    amplitude, phase = axes
    amplitude.loglog(one.frequencies, np.maximum(np.abs(one.values), np.finfo(float).tiny), color=COLOURS[0])
    amplitude.set_ylabel(f"{one.out} over {one.acting} [{one.unit}]")
    phase.semilogx(one.frequencies, np.degrees(np.unwrap(np.angle(one.values))), color=COLOURS[0])
    phase.set_ylabel("phase [deg]")
    phase.set_xlabel("frequency [Hz]")
