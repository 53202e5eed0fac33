"""The statics of a line as a reader of Python has them: tables of stations, drives and rest.

    (line,) = fairlead.load("guidance_route").statics()
    line.stations().to_pandas()
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, fields
from functools import cached_property
from html import escape
from typing import TYPE_CHECKING, Any

import fairlead.analysis.statics.solution as analysis
from fairlead.analysis.remarks.statics_record import record
from fairlead.results.table import Table

if TYPE_CHECKING:
    import pandas

STATIONS = {
    "state": "", "layer": "", "speed": "m/s", "station": "", "from": "m", "to": "m", "inboard": "N", "outboard": "N",
    "side_wall": "N/m", "side_wall_margin": "", "core": "N", "hose": "N", "bulkheads_slip": "", "ruck_margin": "",
}  # fmt: skip
"""Columns of the table of stations, with their units."""
DRIVES = {"drive": "", "state": "", "force": "N", "torque": "N*m", "power": "W", "clamp": "N", "factor": ""}


@dataclass(frozen=True)
class Statics(analysis.Statics):
    """One line on its route, solved for the states of motion that its references imply, and for rest."""

    @classmethod
    def of(cls, found: analysis.Statics) -> Statics:
        """The same line, with tables."""
        return cls(**{one.name: getattr(found, one.name) for one in fields(analysis.Statics)})

    @cached_property
    def record(self) -> dict[str, Any]:
        """All of it as plain numbers, as `fairlead statics --json` prints it."""
        return record(self)

    def stations(self) -> Table:
        """A row for each station in each state of motion: tensions, load on the wall, layers, margins."""
        rows = ({**row, "state": state["state"], "layer": state["layer"], "speed": state["speed"]}
                for state in self.record["states"] for row in state["stations"])  # fmt: skip
        return _table(f"{self._named()}: statics in motion", STATIONS, rows)

    def drives(self) -> Table:
        """A row for each drive in each state, also while the speed changes: force, torque, power, clamp."""
        return _table(f"{self._named()}: drives", DRIVES, self.record["drives"])

    def at_rest(self) -> Table:
        """A row for each station: the least and the most tension that friction can hold at both ends."""
        standing, rows = self.record["standing"], []
        for row in standing["stations"]:
            ends = zip(("inboard", "outboard"), (row["inboard"], row["outboard"]), strict=True)
            bounds = {f"{end}_{word}": value for end, pair in ends for word, value in zip(("least", "most"), pair)}
            rows.append({"station": row["station"], "from": row["from"], "to": row["to"], **bounds})
        units = {"station": "", "from": "m", "to": "m", "inboard_least": "N", "inboard_most": "N",
                 "outboard_least": "N", "outboard_most": "N"}  # fmt: skip
        missing = "" if standing["holds"] else f"; friction does not hold it, {standing['missing']:.4g} N are missing"
        return _table(f"{self._named()}: at rest{missing}", units, rows)

    def to_pandas(self) -> pandas.DataFrame:
        """The table of stations."""
        return self.stations().to_pandas()

    def _named(self) -> str:
        return f"{self.route.line.path} on {self.route.route.path}"

    def __repr__(self) -> str:
        return repr(self.stations() if self.moving else self.at_rest())

    def _repr_html_(self) -> str:
        tables = [one for one in (self.stations(), self.at_rest(), self.drives()) if len(one)]
        notes = "".join(f"<p>note: {escape(text)}.</p>" for text in self.record["remarks"])
        return "".join(one._repr_html_() for one in tables) + notes


class StaticsOfLines(list[Statics]):
    """The statics of every line on a route, one after the other."""

    def to_pandas(self) -> pandas.DataFrame:
        """The tables of stations under one another, with the line as first column."""
        import pandas

        frames = [one.to_pandas() for one in self]
        for one, frame in zip(self, frames, strict=True):
            frame.insert(0, "line", one.route.line.path)
        return pandas.concat(frames, ignore_index=True)

    def __repr__(self) -> str:
        told = "\n\n".join(map(repr, self[:1]))
        return told + (f"\n\n... and {len(self) - 1} more lines" if len(self) > 1 else "")

    def _repr_html_(self) -> str:
        return "".join(one._repr_html_() for one in self)


def _table(title: str, units: dict[str, str], rows: Iterable[dict[str, Any]]) -> Table:
    """Rows by column; columns in which no row has anything are left out."""
    rows = list(rows)
    kept = [name for name in units if any(row.get(name) is not None for row in rows)]
    made = tuple(tuple(row.get(name) for name in kept) for row in rows)
    return Table(title, tuple(kept), tuple(units[name] for name in kept), made)
