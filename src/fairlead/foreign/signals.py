"""Which variables of an FMU are signals of a component, and what its parameters are set to.

    inputs: {speed: shaft.w}                     the input `speed` is the variable shaft.w
    outputs: {pull: {of: F, unit: N}}            of a variable that the FMU gives without a unit
    parameters: {gain: 0.3, "pid.Ti": 20 ms}     by the names of the FMU

Nothing given: all inputs and outputs that are one number, under their own names, in which every character that is no
letter, digit or underscore becomes an underscore.
"""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from fairlead.component.controller import Controller
from fairlead.errors import did_you_mean, listing, shown
from fairlead.foreign.description import Fmu, Variable
from fairlead.foreign.refusals import Refused
from fairlead.foreign.units import Scale, scale_of
from fairlead.quantities import QuantityError, si

NAME = re.compile(r"[A-Za-z_]\w*$")
TAKEN = {*dir(Controller), "p", "t", "self", "starts", "time_limit", "period"}
"""Names that mean something else to a component."""
RANGES = {f"{sign}Int{bits}": (0 if sign else -(2 ** (bits - 1)), 2 ** (bits - (not sign)) - 1)
          for sign in ("", "U") for bits in (8, 16, 32, 64)} | {"Integer": (-(2**31), 2**31 - 1)}  # fmt: skip
EXACT = 2**53  # whole numbers up to here are exact in a signal
FLOATS = ("Real", "Float64", "Float32")
Wrong = tuple[str, str, str]  # a path in the parameters of the component, what is wrong, a way out


@dataclass(frozen=True)
class Signal:
    """A signal of the component, and the variable of the FMU that it is."""

    name: str
    variable: Variable
    scale: Scale

    @property
    def start(self) -> float:
        """What the description says it is at first, in SI."""
        return self.scale.si(float(_number(self.variable.start or "0", self.variable)))

    def own(self, value: float) -> float | int | bool:
        """A number in SI as the FMU takes it. Raises Refused for one that its type does not hold."""
        number = self.scale.own(value)
        if self.variable.kind in FLOATS:
            return number
        rounded = round(number)
        if abs(number - rounded) > 1e-9 * max(1.0, abs(number)):  # what sums of decimals leave
            raise Refused(f"the input {self.name} = {value:.9g} is no whole number", _takes(self.variable))
        if self.variable.kind == "Boolean":
            if rounded not in (0, 1):
                raise Refused(f"the input {self.name} = {value:.9g} is neither 0 nor 1", _takes(self.variable))
            return bool(rounded)
        low, high = RANGES.get(self.variable.kind, (-EXACT, EXACT))
        if not low <= rounded <= high:
            raise Refused(f"the input {self.name} = {value:.9g} is out of range", _takes(self.variable))
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
    asked: Iterable[tuple[str, Any]] = entries if entries is not None else _all(fmu, causalities)
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
        name = re.sub(r"\W", "_", variable.name)
        name = name if NAME.match(name) else f"_{name}"
        yield (f"{name}_" if name in TAKEN or keyword.iskeyword(name) else name), variable.name


def _asked(fmu: Fmu, side: str, name: str, said: Any) -> tuple[Variable, str]:
    """The variable and the unit of an entry. Raises Refused."""
    if not NAME.match(name) or name in TAKEN or keyword.iskeyword(name):
        raise Refused(f"no signal can be called {shown(name)}", "Take another name of letters, digits and underscores.")
    given = said if isinstance(said, Mapping) else {"of": said}
    odd = set(given) - {"of", "unit"}
    if odd or not isinstance(given.get("of", name), str) or not isinstance(given.get("unit", ""), str):
        raise Refused(f"{shown(said)} names no variable", "Write the name of a variable, or {of: VARIABLE, unit: N}.")
    variable = _known(fmu, given.get("of", name), side)
    if not variable.numeric:
        what = variable.kind if variable.scalar else "an array"
        raise Refused(f"{shown(variable.name)} is {what}, and a signal is one number", "Leave it out.")
    return variable, given.get("unit", "")


def _known(fmu: Fmu, name: str, side: str) -> Variable:
    """A variable of the FMU that may stand there. Raises Refused."""
    may = {"inputs": ("input",), "outputs": ("output", "local", "calculatedParameter", "parameter"),
           "parameters": ("parameter", "structuralParameter", "input", "local", "output")}[side]  # fmt: skip
    names = [one.name for one in fmu.variables.values() if one.causality == may[0]]
    variable = fmu.variables.get(name)
    if variable is None:
        near = did_you_mean(name, fmu.variables)
        raise Refused(f"the FMU has no variable {shown(name)}", f"{near} {_has(side, names)}".strip())
    settable = side != "parameters" or variable.causality in may[:3] or variable.initial in ("exact", "approx")
    if variable.causality not in may or not settable or (variable.variability == "constant" and side == "parameters"):
        raise Refused(f"{shown(name)} is {variable.causality} and cannot be one of its {side}", _has(side, names))
    return variable


def _has(side: str, names: list[str]) -> str:
    return f"Its {side} are {listing(names, 30)}." if names else f"It has no {side}."


def starts_of(fmu: Fmu, entries: Entries) -> tuple[tuple[tuple[str, Any], ...], list[Wrong]]:
    """Variables that are set before a run begins, with values as the FMU takes them; and what is wrong with others."""
    found, wrong = [], list[Wrong]()
    for name, said in entries:
        try:
            variable = _known(fmu, name, "parameters")
            found.append((name, _start(fmu, variable, said)))
        except Refused as error:
            wrong.append((f"parameters.{name}", error.what, error.way_out))
    return tuple(found), wrong


def _start(fmu: Fmu, variable: Variable, said: Any) -> Any:
    """A value that a netlist gives to a variable of the FMU. Raises Refused."""
    if not variable.scalar or variable.kind in ("Binary", "Clock"):
        raise Refused(f"{shown(variable.name)} is {variable.kind if variable.scalar else 'an array'}", "Leave it out.")
    if variable.kind == "String":
        if not isinstance(said, str):
            raise Refused(f"{shown(said)} is no text, and {variable.name} is one", "Write it in quotes.")
        return said
    if isinstance(said, bool) or said in ("true", "false"):
        if variable.kind != "Boolean":
            raise Refused(f"{shown(said)} is no number", _takes(variable))
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


def _number(text: str, variable: Variable) -> float:
    """A start value of the description; what cannot be read is 0, since the FMU has its own."""
    if text in ("true", "false"):
        return float(text == "true")
    try:
        return float(text)
    except ValueError:
        return float(dict(variable.items).get(text, 0))


def _takes(variable: Variable) -> str:
    """What a variable of the FMU takes."""
    if variable.kind == "Boolean":
        return f"{variable.name} is a Boolean of the FMU: 0 or 1."
    if variable.kind in FLOATS:
        return f"{variable.name} is {variable.kind} in the FMU: a number{variable.unit and f' in {variable.unit}'}."
    low, high = RANGES.get(variable.kind, (None, None))
    bounds = f" from {low} to {high}" if low is not None else ""
    return f"{variable.name} is {variable.kind} in the FMU: a whole number{bounds}."
