"""Figures 3, 5 and 6 of the source paper, from the classes and the scene that follow it.

Tomlinson, Cooke and Cosserat (2003), Proc. IMechE Part I 217, 139, DOI 10.1177/095965180321700207. The paper gives
shapes, the speed and two friction levels; all other numbers are those of the library's curve and of `single_bend`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fairlead.report.figures import WIDTH
from fairlead.report.panel import COLOURS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from fairlead.analysis.characteristic import Characteristic
    from fairlead.results import Result

SLIDES = ("slide_forward", "slide_backward")
WIDE = 1.6  # times v_n and stiction: how far the prism is shown


def figure3(found: Characteristic) -> Figure:
    """Sliding friction over slip speed, of a contact with the curve `hump` (Fig. 3)."""
    figure, ax = _begun("Figure 3: sliding friction over relative velocity")
    for zone in SLIDES:
        ax.plot(*found.branches[zone], color=COLOURS[0])
    ax.plot([0, 0], [-found.breakaway, found.breakaway], color="black", linewidth=2)
    ax.annotate("stiction", (0, found.breakaway), xytext=(-8, -4), ha="right", textcoords="offset points", fontsize=8)
    reach = max(float(np.abs(found.branches[zone][0]).max()) for zone in SLIDES)
    ax.set_xlim(-reach / 3, reach / 3)
    ax.set_xlabel("relative velocity [m/s]")
    ax.set_ylabel("friction [N]")
    return figure


def prism(p: Any, normal: float, v: NDArray[np.float64], af: NDArray[np.float64]) -> NDArray[np.float64]:
    """Viscous coefficient [N s/m] over slip speed and applied force [N]: Eq. (3) with v_m, v_n, creep of a contact.

    f_m = F_s/creep up to v_m, on a straight line to nothing at v_n, and nothing where the applied force is above F_s.
    """
    rest = normal * p.mu_s
    share = np.clip((p.v_n - np.abs(v)) / (p.v_n - p.v_m), 0.0, 1.0)
    return np.where(np.abs(af) <= rest, rest / p.creep * share, 0.0)


def figure5(p: Any, normal: float) -> Figure:
    """The truncated prism of the viscous coefficient (Fig. 5), for a binding contact with the values `p`."""
    from matplotlib.figure import Figure

    v = np.linspace(-WIDE * p.v_n, WIDE * p.v_n, 161)
    af = np.linspace(-WIDE, WIDE, 161) * normal * p.mu_s
    V, A = np.meshgrid(v, af)
    figure: Figure = Figure(figsize=(WIDTH, 4.6), layout="constrained")
    ax: Any = figure.add_subplot(projection="3d")
    ax.plot_surface(1e3 * V, A, prism(p, normal, V, A) / 1e3, cmap="viridis", linewidth=0, rcount=161, ccount=161)
    ax.set_xlabel("relative velocity [mm/s]")
    ax.set_ylabel("applied force [N]")
    ax.set_zlabel("viscous coefficient [kN s/m]")
    ax.view_init(28, -58)
    ax.set_box_aspect(None, zoom=0.85)  # room for the words on the axes, which the layout does not count
    figure.suptitle("Figure 5: viscous friction over relative velocity and applied force", x=0.01, ha="left")
    return figure


def figure6(results: Sequence[Result], titles: Sequence[str]) -> Figure:
    """Velocities of hose and bulkhead of the node that rucks first, side by side; rucks are marked (Fig. 6)."""
    from matplotlib.figure import Figure

    from fairlead.analysis.margins.ruck import verdicts

    told = [verdicts(result)[0] for result in results]
    node = next((one["element"] for one in told if one["rucks"]), told[-1]["element"])
    figure: Figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    axes = figure.subplots(1, len(results), sharey=True, squeeze=False)[0]
    for ax, result, title, one in zip(axes, results, titles, told, strict=True):
        for child, name, colour in (("hose_node", "hose", COLOURS[0]), ("core_node", "bulkhead", COLOURS[1])):
            ax.plot(result.t, result[f"line.{child}[{node}].v"], color=colour, label=name, linewidth=0.9)
        if one["rucks"]:
            ax.axvline(one["t"], color="#D3261A", linewidth=1, linestyle="--")
            ax.annotate(f"rucks at {one['t']:.3g} s", (one["t"], 0.97), xycoords=("data", "axes fraction"), fontsize=8,
                        color="#D3261A", xytext=(4, 0), textcoords="offset points", va="top")  # fmt: skip
        ax.set_title(f"{title}: {'rucks' if one['rucks'] else 'no ruck'}", fontsize=9)
        ax.set_xlabel("time [s]")
    axes[0].set_ylabel("velocity, outboard positive [m/s]")
    axes[0].legend(loc="lower right")
    figure.suptitle(f"Figure 6: hose and bulkhead, node {node} of the line", x=0.01, ha="left")
    return figure


def _begun(title: str) -> tuple[Figure, Any]:
    from matplotlib.figure import Figure

    figure: Figure = Figure(figsize=(WIDTH, 3.6), layout="constrained")
    figure.suptitle(title, x=0.01, ha="left")
    return figure, figure.subplots()
