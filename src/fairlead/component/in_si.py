"""Declarations in SI: what a class declares in `mm` is a length in metres to everybody who asks it.

Laws reckon in SI, and so do netlists that give a bare number. Who writes `Parameter("mm", default=5.0, most=1000.0)`
means 5 mm and at most 1000 mm, so these numbers are turned, and the unit with them. What a law gives or keeps cannot be
turned without guessing in which unit its author reckons: an output, input or variable in such a unit is refused.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import Any

from fairlead.component.declaration import Declaration
from fairlead.component.given import REQUIRED, Block, Parameter, Table, Waveform
from fairlead.quantities import KINDS, QuantityError, parse_unit, unit_text

BOUNDS = ("default", "above", "least", "below", "most")


def parameters_in_si(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """The parameters with units in SI, and the numbers that were declared in others turned."""
    return {name: _in_si(one) for name, one in parameters.items()}


def not_in_si(parameters: Mapping[str, Any], has: Declaration) -> Iterator[str]:
    """What cannot be turned: tables and quantities in time with defaults, as written in `parameters`; and variables."""
    for name, one in parameters.items():
        if isinstance(one, Block) and isinstance(one.parameters, Mapping):
            yield from not_in_si(one.parameters, Declaration())
        if isinstance(one, Waveform | Table) and not _is_number(one.default) and one.default not in (REQUIRED, None):
            units = (one.x, one.y) if isinstance(one, Table) else (one.unit,)
            odd = ((unit, si_unit(unit)) for unit in units if si_unit(unit) != unit)
            yield from (f"the default of {name!r} is read in SI; declare it in {si}, not {unit}" for unit, si in odd)
    kinds: dict[str, Mapping[str, Any]] = {
        "output": has.outputs, "input": has.inputs, "state": has.states, "unknown": has.unknowns,
        "discrete variable": has.discrete,
    }  # fmt: skip
    for kind, named in kinds.items():
        for name, one in named.items():
            if (si := si_unit(one.unit)) != one.unit:
                yield f"the {kind} {name!r} is in {one.unit}, and laws reckon and runs record in SI; declare it in {si}"
    for name, guard in has.guards.items():
        if (si := si_unit(guard.unit)) != guard.unit:
            yield f"the guard {name!r} is in {guard.unit}, and laws reckon in SI; its unit is {si}"


def si_unit(unit: Any) -> Any:
    """The unit of SI for what is declared in another one; the same where it is one, or none at all."""
    try:
        known = parse_unit(unit) if isinstance(unit, str) else None
        if known is None or known.factor == 1.0:
            return unit
        alike = (one for one in KINDS if parse_unit(one).dimension == known.dimension)
        return next(alike, None) or unit_text(known.dimension)
    except QuantityError:
        return unit


def _in_si(one: Any) -> Any:
    if isinstance(one, Block) and isinstance(one.parameters, Mapping):
        return replace(one, parameters=parameters_in_si(one.parameters))
    if isinstance(one, Table):
        return replace(one, x=si_unit(one.x), y=si_unit(one.y))
    if not isinstance(one, Parameter | Waveform) or si_unit(one.unit) == one.unit:
        return one
    factor = parse_unit(one.unit).factor
    turned = {name: getattr(one, name) * factor for name in BOUNDS if _is_number(getattr(one, name, None))}
    if isinstance(one, Parameter) and one.usual is not None:
        turned["usual"] = (one.usual[0] * factor, one.usual[1] * factor)
    return replace(one, unit=si_unit(one.unit), **turned)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)
