"""The figure of the comparison: error against CPU time, a panel per case, a line per way of solving."""

from __future__ import annotations

import pathlib
from typing import Any

STYLES: dict[str, dict[str, Any]] = {
    "fairlead hold rodas5p": {"color": "#b3261e", "marker": "o", "linewidth": 2.2},
    "fairlead hold rodas3p": {"color": "#e07a5f", "marker": "s"},
    "fairlead binding rodas5p": {"color": "#e0a458", "marker": "D"},
    "scipy events LSODA": {"color": "#1d3557", "marker": "v"},
    "scipy events RK45": {"color": "#457b9d", "marker": "^"},
    "scipy events DOP853": {"color": "#6fa8c9", "marker": "<"},
    "scipy events Radau": {"color": "#7d8597", "marker": ">"},
    "scipy events BDF": {"color": "#adb5bd", "marker": "P"},
    "scipy smooth LSODA": {"color": "#2a6f4e", "marker": "x", "linestyle": "--"},
    "scipy smooth BDF": {"color": "#52a675", "marker": "+", "linestyle": "--"},
    "scipy smooth Radau": {"color": "#95cfae", "marker": "1", "linestyle": "--"},
}
TITLES = {"belt": "Block on a belt, 50 cycles", "chain-100": "Rod on 100 guides, 3 s"}


def figure(result: dict[str, Any], path: pathlib.Path) -> None:
    """Draw the rows of `compare.py` into a PNG file."""
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    style = {"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": "0.4"}
    with plt.rc_context(style):
        drawing, axes = plt.subplots(1, len(result["cases"]), figsize=(10.5, 4.6), layout="constrained", squeeze=False)
        for ax, (name, case) in zip(axes[0], result["cases"].items(), strict=True):
            panel(ax, TITLES.get(name, name), case["rows"])
        handles = {line.get_label(): line for ax in axes[0] for line in ax.get_lines()}
        drawing.legend(
            [handles[name] for name in STYLES if name in handles], [name for name in STYLES if name in handles],
            loc="outside right center", frameon=False, fontsize=8,
        )  # fmt: skip
        drawing.savefig(path, dpi=120, metadata={"Software": "fairlead"})
        plt.close(drawing)


def panel(ax: Any, title: str, rows: list[dict[str, Any]]) -> None:
    """One case: each way of solving by error; of the smooth law only the cheapest run at each error."""
    for series, style in STYLES.items():
        good = [row for row in rows if row["series"] == series and "error" in row]
        points = sorted((row["error"], 1e3 * row["cpu"]) for row in good)
        if "smooth" in series:
            points = [p for p in points if not any(q[0] <= p[0] and q[1] < p[1] for q in points)]
        if points:
            ax.loglog(*zip(*points, strict=True), label=series, markersize=5, **{"linewidth": 1.2, **style})
    ax.set_title(title, loc="left", fontsize=10)
    ax.set_xlabel("error over 0.1 m")
    ax.set_ylabel("CPU time [ms]")
    ax.set_xlim(right=1.0)
    ax.invert_xaxis()
    ax.grid(color="0.92")
    ax.set_axisbelow(True)
