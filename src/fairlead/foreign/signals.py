"""Which variables of an FMU are signals of a component.

    inputs: {speed: shaft.w}                     the input `speed` is the variable shaft.w
    outputs: {pull: {of: F, unit: N}}            of a variable that the FMU gives without a unit
    outputs: {second: "y[2]"}                    an element of an array

Nothing given: all inputs and outputs that are numbers, under their own names, in which every character that is no
letter, digit or underscore becomes an underscore; `y[2]` becomes `y_2`.
"""

from __future__ import annotations

import keyword
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any

from fairlead.component.controller import Controller
from fairlead.errors import did_you_mean, shown
from fairlead.foreign.clocks import COUNTED
from fairlead.foreign.description import Fmu
from fairlead.foreign.refusals import Refused
from fairlead.foreign.units import Scale, scale_of
from fairlead.foreign.variables import ELEMENT, Variable, element, elements, form, names_of, what_it_is

NAME = re.compile(r"[A-Za-z_]\w*$")
TAKEN = {*dir(Controller), "p", "t", "self", "starts", "time_limit", "period"}
"""Names that mean something else to a component."""
RANGES = {f"{sign}Int{bits}": (0 if sign else -(2 ** (bits - 1)), 2 ** (bits - (not sign)) - 1)
          for sign in ("", "U") for bits in (8, 16, 32, 64)} | {"Integer": (-(2**31), 2**31 - 1)}  # fmt: skip
EXACT = 2**53  # whole numbers up to here are exact in a signal
FLOATS = ("Real", "Float64", "Float32")
MOST_ELEMENTS = 1000  # of one array that are signals without being named
MAY_BE = {
    "inputs": ("input",),
    "outputs": ("output", "local", "calculatedParameter", "parameter", "structuralParameter"),
    "parameters": ("parameter", "structuralParameter", "input", "local", "output"),
}
Wrong = tuple[str, str, str]  # a path in the parameters of the component, what is wrong, a way out


@dataclass(frozen=True)
class Signal:
    """A signal of the component, and the variable of the FMU that it is."""

    name: str
    variable: Variable
    scale: Scale

    @property
    def description(self) -> str:
        """What it is, in a sentence."""
        counted = COUNTED if self.variable.kind == "Clock" else ""
        return f"{self.variable.description} {counted}".strip()

    @property
    def start(self) -> float:
        """What the description says it is at first, in SI."""
        return self.scale.si(_number(self.variable.start or "0", self.variable))

    def own(self, value: float) -> float | int | bool:
        """A number in SI as the FMU takes it. Raises Refused for one that its type does not hold."""
        number = self.scale.own(value)
        if self.variable.kind in FLOATS:
            return number
        rounded = round(number)
        if abs(number - rounded) > 1e-9 * max(1.0, abs(number)):  # what sums of decimals leave
            raise Refused(f"the input {self.name} = {value:.9g} is no whole number", takes(self.variable))
        if self.variable.kind == "Boolean":
            if rounded not in (0, 1):
                raise Refused(f"the input {self.name} = {value:.9g} is neither 0 nor 1", takes(self.variable))
            return bool(rounded)
        low, high = RANGES.get(self.variable.kind, (-EXACT, EXACT))
        if not low <= rounded <= high:
            raise Refused(f"the input {self.name} = {value:.9g} is out of range", takes(self.variable))
        return rounded


@dataclass(frozen=True)
class Signals:
    """All that passes between a model and an FMU."""

    inputs: tuple[Signal, ...]
    outputs: tuple[Signal, ...]


def signals_of(fmu: Fmu, inputs: Entries | None, outputs: Entries | None) -> tuple[Signals, list[Wrong]]:
    """The signals that a netlist asks for, and what is wrong with others."""
    wrong: list[Wrong] = []
    taken: dict[str, str] = {}
    read = tuple(_signals(fmu, "inputs", inputs, ("input",), taken, wrong))
    told = tuple(_signals(fmu, "outputs", outputs, ("output",), taken, wrong))
    return Signals(read, told), wrong


Entries = tuple[tuple[str, Any], ...]


def _signals(
    fmu: Fmu, side: str, entries: Entries | None, causalities: tuple[str, ...], taken: dict[str, str],
    wrong: list[Wrong],
) -> Iterator[Signal]:  # fmt: skip
    asked: Iterable[tuple[str, Any]] = entries or ()
    if entries is None:
        try:
            asked = list(_all(fmu, causalities))
        except Refused as error:
            wrong.append((side, error.what, error.way_out))
    for name, said in asked:
        path = f"{side}.{name}" if entries is not None else side
        try:
            variable, unit = _asked(fmu, side, name, said)
            if name in taken:
                raise Refused(f"{shown(variable.name)} would have the name of {shown(taken[name])} too",
                              f"Name what you need: {side}: {{NAME: VARIABLE}}.")  # fmt: skip
            taken[name] = variable.name
            yield Signal(name, variable, scale_of(fmu, variable, unit))
        except Refused as error:
            wrong.append((path, error.what, error.way_out))


def _all(fmu: Fmu, causalities: tuple[str, ...]) -> Iterator[tuple[str, str]]:
    for variable in fmu.of(*causalities):
        if variable.dimensions and math.prod(variable.shape) > MOST_ELEMENTS:
            raise Refused(f"the array {shown(variable.name)} has {form(variable.shape)}",
                          f"Name those that you need, such as {{NAME: {_example(variable)}}}.")  # fmt: skip
        for one in elements(variable) if variable.dimensions else (variable,):
            name = re.sub(r"\W", "_", one.name.removesuffix("]"))
            name = name if NAME.match(name) else f"_{name}"
            yield (f"{name}_" if name in TAKEN or keyword.iskeyword(name) else name), one.name


def _asked(fmu: Fmu, side: str, name: str, said: Any) -> tuple[Variable, str]:
    """The variable and the unit of an entry. Raises Refused."""
    if not NAME.match(name) or name in TAKEN or keyword.iskeyword(name):
        raise Refused(f"no signal can be called {shown(name)}", "Take another name of letters, digits and underscores.")
    given = said if isinstance(said, Mapping) else {"of": said}
    odd = set(given) - {"of", "unit"}
    if odd or not isinstance(given.get("of", name), str) or not isinstance(given.get("unit", ""), str):
        raise Refused(f"{shown(said)} names no variable", "Write the name of a variable, or {of: VARIABLE, unit: N}.")
    variable = known(fmu, given.get("of", name), side)
    if not variable.numeric:
        raise Refused(f"{shown(variable.name)} is {what_it_is(variable)}", "Leave it out.")
    if variable.dimensions:
        raise Refused(f"{shown(variable.name)} is an array of {form(variable.shape)}, and a signal is one number",
                      f"Name an element: {_example(variable)}.")  # fmt: skip
    return variable, given.get("unit", "")


def _example(array: Variable) -> str:
    """The last element, in quotes as YAML wants it."""
    return f'"{array.name}[{",".join(map(str, array.shape))}]"'


def known(fmu: Fmu, name: str, side: str) -> Variable:
    """A variable of the FMU, or an element of one, that may stand there. Raises Refused."""
    may = MAY_BE[side]
    of_side = [one for one in fmu.variables.values() if one.causality == may[0] and (side != "inputs" or one.numeric)]
    has = f"Its {side} are {names_of(iter(of_side))}." if of_side else f"It has no {side}."
    variable = _found(fmu, name)
    if variable is None:
        near = did_you_mean(name, fmu.variables)
        raise Refused(f"the FMU has no variable {shown(name)}", f"{near} {has}".strip())
    if side == "parameters" and variable.kind == "Clock":
        return variable  # what may be set of it is the business of starts
    settable = side != "parameters" or variable.causality in may[:3] or variable.initial in ("exact", "approx")
    if variable.causality not in may or not settable or (variable.variability == "constant" and side == "parameters"):
        raise Refused(f"{shown(name)} is {variable.causality} and cannot be one of its {side}", has)
    return variable


def _found(fmu: Fmu, name: str) -> Variable | None:
    """The variable of this name, which may be `u[2]` of an array `u`. Raises Refused for an index that it has not."""
    if name in fmu.variables or not (indexed := ELEMENT.match(name)):
        return fmu.variables.get(name)
    array = fmu.variables.get(indexed["array"])
    if array is None:
        return None
    if not array.dimensions:
        raise Refused(f"{shown(array.name)} is one number, and {shown(name)} would be an element of an array",
                      f"Write {array.name}.")  # fmt: skip
    return element(array, indexed["indices"].replace(" ", ""))


def started(signals: Signals, values: Mapping[tuple[int, int], float | bool]) -> Signals:
    """Inputs that begin with values that the netlist sets, by reference and place in the array."""

    def begun(one: Signal) -> Signal:
        value = values.get((one.variable.reference, one.variable.place))
        return one if value is None else replace(one, variable=replace(one.variable, start=repr(float(value))))

    return replace(signals, inputs=tuple(map(begun, signals.inputs)))


def _number(text: str, variable: Variable) -> float:
    """A start value of the description; what cannot be read is 0, since the FMU has its own."""
    if text in ("true", "false"):
        return float(text == "true")
    try:
        return float(text)
    except ValueError:
        return float(dict(variable.items).get(text, 0))


def takes(variable: Variable) -> str:
    """What a variable of the FMU takes."""
    if variable.kind == "Boolean":
        return f"{variable.name} is a Boolean of the FMU: 0 or 1."
    if variable.kind == "Clock":
        return f"{variable.name} is a clock of the FMU: it ticks when this whole number rises."
    if variable.kind in FLOATS:
        return f"{variable.name} is {variable.kind} in the FMU: a number{variable.unit and f' in {variable.unit}'}."
    low, high = RANGES.get(variable.kind, (None, None))
    bounds = f" from {low} to {high}" if low is not None else ""
    return f"{variable.name} is {variable.kind} in the FMU: a whole number{bounds}."
