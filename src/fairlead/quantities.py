"""Quantities: one finite number, a space, one unit. Text comes in, SI floats go out.

A unit is a product of atoms with whole exponents, `N*s/m` or `m/s^2`. The grammar is ours; only an
atom that the table in units.py does not hold (`lbf`, `knot`) is looked up with pint, so that pint never
sees more than one word of a user's text and is not even imported in the usual case.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from numbers import Real

from fairlead.errors import FairleadError, did_you_mean, shown
from fairlead.units import (
    BASES,
    ENERGY,
    KINDS,
    METRIC,
    MISREAD,
    NONE,
    PLAIN,
    PREFIXED,
    PREFIXES,
    RAD,
    ROOTS,
    Dimension,
)

LONGEST_UNIT = 40
LONGEST_NUMBER = 60
LARGEST_EXPONENT = 4

NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?", re.ASCII)
FACTOR = re.compile(r"([A-Za-zµμΩ°%_]+|1)(?:(?:\^|\*\*)([-+]?\d{1,3}))?")
FORM = "A quantity is a finite number, a space and a unit."
GRAMMAR = "Units are joined by * and / as in N*s/m or m/s^2."
MINUSES = "\u2212\u2013\u2010\u2011"
"""What editors make of a hyphen before a number."""
GROUPED = re.compile(
    r"([-+]?\d{1,3}(?:([ ,'_\u2019\u00a0\u202f\u2009])\d{3}(?!\d))(?:\2\d{3}(?!\d))*"
    r"|[-+]?\d{1,3}(?:\.\d{3})+(?=,))([.,]\d+)?"
)
"""A number with marks of thousands, and the part behind its decimal sign."""
SUM = re.compile(r"([-+]?[\d.]+(?:[eE][-+]?\d+)?(?: *[*/] *[-+]?[\d.]+)+)(?=$| )")
OTHER_BASE = re.compile(r"0(?:[xX][0-9a-fA-F]+|[oO][0-7]+|[bB][01]+)(?=$| )")
OTHER_EXPONENT = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+))[dD]([-+]?\d+)(?=$| )", re.ASCII)
"""Of Fortran."""
SUPERSCRIPTS = str.maketrans({"²": "^2", "³": "^3", "·": "*"})


MOST = 1e150
"""What is larger in SI cannot be computed with, nor can sizes that are smaller than one over it: squares and products
of two, as energies and stiffness over mass, go beyond the range of a double."""


class QuantityError(FairleadError, ValueError):
    """A text or number that is not the quantity wanted.

    `what` begins with the offending value, so that `spring.stiffness = {what}` reads as a sentence;
    `allowed` says what would be accepted, with an example.
    """

    def __init__(self, what: str, allowed: str = "") -> None:
        super().__init__(what, allowed)
        self.what, self.allowed = what, allowed

    def __str__(self) -> str:
        return f"{self.what}. {self.allowed}".strip()


@dataclass(frozen=True)
class Unit:
    """A unit read from text: the factor that turns it to SI, and its dimension."""

    text: str
    factor: float
    dimension: Dimension


@dataclass(frozen=True)
class Quantity:
    """A number in SI with its dimension."""

    value: float
    dimension: Dimension = NONE


def si(value: object, unit: str) -> float:
    """The value in SI: `si("12 kN", "N")` is 12000.0; a bare number is taken to be in SI already.

    Parameters: `value` a text or a number; `unit` the declared unit, such as `N*m/rad` or `1`.
    Raises QuantityError when it is not finite, not a quantity, or of another dimension.
    """
    if isinstance(value, Real) and not isinstance(value, bool):
        return _finite(value, unit)
    if not isinstance(value, str):
        raise QuantityError(f"{shown(value)} is not {article(kind(unit))}", wanted(unit))
    try:
        number, given = _read(value)
    except QuantityError as error:
        raise QuantityError(error.what, f"{error.allowed} {wanted(unit)}".strip()) from None
    declared = parse_unit(unit)
    if given and not fits(given.dimension, declared.dimension):
        what = f"{shown(value)} is {article(kind(given.text))}, not {article(kind(unit))}"
        raise QuantityError(what, _hint(given.dimension, declared.dimension) + wanted(unit))
    return _finite(number * (given.factor if given else 1.0), unit, value)


def written(value: object, unit: str, *, size: bool = False, level: bool = False) -> float:
    """What a netlist gives for a quantity, or a `size` above zero. Raises QuantityError as `computable` does.

    A `level` may have any unit: what it must measure is known once a signal is joined.

    A bare number in quotes is refused too: it is a text. Who wants a number writes no quotes, and who wants it in some
    unit writes that.
    """
    if isinstance(value, str) and NUMBER.fullmatch(value.strip()):
        own = "" if unit == "1" else f", or give its unit too: {value.strip()} {unit}"
        raise QuantityError(f"'{shown(value)}' is a text, for it is in quotes", f"Leave out the quotes{own}.")
    if level and isinstance(value, str):
        value = quantity(value).value
    return computable_size(value, unit) if size else computable(value, unit)


def computable(value: object, unit: str) -> float:
    """What enters equations, in SI. Raises QuantityError as `si` does, and where its square overflows."""
    number = si(value, unit)
    if abs(number) > MOST:
        what = f"{shown(value)} is too large to compute with: its square is more than a number can hold (1.8e308)"
        raise QuantityError(what, f"Is the exponent meant? At most {MOST:g} in SI; leave out what has no limit.")
    return number


def computable_size(value: object, unit: str) -> float:
    """A size above zero, which equations divide by. Raises QuantityError too where its square underflows."""
    number = computable(value, unit)
    if 0 < number < 1 / MOST:
        what = f"{shown(value)} is too small to compute with: its square is less than a number can hold (5e-324)"
        raise QuantityError(what, f"Is the exponent meant? At least {1 / MOST:g} in SI.")
    return number


def digits(text: str) -> int | None:
    """The number that one to nine plain digits are, which counts or numbers something; None for any other text."""
    return int(text) if text.isascii() and text.isdecimal() and len(text) < 10 else None


def whole(value: object) -> object:
    """A whole number for what is one to everybody but a parser, such as 1e6 or a number in quotes; else as it is."""
    try:
        number = si(value, "1")
    except QuantityError:
        return value
    return int(number) if number.is_integer() else value


def quantity(text: str) -> Quantity:
    """The quantity a text holds, whatever its dimension; raises QuantityError when it holds none."""
    number, unit = _read(text)
    if unit is None:
        return Quantity(_finite(number, "1", text))
    return Quantity(_finite(number * unit.factor, unit.text, text), unit.dimension)


def _read(text: str) -> tuple[float, Unit | None]:
    """Number and unit of a text; None when it is a bare number."""
    number, given = split(text)
    try:
        return number, parse_unit(given) if given else None
    except QuantityError as error:
        raise QuantityError(f"{shown(text)}: {error.what}", error.allowed) from None


def split(text: str) -> tuple[float, str]:
    """The number and the unit text ("" when there is none) of a quantity; the unit is not looked at."""
    match = NUMBER.match(text) if len(text) <= LONGEST_NUMBER + 1 + LONGEST_UNIT else None
    if match is None:
        raise QuantityError(f"{shown(text)} is not a quantity", _other_hand(text) or FORM)
    number, rest = float(match[0]), text[match.end() :]
    if rest and (rest[0] != " " or not rest[1:2].isalpha()) and (advice := _other_hand(text)):
        raise QuantityError(f"{shown(text)} is not a quantity", advice)
    if rest and not rest.startswith(" "):
        advice = f"Put a space before the unit: {match[0]} {rest}." if rest[0].isalpha() else FORM
        raise QuantityError(f"{shown(text)} is not a quantity", advice)
    return number, rest.strip(" ")


def _other_hand(text: str) -> str:
    """What to write instead of a number as it is written elsewhere, or as a sum; "" for what is none of these."""
    if len(text) > LONGEST_NUMBER + 1 + LONGEST_UNIT:
        return ""
    if text[:1] in MINUSES and NUMBER.match(text[1:]):
        return f"The minus sign of a number is a hyphen: {shown(f'-{text[1:]}')}."
    if found := OTHER_BASE.match(text):
        return f"Write a decimal number: {shown(f'{int(found[0], 0)}{text[found.end() :]}')}."
    if found := OTHER_EXPONENT.match(text):
        return f"The exponent of a number follows an e: {shown(f'{found[1]}e{found[2]}{text[found.end() :]}')}."
    if found := SUM.match(text):
        return f'Arithmetic goes in braces and quotes: "{{{found[1]}}}{text[found.end() :].rstrip()}".'
    if (grouped := GROUPED.match(text)) is None:
        comma = re.match(r"([-+]?\d+),(\d+)(?![\d,.])", text)
        return f"Write a decimal point, not a comma: {comma[1]}.{comma[2]}{text[comma.end() :]}." if comma else ""
    whole, rest = re.sub(r"[^-+\d]", "", grouped[1]), text[grouped.end() :]
    decimals = f".{grouped[3][1:]}" if grouped[3] else ""
    if grouped[2] == "," and grouped[1].count(",") == 1 and not decimals:
        if whole.lstrip("-+").startswith("0"):
            return f"Write a decimal point, not a comma: {grouped[1].replace(',', '.')}{rest}."
        point = f"{grouped[1].replace(',', '.')}{rest}"
        return f"A comma is no decimal point and parts no thousands: write {shown(point)} or {shown(whole + rest)}."
    return f"Write the number without marks of thousands: {shown(f'{whole}{decimals}{rest}')}."


def fits(given: Dimension, declared: Dimension) -> bool:
    """Whether a quantity of dimension `given` may stand where `declared` is asked for (units.py)."""
    if given[:ENERGY] != declared[:ENERGY]:
        return False
    electric = declared[BASES.index("A")] != 0
    return electric or given[ENERGY] in (0, declared[ENERGY])


@lru_cache(maxsize=1024)
def parse_unit(text: str) -> Unit:
    """The unit a text such as `kN*s/m` means; raises QuantityError when it means none."""
    if len(text) > LONGEST_UNIT:
        raise QuantityError(f"{shown(text)} is not a unit", f"A unit has at most {LONGEST_UNIT} characters.")
    factor, dimension, position, sign = 1.0, NONE, 0, 1
    plain = text.translate(SUPERSCRIPTS)
    while True:
        match = FACTOR.match(plain, position) if sign else None
        if match is None:
            raise QuantityError(f"{shown(text)} is not a unit", GRAMMAR)
        exponent = sign * int(match[2] or 1)
        if abs(exponent) > LARGEST_EXPONENT:
            raise QuantityError(f"{shown(text)} is not a unit", f"Exponents go up to {LARGEST_EXPONENT}.")
        scale, powers = atom(match[1])
        factor *= scale**exponent
        dimension = tuple(have + exponent * more for have, more in zip(dimension, powers, strict=True))
        position = match.end()
        if position == len(plain):
            return Unit(text, factor, dimension)
        sign = {"*": 1, "/": -1}.get(plain[position], 0)
        position += 1


def atom(name: str) -> tuple[float, Dimension]:
    """Factor and dimension of one word of a unit: from the tables, else from pint."""
    if name in PLAIN:
        return PLAIN[name]
    name = name.replace("Ω", "ohm")
    if name in METRIC:
        return METRIC[name]
    if name[0] in PREFIXES and name[1:] in METRIC:
        scale, powers = METRIC[name[1:]]
        return PREFIXES[name[0]] * scale, powers
    return _from_pint(name)


def _product(name: str) -> str:
    """Two units that stand in one word, `kgm`, with a sign between them: `kg*m`; "" for what is none, as `KN`."""
    known = {*METRIC, *PLAIN, *PREFIXED}
    if name.lower() in {one.lower() for one in known}:
        return ""
    halves = ((name[:k], name[k:]) for k in range(len(name) - 1, 0, -1))
    return next((f"{one}*{other}" for one, other in halves if one in known and other in known), "")


def _from_pint(name: str) -> tuple[float, Dimension]:
    """Look one word up with pint; temperatures with an offset, and units of nothing we know, are refused."""
    if name in MISREAD:
        raise QuantityError(f"{name} is not a known unit", f"Did you mean {MISREAD[name]}?")
    product = _product(name)
    near = f"Did you mean {product}?" if product else did_you_mean(name, [*METRIC, *PLAIN, *PREFIXED])
    unknown = QuantityError(f"{name} is not a known unit", near)
    import pint

    registry = pint.application_registry
    try:
        zero = registry.Quantity(0.0, name).to_root_units().magnitude
        one = registry.Quantity(1.0, name).to_root_units()
    except Exception:  # noqa: BLE001 - pint raises a dozen kinds, some not its own; each means: not a unit
        raise unknown from None
    if zero != 0.0:
        raise QuantityError(f"{name} has a zero point of its own", "Give temperatures in K.")
    factor, powers = float(one.magnitude), [0] * len(BASES)
    for root, exponent in one.unit_items():
        if root not in ROOTS or exponent != int(exponent):
            raise unknown
        scale, index = ROOTS[root]
        factor *= scale ** int(exponent)
        powers[index] = int(exponent)
    if powers[:2] in ([2, 1], [-2, -1]) and powers[2] * powers[0] < 0:
        powers[ENERGY] = powers[1]
    return factor, tuple(powers)


def kind(unit: str) -> str:
    """What a unit measures in words ("force"), or "quantity in N^2" when the table has no word for it."""
    if unit in KINDS:
        return KINDS[unit][0]
    dimension = parse_unit(unit).dimension
    for declared, (words, _example) in KINDS.items():
        if parse_unit(declared).dimension == dimension:
            return words
    return f"quantity in {unit}"


def wanted(unit: str) -> str:
    """The sentence that says which quantities are accepted, with an example."""
    if unit == "1":
        return "Write a plain number such as 0.35."
    example = KINDS[unit][1] if unit in KINDS else f"2 {unit}"
    return f"Write {article(kind(unit))} such as {example}, or a bare number in {unit}."


def article(words: str) -> str:
    """The words with "a" or "an" before them."""
    return f"an {words}" if words[0] in "aeiou" else f"a {words}"


def unit_text(dimension: Dimension) -> str:
    """The SI unit of a dimension as text that `parse_unit` reads back, such as `m*kg/s^2`; "" for a number.

    Raises QuantityError when an exponent is not whole or beyond what a unit may have.
    """
    turns = [2, 1, -2, 0, 0, 0, 0]  # J stands for one energy, so its m, kg and s are taken out of the others
    powers = [have - turn * dimension[ENERGY] for have, turn in zip(dimension, turns, strict=True)]
    named = [(base, power) for base, power in zip(BASES, powers) if power]
    if any(power != int(power) or not -LARGEST_EXPONENT <= power <= LARGEST_EXPONENT for _, power in named):
        text = "*".join(f"{base}^{power}" for base, power in named)
        raise QuantityError(f"{text} is not a unit", f"Exponents are whole, up to {LARGEST_EXPONENT}.")
    above = "*".join(_power_text(base, power) for base, power in named if power > 0)
    below = "".join("/" + _power_text(base, -power) for base, power in named if power < 0)
    return (above or "1") + below if named else ""


def quotient(unit: str, by: str) -> str:
    """One unit over another: `s/N`, `m/(N*s)`, `1` where both measure the same."""
    one, other = (parse_unit(each).dimension for each in (unit, by))
    if one == other:
        return "1"
    return unit if by == "1" else f"{unit}/({by})" if "/" in by or "*" in by else f"{unit}/{by}"


def _power_text(base: str, power: Fraction | int) -> str:
    return base if power == 1 else f"{base}^{power}"


def _finite(number: object, unit: str, text: object = None) -> float:
    try:
        result = float(number)  # type: ignore[arg-type]
    except OverflowError:
        result = math.inf
    if not math.isfinite(result):
        raise QuantityError(f"{shown(number if text is None else text)} is not finite", wanted(unit))
    return result


def _hint(given: Dimension, declared: Dimension) -> str:
    if given[:RAD] != declared[:RAD]:
        return ""
    if given[RAD] != declared[RAD]:
        return "Angles are a kind of their own: Hz is not rad/s, and rad is not dropped. "
    return "J measures an energy; a torque is written in N*m. "
