"""The shape of a netlist file as pydantic models: the one source of its validation and of its JSON Schema.

Component parameters are open here (`extra="allow"`): each component class closes them by a model of its own.
"""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, StringConstraints

from fairlead.netlist.hover import say
from fairlead.netlist.interface import Interface
from fairlead.netlist.settings import RecordSettings, RunSettings, Strict

Scalar = bool | int | float | str
# The results of a run go to a folder of the scene's name, so it is one on every system and leads nowhere else.
SceneName = Annotated[str, StringConstraints(pattern=r"^(\w[\w +.-]*)?$", max_length=80)]
ComponentName = Annotated[str, StringConstraints(pattern=r"^[a-z][a-z0-9_]*$", max_length=80)]
PortPath = Annotated[
    str, StringConstraints(pattern=r"^[a-z][a-z0-9_]*(\[\d+\])?(\.\w+(\[\d+\])?)+$", max_length=200)
]


def _nothing_is_empty(value: object) -> object:
    """`friction:` with nothing behind it is an empty block, as every user means it."""
    return {} if value is None else value


Block = Annotated[dict[str, Any], BeforeValidator(_nothing_is_empty)]


class ComponentBlock(BaseModel):
    """A component: its type, and its parameters by name."""

    model_config = ConfigDict(extra="allow", frozen=True, strict=True, json_schema_extra=say)

    type: str
    """Name of the component class, as in `type: Spring`; `fairlead describe types` lists all."""


class Part(Strict):
    """What an included file may hold."""

    called = "an included file"
    version: Literal[1] = Field(alias="schema")
    """Version of the netlist format: 1."""
    name: SceneName = ""
    """Name of the scene, letters, digits and " _+-." in it; the file's name when left out."""
    description: str = ""
    """What the scene shows, and where it comes from."""
    include: list[str] = []
    """Netlists whose parameters, components and connections are added, in this folder or below."""
    parameters: Annotated[dict[str, Scalar], BeforeValidator(_nothing_is_empty)] = {}
    """Numbers, quantities and texts that values may use in braces, as in "{2*mu} N"."""
    components: Annotated[dict[ComponentName, ComponentBlock], BeforeValidator(_nothing_is_empty)] = {}
    """The components by name (lower_snake)."""
    connections: list[Annotated[list[PortPath], Field(min_length=2)]] = []
    """Sets of two or more ports that are joined, such as [spring.b, mass.flange]."""


class Document(Part):
    """A fairlead netlist."""

    called = "a netlist"
    effects: Block = {}
    """Effects switched on or off for the whole scene."""
    friction: Block = {}
    """Defaults for every friction contact of the scene."""
    initial: Block = {}
    """Initial values by signal."""
    nominal: Block = {}
    """Sizes that count as 1, by signal; the accuracy is relative to them."""
    run: RunSettings
    """How far and how exactly to run, such as run: {stop: 20 s}."""
    record: Annotated[RecordSettings, BeforeValidator(_nothing_is_empty)] = RecordSettings()
    """What to write down."""
    interface: Annotated[Interface, BeforeValidator(_nothing_is_empty)] = Interface()
    """What a program that steps the model from outside sets and reads."""
    limits: Block = {}
    """Bounds on signals; a run that breaks one ends with exit code 5."""
