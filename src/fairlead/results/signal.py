"""What a recorded signal is called, and how a pattern picks signals by name."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from fairlead.patterns import matcher


@dataclass(frozen=True)
class Signal:
    """One recorded quantity: its dotted name (`line.core[12].tension`), SI unit and a sentence."""

    name: str
    unit: str
    description: str = ""


def matching(names: Iterable[str], pattern: str) -> list[str]:
    """Return the names that fit `pattern`, in their own order.

    `*` stands for any run of characters and `?` for one. Brackets stand for themselves, because
    `core[12]` is an element and not a set of characters. A segment without an index also stands
    for all its elements, so `line.core.tension` fits `line.core[12].tension`; when a name fits
    literally, it is the only one.
    """
    names = list(names)
    if pattern in names:
        return [pattern]
    return [*filter(matcher(pattern, any_index=True), names)]


def family(name: str) -> tuple[str, int | None]:
    """Split a name into its family and its element: `line.core[12].slip` -> (`line.core[*].slip`, 12).

    The last index counts; a name without an index is its own family with element None.
    """
    parts = re.match(r"(.*)\[(\d+)\](.*)", name)
    if parts is None:
        return name, None
    return f"{parts[1]}[*]{parts[3]}", int(parts[2])
