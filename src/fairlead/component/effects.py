"""Effects: physics that a scene calls for or leaves out; what is off is absent from the compiled system.

A class declares an effect (`declare.Effect`), and a netlist switches it, for one component or for the scene:

    components:
      drive: {type: ServoMotorDrive, effects: {compressibility: off}}     # this one
    effects: {valve_dynamics: off}                                        # all that know it and do not say otherwise

Three ways of being absent, by what would otherwise be there:

    a child         the composite's `expand` makes none             if p.cavitation == "on": ...
    a term          the law is traced without it, as a variant      if p.leakage == "on": ...
    an unknown or   another class takes the place of the whole      Effect("...", off=LimitingModel)
    a zone          component: the limiting model

The word decides, never the value of a number, so that a new value compiles nothing. `Assembly.effects` lists
what is on and off, by component. The one exception is a contact whose friction is zero by a parameter of its composite,
which is not made (`friction/frictionless.py`).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from fairlead.component.base import Declared
from fairlead.component.values import Values


def switch(value: Any) -> Any:
    """The word for a YAML boolean, `on` or `off`; anything else as it is."""
    return {True: "on", False: "off"}[value] if isinstance(value, bool) else value


def in_force(values: Values) -> Values:
    """The values themselves, or those of the limiting model that takes their place."""
    for name, effect in values.type.declaration.effects.items():
        if effect.off is not None and values.given[name] == "off":
            return in_force(_handed_to(effect.off, values))
    return values


def _handed_to(limit: type[Declared], values: Values) -> Values:
    """A limiting model with the parameters and effects that it shares with what it replaces."""
    has = limit.declaration
    names = [name for name in (*has.parameters, *has.effects) if name in values.given]
    handed = Values(limit, {name: values.given[name] for name in names})
    handed.effects = values.effects
    return handed


def nested(kind: type[Declared], given: Mapping[str, Any]) -> dict[str, Any]:
    """Parameters as the model of a class has them, where effects are a map of their own."""
    switches = {name: given[name] for name in kind.declaration.effects if name in given}
    rest = {name: value for name, value in given.items() if name not in switches}
    return {**rest, "effects": {**rest.get("effects", {}), **switches}} if switches else rest
