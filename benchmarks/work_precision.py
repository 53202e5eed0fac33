"""The figure of the comparison: error against CPU time, a panel per case, a line per way of solving."""

from __future__ import annotations

import pathlib
from typing import Any

STYLES: dict[str, dict[str, Any]] = {
    "fairlead hold rodas5p": {"color": "#b3261e", "marker": "o", "linewidth": 2.2},
    "fairlead hold rodas3p": {"color": "#e07a5f", "marker": "s"},
    "fairlead hold stepping": {"color": "#c2185b", "marker": "D", "linewidth": 2.2},
    "fairlead hold ida": {"color": "#8d5a97", "marker": "p"},
    "fairlead binding rodas5p": {"color": "#e0a458", "marker": "d"},
    "scipy events LSODA": {"color": "#1d3557", "marker": "v"},
    "scipy events RK45": {"color": "#457b9d", "marker": "^"},
    "scipy events DOP853": {"color": "#6fa8c9", "marker": "<"},
    "scipy events Radau": {"color": "#7d8597", "marker": ">"},
    "scipy events BDF": {"color": "#adb5bd", "marker": "P"},
    "scipy smooth LSODA": {"color": "#457b9d", "marker": "x", "linestyle": ":"},
    "scipy smooth BDF": {"color": "#adb5bd", "marker": "+", "linestyle": ":"},
    "scipy smooth Radau": {"color": "#7d8597", "marker": "1", "linestyle": ":"},
    "sundae events BDF": {"color": "#2a6f4e", "marker": "v", "linestyle": "--"},
    "sundae events Adams": {"color": "#52a675", "marker": "^", "linestyle": "--"},
    "PathSim events RKBS32": {"color": "#a98467", "marker": "v", "linestyle": "-."},
    "PathSim events RKCK54": {"color": "#7f5539", "marker": "^", "linestyle": "-."},
    "PathSim events RKDP87": {"color": "#ddb892", "marker": "<", "linestyle": "-."},
    "MuJoCo frictionloss Euler": {"color": "#222222", "marker": "v", "linestyle": ":"},
    "MuJoCo frictionloss implicitfast": {"color": "#555555", "marker": "^", "linestyle": ":"},
    "MuJoCo frictionloss RK4": {"color": "#888888", "marker": "<", "linestyle": ":"},
}
TITLES = {
    "belt": "Block on a belt, 50 cycles", "chain-10": "Rod on 10 guides, 3 s", "chain-100": "Rod on 100 guides, 3 s",
    "chain-1000": "Rod on 1000 guides, 3 s",
}  # fmt: skip
LONGEST = 100  # letters of a line under the figure


def figure(result: dict[str, Any], path: pathlib.Path) -> None:
    """Draw the rows of `compare.py` into a PNG file."""
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    style = {"font.size": 9, "axes.spines.top": False, "axes.spines.right": False, "axes.edgecolor": "0.4"}
    cases = result["cases"]
    with plt.rc_context(style):
        drawing, axes = plt.subplots(-(-len(cases) // 2), 2, figsize=(11, 8.4), layout="constrained", squeeze=False)
        for ax, (name, case) in zip(axes.flat, cases.items(), strict=False):
            panel(ax, TITLES.get(name, name), case["rows"])
        handles = {line.get_label(): line for ax in axes.flat for line in ax.get_lines()}
        shown = [name for name in STYLES if name in handles]
        drawing.legend(
            [handles[name] for name in shown], [name.replace("sundae", "scikit-sundae CVODE") for name in shown],
            loc="outside right center", frameon=False, fontsize=8,
        )  # fmt: skip
        drawing.savefig(path, dpi=110, metadata={"Software": "fairlead"})
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
    absent = {row["program"]: row["failed"] for row in rows if row.get("failed", "").startswith("cannot: ")}
    reasons = [f"{program} {reason}"[:LONGEST] for program, reason in absent.items()]
    ax.set_title("\n".join([title, *reasons]), loc="left", fontsize=8 if reasons else 10)
    ax.set_xlabel("error over 0.1 m")
    ax.set_ylabel("CPU time [ms]")
    ax.set_xlim(right=1.0)
    ax.invert_xaxis()
    ax.grid(color="0.92")
    ax.set_axisbelow(True)
