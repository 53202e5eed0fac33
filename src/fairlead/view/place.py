r"""Where in a netlist that is being typed the cursor stands: in which maps, and behind which key.

    place_in("components:\n  s: {type: Spr", 26)    ->   path ("components", "s"), key "type", prefix "Spr"

The text may be in any state, so this is no YAML parser: it follows indentation, braces, commas and colons up to the
cursor, and knows quotes and comments.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

ITEM = "[]"
"""In a path: an item of a list."""
KEY = re.compile(r"""(?:"([^"]*)"|'([^']*)'|([^\s#{}\[\],:"'][^#{}\[\],:]*?))\s*:(?=\s|$)""")


@dataclass(frozen=True)
class Place:
    """The maps and lists round the cursor, the key whose value it is in (None at a key), and what is typed of it."""

    path: tuple[str, ...]
    key: str | None
    prefix: str
    begins: tuple[int, ...]
    """Where in the text the content of every entry of the path begins."""


@dataclass
class _Open:
    """A brace or bracket that is open: the key at hand, and where what is being typed begins."""

    bracket: str
    begin: int
    key: str | None = None
    token: int = 0


@dataclass
class _Reading:
    blocks: list[tuple[int, str, int]] = field(default_factory=list)  # (indent, key, where its content begins)
    flows: list[_Open] = field(default_factory=list)
    value: int | None = None  # of the last key of a block, on its own line
    token: int = 0


def place_in(text: str, at: int) -> Place:
    """The place of the cursor, `at` characters into the text."""
    reading, begin = _Reading(), 0
    for line in text[:at].split("\n"):
        if reading.flows:
            _flow(reading, line, 0, begin)
        else:
            _block(reading, line, begin)
        begin += len(line) + 1
    return _told(reading, text[:at])


def _block(reading: _Reading, line: str, begin: int) -> None:
    indent = len(line) - len(line.lstrip(" "))
    rest = line[indent:]
    while reading.blocks and reading.blocks[-1][0] >= indent and not rest.startswith("#"):
        reading.blocks.pop()
    reading.value, reading.token = None, begin + indent
    while rest.startswith("- ") or rest == "-":
        width = 2 + len(rest[2:]) - len(rest[2:].lstrip(" "))
        reading.blocks.append((indent, ITEM, begin + min(indent + width, len(line))))
        indent, rest = indent + width, rest[width:]
        reading.token = begin + min(indent, len(line))
    found = KEY.match(rest)
    if found:
        content = begin + indent + found.end()
        reading.blocks.append((indent, _name(found), content))
        rest, indent = rest[found.end() :], indent + found.end()
        spaces = len(rest) - len(rest.lstrip(" "))
        reading.value = reading.token = begin + indent + spaces
        rest, indent = rest[spaces:], indent + spaces
    if rest[:1] in ("{", "["):
        _flow(reading, line, indent, begin)


def _name(found: re.Match[str]) -> str:
    return next(one for one in found.groups() if one is not None)


def _flow(reading: _Reading, line: str, first: int, begin: int) -> None:
    """Follow braces from column `first` of a line to its end, or to where all are closed."""
    k = first
    while k < len(line):
        letter = line[k]
        if letter in "\"'":
            end = line.find(letter, k + 1)
            k = len(line) if end < 0 else end + 1
            continue
        if letter == "#" and (k == 0 or line[k - 1] == " "):
            return
        if letter in "{[":
            reading.flows.append(_Open(letter, begin + k + 1, token=begin + k + 1))
        elif letter in "}]":
            reading.flows.pop()
            if not reading.flows:
                reading.token = begin + k + 1
                return
        elif letter == ",":
            reading.flows[-1].key, reading.flows[-1].token = None, begin + k + 1
        elif letter == ":" and reading.flows[-1].bracket == "{" and line[k + 1 : k + 2] in ("", " "):
            one = reading.flows[-1]
            one.key = line[max(one.token - begin, 0) : k].strip().strip("\"'")
            one.token = begin + k + 1
        k += 1


def _told(reading: _Reading, before: str) -> Place:
    names = [name for _, name, _ in reading.blocks]
    begins = [content for _, _, content in reading.blocks]
    for one in reading.flows[:-1]:
        names.append(ITEM if one.bracket == "[" else one.key or "")
        begins.append(one.begin if one.bracket == "[" else one.token)
    if reading.flows:
        last = reading.flows[-1]
        prefix = before[last.token :].lstrip()
        if last.bracket == "[":
            return Place((*names, ITEM), "", prefix, (*begins, last.begin))
        return Place(tuple(names), last.key, prefix, tuple(begins))
    prefix = before[reading.token :].lstrip()
    if reading.value is not None and names:
        return Place(tuple(names[:-1]), names[-1], prefix, tuple(begins[:-1]))
    return Place(tuple(names), None, prefix, tuple(begins))
