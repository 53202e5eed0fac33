"""Slips of the pen in the bodies of classes: names that nobody asks for and that are nearly those somebody does.

A class body may hold more than is asked: helpers of its laws, such as the `coefficient` of a curve. They are left
alone, because a law calls `p.helper(...)` and says with its name what it means. A name that nobody asks for and that is
nearly one that somebody asks for, or nearly that of something a base class has, is refused as a slip of the pen; a
helper that is meant to have such a name takes a leading underscore. So no list of helpers has to be kept, and
`transmit = True` does not pass for silence.
"""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields
from typing import Any

from fairlead.component.answers import EVERYWHERE, Answers, asked_of
from fairlead.component.kinds_of_answers import arguments_of, as_shown, is_plain, method
from fairlead.component.near import near_to

BY_NAME = ("law", "sample", "dissipated", "supplied", "stored")
"""Methods whose arguments are given by their names, so that a class asks for those it wants."""
SET_HERE = ("declaration", "answers", "members", "everyone", "shown", "needs", "gives")
"""What the framework itself leaves in a class."""


def misspelt(bodies: Iterable[Mapping[str, Any]], sort: str) -> Iterator[str]:
    """Slips of the pen in class bodies, the class itself last, and what overrides something of another kind."""
    known: dict[str, Any] = dict.fromkeys(asked_of(sort))
    for whole in bodies:
        body = {name: value for name, value in whole.items() if not name.startswith("_") and name not in SET_HERE}
        for name, value in body.items():
            if name in known:
                yield from _other_kind(name, value, known[name])
            elif is_plain(value) and (whose := _of_others(name, sort)):
                yield f"{name!r} is asked of {whose}, and never of {sort}"
            elif is_plain(value) and (near := near_to(name, known)):
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
    elif isinstance(before, bool | str | tuple | dict) and type(value) is not type(before) and is_plain(value):
        yield f"{name} is {as_shown(value)}, and a {type(before).__name__} in the class it builds on"
