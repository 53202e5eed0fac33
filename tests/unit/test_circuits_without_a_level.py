"""Circuits drawn at random: which of their parts have no level, against the graph of what resistors join."""

from __future__ import annotations

import contextlib
import itertools

import networkx as nx
import numpy as np
import pytest

from fairlead.errors import ModelError
from fairlead.system import compile as compiling
from fairlead.system.assembly.common_level import without_level

PAIRS = 4


@pytest.fixture
def levelless(scene, monkeypatch):
    """levelless(text) -> the parts of the circuit without a level: nodes by what is plugged in, coils around."""
    asked = []
    ask = compiling.undetermined

    def listen(flat, numbering, blocks):
        asked.append((flat, blocks))
        return ask(flat, numbering, blocks)

    monkeypatch.setattr(compiling, "undetermined", listen)

    def make(text):
        asked.clear()
        model = scene(text)
        with contextlib.suppress(ModelError):
            _ = model.system
        flat, blocks = asked[-1]
        found = []
        for one in without_level(flat, blocks):
            ports = [flat.nodes[node].ports for group in one.groups for node in flat.groups[group].nodes]
            found.append((frozenset(f"{p.instance}.{p.port}" for some in ports for p in some), frozenset(one.keeping)))
        return found

    return make


@pytest.mark.parametrize("seed", range(15))
def test_a_part_has_a_level_where_resistors_lead_to_an_earth(levelless, seed):
    """Coils lead nowhere: their current is what it is."""
    chance = np.random.default_rng(seed)
    count = 2 * PAIRS
    resistors = 2 * [(2 * k, 2 * k + 1) for k in range(PAIRS)]
    resistors += [pair for pair in itertools.combinations(range(count), 2) if chance.random() < 0.08]
    coils = [pair for pair in itertools.combinations(range(count), 2) if chance.random() < 0.15]
    earths = [k for k in range(count) if chance.random() < 0.15]
    parts, joined = [], [[] for _ in range(count)]
    for kind, pairs in (("Resistor, resistance: 2 ohm", resistors), ("Inductor, inductance: 1 H", coils)):
        for k, (a, b) in enumerate(pairs):
            name = f"{kind[0].lower()}{k}"
            parts.append(f"{name}: {{type: {kind}}}")
            joined[a].append(f"{name}.plus")
            joined[b].append(f"{name}.minus")
    for k in earths:
        parts.append(f"earth{k}: {{type: Earth}}")
        joined[k].append(f"earth{k}.terminal")
    lines = ["components:", *(f"  {one}" for one in parts), "connections:"]
    lines += [f"  - [{', '.join(ports)}]" for ports in joined if len(ports) > 1]
    graph = nx.Graph()
    graph.add_nodes_from(range(count))
    graph.add_edges_from(resistors)
    wanted = []
    for some in nx.connected_components(graph):
        if some.isdisjoint(earths):
            ports = frozenset(port for k in some for port in joined[k])
            keeping = frozenset(f"i{k}" for k, (a, b) in enumerate(coils) if a in some or b in some)
            wanted.append((ports, keeping))
    found = levelless("\n".join([*lines, "run: {stop: 1 s}"]))
    assert set(found) == set(wanted)
    assert len(found) == len(wanted)
