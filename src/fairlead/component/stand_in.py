"""A component with a mistake in a parameter still stands in the wiring, so that mistakes there are told at once too.

What cannot be read is replaced by a value that its declaration allows. Nothing is run with it: a mistake has been told,
so all that a stand-in serves for is its ports. Where a value decides what ports there are (a word of a composite, the
name of a device) there is no stand-in, and nobody is blamed for what would have been joined to it.
"""

from __future__ import annotations

import pathlib
from collections.abc import Iterable, Mapping
from typing import Any

from pydantic import ValidationError

from fairlead.component.base import Composite, Declared
from fairlead.component.given import REQUIRED, Block, Choice, Count, File, Parameter, Part, Stations, Table, Waveform
from fairlead.component.parameters import validated
from fairlead.component.values import Values
from fairlead.errors import FairleadError, did_you_mean

NUMBERS = (Parameter, Waveform, Table, Part)
ANY_TABLE = [[0.0, 1.0], [1.0, 1.0]]
ANY_COEFFICIENT = 0.5
TRIES = 3  # what is missing shows when what is misspelt has gone, and a contradiction after that


class _Hopeless(Exception):
    """Nothing can stand for this value."""


def stand_in(kind: type[Declared], given: Mapping[str, Any], folder: pathlib.Path) -> Values | None:
    """Values like those given, with others where there are mistakes; None where that cannot be told.

    `given` holds the parameters as written, without their places.
    """
    if any(isinstance(one, File) for one in kind.declaration.parameters.values()):
        return None  # what the file holds decides what ports there are
    firm = issubclass(kind, Composite)
    plain = dict(given)
    wrong: list[tuple[Any, ...]]
    for _ in range(TRIES):
        try:
            values = validated(kind, plain, folder)
            wrong = [(name.partition("[")[0].partition(".")[0],) for name, *_ in _contradictions(values)]
            if not wrong:
                return values
        except ValidationError as error:
            wrong = [detail["loc"] for detail in error.errors(include_url=False)]
        except FairleadError:
            return None
        try:
            plain = _mended(kind.declaration.parameters, plain, wrong, firm)
        except _Hopeless:
            return None
    return None


def _contradictions(values: Values) -> Iterable[tuple[str, str, str]]:
    """What the class itself says of the values together; what its parts say cannot change its ports."""
    check = values.type.answers.check
    return check(values) if check else ()


def _mended(
    declared: Mapping[str, Any], given: Mapping[str, Any], wrong: Iterable[tuple[Any, ...]], firm: bool
) -> dict[str, Any]:
    """What was given, with other values at the places that are wrong. `firm`: words decide what ports there are."""
    inside: dict[str, list[tuple[Any, ...]]] = {}
    for place in wrong:
        if not place:  # the values contradict each other
            raise _Hopeless
        inside.setdefault(str(place[0]), []).append(tuple(place[1:]))
    made = dict(given)
    for name, places in inside.items():
        one = declared.get(name)
        if one is None:
            made.pop(name, None)
            meant = declared.get(did_you_mean(name, declared).removeprefix("Did you mean ").removesuffix("?"))
            if firm and meant is not None and not isinstance(meant, NUMBERS):
                raise _Hopeless
        elif isinstance(one, Block) and isinstance(made.get(name), Mapping):
            if () in places and not firm:
                made.pop(name)
            else:
                made[name] = _mended(one.parameters, made[name], places, firm)
        elif isinstance(one, Stations) and isinstance(made.get(name), list):
            made[name] = _stations(one, made[name], places)
        elif firm and not isinstance(one, NUMBERS):
            raise _Hopeless
        else:
            made[name] = _any(one)
    return made


def _stations(declared: Stations, listed: list[Any], wrong: Iterable[tuple[Any, ...]]) -> list[Any]:
    """A list of devices with others where they are wrong; each is known by its type."""
    by_number: dict[Any, list[tuple[Any, ...]]] = {}
    for place in wrong:
        if len(place) < 3 or not isinstance(listed[place[0]], Mapping):  # the type, or something that is no map
            raise _Hopeless
        by_number.setdefault(place[0], []).append(place[2:])
    made = list(listed)
    for number, places in by_number.items():
        member = declared.family.members.get(str(made[number].get("type")))  # type: ignore[attr-defined]
        if member is None:
            raise _Hopeless
        made[number] = _mended(member.declaration.parameters, made[number], places, firm=True)
    return made


def _any(declared: Any) -> Any:
    """A value that a declaration allows."""
    default = getattr(declared, "default", REQUIRED)
    if isinstance(declared, Part):
        bare = declared.family.bare  # type: ignore[attr-defined]
        if bare is None:
            raise _Hopeless
        return ANY_COEFFICIENT
    if default is not REQUIRED and default is not None:
        return default
    if isinstance(declared, Parameter):
        return _number(declared)
    if isinstance(declared, Waveform):
        return 0.0
    if isinstance(declared, Table):
        return ANY_TABLE
    if isinstance(declared, Count):
        return max(declared.least or 1, 1)
    if isinstance(declared, Choice):
        return declared.options[0]
    raise _Hopeless


def _number(declared: Parameter) -> float:
    """A number well inside the range."""
    least = declared.above if declared.above is not None else declared.least
    most = declared.below if declared.below is not None else declared.most
    if least is None:
        return 1.0 if most is None else most - 1.0
    return least + 1.0 if most is None else (least + most) / 2
