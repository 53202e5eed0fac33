"""Stacks of blocks with friction between them, drawn at random: what tests of what rests work on."""

from __future__ import annotations

import itertools
from typing import NamedTuple

import networkx as nx
import numpy as np

FLOOR = 0


class Stack(NamedTuple):
    """Blocks 1, 2 ... on a floor 0, each on one that was drawn before it, and springs between some of them."""

    blocks: int
    contacts: dict[str, tuple[int, int]]
    springs: dict[str, tuple[int, int]]

    def text(self, order=lambda lines: lines):
        """The netlist, with its components and its connections in another order."""
        parts = ["n0: {type: Ground}", *(f"n{k}: {{type: Mass, mass: {k} kg}}" for k in range(1, self.blocks + 1))]
        joined = [[f"n{k}.flange"] for k in range(self.blocks + 1)]
        for kind, ties in (("Contact, normal_force: 10 N, curve: 0.5", self.contacts),
                           ("Spring, stiffness: 100 N/m", self.springs)):  # fmt: skip
            for name, (a, b) in ties.items():
                parts.append(f"{name}: {{type: {kind}}}")
                joined[a].append(f"{name}.a")
                joined[b].append(f"{name}.b")
        joins = [f"[{', '.join(ports)}]" for ports in joined if len(ports) > 1]
        lines = ["components:", *(f"  {one}" for one in order(parts))]
        lines += ["connections:", *(f"  - {one}" for one in order(joins))]
        return "\n".join([*lines, "friction: {method: hold}", "run: {stop: 1 s}"])


def drawn(seed, blocks=7):
    """A stack, and chance to go on with."""
    chance = np.random.default_rng(seed)
    contacts = {f"c{k}": (int(chance.integers(0, k)), k) for k in range(1, blocks + 1)}
    pairs = [pair for pair in itertools.combinations(range(1, blocks + 1), 2) if chance.random() < 0.15]
    return Stack(blocks, contacts, {f"s{k}": pair for k, pair in enumerate(pairs)}), chance


def hold(system, held):
    """Let these contacts hold, and all others slide."""
    for machine, zone in system.memory["holds"]:
        system.zones[machine] = zone if system.machine_names[machine] in held else (1 if zone != 1 else 0)


def standing(stack, held, moving=()):
    """Blocks that a path of contacts that hold leads to from the floor, over none that moves."""
    graph = nx.Graph([stack.contacts[name] for name in held])
    graph.add_node(FLOOR)
    graph.remove_nodes_from(moving)
    return nx.node_connected_component(graph, FLOOR) - {FLOOR}
