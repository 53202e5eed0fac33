"""Settings of a run as keyword arguments of Python: the same names, quantities and refusals as in a netlist.

    model.run(stop="5 s", accuracy=1e-6)
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import Any, Literal, TypedDict

import numpy as np

from fairlead.errors import Fault, Location, ModelError, did_you_mean, shown
from fairlead.netlist.netlist import Value
from fairlead.netlist.settings import RecordSettings, RunSettings, Strict
from fairlead.netlist.translate import validate

FRICTION = ("hold", "karnopp", "binding", "tanh", "arctan", "root", "reset_integrator", "dahl", "lugre",
            "elastoplastic", "maxwell_slip")  # fmt: skip
"""Treatments of friction of the bundled laws, which are no methods of an engine."""
OWN = {
    "Model.run": ("out", "force", "progress", "profile", "check"), "Model.start": ("inputs", "tunable"),
    "export": ("file", "version", "inputs", "outputs", "tunable"),
    "export_library": ("folder", "inputs", "outputs", "tunable"),
}  # fmt: skip
"""What a call takes beside settings of a run, for who mistypes it."""
Quantity = float | str
"""A number in SI, or a text with its unit: `5.0` or `"5 s"`."""


class RunKeywords(TypedDict, total=False):
    """What `Model.run` takes beside its own arguments; each is documented in `RunSettings`."""

    stop: Quantity
    start: Quantity
    accuracy: Quantity
    engine: Literal["auto", "rodas", "stepping", "ida"]
    method: Literal["auto", "rodas5p", "rodas3p"]
    max_step: Quantity | None
    real_time: Quantity | None
    first_step: Quantity | None
    step_floor: Quantity | None
    max_wall: Quantity | None
    max_steps: int | None
    max_events: int | None
    chatter: Literal["warn", "hold", "stop"]
    dwell: Quantity | None


class _Block(Strict):
    run: RunSettings


def with_keywords(settings: RunSettings, given: Mapping[str, Any], parameters: Collection[str] = (),
                  called: str = "Model.run") -> RunSettings:  # fmt: skip
    """The settings of a netlist with those that are given. Raises ModelError with every mistake in them.

    `parameters` are those of the scene: who gives one here is told where it goes. `called` is the call.
    """
    place = Location(called)
    strays = {name: Fault(place, *said) for name, *said in _strays(given, parameters, OWN.get(called, ()))}
    known = {name: value for name, value in given.items() if name not in strays}
    made, faults = validate(_Block, _written({"run": settings.model_dump() | known}, place))
    if made is None or strays:
        raise ModelError([*strays.values(), *faults])
    return made.run


def _strays(
    given: Mapping[str, Any], parameters: Collection[str], own: Collection[str]
) -> Iterator[tuple[str, str, str]]:
    """What is no setting of a run, but of its record, of friction, of the scene, of a part or the call itself.

    Each with its name, what it is not, and a way out.
    """
    for name, value in given.items():
        if name == "method" and isinstance(value, str) and value in FRICTION:
            what = f"run.method = {value} is a treatment of friction, not a method of the engine"
            yield name, what, f'Give it to the model: load(..., set={{"friction.method": {value!r}}}).'
        if name in RunSettings.model_fields:  # also where the scene has a parameter of that name
            continue
        if name in RecordSettings.model_fields:
            way_out = f'It stands in the block record: load(..., set={{"record.{name}": ...}}).'
        elif name == "record":
            way_out = 'It is a block of the netlist: load(..., set={"record.every": ...}); its signals stand there.'
        elif name in parameters:
            way_out = f"It is a parameter of the scene: model.with_values({name}={shown(repr(value))}).run()."
        elif "." in name:
            way_out = f"What a part has is given before: model.with_values({{{name!r}: {shown(repr(value))}}}).run()."
        elif did_you_mean(name, RunSettings.model_fields) or not (near := did_you_mean(name, own)):
            continue
        else:
            way_out = near
        yield name, f"run has no key {name}", way_out


def _written(value: Any, place: Location) -> Value:
    """A value as if it stood in a netlist; numbers of numpy as Python's own."""
    if isinstance(value, dict):
        return Value({str(name): _written(one, place) for name, one in value.items()}, place, place)
    if isinstance(value, list | tuple):
        return Value([_written(one, place) for one in value], place, place)
    return Value(value.item() if isinstance(value, np.generic) else value, place, place)
