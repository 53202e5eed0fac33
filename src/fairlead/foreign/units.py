"""Units of an FMU as fairlead knows them: SI inside a model, factor * value + offset."""

from __future__ import annotations

import re
from dataclasses import dataclass

from fairlead.errors import shown
from fairlead.foreign.description import Fmu
from fairlead.foreign.refusals import Refused
from fairlead.foreign.variables import Variable
from fairlead.quantities import KINDS, Dimension, QuantityError, Unit, fits, parse_unit, unit_text

PLAIN = ("", "1", "-")
SAID = "Say in which unit it is: {of: VARIABLE, unit: N}"
MODELICA = re.compile(r"(?<=[A-Za-z])(-?\d)")


@dataclass(frozen=True)
class Scale:
    """The SI unit of a signal, and how its number in the FMU becomes one in SI."""

    unit: str
    factor: float = 1.0
    offset: float = 0.0

    def si(self, value: float) -> float:
        """A number of the FMU in SI."""
        return self.factor * value + self.offset

    def own(self, value: float) -> float:
        """A number in SI as the FMU has it."""
        return (value - self.offset) / self.factor


def scale_of(fmu: Fmu, variable: Variable, given: str = "") -> Scale:
    """How a variable is scaled; `given` is the unit that the netlist says it has. Raises Refused."""
    said = _given(given)
    if variable.unit in PLAIN:
        return Scale(_si(said.dimension), said.factor) if said else Scale("1")
    own = _own(fmu, variable)
    if said and not fits(said.dimension, parse_unit(own.unit).dimension):
        raise Refused(f"the FMU has {variable.name} in {variable.unit}, which is no unit of {given}",
                      f"Leave out the unit, or give {variable.unit}.")  # fmt: skip
    if said and said.factor != own.factor:
        raise Refused(f"the FMU has {variable.name} in {variable.unit}, not in {given}",
                      f"Leave out the unit: fairlead turns {variable.unit} into {own.unit} by itself.")  # fmt: skip
    return own


def _own(fmu: Fmu, variable: Variable) -> Scale:
    """As the FMU says, by the spelling of the unit and by its definition."""
    base = fmu.units.get(variable.unit)
    try:
        spelt = parse_unit(MODELICA.sub(r"^\1", variable.unit.replace(".", "*")))
    except QuantityError:
        spelt = None
    if (base is None and spelt is None) or (base is not None and base.others):
        raise Refused(f"{variable.name} is in {shown(variable.unit)}, a unit that fairlead does not know", f"{SAID}.")
    if base is None:
        assert spelt is not None
        return Scale(_si(spelt.dimension), spelt.factor)
    exponents: Dimension = (*base.exponents, 0)
    if spelt is not None and spelt.dimension[:5] == base.exponents[:5]:  # tools leave out rad
        exponents = spelt.dimension
    return Scale(_si(exponents), base.factor, base.offset)


def _given(text: str) -> Unit | None:
    """The unit that a netlist gives. Raises Refused."""
    try:
        return parse_unit(text) if text else None
    except QuantityError as error:
        raise Refused(error.what, error.allowed) from None


def _si(dimension: Dimension) -> str:
    """The SI unit of a dimension as components name it."""
    return next((unit for unit in KINDS if parse_unit(unit).dimension == tuple(dimension)), unit_text(dimension) or "1")
