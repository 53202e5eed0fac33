"""The work-precision figure of a study: error against time, the front of what nothing beats, and its knee.

One line per engine and set of equations for the numerical error; modelling and discretisation errors are levels that
no accuracy gets below, drawn as dashed and dotted lines; the floor of the references is grey.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from fairlead.analysis.cost.choice import front, knee
from fairlead.report.figures import DOTS_PER_INCH, STYLE
from fairlead.report.panel import COLOURS

if TYPE_CHECKING:
    from fairlead.analysis.cost.study import Row, Study

LEAST = 1e-8  # relative; an error below it is drawn there
MARKS = {"rodas": "o", "stepping": "s", "ida": "^"}


def draw(study: Study, path: Path) -> Path:
    """Write the figure to `path` (PNG). Returns it."""
    import matplotlib

    with matplotlib.rc_context({**STYLE, "backend": "agg"}):
        from matplotlib.figure import Figure

        figure = Figure(figsize=(9, 5.5), layout="constrained")
        ax = figure.subplots()
        _lines(ax, study)
        _levels(ax, study)
        _front(ax, study)
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_xlabel("CPU time of stepping [s]")
        ax.set_ylabel("error of mean and spread over time" if study.sensitive else "rms error, worst output")
        if ax.get_legend_handles_labels()[0]:  # no line was measured where there is no reference
            ax.legend(fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
        part = "" if study.whole else f", first {study.span[1] - study.span[0]:g} s"
        figure.suptitle(f"{study.name}{part}: what accuracy costs", x=0.01, horizontalalignment="left")
        path.parent.mkdir(parents=True, exist_ok=True)
        figure.savefig(path, dpi=DOTS_PER_INCH)
    return path


def _groups(study: Study) -> dict[str, dict[str, list[Row]]]:
    found: dict[str, dict[str, list[Row]]] = {}
    for row in study.rows:
        if row.timed.finished and row.numerical is not None:
            found.setdefault(row.rung.equations.label, {}).setdefault(row.rung.engine, []).append(row)
    return found


def _lines(ax: Any, study: Study) -> None:
    for number, (label, engines) in enumerate(_groups(study).items()):
        for engine, rows in engines.items():
            ordered = sorted(rows, key=lambda row: -row.rung.accuracy)
            ax.plot(
                [row.timed.cpu for row in ordered], [max(study.size(row.numerical) or 0.0, LEAST) for row in ordered],
                MARKS.get(engine, "d"), linestyle="-", linewidth=0.8, markersize=4.5,
                color=COLOURS[number % len(COLOURS)], label=f"{engine}, {label or 'the scene as it is'}",
            )  # fmt: skip


def _levels(ax: Any, study: Study) -> None:
    for number, (label, engines) in enumerate(_groups(study).items()):
        row = next(iter(engines.values()))[0]
        for errors, style, name in (
            (row.modelling, "--", "modelling error"), (row.discretisation, ":", "discretisation error")
        ):  # fmt: skip
            size = study.size(errors)
            if size and (style == "--" or row.rung.equations.axis in ("scene", "mesh")):
                text = f"{name}, {label or 'the scene as it is'}"
                ax.axhline(max(size, LEAST), linestyle=style, color=COLOURS[number % len(COLOURS)], label=text)
    if 0 < study.floor < 1:
        ax.axhspan(LEAST / 10, max(study.floor, LEAST), color="0.9", zorder=0, label="below what references agree to")


def _front(ax: Any, study: Study) -> None:
    points = front(study)
    if len(points) > 1:
        ax.step(
            [seconds for seconds, _, _ in points], [max(size, LEAST) for _, size, _ in points], where="post",
            color="0.5", linewidth=2.5, alpha=0.4, label="nothing is faster and more exact",
        )  # fmt: skip
    chosen = knee(points)
    if chosen is not None:
        place = next((seconds, max(size, LEAST)) for seconds, size, row in points if row is chosen)
        ax.annotate("knee", place, xytext=(6, 6), textcoords="offset points", fontsize=8)
