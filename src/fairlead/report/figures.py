"""Draws recorded signals over time: PNG files in the run directory.

    draw(result, plots)      the figures a netlist names, or a default set, one per quantity

Signals of one unit share a panel; the panels of a figure stand above each other on one time axis.
"""

from __future__ import annotations

import io
import re
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fairlead.errors import UsageError, did_you_mean
from fairlead.report.map import draw_map
from fairlead.report.panel import draw_panel
from fairlead.results.placing import place
from fairlead.results.signal import family

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from fairlead.results import Result, Signal

MOST_DEFAULT_FIGURES = 8
WIDTH, PANEL_HEIGHT, TITLE_HEIGHT = 8.0, 2.7, 0.7  # inches
DOTS_PER_INCH = 120
FAST = {"compress_level": 1}  # of the PNG; the strongest takes a tenth of a second a figure for a few per cent
STYLE: dict[Any, Any] = {
    "font.size": 9,
    "figure.titlesize": 11,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "0.4",
    "axes.grid": True,
    "grid.color": "0.92",
    "axes.axisbelow": True,
    "xtick.color": "0.3",
    "ytick.color": "0.3",
    "legend.frameon": False,
    "legend.fontsize": 8,
    "lines.linewidth": 1.3,
    "axes.formatter.useoffset": False,
    "axes.formatter.limits": (-4, 6),
}


@dataclass(frozen=True)
class Picture:
    """One figure to draw: its title, the signals in it (by name), its file name; for a map the places, by name."""

    title: str
    signals: tuple[str, ...]
    file: str
    map: bool = False
    along: tuple[str, ...] = ()
    between: tuple[float, float] | None = None


def draw(result: Result, plots: Iterable[Any] = ()) -> list[Path]:
    """Draw `plots` into the directory of `result`; without plots, one figure per quantity.

    A plot has `signals` (patterns), and perhaps a `title` and a `file`, as attributes or keys. A
    pattern that fits no recorded signal is warned of, and a plot of such patterns alone left out.
    Returns the paths of the figures. Raises UsageError for a file outside the run directory.
    """
    import matplotlib
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    plots = list(plots)
    pictures = _asked_for(result, plots) if plots else _by_quantity(result)
    paths = []
    with matplotlib.rc_context({**STYLE, "backend": "agg"}):
        for picture in pictures:
            path = result.folder / picture.file
            # The mark tells a later run in this directory that the picture may go.
            mark = {"Software": "fairlead"}
            # Figure.savefig draws twice, the first time for the layout alone, which the second finds by itself.
            drawn = io.BytesIO()
            FigureCanvasAgg(figure_of(result, picture)).print_png(drawn, metadata=mark, pil_kwargs=FAST)
            place(path, drawn.getvalue())
            paths.append(path)
    return paths


def figure_of(result: Result, picture: Picture, kind: Any = None) -> Figure:
    """Draw one figure, of the class `kind`."""
    from matplotlib.figure import Figure

    about = {signal.name: signal for signal in result.signals}
    signals = [about[name] for name in picture.signals]
    panels = _by_family(signals) if picture.map else _by_unit(signals)
    height = TITLE_HEIGHT + PANEL_HEIGHT * len(panels)
    figure: Figure = (kind or Figure)(figsize=(WIDTH, height), dpi=DOTS_PER_INCH, layout="constrained")
    axes = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    for ax, shown in zip(axes, panels, strict=True):
        if picture.map:
            label = f"{family(shown[0].name)[0]} [{shown[0].unit}]"
            draw_map(ax, result, [one.name for one in shown], label, picture.along, picture.between)
        else:
            draw_panel(ax, result, shown)
    figure.suptitle(picture.title, x=0.01, horizontalalignment="left", parse_math=False)
    axes[-1].set_xlabel("time [s]")
    return figure


def _by_family(signals: Sequence[Signal]) -> list[list[Signal]]:
    panels: dict[str, list[Signal]] = {}
    for signal in signals:
        panels.setdefault(family(signal.name)[0], []).append(signal)
    return list(panels.values())


def _by_unit(signals: Sequence[Signal]) -> list[list[Signal]]:
    panels: dict[str, list[Signal]] = {}
    for signal in signals:
        panels.setdefault(signal.unit, []).append(signal)
    return list(panels.values())


def _asked_for(result: Result, plots: list[Any]) -> list[Picture]:
    pictures: list[Picture] = []
    for plot in plots:
        patterns = _entry(plot, "signals") or []
        patterns = [patterns] if isinstance(patterns, str) else list(patterns)
        names = _found(result, patterns)
        if names:
            title = _entry(plot, "title") or ", ".join(patterns)
            taken = {picture.file for picture in pictures}
            file = _file_name(_entry(plot, "file") or title, taken)
            along, between = _entry(plot, "along"), _entry(plot, "between")
            places = _found(result, [along]) if along else ()
            pictures.append(
                Picture(title, names, file, _entry(plot, "kind") == "map", places, tuple(between) if between else None)
            )
    return pictures


def _entry(plot: Any, key: str) -> Any:
    return plot.get(key) if isinstance(plot, Mapping) else getattr(plot, key, None)


def _found(result: Result, patterns: Iterable[str]) -> tuple[str, ...]:
    names: dict[str, None] = {}
    for pattern in patterns:
        matched = result.match(pattern)
        if not matched:
            advice = did_you_mean(pattern, [signal.name for signal in result.signals])
            warnings.warn(f"plot: no recorded signal fits {pattern}. {advice}".rstrip(), stacklevel=3)
        names.update(dict.fromkeys(matched))
    return tuple(names)


def _by_quantity(result: Result) -> list[Picture]:
    """Return one figure per last word of a name and unit: all tensions, all slips, ..."""
    groups: dict[tuple[str, str], list[str]] = {}
    for signal in result.signals:
        quantity = signal.name.rpartition(".")[2].partition("[")[0]
        groups.setdefault((quantity, signal.unit), []).append(signal.name)
    pictures: list[Picture] = []
    for (quantity, _), names in list(groups.items())[:MOST_DEFAULT_FIGURES]:
        taken = {picture.file for picture in pictures}
        pictures.append(Picture(quantity.replace("_", " "), tuple(names), _file_name(quantity, taken)))
    return pictures


def _file_name(wanted: str, taken: set[str]) -> str:
    """Return a file name for a figure: the one that was asked for, or one made from its title."""
    if wanted.lower().endswith(".png"):
        if Path(wanted).name != wanted:
            raise UsageError(
                f"plot file {wanted} is not a plain file name; figures stay in the run directory."
            )
        stem = wanted[:-4]
    else:
        stem = re.sub(r"[^\w.-]+", "_", wanted).strip("_.")[:60] or "figure"
    name, number = f"{stem}.png", 2
    while name in taken:
        name, number = f"{stem}_{number}.png", number + 1
    return name
