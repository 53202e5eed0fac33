"""The record of all that a component class declares."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from fairlead.component.declare import (
    Carries,
    Derived,
    Discrete,
    Guard,
    Input,
    Output,
    Port,
    Sampled,
    Shared,
    State,
    Unknown,
    Zones,
)  # fmt: skip
from fairlead.component.given import Effect


@dataclass(frozen=True)
class Declaration:
    """All that a class declares, by name and in order."""

    ports: dict[str, Port] = field(default_factory=dict)
    parameters: dict[str, Any] = field(default_factory=dict)
    inputs: dict[str, Input] = field(default_factory=dict)
    outputs: dict[str, Output] = field(default_factory=dict)
    states: dict[str, State] = field(default_factory=dict)
    unknowns: dict[str, Unknown] = field(default_factory=dict)
    discrete: dict[str, Discrete] = field(default_factory=dict)
    samples: dict[str, Sampled] = field(default_factory=dict)
    derived: dict[str, Derived] = field(default_factory=dict)
    shared: dict[str, Shared] = field(default_factory=dict)
    effects: dict[str, Effect] = field(default_factory=dict)
    zones: Zones = field(default_factory=lambda: Zones("always"))
    laws: dict[str, Callable[..., Any]] = field(default_factory=dict)  # by zone
    guards: dict[str, Guard] = field(default_factory=dict)
    carries: Carries | None = None
    python: bool = False  # its discrete variables are set by plain Python, see controller.py

    @property
    def periods(self) -> list[str]:
        """Parameters that give a sample period [s]."""
        return ["period"] if self.python else [sample.period for sample in self.samples.values()]

    @property
    def arguments(self) -> set[str]:
        """Names a law may ask for."""
        return {*self.given, *self.shared}

    @property
    def given(self) -> set[str]:
        """Names a shared expression may ask for."""
        return {"p", "t", "zone", "direction", *self.ports, *self.inputs, *self.states, *self.unknowns, *self.discrete}
