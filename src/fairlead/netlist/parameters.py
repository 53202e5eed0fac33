"""The scene's parameters: checked, worked out in the order they need each other, circles named."""

from __future__ import annotations

import keyword
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from graphlib import CycleError, TopologicalSorter

from fairlead.errors import Fault, Location, shown
from fairlead.netlist.expressions import (
    RESERVED,
    ExpressionError,
    Scalar,
    has_expression,
    names_in,
    substitute,
)
from fairlead.netlist.netlist import Value
from fairlead.quantities import NUMBER, QuantityError, quantity

MOST_CIRCLES = 10  # named in one go: finding each takes a pass over all parameters
NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")


@dataclass
class Parameters:
    """Scene parameters by name; `broken` ones have a fault of their own and say where it stands."""

    values: dict[str, Scalar] = field(default_factory=dict)
    broken: dict[str, Location] = field(default_factory=dict)

    def put_into(self, value: Value, path: str) -> tuple[Value, Fault | None]:
        """The value at `path` with its expression, if it has one, worked out; 0 and a fault when it cannot be."""
        text = value.content
        if not isinstance(text, str) or not has_expression(text):
            return value, None
        for name in self.broken.keys() & names_in(text):
            fault = Fault(
                value.where, f"{path}: {shown(text)}: parameter {name} has a mistake, at {self.broken[name]}"
            )
            return replace(value, content=0), fault
        try:
            return replace(value, content=substitute(text, self.values), written=text), None
        except ExpressionError as error:
            return replace(value, content=0), Fault(value.where, f"{path}: {error.what}", error.way_out)


def work_out(given: Mapping[str, Value]) -> tuple[Parameters, list[Fault]]:
    """The parameters of a scene, each worked out after those it names."""
    done, faults = Parameters(), []
    for name, value in given.items():
        if fault := _mistake(name, value):
            faults.append(fault)
            done.broken[name] = fault.where or value.where
    sound = {name: value for name, value in given.items() if name not in done.broken}
    for name in _order(sound, done.broken, faults):
        value, fault = done.put_into(sound[name], f"parameters.{name}")
        if fault:
            faults.append(fault)
            done.broken[name] = value.where
        else:
            done.values[name] = value.content  # type: ignore[assignment]
    return done, faults


def _order(sound: Mapping[str, Value], broken: dict[str, Location], faults: list[Fault]) -> list[str]:
    """The names, each after those it needs; a circle is a fault, and its members are broken."""
    needs = {name: names_in(str(value.content)) & sound.keys() for name, value in sound.items()}
    circles = 0
    while True:
        try:
            return [*TopologicalSorter(needs).static_order()]
        except CycleError as error:
            circle: list[str] = error.args[1]
        names = circle if len(circle) < 10 else [*circle[:5], "...", circle[-1]]
        what = f"parameters need each other in a circle: {' -> '.join(shown(name) for name in names)}"
        faults.append(Fault(sound[circle[0]].where, what))
        circles += 1
        hopeless = needs if circles == MOST_CIRCLES else circle
        broken.update({name: sound[name].where for name in hopeless})
        needs = {name: needed - broken.keys() for name, needed in needs.items() if name not in broken}


def _mistake(name: str, value: Value) -> Fault | None:
    """What keeps a parameter from being used, if anything."""
    content = value.content
    if name in RESERVED or keyword.iskeyword(name) or not NAME.fullmatch(name):
        why = "a word of the arithmetic" if name in RESERVED else "not a name"
        advice = "A parameter's name has letters, digits and underscores, and is none of the functions."
        return Fault(value.named_at, f"parameters: {shown(name)} is {why}", advice)
    if content is None or isinstance(content, (dict, list)):
        advice = 'A parameter is one number, quantity or text; an expression goes in quotes: "{2*mu}".'
        return Fault(value.where, f"parameters.{name} = {shown(content)} is not a parameter", advice)
    if isinstance(content, str) and (match := NUMBER.match(content)) and content[match.end() :][:1] == " ":
        try:
            quantity(content)
        except QuantityError as error:
            return Fault(value.where, f"parameters.{name} = {error.what}", error.allowed)
    return None
