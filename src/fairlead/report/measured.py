"""A value with its unit as a reader wants it: three digits, and a prefix where the number would be long."""

from __future__ import annotations

import re

PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "\u00b5"), (1e-9, "n"))
TAKES = re.compile(r"(Pa|N|W|J|Hz|m|s|V|A|rad)(?![\w^])")
"""Units that take a prefix; not those of a square, `m^2`."""
SMALL, LARGE, VAST = 1e-3, 1e5, 1e12
"""From a number below and from one above a prefix is taken; of what is larger than the last no prefix helps."""


def measured(value: float, unit: str, digits: int = 3) -> str:
    """So many digits and the unit, with a prefix where it takes one and the number would be long: 18 MPa, 0.177 m."""
    behind = f"\u00a0{unit}" if unit not in ("", "1") else ""
    scale, prefix = prefix_of(abs(value), unit)
    if scale != 1.0 or value == 0.0 or SMALL <= abs(value) < LARGE:
        return f"{_short(value / scale, digits)}{behind and f'{behind[0]}{prefix}{unit}'}"
    return f"{value:.{digits - 1}e}{behind}".replace("e-0", "e-").replace("e+0", "e").replace("e+", "e")


def prefix_of(size: float, unit: str) -> tuple[float, str]:
    """The factor and the prefix for numbers of this size: 1e6, "M"; 1, "" where none is needed or none is taken."""
    if SMALL <= size < LARGE or not PREFIXES[-1][0] <= size < VAST or not TAKES.match(unit):
        return 1.0, ""
    return next(one for one in PREFIXES if size >= one[0])


def _short(value: float, digits: int) -> str:
    """So many digits, all before the point, no exponent."""
    return f"{float(f'{value:.{digits}g}'):.12g}"
