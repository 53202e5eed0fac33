"""The pictures of a sweep: what fits its design is drawn, one file each."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING, Any

import numpy as np

from fairlead.cases.row import FINISHED
from fairlead.errors import UsageError
from fairlead.report.figures import DOTS_PER_INCH, STYLE
from fairlead.report.panel import COLOURS
from fairlead.studies.pictures.indices import kind_of, morris_indices, sobol_indices
from fairlead.studies.pictures.rows import Rows
from fairlead.studies.pictures.tornado import tornado

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Draw = Callable[["Figure", Rows, str], None]
LONGEST = 80
MOST_CURVES, MOST_SCATTERED = 8, 6
MOST_LETTERS, MOST_TICKS = 60, 12
ROOM = 0.2  # of the width of a tornado, for what stands at the ends of its bars


def draw(rows: Rows, figure: str, folder: Path) -> tuple[list[Path], list[str]]:
    """Write the pictures of one figure of a sweep into a folder, as PNG: which, and why others cannot be drawn.

    Raises UsageError where there is none to draw.
    """
    import matplotlib

    written, reasons = list[Path](), list[str]()
    with matplotlib.rc_context({**STYLE, "backend": "agg"}):
        from matplotlib.figure import Figure

        for name, make, size in fitting(rows):
            made = Figure(figsize=size, layout="constrained")
            try:
                make(made, rows, figure)
            except UsageError as error:
                reasons.append(str(error))
                continue
            folder.mkdir(parents=True, exist_ok=True)
            written.append(folder / f"{name}.png")
            made.savefig(written[-1], dpi=DOTS_PER_INCH)
    if not written:
        raise UsageError("\n".join(reasons) or "All cases have the same values, so there is nothing to draw.")
    return written, reasons


def folder_name(figure: str) -> str:
    """A name for a folder of what a figure is called."""
    return re.sub(r"[^\w.-]+", "_", figure).strip("_.")[:LONGEST] or "figure"


def fitting(rows: Rows) -> Iterator[tuple[str, Draw, tuple[float, float]]]:
    """Names, functions and sizes [inch] of what can be drawn of a design."""
    grid = [name for name in rows.heading["design"]["grid"] if name in rows.numbers]
    if grid:
        yield "response", _response, (8, 4.5)
    if len(grid) > 1:
        yield "heat_map", _heat_map, (7, 5)
    if rows.numbers and not grid:
        yield "scatter", _scatter, (8, 2.6 * -(-min(len(rows.numbers), MOST_SCATTERED) // 2))
    if len(rows.varied) > 1:
        yield "tornado", _tornado, (8, 1.2 + 0.4 * len(rows.varied))
    if rows.varied:
        yield "failures", _failures, (7, 5)
    if kind_of(rows):
        yield "indices", _indices, (8, 1.2 + 0.5 * len(rows.varied))


def _response(made: Figure, rows: Rows, figure: str) -> None:
    """The figure over the first parameter of the grid, a curve for each combination of the others."""
    ax, along = made.subplots(), _grid_numbers(rows)[0]
    others = [name for name in rows.varied if name != along]
    groups = list(rows.finished.groupby(others)) if others else [((), rows.finished)]
    for number, (key, part) in enumerate(groups[:MOST_CURVES]):
        part = part.sort_values(along)
        told = ", ".join(f"{name} = {rows.value(name, one)}" for name, one in zip(others, key, strict=True))
        ax.plot(part[along], part[figure], marker=".", color=COLOURS[number % len(COLOURS)], label=told or None)
    if others:
        left = f"{MOST_CURVES} of {len(groups)} curves" if len(groups) > MOST_CURVES else ""
        made.legend(fontsize=8, loc="outside right upper", title=left, title_fontsize=8)
    _named(ax, _axis(rows, along), rows.label(figure))


def _heat_map(made: Figure, rows: Rows, figure: str) -> None:
    """The figure over two parameters of the grid: the mean over all others; grey where no case finished."""
    ax, (x, y) = made.subplots(), _grid_numbers(rows)[:2]
    table = rows.finished.pivot_table(index=y, columns=x, values=figure, aggfunc="mean", dropna=False)
    ax.set_facecolor("0.8")
    ax.grid(visible=False)
    colours = ax.pcolormesh(table.columns, table.index, table.to_numpy(dtype=float), shading="nearest", cmap="viridis")
    bar = made.colorbar(colours, ax=ax)
    others = [name for name in rows.varied if name not in (x, y)]
    over = f", mean over {', '.join(others)}" if others else ""
    bar.set_label(f"{rows.label(figure)}{over}", parse_math=False)
    ax.set_xticks(_few(table.columns))
    ax.set_yticks(_few(table.index))
    _named(ax, _axis(rows, x), _axis(rows, y))


def _scatter(made: Figure, rows: Rows, figure: str) -> None:
    names = rows.numbers[:MOST_SCATTERED]
    axes = np.atleast_1d(made.subplots(-(-len(names) // 2), min(len(names), 2), sharey=True, squeeze=False)).ravel()
    for ax, name in zip(axes, names, strict=False):
        ax.plot(rows.finished[name], rows.finished[figure], ".", markersize=3, color=COLOURS[0])
        _named(ax, _axis(rows, name), rows.label(figure))
    for ax in axes[len(names) :]:
        ax.set_axis_off()


def _tornado(made: Figure, rows: Rows, figure: str) -> None:
    ax, bars = made.subplots(), tornado(rows, figure)
    for place, bar in enumerate(bars):
        ax.barh(place, bar.width, left=bar.low, height=0.6, color=COLOURS[0])
        for value, said, side in ((bar.low, bar.at_low, "right"), (bar.high, bar.at_high, "left")):
            ax.annotate(f" {said} ", (value, place), ha=side, va="center", fontsize=8, parse_math=False)
    ax.set_yticks(range(len(bars)), [bar.parameter for bar in bars])
    ax.invert_yaxis()
    low, high = min(bar.low for bar in bars), max(bar.high for bar in bars)
    room = ROOM * ((high - low) or 1.0)
    ax.set_xlim(low - room, high + room)
    _named(ax, f"mean of {rows.label(figure)}, with the value of the parameter at each end", "")


def _failures(made: Figure, rows: Rows, figure: str) -> None:
    """How every case ended, over two parameters: finished, a limit broken, or the status."""
    ax, frame = made.subplots(), rows.frame
    x, y, *_ = [*rows.numbers[:2], *rows.words, None, None]
    assert x is not None, "drawn where something varies"
    ended = frame["status"].where(
        frame["status"] != FINISHED, np.where(frame["limits_broken"] > 0, "limit broken", FINISHED)
    )
    for number, word in enumerate(dict.fromkeys([FINISHED, *sorted(set(ended))])):
        mine = ended == word
        height = frame[y][mine].astype(str if y in rows.words else float) if y else np.zeros(int(mine.sum()))
        place = frame[x][mine].astype(str if x in rows.words else float)
        ax.plot(place, height, "o" if word == FINISHED else "X", markersize=4, linestyle="",
                color=COLOURS[number % len(COLOURS)], label=f"{word}: {int(mine.sum())}")  # fmt: skip
    made.legend(fontsize=8, loc="outside right upper")
    _named(ax, _axis(rows, x), _axis(rows, y) if y else "")


def _indices(made: Figure, rows: Rows, figure: str) -> None:
    ax, morris = made.subplots(), kind_of(rows) == "morris"
    found = morris_indices(rows, figure) if morris else sobol_indices(rows, figure)
    words = ("sigma", "mu*") if morris else ("first order", "total order")
    for place, index in enumerate(found):
        for shift, value, ends, colour in (
            (-0.2, index.first, index.first_interval, COLOURS[0]), (0.2, index.total, index.total_interval, COLOURS[1]),
        ):  # fmt: skip
            label = words[shift > 0] if place == 0 else None
            ax.barh(place + shift, value, height=0.36, color=colour, label=label)
            ax.plot(ends, [place + shift] * 2, color="0.2", linewidth=1)
    ax.set_yticks(range(len(found)), [index.parameter for index in found])
    ax.invert_yaxis()
    made.legend(fontsize=8, loc="outside right upper")
    _named(ax, f"indices of {figure}" + (f" [{rows.heading['units'][figure]}]" if morris else ""), "")


def _grid_numbers(rows: Rows) -> list[str]:
    return [name for name in rows.heading["design"]["grid"] if name in rows.numbers]


def _named(ax: Any, x: str, y: str) -> None:
    ax.set_xlabel(x, parse_math=False)
    ax.set_ylabel(y, parse_math=False)


def _axis(rows: Rows, parameter: str) -> str:
    """A parameter with its unit, and below it what that is, where somebody says so."""
    doc = rows.about(parameter)[1].replace("`", "").partition(". ")[0].rstrip(".")
    if doc.casefold() == parameter.rpartition(".")[2].replace("_", " "):  # `mass` is a mass
        doc = ""
    return f"{rows.label(parameter)}\n{shorten(doc, MOST_LETTERS)}" if doc else rows.label(parameter)


def _few(values: Any) -> list[float]:
    """Of the values of a grid those that have a tick: all, or every so many."""
    return [float(one) for one in values][:: -(-len(values) // MOST_TICKS)]
