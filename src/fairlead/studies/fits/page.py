"""The page of a fit: one HTML file with its tables, and a picture of each record beside the model."""

from __future__ import annotations

import base64
import html
import io
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from fairlead.report.figures import DOTS_PER_INCH, STYLE
from fairlead.studies.fits.problem import Record

LOOK = (
    "body{font:15px/1.5 system-ui,sans-serif;max-width:62em;margin:2em auto;padding:0 1em}"
    "table{border-collapse:collapse}td,th{padding:.2em .8em;border-bottom:1px solid #ccc;text-align:left}"
    "img{max-width:100%}"
)


def write_page(
    file: Path, title: str, lines: Iterable[str], laws: tuple[Sequence[str], Sequence[Sequence[str]]] | None,
    law_lines: Iterable[str], records: Sequence[Record], values: Mapping[str, float],
) -> None:  # fmt: skip
    """Write the page of a fit."""
    parts = [f"<!doctype html><meta charset=utf-8><title>{html.escape(title)}</title><style>{LOOK}</style>"]
    parts.append(f"<h1>{html.escape(title)}</h1><ul>")
    parts += [f"<li>{html.escape(line)}</li>" for line in lines]
    parts.append("</ul>")
    if laws is not None:
        parts.append("<h2>Laws: mean error of each record, fitted with it and without it</h2>")
        parts.append(_table(*laws))
        parts += [f"<p>{html.escape(line)}</p>" for line in law_lines]
    for record in records:
        parts.append(f"<h2>{html.escape(record.name)}</h2>{_picture(record, values)}")
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("\n".join(parts), encoding="utf-8")


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    top = "".join(f"<th>{html.escape(cell)}</th>" for cell in head)
    body = "".join("<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in row) + "</tr>" for row in rows)
    return f"<table><tr>{top}</tr>{body}</table>"


def _picture(record: Record, values: Mapping[str, float]) -> str:
    """Measured and computed curves above, what is between them below, for each signal."""
    import matplotlib

    curves = record.computed(values)
    with matplotlib.rc_context({**STYLE, "backend": "agg"}):
        from matplotlib.figure import Figure

        signals: list[tuple[str, Any]] = list(record.measured.values.items())
        made = Figure(figsize=(8, 4.2 * len(signals)), layout="constrained")
        axes = made.subplots(2 * len(signals), 1, sharex=True, squeeze=False)[:, 0]
        for k, (name, measured) in enumerate(signals):
            unit, times = record.units[name], record.measured.times
            axes[2 * k].plot(times, measured, label="measured")
            axes[2 * k].set_ylabel(f"{name} [{unit}]")
            if curves is not None:
                axes[2 * k].plot(times, curves[k], label="computed")
                axes[2 * k + 1].plot(times, curves[k] - measured)
            axes[2 * k].legend()
            axes[2 * k + 1].set_ylabel(f"residual [{unit}]")
        axes[-1].set_xlabel("t [s]")
        picture = io.BytesIO()
        made.savefig(picture, format="png", dpi=DOTS_PER_INCH)
    data = base64.b64encode(picture.getvalue()).decode()
    return f'<img alt="{html.escape(record.name)}" src="data:image/png;base64,{data}">'
