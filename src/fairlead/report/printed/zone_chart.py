"""The zone chart for print: a row for each part that changed zone, coloured spans for its zones."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from fairlead.errors import UsageError
from fairlead.patterns import picked
from fairlead.report.figures import WIDTH
from fairlead.report.page.zones import meaning, starts
from fairlead.results.events import PIECE
from fairlead.results.signal import family

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from fairlead.results import Result

MOST_ROWS, MOST_LABELS = 400, 48
EDGE = "#8a94a3"
HUES = {"stuck": "#0072B2", "forward": "#E69F00", "backward": "#CC79A7", "between": "#7B68C8", "off": "#E4E7EB",
        "slack": "#56B4E9", "ruck": "#D3261A", "sound": "#93AD99"}  # fmt: skip
"""Colours by what a zone means, those of the page."""
OWN = ("#D55E00", "#DDCC77", "#8A8A2A", "#B07AA1", "#9C755F", "#76B7B2", "#009E73", "#4E79A7")
"""Of zones with words of their own, also those of the page: none is the colour of sticking or sliding."""

Span = tuple[float, float, str]


def spans(result: Result) -> dict[str, list[Span]]:
    """By part that changed zone: from, to [s] and zone, from the first row of the run to its last."""
    first, last = float(result.t[0]), float(result.t[-1])
    begun, found = starts(result.run), dict[str, list[Span]]()
    since: dict[str, tuple[float, str]] = {}
    for event in result.events:
        t, zone = since.get(event.component, (first, begun.get(event.component, event.zone_from)))
        found.setdefault(event.component, []).append((t, event.t, zone))
        since[event.component] = (event.t, event.zone_to)
    for name, (t, zone) in since.items():
        found[name].append((t, last, zone))
    return found


def row_labels(names: Sequence[str]) -> tuple[dict[int, str], list[int]]:
    """Labels by row, far enough apart to be read, and the rows at which another kind of part begins.

    The first of a kind has its whole name; of those after it that have room, the number: `line.hose[0]`, `[4]`, `[8]`.
    """
    kinds = [family(name)[0] for name in names]
    begin = [k for k, kind in enumerate(kinds) if k == 0 or kind != kinds[k - 1]]
    apart = -(-len(names) // MOST_LABELS)
    found: dict[int, str] = {}
    for first, after in zip(begin, [*begin[1:], len(names)], strict=True):
        if not found or first - max(found) >= apart:
            found[first] = names[first]
        for k in range(first + apart, after - apart + 1, apart):
            if k - max(found) >= apart:
                found[k] = names[k] if apart == 1 else f"[{family(names[k])[1]}]"
    return found, begin


def zone_chart(result: Result, names: Sequence[str], times: Sequence[float]) -> Figure:
    """Rows by part: those that `names` pick, else all but pieces of tables. Two `times` [s] limit the time.

    Raises UsageError when nothing that was asked for changed zone.
    """
    from matplotlib.figure import Figure

    found = spans(result)
    if names:
        known = dict.fromkeys(found)
        chosen = {name: found[name] for pattern in names for name in picked(known, pattern)}
    else:
        chosen = {name: each for name, each in found.items() if not all(PIECE.fullmatch(zone) for *_, zone in each)}
    if not chosen:
        raise UsageError("No part that was asked for changed its zone.\n    Result.switches() lists those that did.")
    kinds = {kind: k for k, kind in enumerate(dict.fromkeys(family(name)[0] for name in chosen))}
    rows = sorted(chosen.items(), key=lambda one: (kinds[family(one[0])[0]], family(one[0])[1] or 0))[:MOST_ROWS]
    figure: Figure = Figure(figsize=(WIDTH, min(1.2 + 0.16 * len(rows), 11.0)), layout="constrained")
    ax = figure.subplots()
    words = list(dict.fromkeys(zone for _, each in rows for *_, zone in each))
    own = {word: OWN[k % len(OWN)] for k, word in enumerate(w for w in words if not meaning(w))}
    hues = {word: HUES.get(meaning(word)) or own[word] for word in words}
    for k, (_, each) in enumerate(rows):
        ax.broken_barh([(a, b - a) for a, b, _ in each], (k - 0.45, 0.9), color=[hues[zone] for *_, zone in each])
    labels, begin = row_labels([name for name, _ in rows])
    ax.set_yticks(list(labels), list(labels.values()), fontsize=7)
    for k in begin[1:]:
        ax.axhline(k - 0.5, color=EDGE, linewidth=0.6)
    ax.set_ylim(len(rows) - 0.5, -0.5)
    ax.set_xlim(*(times if len(times) == 2 else (result.t[0], result.t[-1])))
    ax.grid(visible=False, axis="y")
    ax.set_xlabel("time [s]")
    marks = [ax.barh(-9, 0, color=hues[word], label=word) for word in words]
    ax.legend(handles=marks, loc="lower left", bbox_to_anchor=(0, 1.0), ncols=min(len(words), 6), borderaxespad=0.2)
    left = f", first {len(rows)} of {len(chosen)} parts" if len(rows) < len(chosen) else ""
    figure.suptitle(f"{result.run.get('name', '')}: zones{left}", x=0.01, horizontalalignment="left", parse_math=False)
    return figure
