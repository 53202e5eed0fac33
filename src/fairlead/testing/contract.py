"""The list of properties, and how they are asked of a class or a whole family."""

from __future__ import annotations

import functools
import zlib
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fairlead.component.base import Composite, Declared
from fairlead.component.registry import bundled
from fairlead.component.trace import TraceError
from fairlead.errors import ModelError
from fairlead.testing.properties import PROPERTIES
from fairlead.testing.samples import families, sample
from fairlead.testing.world import ContractError, World


@dataclass(frozen=True)
class Check:
    """One property of one kind of law; calling it raises ContractError when the property is broken."""

    name: str
    kind: type[Declared]
    chosen: dict[str, Any] = field(default_factory=dict)

    def __call__(self) -> None:
        """Ask random instances, with and without what may be left out; always the same ones."""
        exempt = self.kind.answers.exempt
        unknown = {key for key in exempt if key.split(" ")[0] not in PROPERTIES}
        if unknown:
            raise ContractError(
                f"{self.kind.__name__}: exempt names {sorted(unknown)}; properties are {', '.join(PROPERTIES)}"
            )
        if self.name in exempt or any(f"{self.name} {word}" in exempt for word in self.chosen.values()):
            return
        rng = np.random.default_rng(zlib.crc32(str(self).encode()))
        for optional in (True, False):
            try:
                PROPERTIES[self.name](functools.partial(_world, self, rng, optional), rng)
            except TraceError as error:
                raise ContractError(f"{self.kind.__name__}: its law cannot be traced: {error}") from error
            except ModelError as error:  # of a method that fails, or gives what it should not
                raise ContractError(str(error)) from error

    def __str__(self) -> str:
        effects = self.kind.declaration.effects
        words = ", ".join(f"{name} {word}" if name in effects else str(word) for name, word in self.chosen.items())
        return f"{self.kind.__name__}[{words}] {self.name}" if words else f"{self.kind.__name__} {self.name}"


def checks(kind: type[Declared], **given: Any) -> list[Check]:
    """All properties of a class, or of every member of a family with every part, as tests to be called.

    `given` fixes parameters (SI) that random numbers do not suit. A composite has no law of its own.
    """
    if issubclass(kind, Composite):
        return []
    bundled()  # or a law would be asked with no curve at all
    kinds = [(member, {**words, **given}) for member, words in families(kind)]
    return [Check(name, member, chosen) for member, chosen in kinds for name in PROPERTIES]


def contract(kind: type[Declared], **given: Any) -> None:
    """Ask every property of a class. Raises ContractError with all that are broken, one sentence each."""
    broken = []
    for check in checks(kind, **given):
        try:
            check()
        except ContractError as error:
            broken.append(f"{check.name}: {error}")
    if broken:
        raise ContractError("\n".join(broken))


def _world(check: Check, rng: np.random.Generator, optional: bool) -> World:
    values = sample(check.kind, rng, check.chosen, optional)
    ports = check.kind.declaration.ports
    return World(
        values,
        {name: float(10 ** rng.uniform(-1, 1)) for name, port in ports.items() if port.domain.mechanical},
    )


Property = Callable[[Callable[[], World], np.random.Generator], None]
