"""What the framework may ask of a component class, besides its declarations: the one list.

A class answers by an attribute of that name, `transmits = True` or `def inertia(p): ...`; what it does not say
has the default. `Answers` is read when the class is created and kept as `kind.answers`, so nothing else looks into
a class for what it may have. `docs/components.md` has the same list.

What is answered must be of its kind (kinds_of_answers.py): a method takes the arguments told here, a name is that of an
input or a parameter. What else a class body may hold, and what is a misspelt answer, is in slips.py.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import Field, dataclass, field, fields
from typing import Any

from fairlead.component.declaration import Declaration
from fairlead.component.kinds_of_answers import (
    BUDGET,
    GIVEN,
    INPUT,
    LAW,
    MAP,
    PARAMETER,
    PARAMETERS,
    SAMPLE,
    SATURATION,
    SENTENCE,
    SHARE,
    TWO_INPUTS,
    TWO_OPTIONS,
    TWO_PORTS,
    UNKNOWN,
    WAVE,
    YES_OR_NO,
    Kind,
    is_plain,
    method,
)

EVERYWHERE, COMPONENT, COMPOSITE, CONTROLLER = "any class", "a Component", "a Composite", "a Controller"


def _asked(kind: Kind, doc: str, of: str = COMPONENT, default: Any = None) -> Any:
    facts = {"kind": kind, "doc": doc, "of": of}
    return field(default_factory=dict, metadata=facts) if default is dict else field(default=default, metadata=facts)


@dataclass(frozen=True)
class Answers:
    """What a class says, or the default; None where nothing is said. Methods are called with `p` themselves."""

    law: Callable[..., Any] | None = _asked(LAW, "what the ports take in, for a class without zones")
    stored: Callable[..., Any] | None = _asked(LAW, "energy stored [J], if the laws do not give it")
    dissipated: Callable[..., Any] | None = _asked(LAW, "power dissipated [W], likewise")
    supplied: Callable[..., Any] | None = _asked(LAW, "power supplied [W], likewise")
    sample: Callable[..., Any] | None = _asked(SAMPLE, "its outputs, at a sample", CONTROLLER)
    inertia: Callable[[Any], Mapping[str, float]] | None = _asked(
        method("p"), "mass, moment of inertia or capacity, by port"
    )
    start: Callable[[Any], Mapping[str, Any]] | None = _asked(
        method("p"), "start value by port: a potential, or (position, speed); None for what is not given"
    )
    prescribes: Callable[[], Mapping[str, Any]] | None = _asked(
        method(), "ports whose motion is given, each with the outputs for position, speed, acceleration; None at rest"
    )
    starts_at: Callable[[Any, float, float], None] | None = _asked(
        method("p", "x", "t"), "receives where the body that it moves is at the start of the run, and that time"
    )
    moves_as: str = _asked(WAVE, "with `prescribes`: the quantity in time that is the position", default="")
    ties: Callable[[Any], Iterable[tuple[str, str, Any, Any]]] | None = _asked(
        method("p"), "rigid ties of its ports: (a, b, ratio, offset) for b = ratio * a + offset"
    )
    bears: str = _asked(
        UNKNOWN,
        "with `ties` of two ports: the unknown that is the force in the tie; the framework writes its "
        "equation (the balance of the part beyond), the law writes the flows", default="",
    )  # fmt: skip
    expand: Callable[[Any, Any], Any] | None = _asked(
        method("p", "scene"), "what it is made of, as an Expansion", COMPOSITE
    )
    hands_on: tuple[str, ...] = _asked(
        PARAMETERS, "parameters that it gives to the contacts it makes, under their own names", COMPOSITE, default=()
    )
    check: Callable[[Any], Iterable[tuple[str, str, str]]] | None = _asked(
        method("p"), "yields (parameter, what is wrong, way out) for values that contradict each other", EVERYWHERE
    )
    doubts: Callable[[Any], Iterable[tuple[str, str, str]]] | None = _asked(
        method("p"), "yields (parameter, what is odd, way out) for values that are allowed and need a thought; `check` "
        "and a run remark it", EVERYWHERE
    )  # fmt: skip
    prepare: Callable[[dict[str, Any]], dict[str, Any]] | None = _asked(
        method("given"),
        "the given parameters, completed by those that follow from them, before `p` is made",
        EVERYWHERE,
    )
    transmits: bool = _asked(
        YES_OR_NO, "its two ends move alike in steady motion (springs, teeth, sensors)", default=False
    )
    passes: str = _asked(INPUT, "in steady motion its output equals that input (lags, interlocks)", default="")
    at_most: str = _asked(
        PARAMETER, "with `passes`: the greatest rate at which its output follows the input", default=""
    )
    follows: tuple[str, str] | None = _asked(
        TWO_INPUTS, "in steady motion the second input equals the first (controllers with an integral)"
    )
    keeps: str = _asked(PARAMETER, "it keeps the tension of the line at that parameter [N]", default="")
    fastest: Callable[[Any], tuple[float, float]] | None = _asked(
        method("p"), "of a motor with a supply: its speed without load [rad/s] and its torque at rest [N*m]"
    )
    swept: str = _asked(PARAMETER, "of a hydraulic motor: its oil per angle [m^3/rad]", default="")
    metered: str = _asked(
        PARAMETER, "of a valve: flow per root of the drop over one land, fully open [m^3/s/Pa^0.5]", default=""
    )
    fed: tuple[str, str] | None = _asked(TWO_PORTS, "with `metered`: where oil comes in and where it goes back")
    pressed_by: str = _asked(
        INPUT, "of a contact: its normal force; its first port is the surface, its second the body", default=""
    )
    breaks_away_at: Callable[[Any], float] | None = _asked(
        method("p"), "with `pressed_by`: friction over normal force at which it begins to slip"
    )
    sticks_below: str = _asked(PARAMETER, "of a contact: the slip speed below which it counts as sticking", default="")
    creeps: bool = _asked(
        YES_OR_NO,
        "with `sticks_below`: while sticking it still slips, at a share of that speed that grows with the load",
        default=False,
    )
    narrowest: Callable[[Any], float | None] | None = _asked(
        method("p"), "of a contact: slip speed [m/s] from which on friction is that of sliding; None without a band"
    )
    changes_over: Callable[[Any], float | None] | None = _asked(
        method("p"), "of a contact: smallest range of slip speeds [m/s] over which friction changes, to which the "
        "accuracy of speeds there is relative; None when level",
    )  # fmt: skip
    preslides: str = _asked(
        PARAMETER,
        "of a contact: the distance by which it yields before it slides [m], to which the accuracy of "
        "positions there "
        "is relative", default="",
    )  # fmt: skip
    gives_by: str = _asked(
        PARAMETER, "of a contact: its stiffness over the normal force before it slides [1/m]", default=""
    )
    numbers: Callable[[Any, float], Iterable[tuple[str, float, str]]] | None = _asked(
        method("p", "normal"), "of a contact: (name, value, unit) of further values that `fairlead friction` prints"
    )
    exact: bool = _asked(
        YES_OR_NO, "of a contact: while sticking it does not move; other contacts are compared with it", default=False
    )
    never_sticks: bool = _asked(
        YES_OR_NO, "of a contact: it slips under any load, by one formula for all slip speeds", default=False
    )
    can_hold: bool = _asked(YES_OR_NO, "of a contact: it can keep a load at rest", default=True)
    level: str = _asked(
        PARAMETER, "of a curve: the coefficient of steady sliding, which stands for it where its dependence on speed "
        "is left out", EVERYWHERE, "",
    )  # fmt: skip
    as_one: tuple[str, str, str] | None = _asked(
        TWO_OPTIONS, "of a station that immerses the line: the choice, and its options for a line that moves as one "
        "body out there and for one that does not", EVERYWHERE,
    )  # fmt: skip
    compressible: float = _asked(
        SHARE,
        "with an output of role strain: the share of its length by which it may get shorter without a remark",
        default=0.5,
    )
    begins_in: Callable[[Any], str] | None = _asked(
        method("p"), "the zone in which it begins, unless a guard says otherwise; the first one where it is not said"
    )
    saturates_in: tuple[str, ...] | Mapping[str, tuple[str, ...]] = _asked(
        SATURATION,
        "zones in which a larger input gives no larger output, of all inputs or by input; a run "
        "reports a controller that winds up there",
        default=(),
    )
    budget: Mapping[str, int] = _asked(
        BUDGET, "`max_steps` and `max_events` of its runs, where the netlist gives none", default=dict
    )
    advice: str = _asked(SENTENCE, "printed when a run with it fails or a budget ends it", default="")
    exempt: Mapping[str, str] = _asked(
        MAP, "properties of the contract that it does not keep, each with the reason", EVERYWHERE, dict
    )
    asked_with: Mapping[str, Any] = _asked(
        GIVEN, "parameters with which the contract is checked, instead of random ones", EVERYWHERE, dict
    )


METHODS = tuple(one.name for one in fields(Answers) if one.metadata["kind"].method)


def asked_of(sort: str) -> dict[str, Field[Any]]:
    """What a sort of class may be asked, by name."""
    asked = (EVERYWHERE, COMPONENT, CONTROLLER) if sort == CONTROLLER else (EVERYWHERE, sort)
    return {one.name: one for one in fields(Answers) if one.metadata["of"] in asked}


def rows() -> list[tuple[str, str, str]]:
    """(what to write, which classes, what it means) of all that may be asked, as documented."""
    return [
        (f"{one.name}{kind.said}" if kind.said.startswith("(") else one.name, _where(one), one.metadata["doc"])
        for one in fields(Answers)
        for kind in [one.metadata["kind"]]
    ]


def _where(one: Field[Any]) -> str:
    kind, of = one.metadata["kind"], one.metadata["of"]
    return f"method of {of}" if kind.method else f"{kind.said}, of {of}"


def answers_of(members: Mapping[str, Any], sort: str) -> Answers:
    """What a class says, given all that it and its bases have by name."""
    return Answers(**{name: members[name] for name in asked_of(sort) if name in members and is_plain(members[name])})


def unfit(members: Mapping[str, Any], sort: str, has: Declaration) -> Iterator[str]:
    """Answers that are not of their kind."""
    for name, one in asked_of(sort).items():
        if name in members and is_plain(members[name]) and (wrong := one.metadata["kind"].wrong(members[name], has)):
            yield f"{name} {wrong}"
