"""What may stand at the cursor of a netlist: types, parameters, words and units from the schema, and ports.

    offers = Completion(types)
    offers.at(text, cursor)      {"begin": 26, "items": [{"text": "Spring", "about": "Linear spring; ..."}, ...]}
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from fairlead.component.base import Declared
from fairlead.component.json_schema import json_schema
from fairlead.quantities import QuantityError, fits, parse_unit
from fairlead.view.place import ITEM, Place, place_in

MOST = 60
UNITS = (
    "m", "mm", "cm", "km", "m/s", "mm/s", "km/h", "m/s^2", "s", "ms", "min", "h", "Hz", "kg", "g", "t", "kg/m",
    "kg*m^2", "N", "kN", "MN", "N/m", "kN/m", "N/mm", "N*s/m", "kN*s/m", "N*m", "kN*m", "N*m/rad", "N*m*s/rad", "rad",
    "mrad", "deg", "rev", "rad/s", "rpm", "Pa", "kPa", "MPa", "bar", "l", "l/min", "m^2", "cm^2", "mm^2", "m^3", "cm^3",
    "m^3/s", "W", "kW", "J", "kJ", "V", "A", "mA", "ohm", "K", "%",
)  # fmt: skip
QUANTITY = re.compile(r"^([-+]?[\d.]+(?:[eE][-+]?\d+)?) *([A-Za-z%°]*[\w*/^%°]*)$")
BARE = re.compile(r"such as \S+ (\S+?),? or a bare number in (\S+?)\.(?:\s|$)")
WORDS = re.compile(r"""\b([a-z_]+)\s*:\s*["']?([A-Za-z][\w.]*)""")
COMPONENT = re.compile(
    r"""^ +([a-z][a-z0-9_]*):(?:\s*\{[^}\n]*?\btype:|[ ]*(?:#.*)?\n(?:[ ]*(?:#.*)?\n)* +type:)\s*["']?(\w+)""",
    re.MULTILINE,
)
Schema = Mapping[str, Any]


class Completion:
    """Offers for netlists that may use `types`."""

    def __init__(self, types: Mapping[str, type[Declared]]) -> None:
        self._schema = json_schema(types)
        self._ports = {name: _ports(kind) for name, kind in types.items()}

    def at(self, text: str, cursor: int) -> dict[str, Any]:
        """What fits behind what is typed, and where that begins."""
        place = place_in(text, min(max(cursor, 0), len(text)))
        typed = place.prefix.lower()
        found = [(one, about) for one, about in self._offers(text, place) if one.lower().startswith(typed)]
        if place.key is not None and not found:
            found = list(self._units(text, place))
        items = [{"text": one, "about": about} for one, about in dict(found).items()][:MOST]
        return {"begin": cursor - len(place.prefix), "items": items}

    def _offers(self, text: str, place: Place) -> Iterator[tuple[str, str]]:
        if place.path[:1] == ("connections",):
            yield from self._connected(text)
            return
        nodes = self._nodes(text, place)
        if place.key is None:
            for node in nodes:
                for name, said in node.get("properties", {}).items():
                    yield f"{name}: ", self._about([said])
            return
        for node in self._below(nodes, place.key):
            for word in (*node.get("enum", ()), *([node["const"]] if "const" in node else ())):
                about = self._schema["definitions"].get(word, {}) if place.key == "type" else {}
                yield str(word), self._about([about])

    def _units(self, text: str, place: Place) -> Iterator[tuple[str, str]]:
        """The number that is typed with every unit that fits."""
        found = QUANTITY.match(place.prefix)
        nodes = self._open(self._below(self._nodes(text, place), str(place.key)), {})
        declared = BARE.search("\n".join(str(node.get("description", "")) for node in nodes))
        if not found or not declared:
            return
        try:
            dimension = parse_unit(declared[2]).dimension
        except QuantityError:
            return
        for unit in dict.fromkeys((declared[1], declared[2], *UNITS)):
            if unit.startswith(found[2]) and unit != found[2] and fits(parse_unit(unit).dimension, dimension):
                yield f"{found[1]} {unit}", ""

    def _connected(self, text: str) -> Iterator[tuple[str, str]]:
        for name, kind in COMPONENT.findall(text):
            for port in self._ports.get(kind, ()):
                yield f"{name}.{port}", kind

    def _nodes(self, text: str, place: Place) -> list[Schema]:
        """The schemas that hold for the map the cursor is in."""
        nodes = list(self._open([self._schema], {}))
        for name, begin in zip(place.path, place.begins, strict=True):
            nodes = list(self._open(self._below(nodes, name), _siblings(text, begin)))
        return nodes

    def _below(self, nodes: Iterable[Schema], name: str) -> list[Schema]:
        """The schemas of an entry of these maps, or of the items of these lists."""
        found = []
        for node in nodes:
            patterns = node.get("patternProperties", {})
            if name in (ITEM, ""):
                found.append(node.get("items"))
            elif name in node.get("properties", {}):
                found.append(node["properties"][name])
            else:
                found += [one for pattern, one in patterns.items() if re.search(pattern, name)]
                found.append(node.get("additionalProperties"))
        return list(self._open([one for one in found if isinstance(one, dict)], {}))

    def _open(self, nodes: Iterable[Schema], words: Mapping[str, str]) -> Iterator[Schema]:
        """These schemas and all that they refer to, of alternatives those that fit the words that are written."""
        for node in nodes:
            yield node
            inner = [self._schema["definitions"][node["$ref"].rpartition("/")[2]]] if "$ref" in node else []
            inner += [one for way in ("allOf", "anyOf", "oneOf") for one in node.get(way, ())]
            if "if" in node:
                asked = node["if"].get("properties", {})
                holds = all(words.get(key) == one.get("const", words.get(key)) for key, one in asked.items())
                holds = holds and all(key in words for key in node["if"].get("required", ()))
                inner += [node[branch] for branch in ("then" if holds else "else",) if branch in node]
            yield from self._open(inner, words)

    def _about(self, nodes: Iterable[Schema]) -> str:
        said = next((node["description"] for node in self._open(nodes, {}) if node.get("description")), "")
        return str(said).split("\n", 1)[0]


def _ports(kind: Any) -> tuple[str, ...]:
    """Ports of a type, of a family those of all its members."""
    kinds = [*getattr(kind, "members", {}).values()] or [kind]
    return tuple(dict.fromkeys(port for one in kinds for port in one.declaration.ports))


def _siblings(text: str, begin: int) -> dict[str, str]:
    """Words of the map that begins there, by key: to its closing brace, or as far as lines are indented."""
    if text[begin:].lstrip(" ").startswith("{") or (begin and text[begin - 1] in "{["):
        content, depth = text[begin:], 0 if text[begin:].lstrip(" ").startswith("{") else 1
        for k, letter in enumerate(content):
            depth += (letter in "{[") - (letter in "}]")
            if depth <= 0 and letter in "}]":
                content = content[:k]
                break
    else:
        first, *lines = text[begin:].split("\n")
        start = text.rfind("\n", 0, begin) + 1
        outer = len(text[start:begin]) - len(text[start:begin].lstrip(" "))
        kept = [first]
        for line in lines:
            if line.strip() and len(line) - len(line.lstrip(" ")) <= outer:
                break
            kept.append(line)
        content = "\n".join(kept)
    found: dict[str, str] = {}
    for key, word in WORDS.findall(content):
        found.setdefault(key, word)
    return found
