"""The same scene in another order."""

from __future__ import annotations

import dataclasses
import random

import yaml

from tests.invariance.renaming import entry, text_of


def shuffled(text: str, seed: int) -> str:
    """The netlist with its components, its connections and the ends of each connection in another order."""
    draw, tree = random.Random(seed), yaml.compose(text)
    connections = entry(tree, "connections")
    draw.shuffle(entry(tree, "components").value)
    draw.shuffle(connections.value)
    for ends in connections.value:
        draw.shuffle(ends.value)
    return text_of(tree)


def permuted(flat, seed: int):
    """The flat model with its instances and its groups in another order.

    Unknowns are numbered along the groups, contacts and guards along the instances, so the compiled model has all of
    them in another order.
    """
    draw = random.Random(seed)
    instances, order = list(flat.instances), list(range(len(flat.groups)))
    draw.shuffle(instances)
    draw.shuffle(order)
    place = {old: new for new, old in enumerate(order)}
    return dataclasses.replace(
        flat, instances=tuple(instances), groups=tuple(flat.groups[k] for k in order),
        group_of={node: (place[k], ratio, offset) for node, (k, ratio, offset) in flat.group_of.items()},
    )  # fmt: skip
