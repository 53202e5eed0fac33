"""Writes report.html: one self-contained page about a run, to be mailed or archived.

How the run went, the figures, who changed zone how often, and the range of every signal. Nothing is
loaded from elsewhere: the figures are inside the page.
"""

from __future__ import annotations

import base64
from collections import Counter
from collections.abc import Iterable, Mapping
from html import escape
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING, Any

import numpy as np

from fairlead.analysis.friction_record import sentence as of_friction
from fairlead.analysis.ruck import sentence as of_ruck
from fairlead.report.figures import draw
from fairlead.results.placing import place
from fairlead.results.signal import family

if TYPE_CHECKING:
    from fairlead.results import Event, Result

PAGE_FILE = "report.html"
MOST_ROWS = 60
# Shown elsewhere on the page, or not at all.
APART = ("name", "description", "format", "limits_broken", "limits", "routes", "ruck", "friction")

PAGE = Template("""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<style>
body { font: 15px/1.5 system-ui, sans-serif; color: #222; }
body { max-width: 62rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.6rem; margin-bottom: 0; }
h2 { font-size: 1.15rem; margin-top: 2.2rem; }
table { border-collapse: collapse; font-size: .9rem; }
th, td { text-align: left; vertical-align: top; }
th, td { padding: .2rem 1.2rem .2rem 0; border-bottom: 1px solid #e5e5e5; }
th { font-weight: 600; }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
img { width: 100%; margin: .6rem 0; }
.status { display: inline-block; padding: 0 .6rem; border-radius: .6rem; background: #e3f1e5; }
.status.bad { background: #fbe3d9; }
.broken { border-left: 4px solid #d55e00; padding-left: .8rem; }
.scroll { overflow-x: auto; }
</style>
</head>
<body>
<h1>$title</h1>
<p>$description</p>
<p><span class="status $mood">$status</span></p>
$broken
<h2>Run</h2>
<div class="scroll">$run</div>
<h2>Figures</h2>
$figures
<h2>Zone changes</h2>
<div class="scroll">$zones</div>
<h2>Signals</h2>
<div class="scroll">$signals</div>
</body>
</html>
""")


def write(result: Result, plots: Iterable[Any] = ()) -> Path:
    """Draw the figures (see `figures.draw`), write report.html into the run directory, return its path."""
    figures = draw(result, plots)
    page = PAGE.substitute(
        title=escape(str(result.run.get("name", result.folder.name))),
        description=escape(str(result.run.get("description", ""))),
        status=escape(result.status),
        mood="" if result.status == "finished" else "bad",
        broken=_broken_limits(result.run.get("limits_broken") or ()),
        run=_table((), [*_verdicts(result.run), *((key, _shown(value)) for key, value in _flat(result.run))]),
        figures="\n".join(_image(figure) for figure in figures) or "<p>Nothing was recorded.</p>",
        zones=_zones(result.events),
        signals=_signals(result),
    )
    path = result.folder / PAGE_FILE
    place(path, page)
    return path


def _verdicts(run: Mapping[str, Any]) -> list[tuple[str, str]]:
    """How friction was treated, and whether lines ruck."""
    friction = of_friction(run.get("friction"))
    return [*([("friction", friction)] if friction else []), *(("ruck", of_ruck(one)) for one in run.get("ruck") or ())]


def _flat(run: Mapping[str, Any], above: str = "") -> list[tuple[str, Any]]:
    """Return the entries of run.json as (words, value), nested ones under the words above them."""
    rows: list[tuple[str, Any]] = []
    for key, value in run.items():
        words = f"{above} {key.replace('_', ' ')}".strip()
        if isinstance(value, Mapping):
            rows += _flat(value, words)
        elif above or key not in APART:
            rows.append((words, value))
    return rows


def _shown(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, list):
        rest = f" and {len(value) - 12} more" if len(value) > 12 else ""
        return ", ".join(_shown(item) for item in value[:12]) + rest
    return "" if value is None else str(value)


def _broken_limits(limits: Iterable[Any]) -> str:
    sentences = "".join(f"<li>{escape(str(limit))}</li>" for limit in limits)
    return f'<div class="broken"><b>Limits broken</b><ul>{sentences}</ul></div>' if sentences else ""


def _image(figure: Path) -> str:
    content = base64.b64encode(figure.read_bytes()).decode()
    return f'<img alt="{escape(figure.stem)}" src="data:image/png;base64,{content}">'


def _zones(events: list[Event]) -> str:
    """Return one row per component, the busiest first: how often it changed zone, how, and when."""
    if not events:
        return "<p>No component changed its zone.</p>"
    rows = []
    counts = Counter(event.component for event in events)
    for component, count in counts.most_common(MOST_ROWS):
        own = [event for event in events if event.component == component]
        changes = Counter(f"{event.zone_from} → {event.zone_to}" for event in own).most_common()
        told = ", ".join(f"{change} ({times})" for change, times in changes)
        rows.append((component, count, told, f"{own[0].t:.6g}", f"{own[-1].t:.6g}"))
    head = ("component", "changes", "from → to", "first [s]", "last [s]")
    return _table(head, rows) + _left_out(len(counts) - len(rows), "components")


def _signals(result: Result) -> str:
    """Return one row per family of signals: how many, unit, lowest and highest value."""
    families: dict[tuple[str, str], list[str]] = {}
    for signal in result.signals:
        families.setdefault((family(signal.name)[0], signal.unit), []).append(signal.name)
    rows = []
    for (name, unit), members in list(families.items())[:MOST_ROWS]:
        values = result.columns(members)
        known = values[np.isfinite(values)]
        span = (f"{known.min():.6g}", f"{known.max():.6g}") if known.size else ("", "")
        rows.append((name, len(members), unit, *span))
    head = ("signal", "number", "unit", "lowest", "highest")
    return _table(head, rows) + _left_out(len(families) - len(rows), "signals")


def _table(head: Iterable[str], rows: Iterable[Iterable[Any]]) -> str:
    top = "".join(f"<th>{escape(word)}</th>" for word in head)
    body = "".join("<tr>" + "".join(_cell(value) for value in row) + "</tr>\n" for row in rows)
    return f"<table>{f'<tr>{top}</tr>' if top else ''}\n{body}</table>"


def _cell(value: Any) -> str:
    kind = ' class="number"' if isinstance(value, int) else ""
    return f"<td{kind}>{escape(str(value))}</td>"


def _left_out(count: int, what: str) -> str:
    return f"<p>... and {count} more {what}.</p>" if count > 0 else ""
