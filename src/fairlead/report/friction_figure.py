"""Draws friction against slip speed, zones shaded, with the numbers in use."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from fairlead.report.figures import DOTS_PER_INCH, STYLE
from fairlead.report.panel import COLOURS

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from fairlead.analysis.characteristic import Characteristic


MOST_DECADES = 4
"""Labels on each side of zero."""
MOST_KINDS = 8
"""Of contacts in one figure; of more, the title of the last says how many are left out."""


def draw(found: Characteristic, path: Path, title: str) -> Path:
    """Write the figure of one contact to `path`, in the format of its ending. Returns it."""
    return draw_all({title: found}, path)


def draw_all(found: Mapping[str, Characteristic], path: Path) -> Path:
    """Write a figure with a panel for each kind of contact, by title. Returns `path`."""
    import matplotlib

    shown, left_out = list(found.items())[:MOST_KINDS], len(found) - MOST_KINDS
    with matplotlib.rc_context({**STYLE, "backend": "agg"}):
        from matplotlib.figure import Figure

        figure = Figure(figsize=(8, 4 * len(shown)), layout="constrained")
        for ax, (title, one) in zip(figure.subplots(len(shown), squeeze=False)[:, 0], shown, strict=True):
            _panel(ax, one)
            if len(shown) > 1:
                ax.set_title(title, loc="left", parse_math=False)
        more = f"; {left_out} more kinds are left out" if left_out > 0 else ""
        if len(shown) == 1 or more:
            title = shown[0][0] if len(shown) == 1 else f"The first {MOST_KINDS} kinds of contact{more}"
            figure.suptitle(title, x=0.01, horizontalalignment="left", parse_math=False)
        figure.savefig(path, dpi=DOTS_PER_INCH)
    return path


def decades(low: float, high: float, linear: float) -> list[float]:
    """Zero and powers of ten beyond the linear stretch on both sides: of many every second, so that none touch."""
    first, last = int(np.ceil(np.log10(linear))) + 1, int(np.floor(np.log10(max(-low, high, linear))))
    powers = range(last, first - 1, -max(1, -(-(last - first + 1) // MOST_DECADES)))
    found = [sign * 10.0**power for power in powers for sign in (-1, 1)]
    return sorted([0.0, *(x for x in found if low <= x <= high)])


def _panel(ax: Axes, found: Characteristic) -> None:
    """Friction over slip of one contact."""
    from matplotlib.ticker import FixedLocator, NullLocator

    _draw_branches(ax, found)
    least = min((np.abs(v).min() for v, _ in found.branches.values()), default=1e-6)
    # Creep and sliding are decades apart: linear near zero, logarithmic beyond, the same for both signs.
    ax.set_xscale("symlog", linthresh=float(least) * 30)
    ax.xaxis.set_major_locator(FixedLocator(decades(*ax.get_xlim(), float(least) * 30)))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.tick_params(axis="x", labelsize=7)
    ax.set_xlabel(f"slip speed [{found.speed_unit}]")
    ax.set_ylabel(f"friction [{found.force_unit}]")
    ax.axhline(0, color="0.7", linewidth=0.6)
    for limit in (-found.breakaway_backward, found.breakaway):
        ax.axhline(limit, color="0.5", linewidth=0.8, linestyle=":")
    ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), handlelength=1.4)


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
    held = [-found.capacity_backward, found.capacity]
    if found.holds:
        ax.plot([0, 0], held, color="black", linewidth=2, label="held")
    elif found.stiffness is not None:
        ax.plot([0, 0], held, ":", color="black", label="presliding")


def _with_gaps(slip: np.ndarray, force: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The line broken where it passes from backward to forward slip away from zero, as a ramp does."""
    k = int(np.searchsorted(slip, 0.0))
    if 0 < k < len(slip) and abs(force[k] - force[k - 1]) > 0.5 * np.abs(force).max():
        return np.insert(slip, k, 0.0), np.insert(force, k, np.nan)
    return slip, force
