"""Parameters that are like an input: plain numbers which a netlist may write in the unit of the signal joined there."""

from __future__ import annotations

from collections.abc import Mapping

from fairlead.component.base import Declared
from fairlead.component.given import Parameter
from fairlead.netlist.netlist import Value
from fairlead.quantities import NONE, Dimension, QuantityError, quantity


def dimensions_of_levels(of: type[Declared], given: Mapping[str, Value]) -> dict[str, Dimension]:
    """By name: what the parameters measure that are like an input, and written with a unit."""
    declared = of.declaration.parameters
    like = (name for name, one in declared.items() if isinstance(one, Parameter) and one.like and name in given)
    return {name: found for name in like if (found := _dimension(given[name].plain())) != NONE}


def _dimension(value: object) -> Dimension:
    try:
        return quantity(value).dimension if isinstance(value, str) else NONE
    except QuantityError:  # told where it is read
        return NONE
