"""Which members of families are in view: what was defined or imported, and what the libraries of one model define.

Two models may have libraries that define a member of the same word. Whoever reads a netlist hides those of all
libraries first, and shows those of its own (`registry.known_types`).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager

from fairlead.component.base import Family

_libraries: list[list[type[Family]]] = []
"""What each load of a library defined, by its number."""


@contextmanager
def defined_by_a_library() -> Iterator[int]:
    """Take what joins meanwhile for members of one library; gives its number. They are not in view yet."""
    before = len(Family.everyone)
    number = len(_libraries)
    _libraries.append([])
    try:
        yield number
    finally:
        _libraries[number] += Family.everyone[before:]
        _put_in_view(Family.shown)


def hide_libraries() -> None:
    """Leave what was defined or imported without a library in view."""
    _put_in_view(())


def show(number: int) -> None:
    """Add the members of one library; they go before others of the same word."""
    _put_in_view((*(one for one in Family.shown if one != number), number))


def defined_in(number: int) -> list[type[Family]]:
    """The members that one library defines."""
    return _libraries[number]


def replaced(number: int) -> Iterator[tuple[type[Family], type[Family]]]:
    """(a member of one library, the one of its word that it takes the place of, of those that are in view)."""
    hidden = {one for n, members in enumerate(_libraries) if n == number or n not in Family.shown for one in members}
    for member in _libraries[number]:
        same = (one for one in Family.everyone if one not in hidden and one.word == member.word)
        yield from ((member, one) for one in same if _head(one) is _head(member))


def in_order(place: Mapping[tuple[str, str], int]) -> None:
    """Put the members of the bundled library first, in the order told by module and name, whenever they were imported.

    So messages and pages list them alike whatever a scene imports, and one of a user's own of the same word counts.
    """
    last = len(place)
    known = [place.get((member.__module__, member.__name__), last) for member in Family.everyone]
    if known != sorted(known):
        Family.everyone.sort(key=lambda member: place.get((member.__module__, member.__name__), last))
        _put_in_view(Family.shown)


def view() -> tuple[int, tuple[int, ...]]:
    """What tells one view from another."""
    return len(Family.everyone), Family.shown


def _put_in_view(shown: tuple[int, ...]) -> None:
    apart = {member for members in _libraries for member in members}
    free = [member for member in Family.everyone if member not in apart]
    for head in {_head(member): None for member in Family.everyone}:
        head.members.clear()
    for member in (*free, *(member for number in shown for member in _libraries[number])):
        member.members[member.word] = member
    Family.shown = shown


def _head(member: type[Family]) -> type[Family]:
    return next(kind for kind in member.__mro__ if "members" in kind.__dict__)
