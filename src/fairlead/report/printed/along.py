"""Quantities along a line: profiles at given times, and which signals a map is drawn of."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from fairlead.errors import UsageError
from fairlead.report.figures import WIDTH
from fairlead.report.page.line import line_data
from fairlead.report.panel import COLOURS
from fairlead.results.elements import PLACE

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from fairlead.results import Result

MOST_TIMES = 8


def profile(result: Result, names: Sequence[str], times: Sequence[float]) -> Figure:
    """Values along the line at some times [s] (without times at the end); the first family along it without names.

    Places are those on the route where the positions of the line were recorded, else numbers of elements. Raises
    UsageError without a line, for more times than can be told apart and for times outside the run.
    """
    from matplotlib.figure import Figure

    family, line = _family(result, names)
    times = list(times) or [float(result.t[-1])]
    outside = [t for t in times if not result.t[0] <= t <= result.t[-1]]
    if len(times) > MOST_TIMES or outside:
        span = f"{result.t[0]:g} to {result.t[-1]:g} s"
        told = f"t = {outside[0]:g} s is no time of the run" if outside else f"{len(times)} times were given"
        raise UsageError(f"profile: {told}.\n    A profile has 1 to {MOST_TIMES} times within {span}.")
    found = result.elements(family, side="right")
    figure: Figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    ax = figure.subplots()
    for k, t in enumerate(times):
        row = int(np.searchsorted(found["time"].values, t, side="right")) - 1
        place = found[PLACE].values[row] if PLACE in found.coords else found["element"].values
        ax.plot(place, found.values[row], color=COLOURS[k % len(COLOURS)], label=f"{t:g} s")
    if PLACE in found.coords:
        _devices(ax, line)
    ax.set_xlabel("place on the route [m]" if PLACE in found.coords else "element")
    ax.set_ylabel(f"{family.rpartition('.')[2]} [{found.attrs['units']}]", parse_math=False)
    ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    figure.suptitle(f"{result.run.get('name', '')}: {family}", x=0.01, horizontalalignment="left", parse_math=False)
    return figure


def _devices(ax: Any, line: dict[str, Any]) -> None:
    low, high = ax.get_xlim()
    for one in line["stations"]:
        begin, end = (low if one["begin"] is None else one["begin"]), (high if one["end"] is None else one["end"])
        if one["type"] != "Straight" and begin < high and end > low:
            ax.axvspan(max(begin, low), min(end, high), color="0.5", alpha=0.12, linewidth=0)
            middle = (max(begin, low) + min(end, high)) / 2
            ax.text(middle, 1.01, one["name"], transform=ax.get_xaxis_transform(), ha="center", fontsize=7)
    ax.set_xlim(low, high)


def _family(result: Result, names: Sequence[str]) -> tuple[str, dict[str, Any]]:
    """The family to draw, with its line."""
    lines = line_data(result)
    if not lines:
        raise UsageError(f"{result.run.get('name', 'The run')} has no line on a route.\n    Draw signals instead.")
    if names:
        found = str(result.elements(names[0]).name)
        return found, next((one for one in lines if found.startswith(f"{one['line']}.")), lines[0])
    one = next((one for one in lines if one["along"]), None)
    if one is None:
        what = f"Nothing along {lines[0]['line']} was recorded."
        raise UsageError(f"{what}\n    Record it (record.signals), or run with --report, which records it.")
    return one["along"][0], one


def map_names(result: Result, names: Sequence[str]) -> tuple[tuple[str, ...], str, bool, tuple[str, ...]]:
    """For a `Picture`: the signals of a family along a line, no file, that it is a map, and the places."""
    family, line = _family(result, names)
    found = result.elements(family)
    values = result.match(family)
    where = result.match(line["positions"]) if line["positions"] else []
    fits = len(where) in (len(values), len(values) + 1)
    if line["positions"] and not fits:  # a family of inner nodes: the places of its own numbers
        where = [f"{line['positions'].replace('[*]', f'[{k}]')}" for k in found["element"].values.tolist()]
    return tuple(values), "", True, tuple(where)
