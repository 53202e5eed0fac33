"""What an FMU is given before a run begins: its block `parameters`, by the names of the FMU.

    parameters: {gain: 0.3, "pid.Ti": 20 ms}             numbers, quantities, words, texts
    parameters: {size: 3, weights: [1, 2, 3]}            an array, here of as many elements as `size` says
    parameters: {rows: [[1, 2], [3, 4]], all: 0}         of two dimensions; one value for all elements
    parameters: {"u[2]": 5, sampling: 20 ms}             one element; the interval of a clock that can be set
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from fairlead.errors import listing, shown
from fairlead.foreign.description import Fmu, shaped
from fairlead.foreign.refusals import Refused
from fairlead.foreign.signals import Entries, Signal, Wrong, known, takes
from fairlead.foreign.units import scale_of
from fairlead.foreign.variables import Variable, element, form, what_it_is
from fairlead.quantities import QuantityError, si

ROUNDED = 1e-9  # by which a tick may miss a communication point, relative
Value = float | int | bool | str


@dataclass(frozen=True)
class Start:
    """Values of a variable as the FMU takes them, each with its place in the array (0 of a scalar)."""

    variable: Variable
    values: tuple[tuple[int, Value], ...]

    @property
    def told(self) -> tuple[Any, ...]:
        """Type, reference, number of elements, and the values."""
        one = self.variable
        return one.kind, one.reference, math.prod(one.shape) if one.dimensions else one.size, self.values


@dataclass(frozen=True)
class Starts:
    """All that is set before the start."""

    structure: tuple[Start, ...] = ()  # sizes and the like, which FMI 3 sets in a mode of their own
    values: tuple[Start, ...] = ()
    intervals: tuple[Start, ...] = ()  # s, of clocks

    @property
    def told(self) -> tuple[tuple[str, Any], ...]:
        """What the process is told of it, by the words of worker.py."""
        return (
            ("structure", tuple(one.told for one in self.structure)),
            ("starts", tuple(one.told for one in self.values)),
            ("intervals", tuple((one.variable.reference, one.values[0][1]) for one in self.intervals)),
        )

    @property
    def of_clocks(self) -> dict[str, float]:
        """Intervals [s] by the names of clocks."""
        return {one.variable.name: float(one.values[0][1]) for one in self.intervals}

    @property
    def numbers(self) -> dict[tuple[int, int], float | bool]:
        """The value of each variable that is a number, by reference and place."""
        return {(one.variable.reference, place): value for one in self.values for place, value in one.values
                if not isinstance(value, str)}  # fmt: skip


def sized(fmu: Fmu, entries: Entries) -> Fmu:
    """The FMU with arrays of the sizes that the netlist gives; one that is given wrongly is as it is by itself."""
    sizes = []
    for name, said in entries:
        variable = fmu.variables.get(name)
        if variable is not None and variable.causality == "structuralParameter":
            try:
                start = Start(variable, tuple(_values(fmu, variable, said)))
                _check_size(variable, start)
            except Refused:
                continue
            sizes.append((name, int(start.values[0][1])))
    return shaped(fmu, tuple(sizes))


def starts_of(fmu: Fmu, entries: Entries) -> tuple[Starts, list[Wrong]]:
    """What is set before a run begins, of a shaped FMU; and what is wrong with other entries."""
    structure, values, intervals = list[Start](), list[Start](), list[Start]()
    wrong = list[Wrong]()
    dimensions = {one for variable in fmu.variables.values() for one in variable.sized_by}
    for name, said in entries:
        try:
            variable = known(fmu, name, "parameters")
            if variable.kind == "Clock":
                intervals.append(Start(variable, ((0, _interval(fmu, variable, said)),)))
                continue
            start = Start(variable, tuple(_values(fmu, variable, said)))
            if variable.name in dimensions:
                _check_size(variable, start)
            (structure if variable.causality == "structuralParameter" else values).append(start)
        except Refused as error:
            wrong.append((f"parameters.{name}", error.what, error.way_out))
    return Starts(tuple(structure), tuple(values), tuple(intervals)), wrong


def unmet(fmu: Fmu, intervals: Mapping[str, float], period: float) -> Iterator[str]:
    """Ticks of periodic clocks that no communication point meets, of an FMU whose steps all have one length."""
    for clock in fmu.clocks.values() if not fmu.splits else ():
        interval = intervals.get(clock.name, clock.interval)
        for what, time in (("interval", interval), ("shift", clock.shift)):
            ratio = (time or 0.0) / period
            if abs(ratio - round(ratio)) > ROUNDED * max(1.0, ratio):
                yield f"its clock {clock.name} has the {what} {time:g} s, which is no multiple of period = {period:g} s"


def _check_size(variable: Variable, start: Start) -> None:
    """A size of arrays is at least 1, and no more than the FMU takes. Raises Refused."""
    size, most = start.values[0][1], variable.most
    if not isinstance(size, int) or size < 1 or (most is not None and size > most):
        bounds = "from 1 on" if most is None else f"from 1 to {most}"
        raise Refused(f"{variable.name} = {size} is no size that its arrays may have", f"Give a whole number {bounds}.")


def _interval(fmu: Fmu, variable: Variable, said: Any) -> float:
    """The interval of a clock [s]. Raises Refused."""
    clock = fmu.clocks.get(variable.name)
    if clock is None:
        raise Refused(f"{shown(variable.name)} is a triggered clock and has no interval", "Leave it out.")
    if not clock.settable:
        why = "the FMU alone says when it ticks"
        raise Refused(f"{shown(variable.name)} is a clock with intervalVariability {clock.timing}: {why}",
                      "Leave it out.")  # fmt: skip
    try:
        interval = si(said, "s")
    except QuantityError as error:
        raise Refused(error.what, error.allowed) from None
    if interval <= 0:
        raise Refused(f"the clock {shown(variable.name)} has an interval of {shown(said)}", "Give a time above 0.")
    return interval


def _values(fmu: Fmu, variable: Variable, said: Any) -> Iterator[tuple[int, Value]]:
    """Each value with its place. Raises Refused."""
    if variable.kind in ("Binary", "Clock"):
        raise Refused(f"{shown(variable.name)} is {what_it_is(variable)}", "Leave it out; it keeps its own start.")
    if variable.scalar:
        if isinstance(said, list | tuple):
            raise Refused(f"{shown(said)} is no single value, and {variable.name} is one", takes(variable))
        yield variable.place, _value(fmu, variable, said)
    elif isinstance(said, list | tuple):
        for place, one in enumerate(_flat(variable, said, variable.shape, "")):
            indices = ",".join(str(index + 1) for index in _indices(place, variable.shape))
            yield place, _element_value(fmu, element(variable, indices), one)
    else:
        value = _value(fmu, replace(variable, dimensions=()), said)
        yield from ((place, value) for place in range(math.prod(variable.shape)))


def _element_value(fmu: Fmu, one: Variable, said: Any) -> Value:
    """A value of a list. Raises Refused, with the name of the element."""
    try:
        return _value(fmu, one, said)
    except Refused as error:
        named = error.what if one.name in error.what else f"{one.name}: {error.what}"
        raise Refused(named, error.way_out) from None


def _flat(variable: Variable, said: Any, shape: tuple[int, ...], where: str) -> Iterator[Any]:
    """The values of a list in the order of the standard. Raises Refused for another shape than that of the array."""
    if not shape:
        if isinstance(said, list | tuple):
            raise Refused(f"{variable.name}{where} is {shown(said)}, and it is one value", _lists(variable))
        yield said
        return
    if not isinstance(said, list | tuple):
        raise Refused(f"{variable.name}{where} is {shown(said)} and no list", _lists(variable))
    if len(said) != shape[0]:
        has = f"{variable.name} has {form(variable.shape)}"
        raise Refused(f"{variable.name}{where} is {shown(said)}, and {has}", _lists(variable))
    for place, one in enumerate(said, 1):
        yield from _flat(variable, one, shape[1:], f"{where}[{place}]")


def _lists(variable: Variable) -> str:
    """How an array is written."""
    plural = "s" * (variable.shape[-1] != 1)
    inner = f"a list of {' lists of '.join(map(str, variable.shape))} value{plural}"
    sizes = f" Its size is set by {listing(dict.fromkeys(variable.sized_by))}." if variable.sized_by else ""
    return f"Write {inner}; or one value for all elements.{sizes}"


def _indices(place: int, shape: tuple[int, ...]) -> tuple[int, ...]:
    found: list[int] = []
    for size in reversed(shape):
        place, index = divmod(place, size)
        found.append(index)
    return tuple(reversed(found))


def _value(fmu: Fmu, variable: Variable, said: Any) -> Value:
    """One value that a netlist gives, as the FMU takes it. Raises Refused."""
    if variable.kind == "String":
        if not isinstance(said, str):
            raise Refused(f"{shown(said)} is no text, and {variable.name} is one", "Write it in quotes.")
        return said
    if isinstance(said, bool) or said in ("true", "false"):
        if variable.kind != "Boolean":
            raise Refused(f"{shown(said)} is no number", takes(variable))
        return said in (True, "true")
    said = dict(variable.items).get(said, said) if isinstance(said, str) else said
    scale = scale_of(fmu, variable)
    try:
        return Signal(variable.name, variable, scale).own(si(said, scale.unit))
    except QuantityError as error:
        words = f" Or one of {listing([word for word, _ in variable.items])}." if variable.items else ""
        raise Refused(error.what, f"{error.allowed}{words}") from None
    except Refused as error:
        raise Refused(error.what.replace("the input ", ""), error.way_out) from None
