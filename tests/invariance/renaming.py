"""The same scene under other names: of its components, and of the stations of its routes.

Netlists are changed as trees of YAML, so that every value keeps the way it was written.
"""

from __future__ import annotations

import pathlib
import re
from collections.abc import Callable, Mapping

import yaml

SCHEMES: dict[str, Callable[[int], str]] = {
    "names without digits, in the opposite order": lambda k: "q" + "".join(chr(122 - int(c)) for c in f"{k:03d}"),
    "names that differ in digits only": lambda k: f"x{(37 * k + 11) % 1009:04d}",
}
"""New names from the place in the netlist."""

Tree = yaml.MappingNode


def tree_of(file: pathlib.Path) -> Tree:
    """The netlist in a file with all that it includes, as fairlead merges them: components and connections in turn."""
    tree = yaml.compose(file.read_text("utf-8"))
    assert isinstance(tree, Tree)
    include = entry(tree, "include")
    if include is None:
        return tree
    tree.value = [(key, value) for key, value in tree.value if key.value != "include"]
    for part in (tree_of(file.parent / item.value) for item in include.value):
        for name in ("parameters", "components", "connections"):
            _put_before(tree, name, part)
    return tree


def _put_before(tree: Tree, name: str, part: Tree) -> None:
    own, theirs = entry(tree, name), entry(part, name)
    if theirs is None:
        return
    if own is None:
        tree.value.append((yaml.ScalarNode("tag:yaml.org,2002:str", name), theirs))
    elif isinstance(own, yaml.SequenceNode):
        own.value = [*theirs.value, *own.value]
    else:
        known = {key.value for key, _ in own.value}
        own.value = [*((key, value) for key, value in theirs.value if key.value not in known), *own.value]


def entry(tree: Tree | None, name: str):
    """The value under a key, or None."""
    return next((value for key, value in tree.value if key.value == name), None) if tree is not None else None


def text_of(tree: Tree) -> str:
    """A netlist again."""
    return yaml.serialize(tree, width=10**6, allow_unicode=True)


def renamed(text: str, scheme: Callable[[int], str]) -> tuple[str, Callable[[str], str]]:
    """The netlist under new names, and what turns them back into the old ones."""
    tree = yaml.compose(text)
    components = entry(tree, "components")
    stations = [name for _, component in components.value for name in _station_names(component)]
    parts = {key.value: scheme(k) for k, (key, _) in enumerate(components.value)}
    devices = {name.value: scheme(len(parts) + k) for k, name in enumerate(stations)}
    for key, _ in components.value:
        key.value = parts[key.value]
    for name in stations:
        name.value = devices[name.value]
    for ends in entry(tree, "connections").value:
        for end in ends.value:
            first, *rest = end.value.split(".")  # route.bend_a.shaft: a component, and a device of it
            end.value = ".".join([parts[first], *(devices.get(one, one) for one in rest)])
    return text_of(tree), _replacing({after: before for before, after in (parts | devices).items()})


def _station_names(component: Tree) -> list[yaml.ScalarNode]:
    stations = entry(component, "stations")
    return [name for one in stations.value if (name := entry(one, "name"))] if stations is not None else []


def _replacing(back: Mapping[str, str]) -> Callable[[str], str]:
    """New names are like no other word, so they are found wherever they stand: route.NAME, outer_NAME."""
    pattern = re.compile("|".join(sorted(map(re.escape, back), key=len, reverse=True)))
    return lambda name: pattern.sub(lambda found: back[found[0]], name)
