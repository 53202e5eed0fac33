"""The page and the figure of friction_levels.py: docs/friction_levels.md, docs/figures/friction_levels.png."""

from __future__ import annotations

import pathlib
from collections.abc import Sequence
from typing import Any

from friction_levels import FRICTIONS, SHIPS, SPANS, closed_form

DOCS = pathlib.Path(__file__).parents[1] / "docs"
COLOURS = {2.0: "#0072B2", 4.0: "#D55E00", 6.0: "#009E73"}  # Okabe and Ito (2008)
TICKS = (50, 100, 200, 400, 800)  # N
LENGTHS = {"deploying": 12.4, "hauling": 9.35}  # m of line in the sea in the middle of the span
TEXT = """# All friction levels: does a whole handling system run?

<!-- table and figure written by benchmarks/friction_levels.py; the words are there too -->

The technique of fairlead was published with the claim that a whole handling system runs at every friction level. This
page tests the claim. The model is `guidance_route` with its own settings: 40 m of array are deployed, stopped and
recovered in 50 s, with electrohydraulic drives that are sampled at 10 ms. It runs at frictions of 0.05 to 1.0 of the
hose on the bends, each at three speeds of the ship.

```
python benchmarks/friction_levels.py            # runs what is missing in benchmarks/data/friction_levels.jsonl
python benchmarks/friction_levels.py --table    # this page
```

**{summary}**

![Tensions before and after the deployer over friction, and the time they take](figures/friction_levels.png)

**What happens at high friction?** From a friction of 0.5 on the hose does not follow the core, because the bulkheads
drag it along only up to 0.50 T_core/T (section 7a of [Physics](physics.md)). Single elements of hose stick and slip,
and the core goes slack for moments. The hose is compressed beyond the 160 N at which it rucks: from 0.75 on at 2 and
4 m/s, from 0.40 on at 6 m/s. This is a property of the route and not of the engine. It needs more steps, so the time
grows, and the winch tension is not held within a few newtons.

**Columns.** *Deviation* compares the four tensions of the route with those of steady sliding, and has the largest
difference: first deploying (mean over 18 to 24.9 s), then hauling (34 to 44 s). A line that sticks and slips does not
slide steadily, so its deviation is larger. The lowest tensions are those of the whole run; that of the core is in the
route.

{table}

**One run differs from the others.** At 1.00 and 2 m/s, while hauling, the whole line goes on shaking, so the tensions
are far from those of steady sliding. At 0.95 the line comes to steady sliding. So two motions are possible there, and
a small error decides between them. Make more than one run if you need a mean tension at such frictions.

Times are CPU seconds on a machine shared with others (commits {commits}). The energy ledger of every run closes to
{closure:.0e} of what was supplied, or better. [Lines and routes](routes.md) explains how to build such a route.
"""


def write(rows: Sequence[dict[str, Any]]) -> None:
    """Write the page and the figure from the rows of the data file."""
    done = [row for row in rows if row["status"] == "finished"]
    wanted = len(FRICTIONS) * len(SHIPS)
    failed = [row for row in rows if row["status"] != "finished"]
    summary = f"{len(done)} of {wanted} runs reached their end."
    if len(rows) < wanted:
        summary += f" {wanted - len(rows)} have not been run."
    for row in failed:
        summary += f" Friction {row['mu']:.2f}, ship {row['ship']:g} m/s: {row['sentence']}"
    commits = ", ".join(sorted({row["commit"] for row in rows}))
    closure = max(row["closure"] for row in done)
    text = TEXT.format(summary=summary, table=table(rows), commits=commits, closure=closure)
    (DOCS / "friction_levels.md").write_text(text, encoding="utf-8")
    draw(done)


def table(rows: Sequence[dict[str, Any]]) -> str:
    """A line for each friction, three columns for each speed of the ship."""
    found = {(row["mu"], row["ship"]): row for row in rows}
    ships = sorted(SHIPS)
    heads = [f"{ship:g} m/s: {what}" for ship in ships for what in ("deviation", "lowest hose, core", "steps, time")]
    lines = ["| friction | " + " | ".join(heads) + " |", "| --- |" + " --- |" * len(heads)]
    for mu in FRICTIONS:
        cells = [cell for ship in ships for cell in cells_of(found.get((mu, ship)))]
        lines.append(f"| {mu:.2f} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def cells_of(row: dict[str, Any] | None) -> tuple[str, str, str]:
    """What is told of a run."""
    if row is None:
        return "not run", "", ""
    if row["status"] != "finished":
        return f"ended at {row['end']:.3g} s", "", f"{row['steps']}, {row['cpu_s']:.0f} s"
    deviations = [100 * row[f"{span}_error"] for span in SPANS]
    lowest = f"{row['lowest_hose_N']:.0f}, {abs(row['lowest_core_N']):.0f} N"
    return f"{deviations[0]:.1f}, {deviations[1]:.1f} %", lowest, f"{row['steps']}, {row['cpu_s']:.0f} s"


def draw(rows: Sequence[dict[str, Any]]) -> None:
    """Tensions before and after the deployer beside the closed form, and the time."""
    import matplotlib
    from matplotlib.figure import Figure

    matplotlib.rcParams.update({"font.size": 8, "axes.spines.top": False, "axes.spines.right": False})
    figure = Figure(figsize=(10, 3.4), layout="constrained")
    axes = figure.subplots(1, 3)
    for ax, (span, (_, _, way)) in zip(axes, SPANS.items(), strict=False):
        ax.set_yscale("log")
        ax.set_yticks(TICKS, [str(tick) for tick in TICKS])
        ax.minorticks_off()
        ax.set_title(f"{span}: tension [N] at the deployer", fontsize=9, loc="left")
        for ship, colour in COLOURS.items():
            mine = of_ship(rows, ship)
            for k, place, filling in ((1, "before", "none"), (2, "after", colour)):
                steady = [closed_form(mu, ship, way, LENGTHS[span])[k] for mu in FRICTIONS]
                ax.plot(FRICTIONS, steady, color="0.75", lw=1)
                ax.plot([r["mu"] for r in mine], [r[span][place] for r in mine], "o", color=colour, ms=3, mfc=filling)
    axes[0].text(0.12, 900, "open: inboard, filled: outboard of it\nlines: sliding steadily", fontsize=7, va="top")
    for ship, colour in COLOURS.items():
        mine = of_ship(rows, ship)
        steps = [row["steps"] / 1e3 for row in mine]
        axes[2].plot([r["mu"] for r in mine], steps, color=colour, label=f"ship {ship:g} m/s")
    axes[2].set_title("thousand steps of 50 s", fontsize=9, loc="left")
    axes[2].set_ylim(bottom=0)
    axes[2].legend(frameon=False, fontsize=7)
    for ax in axes:
        ax.set_xlabel("friction of the hose on the bends")
    figure.savefig(DOCS / "figures" / "friction_levels.png", dpi=110)


def of_ship(rows: Sequence[dict[str, Any]], ship: float) -> list[dict[str, Any]]:
    """The runs at a speed of the ship, by friction."""
    return sorted((row for row in rows if row["ship"] == ship), key=lambda row: row["mu"])
