"""One line of the verdict of a page."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any, NamedTuple

from fairlead.analysis.margins.ruck_words import figure

PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "\u00b5"), (1e-9, "n"))
TAKES = re.compile(r"(Pa|N|W|J|Hz|m|s|V|A|rad)(?![\w^])")
"""Units that take a prefix; not those of a square, `m^2`."""


class Sentence(NamedTuple):
    """One line of the verdict; `points` are more sentences, each with the word for what it is about."""

    about: str
    mood: str
    text: str
    points: Sequence[tuple[str, str]] = ()
    brief: str = ""
    """What stands for it where it is folded away, if that is not `about`."""
    worth: bool = False
    """True for what tells how far the numbers can be trusted; it is folded away where nothing is wrong."""
    above: bool = False
    """True where the verdict on a line says the same, so that nothing has to be folded open for it."""

    @property
    def opens(self) -> bool:
        """True for what a reader must not overlook, and finds nowhere else."""
        return self.mood in ("bad", "fair") and not self.above


def ended(text: str) -> str:
    """The text as a sentence that ends."""
    text = text.strip()
    return text if text.endswith((".", "!", "?")) else f"{text}."


def number(value: Any) -> str:
    """Three digits, or the word for a value that is not there."""
    return "unknown" if value is None else figure(value)


def measured(value: float, unit: str) -> str:
    """Three digits and the unit, with a prefix where it takes one and the number would be long: 18 MPa, 0.177 m."""
    behind = f"\u00a0{unit}" if unit not in ("", "1") else ""
    size = abs(value)
    if size == 0 or 1e-3 <= size < 1e5:
        return f"{figure(value)}{behind}"
    scale, prefix = next((one for one in PREFIXES if size >= one[0]), (1.0, ""))
    if scale == 1.0 or size >= 1e12 or not TAKES.match(unit):
        return f"{value:.2e}{behind}".replace("e-0", "e-").replace("e+0", "e")
    return f"{figure(value / scale)}\u00a0{prefix}{unit}"
