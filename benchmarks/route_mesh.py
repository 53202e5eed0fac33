"""Elements of the guidance route: halved again and again, and shifted by half an element against the devices.

    python benchmarks/route_mesh.py            runs what is missing in benchmarks/data, some minutes of CPU
    python benchmarks/route_mesh.py --table    the table, and the figure docs/figures/route_mesh.png

The bundled `guidance_route` is started and pays out steadily, at accuracy 1e-4. In the shifted runs the first element
of the line and the last one are half as long, so that all nodes in between meet every device half an element earlier;
the line itself is the same. Steady are means over 5 to 8 s, in which whole numbers of elements pass.
"""

from __future__ import annotations

import argparse
import json
import math
import pathlib
import shutil
import tempfile
import warnings
from typing import Any

import numpy as np
from machine import commit

HERE = pathlib.Path(__file__).parent
DATA, MODELS = HERE / "data" / "route_mesh.jsonl", HERE.parent / "models"
ELEMENT = 'element: "{element}"'
ELEMENTS = [0.5, 0.25, 0.125]
MU, BEND_A, BEND_B = 0.35, math.pi / 2, math.pi / 3
LENGTH = 40.0
STEADY = (5.0, 8.0)
QUANTITIES = {
    "bend_a": "ratio of tensions at bend A, over the exponential, less one",
    "bend_b": "the same at bend B",
    "force_N": "mean force of the deployer in the first 2 s, N",
    "peak_N": "greatest tension in the route, N",
    "registration_mm": "greatest de-registration in the first second, mm",
    "lowest_hose_N": "lowest tension of the hose, N",
}


def run(element: float, shifted: bool) -> dict[str, Any]:
    """One run in the figures of the table."""
    import fairlead

    settings = {"element": f"{element} m", "mu": str(MU), "run.stop": "8 s", "run.accuracy": "1e-4",
                "record.every": "10 ms"}  # fmt: skip
    with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        model = with_half_ends(folder, element) if shifted else "guidance_route"
        result = fairlead.load(model, set=settings).run(out=f"{folder}/run", check=False)
        if result.status != "finished":
            raise SystemExit(f"element {element} m: {result.run['sentence']}")
        return {"element": element, "shifted": shifted, **figures(result), "steps": result.run["steps"],
                "solve_s": round(result.run["solve_time"], 1), "commit": commit()}  # fmt: skip


def with_half_ends(folder: str, element: float) -> str:
    """A copy of the netlist in which the line begins and ends with half an element."""
    half, near = element / 2, element / 2 + 1e-6
    points = [(0.0, half), (half, half), (near, element)]
    points += [(LENGTH - place, length) for place, length in reversed(points)]
    graded = "[" + ", ".join(f"[{place!r}, {length!r}]" for place, length in points) + "]"
    path = pathlib.Path(folder)
    shutil.copytree(MODELS / "parts", path / "parts")
    part = path / "parts" / "array_route.yaml"
    text = part.read_text(encoding="utf-8")
    part.write_text(text.replace(ELEMENT, f"{ELEMENT}\n    graded: {graded}"), encoding="utf-8")
    return shutil.copy(MODELS / "guidance_route.yaml", path)


def figures(result: Any) -> dict[str, float]:
    """The quantities of a run."""
    t = result.t
    hose, core = (result.columns(result.match(f"line.{layer}[*].tension")) for layer in ("hose", "core"))
    nodes = result.columns(result.match("line.hose_node[*].x"))
    middle, tension = (nodes[:, 1:] + nodes[:, :-1]) / 2, hose + core
    rows = np.searchsorted(t, np.arange(STEADY[0], STEADY[1] - 1e-9, 0.01))
    at = np.mean([np.interp([1.0, 4.2, 7.2, 9.5], middle[k], tension[k]) for k in rows], axis=0)
    force = -result.columns(result.match("line.outer_deployer[*].friction")).sum(axis=1)
    start, first = t <= 2.0, t <= 1.0
    inside = (nodes[:, 1:] < 9.5) & (nodes[:, :-1] > 0.0)
    registration = np.abs(result.columns(result.match("line.registration[*].d")))
    return {
        "bend_a": float(at[1] / at[0] / math.exp(MU * BEND_A) - 1),
        "bend_b": float(at[3] / at[2] / math.exp(MU * BEND_B) - 1),
        "force_N": float(np.trapezoid(force[start], t[start]) / 2.0),
        "peak_N": float(np.where(inside, tension, -np.inf).max()),
        "registration_mm": float(1e3 * registration[first].max()),
        "lowest_hose_N": float(hose.min()),
    }


def kept() -> dict[tuple[float, bool], dict[str, Any]]:
    """Rows of the data file by element and whether it is shifted."""
    if not DATA.exists():
        return {}
    rows = [json.loads(line) for line in DATA.read_text(encoding="utf-8").splitlines() if line.strip()]
    return {(row["element"], row["shifted"]): row for row in rows}


def complete() -> None:
    """Run what is missing."""
    for element in ELEMENTS:
        for shifted in (False, True):
            if (element, shifted) not in kept():
                row = run(element, shifted)
                with DATA.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(row) + "\n")
                print(row, flush=True)


def table(rows: dict[tuple[float, bool], dict[str, Any]]) -> str:
    """Each quantity over the elements, what the shift changes, and the order that the last three show."""
    elements = sorted({element for element, _ in rows}, reverse=True)
    lines = ["| | " + " | ".join(f"{1e3 * e:g} mm" for e in elements) + " | order |",
             "| --- |" + " --- |" * (len(elements) + 1)]  # fmt: skip
    for name, words in QUANTITIES.items():
        values = [rows[e, False][name] for e in elements]
        shifts = [rows[e, True][name] - rows[e, False][name] if (e, True) in rows else math.nan for e in elements]
        lines.append(f"| {words} | " + " | ".join(shown(name, v) for v in values) + f" | {order(values)} |")
        lines.append("| shifted by half an element | " + " | ".join(f"{v:+.2g}" for v in shifts) + " | |")
    return "\n".join(lines)


def shown(name: str, value: float) -> str:
    """A value with the digits it needs."""
    return f"{value:.2g}" if name.startswith("bend") else f"{value:.4g}"


def order(values: list[float]) -> str:
    """Order in which the last three approach each other; where they do not, none."""
    a, b = abs(values[-3] - values[-2]), abs(values[-2] - values[-1])
    return f"{math.log2(a / b):.1f}" if a > b > 0 else "-"


def draw(rows: dict[tuple[float, bool], dict[str, Any]]) -> None:
    """What halving the elements changes, and what shifting them does, over their length."""
    import matplotlib
    from matplotlib.figure import Figure

    matplotlib.rcParams.update({"font.size": 8, "axes.spines.top": False, "axes.spines.right": False})
    figure = Figure(figsize=(8, 4.2), layout="constrained")
    axes = figure.subplots(1, 2)
    lengths = np.array([ELEMENTS[0], ELEMENTS[-1]])
    axes[0].loglog(lengths, 8.6e-4 * (lengths / 0.5) ** 2, color="0.75", lw=1, zorder=0)
    for ax, names in zip(axes, (["bend_a"], ["force_N", "peak_N", "registration_mm", "lowest_hose_N"]), strict=True):
        for name, colour in zip(names, ("#0072B2", "#D55E00", "#009E73", "#CC79A7"), strict=False):
            size = 1.0 if name == "bend_a" else max(abs(row[name]) for row in rows.values())
            plain = [e for e in ELEMENTS if (e, False) in rows]
            halved = [abs(rows[e, False][name] - rows[e / 2, False][name]) / size for e in plain[:-1]]
            shifted = [e for e in plain if (e, True) in rows]
            moved = [abs(rows[e, False][name] - rows[e, True][name]) / size for e in shifted]
            words = QUANTITIES[name].partition(",")[0]
            ax.loglog(plain[:-1], halved, "o-", color=colour, ms=4, label=f"{words}: halved")
            ax.loglog(shifted, moved, "x:", color=colour, ms=5, label=f"{words}: shifted")
        ax.set_xticks(ELEMENTS, [f"{1e3 * e:g}" for e in ELEMENTS])
        ax.minorticks_off()
        ax.set_xlabel("element [mm]")
        ax.legend(frameon=False, fontsize=7, loc="lower left", bbox_to_anchor=(0, 1.06))
    axes[0].set_title("sliding steadily (grey: order two)", fontsize=9, loc="left")
    axes[1].set_title("what the start makes, relative", fontsize=9, loc="left")
    figure.savefig(HERE.parent / "docs" / "figures" / "route_mesh.png", dpi=110)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--table", action="store_true", help="print the table and draw the figure")
    if not parser.parse_args().table:
        complete()
    print(table(kept()))
    draw(kept())
