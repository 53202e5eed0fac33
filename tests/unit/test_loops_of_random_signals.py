"""Signals that depend on each other at random: against the circles of the graph, and a system of linear equations."""

from __future__ import annotations

import networkx as nx
import numpy as np
import pytest

from tests.callbacks import Called

MIXERS = '''
    class Mixer(Component):
        """A sum of two signals and a number."""

        one = Input("1", "The first.")
        other = Input("1", "The second.")
        much = Parameter("1", "How much of the first.")
        more = Parameter("1", "How much of the second.")
        level = Parameter("1", "What is added.")
        signal = Output("1", "The sum.")

        def law(p, one, other):
            """At once."""
            return Law(signal=p.much * one + p.more * other + p.level)

'''
COUNT = 7


@pytest.fixture
def mixed(scene, library):
    """mixed(seed) -> a System of mixers that read each other, the gains as a matrix, and what each adds."""

    def make(seed, order=list):
        chance = np.random.default_rng(seed)
        gains, level = np.zeros((COUNT, COUNT)), chance.uniform(-1, 1, COUNT).round(3)
        parts = ["floor: {type: Ground}", "body: {type: Mass, mass: 1 kg}", "brake: {type: Damper, damping: 1 N*s/m}"]
        joins = {k: [f"m{k}.signal"] for k in range(COUNT)}
        for k in range(COUNT):
            much, more = (chance.uniform(0.1, 0.9, 2) * chance.choice([-1, 1], 2)).round(3)
            of_mixer = f"{{type: Mixer, much: {much}, more: {more}, level: {level[k]}}}"
            parts.append(f"m{k}: {of_mixer}")
            for port, gain in (("one", much), ("other", more)):
                source = int(chance.integers(0, COUNT))
                gains[k, source] += gain
                joins[source].append(f"m{k}.{port}")
        lines = ["components:", *(f"  {one}" for one in order(parts)), "connections:"]
        lines += [f"  - [{', '.join(ports)}]" for ports in order([*joins.values()]) if len(ports) > 1]
        lines += ["  - [floor.flange, brake.a]", "  - [brake.b, body.flange]"]
        model = scene("\n".join([*lines, "run: {stop: 1 s}"]), (library(MIXERS),))
        return model.system, gains, level

    return make


def solved(system):
    """By mixer its signal where the equations of all loops hold, found with one step of Newton's method from zero."""
    called = Called(system)
    y = called.system.initial.copy()
    algebraic = np.flatnonzero(~called.system.differential)
    if len(algebraic):
        y[algebraic] = 0.0
        slopes = called.jacobian(0.0, y)[0][np.ix_(algebraic, algebraic)]
        y[algebraic] = -np.linalg.solve(slopes, called.rhs(0.0, y)[algebraic])
    f = called.rhs(0.0, y)
    assert np.abs(f[algebraic]).max(initial=0.0) < 1e-12
    numbering, z = called.system.numbering, called.system.memory["z"]
    return {output.instance: z[called.n + k] for output, k in numbering.signals.items()}


@pytest.mark.parametrize("seed", range(12))
def test_signals_in_loops_are_the_solution_of_their_equations(mixed, seed):
    """Of  signal = gains signal + level, all at once."""
    system, gains, level = mixed(seed)
    wanted = np.linalg.solve(np.eye(COUNT) - gains, level)
    found = solved(system)
    used = {k for k in range(COUNT) if gains[:, k].any()}
    assert {f"m{k}" for k in used} <= found.keys()
    for k in used:
        assert found[f"m{k}"] == pytest.approx(wanted[k], rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("seed", range(12))
def test_every_cut_is_in_a_circle_and_together_they_leave_none(mixed, seed):
    """Circles of a graph in which an arrow leads from each mixer to those that read it."""
    system, gains, _ = mixed(seed)
    graph = nx.DiGraph((f"m{j}", f"m{k}") for k, j in np.argwhere(gains))
    cuts = system.flat.loops
    assert bool(cuts) == (not nx.is_directed_acyclic_graph(graph))
    for loop in cuts:
        assert loop.through[0] == loop.output.instance
        nx.find_cycle(graph.subgraph(loop.through))
        ways = zip(loop.through, (*loop.through[1:], loop.through[0]), strict=True)
        assert all(graph.has_edge(a, b) for a, b in ways)
        graph.remove_edges_from([*graph.out_edges(loop.output.instance)])
    assert nx.is_directed_acyclic_graph(graph)
    rank = {block.instances[k].path: r for block in system.blocks for k, r in enumerate(block.ranks)}
    read = {f"m{k}" for k in range(COUNT) if gains[:, k].any()}
    assert all(rank[a] < rank[b] for a, b in graph.edges if b in read)


@pytest.mark.parametrize("seed", range(4))
def test_signals_in_loops_do_not_depend_on_the_order_of_a_netlist(mixed, seed):
    """Another output may be cut, and all signals are the same."""
    one, other = solved(mixed(seed)[0]), solved(mixed(seed, lambda lines: lines[::-1])[0])
    for path in {name for name in one if "." not in name}:
        assert one[path] == pytest.approx(other[path], rel=1e-9, abs=1e-12)
