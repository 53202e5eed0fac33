"""The list of properties, and how they are asked of a class or a whole family."""

from __future__ import annotations

import functools
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fairlead.component.base import Composite, Declared
from fairlead.component.bundled import bundled
from fairlead.component.composition import expanded
from fairlead.component.scene import Scene
from fairlead.component.trace import TraceError
from fairlead.errors import ModelError
from fairlead.testing.properties import PROPERTIES
from fairlead.testing.samples import SampleError, families, sample
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
            except (ContractError, SampleError):
                raise
            except TraceError as error:
                raise ContractError(f"{self.kind.__name__}: its law cannot be traced: {error}") from error
            except ModelError as error:  # of a method that fails, or gives what it should not
                raise ContractError(str(error)) from error
            except (KeyError, AttributeError, TypeError, ValueError, ArithmeticError) as error:
                raise ContractError(_odd(self, error)) from error

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
    broken = [*_unmade(kind, given)] if issubclass(kind, Composite) else []
    for check in checks(kind, **given):
        try:
            check()
        except ContractError as error:
            if not any(one.endswith(f": {error}") for one in broken):  # one that all properties meet is told once
                broken.append(f"{check.name}: {error}")
    if broken:
        raise ContractError("\n".join(broken))


def _odd(check: Check, error: Exception) -> str:
    """What a property could not be asked for."""
    from fairlead.component.author import author_of

    place, name = author_of(error, check.kind)
    said = f"{type(error).__name__}: {error}"
    return f"{check.kind.__name__}: {name} fails at {place} with random numbers within the declared ranges: {said}"


def _unmade(kind: type[Declared], given: dict[str, Any]) -> Iterator[str]:
    """Why a composite with random parameters cannot be made, if it cannot."""
    rng = np.random.default_rng(zlib.crc32(kind.__name__.encode()))
    for optional in (True, False):
        try:
            expanded(sample(kind, rng, given, optional), Scene())
        except (ModelError, SampleError) as error:
            yield f"expand: {error}"
            return


def _world(check: Check, rng: np.random.Generator, optional: bool) -> World:
    values = sample(check.kind, rng, check.chosen, optional)
    ports = check.kind.declaration.ports
    return World(
        values,
        {name: float(10 ** rng.uniform(-1, 1)) for name, port in ports.items() if port.domain.mechanical},
    )


Property = Callable[[Callable[[], World], np.random.Generator], None]
