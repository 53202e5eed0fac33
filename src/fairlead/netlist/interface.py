"""The `interface` block: what a model gives to and takes from a program that steps it from outside."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, StringConstraints

from fairlead.netlist.settings import Strict

OuterName = Annotated[str, StringConstraints(pattern=r"^[a-zA-Z_]\w*$", max_length=80)]


class Outer(Strict):
    """A signal or a parameter under the name that it has outside."""

    of: str
    """What it is inside: of an input a signal that nothing is connected to, of an output any that can be recorded, or
    max(...) or min(...) of a pattern of them; of what is tunable a parameter."""
    unit: str = ""
    """Its unit outside, where the model has a plain number."""
    description: str = ""
    """What it is."""
    nominal: float | str | None = None
    """A usual size, above zero: a scale for tolerances and axes of the program outside."""


class OuterInput(Outer):
    """A signal that is set from outside."""

    start: float | str | None = None
    """Its value until it is set; that of the model when not given."""


def _named(value: Any) -> Any:
    """`force: spring.tension` is short for `force: {of: spring.tension}`."""
    return {"of": value} if isinstance(value, str) else value


Inputs = dict[OuterName, Annotated[OuterInput, BeforeValidator(_named)]]
Outputs = dict[OuterName, Annotated[Outer, BeforeValidator(_named)]]


def _nothing_is_empty(value: object) -> object:
    return {} if value is None else value


class Interface(Strict):
    """Inputs, outputs and tunable parameters by the names that they have outside."""

    inputs: Annotated[Inputs, BeforeValidator(_nothing_is_empty)] = {}
    """What is set from outside, such as reference: command.value."""
    outputs: Annotated[Outputs, BeforeValidator(_nothing_is_empty)] = {}
    """What is read outside, such as force: spring.tension."""
    tunable: Annotated[Outputs, BeforeValidator(_nothing_is_empty)] = {}
    """What can be set between two steps, such as load: pad.normal_force."""
