"""Writes a figure of a run to a file, in the format that the ending of its name says."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from fairlead.errors import UsageError, listing, shown
from fairlead.report.figures import DOTS_PER_INCH, STYLE, Picture, figure_of
from fairlead.report.page.signals import families, first_panels
from fairlead.report.plot import FORMATS, plot
from fairlead.report.printed.along import map_names, profile
from fairlead.report.printed.ledger import ledger
from fairlead.report.printed.zone_chart import zone_chart
from fairlead.results.placing import placing

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from fairlead.results import Result

Drawing = Callable[["Result", Sequence[str], Sequence[float]], "Figure"]


def _signals(result: Result, names: Sequence[str], times: Sequence[float]) -> Figure:
    """Signals over time; without names those of the netlist's plots."""
    known = families(result)
    chosen = result.chosen(names) if names else [
        one.name for panel in first_panels(result) for name in panel["families"] for one in known[name]]  # fmt: skip
    between = (times[0], times[1]) if len(times) == 2 else None
    return plot(result, list(dict.fromkeys(chosen)), "", between, None)


def _map(result: Result, names: Sequence[str], times: Sequence[float]) -> Figure:
    """A quantity of a line over time and place."""
    picture = Picture(str(result.run.get("name", "")), *map_names(result, names))
    return figure_of(result, picture)


WHATS: dict[str, Drawing] = {
    "signals": _signals, "profile": profile, "map": _map, "zones": zone_chart,
    "ledger": lambda result, names, times: ledger(result),
}  # fmt: skip
"""What can be drawn of a run: the function takes the result, signals or parts by pattern, and times [s]."""


TIMES = {"signals": 2, "zones": 2, "map": 0, "ledger": 0}
"""How many times a figure takes, if any are given; a profile tells its own."""


def printed(result: Result, what: str, file: Path, names: Sequence[str] = (), times: Sequence[float] = ()) -> Path:
    """Draw one of `WHATS` of a run and write it. Raises UsageError for what the run has not, and for other formats."""
    import matplotlib

    if file.suffix.lower() not in FORMATS:
        raise UsageError(f"{shown(str(file))} is no figure that can be drawn.\n    Formats are {listing(FORMATS)}.")
    if times and what in TIMES and len(times) != TIMES[what]:
        wanted = "two times limit what is drawn: from and to" if TIMES[what] else f"a {what} is of the whole run"
        raise UsageError(f"{what}: {len(times)} times were given.\n    Leave them out, for {wanted}.")
    with matplotlib.rc_context({**STYLE, "backend": "agg"}):
        return save(WHATS[what](result, names, times), file)


def save(figure: Figure, file: Path) -> Path:
    """Write a figure in the format of the file's name; texts of an SVG stay texts."""
    import matplotlib

    file.parent.mkdir(parents=True, exist_ok=True)
    with matplotlib.rc_context({"svg.fonttype": "none"}), placing(file) as part:
        figure.savefig(part, format=file.suffix[1:].lower(), dpi=2 * DOTS_PER_INCH)
    return file
