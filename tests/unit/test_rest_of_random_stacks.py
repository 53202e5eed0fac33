"""What rests of stacks drawn at random: against the paths of contacts that hold, and what balances leave open."""

from __future__ import annotations

import itertools

import networkx as nx
import numpy as np
import pytest

from fairlead.system.active.rest import anatomy, at_rest, leaning_on
from tests.unit.stacks import FLOOR, drawn, hold, standing

SEEDS = range(4)


def resting(system, y):
    """Names of what rests, and the evidence for it."""
    found = at_rest(anatomy(system), system, y)
    return {system.unknown_names[k] for k in np.flatnonzero(found.still)}, found


def carrying_the_same(stack, still, chance):
    """Contacts whose force is nought in every change of forces and places that the balances of what stands allow.

    A contact with blocks beside it that move may carry anything; a sliding one between two that stand is no different
    from any other law: it says what its force is by their speeds.
    """
    names = list(stack.contacts)
    swings = [name for name, ends in stack.springs.items() if not set(ends) <= still]
    columns = {name: k for k, name in enumerate([*names, *swings])}
    rows = []
    for block in still:
        row = np.zeros(len(columns))
        for ties in (stack.contacts, {name: stack.springs[name] for name in swings}):
            for name, ends in ties.items():
                row[columns[name]] = chance.uniform(1, 2) if block in ends else 0.0
        rows.append(row)
    return names, columns, rows


def forces_at_rest(stack, held, still, chance):
    """Contacts of which no change of force agrees with the equations."""
    names, columns, rows = carrying_the_same(stack, still, chance)
    for name in set(names) - set(held):
        if set(stack.contacts[name]) <= still | {FLOOR}:  # it slides between two that stand
            rows.append(np.eye(len(columns))[columns[name]])
    if not rows:
        return set()
    _, sizes, modes = np.linalg.svd(np.array(rows))
    left = modes[np.count_nonzero(sizes > 1e-9) :]
    return {name for name in names if np.abs(left[:, columns[name]]).max(initial=0.0) < 1e-9}


@pytest.mark.parametrize("seed", SEEDS)
def test_a_block_rests_where_contacts_that_hold_lead_to_the_floor(scene, seed):
    """And of forces those rest that the balances leave no other value; for contacts drawn to hold, ten times each."""
    stack, chance = drawn(seed)
    system = scene(stack.text()).system.instance()
    for share in np.linspace(0.5, 1.0, 10):
        held = [name for name in stack.contacts if chance.random() < share]
        hold(system, held)
        still = standing(stack, held)
        wanted = {f"n{k}.{one}" for k in still for one in "xv"}
        wanted |= {f"{name}.force" for name in forces_at_rest(stack, held, still, chance)}
        assert resting(system, np.zeros(system.n))[0] == wanted


@pytest.mark.parametrize("seed", SEEDS)
def test_what_stands_on_a_block_with_a_speed_does_not_rest(scene, seed):
    """A block that is held with a slip left over is as if it were not there."""
    stack, chance = drawn(seed)
    system = scene(stack.text()).system.instance()
    hold(system, stack.contacts)
    for moving in range(1, stack.blocks + 1):
        y = np.zeros(system.n)
        y[system.unknown_names.index(f"n{moving}.v")] = chance.uniform(1e-3, 1.0)
        still = standing(stack, stack.contacts, (moving,))
        found = resting(system, y)[0]
        assert {name for name in found if name.startswith("n")} == {f"n{k}.{one}" for k in still for one in "xv"}


@pytest.mark.parametrize("seed", SEEDS)
def test_what_a_block_leans_on_is_the_way_from_it_to_the_floor(scene, seed):
    """Each of several together lean on all of their ways."""
    stack, chance = drawn(seed)
    system = scene(stack.text()).system.instance()
    held = [name for name in stack.contacts if chance.random() < 0.8]
    hold(system, held)
    _, found = resting(system, np.zeros(system.n))
    graph = nx.Graph([(*stack.contacts[name], {"name": name}) for name in held])
    ways = {}
    for block in standing(stack, held):
        way = nx.shortest_path(graph, block, FLOOR)
        ways[block] = {graph.edges[pair]["name"] for pair in itertools.pairwise(way)}
    for size in (1, 2):
        for some in itertools.combinations(ways, size):
            which = np.isin(system.unknown_names, [f"n{k}.x" for k in some])
            leans = leaning_on(found, which, len(system.zones))
            assert {system.machine_names[k] for k in np.flatnonzero(leans)} == set.union(*(ways[k] for k in some))


@pytest.mark.parametrize("seed", SEEDS)
def test_whatever_rests_goes_on_resting_when_something_lets_go_that_it_does_not_lean_on(scene, seed):
    """And ceases to rest when something does that it leans on: each contact is let go by itself."""
    stack, _ = drawn(seed)
    system = scene(stack.text()).system.instance()
    hold(system, stack.contacts)
    names, found = resting(system, np.zeros(system.n))
    leans = {}
    for name in names:
        some = leaning_on(found, np.array(system.unknown_names) == name, len(system.zones))
        leans[name] = {system.machine_names[k] for k in np.flatnonzero(some)}
    for contact in stack.contacts:
        hold(system, set(stack.contacts) - {contact})
        left = resting(system, np.zeros(system.n))[0]
        assert left == {name for name in names if contact not in leans[name]}


@pytest.mark.parametrize("seed", SEEDS)
def test_what_rests_does_not_depend_on_the_order_of_a_netlist(scene, seed):
    """Components and connections the other way round, and shuffled."""
    stack, chance = drawn(seed)
    held = [name for name in stack.contacts if chance.random() < 0.8]
    found = []
    for order in (list, lambda lines: lines[::-1], chance.permutation):
        system = scene(stack.text(order)).system.instance()
        hold(system, held)
        found.append(resting(system, np.zeros(system.n))[0])
    assert found[0] == found[1] == found[2]


def test_a_block_without_speed_that_a_constant_force_pulls_does_not_rest(scene, library):
    """Nothing in its balance varies but its speed, and that is zero now; it will not be."""
    weight = library('''
        class Hung(Component):
            """A constant force."""

            port = Translational("a body")
            force = Parameter("N", "The force.", default=5.0)

            def law(p, port):
                """Always the same."""
                return Law(port=-p.force, supplied=p.force * port.v)

    ''')  # fmt: skip
    text = """
        components:
          floor: {type: Ground}
          held: {type: Mass, mass: 1 kg}
          loose: {type: Mass, mass: 1 kg}
          one: {type: Hung}
          other: {type: Hung}
          pad: {type: Contact, normal_force: 30 N, curve: 0.5}
        connections:
          - [floor.flange, pad.a]
          - [pad.b, held.flange, one.port]
          - [loose.flange, other.port]
        friction: {method: hold}
        run: {stop: 1 s}
    """
    system = scene(text, (weight,)).system.instance()
    hold(system, ["pad"])
    assert resting(system, np.zeros(system.n))[0] == {"held.x", "held.v", "pad.force"}
