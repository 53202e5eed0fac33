"""Force against slip speed of a contact, zone by zone, as its law and guards give it with the numbers of a scene.

    found = characteristic(values, normal=10.0)
    found.branches["plateau"]        slip [m/s] and friction [N] where this zone can stay

The laws are run with plain numbers for a surface at rest and a body of 1 kg. A zone can stay at a slip where none of
its guards has risen: for a body that does not accelerate (steady slip); else for one that is slowed down by friction
alone (caught); or, where a zone has neither, for one that is driven by `DRIVEN` times stiction. States such as a
bristle's deflection are at their steady value. What counts is the normal force with the factors of the curve for load
and temperature, as in a run, at the temperature that stands where none is connected.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fairlead.component.declaration import Declaration
from fairlead.component.holding import Hold
from fairlead.component.terms import terms_of
from fairlead.component.values import Values

DRIVEN = 1.5  # applied force over stiction, for zones that steady slip never sees
SPEEDS = (1e-7, 1e2)  # m/s; where the range of a curve is looked for
LEVEL = 0.02  # share of a coefficient up to which it does not change
GRIP = "grip"  # of what contacts share: the normal force that counts
POINTS = 500  # slip speeds of each sign, from a hundredth of the smallest scale to ten times the largest
LOAD_SHARES = (0.5, 0.99)  # of the holding capacity, at which creep is told
SAME = 1e-3  # relative; a capacity is met on a grid of slips, so that both directions differ by that and are one
TURNED = {"N": "N*m", "m/s": "rad/s", "N/m": "N*m/rad", "N*s/m": "N*m*s/rad"}
"""Units of a contact between shafts, whose lever arm is one metre for each radian."""
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Characteristic:
    """A contact's law with numbers. Speeds in m/s and forces in N; of shafts, in rad/s and N*m."""

    label: str
    normal: float
    breakaway: float
    breakaway_backward: float
    branches: dict[str, tuple[Floats, Floats]] = field(default_factory=dict)  # zone -> slip, friction
    driven: dict[str, tuple[Floats, Floats]] = field(default_factory=dict)  # the same, only while driven
    caught: dict[str, tuple[Floats, Floats]] = field(default_factory=dict)  # the same, only while slowing down
    called: dict[str, str] = field(default_factory=dict)  # zone -> name of its branch, the same for mirror images
    latched: frozenset[str] = frozenset()  # zones of the branches that are entered by breaking away
    holds: bool = False  # a zone holds the slip at zero
    capacity: float = 0.0  # largest force below the first maximum
    capacity_backward: float = 0.0
    slope: float | None = None  # at zero slip [N s/m]; None: rigid, or bristles
    stiffness: float | None = None  # of bristles [N/m]
    creep: tuple[float, ...] = ()  # at LOAD_SHARES of the capacity
    can_hold: bool = True  # false for laws that are there to be seen failing
    numbers: tuple[tuple[str, float, str], ...] = ()  # name, value, unit of what the law derives from its settings
    force_unit: str = "N"
    speed_unit: str = "m/s"

    def rows(self) -> list[tuple[str, str]]:
        """What is printed: (quantity, value with unit)."""
        turns = self.force_unit != "N"
        if self.stiffness is not None:
            stiffness = f"{self.stiffness:.4g} {TURNED['N/m'] if turns else 'N/m'} (bristles)"
        else:
            stiffness = "rigid" if self.slope is None else f"{self.slope:.4g} {TURNED['N*s/m'] if turns else 'N*s/m'}"
        creep = ", ".join(
            f"{v:.3g} {self.speed_unit} at {share:.0%}" for v, share in zip(self.creep, LOAD_SHARES, strict=True)
        )
        begin = [("normal force", f"{self.normal:.4g} N"),
                 ("breakaway", self._both(self.breakaway, self.breakaway_backward))]  # fmt: skip
        if not self.can_hold:
            return [*begin, ("holding capacity", f"none: method {self.label} has no sticking")]
        return [
            *begin, ("holding capacity", self._both(self.capacity, self.capacity_backward)), ("stiffness", stiffness),
            ("creep", creep), *((name, f"{value:.4g} {unit}") for name, value, unit in self.numbers),
        ]  # fmt: skip

    def _both(self, forward: float, backward: float) -> str:
        """One value, or that of each direction where they differ."""
        if abs(forward - backward) <= SAME * max(abs(forward), abs(backward)):
            return f"{forward:.4g} {self.force_unit}"
        return f"{forward:.4g} {self.force_unit} forward, {backward:.4g} {self.force_unit} backward"

    def at_arm(self, arm: float) -> Characteristic:
        """The same as torques over angular speeds, of a contact at a lever arm [m]."""

        def turned(branches: dict[str, tuple[Floats, Floats]]) -> dict[str, tuple[Floats, Floats]]:
            return {zone: (slip / arm, force * arm) for zone, (slip, force) in branches.items()}

        power = {"N": 1, "m/s": -1, "N/m": 2, "N*s/m": 2}  # of the arm
        numbers = tuple((name, value * arm ** power.get(unit, 0), TURNED.get(unit, unit))
                        for name, value, unit in self.numbers)  # fmt: skip
        return replace(
            self, breakaway=self.breakaway * arm, breakaway_backward=self.breakaway_backward * arm,
            branches=turned(self.branches), driven=turned(self.driven), caught=turned(self.caught),
            capacity=self.capacity * arm, capacity_backward=self.capacity_backward * arm,
            slope=None if self.slope is None else self.slope * arm**2,
            stiffness=None if self.stiffness is None else self.stiffness * arm**2,
            creep=tuple(v / arm for v in self.creep), numbers=numbers, force_unit=TURNED["N"],
            speed_unit=TURNED["m/s"],
        )  # fmt: skip


def characteristic(values: Values, normal: float) -> Characteristic:
    """Evaluate a contact (a component that says what it is `pressed_by`) at a normal force [N]."""
    has, p = values.type.declaration, values
    slips, limits = _slips(p), _limits(p, normal)
    most = max(limits)
    steady: dict[str, tuple[Floats, Floats]] = {}
    driven: dict[str, tuple[Floats, Floats]] = {}
    caught: dict[str, tuple[Floats, Floats]] = {}
    holds = False
    for zone in has.zones:
        points = [(v, _force(p, zone, v, normal), v) for v in slips]
        if any(isinstance(force, Hold) for _, force, _ in points):
            holds = True
            continue
        known = [(v, force) for v, force, _ in points if force is not None]
        stays = [(v, f) for v, f in known if _stays(p, zone, v, f, normal, 0.0)]
        slowing = [(v, f) for v, f in known if (v, f) not in stays and _stays(p, zone, v, f, normal, -f)]
        if stays:
            steady[zone] = _columns(stays)
        if slowing:
            caught[zone] = _columns(slowing)
        if stays or slowing:
            continue
        pushed = [
            (v, f) for v, f in known for d in (-1, 1) if _stays(p, zone, v, f, normal, d * DRIVEN * most - f)
        ]
        if pushed:
            driven[zone] = _columns(pushed)
    return replace(_measured(p, normal, limits, steady, driven, holds), caught=caught)


def _measured(
    p: Values, normal: float, limits: tuple[float, float], steady: dict[str, Any], driven: dict[str, Any], holds: bool
) -> Characteristic:
    label, rest = p.type.word, dict.fromkeys(LOAD_SHARES, 0.0)  # type: ignore[attr-defined]
    grip, (breakaway, backward) = _grip(p, normal), limits
    numbers = tuple(p.type.answers.numbers(p, grip)) if p.type.answers.numbers is not None else ()
    common = {"label": label, "normal": normal, "breakaway": breakaway, "breakaway_backward": backward,
              "branches": steady, "driven": driven,
              "numbers": numbers, "can_hold": p.type.answers.can_hold,
              "latched": p.type.declaration.zones.latched, "called": _branches(p.type.declaration)}  # fmt: skip
    if holds or p.type.declaration.states:
        gives = p.type.answers.gives_by
        stiffness = grip * p.path(gives) if gives and not holds else None
        return Characteristic(
            **common, holds=holds, capacity=breakaway, capacity_backward=backward, stiffness=stiffness,
            creep=tuple(rest.values()),
        )  # fmt: skip
    latched = p.type.declaration.zones.latched
    branches = [branch for zone, branch in steady.items() if zone not in latched]
    v, force = _forward(branches)
    if not len(v):
        return Characteristic(**common, creep=tuple(rest.values()))
    rising = _rising(force)
    capacity = float(rising[-1])
    other = _rising(_forward([(-slip, -pull) for slip, pull in branches])[1])
    creep = tuple(float(np.interp(share * capacity, rising, v[: len(rising)])) for share in LOAD_SHARES)
    return Characteristic(**common, capacity=capacity, capacity_backward=float(other[-1]) if len(other) else 0.0,
                          slope=float(force[0] / v[0]), creep=creep)  # fmt: skip


def _rising(force: Floats) -> Floats:
    """Up to the first fall."""
    top = int(np.argmax(np.maximum.accumulate(force) * (1 - 1e-9) > force)) or len(force)
    return np.maximum.accumulate(force[:top])


def _grip(p: Values, normal: float) -> float:
    """The normal force that counts [N]: with the factors that the contact has for load and temperature."""
    zone = next(iter(p.type.declaration.zones))
    return float(_arguments(p, zone, 0.0, normal, 0.0, {}).get(GRIP, normal))


def _limits(p: Values, normal: float) -> tuple[float, float]:
    """Friction [N] at which the contact breaks away, forward and backward."""
    breaks_away_at = p.type.answers.breaks_away_at
    if breaks_away_at is None:
        return 0.0, 0.0
    forward = breaks_away_at(p)
    curve, grip = _curve(p), _grip(p, normal)
    own = curve is not None and curve.given.get("backward") is not None
    backward = curve.breakaway_backward if own and curve is not None else forward
    return grip * forward, grip * backward


def _curve(p: Values) -> Values | None:
    """The part of a contact that has a coefficient."""
    parts = (one for one in p.given.values() if isinstance(one, Values))
    return next((one for one in parts if hasattr(one.type, "coefficient")), None)


def _branches(has: Declaration) -> dict[str, str]:
    """By zone the name of its branch: its own; of a zone and its mirror image both."""
    pairs = {(one, other): f"{one}, {other}" for one, other in zip(has.zones.forward, has.zones.backward, strict=True)}
    return dict(zip(has.zones, has.zones, strict=True)) | {zone: both for pair, both in pairs.items() for zone in pair}


def _forward(branches: list[tuple[Floats, Floats]]) -> tuple[Floats, Floats]:
    """All points of positive slip, in order."""
    pairs = sorted((float(v), float(f)) for slip, force in branches for v, f in zip(slip, force, strict=True) if v > 0)
    table = np.array(pairs).reshape(-1, 2)
    return table[:, 0], table[:, 1]


def _slips(p: Values) -> Floats:
    """Slip speeds of both signs, logarithmic, that show the treatment's own scale and the curve's."""
    own = [p.path(p.type.answers.sticks_below)] if p.type.answers.sticks_below else []
    changes = p.type.answers.changes_over
    curve = [scale for scale in (changes(p) or _range(p),) if scale] if changes is not None else []
    scales = [*own, *curve] or [1e-3]
    half = np.geomspace(min(scales) / 100, max([*curve, *(100 * s for s in own), *scales]) * 10, POINTS)
    return np.concatenate([-half[::-1], half])


def _range(p: Values) -> float | None:
    """Speed [m/s] over which the curve of a contact changes, measured, where the curve does not say; None when level.

    Where it levels out, that is where two thirds of the change are done; where it goes on, where it has changed by as
    much as it begins with.
    """
    curve = _curve(p)
    if curve is None:
        return None
    speeds = np.geomspace(*SPEEDS, POINTS)
    change = np.abs(np.array([float(curve.coefficient(float(v))) for v in speeds]) - float(curve.coefficient(0.0)))
    whole, first = float(change.max()), abs(float(curve.coefficient(0.0)))
    if whole <= LEVEL * first or whole == 0.0:
        return None
    late = change[speeds > SPEEDS[1] / 10]
    part = 2 / 3 * whole if np.ptp(late) <= LEVEL * whole else min(first or whole, whole)
    return float(speeds[np.argmax(change >= part)])


def _columns(points: list[tuple[float, float]]) -> tuple[Floats, Floats]:
    table = np.array(sorted(points))
    return table[:, 0], table[:, 1]


def _force(p: Values, zone: str, slip: float, normal: float) -> Any:
    """Friction in a zone; a Hold where the zone holds; None where a state has no steady value."""
    states = dict.fromkeys(p.type.declaration.states, 0.0)
    terms = _terms(p, zone, slip, normal, states)
    unknown = next(iter(p.type.declaration.unknowns), None)
    if unknown is not None:
        return terms[unknown] if isinstance(terms[unknown], Hold) else -float(terms[unknown])
    if states:
        steady = _steady(p, zone, slip, normal, states)
        if steady is None:
            return None
        terms = _terms(p, zone, slip, normal, steady)
    return float(terms[_body(p)])


def _body(p: Values) -> str:
    """The port of the body that slips on the surface: the second."""
    return list(p.type.declaration.ports)[1]


def _steady(p: Values, zone: str, slip: float, normal: float, states: dict[str, float]) -> dict[str, float] | None:
    """Where the rates of all states, linear in them, are zero; None where one goes on whatever they are."""

    def rates(at: dict[str, float]) -> Floats:
        terms = _terms(p, zone, slip, normal, at)
        return np.array([float(terms[name]) for name in states])

    at_zero = rates(states)
    slopes = np.stack([rates({**states, name: 1.0}) - at_zero for name in states], axis=1)
    free = ~slopes.any(axis=1)
    if at_zero[free].any():
        return None
    found, *_ = np.linalg.lstsq(slopes[~free], -at_zero[~free])
    return dict(zip(states, found.tolist(), strict=True))


def _terms(p: Values, zone: str, slip: float, normal: float, states: dict[str, float]) -> dict[str, Any]:
    law = p.type.declaration.laws[zone]
    return terms_of(p.type, _called(law, _arguments(p, zone, slip, normal, 0.0, states)))


def _stays(p: Values, zone: str, slip: float, friction: float, normal: float, push: float) -> bool:
    """True when no guard of the zone has risen."""
    has = p.type.declaration
    if has.states:
        d = has.zones.direction(zone)
        return d == 0 or d * slip > 0
    arguments = _arguments(p, zone, slip, normal, push, dict.fromkeys(has.unknowns, friction))
    for guard in has.guards.values():
        if zone in guard.zones:
            direction = guard.direction or arguments["direction"]
            said = _called(guard.function, {**arguments, "direction": direction})
            if all(value > 0 for value in (said if isinstance(said, tuple) else (said,))):
                return False
    return True


def _arguments(p: Values, zone: str, slip: float, normal: float, push: float, own: dict[str, float]) -> dict[str, Any]:
    """Arguments of a law: the surface at rest, the body of 1 kg at `slip` with acceleration `push`."""
    has = p.type.declaration
    surface = SimpleNamespace(x=0.0, v=0.0, a=0.0, inverse_mass=0.0)
    body = SimpleNamespace(x=0.0, v=slip, a=push, inverse_mass=1.0)
    given = {
        **{name: _stands(p, one.default) for name, one in has.inputs.items()}, **dict.fromkeys(has.unknowns, 0.0),
        p.type.answers.pressed_by: normal,
        "p": p, "t": 0.0, "zone": zone, "direction": has.zones.direction(zone),
        **dict(zip(has.ports, (surface, body), strict=False)), **own,
    }  # fmt: skip
    return given | {name: _called(shared.function, given) for name, shared in has.shared.items()}


def _stands(p: Values, default: Any) -> float:
    """What an input is where nothing is connected; zero where that is not said."""
    value = p.path(default) if isinstance(default, str) else default
    return float(value) if isinstance(value, int | float) else 0.0


def _called(function: Any, arguments: dict[str, Any]) -> Any:
    code = function.__code__
    return function(**{name: arguments[name] for name in code.co_varnames[: code.co_argcount]})
