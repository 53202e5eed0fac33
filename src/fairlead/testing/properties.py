"""The properties of a component, each a function that raises ContractError with a sentence.

They are asked of random instances (`make()` makes one) at random instants. A class that rightly breaks
one says so, with the reason, for all of it or for one zone or option:

    exempt = {"dissipates": "the bristle gives back ... (author, year)", "dissipates latched": "..."}
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from types import SimpleNamespace
from typing import Any

import numpy as np

from fairlead.component.given import Table, Waveform
from fairlead.component.holding import Hold, HoldPosition
from fairlead.component.keys import PORT, key
from fairlead.component.terms import terms_of
from fairlead.component.values import parameter
from fairlead.kernels import layout
from fairlead.testing.borders import at_borders, follow, is_at_border, must_let_go, under_loads
from fairlead.testing.oddness import must_be_odd
from fairlead.testing.power import at_tied_motion, heat_falls, massive, power_in, power_met, power_of, rates_of
from fairlead.testing.reach import (
    all_reached,
    begins,
    idle_guards,
    left_by_samples,
    not_met,
    other_parameters,
    reached,
    unled,
)
from fairlead.testing.rig import Rig, traced_zones
from fairlead.testing.settled import Maker, in_pieces
from fairlead.testing.world import STEP, CircleError, ContractError, Instant, World

INSTANCES, INSTANTS = 4, 12  # per variant; each instant is taken through all zones
BORDERS = 2  # instances of which in each zone, from one instant, speeds are brought to the borders of the zone
ROUNDING = 1e-9  # relative to the largest number met; laws lose a few digits by cancellation, no more
KEPT = (
    ("d_signals", layout.PARTIALS_SIGNALS, layout.SIGNALS),
    ("d_flows", layout.PARTIALS_FLOWS, layout.FLOWS),
)


def derivatives(make: Maker, rng: np.random.Generator) -> None:
    """Every derivative of the machine code equals the complex step of the traced law, zone by zone."""
    for world, at in _anywhere(make, rng):
        s = world.structure
        inputs = np.array([at.values[key] for key in s.inputs])
        for name, partials, values in KEPT:
            said = world.rig.ask(partials, inputs, at.zones, machine=True)[0]
            stepped = _complex_steps(world, at, values)
            pairs = {tuple(pair): value for pair, value in zip(getattr(s, name), said, strict=True)}
            for (k, j), want in np.ndenumerate(stepped):
                if name == "d_signals" and s.outputs[k] in s.unfit:
                    continue
                have = pairs.get((k, j), 0.0)
                if not _close(have, want):
                    what = (s.outputs if name == "d_signals" else s.targets)[k]
                    raise ContractError(
                        f"{world.where(at)}: the derivative of {what} to {s.inputs[j]} is {have:.9g} in "
                        f"machine code and {want:.9g} by complex step"
                    )


def machine_code(make: Maker, rng: np.random.Generator) -> None:
    """The machine code says what the Python text of the kernel says, in every mode and zone."""
    modes = ("SIGNALS", "FLOWS", "LEDGER", "MASS", "SLIP", "GAP", "GUARD", "OUTPUT")
    for world, at in _anywhere(make, rng):
        inputs = [at.values[key] for key in world.structure.inputs]
        for mode in modes:
            number = getattr(layout, mode)
            have = world.rig.ask(number, inputs, at.zones, machine=True)[0]
            want = world.rig.ask(number, inputs, at.zones)[0].real
            if not np.allclose(
                have,
                want,
                rtol=ROUNDING,
                atol=ROUNDING * max(1.0, np.abs(want).max(initial=0)),
                equal_nan=True,
            ):
                raise ContractError(
                    f"{world.where(at)}: machine code and Python text differ in {mode.lower()}: {have} and {want}"
                )


def as_written(make: Maker, rng: np.random.Generator) -> None:
    """The kernel says what the author's own Python says with plain numbers."""
    for world, at in _settled(make):
        has = world.kind.declaration
        tables = any(isinstance(d, Table | Waveform) for d in has.parameters.values())
        if tables or any(d.wave for d in has.derived.values()):
            return  # a table of plain numbers looks its interval up, a traced one has it frozen
        law = has.laws[world.zone(at)]
        said = terms_of(world.kind, law(**{name: _argument(world, at, name) for name in _names(law)}))
        flows, outputs = (
            world.flows(at),
            dict(zip(world.structure.outputs, world.ask(layout.OUTPUT, at), strict=False)),
        )
        scale = max((abs(flow) for flow in flows.values()), default=0.0)  # what is zero is a difference of such
        added = _of_relations(world, at)
        for name, value in said.items():
            have = flows.get(f"port:{name}", flows.get(f"own:{name}", outputs.get(name)))
            if isinstance(value, Hold | HoldPosition) or have is None:
                continue  # `hold` has no number; see `derivatives`
            have, rough = have.real - added.get(name, 0.0), name in has.unknowns or name in added
            if not _close(have, float(value), scale if rough else 0.0):
                said_here = f"the kernel gives {name} = {have:.9g}, the law {float(value):.9g}"
                raise ContractError(f"{world.where(at)}: {said_here}")


def _of_relations(world: World, at: Instant) -> dict[str, float]:
    """What relations of positions put on ports beside what the law gives: minus their force times the ratio there."""
    added: dict[str, float] = {}
    for unknown in world.structure.positions:
        for port, ratio in world.held(at)[unknown].items():
            added[port] = added.get(port, 0.0) - float(np.real(at.values[f"own:{unknown}"])) * ratio
    return added


def balance(make: Maker, rng: np.random.Generator) -> None:
    """What the two ports of a massless two-port take in sums to zero, unless it holds speeds at a ratio, as a gear."""
    for world, at in _settled(make):
        ports = world.kind.declaration.ports
        if len(ports) != 2 or len({p.domain for p in ports.values()}) != 1 or massive(world) or world.prescribed:
            return
        if world.structure.positions:  # its ratio is no number, and its power is zero: see `energy`
            return
        if _at_a_ratio(world, at):  # its housing takes the rest, and its power is zero: see `energy`
            continue
        flows = {name: world.flows(at).get(f"port:{name}") for name in ports}
        (a, one), (b, two) = flows.items()
        if one is not None and two is not None and not _close(one.real, -two.real):
            unit = next(iter(ports.values())).domain.through[1]
            raise ContractError(
                f"{world.where(at)}: what the two ports of a massless component take in must sum to zero; "
                f"{a} takes in {one.real:.6g} {unit} and {b} {two.real:.6g} {unit}"
            )


def _at_a_ratio(world: World, at: Instant) -> bool:
    """Whether it holds a slip that changes when both ports move alike: that of a gear, not of a clutch."""
    ports = world.kind.declaration.ports
    for slip in world.held(at).values():
        speeds = [float(np.real(slip.get(name, 0.0))) for name in ports]
        if abs(sum(speeds)) > ROUNDING * max(map(abs, speeds)):
            return True
    return False


def dissipates(make: Maker, rng: np.random.Generator) -> None:
    """Dissipated power is never negative, in the zones that the guards allow, and heat does not only flow uphill."""
    uphill: dict[str, list[tuple[float, World, Instant]]] = {}
    for world, at in _settled(make):
        uphill.setdefault(world.zone(at), []).extend((fall, world, at) for fall in heat_falls(world, at))
        if f"dissipates {world.zone(at)}" in world.kind.answers.exempt:
            continue
        power = world.ask(layout.OUTPUT, at)[-2].real
        if power < -ROUNDING * max(1.0, power_met(world, at)):
            raise ContractError(
                f"{world.where(at)}: dissipated is {power:.6g} W; a component cannot dissipate less than nothing"
            )
    for met in uphill.values():  # one that pumps heat, at a rate of its own, meets instants of either kind
        if len(met) >= INSTANTS and all(fall < 0 for fall, _, _ in met):
            _, world, at = met[0]
            raise ContractError(f"{world.where(at)}: heat flows from cold to hot, at this instant and all others")


def energy(make: Maker, rng: np.random.Generator) -> None:
    """Power in = rate of stored energy + dissipated - supplied."""
    for world, at in _settled(make):
        if world.kind.answers.ties is not None:
            tied = at_tied_motion(world, at)
            if tied is None:
                continue
            at = tied
        rates = rates_of(world, at, rng)
        if rates is None:  # what it stores follows a force that holds, whose rate is not known here
            continue
        taken = power_in(world, at, rates)
        stored = world.ask(layout.OUTPUT, at.shifted(rates, STEP * 1j))[-3]
        dissipated, supplied = (float(x) for x in world.ask(layout.OUTPUT, at)[-2:].real)
        rate = stored.imag / STEP
        told, scale = rate + dissipated - supplied, max(power_met(world, at), abs(taken), abs(rate))
        if not _close(taken, told, scale):
            raise ContractError(
                f"{world.where(at)}: energy is not accounted for: it takes in {taken:.6g} W, stores {rate:.6g} W, "
                f"dissipates {dissipated:.6g} W and is supplied {supplied:.6g} W{_cause(world, at, rates, told, scale)}"
            )


def _cause(world: World, at: Instant, rates: Mapping[str, float], told: float, scale: float) -> str:
    """What would close the ledger: other signs, or any line of it at all."""
    taken = power_in(world, at, dict(rates))
    if not any(_ledger_lines(world)):
        lines = "stored= [J], dissipated= or supplied= [W]"
        return f". No law has a line of the ledger: add {lines} to Law(...), or methods of these names"
    if _close(taken, -told, scale):
        return ". With the opposite sign it would close: a port takes in what acts on the component there, +pull at b"
    for name in world.kind.declaration.ports:
        without = power_of(world, at, rates, name)
        if without and _close(taken - 2 * without, told, scale):
            return f". With the opposite sign of what {name} takes in it would close"
    return ""


def _ledger_lines(world: World) -> Iterator[bool]:
    """Whether the laws of a class give a line of the ledger, zone by zone."""
    return (any(zone.ledger.values()) for zone in traced_zones(world.rig.variant).values())


def settles(make: Maker, rng: np.random.Generator) -> None:
    """From every zone, at any instant, the guards lead to a zone in which none has risen.

    So they do at an instant at which a speed reaches the border of its zone, as when a slip comes to rest; not of a
    class that says it cannot hold (`can_hold`).
    """
    seen: dict[str, set[int]] = {}
    for world, end in _settled(make, tell=True):
        if not world.zoned or not world.kind.answers.can_hold:
            continue
        if is_at_border(world, end):
            follow(world, end)
        met = seen.setdefault(world.zone(end), set())
        if id(world) not in met and len(met) < BORDERS:
            met.add(id(world))
            for border in under_loads(world, end):
                follow(world, border)


def zones_reached(make: Maker, rng: np.random.Generator) -> None:
    """Guards lead to every zone from the one in which it begins, and some motion stays there."""
    world = make()
    if not world.zoned:
        return
    must_let_go(world)
    named = {name.partition(" ")[2] for name in world.kind.answers.exempt if name.startswith("zones_reached ")}
    wanted, begin, met = set(world.structure.zones) - named, {begins(world), *named}, named | left_by_samples(world)
    led, seen = set[tuple[str, str]](), set[tuple[str, str]]()

    def all_met() -> bool:
        return met >= wanted and reached(begin, led) >= wanted

    def look(world: World, ends: Iterable[Instant]) -> None:
        met.update(world.zone(end) for end in ends)
        led.update(world.led)
        seen.update(world.seen)
        begin.add(begins(world))

    for there, end in _settled(make):
        look(there, [end])
    for _ in range(40):
        if met >= wanted:
            break
        world = make()
        for at in (world.draw(rng) for _ in range(INSTANTS)):
            for zone in world.structure.zones:
                look(world, _ends_beside(world, at, zone))
            if met >= wanted:
                break
    if unmet := wanted - met:
        raise ContractError(f"{world.rig.variant.label}: {not_met(world, unmet, (INSTANCES + 40) * INSTANTS)}")
    if not all_met() and (left := wanted - all_reached(make, rng, begin, led)):
        raise ContractError(f"{world.rig.variant.label}: {unled(world, left, begin)}")
    if idle := idle_guards(make, rng, seen):
        zone, name = idle[0]
        raise ContractError(
            f"{world.rig.variant.label}: guard {name} can never fire in zone {zone}: it is above zero at no instant of "
            f"a wide search. {other_parameters(world)}"
        )


def _ends_beside(world: World, at: Instant, zone: str) -> Iterator[Instant]:
    """Where the guards lead from a zone, and from the borders of speeds there."""
    for end in _end(world, at, zone):
        yield end
        for border in at_borders(world, end):
            try:
                yield follow(world, border)
            except CircleError:
                continue


def outputs_given(make: Maker, rng: np.random.Generator) -> None:
    """Every declared output is given in some zone."""
    world = make()
    zones = traced_zones(world.rig.variant).values()
    for name in world.kind.declaration.outputs:
        if not any(name in zone.outputs for zone in zones):
            raise ContractError(f"{world.rig.variant.label}: output {name} is declared and given by no law")


def units(make: Maker, rng: np.random.Generator) -> None:
    """Terms of a sum are of one unit, and what a law gives is of the unit that is declared."""
    from fairlead.component.dimensions import misfits

    world = make()
    for wrong in misfits(world.rig.variant, traced_zones(world.rig.variant)):
        raise ContractError(f"{world.rig.variant.label} in zone {wrong.zone}: {wrong.what}")


def instances(make: Maker, rng: np.random.Generator) -> None:
    """N instances in one kernel say what n kernels with one instance say."""
    worlds = [make() for _ in range(INSTANCES)]
    variant = worlds[0].rig.variant
    worlds = [world for world in worlds if world.rig.variant == variant]
    s = worlds[0].structure
    instants = [world.enter(world.draw(rng), s.zones[k % len(s.zones)]) for k, world in enumerate(worlds)]
    together = Rig([w.of for w in worlds], [{p: 1 / m for p, m in w.masses.items()} for w in worlds])
    inputs = np.array([[at.values[key] for key in s.inputs] for at in instants])
    zones = np.array([at.zones for at in instants])
    for mode in range(10):
        all_ = together.ask(mode, inputs, zones, machine=True)
        apart = np.concatenate(
            [w.rig.ask(mode, x, z, machine=True) for w, x, z in zip(worlds, inputs, zones, strict=True)]
        )
        apart = apart.sum(axis=0, keepdims=True) if mode == layout.LEDGER else apart
        if not np.allclose(all_, apart, rtol=ROUNDING, atol=1e-300, equal_nan=True):
            raise ContractError(f"{variant.label}: {len(worlds)} instances together say {all_}, apart {apart}")


def odd(make: Maker, rng: np.random.Generator) -> None:
    """A component with a slip takes in the opposite when everything moves and pushes the other way."""
    must_be_odd(lambda: _anywhere(make, rng, alone=True), make().kind)


_ALL = (
    derivatives, machine_code, as_written, balance, dissipates, energy, settles, zones_reached, outputs_given,
    units, instances, odd,
)  # fmt: skip
PROPERTIES: dict[str, Callable[[Maker, np.random.Generator], None]] = {each.__name__: each for each in _ALL}


def _anywhere(make: Maker, rng: np.random.Generator, *, alone: bool = False) -> Iterator[tuple[World, Instant]]:
    """Random instants in every zone, whether the guards allow it or not."""
    for _ in range(INSTANCES):
        world = make()
        for zone in world.structure.zones:
            yield world, world.enter(in_pieces(world, world.draw(rng, alone=alone), rng), zone)


def _settled(make: Maker, *, tell: bool = False) -> Iterator[tuple[World, Instant]]:
    """Where the guards lead to from random instants. A circle of zones is for `settles` to `tell`, else left out."""
    for world, end in make.settled(INSTANCES, INSTANTS):
        if not isinstance(end, CircleError):
            yield world, end
        elif tell:
            raise end


def _end(world: World, at: Instant, zone: str) -> list[Instant]:
    """Where the guards lead from a zone; nowhere, if they run in a circle."""
    try:
        return [world.settle(at, zone)]
    except CircleError:
        return []


def _complex_steps(world: World, at: Instant, mode: int) -> Any:
    columns = [world.ask(mode, at.shifted({key: 1.0}, STEP * 1j)).imag / STEP for key in world.structure.inputs]
    rows = len(world.structure.outputs if mode == layout.SIGNALS else world.structure.targets)
    return np.array(columns).T.reshape(rows, len(columns))


def _close(have: float, want: float, scale: float = 0.0) -> bool:
    return abs(have - want) <= ROUNDING * max(1.0, scale, abs(have), abs(want)) or (np.isnan(have) and np.isnan(want))


def _names(law: Callable[..., Any]) -> tuple[str, ...]:
    return law.__code__.co_varnames[: law.__code__.co_argcount]


def _argument(world: World, at: Instant, name: str) -> Any:
    """What a law asks for, with numbers in it."""
    has, values = world.kind.declaration, at.values
    if name in has.ports:
        port = {key(one).part: value for one, value in values.items() if key(one)[:2] == (PORT, name)}
        domain = has.ports[name].domain
        said = {variable: port[kind] for (variable, _), kind in zip(domain.across, "xv", strict=False)}
        said |= {domain.acceleration: port["a"].real} if domain.acceleration else {}
        return SimpleNamespace(**said, inverse_mass=1 / world.masses.get(name, 1.0), **{domain.through[0]: port["R"]})
    known = {"p": world.of, "t": values["t"], "zone": world.zone(at)}
    known["direction"] = has.zones.direction(known["zone"])
    known |= {name: parameter(world.of, f"#{name}") for name in has.discrete}
    if name in has.shared:
        function = has.shared[name].function
        return function(**{each: _argument(world, at, each) for each in _names(function)})
    return known.get(name, values.get(f"in:{name}", values.get(f"own:{name}")))
