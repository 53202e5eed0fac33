"""What a mistake is, and what a good answer to it holds."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

ERROR, WARNING, EITHER = "error", "warning", "either"


@dataclass(frozen=True)
class Typed:
    """A command as it is typed, in a folder with the base netlists and `files`.

    `apart` is for one that leaves something behind in the process, as a class of one's own in a family does.
    """

    command: tuple[str, ...]
    files: Mapping[str, str] = field(default_factory=dict)
    apart: bool = False


@dataclass(frozen=True)
class Called:
    """A call from Python; it is given the `Desk` on which the user's models lie, and `files` are in the folder."""

    call: Callable[[Any], object]
    files: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Mistake:
    """One mistake. A good answer has one of `place`, all of `part` and one of `cure`, as words.

    `answer` is what is right: to refuse it (ERROR), to say so and go on (WARNING), or one of the two (EITHER).
    """

    name: str
    make: Typed | Called
    place: tuple[str, ...]
    part: tuple[str, ...]
    cure: tuple[str, ...]
    answer: str = ERROR


def words(given: str | tuple[str, ...]) -> tuple[str, ...]:
    """One word or several as a tuple."""
    return (given,) if isinstance(given, str) else given


def damaged(text: str, *changes: tuple[str, str]) -> str:
    """Return `text` with each replacement made once; every one must be found there exactly once."""
    for old, new in changes:
        if text.count(old) != 1:
            raise ValueError(f"{old!r} occurs {text.count(old)} times")
        text = text.replace(old, new)
    return text


def line_of(text: str, piece: str) -> int:
    """Return the number of the first line that holds `piece`."""
    for number, line in enumerate(text.splitlines(), start=1):
        if piece in line:
            return number
    raise ValueError(f"no line has {piece!r}")


def first_difference(text: str, other: str) -> int:
    """Return the number of the first line in which two texts differ."""
    pairs = zip(text.splitlines(), other.splitlines(), strict=False)
    return next(number for number, (one, two) in enumerate(pairs, start=1) if one != two)
