"""Sensitivities as they are handed back, and as lines of text."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from fairlead.errors import UsageError, shown
from fairlead.studies.sensitivities.derivative import CORNER, SMOOTH, Derivative

if TYPE_CHECKING:
    import pandas

COLUMNS = ("figure", "parameter", "derivative", "unit", "elasticity", "error", "step")


@dataclass(frozen=True)
class Sensitivities:
    """Derivatives of figures to parameters; `found["peak", "mu"]` is one of them."""

    model: str
    rows: tuple[Derivative, ...]
    figures: Mapping[str, float]
    units: Mapping[str, str]
    noise: Mapping[str, float]
    """Deviation of the rough part of each figure, in its unit."""
    parameters: Mapping[str, float]
    runs: int

    def __iter__(self) -> Iterator[Derivative]:
        return iter(self.rows)

    def __len__(self) -> int:
        """How many derivatives there are."""
        return len(self.rows)

    def __getitem__(self, names: tuple[str, str]) -> Derivative:
        """The derivative of a figure to a parameter. Raises UsageError for names that were not asked."""
        known = {(one.figure, one.parameter): one for one in self.rows}
        if names in known:
            return known[names]
        raise UsageError(f"There is no derivative of {names[0]} to {names[1]}." if isinstance(names, tuple) else
                         f"{shown(names)} is no pair of a figure and a parameter.")  # fmt: skip

    def to_pandas(self) -> pandas.DataFrame:
        """A row for each derivative."""
        import pandas

        return pandas.DataFrame([vars(one) for one in self.rows])

    def __str__(self) -> str:
        return "\n".join(lines_of(self))


def cells(one: Derivative) -> list[str]:
    """A derivative as the texts of COLUMNS."""
    if one.value is not None:
        told = f"{one.value:.8g}"
    elif one.status == CORNER and one.below is not None and one.above is not None:
        told = f"{one.below:.4g} | {one.above:.4g}"
    else:
        told = one.status
    step = one.step if one.status == SMOOTH else None
    rest = ((one.elasticity, ".4g"), (one.error, ".1g"), (step, ".1g"))
    return [one.figure, one.parameter, told, one.unit, *("" if x is None else format(x, form) for x, form in rest)]


def notes(found: Sensitivities) -> Iterator[str]:
    """What is to be said of derivatives beside their numbers, a sentence each."""
    for one in found:
        if one.sentence:
            yield f"d({one.figure})/d({one.parameter}): {one.sentence}."


def lines_of(found: Sensitivities) -> Iterator[str]:
    """All of it as lines of aligned text."""
    rows = [list(COLUMNS), *map(cells, found)]
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        yield "  ".join(text.ljust(width) for text, width in zip(row, widths, strict=True)).rstrip()
    yield from notes(found)
