"""Parameters that a derivative can be taken to: numbers of the scene and of its components, with value and unit.

They bear the names that `--set` takes: `mu`, `pad.normal_force`, `pad.curve.stiction`. Counts, words, tables and what
was left out have no derivative; a quantity in time has one where it is constant.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fairlead.component.numbers import named_unit, numbers, numbers_of_scene
from fairlead.component.values import Group, Values
from fairlead.errors import Fault, Location, did_you_mean, listing, shown
from fairlead.quantities import QuantityError, si

if TYPE_CHECKING:
    from fairlead.model import Model

PLACE = Location("to")


@dataclass(frozen=True)
class Varied:
    """A parameter: its value and the size in which its changes are counted, both in SI."""

    name: str
    value: float
    unit: str
    scale: float

    def at(self, z: float) -> float:
        """Its value after a change of z sizes."""
        return self.value + z * self.scale


def asked_parameters(model: Model, wanted: Mapping[str, str | float | None], faults: list[Fault]) -> list[Varied]:
    """The parameters of these names, each with its size if one is given; what is wrong goes to `faults`."""
    known = numbers(model.netlist, model.assembly.entries)
    known = {name: (value, named_unit(unit)) for name, (value, unit) in known.items()}
    found = (_varied(model, known, name, size, faults) for name, size in wanted.items())
    return [one for one in found if one is not None]


def defaults(model: Model) -> list[str]:
    """What is varied when nobody says: the numbers among the parameters of the scene."""
    return list(numbers_of_scene(model.netlist))


def _varied(
    model: Model, known: Mapping[str, tuple[float, str]], name: str, size: str | float | None, faults: list[Fault]
) -> Varied | None:
    if name not in known:
        faults.append(_unknown(model, known, name))
        return None
    value, unit = known[name]
    try:
        scale = abs(value) if size is None else si(size, unit or "1")
    except QuantityError as error:
        faults.append(Fault(PLACE, f"{name} = {shown(size)}: {error.what}", error.allowed))
        return None
    if scale > 0:
        return Varied(name, value, unit or "1", scale)
    what = f"{name} is 0, so there is no size to count its changes in" if size is None else f"{name} = {shown(size)}"
    faults.append(Fault(PLACE, what, f"Give a size above zero, as in {name}={f'0.1 {unit}'.strip()}."))
    return None


def _unknown(model: Model, known: Mapping[str, object], name: str) -> Fault:
    """A name without a number: what it is instead, or names near it."""
    component, _, inner = name.partition(".")
    if name in model.netlist.parameters:
        return Fault(PLACE, f"{name} is no number", "A derivative is taken to a number of the scene or of a component.")
    if component in model.assembly.entries:
        try:
            value = model.assembly.entries[component].path(inner) if inner else model.assembly.entries[component]
        except AttributeError:
            mine = [one for one in known if one.startswith(f"{component}.")]
            hint = did_you_mean(name, mine)
            return Fault(PLACE, f"{component} has no number {shown(inner)}. {hint}".rstrip(), _there_are(mine))
        mine = [one for one in known if one.startswith(f"{name}.")]
        return Fault(PLACE, f"{name} is {_called(value)}", _there_are(mine or known))
    what = f"{model.netlist.name} has no parameter {shown(name)}. {did_you_mean(name, known)}".rstrip()
    return Fault(PLACE, what, _there_are(known))


def _there_are(names: Any) -> str:
    found = list(names)
    return f"There are {listing(found)}." if found else "None of its parameters is a number."


def _called(value: Any) -> str:
    if value is None:
        return "not given"
    if isinstance(value, str):
        return f"the word {shown(value)}"
    if isinstance(value, int) and not isinstance(value, bool):
        return "a whole number, which has no derivative"
    if isinstance(value, Values | Group):
        return "a group of parameters"
    return "a quantity that changes in time, or a table"
