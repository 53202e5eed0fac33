"""What depends on what, by the facts of the laws: against what changes when every unknown is moved by itself."""

from __future__ import annotations

import networkx as nx
import numpy as np
import pytest

from fairlead.system.active.dependences import dependences, laws
from fairlead.system.active.entrained import nothing_entrained
from fairlead.system.active.partition import Partition
from fairlead.system.active.subsystem import _own_unknowns
from fairlead.system.arrays.portions import portions
from fairlead.system.compiled.asking import call, guards_at
from tests.callbacks import Called
from tests.unit.stacks import drawn, hold

SEEDS = range(4)
BENT = '''
    class Bent(Component):
        """A force that goes with the square of a stretch, and ends by two guards."""

        a = Translational("one end")
        b = Translational("the other")
        most = Parameter("m", "Stretch at which it ends.")
        stiff = Parameter("N/m^2", "Force over the square of the stretch.", default=3.0)
        zones = Zones("whole", "torn")

        @zone("whole")
        def whole(p, a, b):
            """Stretched."""
            force = p.stiff * (b.x - a.x) ** 2
            return Law(a=-force, b=force, dissipated=0)

        @zone("torn")
        def torn(p):
            """Nothing."""
            return Law(a=0, b=0, dissipated=0)

        @guard("whole", to="torn", unit="m")
        def tears(p, a, b):
            """Too long."""
            return b.x - a.x - p.most

        @guard("whole", to="torn", unit="m")
        def slips_off(p, a):
            """Too far."""
            return 2 * a.x - 5 * p.most


    class Ear(Component):
        """Hears a speed."""

        port = Translational("a body")
        heard = Output("m/s", "Its speed.")

        def law(p, port):
            """Takes nothing."""
            return Law(port=0, heard=port.v)


    class Less(Component):
        """The difference of two."""

        one = Input("m/s", "From this.")
        other = Input("m/s", "This is taken.")
        left = Output("m/s", "What is left.")

        def law(p, one, other):
            """One less the other."""
            return Law(left=one - other)


    class Slower(Component):
        """A force by a signal."""

        port = Translational("a body")
        by = Input("m/s", "By what.")
        strength = Parameter("N*s/m", "Force over it.", default=4.0)

        def law(p, port, by):
            """In proportion."""
            return Law(port=p.strength * by, supplied=0)

'''
SIGNALS = """
    components:
      a: {type: Mass, mass: 1 kg}
      b: {type: Mass, mass: 2 kg}
      c: {type: Mass, mass: 3 kg}
      d: {type: Mass, mass: 3 kg}
      ear_a: {type: Ear}
      ear_b: {type: Ear}
      ear_c: {type: Ear}
      first: {type: Less}
      second: {type: Less}
      brake: {type: Slower}
      early: {type: Slower}
    connections:
      - [a.flange, ear_a.port]
      - [b.flange, ear_b.port, early.port]
      - [c.flange, ear_c.port]
      - [d.flange, brake.port]
      - [ear_a.heard, first.one]
      - [ear_b.heard, first.other]
      - [first.left, second.one, early.by]
      - [ear_c.heard, second.other]
      - [second.left, brake.by]
    run: {stop: 1 s}
"""
CHAIN = """
    components:
      a: {type: Mass, mass: 1 kg}
      b: {type: Mass, mass: 2 kg}
      c: {type: Mass, mass: 3 kg}
      ab: {type: Bent, most: 2 m}
      bc: {type: Bent, most: 3 m}
      lean: {type: Spring, stiffness: 10 N/m}
    connections:
      - [a.flange, ab.a]
      - [ab.b, b.flange, bc.a, lean.a]
      - [bc.b, c.flange, lean.b]
    run: {stop: 1 s}
"""


def found_of(system, y):
    """The laws and what depends on what, as they are at y with nothing entrained."""
    of = laws(system)
    return of, dependences(system, of, nothing_entrained(system), guards_at(system, 0.0, y))


def forces(system, y):
    """All rows that laws add to, and the signals."""
    call(system, "rhs", 0.0, y, np.zeros(system.n))
    memory, numbering = system.memory, system.numbering
    return np.concatenate([memory["w"][: system.n], memory["z"][system.n : numbering.first_reaction]])


def moved_rows(system, y, chance):
    """Pairs (unknown, row or signal) such that moving the unknown alone changes that."""
    pairs = set()
    for _ in range(2):
        base = y + chance.uniform(-1e-2, 1e-2, system.n)
        before = forces(system, base)
        for k in range(system.n):
            other = base.copy()
            other[k] += 1e-2
            now = forces(system, other)
            pairs |= {(k, int(j)) for j in np.flatnonzero(np.abs(now - before) > 1e-12)}
    kinematic = {x for x, _ in system.numbering.pairs}
    return {(k, j) for k, j in pairs if j not in kinematic and not (j < system.n and system.quadrature[j])}


def told_rows(system, of, found):
    """The same by what was found: signals hand on what they depend on, and rows of the ledger do not count."""
    graph = nx.DiGraph()
    graph.add_nodes_from(("z", k) for k in range(system.numbering.dump + 1))
    for value, place in zip(found.value.tolist(), found.value_z.tolist(), strict=True):
        if of.gives[value] >= 0:
            graph.add_edge(("z", place), ("z", int(of.gives[value])))
        elif 0 <= of.row[value] < system.n:
            graph.add_edge(("z", place), ("w", int(of.row[value])))
    pairs = set()
    for k in range(system.n):
        for kind, j in nx.descendants(graph, ("z", k)):
            if kind == "w" or system.n <= j < system.numbering.first_reaction:
                pairs.add((k, j))
    kinematic = {x for x, _ in system.numbering.pairs}
    return {(k, j) for k, j in pairs if j not in kinematic and not (j < system.n and system.quadrature[j])}


@pytest.mark.parametrize("seed", SEEDS)
def test_forces_of_a_stack_depend_on_what_changes_them(scene, seed):
    """Springs on both places, contacts that hold on speeds, those that slide on themselves alone."""
    stack, chance = drawn(seed)
    system = scene(stack.text()).system.instance()
    y = chance.uniform(-1, 1, system.n)
    for share in (0.0, 0.5, 1.0):
        hold(system, [name for name in stack.contacts if chance.random() < share])
        assert told_rows(system, *found_of(system, y)) == moved_rows(system, y, chance)


@pytest.mark.parametrize("torn", [(), (0,), (1,), (0, 1)])
def test_forces_of_bent_springs_depend_on_their_ends_until_they_are_torn(scene, library, torn):
    """With a straight spring beside one of them."""
    system = scene(CHAIN, (library(BENT),)).system.instance()
    chance = np.random.default_rng(2)
    block = next(one for one in system.blocks if one.kernel.variant.type.__name__ == "Bent")
    for k in torn:
        system.zones[block.machines[k, 0]] = 1
    y = chance.uniform(-1, 1, system.n)
    of, found = found_of(system, y)
    assert told_rows(system, of, found) == moved_rows(system, y, chance)
    assert {system.machine_names[m] for m in system.memory["guard_machines"]} == {"ab", "bc"}


def test_signals_hand_on_what_they_depend_on(scene, library):
    """Speeds of three bodies, through two differences, to the forces on a fourth and on the second."""
    system = scene(SIGNALS, (library(BENT),)).system.instance()
    chance = np.random.default_rng(3)
    y = chance.uniform(-1, 1, system.n)
    found = told_rows(system, *found_of(system, y))
    assert found == moved_rows(system, y, chance)
    named = {(system.unknown_names[k], system.unknown_names[j]) for k, j in found if j < system.n}
    assert named == {("a.v", "d.v"), ("b.v", "d.v"), ("c.v", "d.v"), ("a.v", "b.v"), ("b.v", "b.v")}


def test_guards_that_are_one_place_change_with_it_as_fast_as_they_are_said_to(scene, library):
    """Slopes by differences; guards of two places are told with both, and only those of one are straight."""
    system = scene(CHAIN, (library(BENT),)).system.instance()
    chance = np.random.default_rng(4)
    y = chance.uniform(-1, 1, system.n)
    _, found = found_of(system, y)
    wanted = {}
    for k in range(system.n):
        other = y.copy()
        other[k] += 0.5
        slope = (guards_at(system, 0.0, other) - guards_at(system, 0.0, y)) / 0.5
        wanted |= {(int(g), k): slope[g] for g in np.flatnonzero(np.abs(slope) > 1e-9)}
    told = {
        (int(found.members.guard[member]), int(place)): float(slope)
        for member, place, slope in zip(found.member, found.member_z, found.slope, strict=True)
    }
    assert told.keys() == wanted.keys()
    for pair, slope in wanted.items():
        assert told[pair] == pytest.approx(slope)
    assert found.members.now == pytest.approx(guards_at(system, 0.0, y)[found.members.guard])
    of_guard = {}
    for guard, _ in wanted:
        of_guard[guard] = of_guard.get(guard, 0) + 1
    straight = {int(g) for g, s in zip(found.members.guard, found.members.straight, strict=True) if s}
    assert straight == {g for g, places in of_guard.items() if places == 1}


@pytest.mark.parametrize("ratio", [0.5, 1.0, 3.0])
def test_two_ends_that_follow_one_place_count_once_with_what_is_left_of_both(scene, library, ratio):
    """b goes ratio times as far as a: a guard on their distance changes by ratio - 1, or not at all."""
    system = scene(CHAIN, (library(BENT),)).system.instance()
    a, b = (system.unknown_names.index(name) for name in ("a.x", "b.x"))
    along = nothing_entrained(system)
    along.place[b], along.ratio[b] = a, ratio
    found = dependences(system, laws(system), along, guards_at(system, 0.0, np.zeros(system.n)))
    owner = [system.machine_names[m] for m in system.memory["guard_machines"]]
    told = sorted(
        (owner[found.members.guard[member]], system.unknown_names[place], float(slope))
        for member, place, slope in zip(found.member, found.member_z, found.slope, strict=True)
    )
    of_ab = [("ab", "a.x", ratio - 1.0)] if ratio != 1.0 else []  # its length
    wanted = [*of_ab, ("ab", "a.x", 2.0), ("bc", "a.x", -ratio), ("bc", "c.x", 1.0), ("bc", "a.x", 2 * ratio)]
    assert told == sorted(wanted)


@pytest.mark.parametrize("seed", SEEDS)
def test_with_nothing_entrained_only_what_is_a_components_own_may_be_a_number(scene, seed):
    """Bodies move in any case, and forces of contacts that hold with them; of one that slides it is what it is.

    Of df/dy nothing is left in the rows of what is left out but what these unknowns have to do with each other.
    """
    stack, chance = drawn(seed)
    system = scene(stack.text()).system.instance()
    held = [name for name in stack.contacts if chance.random() < 0.5]
    hold(system, held)
    y = chance.uniform(-1, 1, system.n)
    found = Partition(system, laws(system), nothing_entrained(system), 3, 0.0, y)
    left_out = {system.unknown_names[k] for k in np.flatnonzero(~found.kept)}
    assert left_out <= {f"{name}.force" for name in stack.contacts if name not in held}
    assert found.hindered() == set()
    slopes = Called(system).jacobian(0.0, y)[0]
    assert not slopes[~found.kept][:, found.kept].any()
    moving = found.moving()
    part = system.subsystem.part(0.0, y, moving)
    later = y + np.where(moving.kept & ~system.quadrature, chance.uniform(-0.1, 0.1, system.n), 0.0)
    f, mine = np.zeros(system.n), np.zeros(part.problem.n)
    call(system, "rhs", 0.0, later, f)
    call(part.problem, "rhs", 0.0, later[part.unknowns], mine)
    np.testing.assert_allclose(mine, f[part.unknowns], rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_laws_bring_the_unknowns_that_are_their_own(scene, seed):
    """Contacts their force, springs nothing: for laws drawn at random."""
    stack, chance = drawn(seed)
    system = scene(stack.text()).system.instance()
    chosen = [chance.random(block.count) < 0.5 for block in system.blocks]
    wanted = {
        f"{block.instances[k].path}.force"
        for block, some in zip(system.blocks, chosen, strict=True)
        for k in np.flatnonzero(some)
        if block.instances[k].path in stack.contacts
    }
    found = _own_unknowns(system, chosen)
    assert {system.unknown_names[k] for k in np.flatnonzero(found)} == wanted


@pytest.mark.parametrize("seed", SEEDS)
def test_every_number_of_a_vector_belongs_to_one_block(scene, seed):
    """Portions follow each other without a gap: counted one by one."""
    stack, _ = drawn(seed)
    system = scene(stack.text()).system.instance()
    found, end = portions(system.blocks)
    counts = {
        "guards": lambda s: s.slots, "outputs": lambda s: len(s.all_outputs), "swings": lambda s: len(s.swings),
    }  # fmt: skip
    for name, width in counts.items():
        sizes = [block.count * width(block.kernel.structure) for block in system.blocks]
        owners = [k for k, size in enumerate(sizes) for _ in range(size)]
        for k, portion in enumerate(found):
            assert getattr(portion, name) == sum(1 for one in owners if one < k)
        assert getattr(end, name) == len(owners)
    taken = [0]  # the constant 1
    for block, portion in zip(system.blocks, found, strict=True):
        s = block.kernel.structure
        begins = (portion.signals, portion.flows, portion.ledger, portion.mass)
        for first, pairs in zip(begins, (s.d_signals, s.d_flows, s.d_ledger, s.mass), strict=True):
            taken += range(first, first + block.count * len(pairs))
    assert taken == list(range(end.mass))
