"""The netlist as data: frozen, and every value still knows the place it came from."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from fairlead.brief import in_a_line
from fairlead.errors import Location
from fairlead.netlist.interface import Interface
from fairlead.netlist.settings import RecordSettings, RunSettings


@dataclass(frozen=True)
class Value:
    """A value of a netlist with its place, and the place of the key it stands under (None in a list)."""

    content: str | int | float | bool | dict[str, Value] | list[Value] | None
    where: Location
    key_where: Location | None = None
    written: str = field(default="", compare=False)
    """The expression that the content was worked out from, if it was: `{element}`."""

    def __repr__(self) -> str:
        return in_a_line(self)

    @property
    def named_at(self) -> Location:
        """Where the key stands, for messages about a name rather than a value."""
        return self.key_where or self.where

    @property
    def entries(self) -> dict[str, Value]:
        """The entries of a map; empty when this is not a map."""
        return self.content if isinstance(self.content, dict) else {}

    @property
    def is_worked_out(self) -> bool:
        """Whether it comes from an expression, or anything in it does."""
        inner = self.content if isinstance(self.content, list) else self.entries.values()
        return bool(self.written) or any(value.is_worked_out for value in inner)

    def plain(self) -> Any:
        """The value as Python's own text, number, bool, None, dict or list, without places."""
        if isinstance(self.content, dict):
            return {name: value.plain() for name, value in self.content.items()}
        if isinstance(self.content, list):
            return [value.plain() for value in self.content]
        return self.content


@dataclass(frozen=True)
class Entry:
    """A component of the netlist: its name, its type and its parameters as written, units and all."""

    name: str
    type: str
    parameters: dict[str, Value]
    where: Location
    type_where: Location

    def __repr__(self) -> str:
        return in_a_line(self)


@dataclass(frozen=True)
class EndPoint:
    """One end of a connection, such as `spring.b` or `route.bend3.path`."""

    text: str
    where: Location

    @property
    def component(self) -> str:
        """The name of the component of the netlist the end belongs to."""
        return self.text.partition(".")[0]

    @property
    def port(self) -> str:
        """What follows the component's name: a port, or a path to a port of a child."""
        return self.text.partition(".")[2]


@dataclass(frozen=True)
class Netlist:
    """A netlist with its includes merged, its overrides applied and its expressions worked out.

    `connections` holds sets of two or more ports joined in one node. Component parameters, `effects`,
    `friction`, `initial`, `nominal` and `limits` stay as written: the next stage knows their units. `digest` is a hash
    over the bytes of every file read and the overrides.
    """

    path: Path
    name: str
    description: str
    parameters: dict[str, Value]
    components: dict[str, Entry]
    connections: tuple[tuple[EndPoint, ...], ...]
    run: RunSettings
    record: RecordSettings
    effects: Mapping[str, Value] = field(default_factory=dict)
    friction: Mapping[str, Value] = field(default_factory=dict)
    initial: Mapping[str, Value] = field(default_factory=dict)
    nominal: Mapping[str, Value] = field(default_factory=dict)
    limits: Mapping[str, Value] = field(default_factory=dict)
    interface: Interface = field(default_factory=Interface)
    digest: str = ""
    unread: tuple[str, ...] = ()
    """Names of components without a type, of which nothing more can be said."""
    written: Mapping[str, Mapping[str, Value]] = field(default_factory=lambda: {"run": {}, "record": {}})
    """The blocks `run` and `record` as written, for messages about them."""
    texts: Mapping[str, str] = field(default_factory=dict, repr=False)
    """The files as they were read, by the name that messages call them; the netlist itself first."""
    given: Mapping[str, str] = field(default_factory=dict)
    """Values given from outside, by name (`--set`)."""
    foreign_code: bool = False
    """Whether code of FMUs may run (`--allow-fmu`): said by who loads it, never in the file."""

    def __str__(self) -> str:
        return "\n".join(self._lines())

    def _lines(self) -> Iterator[str]:
        yield f"{self.name}: {self.description}" if self.description else self.name
        for name, value in self.parameters.items():
            yield f"  parameter {name} = {value.plain()}"
        for entry in self.components.values():
            settings = ", ".join(f"{name} = {value.plain()}" for name, value in entry.parameters.items())
            yield f"  {entry.name}: {entry.type}({settings})    {entry.where}"
        for ends in self.connections:
            yield f"  {' -- '.join(end.text for end in ends)}    {ends[0].where}"
