"""The rows of a sweep as its pictures want them: those of the design, and which columns are what."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fairlead.cases.row import FINISHED
from fairlead.errors import UsageError, did_you_mean, listing, shown
from fairlead.report.measured import measured
from fairlead.studies.sweeps.table import of_design, read

if TYPE_CHECKING:
    import pandas


@dataclass(frozen=True)
class Rows:
    """A table in memory: all rows of the design, in its order."""

    frame: pandas.DataFrame
    heading: dict[str, Any]

    @classmethod
    def read(cls, place: Path) -> Rows:
        """Raises UsageError where there is no table, or none of its cases has finished."""
        table, heading = read(place)
        frame = of_design(table)
        if not (frame["status"] == FINISHED).any():
            raise UsageError(f"{shown(str(place))}: no case has finished, so there is nothing to draw.")
        return cls(frame, heading)

    @property
    def finished(self) -> pandas.DataFrame:
        """Rows with figures."""
        return self.frame[self.frame["status"] == FINISHED]

    @property
    def numbers(self) -> list[str]:
        """Parameters with numbers that vary."""
        texts = set(self.heading["texts"])
        return [name for name in self.varied if name not in texts]

    @property
    def words(self) -> list[str]:
        """Parameters with words that vary."""
        return [name for name in self.varied if name in set(self.heading["texts"])]

    @property
    def varied(self) -> list[str]:
        """Parameters with more than one value."""
        return [name for name in self.heading["parameters"] if self.frame[name].nunique(dropna=False) > 1]

    def figure(self, name: str) -> str:
        """The figure of that name; the first one with a value for "". Raises UsageError, also if it has none."""
        known = [*self.heading["units"]]
        told = [one for one in known if self.finished[one].notna().any()]
        if not name and told:
            return told[0]
        if name not in known:
            near = did_you_mean(name, known)
            raise UsageError(f"The sweep has no figure {shown(name)}. {near}\n    There are {listing(known)}.")
        if name not in told:
            others = f"Figures with values: {listing(told)}." if told else "Nor has any other figure."
            raise UsageError(f"{name} has no value in any case, so there is nothing to draw.\n    {others}")
        return name

    def label(self, name: str) -> str:
        """A figure or a parameter with its unit."""
        unit = self.heading["units"].get(name) or self.about(name)[0]
        return name if unit in ("", "1") else f"{name} [{unit}]"

    def about(self, parameter: str) -> tuple[str, str]:
        """Unit and description of a parameter; "" for what is not known, and in a table of old."""
        unit, doc = (self.heading.get("about") or {}).get(parameter, ("", ""))
        return unit, doc

    def value(self, parameter: str, value: Any) -> str:
        """A value of a parameter with its unit."""
        if not isinstance(value, float):
            return str(value)
        unit = self.about(parameter)[0]
        return f"{value:.4g}" if unit in ("", "1") else measured(value, unit, 4)
