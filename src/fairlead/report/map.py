"""Draws the elements of a line as a map: time to the right, place along the line or the route upward, value as colour.

A value belongs to a place: to that of the node of the same number when there are as many places as values, to the
middle between two nodes when there is one place more. In between it is interpolated; where there is no line the map
is empty.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fairlead.errors import UsageError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from fairlead.results import Result

COLUMNS, ROWS = 900, 360  # of the picture, about its pixels
SPIKES = 0.1  # per cent of the values at either end that may leave the colour scale


def draw_map(
    ax: Axes, result: Result, names: Sequence[str], label: str, along: Sequence[str] = (),
    between: tuple[float, float] | None = None,
) -> None:  # fmt: skip
    """Draw the signals `names`, in order, over time and place.

    along     signals that tell the places, as many as names or one more; without, the place is the number
    between   from where to where; all of it when not given

    Raises UsageError when the numbers of signals and places do not go together.
    """
    last = result.t[-1]
    if last <= result.t[0]:  # a run that was cut short in its first step has one time
        last = result.t[0] + np.spacing(abs(result.t[0]) + 1.0) * COLUMNS
    times = np.linspace(result.t[0], last, COLUMNS)
    rows = np.minimum(np.searchsorted(result.t, times), len(result.t) - 1)
    values = result.columns(names)[rows]
    places = _places(result, names, along)[rows if along else slice(None)]
    low, high = between or (float(np.nanmin(places)), float(np.nanmax(places)))
    grid = gridded(np.broadcast_to(places, values.shape), values, np.linspace(low, high, ROWS))
    bottom, top = np.nanpercentile(grid, [SPIKES, 100 - SPIKES]) if np.isfinite(grid).any() else (0.0, 1.0)
    image = ax.imshow(
        grid.T, aspect="auto", origin="lower", interpolation="nearest", cmap="viridis", vmin=bottom, vmax=top,
        extent=(times[0], times[-1], low, high),
    )  # fmt: skip
    ax.grid(visible=False)
    bar = ax.figure.colorbar(image, ax=ax, pad=0.01, fraction=0.04, aspect=30, extend="both")
    bar.outline.set_visible(False)
    bar.set_label(label, size=8)
    unit = {signal.name: signal.unit for signal in result.signals}[along[0]] if along else ""
    ax.set_ylabel(f"place [{unit}]" if unit else "number")


def gridded(places: NDArray[np.float64], values: NDArray[np.float64], grid: NDArray[np.float64]) -> NDArray[np.float64]:
    """Values (rows, elements) at places of the same shape, interpolated to (rows, grid); nan beyond the ends."""
    pairs = zip(places, values, strict=True)
    return np.array([np.interp(grid, place, value, left=np.nan, right=np.nan) for place, value in pairs])


def _places(result: Result, names: Sequence[str], along: Sequence[str]) -> NDArray[np.float64]:
    """Place of every value, (rows, values) or (1, values)."""
    if not along:
        return np.arange(len(names), dtype=float)[np.newaxis, :]
    nodes = result.columns(along)
    if len(along) == len(names):
        return nodes
    if len(along) == len(names) + 1:
        return (nodes[:, 1:] + nodes[:, :-1]) / 2
    raise UsageError(
        f"plot: a map of {len(names)} signals needs {len(names)} or {len(names) + 1} places, and `along` fits "
        f"{len(along)}.\n    Give the signals of one line, and the positions of its nodes."
    )
