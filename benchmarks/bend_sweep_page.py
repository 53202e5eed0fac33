"""Tables and figure of bend_sweep.py: a part of docs/bend_tables.md, docs/figures/bend_sweep.png."""

from __future__ import annotations

import pathlib
from collections.abc import Mapping
from typing import Any

from bend_sweep import FRICTIONS, STOP, TENSIONS, TREATMENTS, Key

DOCS = pathlib.Path(__file__).parents[1] / "docs"
PAGE = DOCS / "bend_tables.md"
BEGIN, END = "<!-- bend_sweep.py writes from here -->", "<!-- to here -->"
COLOURS = {400.0: "#009E73", 800.0: "#0072B2", 1600.0: "#D55E00"}  # Okabe and Ito (2008)
MARKERS = {"exact": "o", "robust": "s", "tanh": "^", "LuGre": "v", "literal, naive, h 0.1": "x"}

Rows = Mapping[Key, dict[str, Any]]


def write(rows: Rows) -> None:
    """Put the tables into the page, draw the figure."""
    before, _, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    if not rest:
        raise SystemExit(f"{PAGE} has no line {BEGIN}")
    told = "\n\n".join([summary(rows), *(f"{tension:g} N outboard\n\n{table(rows, tension)}" for tension in TENSIONS)])
    commits = ", ".join(sorted({row["commit"] for row in rows.values()}))
    work = sum(row["cpu_s"] for row in rows.values())
    text = f"{BEGIN}\n{told}\n\n{len(rows)} runs, {work:.0f} s of processor time, commit {commits}.\n{END}"
    PAGE.write_text(before + text + rest.partition(END)[2], encoding="utf-8")
    draw(rows)


def summary(rows: Rows) -> str:
    """How many runs ended how, by treatment."""
    lines = ["| treatment | to the end | otherwise ended | worst ratio of tensions | processor time of a run |",
             "| --- | --- | --- | --- | --- |"]  # fmt: skip
    for treatment in TREATMENTS:
        mine = [row for (_, _, one), row in rows.items() if one == treatment]
        done = [row for row in mine if row["status"] == "finished"]
        ended = [row["end"] for row in mine if row["status"] != "finished"]
        early = f"at {min(ended):.3f} ... {max(ended):.3f} s" if ended else ""
        worst = f"{100 * max((row['excess'] for row in done), key=abs):+.1f} %" if done else ""
        times = [row["cpu_s"] for row in done]
        cost = f"{min(times):.1f} ... {max(times):.1f} s" if times else ""
        lines.append(f"| {treatment} | {len(done)} of {len(mine)} | {early} | {worst} | {cost} |")
    return "\n".join(lines)


def table(rows: Rows, tension: float) -> str:
    """De-registration, tension inboard, steps, switches, ruck over friction, for treatments that came to their end."""
    shown = [one for one in TREATMENTS if one in MARKERS]
    lines = ["| friction | " + " | ".join(shown) + " |", "| --- |" + " --- |" * len(shown)]
    for mu in FRICTIONS:
        lines.append(f"| {mu:.2f} | " + " | ".join(cell(rows.get((mu, tension, one))) for one in shown) + " |")
    return "\n".join(lines)


def cell(row: dict[str, Any] | None) -> str:
    """What is told of a run."""
    if row is None:
        return "not run"
    if row["status"] != "finished":
        return f"ended at {row['end']:.2g} s"
    ruck = "" if row["ruck_s"] is None else f", ruck {row['ruck_s']:.1f} s"
    excess = 100 * row["excess"] + 0.0
    return f"{row['registration_mm']:.1f} mm, {excess:+.1f} %, {row['steps']}/{row['switches']}{ruck}"


def draw(rows: Rows) -> None:
    """De-registration and the tension inboard, over friction."""
    import matplotlib
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    matplotlib.rcParams.update({"font.size": 8, "axes.spines.top": False, "axes.spines.right": False})
    figure = Figure(figsize=(8.5, 3.4), layout="constrained")
    left, right = figure.subplots(1, 2)
    for (mu, tension, treatment), row in rows.items():
        if treatment in MARKERS and row["status"] == "finished":
            look = {"color": COLOURS[tension], "marker": MARKERS[treatment], "ms": 3.5, "mfc": "none", "lw": 0}
            left.plot(mu, row["registration_mm"], **look)
            right.plot(mu, 100 * row["excess"], **look)
    left.axvspan(0.394, 0.492, color="0.93")
    left.text(0.443, 500, "bulkheads\nmay slip", ha="center", va="top", fontsize=7)
    left.set_yscale("log")
    left.set_yticks([5, 10, 20, 50, 100, 200, 500], ["5", "10", "20", "50", "100", "200", "500"])
    left.minorticks_off()
    left.set_title(f"greatest de-registration in {STOP:g} s [mm]", fontsize=9, loc="left")
    right.axhline(0, color="0.75", lw=1)
    right.set_title("mean tension inboard over the capstan's, less one [%]", fontsize=9, loc="left")
    handles = [Line2D([], [], color=colour, lw=3, label=f"{tension:g} N") for tension, colour in COLOURS.items()]
    handles += [Line2D([], [], color="0.3", marker=m, ms=3.5, mfc="none", lw=0, label=k) for k, m in MARKERS.items()]
    right.legend(handles=handles, frameon=False, fontsize=7)
    for ax in (left, right):
        ax.set_xlabel("friction of the hose on the bend")
    figure.savefig(DOCS / "figures" / "bend_sweep.png", dpi=110)
