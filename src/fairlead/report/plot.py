"""A figure of chosen signals for whoever sits at a prompt or in a notebook."""

from __future__ import annotations

import io
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fairlead.arguments import Arguments
from fairlead.errors import UsageError, listing, shown
from fairlead.report.figures import STYLE, Picture, figure_of
from fairlead.results.placing import placing

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from fairlead.results import Result

MOST_PANELS = 12
FORMATS = (".png", ".svg", ".pdf")


def plot(
    result: Result, names: Sequence[str], title: str, between: tuple[float | str, float | str] | None,
    file: str | Path | None,
) -> Figure:  # fmt: skip
    """Draw signals, a panel for each unit. Raises UsageError for more panels than a page has, and other formats."""
    import matplotlib

    asked = Arguments("Result.plot")
    if file is not None:
        asked.new_file("file", file)
    span = None if between is None else _span(asked, between, result)
    asked.refuse()
    if file is not None and Path(file).suffix.lower() not in FORMATS:
        raise UsageError(f"{shown(str(file))} is no figure that can be drawn.\n    Formats are {listing(FORMATS)}.")
    units = {result.unit(name) for name in names}
    if not names or len(units) > MOST_PANELS:
        what = f"{len(units)} units make as many panels" if names else "there is no signal to draw"
        raise UsageError(f"{result.run.get('name', 'The run')}: {what}.\n    Choose signals, plot(names).")
    picture = Picture(title or str(result.run.get("name", "")), tuple(names), "")
    with matplotlib.rc_context({**STYLE, "backend": "agg"}):
        drawn = figure_of(result, picture, _shown_in_notebooks())
        if span is not None:
            drawn.axes[0].set_xlim(*span)
        if file is not None:
            with placing(Path(file)) as part:
                drawn.savefig(part, format=Path(file).suffix[1:].lower())
    return drawn


def _span(asked: Arguments, between: tuple[float | str, float | str], result: Result) -> tuple[float, float]:
    if not isinstance(between, tuple | list) or len(between) != 2:
        asked.pair("between", between, "(1.0, 2.5)")
        return 0.0, 1.0
    first, last = (asked.quantity(f"between[{k}]", value, "s") for k, value in enumerate(between))
    if last <= first:
        asked.pair("between", f"({first:g}, {last:g})", "(1.0, 2.5)")
    elif len(result.t) and (last <= result.t[0] or first >= result.t[-1]):
        asked.outside("between", f"({first:g}, {last:g})", f"was recorded from {result.t[0]:g} s to {result.t[-1]:g} s")
    return first, last


def _shown_in_notebooks() -> Any:
    """A Figure that notebooks show, also where nobody has imported pyplot."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    class Drawing(Figure):
        def _repr_png_(self) -> bytes:
            drawn = io.BytesIO()
            FigureCanvasAgg(self).print_png(drawn)
            return drawn.getvalue()

    return Drawing
