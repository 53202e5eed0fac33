"""What a signal comes to in steady running: traced back from an input to a source, a sensor or a controller.

Classes say of themselves what cannot be seen from their law:

    passes = "target"                       the output is, steadily, that input (shapers, interlocks, lags)
    at_most = "most"                        and on the way its rate is at most that parameter
    follows = ("reference", "measured")     the second input becomes the first (controllers with an integral)
    keeps = "wanted"                        it keeps the tension of the line at that parameter [N]
    transmits = True                        its two ends move alike, and pass on what they carry (springs, teeth)

Everything else is asked by calling its law with numbers: what is a straight line of one input, or of the speed of one
port, is taken as that.
"""

from __future__ import annotations

import inspect
import itertools
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import SimpleNamespace

from fairlead.analysis.statics.schedule import followed
from fairlead.component.assembly import Instance, PortRef
from fairlead.component.class_checks import DeclarationError
from fairlead.component.given import Waveform
from fairlead.component.terms import terms_of
from fairlead.component.values import Wave, input_given, steady
from fairlead.flatten.flat_model import FlatModel

MOST_LINKS = 100  # of a chain of signals; a longer one goes in a circle
AGREES = 1e-9


@dataclass(frozen=True)
class Traced:
    """A signal that is  factor * (a wave, or the rate of a port) + offset;  or one that keeps a tension [N]."""

    by: str
    wave: Wave | None = None
    senses: PortRef | None = None
    kept: float | None = None
    factor: float = 1.0
    offset: float = 0.0

    def told(self) -> Wave | None:
        """The signal in time, if it does not depend on what moves."""
        return self.wave.scaled(self.factor, self.offset) if self.wave is not None else None


def trace(flat: FlatModel, target: PortRef, links: int = 0) -> Traced | None:
    """Where the input `target` comes from; None when that cannot be told."""
    source = flat.sources.get(target)
    instance = flat.assembly.instances.get(source.instance if source is not None else target.instance)
    if instance is None or links > MOST_LINKS:
        return None
    if source is None:
        own = input_given(instance.values, instance.type.declaration.inputs[target.port].default)
        number = flat.assembly.open_inputs.get(target, own)
        return None if number is None else Traced(str(target), wave=steady(number))
    says = instance.type.answers
    if says.keeps:
        return Traced(instance.path, kept=float(getattr(instance.values, says.keeps)))
    if says.passes:
        return _passed(flat, instance, trace(flat, PortRef(instance.path, says.passes), links + 1))
    return _given(instance, source.port) or _sensed(instance, source.port) or _amplified(flat, instance, source, links)


def _passed(flat: FlatModel, instance: Instance, before: Traced | None) -> Traced | None:
    """What comes out of a component that passes on its input, with limited rate if it says so."""
    told = before.told() if before is not None else None
    if before is None or told is None or not instance.type.answers.at_most:
        return before
    run = flat.assembly.netlist.run
    most = float(getattr(instance.values, instance.type.answers.at_most))
    return Traced(before.by, wave=followed(told, most, run.start, run.stop))


def _given(instance: Instance, output: str) -> Traced | None:
    """A source: its one waveform, told at its output."""
    has = instance.type.declaration
    waves = [name for name, one in has.parameters.items() if isinstance(one, Waveform)]
    if has.inputs or has.ports or len(waves) != 1:
        return None
    wave: Wave | None = getattr(instance.values, waves[0])
    said = answer(instance, output)
    if wave is None or said is None or abs(said - wave(0.0)) > AGREES:
        return None
    return Traced(instance.path, wave=wave)


def _sensed(instance: Instance, output: str) -> Traced | None:
    """A body or a sensor that tells its speed."""
    ports = [name for name, port in instance.type.declaration.ports.items() if port.domain.mechanical]
    said = [answer(instance, output, rate=rate) for rate in (0.0, 1.0, 2.0)]
    factor = _straight(said)
    if len(ports) != 1 or factor is None or abs(said[0] or 0.0) > AGREES:
        return None
    return Traced(instance.path, senses=PortRef(instance.path, ports[0]), factor=factor)


def _amplified(flat: FlatModel, instance: Instance, source: PortRef, links: int) -> Traced | None:
    """A straight line of one input."""
    for name in instance.type.declaration.inputs:
        said = [answer(instance, source.port, inputs={name: value}) for value in (0.0, 1.0, 2.0)]
        factor = _straight(said)
        if factor is None:
            continue
        before = trace(flat, PortRef(instance.path, name), links + 1)
        if before is None or before.kept is not None:
            return before
        offset = factor * before.offset + float(said[0] or 0.0)
        return replace(before, factor=factor * before.factor, offset=offset)
    return None


def _straight(said: list[float | None]) -> float | None:
    """The slope of three values at 0, 1, 2 that lie on a line that is not level."""
    if any(value is None for value in said):
        return None
    first, second = (float(b) - float(a) for a, b in itertools.pairwise(said))  # type: ignore[arg-type]
    return first if abs(first) > 0 and abs(second - first) <= AGREES * abs(first) else None


def answer(
    instance: Instance, term: str, t: float = 0.0, rate: float = 0.0, inputs: Mapping[str, float] | None = None
) -> float | None:
    """What the law of a component without memory says of a term, for one speed of all its ports; None if it cannot."""
    has = instance.type.declaration
    if list(has.laws) != ["always"] or has.states or has.unknowns or has.discrete or has.shared:
        return None
    law, given = has.laws["always"], {"p": instance.values, "t": t, **dict.fromkeys(has.inputs, 0.0), **(inputs or {})}
    still = {"x": 0.0, "angle": 0.0, "a": 0.0, "acceleration": 0.0, "force": 0.0, "torque": 0.0}
    given |= {name: SimpleNamespace(v=rate, speed=rate, **still) for name in has.ports}
    asked = inspect.signature(law).parameters
    try:
        value = terms_of(instance.type, law(**{name: given[name] for name in asked})).get(term)
        return None if value is None else float(value)
    except (TypeError, ValueError, AttributeError, ArithmeticError, KeyError, DeclarationError):
        return None  # a law of something else than numbers, such as a table that is asked for its slope
