"""A variable of an FMU as its description has it: a number, a text, an array of them, or a clock.

An array of FMI 3 has the dimensions of its description, each a number or the name of a structural parameter. Its
elements are called as the standard forms names, `u[1]` and `u[2,3]`: from 1 on, as it counts elements elsewhere, and
in its order, the last index fastest.
"""

from __future__ import annotations

import itertools
import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

from fairlead.errors import listing
from fairlead.foreign.refusals import Refused

ELEMENT = re.compile(r"(?P<array>.+)\[(?P<indices>\s*\d+\s*(?:,\s*\d+\s*)*)\]$")
UNSIGNALLED = ("String", "Binary")


@dataclass(frozen=True)
class Variable:
    """A variable, or with `size` above 1 the element at `place` (from 0 on) of an array."""

    name: str
    reference: int
    kind: str  # Real, Float32, Int8, Boolean, Enumeration, String, Clock ...
    causality: str
    variability: str
    initial: str
    unit: str
    start: str | None
    description: str
    items: tuple[tuple[str, int], ...] = ()  # of an enumeration: words with their numbers
    dimensions: tuple[int | str, ...] = ()  # of an array; a word names the structural parameter
    clocks: tuple[int, ...] = ()  # references of those at whose ticks alone it may be read or set
    timing: str = ""  # of a clock: constant, fixed, tunable, changing, countdown or triggered
    sized_by: tuple[str, ...] = ()  # structural parameters among the dimensions
    most: int | None = None  # of a structural parameter, which is a size
    place: int = 0
    size: int = 1  # values behind its reference

    @property
    def scalar(self) -> bool:
        """Whether it is one value."""
        return not self.dimensions

    @property
    def numeric(self) -> bool:
        """Whether it can be a signal, or its elements can."""
        return self.kind not in UNSIGNALLED and (self.kind != "Clock" or self.timing == "triggered")

    @property
    def shape(self) -> tuple[int, ...]:
        """Sizes of its dimensions; of an array of a `shaped` FMU only."""
        return tuple(int(one) for one in self.dimensions)


def variable_of(one: Any) -> Variable:
    """As FMPy has read it."""
    declared = one.declaredType
    items = tuple((item.name, int(item.value)) for item in declared.items) if declared is not None else ()
    unit = one.unit or (declared.unit if declared is not None else None) or ""
    clocks = tuple(int(clock.valueReference) for clock in one.clocks or ())
    dimensions = tuple(_dimension(each) for each in one.dimensions)
    sized_by = tuple(size for size in dimensions if isinstance(size, str))
    return Variable(
        one.name, int(one.valueReference), one.type, one.causality or "local", one.variability or "", one.initial or "",
        unit, one.start, one.description or "", items, dimensions, clocks, one.intervalVariability or "",
        sized_by,
    )  # fmt: skip


def _dimension(one: Any) -> int | str:
    if one.variable is None or one.variable.causality != "structuralParameter":
        return int(one.start if one.variable is None else one.variable.start)
    return str(one.variable.name)


def elements(array: Variable) -> Iterator[Variable]:
    """Its elements in the order of the standard."""
    for indices in itertools.product(*(range(1, size + 1) for size in array.shape)):
        yield _element(array, indices)


def element(array: Variable, said: str) -> Variable:
    """The element with these indices, such as "2,3". Raises Refused."""
    indices = [int(one) for one in said.split(",")]
    bounds = f"{array.name} has {form(array.shape)}: {array.name}[{_ones(array)}] to {array.name}[{_ends(array)}]"
    if len(indices) != len(array.shape):
        count = "one index" if len(indices) == 1 else f"{len(indices)} indices"
        raise Refused(f"{array.name}[{said}] has {count}, and {array.name} has {len(array.shape)}", f"{bounds}.")
    if not all(1 <= index <= size for index, size in zip(indices, array.shape, strict=True)):
        raise Refused(f"there is no element {array.name}[{said}]", f"{bounds}.")
    return _element(array, tuple(indices))


def _element(array: Variable, indices: tuple[int, ...]) -> Variable:
    place = 0
    for index, size in zip(indices, array.shape, strict=True):
        place = place * size + index - 1
    count = math.prod(array.shape)
    starts = (array.start or "").split()
    start = starts[place] if len(starts) == count else starts[0] if len(starts) == 1 else None
    name = f"{array.name}[{','.join(map(str, indices))}]"
    return replace(array, name=name, start=start, dimensions=(), place=place, size=count)


def form(shape: tuple[int, ...]) -> str:
    """How many elements there are, in words."""
    if len(shape) == 1:
        return "1 element" if shape[0] == 1 else f"{shape[0]} elements"
    return f"{' x '.join(map(str, shape))} elements"


def _ones(array: Variable) -> str:
    return ",".join("1" for _ in array.shape)


def _ends(array: Variable) -> str:
    return ",".join(map(str, array.shape))


def what_it_is(variable: Variable) -> str:
    """Why it is no number that changes while a run goes on."""
    if variable.kind == "Clock":
        return f"a clock ({variable.timing}), which ticks by itself"
    return f"{variable.kind}, and a signal is one number"


def names_of(variables: Iterator[Variable], most: int = 30) -> str:
    """Names for a message, of arrays with their size."""
    return listing([f"{one.name} ({form(one.shape)})" if one.dimensions else one.name for one in variables], most)
