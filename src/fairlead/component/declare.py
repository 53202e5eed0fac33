"""The words of a component: ports, unknowns, outputs, zones, guards; those of its parameters are in `given.py`.

Everything here is a declaration, a small frozen record that says what a class has. `base.Component`
collects them by name when the class is created; nothing is computed in this file.

Sign rules, stated once:
    a flow is what a port *takes in*: the force that acts on the component there, the volume or the
    current that enters it. At a node the flows of all ports sum to zero.
    tension is positive; power into a component is positive.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any


@dataclass(frozen=True)
class Domain:
    """A kind of port: what is equal at a node (across) and what sums to zero there (through).

    A mechanical domain has a position, its rate and, in guards and outputs only, its acceleration;
    the others have one potential.
    """

    name: str
    across: tuple[tuple[str, str], ...]  # (variable, unit), position before rate
    through: tuple[str, str]
    acceleration: str = ""
    rest: float = 0.0  # where a node begins that nobody gives a start

    @property
    def mechanical(self) -> bool:
        """True when the across variables are a position and its rate."""
        return len(self.across) == 2


TRANSLATIONAL = Domain("translational", (("x", "m"), ("v", "m/s")), ("force", "N"), "a")
ROTATIONAL = Domain("rotational", (("angle", "rad"), ("speed", "rad/s")), ("torque", "N*m"), "acceleration")
HYDRAULIC = Domain("hydraulic", (("pressure", "Pa"),), ("flow", "m^3/s"), rest=1e5)  # that of the air
ELECTRICAL = Domain("electrical", (("voltage", "V"),), ("current", "A"))
THERMAL = Domain("thermal", (("temperature", "K"),), ("heat", "W"), rest=293.15)  # that of a room
SUM = Domain("sum", (("total", "N"),), ("share", "N"))
PATH = Domain("path", (), ("", ""))


@dataclass(frozen=True)
class Port:
    """A connection point of one domain."""

    domain: Domain
    doc: str = ""
    optional: bool = False  # may stay unconnected


def Translational(doc: str = "", *, optional: bool = False) -> Any:
    """A flange that moves along a line: x [m], v [m/s]; takes in a force [N]."""
    return Port(TRANSLATIONAL, doc, optional)


def Rotational(doc: str = "", *, optional: bool = False) -> Any:
    """A shaft end: angle [rad], speed [rad/s]; takes in a torque [N m]."""
    return Port(ROTATIONAL, doc, optional)


def Hydraulic(doc: str = "", *, optional: bool = False) -> Any:
    """A fluid port: pressure [Pa, absolute]; takes in a volume flow [m^3/s]."""
    return Port(HYDRAULIC, doc, optional)


def Electrical(doc: str = "", *, optional: bool = False) -> Any:
    """A terminal: voltage [V]; takes in a current [A]."""
    return Port(ELECTRICAL, doc, optional)


def Thermal(doc: str = "", *, optional: bool = False) -> Any:
    """A thermal port: temperature [K]; takes in heat [W], which is a power by itself."""
    return Port(THERMAL, doc, optional)


def Summing(doc: str = "") -> Any:
    """Adds up signals of many components, such as the loads of all nodes on a wheel: `total` [N] is their sum."""
    return Port(SUM, doc)


def Path(doc: str = "") -> Any:
    """Joins a line with the route it runs along; becomes contacts when the model is flattened."""
    return Port(PATH, doc)


@dataclass(frozen=True)
class Input:
    """A directed signal read by the component. `default` is used when nothing is connected."""

    unit: str
    doc: str = ""
    default: str | float | None = None  # a number, or the name of a parameter
    signed: bool = False  # what it means may be negative, such as a command; the contract suite asks with both signs


CREEP, SHARE, STRAIN, PULL, INTEGRAL, USED_UP = "creep", "share", "strain", "pull", "integral", "used_up"
ROLES = (CREEP, SHARE, STRAIN, PULL, INTEGRAL, USED_UP)


@dataclass(frozen=True)
class Output:
    """A directed signal, computed by the law in force; free unless recorded or connected.

    `role` is what it means to the framework: CREEP is the slip speed of a contact while it should stick. Of it every
    run tells the worst. SHARE is what an element or a node of a line takes in, which belongs to its length: with finer
    elements there are more and smaller ones, so two meshes are not compared by it. Creep is not compared either.
    STRAIN is that of an element, over its length without load; a run watches it, see `compressible` of a component.
    PULL is the force of what can only pull in a machine, though not by its law; a run tells where it pushes.
    INTEGRAL is what a controller has gathered; a run tells where it winds up, see `saturates_in`.
    USED_UP is above zero once nothing is left of what a part gives; the run ends there, unless another part listens to
    the output `of`, which tells what is left. It is above 1 where the law says no more at all, and any run ends. `gone`
    is what the sentence says of the part then, in place of "is used up", and a way out.
    `rounded_by` is the parameter over which a corner at zero of this output is rounded off; a run tells where the
    output stays so small that the rounding counts. In a Composite the parameter has the same name.
    `name` is what it is called, in laws and by users, where a parameter of the class has that name already.
    `start` is what an output of a Controller is until its first sample: a number, or a parameter's name.
    `like` is the input whose unit a plain number has, where a part passes on what comes in.
    """

    unit: str
    doc: str = ""
    role: str = ""
    name: str = ""
    rounded_by: str = ""
    of: str = ""
    gone: tuple[str, str] | None = None
    start: str | float = 0.0
    like: str = ""


@dataclass(frozen=True)
class State:
    """An unknown of the component's own with a rate. `start` is a number or a parameter's name.

    `nominal` is a size of it that matters, likewise a number or a name; the accuracy is relative to that. Without, the
    unit decides. `least` is a bound below which its law does not let it fall: a promise of the author, by which the
    contract chooses the states that it asks with. A run does not hold a state there; a zone of its own does.
    """

    unit: str
    doc: str = ""
    start: str | float = 0.0
    nominal: str | float | None = None
    least: float | None = None


@dataclass(frozen=True)
class Unknown:
    """An algebraic unknown of the component's own: its law gives what must be zero, or `hold(...)`."""

    unit: str
    doc: str = ""
    nominal: float | None = None


@dataclass(frozen=True)
class Discrete:
    """A variable that changes only at sample times; `start` is a number or a parameter's name."""

    unit: str
    doc: str = ""
    start: str | float = 0.0


@dataclass(frozen=True)
class Sampled:
    """A law for discrete variables, in force at sample times only; `period` names a parameter [s]."""

    period: str
    law: Callable[..., Any]


class Zones(tuple[str, ...]):
    """The zones of a component, in the order in which a start tries them.

    Of a contact those in `forward` are for positive slip and those in `backward` for negative, each the mirror image of
    the one in its place among the others; laws and guards ask for the `direction` of the zone, +1 or -1. Those in
    `latched` are entered by breaking away, not from rest. `fairlead friction` draws them so.
    """

    forward: tuple[str, ...]
    backward: tuple[str, ...]
    latched: frozenset[str]

    def __new__(
        cls, *names: str, forward: Iterable[str] = (), backward: Iterable[str] = (), latched: Iterable[str] = ()
    ) -> Zones:
        """Zones by name."""
        zones = super().__new__(cls, names)
        zones.forward, zones.backward, zones.latched = tuple(forward), tuple(backward), frozenset(latched)
        return zones

    def direction(self, zone: str) -> int:
        """+1 in a zone for forward slip, -1 in one for backward, 0 in others."""
        return (zone in self.forward) - (zone in self.backward)

    def mirrored(self, zone: str) -> str:
        """The zone of the other direction; the same for one that has none."""
        pairs = dict(zip(self.forward, self.backward, strict=True))
        return pairs.get(zone) or {other: one for one, other in pairs.items()}.get(zone, zone)


@dataclass(frozen=True)
class Carries:
    """In `zone` the port `by` carries the port `node` along: their speeds keep a ratio, whatever acts on the node.

    What is carried may then be counted as part of what carries it (`docs/integrator.md`, "Entrained nodes").
    """

    node: str
    by: str
    zone: str


@dataclass(frozen=True)
class ZoneLaw:
    """A law in force in some zones."""

    zones: tuple[str, ...]
    law: Callable[..., Any]


@dataclass(frozen=True)
class Guard:
    """A function that is negative inside `zones`; its rise through zero leads to zone `to`.

    A guard that returns several values is a group: it fires when all of them have risen.
    `mirrored` names the same guard for the other direction: between the mirrored zones, by the same function, which is
    given `direction` +1 in the guard as written and -1 in its mirror.
    """

    zones: tuple[str, ...]
    to: str
    unit: str
    function: Callable[..., Any]
    mirrored: str = ""
    direction: int = 0  # what the function is given; 0: that of the zone

    def pair(self, name: str, zones: Zones) -> dict[str, Guard]:
        """The guard by its name, and its mirror behind it when it has one."""
        if not self.mirrored:
            return {name: self}
        there = tuple(zones.mirrored(one) for one in self.zones)
        other = replace(self, zones=there, to=zones.mirrored(self.to), mirrored=name, direction=-1)
        return {name: replace(self, direction=+1), self.mirrored: other}


@dataclass(frozen=True)
class Shared:
    """An expression under a name that laws and guards may ask for, such as the normal force that counts."""

    function: Callable[..., Any]


@dataclass(frozen=True)
class Derived:
    """A number, or a Wave, computed from the parameters when an instance is made; plain Python, not traced."""

    function: Callable[..., Any]
    wave: bool = False


def zone(*names: str) -> Callable[[Callable[..., Any]], Any]:
    """Mark a law as the one in force in the named zones. With several names it receives `zone`."""
    return lambda law: ZoneLaw(names, law)


def guard(*zones: str, to: str, unit: str, mirrored: str = "") -> Callable[[Callable[..., Any]], Any]:
    """Mark a function as a guard of `zones` that leads to `to`; `unit` scales its tolerance.

    `guard("*", to="off", ...)` leads there from every other zone. `mirrored="stops_backward"` declares the guard of
    that name as well, for the other direction; see `Guard`.
    """
    return lambda function: Guard(zones, to, unit, function, mirrored)


def shared(function: Callable[..., Any]) -> Any:
    """Mark a method of ports, inputs and states as an expression that laws and guards ask for by its name."""
    return Shared(function)


def sampled(*, every: str) -> Callable[[Callable[..., Any]], Any]:
    """Mark a law that gives discrete variables their next values every `every` (a parameter, in s).

    All components sampled at one instant read the values from before it, so a signal passed from one to
    the other is delayed by one sample.
    """
    return lambda law: Sampled(every, law)


def derived(function: Callable[..., float]) -> Any:
    """Mark a method as a number derived from the parameters, read as `p.name` in laws."""
    return Derived(function)


def derived_wave(function: Callable[..., Any]) -> Any:
    """Mark a method that makes a quantity in time (a Wave) from the parameters, read as `p.name(t)` in laws."""
    return Derived(function, wave=True)


@dataclass(frozen=True)
class Law:
    """What a law says, by the names the component declares.

    ports        what the port takes in                     Law(a=-tension, b=+tension)
    states       the rate                                   Law(speed=force / mass)
    unknowns     what must be zero, or hold(slip), or hold_position(gap)    Law(force=force - limit)
    outputs      the value
    dissipated, supplied [W], stored [J]   lines of the energy ledger
    """

    terms: Mapping[str, Any] = field(default_factory=dict)

    def __init__(self, **terms: Any) -> None:
        """Terms by name."""
        object.__setattr__(self, "terms", terms)
