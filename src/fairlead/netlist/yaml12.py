"""YAML 1.2 from pyyaml's events: core schema, places, bounds, no tags, no merge keys, no duplicate keys.

pyyaml reads YAML 1.1, in which `no` is false, 12:30 is 750 and 1e3 is a text. Its scanner and parser are the
same for both versions, so only what gives plain scalars a meaning is written here (YAML 1.2.2, section 10.3).
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import yaml

from fairlead.errors import Fault, Location, shown
from fairlead.netlist.limits import DEEPEST, Meter, TooMuch
from fairlead.netlist.netlist import Value

Loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)

NULL = re.compile(r"null|Null|NULL|~|")
TRUE = re.compile(r"true|True|TRUE")
FALSE = re.compile(r"false|False|FALSE")
INTEGER = re.compile(r"[-+]?[0-9]+")
OCTAL = re.compile(r"0o([0-7]+)")
HEXADECIMAL = re.compile(r"0x([0-9a-fA-F]+)")
FLOAT = re.compile(r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?")
INFINITE = re.compile(r"[-+]?\.(?:inf|Inf|INF)")
NOT_A_NUMBER = re.compile(r"\.(?:nan|NaN|NAN)")
SPACELESS = re.compile(r"([A-Za-z_]\w*):(\S.{0,60})")
COMMENT = re.compile(r"(//+|/\*|;+|--(?!-)) *(.*?) *(?:\*/)?$")
COLONLESS = re.compile(r"([A-Za-z_]\w*)\s*\{\s*(\w+)")
LONGEST_LINE = 200  # characters on each side of a mistake that are looked at for its cause
MOST_DIGITS = 300  # beyond that no float holds it, and Python itself refuses to read 4300

Scalar = str | int | float | bool | None


def resolve(text: str) -> Scalar:
    """What a plain (unquoted) scalar means in the YAML 1.2 core schema.

    Raises ValueError for a number that no float can hold.
    """
    if NULL.fullmatch(text):
        return None
    if TRUE.fullmatch(text) or FALSE.fullmatch(text):
        return text[0] in "tT"
    if not (text[0].isdigit() or text[0] in "+-."):
        return text
    for pattern, base in ((INTEGER, 10), (OCTAL, 8), (HEXADECIMAL, 16)):
        if pattern.fullmatch(text):
            if len(text) > MOST_DIGITS:
                raise ValueError("a number of so many digits cannot be held")
            return int(text[2:] if base != 10 else text, base)
    if FLOAT.fullmatch(text):
        if math.isinf(number := float(text)):
            raise ValueError("beyond the largest number, 1.8e308")
        return number
    if INFINITE.fullmatch(text):
        return -math.inf if text[0] == "-" else math.inf
    return math.nan if NOT_A_NUMBER.fullmatch(text) else text


def read_yaml(text: str, file: str, meter: Meter | None = None) -> tuple[Value | None, list[Fault]]:
    """The single document of a text as a tree of Values, and every fault found on the way.

    Duplicate keys, tags and the like leave a tree to go on with; after a syntax error or a passed bound there
    is none.
    """
    composer = _Composer(file, text, meter or Meter())
    try:
        root = composer.document()
    except TooMuch as error:
        return None, [*composer.faults, error.fault]
    except yaml.MarkedYAMLError as error:
        return None, [*composer.faults, _syntax_fault(error, file, text)]
    except yaml.YAMLError as error:
        return None, [*composer.faults, Fault(Location(file), f"not YAML: {error}")]
    return root, composer.faults


@dataclass(frozen=True)
class _Anchored:
    """What an alias stands for, how many nodes that is, and how many levels it goes down."""

    value: Value
    size: int
    height: int


@dataclass
class _Composer:
    """Builds Values from the event stream, counting every event before it becomes a node."""

    file: str
    text: str
    meter: Meter
    deepest: int = 0
    faults: list[Fault] = field(default_factory=list)
    anchors: dict[str, _Anchored | None] = field(default_factory=dict)
    path: list[str] = field(default_factory=list)  # the keys on the way to where it is
    events: Iterator[Any] = field(init=False)

    def __post_init__(self) -> None:
        self.events = yaml.parse(self.text, Loader=Loader)

    def document(self) -> Value | None:
        """The root of the first document; a second document is a fault, no document is None."""
        next(self.events)
        if isinstance(next(self.events), yaml.StreamEndEvent):
            return None
        root = self.node(next(self.events), 1)
        next(self.events)
        if isinstance(event := next(self.events), yaml.DocumentStartEvent):
            self.complain(event, "a second document begins here", "A file holds one netlist; use include.")
        return root

    def node(self, event: Any, depth: int) -> Value:
        """The value that begins with `event`."""
        where = self.place(event)
        if isinstance(event, yaml.AliasEvent):
            return self.aliased(event, where, depth)
        nodes, above, self.deepest = self.meter.nodes, self.deepest, depth
        self.meter.node(where, depth)
        if event.tag is not None:
            advice = "A netlist holds data only; for a text, use quotes."
            self.complain(event, f"tag {shown(event.tag)} is not allowed", advice)
        if event.anchor:
            self.meter.anchor(where)
            self.anchors[event.anchor] = None
        value = Value(self.content(event, depth), where)
        if event.anchor:
            height = self.deepest - depth
            self.anchors[event.anchor] = _Anchored(value, self.meter.nodes - nodes, height)
        self.deepest = max(self.deepest, above)
        return value

    def content(self, event: Any, depth: int) -> Any:
        if isinstance(event, yaml.MappingStartEvent):
            return self.mapping(depth)
        if isinstance(event, yaml.SequenceStartEvent):
            return self.sequence(depth)
        if event.style:
            return event.value
        try:
            return resolve(event.value)
        except ValueError as error:
            self.complain(event, f"{shown(event.value)}: {error}")
            return 0

    def sequence(self, depth: int) -> list[Value]:
        items = []
        while not isinstance(event := next(self.events), yaml.SequenceEndEvent):
            items.append(self.node(event, depth + 1))
        return items

    def mapping(self, depth: int) -> dict[str, Value]:
        entries: dict[str, Value] = {}
        while not isinstance(event := next(self.events), yaml.MappingEndEvent):
            where = self.place(event)
            name = self.key(event, depth)
            self.path.append(name or "")
            value = replace(self.node(next(self.events), depth + 1), key_where=where)
            self.path.pop()
            if not getattr(event, "style", "") and (mended := self.mended(event, name, value, entries)):
                name, value = mended
            elif name in entries:
                first = entries[name].key_where
                self.complain(event, f"{shown(name)} is given twice", f"It stands at {first} already.")
                continue
            if name is not None:
                entries[name] = value
        return entries

    def mended(self, event: Any, name: str | None, value: Value, entries: Mapping[str, Value]) -> Any:
        """Name and value that were meant by what YAML reads otherwise, with a fault; None for what is as it looks."""
        if name is None:
            return None
        where = ".".join(shown(word) for word in [*self.path, name] if word not in ("", "components"))
        if value.content is None and name[:1].isdigit() and entries:  # 2,5 kg
            last, before = list(entries.items())[-1]
            number = f"{shown(before.content)},{name}"
            if isinstance(before.content, int) and before.where.line == self.place(event).line:
                of = where.removesuffix(shown(name)) + last
                point = number.replace(",", ".")
                what = f"{of} = {shown(number)}: a comma ends an entry"
                advice = f"Write a decimal point, not a decimal comma: {point}."
                if re.match(r"\d{3}(?!\d)", name) and before.content:  # 1,000 kg
                    advice = f"Write a decimal point or no mark of thousands: {point} or {number.replace(',', '')}."
                self.faults.append(Fault(before.where, what, advice))
                return last, replace(before, content=resolve(point))
        if value.content is None and (found := SPACELESS.fullmatch(name)):  # mass:2 kg
            self.complain(event, f"{where}: a space is missing behind the colon", f"Write {found[1]}: {found[2]}.")
            return found[1], replace(value, content=resolve(found[2]))
        if (found := COLONLESS.fullmatch(name)) and isinstance(value.content, str) and value.content.endswith("}"):
            rest = value.content.removesuffix("}").strip()
            what = f"{found[1]}: a colon is missing before the brace"
            self.complain(event, what, f"Write {found[1]}: {{{found[2]}: {shown(rest)}}}.")
            inner = {found[2]: replace(value, content=resolve(rest))}
            return found[1], replace(value, content=inner)
        return None

    def key(self, event: Any, depth: int) -> str | None:
        """The text of a key; None, with a fault, for what cannot be one."""
        if not isinstance(event, yaml.ScalarEvent):
            self.node(event, depth + 1)
            self.complain(event, "a key is a name, not a map, list or alias")
            return None
        self.meter.node(self.place(event), depth)
        if event.value == "<<" and not event.style:
            advice = "Write the entries out, or put what is shared into parameters."
            self.complain(event, "<<: merge keys are not part of YAML 1.2", advice)
            return None
        if event.tag is not None or event.anchor or not event.value:
            self.complain(event, f"{shown(event.value)}: a key is a plain name without tag or anchor")
        return event.value

    def aliased(self, event: Any, where: Location, depth: int) -> Value:
        known = self.anchors.get(event.anchor)
        if known is None:
            inside = event.anchor in self.anchors
            why = "stands for itself" if inside else "has no anchor before it"
            advice = "" if inside else f'A text that begins with * goes in quotes: "*{event.anchor}".'
            self.complain(event, f"*{shown(event.anchor)} {why}", advice)
            self.meter.node(where, 1)
            return Value(None, where)
        bottom = depth + known.height
        self.meter.alias(where, known.size, bottom)
        self.deepest = max(self.deepest, bottom)
        return known.value

    def place(self, event: Any) -> Location:
        return Location(self.file, event.start_mark.line + 1, event.start_mark.column + 1)

    def complain(self, event: Any, what: str, way_out: str = "") -> None:
        self.faults.append(Fault(self.place(event), what, way_out))


def _syntax_fault(error: yaml.MarkedYAMLError, file: str, text: str) -> Fault:
    mark = error.problem_mark or error.context_mark
    if "maximum nesting depth" in str(error.problem):  # libyaml looks ahead of its events, and has a bound of its own
        return Fault(_deep_place(file, text), f"nested more than {DEEPEST} levels deep")
    if mark is None:
        return Fault(Location(file), f"not YAML: {error.problem}")
    opened = error.context_mark
    if opened is not None and opened.index < mark.index and _stays_open(text, opened.index):
        bracket, close = (("{", "}"), ("[", "]"))[text[opened.index] == "["]
        shows = f"line {mark.line + 1}" if opened.line < mark.line else f"column {mark.column + 1}"
        what = f"not YAML: this {bracket} is not closed, as {shows} shows"
        way_out = f"Put {close} where it ends."
        return Fault(Location(file, opened.line + 1, opened.column + 1), what, way_out)
    lines = text.splitlines()
    line = lines[mark.line] if mark.line < len(lines) else ""
    place = Location(file, mark.line + 1, mark.column + 1)
    if opened is not None and "block mapping" in (error.context or "") and (said := _misplaced(lines, opened, mark)):
        return Fault(place, *said)
    near = dict.fromkeys([mark.line, opened.line if opened is not None else mark.line, max(mark.line - 1, 0)])
    for number in (one for one in near if one < len(lines)):
        if said := _run_together(lines[number].strip()):
            return Fault(Location(file, number + 1, len(lines[number]) - len(lines[number].lstrip()) + 1), *said)
    if found := COMMENT.match(line[mark.column :].strip()):
        return Fault(place, f"not YAML: {found[1]} begins no comment", f"A comment begins with #: # {shown(found[2])}")
    context = f" {error.context}" if error.context else ""
    what = f"not YAML: {error.problem}{context}"
    if line.strip():
        what += f", in `{shown(line.strip())}`"
    return Fault(place, what, _advice(line, mark.column))


def _deep_place(file: str, text: str) -> Location:
    """Where brackets and braces first stand deeper than allowed, counted as if none stood in a text in quotes."""
    depth = 0
    for index, letter in enumerate(text):
        depth += (letter in "[{") - (letter in "]}")
        if depth > DEEPEST:
            return Location(file, text.count("\n", 0, index) + 1, index - text.rfind("\n", 0, index))
    return Location(file)


def _run_together(line: str) -> tuple[str, str] | None:
    """Of a line in which a colon is missing, or the space behind it: what is wrong, and what to write."""
    if found := COMMENT.match(line):
        return f"not YAML: {found[1]} begins no comment", f"A comment begins with #: {shown(f'# {found[2]}')}"
    if found := COLONLESS.match(line):
        return f"not YAML: {found[1]}: a colon is missing before the brace", f"Write {found[1]}: {{{found[2]}: ...}}."
    if found := SPACELESS.match(line):
        return f"not YAML: {found[1]}: a space is missing behind the colon", f"Write {found[1]}: {found[2]}"
    return None


def _misplaced(lines: list[str], opened: Any, mark: Any) -> tuple[str, str] | None:
    """Of an entry that begins in no column in which one may begin: what it is, and where the others begin."""
    line = lines[mark.line] if mark.line < len(lines) else ""
    if mark.column != len(line) - len(line.lstrip()) or mark.column == opened.column:
        return None
    word = re.split(r"[:\s]", line.strip(), maxsplit=1)[0]
    above = next((one for one in reversed(lines[: mark.line]) if one.strip() and not one.lstrip().startswith("#")), "")
    column = len(above) - len(above.lstrip()) + 1
    what = f"not YAML: {shown(word)} is indented to column {mark.column + 1}, the entry above it to column {column}"
    return what, "Entries of one map are indented alike."


def _stays_open(text: str, start: int) -> bool:
    """Whether the bracket at `start` has no other that closes it; what stands in quotes or a comment is passed over."""
    if text[start : start + 1] not in ("{", "["):
        return False
    open_ = []
    for found in re.finditer(r"[\[\]{}]|'[^'\n]*'|\"[^\"\n]*\"|#[^\n]*", text[start:]):
        if found[0] in "[{":
            open_.append(found[0])
        elif found[0] in "]}":
            if open_[-1] + found[0] not in ("[]", "{}"):
                return len(open_) == 1
            open_.pop()
        if not open_:
            return False
    return True


def _advice(line: str, column: int) -> str:
    """The usual cause of a syntax error on this line, if it can be seen."""
    begin = max(0, column - LONGEST_LINE)
    line, column = line[begin : column + LONGEST_LINE], column - begin
    if "\t" in line[: column + 1]:
        return "Indent with spaces; YAML takes no tabs."
    if re.search(r":\s+\{[^}:]*\}\s*\S", line):
        return 'An expression goes in quotes: "{2*mu} N".'
    if re.search(r"[:\[,]\s*[*&%@`]", line):
        return 'A text that begins with one of * & % @ ` goes in quotes: "*.tension".'
    if re.search(r"\[[^\]\"']*\w\[", line):
        return 'A path with brackets goes in quotes inside [ ]: "line.core[2].tension".'
    if line.count(": ") > 1:
        return "A text that holds a colon and a space goes in quotes."
    return "Look here and on the line above: indentation, a missing colon, a bracket or quote left open."
