"""Draws the signals of one unit into one pair of axes.

A few signals get a colour and a legend entry each. The elements of a line (`line.core[*].tension`),
when there are many, get one colour scale that runs along the line.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fairlead.patterns import matcher
from fairlead.report.measured import prefix_of
from fairlead.results.signal import family

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from fairlead.results import Result, Signal

MOST_IN_LEGEND = 8
SCALES = ("viridis", "plasma", "cividis")
MOST_POINTS = 8000  # some ten for each pixel column
FEW_ROWS, PARTS = 1000, 6  # of so few rows the curve between two is drawn in so many straight lines
FEW_LINES = 20  # of more elements in one colour scale no eye follows one between its rows
MOST_TICKS, MOST_LABELLED = 1000, 8
FAR = 1.0  # times the range of the signals; a limit farther away would make them small
LIMIT = "#B00020"
DASHES = ("solid", (0, (5, 4)), (0, (1, 3)), (0, (8, 3, 1, 3)))
CLOSE = 0.008
"""Of the height of a panel: curves that are nearer to each other cover one another."""
ROOM, LETTER, HANDLE = 6.6, 0.068, 0.42
"""Inches: width of a panel, of a letter of its legend, of the line before each entry with the gap behind it."""
# Okabe and Ito (2008), Color Universal Design: told apart by colour-blind readers as well.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8C564B")


def draw_panel(ax: Axes, result: Result, signals: Sequence[Signal]) -> None:
    """Draw `signals`, all of one unit, over time, with their limits, and the run's zone changes as ticks at the top.

    A jump at an event is drawn as a vertical line: the event's time occurs twice in the record.
    """
    single, scaled = _split(signals)
    for number, names in enumerate(scaled.values()):
        _draw_family(ax, result, names, SCALES[number % len(SCALES)])
    lying = coincident([result[name] for name in single])
    for number, name in enumerate(single):
        dash = DASHES[lying[number] % len(DASHES)]
        ax.plot(*thinned(*smooth(result, name)), color=COLOURS[number % len(COLOURS)], linestyle=dash, label=name)
    ax.yaxis.get_offset_text().set_horizontalalignment("right")  # 1e6 stands beside the legend, not in it
    factor, prefix = _prefix(result, signals)
    if factor != 1.0:
        ax.yaxis.set_major_formatter(lambda value, _: f"{value / factor:.10g}".replace("-", "\u2212"))
    ax.set_ylabel(_label(signals, prefix), parse_math=False)
    if len(result.t) > 1 and result.t[-1] > result.t[0]:
        ax.set_xlim(result.t[0], result.t[-1])
    words = _draw_limits(ax, result, [signal.name for signal in signals])
    _draw_ticks(ax, np.array([event.t for event in result.events]))
    words += _label_ticks(ax, result)
    if single:
        # Above the axes: inside, it would sooner or later hide what the reader looks for.
        columns, wide = legend_columns(single)
        lift = 0.06 if words and wide + LETTER * len("; ".join(words)) > ROOM else 0.0
        ax.legend(loc="lower left", bbox_to_anchor=(0, 1.0 + lift), ncols=columns, borderaxespad=0.2, handlelength=1.8)
    if words:
        ax.text(1.0, 1.01, "; ".join(words), transform=ax.transAxes, ha="right", va="bottom", size=7, color="0.45",
                parse_math=False)  # fmt: skip


def legend_columns(names: Sequence[str]) -> tuple[int, float]:
    """In how many columns a legend above a panel has room, and how wide it is then [in]."""
    entry = max(map(len, names)) * LETTER + HANDLE
    columns = max(1, min(4, len(names), int(ROOM / entry)))
    return columns, columns * entry


def coincident(curves: Sequence[NDArray[np.float64]]) -> list[int]:
    """By curve, on how many earlier ones it lies for most of its length."""
    known = [curve[np.isfinite(curve)] for curve in curves]
    ends = [(one.min(), one.max()) for one in known if len(one)]
    near = CLOSE * (max(high for _, high in ends) - min(low for low, _ in ends)) if ends else 0.0
    return [sum(bool(np.mean(np.abs(one - other) <= near) > 0.5) for other in curves[:k])
            for k, one in enumerate(curves)]  # fmt: skip


def _prefix(result: Result, signals: Sequence[Signal]) -> tuple[float, str]:
    """The factor and the prefix with which the unit of a panel has numbers that can be read: 1e6, "M"."""
    found = [result.extremes(signal.name) for signal in signals]
    size = max((abs(v) for one in found for v in (one.lowest, one.highest) if np.isfinite(v)), default=0.0)
    return prefix_of(size, signals[0].unit)


def smooth(result: Result, name: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The rows of a signal, and where they are few the points between them that `Result.at` tells."""
    t, y = result.t, result[name]
    if not 1 < len(t) <= FEW_ROWS:
        return t, y
    share = np.arange(1, PARTS) / PARTS
    between = (t[:-1, None] + share * np.diff(t)[:, None])[np.diff(t) > 0.0].ravel()
    after = np.searchsorted(t, between)
    return np.insert(t, after, between), np.insert(y, after, result.at(name, between))


def thinned(t: NDArray[np.float64], y: NDArray[np.float64]) -> tuple[NDArray[Any], NDArray[Any]]:
    """Return fewer points (t, y) that look the same: of every run of rows its lowest and its highest."""
    if len(t) <= MOST_POINTS:
        return t, y
    length = -(-2 * len(t) // MOST_POINTS)
    runs = len(t) // length
    rows = np.where(np.isnan(y), -np.inf, y)[: runs * length].reshape(runs, length)
    starts = np.arange(runs) * length
    ends = np.arange(min(runs * length, len(t) - 1), len(t))
    kept = np.unique(np.concatenate([[0], starts + rows.argmin(1), starts + rows.argmax(1), ends]))
    return t[kept], y[kept]


def _split(signals: Sequence[Signal]) -> tuple[list[str], dict[str, list[str]]]:
    """Return the names that get a colour each, and the families that get a colour scale."""
    families: dict[str, list[str]] = {}
    for signal in signals:
        families.setdefault(family(signal.name)[0], []).append(signal.name)
    if len(signals) <= MOST_IN_LEGEND:
        return [signal.name for signal in signals], {}
    scaled = {name: members for name, members in families.items() if len(members) > 3}
    loose = [name for members in families.values() if len(members) <= 3 for name in members]
    if len(loose) > MOST_IN_LEGEND:
        return [], {**scaled, "signals in order": loose}
    return loose, scaled


def _draw_family(ax: Axes, result: Result, names: list[str], scale: str) -> None:
    from matplotlib.collections import LineCollection

    elements = [family(name)[1] for name in names]
    numbers = [index if element is None else element for index, element in enumerate(elements)]
    curves = [smooth(result, name) if len(names) <= FEW_LINES else (result.t, result[name]) for name in names]
    lines = LineCollection([np.column_stack(thinned(*curve)) for curve in curves], cmap=scale, linewidths=0.8)
    lines.set_array(np.array(numbers, dtype=float))
    ax.add_collection(lines)
    ax.autoscale_view()
    bar = ax.figure.colorbar(lines, ax=ax, pad=0.01, fraction=0.04, aspect=30)
    bar.outline.set_visible(False)
    bar.set_label(_family_label(names), size=8)


def _family_label(names: list[str]) -> str:
    families = {family(name)[0] for name in names}
    return families.pop() if len(families) == 1 else f"{len(names)} signals, in order"


def _label(signals: Sequence[Signal], prefix: str = "") -> str:
    quantities = {signal.name.rpartition(".")[2].partition("[")[0] for signal in signals}
    words = quantities.pop().replace("_", " ") if len(quantities) == 1 else ""
    unit = signals[0].unit
    return f"{words} [{prefix}{unit}]".strip() if unit not in ("", "1") else words


def _draw_limits(ax: Axes, result: Result, names: Sequence[str]) -> list[str]:
    """A line for each limit of the netlist on one of the signals; returns words for those that are far outside."""
    (low, high), words = ax.get_ylim(), list[str]()
    for limit in result.run.get("limits") or ():
        fits, bound, said = matcher(str(limit["signal"])), float(limit["bound"]), f"limit: {limit['text']}"
        if not any(map(fits, names)) or not np.isfinite(bound):
            continue
        if low - FAR * (high - low) <= bound <= high + FAR * (high - low):
            ax.axhline(bound, color=LIMIT, linestyle="--", linewidth=0.9, zorder=2)
            ax.text(1.0, bound, said, transform=ax.get_yaxis_transform(), ha="right", va="bottom", size=7, color=LIMIT,
                    parse_math=False)  # fmt: skip
        else:
            words.append(f"{said} ({'above' if bound > high else 'below'} this picture)")
    return words


def _label_ticks(ax: Axes, result: Result) -> list[str]:
    """Who changed zone, and to which, where there are few changes; else returns how many there are, in words."""
    events = list(result.events)
    if len(events) > MOST_LABELLED:
        return [f"{len(events)} zone changes"]
    for event in events:
        ax.text(event.t, 0.95, f"{event.component} {event.zone_to}", transform=ax.get_xaxis_transform(), rotation=90,
                ha="center", va="top", size=6, color="0.45", clip_on=True, parse_math=False)  # fmt: skip
    return []


def _draw_ticks(ax: Axes, times: NDArray[np.float64]) -> None:
    """Mark zone changes faintly below the upper edge; a dense band where there are many."""
    if len(times) > MOST_TICKS:
        low, high = times.min(), times.max()
        width = (high - low) / MOST_TICKS or 1.0
        times = low + width * np.unique(np.round((times - low) / width))
    ax.plot(
        times,
        np.full_like(times, 0.975),
        linestyle="none",
        marker="|",
        markersize=7,
        markeredgewidth=0.6,
        color="0.45",
        alpha=0.5,
        transform=ax.get_xaxis_transform(),
        clip_on=True,
        zorder=3,
    )
