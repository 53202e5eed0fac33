"""The `interface` block: what a model gives to and takes from a program that steps it from outside."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, StringConstraints

from fairlead.netlist.settings import Strict

OuterName = Annotated[str, StringConstraints(pattern=r"^[a-zA-Z_]\w*$", max_length=80)]


class Outer(Strict):
    """A signal under the name that it has outside."""

    of: str
    """The signal inside: of an input one that nothing is connected to, of an output any that can be recorded."""
    unit: str = ""
    """Its unit outside, where the model has a plain number."""
    description: str = ""
    """What it is."""


def _named(value: Any) -> Any:
    """`force: spring.tension` is short for `force: {of: spring.tension}`."""
    return {"of": value} if isinstance(value, str) else value


Signals = dict[OuterName, Annotated[Outer, BeforeValidator(_named)]]


def _nothing_is_empty(value: object) -> object:
    return {} if value is None else value


class Interface(Strict):
    """Inputs and outputs by the names that they have outside."""

    inputs: Annotated[Signals, BeforeValidator(_nothing_is_empty)] = {}
    """What is set from outside, such as reference: command.value."""
    outputs: Annotated[Signals, BeforeValidator(_nothing_is_empty)] = {}
    """What is read outside, such as force: spring.tension."""
