"""Overrides: `--set mu=0.6`, `--set pad.normal_force="12 N"`, `--set run.stop=5`, put into the tree.

A name without a dot is a scene parameter. A number for it without a unit is in SI, in the dimension that the netlist
gives the parameter: where that has `m: 2 kg`, `--set m=3` is 3 kg. In a dotted path the first word is a component, or
else a block of the netlist (`run`, `record`, `friction`, `effects`, `initial`, `nominal`, `limits`); further words lead
into maps, and into lists by number or by the name of an item (item_names.py).
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Mapping
from dataclasses import replace

from fairlead.errors import Fault, Location, did_you_mean, listing, shown
from fairlead.netlist.expressions import Scalar, has_expression
from fairlead.netlist.files import UNPRINTABLE
from fairlead.netlist.item_names import item_names
from fairlead.netlist.limits import DEEPEST
from fairlead.netlist.netlist import Value
from fairlead.netlist.parameters import work_out
from fairlead.netlist.settings import RecordSettings, RunSettings
from fairlead.netlist.yaml12 import resolve
from fairlead.quantities import QuantityError, digits, quantity, unit_text

BLOCKS = ("run", "record", "friction", "effects", "initial", "nominal", "limits")
KEYS: dict[str, Collection[str]] = {
    "friction": ("method", "creep"), "run": RunSettings.model_fields, "record": RecordSettings.model_fields,
}  # fmt: skip
"""Blocks whose names are always the same."""
DOTTED = ("initial", "nominal", "limits")
"""Blocks whose names are those of signals, with dots and brackets in them."""
SIDES = ("above", "below")
LONGEST = 1000
WHOLE = re.compile(r"\s*(\{\s*['\"]?(?P<key>\w+)['\"]?\s*:|\[)")
"""The beginning of a map or a list; an expression in braces has no colon."""
PLACE = Location("--set")


def override(tree: Value, overrides: Mapping[str, str]) -> tuple[Value, list[Fault]]:
    """The tree with each override in its place, and a fault for each that has none."""
    faults = []
    for name, text in overrides.items():
        place = getattr(text, "where", PLACE)  # of a settings file
        result = _one(tree, name, str(text), place)
        if isinstance(result, Fault):
            faults.append(replace(result, where=place))
        else:
            tree = result
    return tree, faults


def _one(tree: Value, name: str, text: str, place: Location) -> Value | Fault:
    if len(name) > LONGEST or len(text) > LONGEST:
        return Fault(PLACE, f"{shown(name)}: names and values have at most {LONGEST} characters")
    if UNPRINTABLE.search(name + text):
        return Fault(PLACE, f"{shown(name)} = {shown(text)} is not a text in UTF-8", "Type it again in plain letters.")
    if whole := WHOLE.match(text):
        return _several(name, text, whole["key"])
    try:
        resolved = resolve(text.strip())
        new = Value(resolved, place, place)
    except ValueError as error:
        return Fault(PLACE, f"{shown(name)} = {shown(text)}: {error}")
    path = name.replace("[", ".").replace("]", "").split(".")
    if len(path) > DEEPEST or not all(path):
        return Fault(
            PLACE, f"{shown(name)} is not a path", "Write it as in mu, pad.normal_force or run.stop."
        )
    if path[0] in DOTTED and len(path) > 1:
        return _placed(tree, _dotted(name), new, name)
    parameters, components = (_block(tree, block) for block in ("parameters", "components"))
    if len(path) == 1:
        if name not in parameters:
            return _unknown(name, parameters, components)
        path = ["parameters", name]
    elif path[0] in components:
        if owner := _list_of(components[path[0]], path[1]):
            meant = ".".join([path[0], owner, *path[1:]])
            return Fault(PLACE, f"{shown(name)}: {path[0]} has no {path[1]} of its own", f"Did you mean {meant}?")
        path = ["components", *path]
    elif path[0] not in (*BLOCKS, "parameters") or (path[0] == "parameters" and path[1] not in parameters):
        return _unknown(name, parameters, components)
    if path[0] == "parameters" and len(path) == 2:
        new = replace(new, content=_with_unit(resolved, path[1], parameters))
    return _placed(tree, path, new, name)


def _with_unit(content: Scalar, name: str, parameters: Mapping[str, Value]) -> Scalar:
    """A bare number with the unit in SI of the parameter that it replaces, if that is a quantity."""
    if isinstance(content, bool) or not isinstance(content, int | float) or not math.isfinite(content):
        return content
    was: object = parameters[name].content
    if isinstance(was, str) and has_expression(was):
        was = work_out(parameters)[0].values.get(name)
    try:
        unit = unit_text(quantity(was).dimension) if isinstance(was, str) else ""
    except QuantityError:
        return content
    return f"{content!r} {unit}" if unit else content


def _several(name: str, text: str, key: str | None) -> Fault:
    """A map or a list is given where one value is asked for."""
    what = f"{shown(name)} = {shown(text)} is {'a map' if key else 'a list'}; one value is set at a time"
    if key:
        return Fault(PLACE, what, f"Set its entries one by one, each by its path: {shown(f'{name}.{key}')}.")
    return Fault(PLACE, what, f"Write it in the netlist; an item that is there is set by {shown(f'{name}[0]')}.")


def _dotted(name: str) -> list[str]:
    """The steps to an entry of a block whose names have dots: `limits`, `spring.tension`, `below`."""
    block, _, key = name.partition(".")
    signal, _, word = key.rpartition(".")
    return [block, signal, word] if block == "limits" and signal and word in SIDES else [block, key]


def _placed(value: Value, path: list[str], new: Value, name: str) -> Value | Fault:
    """The value with `new` put at the end of the path; maps on the way are made when absent."""
    if not path:
        return new
    word, rest = path[0], path[1:]
    content = value.content
    if isinstance(content, list):
        index = _index(content, word)
        if index is None:
            return _no_item(content, word, name)
        inner = _placed(content[index], rest, new, name)
        if isinstance(inner, Fault):
            return inner
        return replace(value, content=[*content[:index], inner, *content[index + 1 :]])
    if content is not None and not isinstance(content, dict):
        return Fault(PLACE, f"{shown(name)}: {shown(content)} at {value.where} has no part {shown(word)}")
    entries = content or {}
    inner = _placed(entries.get(word, Value(None, PLACE, PLACE)), rest, new, name)
    return inner if isinstance(inner, Fault) else replace(value, content={**entries, word: inner})


def _no_item(items: list[Value], word: str, name: str) -> Fault:
    names = [one for one in _names(items) if one]
    known = f"Items go by number, 0 to {len(items) - 1}" + (f", or by name: {listing(names)}" if names else "")
    what = f"{shown(name)}: there is no item {shown(word)} in {shown(items)}"
    return Fault(PLACE, what, f"{did_you_mean(word, names)} {known if items else 'It has no items'}.".strip())


def _names(items: list[Value]) -> list[str | None]:
    """What the items of a list are called; None for one without a name and a type."""
    return item_names((_text(item, "name"), _text(item, "type")) for item in items)


def _text(item: Value, key: str) -> str | None:
    content = item.entries[key].content if key in item.entries else None
    return content if isinstance(content, str) else None


def _index(items: list[Value], word: str) -> int | None:
    number = digits(word)
    if number is not None:
        return number if number < len(items) else None
    names = _names(items)
    return names.index(word) if word in names else None


def _list_of(component: Value, word: str) -> str:
    """The list of a component in which an item has that name, such as `stations`; "" where it is an entry itself."""
    lists = {key: one.content for key, one in component.entries.items() if isinstance(one.content, list)}
    found = (key for key, items in lists.items() if word in _names(items))
    return "" if word in component.entries else next(found, "")


def _unknown(name: str, parameters: Mapping[str, Value], components: Mapping[str, Value]) -> Fault:
    first, _, rest = name.partition(".")
    if not rest and first in components:
        way_out = (
            f"It is a component; name one of its parameters, as in {first}.{_sample(components[first])}."
        )
        return Fault(PLACE, f"{shown(name)} is not a parameter of the netlist", way_out)
    known = [*components, *BLOCKS] if rest else [*parameters]
    what = (
        f"there is no component or block {shown(first)}" if rest else f"there is no parameter {shown(name)}"
    )
    names = f"Known: {listing(known)}." if known else "The netlist declares no parameters."
    blocks = [block for block, keys in KEYS.items() if name in keys]
    meant = " or ".join(f"{block}.{name}" for block in blocks)
    near = f"Did you mean {meant}?" if meant else did_you_mean(first, known)
    return Fault(PLACE, f"{shown(name)}: {what}", f"{near} {names}".strip())


def _sample(component: Value) -> str:
    return next((name for name in component.entries if name != "type"), "parameter")


def _block(tree: Value, name: str) -> Mapping[str, Value]:
    return tree.entries[name].entries if name in tree.entries else {}
