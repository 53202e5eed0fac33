"""Parts cut out of stacks drawn at random: against the whole with what rests held fast, and every contact let go."""

from __future__ import annotations

import itertools

import networkx as nx
import numpy as np
import pytest

from fairlead.system.active.rest import Rest, anatomy, at_rest
from fairlead.system.active.subsystem import _as_whole_rows, _with_margin
from fairlead.system.compiled.asking import call, guards_at
from tests.callbacks import Called
from tests.unit.stacks import drawn, hold, standing

SEEDS = range(4)
MARGINS = (0, 2)


@pytest.fixture
def cut(scene):
    """cut(seed, margin) -> a stack and chance, its System of which some blocks slide, its unknowns, what moves there.

    Blocks that stand have no speed; all others have some, and every block is away from zero.
    """

    def make(seed, margin, order=list):
        stack, chance = drawn(seed)
        system = scene(stack.text(order)).system.instance()
        held = [name for name in stack.contacts if chance.random() < 0.75]
        hold(system, held)
        y, still = np.zeros(system.n), standing(stack, held)
        for k in range(1, stack.blocks + 1):
            y[system.unknown_names.index(f"n{k}.x")] = chance.uniform(-1, 1)
            y[system.unknown_names.index(f"n{k}.v")] = 0.0 if k in still else chance.uniform(0.1, 1)
        for name in stack.contacts:
            y[system.unknown_names.index(f"{name}.force")] = chance.uniform(-5, 5)
        return stack, chance, system, y, system.subsystem.moving(0.0, y, margin, 1.0)

    return make


def moved_on(system, y, moving, chance):
    """The unknowns some time later: only what is kept has changed."""
    return y + np.where(moving.kept & ~system.quadrature, chance.uniform(-0.1, 0.1, system.n), 0.0)


@pytest.mark.parametrize("margin", MARGINS)
@pytest.mark.parametrize("seed", SEEDS)
def test_a_part_has_the_equations_of_the_whole_with_what_rests_held_fast(cut, seed, margin):
    """Rates and balances, their derivatives, inertias and guards, wherever it goes."""
    _, chance, system, y, moving = cut(seed, margin)
    part = system.subsystem.part(0.0, y, moving)
    one, other, kept = Called(part.problem), Called(system), part.unknowns
    np.testing.assert_array_equal(kept, np.flatnonzero(moving.kept))
    for _ in range(2):
        later = moved_on(system, y, moving, chance)
        mine = later[kept]
        np.testing.assert_allclose(one.rhs(0.5, mine), other.rhs(0.5, later)[kept], rtol=1e-12, atol=1e-12)
        (of_part, by_time), (of_whole, whole_by_time) = one.jacobian(0.5, mine), other.jacobian(0.5, later)
        np.testing.assert_allclose(of_part, of_whole[np.ix_(kept, kept)], rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(by_time, whole_by_time[kept], rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(one.mass(), other.mass()[np.ix_(kept, kept)], rtol=1e-12, atol=1e-12)
        np.testing.assert_allclose(
            guards_at(part.problem, 0.5, mine), guards_at(system, 0.5, later)[part.guards], rtol=1e-12, atol=1e-12
        )


@pytest.mark.parametrize("margin", MARGINS)
@pytest.mark.parametrize("seed", SEEDS)
def test_equations_that_show_that_something_rests_are_left_out_with_it(cut, seed, margin):
    """For each unknown that is left out there is an equation of its own that is left out too."""
    _, _, system, y, moving = cut(seed, margin)
    rest = at_rest(anatomy(system), system, y)
    assert rest.still[~moving.kept].all()
    shown_by = rest.found_by[~moving.kept]
    assert not moving.kept[shown_by].any()
    assert len(set(shown_by.tolist())) == len(shown_by)


@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_left_out_rests_until_a_contact_of_the_boundary_lets_go(cut, seed):
    """Every contact that holds is let go by itself: those of the boundary, and no other, move what is left out."""
    stack, _, system, y, moving = cut(seed, 1)
    boundary = {system.machine_names[k] for k in np.flatnonzero(moving.boundary)}
    zones = system.zones.copy()
    held = {name for name in stack.contacts if _holds(system, name)}
    assert boundary <= held
    for name in held:
        hold(system, held - {name})
        stays = at_rest(anatomy(system), system, y).still[~moving.kept].all()
        assert stays == (name not in boundary), name
    system.zones[:] = zones


def _holds(system, name):
    """Whether this contact is in the zone in which it holds."""
    machine, zone = next(one for one in system.memory["holds"] if system.machine_names[one[0]] == name)
    return system.zones[machine] == zone


@pytest.mark.parametrize("seed", SEEDS)
def test_a_wider_margin_keeps_what_a_narrower_one_did(cut, seed):
    kept = [cut(seed, margin)[-1].kept for margin in (0, 1, 2, 4, 8)]
    for narrow, wide in itertools.pairwise(kept):
        assert wide[narrow].all()


@pytest.mark.parametrize("margin", MARGINS)
@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_kept_does_not_depend_on_the_order_of_a_netlist(cut, seed, margin):
    """The same unknowns, contacts and boundary, by name."""
    found = []
    for order in (list, lambda lines: lines[::-1]):
        _, _, system, _, moving = cut(seed, margin, order)
        names, machines = np.array(system.unknown_names), np.array(system.machine_names)
        found.append([set(names[moving.kept]), set(machines[moving.machines]), set(machines[moving.boundary])])
    assert found[0] == found[1]


@pytest.mark.parametrize("seed", SEEDS)
def test_a_whole_is_given_back_what_its_part_has_become(cut, seed):
    """What is kept as the part has it; what rests as it was."""
    _, chance, system, y, moving = cut(seed, 1)
    part = system.subsystem.part(0.0, y, moving)
    later = moved_on(system, y, moving, chance)
    wanted, given = later.copy(), later.copy()
    part.prolong(0.5, given)
    np.testing.assert_array_equal(given, wanted)
    slopes = chance.uniform(-1, 1, system.n)
    before = slopes.copy()
    part.carry(slopes)
    np.testing.assert_array_equal(slopes, before)  # nothing is carried


@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_recorded_of_a_part_is_what_the_whole_would_record(cut, seed):
    """All outputs, those of what rests too."""
    _, chance, system, y, moving = cut(seed, 1)
    part = system.subsystem.part(0.0, y, moving)
    later = moved_on(system, y, moving, chance)
    of_part, of_whole = np.zeros(system.n_outputs), np.zeros(system.n_outputs)
    call(part.problem, "outputs", 0.5, later[part.unknowns], of_part)
    call(system, "outputs", 0.5, later, of_whole)
    np.testing.assert_allclose(of_part, of_whole, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("seed", range(20))
def test_a_margin_is_a_distance_between_unknowns_over_shared_entries(seed):
    """As networkx counts steps from the nearest that moves, in a matrix drawn at random."""
    chance = np.random.default_rng(seed)
    n = int(chance.integers(2, 15))
    row, column = (chance.integers(0, n, int(chance.integers(1, 2 * n))) for _ in range(2))
    size = min(len(row), len(column))
    row, column = row[:size], column[:size]
    moving = chance.random(n) < 0.2
    graph = nx.Graph()
    graph.add_nodes_from(range(n))
    graph.add_edges_from(zip(row.tolist(), column.tolist(), strict=True))
    sources = np.flatnonzero(moving).tolist()
    away = nx.multi_source_dijkstra_path_length(graph, sources) if sources else {}
    for margin in range(6):
        found = _with_margin(moving, margin, row, column)
        assert set(np.flatnonzero(found).tolist()) == {k for k, far in away.items() if far <= margin}


@pytest.mark.parametrize("seed", range(20))
def test_left_out_is_the_largest_set_that_leaves_its_own_equations_out(seed):
    """Of all sets of at most eight unknowns, tried one by one."""
    chance = np.random.default_rng(seed)
    n = 8
    found_by = chance.permutation(n)
    still = chance.random(n) < 0.9
    found_by[~still] = -1
    wished = chance.random(n) < 0.8
    able = wished & still

    def closed(some):
        return all(some[found_by[k]] for k in np.flatnonzero(some))

    sets = [np.array([number >> k & 1 for k in range(n)], dtype=bool) for number in range(2**n)]
    largest = max((some for some in sets if (some <= able).all() and closed(some)), key=np.count_nonzero)
    nothing = np.zeros(0, dtype=np.int64)
    np.testing.assert_array_equal(_as_whole_rows(Rest(still, found_by, nothing, nothing, nothing), wished), largest)
