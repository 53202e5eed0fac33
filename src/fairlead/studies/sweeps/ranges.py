"""Values of one parameter, as a text: a list, a range, or so many points between two ends.

    hold,binding          8 N, 10 N, 12 N
    0.2:0.7:0.05          from, to, step; the end counts if a step meets it
    lin(8 N, 12 N, 5)     five values, evenly spaced         log(1e-3, 1, 7)     by equal factors

A unit may stand at one of the numbers only; it is meant for all. Numbers are worked out in decimals, so that
0.2 + 3 * 0.05 is 0.35.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal, InvalidOperation

from fairlead.errors import shown
from fairlead.quantities import MOST, QuantityError, digits, si

MOST_VALUES = 100_000
DIGITS = 12  # of a value that is spaced by factors
EXAMPLE = "Write 0.2:0.7:0.05 (from, to, step), a,b,c, lin(from, to, count) or log(from, to, count)."


class RangeError(ValueError):
    """What is wrong with a range, and a way out."""

    def __init__(self, what: str, way_out: str = EXAMPLE) -> None:
        super().__init__(what)
        self.what, self.way_out = what, way_out


def read_range(text: str) -> list[str]:
    """The values as texts with their unit. Raises RangeError."""
    spaced = re.fullmatch(r"\s*(lin|log)\s*\((.*)\)\s*", text)
    if spaced:
        return _spaced(spaced[1], [one.strip() for one in spaced[2].split(",")])
    parts = [one.strip() for one in text.split(":")]
    if len(parts) == 3 and all(re.match(r"[-+.\d]", one) for one in parts):
        return _stepped(*parts)
    values = [one.strip() for one in text.split(",")]
    if not all(values):
        raise RangeError("an empty value stands between two commas" if len(values) > 1 else "there is no value")
    return list(dict.fromkeys(values))


def _stepped(first: str, last: str, step: str) -> list[str]:
    (a, b, h), unit = _numbers([first, last, step])
    if h == 0 or (b - a) * h < 0:
        raise RangeError(f"from {first} one does not come to {last} by steps of {step}: the range is empty")
    count = (b - a) / h
    if count >= MOST_VALUES:
        raise RangeError(
            f"these are {float(count):.3g} values; a parameter has at most {MOST_VALUES}", "Take larger steps."
        )
    return [_text(a + k * h, unit) for k in range(int(count) + 1)]


def _spaced(kind: str, parts: list[str]) -> list[str]:
    count = digits(parts[2]) if len(parts) == 3 else None
    if count is None or count < 2:
        raise RangeError(f"{kind} takes two ends and how many values, two at least")
    (a, b), unit = _numbers(parts[:2])
    if count > MOST_VALUES:
        raise RangeError(f"these are {count} values; a parameter has at most {MOST_VALUES}", "Take fewer.")
    if a == b:
        raise RangeError(f"both ends are {parts[0]}: the range is empty")
    if kind == "lin":
        return [_text(a + (b - a) * k / (count - 1), unit) for k in range(count)]
    if a <= 0 or b <= 0:
        raise RangeError("log takes ends above zero")
    low, high = math.log(float(a)), math.log(float(b))
    inner = [Decimal(f"{math.exp(low + (high - low) * k / (count - 1)):.{DIGITS}g}") for k in range(1, count - 1)]
    return [_text(one, unit) for one in (a, *inner, b)]


def _numbers(texts: list[str]) -> tuple[list[Decimal], str]:
    """Numbers in one unit, that which stands at some of them."""
    found = [re.fullmatch(r"([-+]?[\d.]+(?:[eE][-+]?\d+)?)\s*(.*)", one) for one in texts]
    if not all(found):
        wrong = next(text for text, one in zip(texts, found, strict=True) if one is None)
        raise RangeError(f"{shown(wrong)} is no number")
    units = dict.fromkeys(one[2] for one in found if one is not None and one[2])
    if len(units) > 1:
        raise RangeError(f"the numbers have different units: {', '.join(units)}", "Write them in one unit.")
    try:
        numbers = [Decimal(one[1]) for one in found if one is not None]
    except InvalidOperation:
        raise RangeError(f"{shown(', '.join(texts))}: not all are numbers") from None
    for text, number in zip(texts, numbers, strict=True):
        if abs(number) > MOST or 0 < abs(number) < 1 / MOST:
            raise RangeError(f"{shown(text)} is too {'large' if abs(number) > 1 else 'small'} to compute with",
                             f"Is the exponent meant? Numbers lie between {1 / MOST:g} and {MOST:g}.")  # fmt: skip
    return numbers, next(iter(units), "")


def _text(number: Decimal, unit: str) -> str:
    plain = f"{number.normalize():f}" if 1e-6 <= abs(number) < 1e9 or number == 0 else f"{number.normalize():e}"
    if len(plain.strip("-0.")) > 17:
        plain = repr(float(number))
    return f"{plain} {unit}".strip()


def column_of(text: str | float) -> float | str:
    """What a value is in a table: a number in SI where it is a quantity, else the text."""
    from fairlead.quantities import quantity

    if not isinstance(text, str):
        return text if isinstance(text, bool) else float(text)
    try:
        return quantity(text).value
    except QuantityError:
        try:
            return si(text, "1")
        except QuantityError:
            return text
