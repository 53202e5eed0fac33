"""Joins the parts of the page: data, words, the script of our own and that of the installed plotting package."""

from __future__ import annotations

import functools
import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fairlead.errors import UsageError
from fairlead.report.page.happened import instants
from fairlead.report.page.ledger import ledger_rows
from fairlead.report.page.line import line_data
from fairlead.report.page.mechanism import mechanism_data, wiring
from fairlead.report.page.scene import scene_data, settings_rows, shared
from fairlead.report.page.signals import first_panels, signal_data, worst_rows
from fairlead.report.page.slow import slow_data
from fairlead.report.page.verdict import verdict
from fairlead.report.page.zones import zone_data
from fairlead.results.placing import place

if TYPE_CHECKING:
    from fairlead.results import Result

PAGE_FILE = "report.html"
PARTS = Path(__file__).parent / "parts"
SCRIPTS = (
    "data.js", "clock.js", "colours.js", "hover.js", "scale.js", "route.js", "mechanism.js", "plots.js", "legend.js",
    "panel.js", "profile.js", "adding.js", "maps.js", "zones.js", "printing.js", "main.js",
)  # fmt: skip
MOST_RUNS = 8


def write(results: Result | list[Result] | tuple[Result, ...], path: Path | None = None) -> Path:
    """Write the page about one run, or about several side by side; returns its path.

    It goes to report.html in the folder of the first run unless `path` says otherwise. Raises UsageError for more runs
    than a page shows, DamagedResultsError for results that cannot be read.
    """
    runs = list(results) if isinstance(results, list | tuple) else [results]
    if not 1 <= len(runs) <= MOST_RUNS:
        raise UsageError(f"{len(runs)} runs were given; a page shows 1 to {MOST_RUNS}.")
    target = path or runs[0].folder / PAGE_FILE
    place(target, page(runs))
    return target


def page(runs: Sequence[Result], only: str = "") -> str:
    """The text of the page; `only` shows one of its sections (`moving`)."""
    labels = _labels(runs)
    told = [_run(result, label) for result, label in zip(runs, labels, strict=True)]
    for one, same in zip(told, shared([each["scene"] for each in told], labels), strict=True):
        one["same"] = same
    data = {"runs": [_data(result, label, 1 / len(runs)) for result, label in zip(runs, labels, strict=True)]}
    return str(_template().render(
        title=", ".join(dict.fromkeys(str(one.run.get("name") or one.folder.name) for one in runs)),
        runs=told, only=only, data=_as_json(data), style=(PARTS / "page.css").read_text(encoding="utf-8"),
        library=library(), script="\n".join((PARTS / name).read_text(encoding="utf-8") for name in SCRIPTS),
    ))  # fmt: skip


def _template() -> Any:
    """The template; whatever is put into it is escaped."""
    import jinja2

    loader = jinja2.FileSystemLoader(PARTS)
    made = jinja2.Environment(loader=loader, autoescape=True, trim_blocks=True, lstrip_blocks=True)
    made.filters["number"] = lambda value: f"{value:.5g}"
    return made.get_template("page.html")


@functools.cache
def library() -> str:
    """The JavaScript of the plotting package, as the installed package ships it."""
    from bokeh.resources import Resources

    return "\n".join(Resources(mode="inline", components=["bokeh", "bokeh-api"]).js_raw)


def _as_json(data: Any) -> str:
    """JSON that cannot end the element it stands in."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def _labels(runs: Sequence[Result]) -> list[str]:
    """What tells runs apart: their names, else what was given from outside, else their folders."""
    names = [str(one.run.get("name") or one.folder.name) for one in runs]
    if len(set(names)) == len(names):
        return names
    scenes = [one.run.get("scene") or {} for one in runs]
    keys = list(dict.fromkeys(key for scene in scenes for key in scene.get("set") or {}))
    given = [", ".join(f"{key} = {value}" for key in keys if (value := _value(scene, key)) is not None)
             for scene in scenes]  # fmt: skip
    found = [f"{name} ({more or 'as written'})" for name, more in zip(names, given, strict=True)]
    if len(set(found)) < len(found):
        found = [f"{name} in {folder}" for name, folder in zip(names, _folders(runs), strict=True)]
    return found


def _folders(runs: Sequence[Result]) -> list[str]:
    """The folders of runs, without what all of them have in common."""
    folders = [one.folder.resolve() for one in runs]
    above = Path(os.path.commonpath([one.parent for one in folders]))
    return [str(one.relative_to(above)) for one in folders]


def _value(scene: Mapping[str, Any], key: str) -> Any:
    """What was given for a name from outside, else what the netlist has for a parameter of its own."""
    own = (scene.get("parameters") or {}).get(key)
    return (scene.get("set") or {}).get(key, own)


def _run(result: Result, label: str) -> dict[str, Any]:
    """What the template writes as text about one run."""
    return {
        "label": label, "name": str(result.run.get("name") or result.folder.name), "status": result.status,
        "description": str(result.run.get("description") or ""), "verdict": verdict(result),
        "ledger": ledger_rows(result),
        "balanced": (result.run.get("energy") or {}).get("supplied") is not None,
        "slow": slow_data(result), "scene": scene_data(result),
        "wiring": wiring(result), "settings": settings_rows(result.run), "worst": worst_rows(result),
        "lines": line_data(result), "empty": not len(result.t),
    }  # fmt: skip


def _data(result: Result, label: str, share: float) -> dict[str, Any]:
    """What the script of the page draws of one run."""
    return {
        "label": label, **signal_data(result, share), "panels": first_panels(result), "zones": zone_data(result),
        "lines": line_data(result), "mechanism": mechanism_data(result),
        "limits": [{key: one[key] for key in ("signal", "bound", "text")} for one in result.run.get("limits") or ()],
        "instants": instants(result), "rucks": [one for one in result.run.get("ruck") or () if one.get("rucks")],
    }  # fmt: skip
