"""What the framework may ask of a component class, besides its declarations: the one list.

A class answers by an attribute of that name, `transmits = True` or `def inertia(p): ...`; what it does not say
has the default. `Answers` is read when the class is created and kept as `kind.answers`, so nothing else looks into
a class for what it may have. `docs/components.md` has the same list.

What is answered must be of its kind: a method takes the arguments told here, a name is that of an input or a
parameter. A class body may hold more than is asked: helpers of its laws, such as the `coefficient` of a curve. They
are left alone, because a law calls `p.helper(...)` and says with its name what it means. A name that nobody asks for
and that is nearly one that somebody asks for, or nearly that of something a base class has, is refused as a slip of
the pen; a helper that is meant to have such a name takes a leading underscore. So no list of helpers has to be kept,
and `transmit = True` does not pass for silence.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import Field, dataclass, field, fields
from typing import Any

from fairlead.component.declaration import Declaration
from fairlead.component.given import Choice, Waveform
from fairlead.component.near import near_to

BY_NAME = ("law", "sample", "dissipated", "supplied", "stored")
"""Methods whose arguments are given by their names, so that a class asks for those it wants."""
SET_HERE = ("declaration", "answers", "members", "everyone", "shown", "needs", "gives")
"""What the framework itself leaves in a class."""
DECLARED_IN = ("fairlead.component.declare", "fairlead.component.given")
STARS = inspect.CO_VARARGS | inspect.CO_VARKEYWORDS
BUDGETS = ("max_steps", "max_events")
EVERYWHERE, COMPONENT, COMPOSITE, CONTROLLER = "any class", "a Component", "a Composite", "a Controller"


@dataclass(frozen=True)
class Kind:
    """What an answer must be; `wrong` says what is not so, or nothing."""

    said: str
    wrong: Callable[[Any, Declaration], str]
    method: bool = False


def arguments_of(function: Callable[..., Any]) -> tuple[str, ...]:
    """Names of what a function takes; `inspect.signature` is asked where its code does not say so outright."""
    plain = _plain_arguments(function)
    return tuple(inspect.signature(function).parameters) if plain is None else plain


def _plain_arguments(function: Callable[..., Any]) -> tuple[str, ...] | None:
    """The arguments of a function without stars, without arguments by keyword alone, and without a wrapper."""
    code = getattr(function, "__code__", None)
    if code is None or code.co_flags & STARS or code.co_kwonlyargcount or inspect.ismethod(function):
        return None
    if hasattr(function, "__wrapped__") or hasattr(function, "__signature__"):
        return None
    return tuple(code.co_varnames[: code.co_argcount])


def method(*arguments: str) -> Kind:
    """A method that is called with these arguments, in their order."""
    takes = f"({', '.join(arguments)})"

    def wrong(value: Any, has: Declaration) -> str:
        if not inspect.isfunction(value):
            return f"is {_shown(value)}, and a method {takes} is asked for"
        if len(_plain_arguments(value) or ()) == len(arguments) and not value.__defaults__:
            return ""
        try:
            inspect.signature(value).bind(*arguments)
        except TypeError:
            return f"takes {inspect.signature(value)}, and is called with {takes}"
        return ""

    return Kind(takes, wrong, method=True)


def _law(value: Any, has: Declaration) -> str:
    if not inspect.isfunction(value):
        return f"is {_shown(value)}, and a law is asked for"
    unknown = sorted(set(arguments_of(value)) - has.arguments)
    return f"asks for {', '.join(map(repr, unknown))}; known: {sorted(has.arguments)}" if unknown else ""


def _sample(value: Any, has: Declaration) -> str:
    return "" if inspect.isfunction(value) else f"is {_shown(value)}, and a method is asked for"


def _yes_or_no(value: Any, has: Declaration) -> str:
    return "" if isinstance(value, bool) else f"is {_shown(value)}; it is True or False"


def _sentence(value: Any, has: Declaration) -> str:
    return "" if isinstance(value, str) else f"is {_shown(value)}; it is a sentence"


def _input(value: Any, has: Declaration) -> str:
    return "" if value in has.inputs else f"is {_shown(value)}; the inputs are {sorted(has.inputs)}"


def _parameter(value: Any, has: Declaration) -> str:
    known = {*has.parameters, *has.derived}
    return "" if value in known or value == "" else f"is {_shown(value)}; the parameters are {sorted(known)}"


def _unknown(value: Any, has: Declaration) -> str:
    return "" if value in has.unknowns else f"is {_shown(value)}; the unknowns are {sorted(has.unknowns)}"


def _wave(value: Any, has: Declaration) -> str:
    waves = {name for name, one in has.parameters.items() if isinstance(one, Waveform)}
    waves |= {name for name, one in has.derived.items() if one.wave}
    return "" if value in waves or value == "" else f"is {_shown(value)}; the quantities in time are {sorted(waves)}"


def _two_inputs(value: Any, has: Declaration) -> str:
    if not isinstance(value, tuple) or len(value) != 2:
        return f"is {_shown(value)}; it names two inputs"
    return next((said for each in value if (said := _input(each, has))), "")


def _two_ports(value: Any, has: Declaration) -> str:
    fits = isinstance(value, tuple) and len(value) == 2 and set(value) <= set(has.ports)
    return "" if fits else f"is {_shown(value)}; it names two ports of {sorted(has.ports)}"


def _parameters(value: Any, has: Declaration) -> str:
    fits = isinstance(value, tuple) and set(value) <= {*has.parameters}
    return "" if fits else f"is {_shown(value)}; it names parameters of {sorted(has.parameters)}"


def _zones(value: Any, has: Declaration) -> str:
    fits = isinstance(value, tuple) and set(value) <= set(has.zones)
    return "" if fits else f"is {_shown(value)}; it names zones of {sorted(has.zones)}"


def _saturation(value: Any, has: Declaration) -> str:
    if not isinstance(value, dict):
        return _zones(value, has)
    if not set(value) <= set(has.inputs):
        return f"is {_shown(value)}; it names inputs of {sorted(has.inputs)}"
    return next((said for zones in value.values() if (said := _zones(zones, has))), "")


def _budget(value: Any, has: Declaration) -> str:
    fits = isinstance(value, dict) and all(key in BUDGETS and isinstance(n, int) for key, n in value.items())
    return "" if fits else f"is {value!r}; it gives whole numbers for {' and '.join(BUDGETS)}"


def _share(value: Any, has: Declaration) -> str:
    fits = isinstance(value, int | float) and not isinstance(value, bool) and 0 < value <= 1
    return "" if fits else f"is {_shown(value)}; it is a number above 0 and at most 1"


def _options(value: Any, has: Declaration) -> str:
    choice = has.parameters.get(value[0]) if isinstance(value, tuple) and len(value) == 3 else None
    fits = isinstance(choice, Choice) and {*value[1:]} <= {*choice.options}
    return "" if fits else f"is {_shown(value)}; it names a choice and two of its options"


def _map(value: Any, has: Declaration) -> str:
    fits = isinstance(value, dict) and all(isinstance(key, str) for key in value)
    return "" if fits else f"is {_shown(value)}; it is a map with names"


def _given(value: Any, has: Declaration) -> str:
    if wrong := _map(value, has):
        return wrong
    known = {*has.parameters, *has.effects}
    strange = [name for name in value if name not in known]
    return f"gives {strange[0]!r}; the parameters are {sorted(known)}" if strange else ""


LAW = Kind("as a law", _law, method=True)
SAMPLE = Kind("with self, t and what it reads", _sample, method=True)
YES_OR_NO, SENTENCE, MAP = Kind("True or False", _yes_or_no), Kind("a sentence", _sentence), Kind("a map", _map)
GIVEN = Kind("a map", _given)
INPUT, TWO_INPUTS = Kind("an input", _input), Kind("two inputs", _two_inputs)
UNKNOWN = Kind("an unknown", _unknown)
WAVE = Kind("a parameter", _wave)
TWO_PORTS = Kind("two ports", _two_ports)
PARAMETERS, ZONES = Kind("parameters", _parameters), Kind("zones", _zones)
SATURATION = Kind("zones, or a map of zones by input", _saturation)
PARAMETER, BUDGET = Kind("a parameter", _parameter), Kind("a map of numbers", _budget)
SHARE = Kind("a share", _share)
TWO_OPTIONS = Kind("a choice and two of its options", _options)


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
    return Answers(**{name: members[name] for name in asked_of(sort) if name in members and _plain(members[name])})


def unfit(members: Mapping[str, Any], sort: str, has: Declaration) -> Iterator[str]:
    """Answers that are not of their kind."""
    for name, one in asked_of(sort).items():
        if name in members and _plain(members[name]) and (wrong := one.metadata["kind"].wrong(members[name], has)):
            yield f"{name} {wrong}"


def misspelt(bodies: Iterable[Mapping[str, Any]], sort: str) -> Iterator[str]:
    """Slips of the pen in class bodies, the class itself last, and what overrides something of another kind."""
    known: dict[str, Any] = dict.fromkeys(asked_of(sort))
    for whole in bodies:
        body = {name: value for name, value in whole.items() if not name.startswith("_") and name not in SET_HERE}
        for name, value in body.items():
            if name in known:
                yield from _other_kind(name, value, known[name])
            elif _plain(value) and (whose := _of_others(name, sort)):
                yield f"{name!r} is asked of {whose}, and never of {sort}"
            elif _plain(value) and (near := near_to(name, known)):
                yield (
                    f"nobody asks for {name!r}. Did you mean {near}? A helper of its own with such a name takes "
                    "a leading underscore"
                )
        known |= body


def _of_others(name: str, sort: str) -> str:
    """The sort of class that a name is asked of, when a Component or Composite of another sort has it."""
    of = next((one.metadata["of"] for one in fields(Answers) if one.name == name), EVERYWHERE)
    return "" if sort == EVERYWHERE or name in asked_of(sort) or of == EVERYWHERE else of


def _other_kind(name: str, value: Any, before: Any) -> Iterator[str]:
    """A method stands for one with as many arguments, a value for one of its type."""
    if inspect.isfunction(value) and inspect.isfunction(before) and name not in BY_NAME:
        wanted = list(arguments_of(before))
        said = method(*wanted).wrong(value, None)  # type: ignore[arg-type]
        if said:
            yield f"{name} {said}"
    elif isinstance(before, bool | str | tuple | dict) and type(value) is not type(before) and _plain(value):
        yield f"{name} is {_shown(value)}, and a {type(before).__name__} in the class it builds on"


def _plain(value: Any) -> bool:
    """False for declarations, which say themselves what they are, so that a parameter may be called `start`."""
    return type(value).__module__ not in DECLARED_IN


def _shown(value: Any) -> str:
    if inspect.isfunction(value):
        return "a method"
    return repr(value) if _plain(value) else f"a {type(value).__name__}"
