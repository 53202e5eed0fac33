"""What a run computed, and the questions that are asked of it.

    result = fairlead.load("belt").run()
    result["block.x"]           everything of `fairlead.results.Result`: signals, events, exports
    result.margins()            how near it came to the limits of its lines
    result.limits               those of the netlist, with what came nearest
    result.energy               where the energy went
    result.switches()           who changed zone how often
    result.plot("block.*")      a figure
"""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import fairlead.results as results
from fairlead.analysis.record.reported import remarks
from fairlead.arguments import keywords_told
from fairlead.errors import UsageError, no_attribute
from fairlead.results.asked import refuse_no_height

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from fairlead.report.page.inline import Animation
    from fairlead.results.table import Table

CALLED = {"time": "t", "times": "t", "to_dataframe": "to_pandas()", "df": "to_pandas()", "data": "to_xarray()",
          "names": "signals", "values": "columns()", "max": "extremes(name)", "min": "extremes(name)",
          "save": "to_csv(path)", "sel": "to_xarray().sel(time=...), or at(name, t)",
          "interp": "to_xarray().interp(time=...)", "isel": "to_xarray()", "loc": "to_pandas().loc",
          "success": "ok", "message": "run['sentence']"}  # fmt: skip
"""What others call what a Result has."""


class Result(results.Result):
    """One run: its signals, and what is worked out from them.

    `model.run()` gives it, `Result.open("results/belt")` opens that of an earlier run.
    """

    if not TYPE_CHECKING:  # a type checker would take it for leave to ask for anything

        def __init__(self, path: Any, run: Any = None, series: Any = None, events: Any = None) -> None:
            """As the class of the results room; a path alone is told how it is opened. Raises UsageError."""
            if run is None:
                raise UsageError(f"Result: run is missing. An earlier run is fairlead.Result.open({path!r}).")
            super().__init__(path, run, series, events)

        def __getattr__(self, name: str) -> Any:
            """What is not there is told with what was meant. Raises AttributeError."""
            if name.startswith("_") or hasattr(type(self), name):
                return object.__getattribute__(self, name)
            mine = [one.name for one in self.signals if name in one.name.split(".")]
            more = "Signals go by name: result[...], of which `signals` has a list."
            raise no_attribute(self, name, CALLED, f'A signal is result["{mine[0]}"].' if mine else more)

    @classmethod
    def of(cls, recorded: results.Result) -> Result:
        """The run `recorded` by the results room, with more to ask."""
        return cls(recorded.path, recorded.run, recorded._series, recorded._given_events)

    @property
    def remarks(self) -> tuple[str, ...]:
        """What the run has to say: what `check` would remark, chatter, an open energy ledger, broken limits."""
        return remarks(self.run)

    @keywords_told
    def margins(self, line: str = "*") -> Table:
        """How near the lines came to what they bear, by station and over the run, with time and place of the worst.

        `line` picks lines by name or pattern; one that fits none raises UsageError.
        Columns: line, station ("line" over all of it), quantity, value, unit, margin (what it bears over what it had;
        None where nothing is asked), t [s], signal, place [m]. What was not recorded is named under the table. Raises
        DamagedResultsError.
        """
        from fairlead.analysis.margins.result_tables import margins

        return margins(self, line)

    def rucks(self) -> Table:
        """Whether each line that is watched for rucking does: where and when first, or its margin.

        Raises DamagedResultsError.
        """
        from fairlead.analysis.margins.result_tables import rucks

        return rucks(self)

    @property
    def limits(self) -> Table:
        """The limits of the netlist: signal, what is allowed, the value that came nearest, when, and if it is broken.

        Raises DamagedResultsError.
        """
        from fairlead.analysis.margins.result_tables import limits

        return limits(self)

    @property
    def energy(self) -> Table:
        """The ledger of the run [J]: supplied, dissipated, stored, lost in impacts by part, and what is missing."""
        from fairlead.analysis.margins.result_tables import energy

        return energy(self)

    @keywords_told
    def switches(self, pattern: str = "*") -> Table:
        """Zone changes counted by component and zones: how many, the first and the last time [s].

        `pattern` picks components (`line.outer[*]`). Those that changed most come first.
        """
        from fairlead.analysis.margins.result_tables import switches

        return switches(self, pattern)

    @keywords_told
    def animation(self, height: int = 640) -> Animation:
        """The moving picture of the report, for a cell of a notebook; `height` of its frame in px.

        A line is drawn where the places of its nodes were recorded, other scenes with their recorded positions.
        """
        from fairlead.report.page.inline import Animation

        refuse_no_height(height)
        return Animation.of(self, height)

    @keywords_told
    def plot(
        self, *names: str | Iterable[str] | None, title: str = "",
        between: tuple[float | str, float | str] | None = None, file: str | Path | None = None,
    ) -> Figure:  # fmt: skip
        """Draw signals (all, or those of `names` or patterns) over time, a panel for each unit; a matplotlib Figure.

        Names follow one another, or stand in a list: `plot("block.x", "pad.slip")`. A notebook shows it. Elements of a
        line share a colour scale, zone changes are ticks at the top. `between` limits the time [s], `file` also writes
        it (PNG, SVG or PDF), `title` stands above. Raises UnknownSignalError, UsageError.
        """
        from fairlead.report.plot import plot

        listed = [name for one in names if one is not None for name in _each(one)]
        chosen = self.chosen(None if all(one is None for one in names) else listed)
        return plot(self, chosen, title, between, file)


def _each(names: str | Iterable[str]) -> Iterable[str]:
    """One name as a list of one; what is no name is told where it is looked up."""
    return [names] if isinstance(names, str) or not isinstance(names, Iterable) else names
