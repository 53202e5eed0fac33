"""Words and figures that verdicts on rucking share.

Figures have three digits: the force at which a hose rucks, and the coefficients it comes from, are seldom known better.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

DIGITS = 3


def figure(value: float) -> str:
    """Three digits, all those before the point, and no exponent that a reader would not write: 2170, 244, 0.656."""
    return f"{float(f'{value:.{DIGITS}g}'):.12g}"


def moment(t: float) -> str:
    """A time of a verdict [s]: three digits, and whole seconds of a long run."""
    return f"{t:.0f}" if abs(t) >= 10**DIGITS else f"{t:.{DIGITS}g}"


def called(station: Mapping[str, Any]) -> str:
    """The name of a station; with an article where it was given none and has that of its type."""
    name = str(station["name"])
    return f"the {name}" if name == str(station["type"]).lower() else name
