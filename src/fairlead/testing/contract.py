"""The list of properties, and how they are asked of a class or a whole family."""

from __future__ import annotations

import functools
import warnings
import zlib
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any, cast

import numpy as np

from fairlead.component.base import Composite, Declared, Family
from fairlead.component.bundled import bundled
from fairlead.component.composition import expanded
from fairlead.component.given import Part
from fairlead.component.members import _libraries, show
from fairlead.component.registry import known_types
from fairlead.component.replies import BUNDLED
from fairlead.component.scene import Scene, is_head
from fairlead.component.trace import TraceError
from fairlead.errors import ModelError, UsageError, shown
from fairlead.testing.properties import PROPERTIES
from fairlead.testing.rig import traced_zones
from fairlead.testing.samples import PartAsked, SampleError, families, sample
from fairlead.testing.settled import Maker, Settled
from fairlead.testing.world import ContractError, ContractRemark, World


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
        for part in self.chosen.values():
            if isinstance(part, PartAsked):
                _bring_into_view(part.kind)
        rng = np.random.default_rng(zlib.crc32(str(self).encode()))
        for optional in (True, False):
            try:
                form = _Form(self.kind, optional, repr(self.chosen), self.chosen)
                PROPERTIES[self.name](Maker(form.world, rng, _settled(form)), rng)
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


def checks(kind: type[Declared], /, **given: Any) -> list[Check]:
    """All properties of a class, or of every member of a family with every part, as tests to be called.

    `given` fixes parameters (SI) that random numbers do not suit. A composite has no law of its own. A part, such as a
    friction curve, has none either: it is asked in the components that take it, as treated when nobody says.
    """
    if issubclass(kind, Composite):
        return []
    bundled()  # or a law would be asked with no curve at all
    if _is_part(kind):
        return [Check(name, host, chosen) for host, chosen in _hosts(kind, given) for name in PROPERTIES]
    kinds = [(member, {**words, **given}) for member, words in families(kind)]
    return [Check(name, member, chosen) for member, chosen in kinds for name in PROPERTIES]


def contract(kind: type[Declared], /, **given: Any) -> None:
    """Ask every property of a class. Raises ContractError with all that are broken, one sentence each.

    Warns (ContractRemark) of an output that the law of a zone leaves out: it is 0 there.
    """
    if not isinstance(kind, type):
        what = f"contract: kind = {shown(kind)} is no class"
        raise UsageError(f"{what}. Import the class, and give it itself: contract(Spring).")
    broken = [*_unmade(kind, given)] if issubclass(kind, Composite) else []
    asked = checks(kind, **given)
    if not asked and not broken and _is_part(kind):
        raise ContractError(f"{kind.__name__} is no component, and no component with a law takes it: nothing is asked")
    for check in asked:
        try:
            check()
        except ContractError as error:
            if not any(one.endswith(f": {error}") for one in broken):  # one that all properties meet is told once
                broken.append(f"{check.name}: {error}")
    if broken:
        raise ContractError("\n".join(broken))
    forms = {check.kind: check.chosen for check in reversed(asked)}
    for member, chosen in forms.items():
        for remark in _left_out(member, chosen):
            warnings.warn(remark, ContractRemark, stacklevel=2)


def _left_out(kind: type[Declared], chosen: dict[str, Any]) -> Iterator[str]:
    """Outputs that the author's law of some zone does not give, and that of another does."""
    world = _Form(kind, True, repr(chosen), chosen).world(np.random.default_rng(zlib.crc32(kind.__name__.encode())))
    zones = traced_zones(world.rig.variant)
    for name in kind.declaration.outputs:
        lacks = [zone for zone, traced in zones.items() if name not in traced.outputs and not _of_library(kind, zone)]
        if 0 < len(lacks) < len(zones):
            what = f"the law of zone {', '.join(lacks)} does not give the output {name}, which is 0 there"
            yield f"{kind.__name__}: {what}. If that is meant, write {name}=0"


def _of_library(kind: type[Declared], zone: str) -> bool:
    return kind.declaration.laws[zone].__module__.startswith(BUNDLED)


def _is_part(kind: type[Declared]) -> bool:
    """Whether it is a member of a family that stands in components, and no component itself."""
    return issubclass(kind, Family) and not is_head(kind) and not kind.declaration.ports


def _bring_into_view(part: type[Family]) -> None:
    """Have the components that take a part of a library know it."""
    if part.members.get(part.word) is not part:
        for number, members in enumerate(_libraries):
            if part in members:
                show(number)


def _hosts(kind: type[Declared], given: dict[str, Any]) -> Iterator[tuple[type[Declared], dict[str, Any]]]:
    """Components that take a part, each with it; of a family of them the usual member."""
    part = PartAsked(cast(type[Family], kind), given)
    for head in known_types().values():
        host = head.members.get(head.default_word) if is_head(head) else head
        if host is None or issubclass(host, Composite):
            continue
        for name, declared in host.declaration.parameters.items():
            if isinstance(declared, Part) and issubclass(kind, declared.family):
                yield host, {name: part}


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


@dataclass(frozen=True)
class _Form:
    """A kind of law with parameters that are chosen, with or without what may be left out."""

    kind: type[Declared]
    optional: bool
    words: str
    chosen: dict[str, Any] = field(compare=False)

    def world(self, rng: np.random.Generator) -> World:
        """A random instance, and bodies at its mechanical ports."""
        values = sample(self.kind, rng, self.chosen, self.optional)
        ports = self.kind.declaration.ports
        return World(
            values,
            {name: float(10 ** rng.uniform(-1, 1)) for name, port in ports.items() if port.domain.mechanical},
        )


@functools.lru_cache(maxsize=4)  # properties of one form are asked one after the other, each with and without options
def _settled(form: _Form) -> Settled:
    return Settled(form.world, (zlib.crc32(f"{form.kind.__name__} {form.words}".encode()), int(form.optional)))
