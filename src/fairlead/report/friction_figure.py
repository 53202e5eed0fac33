"""Draws friction against slip speed, zones shaded, with the numbers in use."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from fairlead.report.figures import DOTS_PER_INCH, STYLE
from fairlead.report.panel import COLOURS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from fairlead.analysis.characteristic import Characteristic


def draw(found: Characteristic, path: Path, title: str) -> Path:
    """Write the figure of one contact to `path` (PNG). Returns it."""
    import matplotlib

    with matplotlib.rc_context({**STYLE, "backend": "agg"}):
        from matplotlib.figure import Figure

        figure = Figure(figsize=(8, 4), layout="constrained")
        ax = figure.subplots()
        _draw_branches(ax, found)
        least = min((np.abs(v).min() for v, _ in found.branches.values()), default=1e-6)
        # Creep and sliding are decades apart: linear near zero, logarithmic beyond, the same for both signs.
        ax.set_xscale("symlog", linthresh=float(least) * 30)
        ax.tick_params(axis="x", labelsize=7)
        ax.set_xlabel("slip speed [m/s]")
        ax.set_ylabel("friction [N]")
        ax.axhline(0, color="0.7", linewidth=0.6)
        for sign in (-1, 1):
            ax.axhline(sign * found.breakaway, color="0.5", linewidth=0.8, linestyle=":")
        ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), handlelength=1.4)
        figure.suptitle(title, x=0.01, horizontalalignment="left", parse_math=False)
        figure.savefig(path, dpi=DOTS_PER_INCH)
    return path


def _draw_branches(ax: Axes, found: Characteristic) -> None:
    kinds = ((found.branches, "-", ""), (found.caught, ":", " (caught)"), (found.driven, "--", " (driven)"))
    names = list(dict.fromkeys(found.called[zone] for branches, _, _ in kinds for zone in branches))
    for branches, line, how in kinds:
        for zone, (slip, force) in branches.items():
            colour = COLOURS[names.index(found.called[zone]) % len(COLOURS)]
            label = found.called[zone] + how
            whole = _with_gaps(slip, force)
            ax.plot(*whole, line, color=colour, label=label if label not in ax.get_legend_handles_labels()[1] else "_")
            if zone not in found.latched:
                ax.axvspan(slip.min(), slip.max(), color=colour, alpha=0.06, linewidth=0)
    if found.holds:
        ax.plot([0, 0], [-found.capacity, found.capacity], color="black", linewidth=2, label="held")
    elif found.stiffness is not None:
        ax.plot([0, 0], [-found.capacity, found.capacity], ":", color="black", label="presliding")


def _with_gaps(slip: np.ndarray, force: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The line broken where it passes from backward to forward slip away from zero, as a ramp does."""
    k = int(np.searchsorted(slip, 0.0))
    if 0 < k < len(slip) and abs(force[k] - force[k - 1]) > 0.5 * np.abs(force).max():
        return np.insert(slip, k, 0.0), np.insert(force, k, np.nan)
    return slip, force
