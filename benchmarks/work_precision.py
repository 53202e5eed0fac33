"""The figure of the comparison: error against CPU time, a panel per case, a line per way of solving.

fairlead is drawn in strong colours, its peers pale by family; a broad grey line is the best any peer does.
"""

from __future__ import annotations

import pathlib
import textwrap
from typing import Any

from compare_table import AIMS

STYLES: dict[str, dict[str, Any]] = {
    "fairlead hold stepping": {"color": "#c2185b", "marker": "D"},
    "fairlead hold rodas5p": {"color": "#d1410c", "marker": "o"},
    "fairlead hold rodas3p": {"color": "#e8890c", "marker": "s"},
    "fairlead hold ida": {"color": "#7b3fa0", "marker": "p"},
    "fairlead binding rodas5p": {"color": "#d1410c", "marker": "o", "linestyle": ":", "markerfacecolor": "white"},
    "scipy events LSODA": {"color": "#5b8db8", "marker": "v"},
    "scipy events RK45": {"color": "#5b8db8", "marker": "^"},
    "scipy events DOP853": {"color": "#5b8db8", "marker": "<"},
    "scipy events Radau": {"color": "#5b8db8", "marker": ">"},
    "scipy events BDF": {"color": "#5b8db8", "marker": "P"},
    "scipy smooth LSODA": {"color": "#5b8db8", "marker": "v", "linestyle": ":", "markerfacecolor": "white"},
    "scipy smooth BDF": {"color": "#5b8db8", "marker": "P", "linestyle": ":", "markerfacecolor": "white"},
    "scipy smooth Radau": {"color": "#5b8db8", "marker": ">", "linestyle": ":", "markerfacecolor": "white"},
    "sundae events BDF": {"color": "#3f9b6c", "marker": "P"},
    "sundae events Adams": {"color": "#3f9b6c", "marker": "^"},
    "PathSim events RKBS32": {"color": "#a98467", "marker": "v"},
    "PathSim events RKCK54": {"color": "#a98467", "marker": "^"},
    "PathSim events RKDP87": {"color": "#a98467", "marker": "<"},
    "MuJoCo frictionloss Euler": {"color": "#6b6b6b", "marker": "v"},
    "MuJoCo frictionloss implicitfast": {"color": "#6b6b6b", "marker": "P"},
    "MuJoCo frictionloss RK4": {"color": "#6b6b6b", "marker": "<"},
}
TITLES = {
    "belt": "Block on a belt, 50 cycles", "chain-10": "Rod on 10 guides, 3 s", "chain-100": "Rod on 100 guides, 3 s",
    "chain-1000": "Rod on 1000 guides, 3 s",
}  # fmt: skip
NAMES = {"sundae": "CVODE", "frictionloss": "", "hold": "exact,", "binding": "binding,", "events": "exact,",
         "smooth": "tanh,"}  # fmt: skip
SPAN = (1.0, 1e-9)  # of errors shown
MARKS = {"aim": {"marker": "*", "markersize": 17, "color": "#ffc107", "markeredgecolor": "#5d4300"},
         "C": {"marker": "X", "markersize": 9, "color": "white", "markeredgecolor": "black"}}  # fmt: skip


def figure(result: dict[str, Any], path: pathlib.Path) -> None:
    """Draw the rows of `compare.py` into a PNG file."""
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    style = {"font.size": 10, "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": "0.4"}
    cases = result["cases"]
    with plt.rc_context(style):
        drawing = plt.figure(figsize=(13, 10), layout="constrained")
        left, right = drawing.subfigures(1, 2, width_ratios=(4.7, 1.0))
        axes = left.subplots(-(-len(cases) // 2), 2, squeeze=False)
        for ax, (name, case) in zip(axes.flat, cases.items(), strict=False):
            panel(ax, name, case["rows"])
        legends(right, axes)
        drawing.savefig(path, dpi=100, metadata={"Software": "fairlead"})
        plt.close(drawing)


def legends(beside: Any, axes: Any) -> None:
    """One for fairlead with the marks, below it one for its peers."""
    handles = {line.get_label(): line for ax in axes.flat for line in ax.get_lines()}
    ours = [name for name in STYLES if name in handles and name.startswith("fairlead")]
    theirs = [name for name in STYLES if name in handles and not name.startswith("fairlead")]
    ours += [name for name in ("aim, time in the loop", "C by hand") if name in handles]
    theirs += [name for name in ("best of the peers",) if name in handles]
    for names, title, height in ((ours, "fairlead", 0.97), (theirs, "Peers", 0.72)):
        beside.legend(
            [handles[name] for name in names], [spoken(name, title) for name in names], loc="upper left",
            bbox_to_anchor=(0.0, height), title=title, frameon=False, fontsize=9.5, alignment="left",
            title_fontproperties={"weight": "bold", "size": 11}, labelspacing=0.45,
        )  # fmt: skip


def spoken(series: str, title: str) -> str:
    """The name of a line in the legend."""
    words = [NAMES.get(word, word) for word in series.split()] if series in STYLES else [series]
    return " ".join(word for word in words if word and word != title)


def panel(ax: Any, name: str, rows: list[dict[str, Any]]) -> None:
    """One case: each way of solving by error; of the smooth law only the cheapest run at each error."""
    peers = front([point(row) for row in rows if row["program"] != "fairlead" and "error" in row])
    if peers:
        ax.loglog(*zip(*peers, strict=True), color="0.85", linewidth=9, solid_capstyle="round", zorder=1,
                  label="best of the peers")  # fmt: skip
    for series, style in STYLES.items():
        points = sorted(point(row) for row in rows if row["series"] == series and "error" in row)
        if "smooth" in series or "binding" in series:
            points = front(points)
        ours = series.startswith("fairlead")
        size = {"markersize": 7, "linewidth": 2.4, "zorder": 5} if ours else \
            {"markersize": 5, "linewidth": 1.0, "alpha": 0.9, "zorder": 3}  # fmt: skip
        if points:
            ax.loglog(*zip(*points, strict=True), label=series, **size, **style)
    for (case, wanted), (aim, _, by_hand) in AIMS.items():
        if case == name:
            told = ((aim, "aim", "aim, time in the loop"), (by_hand, "C", "C by hand"))
            for seconds, mark, text in told:
                if seconds:
                    ax.loglog([wanted], [1e3 * seconds], linestyle="", zorder=6, label=text, **MARKS[mark])
    ax.set_title(TITLES.get(name, name), loc="left", fontsize=12, fontweight="bold")
    ax.set_xlabel("error over 0.1 m")
    ax.set_ylabel("CPU time of a whole call [ms]")
    ax.set_xlim(*SPAN)
    ax.grid(color="0.93")
    ax.set_axisbelow(True)
    if absent(rows):
        ax.text(
            0.015, 0.985, absent(rows), transform=ax.transAxes, va="top", fontsize=8.2, color="0.35", linespacing=1.25
        )
        low, high = ax.get_ylim()
        ax.set_ylim(low, high * (high / low) ** (0.05 * (absent(rows).count("\n") + 1)))


def point(row: dict[str, Any]) -> tuple[float, float]:
    """Error and CPU time [ms]."""
    return row["error"], 1e3 * row["cpu"]


def front(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """The points that no other beats in both, by rising error."""
    return sorted(p for p in points if not any(q[0] <= p[0] and q[1] <= p[1] and q != p for q in points))


def absent(rows: list[dict[str, Any]]) -> str:
    """What the panel cannot show: who gave no result at all, in lines."""
    told: dict[str, list[str]] = {}
    for series in dict.fromkeys(row["series"] for row in rows):
        mine = [row for row in rows if row["series"] == series]
        if any(row.get("error", SPAN[0]) < SPAN[0] for row in mine):
            continue
        reason = mine[0].get("failed", "off by more than 0.1 m").removeprefix("failed: ").removeprefix("cannot: ")
        reason = reason.partition(", came to")[0].partition(" at t =")[0]
        told.setdefault(reason, []).append(spoken(series, ""))
    lines = [f"{reason}: {'; '.join(who)}" for reason, who in told.items()]
    return "\n".join(textwrap.fill(line, 80) for line in lines)
