"""A component in a world of its own: a free body at every mechanical port, pushed by a steady force.

    body at port P:   m dv/dt = load - flow        flow: what the port takes in, in the zone in force

So the accelerations that guards read belong to the forces of the zone, and a contact that holds has the
force that keeps its slip at zero. Positions and speeds are given; nothing moves: this is one instant.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from fairlead.component.base import Declared
from fairlead.component.keys import key
from fairlead.component.values import Values
from fairlead.kernels import layout
from fairlead.testing.rig import Rig
from fairlead.testing.samples import USUAL

AT_ZERO = 1e-9  # a guard up to this counts as not risen: rounding of speeds and forces of the sizes drawn here
# A large potential by domain; what it is drawn up to, of either sign (a guard may wait for one below zero).
POTENTIAL = {"hydraulic": 2e7, "electrical": 50.0, "thermal": 300.0}
OWN = {"1": 2.0, "Pa": 2e7, "m^3/s": 1e-3, "m^3": 1e-3}  # the same for unknowns of a component's own, by unit
PASSES = 60  # more switches than any component has zones
STEP = 1e-30  # of a complex step; its square vanishes beside 1


class ContractError(AssertionError):
    """A property that a component breaks, in a sentence."""


class ContractRemark(UserWarning):
    """What is allowed and may not be meant."""


class CircleError(ContractError):
    """Zones that do not settle."""


@dataclass(frozen=True)
class Instant:
    """Values of all inputs by key (see `component/trace.py`), what pushes the bodies, and the zones."""

    values: dict[str, Any]
    loads: dict[str, float]
    zones: tuple[int, ...] = ()

    def but(self, zones: Iterable[int]) -> Instant:
        """The same in other zones."""
        return Instant(self.values, self.loads, tuple(zones))

    def having(self, values: dict[str, Any]) -> Instant:
        """The same with other values."""
        return Instant(values, self.loads, self.zones)

    def shifted(self, rates: Mapping[str, float], distance: complex) -> Instant:
        """The same with every value moved along its rate."""
        return self.having({key: value + distance * rates.get(key, 0.0) for key, value in self.values.items()})


@dataclass
class World:
    """One instance, and bodies of `masses` at its free mechanical ports."""

    of: Values
    masses: dict[str, float]
    rig: Rig = field(init=False)
    led: set[tuple[str, str]] = field(init=False, default_factory=set)  # from which zone guards led to which
    seen: set[tuple[str, str]] = field(init=False, default_factory=set)  # (zone, guard) of those that had risen

    def __post_init__(self) -> None:
        """Set the instance up on a rig of its own."""
        self.rig = Rig([self.of], [{port: 1 / mass for port, mass in self.masses.items()}])
        self.structure = self.rig.structure
        self.kind: type[Declared] = self.of.type
        prescribes = self.kind.answers.prescribes
        self.prescribed: dict[str, Any] = dict(prescribes()) if prescribes else {}
        ports = self.kind.declaration.ports
        self.bodies = [name for name, port in ports.items() if port.domain.mechanical and name not in self.prescribed]
        self.zoned = len(self.structure.zones) > 1

    def draw(self, rng: np.random.Generator, *, alone: bool = True) -> Instant:
        """A random instant in no particular zone: speeds from zero to fast, forces from nothing to much.

        `alone`: inputs that need not be connected have their default, as in a world without others.
        """
        has = self.kind.declaration
        values: dict[str, Any] = {}
        for name, port in has.ports.items():
            if port.domain.mechanical:
                values |= {f"port:{name}:x": _around(rng, 0.3), f"port:{name}:v": _around(rng, 0.3)}
                values |= {f"port:{name}:{k}": _around(rng, 10.0) if name in self.prescribed else 0.0 for k in "aAU"}
                if self.prescribed.get(name, "moves") is None:
                    values |= {f"port:{name}:{k}": 0.0 for k in "vaAU"}
            else:
                values[f"port:{name}:x"] = _around(rng, POTENTIAL.get(port.domain.name, 10.0))
            values[f"port:{name}:R"] = _around(rng, 10.0)
        for name, declared in has.inputs.items():
            rest = declared.default if alone and isinstance(declared.default, int | float) else None
            most = USUAL.get(declared.unit, 10.0)
            values[f"in:{name}"] = float(abs(_around(rng, most))) if rest is None else float(rest)
            if declared.signed and rest is None:
                values[f"in:{name}"] = _around(rng, 2.0 if declared.unit == "1" else most)
            elif declared.unit == "1":
                values[f"in:{name}"] = min(values[f"in:{name}"], 1.0)
        own: dict[str, Any] = {**has.states, **has.unknowns}
        values |= {f"own:{name}": _around(rng, OWN.get(one.unit, 1.0)) for name, one in own.items()}
        bounds = {name: state.least for name, state in has.states.items() if state.least is not None}
        values |= {f"own:{name}": low + abs(values[f"own:{name}"] - low) for name, low in bounds.items()}
        values["t"] = float(rng.uniform(0, 4))
        loads = {name: _around(rng, 30.0) for name in self.bodies}
        return Instant(values, loads, tuple(0 for _ in range(self.structure.machines)))

    def ask(self, mode: int, at: Instant) -> Any:
        """One row of what the instance says."""
        inputs = [at.values[key] for key in self.structure.inputs]
        return self.rig.ask(mode, inputs, list(at.zones))[0]

    def enter(self, at: Instant, zone: str) -> Instant:
        """The instant with another zone, on the pieces of tables it had; slip is taken out where the zone holds."""
        zones = (self.structure.zones.index(zone), *at.zones[1:]) if self.zoned else at.zones
        return self._at_rest(at.but(zones))

    def zone(self, at: Instant) -> str:
        """Name of the zone in force."""
        return self.structure.zones[at.zones[0] if self.zoned else 0]

    def flows(self, at: Instant) -> dict[str, Any]:
        """Flow, rate or balance by target, such as `port:a` and `own:force`."""
        return dict(zip(self.structure.targets, self.ask(layout.FLOWS, at), strict=True))

    def held(self, at: Instant) -> dict[str, dict[str, float]]:
        """Unknowns that hold in the zone in force, with the coefficients of the speeds in their slip."""
        s, zone = self.structure, self.zone(at)
        rows = self.ask(layout.MASS, at) if s.mass else []
        found: dict[str, dict[str, float]] = {u: {} for u, zones in s.holds.items() if zone in zones}
        for (unknown, j), coefficient in zip(s.mass, rows, strict=True):
            if unknown in found:
                found[unknown][key(s.inputs[j]).name] = coefficient
        for unknown, ports in s.positions.items():  # minus the slope of its row by an acceleration
            stepped = {port: self.flows(at.shifted({f"port:{port}:U": 1.0}, STEP * 1j)) for port in ports}
            found[unknown] = {port: -float(np.imag(flows[f"own:{unknown}"])) / STEP for port, flows in stepped.items()}
        return found

    def solve(self, at: Instant) -> Instant:
        """The instant with the own unknowns and the accelerations that belong to its zone. Newton, analytic slopes."""
        unknowns = [f"own:{name}" for name in self._told_here()]
        told, values = len(unknowns), dict(at.values)
        held = self.held(at) if unknowns else {}  # no unknown moves a ratio
        for _ in range(30 if unknowns else 0):
            here = at.having(values)
            residual = np.array(self._residual(here, held))
            try:
                change = np.linalg.solve(self._slopes(here, unknowns, held), -residual.real)
            except np.linalg.LinAlgError:  # singular, or wider by potentials that unknowns keep
                unknowns += [] if len(unknowns) > told else self._kept(here)
                slopes = self._slopes(here, unknowns, held)
                sizes = np.abs(slopes).max(axis=1, keepdims=True)
                sizes[sizes == 0] = 1.0
                change, _, rank, _ = np.linalg.lstsq(slopes / sizes, -residual.real / sizes[:, 0], rcond=None)
                if rank < told:
                    names = ", ".join(self._told_here())
                    raise ContractError(f"{self.where(here)}: the law does not determine its unknown {names}") from None
            values = {
                **values,
                **{key: values[key] + step for key, step in zip(unknowns, change.tolist(), strict=True)},
            }
            if np.abs(change).max() <= 1e-12 * max(1.0, *(abs(values[key]) for key in unknowns)):
                break
        here = at.having(values)
        return at.having({**values, **{k: np.real(a) for k, a in self._accelerations(here).items()}})

    def _slopes(self, at: Instant, keys: list[str], held: Mapping[str, Mapping[str, float]]) -> Any:
        return np.array([np.imag(self._residual(at.shifted({key: 1.0}, STEP * 1j), held)) / STEP for key in keys]).T

    def _kept(self, at: Instant) -> list[str]:
        """Potentials that a law may keep by an unknown: of ports into which an unknown flows."""
        flows = self.flows(at.shifted({f"own:{name}": 1.0 for name in self._told_here()}, STEP * 1j))
        ports = [name for name, port in self.kind.declaration.ports.items() if not port.domain.mechanical]
        return [f"port:{name}:x" for name in ports if np.imag(flows.get(f"port:{name}", 0.0))]

    def _told_here(self) -> list[str]:
        """Unknowns that the law determines; what a tie bears depends on what it is tied between, as drawn."""
        return [name for name in self.kind.declaration.unknowns if name != self.kind.answers.bears]

    def settle(self, at: Instant, zone: str) -> Instant:
        """Follow the guards from `zone` until none has risen. Raises CircleError naming the circle."""
        here, path = at.but((self.structure.zones.index(zone), *at.zones[1:])) if self.zoned else at, []
        for _ in range(PASSES + sum(len(t.rows) for t in self.rig.pieces[0])):
            here = self.solve(here)
            path.append(self.zone(here))
            fired = self.risen(here)
            if not fired:
                rest = self._at_rest(here)
                return here if rest is here else self.solve(rest)
            self.seen |= {(path[-1], guard["name"]) for guard in fired}
            here = self.follow(here, fired[0])
            self.led.add((path[-1], self.zone(here)))
        raise CircleError(f"{self.where(at)}: its zones do not settle, they run in a circle: {circle_of(path)}")

    def risen(self, at: Instant) -> list[dict[str, Any]]:
        """Guards of the zone in force that are above zero."""
        guards = self.structure.guards[self.zone(at)]
        values = self.ask(layout.GUARD, at)
        return [guard for guard, value in zip(guards, values, strict=False) if value.real > AT_ZERO]

    def where(self, at: Instant) -> str:
        """Class, zone and the inputs, as a message names an instant."""
        inputs = ", ".join(f"{_written(key)} = {at.values[key].real:.6g}" for key in self.structure.inputs)
        zone = f" in zone {self.zone(at)}" if self.zoned else ""
        return f"{self.rig.variant.label}{zone} ({inputs})"

    def follow(self, at: Instant, guard: dict[str, Any]) -> Instant:
        """The instant with the zone or the piece that a guard leads to, at rest where that holds."""
        zones = list(at.zones)
        zones[guard["machine"]] = guard["to"] if guard["to"] >= 0 else zones[guard["machine"]] + guard["step"]
        return self._at_rest(at.but(zones))

    def _at_rest(self, at: Instant) -> Instant:
        """Held speeds brought together, where the hold takes them, by an impulse that conserves momentum."""
        held = self.held(at)
        if not held:
            return at
        values, slips = at.values, dict(zip(self.structure.targets, self.ask(layout.SLIP, at), strict=True))
        rows = np.array([[np.real(rates.get(port, 0.0)) for port in self.bodies] for rates in held.values()])
        given = rows / np.array([self.masses[port] for port in self.bodies])  # speed of each body for a unit of impulse
        taken = np.array([np.real(slips[f"own:{unknown}"]) for unknown in held])
        changes = given.T @ np.linalg.lstsq(given @ rows.T, taken, rcond=None)[0]
        speeds = {f"port:{port}:v": change for port, change in zip(self.bodies, changes, strict=True)}
        return at.having(values | {speed: values[speed] + change for speed, change in speeds.items()})

    def _residual(self, at: Instant, held: Mapping[str, Mapping[str, float]]) -> list[Any]:
        flows = self.flows(at)
        accelerations = self._accelerations(at, flows)
        moving = self.flows(at.having({**at.values, **accelerations})) if self.structure.positions else {}
        found = []
        for name in self._told_here():
            rates = held.get(name)
            if name in self.structure.positions:
                found.append(moving[f"own:{name}"])
                continue
            found.append(
                flows[f"own:{name}"]
                if rates is None
                else sum(c * accelerations[f"port:{p}:a"] for p, c in rates.items())
            )
        return found

    def _accelerations(self, at: Instant, flows: dict[str, Any] | None = None) -> dict[str, Any]:
        flows = flows or self.flows(at)
        given = {
            f"port:{port}:a": at.values[f"port:{port}:a"] for port in self.prescribed if f"port:{port}:a" in at.values
        }
        free = {p: (at.loads[p] - flows.get(f"port:{p}", 0.0)) / self.masses[p] for p in self.bodies}
        return given | {f"port:{p}:{k}": a for p, a in free.items() for k in "aU"}


def circle_of(path: Sequence[str]) -> str:
    """The zones that come again and again at the end of a path, once round: "off -> on -> off"."""
    passed = [zone for zone, before in zip(path, ["", *path], strict=False) if zone != before]  # pieces change as well
    for length in range(1, len(passed) // 2 + 1):
        if passed[-length:] == passed[-2 * length : -length]:
            once = passed[-length:]
            first = min(range(length), key=lambda k: passed.index(once[k]))  # where it was entered
            return " -> ".join([*once[first:], *once[:first], once[first]])
    return " -> ".join([*passed[-6:]])


def _around(rng: np.random.Generator, most: float) -> float:
    """A number of either sign, its size from a millionth of `most` up; now and then exactly zero."""
    if rng.random() < 0.05:
        return 0.0
    return float((-1, 1)[rng.integers(2)] * most * 10 ** rng.uniform(-6, 0))


def _written(text: str) -> str:
    return ".".join(said for said in key(text)[1:] if said) or text
