"""Friction that is odd: with every motion and push reversed, every force is.

What does not turn round with the motion is not reversed: a temperature, a pressure that presses plates together, a
state such as the normal force that a contact remembers. No declaration tells which these are. So a law is odd if there
is one choice of them for which it is.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

from fairlead.component.base import Declared
from fairlead.component.keys import INPUT, OWN, PORT, key
from fairlead.testing.world import CircleError, ContractError, Instant, World

ROUNDING = 1e-9
MOST = 4  # quantities of which each is tried both ways; of more all are tried together
WAY_OUT = '. If it is meant to have a preferred direction, say so: exempt = {"odd": "why"}'


def must_be_odd(instants: Callable[[], Iterable[tuple[World, Instant]]], kind: type[Declared]) -> None:
    """Raise the ContractError of the usual choice, all reversed, if no other choice keeps the law odd."""
    if "slip" not in kind.declaration.outputs:
        return
    met = list(instants())
    broken = [next(_faults(met, turned), None) for turned in itertools.islice(_choices(kind), 1)]
    if broken[0] and all(next(_faults(met, turned), None) for turned in itertools.islice(_choices(kind), 1, None)):
        raise broken[0]


def _choices(kind: type[Declared]) -> Iterator[dict[str, bool]]:
    """What is reversed, by key, of what may turn round with the motion or not; first the usual choice."""
    has = kind.declaration
    usual = {f"own:{name}": True for name in has.states}
    usual |= {f"port:{name}:x": True for name, port in has.ports.items() if not port.domain.mechanical}
    usual |= {f"in:{name}": False for name, given in has.inputs.items() if given.signed}
    yield usual
    if len(usual) <= MOST:
        chosen = itertools.product(*((one, not one) for one in usual.values()))
        yield from (dict(zip(usual, each, strict=True)) for each in itertools.islice(chosen, 1, None))
    else:
        yield from (dict.fromkeys(usual, one) for one in (True, False))


def _faults(met: Iterable[tuple[World, Instant]], turned: Mapping[str, bool]) -> Iterator[ContractError]:
    for world, at in met:
        zones, start = world.kind.declaration.zones, world.zone(at)
        paired = bool(zones.forward) or len(zones) == 1
        one = _end(world, at, start)
        back = _mirrored(at, turned)
        others = [_end(world, back, zone) for zone in ((zones.mirrored(start),) if paired else zones)]
        found = [_fault(world, at, one, other, turned, paired) for other in others if one and other]
        if found and all(found):
            yield found[0]  # type: ignore[misc]


def _end(world: World, at: Instant, zone: str) -> Instant | None:
    """Where the guards lead from a zone; None if they run in a circle, which is for `settles` to tell."""
    try:
        return world.settle(at, zone)
    except CircleError:
        return None


def _mirrored(at: Instant, turned: Mapping[str, bool]) -> Instant:
    values = {
        one: -value if turned.get(one, key(one).kind in (PORT, OWN)) else value for one, value in at.values.items()
    }
    return replace(at, values=values, loads={name: -load for name, load in at.loads.items()})


def _close(have: float, want: float) -> bool:
    return abs(have - want) <= ROUNDING * max(1.0, abs(have), abs(want))


def _fault(
    world: World, at: Instant, one: Instant, other: Instant, turned: Mapping[str, bool], paired: bool
) -> ContractError | None:
    zones = world.kind.declaration.zones
    # With no motion at all either direction may claim the instant, as on landing; the forces must agree even so.
    moves = any(value != 0 for each, value in at.values.items() if key(each).is_speed)
    if paired and moves and zones.mirrored(world.zone(one)) != world.zone(other):
        return ContractError(
            f"{world.where(one)}: with every motion and force reversed it is in zone {world.zone(other)}{WAY_OUT}"
        )
    flows, back = world.flows(one), world.flows(other)
    for name in world.kind.declaration.ports:
        if not world.kind.declaration.ports[name].domain.mechanical:
            continue
        there, again = flows.get(f"port:{name}", 0.0).real, back.get(f"port:{name}", 0.0).real
        if not _close(there, -again):
            return ContractError(
                f"{world.where(one)}: {name} takes in {there:.6g}, and {again:.6g} with every motion reversed; "
                f"friction is odd in slip{WAY_OUT}"
            )
    usual = all(turns != (key(each).kind == INPUT) for each, turns in turned.items())
    for name in () if usual else world.kind.declaration.states:  # or what is not reversed could excuse any force
        sign = -1 if turned[f"own:{name}"] else 1
        there, again = flows[f"own:{name}"].real, back[f"own:{name}"].real
        if not _close(there, sign * again):
            return ContractError(
                f"{world.where(one)}: the rate of {name} is {there:.6g}, and {again:.6g} with every motion reversed"
                f"{WAY_OUT}"
            )
    return None
