"""Matchings of unknowns with equations, and contacts in circles, on small random graphs: against plain searches."""

from __future__ import annotations

import itertools
from types import SimpleNamespace

import numpy as np
import pytest
import scipy.sparse
import scipy.sparse.csgraph

from fairlead.system.assembly.matching import unmatched
from fairlead.system.numbering.contact_cycles import REST, HeldPair, circles, moved_apart, numbers


def patterns(seed):
    rng = np.random.default_rng(seed)
    n = int(rng.integers(1, 8))
    return n, [set(np.flatnonzero(rng.random(n) < rng.uniform(0.1, 0.6)).tolist()) for _ in range(n)]


@pytest.mark.parametrize("seed", range(25))
def test_as_many_columns_are_left_over_as_of_a_maximum_matching(seed):
    """Each part has more columns than all of them have rows, and parts have no row in common."""
    n, rows_of = patterns(seed)
    matrix = np.array([[row in rows for row in range(n)] for rows in rows_of], dtype=int)
    most = scipy.sparse.csgraph.maximum_bipartite_matching(scipy.sparse.csr_matrix(matrix), perm_type="column")
    parts = unmatched(rows_of)
    rows = [set().union(*(rows_of[column] for column in part)) for part in parts]
    assert sum(len(part) - len(some) for part, some in zip(parts, rows, strict=True)) == int((most < 0).sum())
    assert all(len(part) > len(some) for part, some in zip(parts, rows, strict=True))
    assert len(set().union(*parts)) == sum(map(len, parts))
    assert len(set().union(*rows)) == sum(map(len, rows))


@pytest.mark.parametrize("seed", range(25))
def test_a_column_is_in_a_part_where_some_maximum_matching_leaves_it_over(seed):
    """Dulmage and Mendelsohn: by leaving out each column in turn."""
    n, rows_of = patterns(seed)

    def size(columns):
        matrix = np.zeros((max(len(columns), 1), n), dtype=int)
        for k, column in enumerate(columns):
            matrix[k, list(rows_of[column])] = 1
        found = scipy.sparse.csgraph.maximum_bipartite_matching(scipy.sparse.csr_matrix(matrix), perm_type="column")
        return int((found >= 0).sum())

    every = list(range(n))
    open_ = {column for column in every if size([c for c in every if c != column]) == size(every)}
    assert set().union(*unmatched(rows_of)) == open_


def network(seed):
    """Bodies on random contacts: slip = a v_1 + b v_2; some bodies stand, some move as given."""
    rng = np.random.default_rng(seed)
    n, m = int(rng.integers(2, 6)), int(rng.integers(1, 7))
    kinds = rng.choice(["free", "given", "stands", "still"], n, p=[0.7, 0.1, 0.1, 0.1])
    given = {"free": None, "given": SimpleNamespace(outputs=("x", "v"), by=SimpleNamespace(instance="drive")),
             "still": SimpleNamespace(outputs=("x", "v"), by=SimpleNamespace(instance="rest")),
             "stands": SimpleNamespace(outputs=None)}  # fmt: skip
    groups = [SimpleNamespace(free=kind == "free", prescribed=given[kind]) for kind in kinds]
    ends = [tuple(rng.choice(n, 2, replace=rng.random() < 0.2).tolist()) for _ in range(m)]  # some over a gear at one
    speeds = [{"a": 1.0, "b": float(rng.choice([-1.0, -1.0, -2.0]))} for _ in range(m)]
    names = [f"pad{j}" for j in range(m)]
    places = {}
    for name, (a, b) in zip(names, ends, strict=True):
        places |= {(name, "a"): (a, 1.0, 0.0), (name, "b"): (b, 3.0 if a == b else 1.0, 0.0)}
    instances = [SimpleNamespace(path=name) for name in names]
    structures = {name: SimpleNamespace(pairs={"force": speed}, ratios={}, senses={"force": 1.0})
                  for name, speed in zip(names, speeds, strict=True)}  # fmt: skip
    flat = SimpleNamespace(groups=groups, instances=instances, places=places)
    structures |= {"drive": SimpleNamespace(zeros=()), "rest": SimpleNamespace(zeros=("v",))}
    return flat, structures, kinds, ends, speeds, names


def joined_otherwise(kinds, ends, rows, j):
    """Whether its two ends hang together without contact j: over others, what is not free, or what locks itself."""
    n = len(kinds)
    links, free = np.zeros((n + 1, n + 1)), np.zeros((n + 1, n + 1))
    links[n, np.flatnonzero(kinds != "free")] = 1
    for k, (a, b) in enumerate(ends):
        b = n if a == b else b  # what a gear turns against itself stands
        links[a, b] = links[a, b] or k != j
        free[a, b] = b < n and kinds[a] == kinds[b] == "free"
    number = scipy.sparse.csgraph.connected_components(free, directed=False)[1]
    for body in np.flatnonzero(kinds == "free"):
        inside = np.flatnonzero(number[:n] == number[body])
        mine = [row for row, (a, b) in zip(rows, ends, strict=True) if free[a, b] and number[a] == number[body]]
        if mine and np.linalg.matrix_rank(np.array(mine)) == len(inside):
            links[n, inside] = 1
    union = scipy.sparse.csgraph.connected_components(links, directed=False)[1]
    a, b = ends[j]
    return union[a] == union[n if a == b else b]


@pytest.mark.parametrize("seed", range(25))
def test_a_contact_may_share_its_force_where_its_slip_follows_from_those_of_others(seed):
    """Its row then is a sum of rows of others, and of the rests and given motions: by rank, one contact left out."""
    flat, structures, kinds, ends, speeds, names = network(seed)
    fixed = [np.eye(len(kinds))[k] for k in range(len(kinds)) if kinds[k] != "free"]
    rows = []
    for (a, b), speed in zip(ends, speeds, strict=True):
        row = np.zeros(len(kinds))
        row[a] += speed["a"]
        row[b] += speed["b"] * (3.0 if a == b else 1.0)
        rows.append(row)

    def rank(some):
        return np.linalg.matrix_rank(np.array([*some, *fixed]).reshape(-1, len(kinds)))

    sharing = set()
    for k in range(1, len(rows) + 1):  # of every set of contacts that holds too much, those that could be left out
        for some in itertools.combinations(range(len(rows)), k):
            mine = [rows[j] for j in some]
            if rank(mine) < len(mine) + len(fixed):
                sharing |= {j for j in some if rank([rows[i] for i in some if i != j]) == rank(mine)}
    found = {pair.path for pair in circles(flat, structures)}
    assert {names[j] for j in sharing} <= found
    assert found <= {names[j] for j in range(len(rows)) if joined_otherwise(kinds, ends, rows, j)}


@pytest.mark.parametrize("seed", range(25))
def test_circles_that_have_a_free_body_in_common_are_one_and_tell_of_motions_that_part(seed):
    rng = np.random.default_rng(seed)
    bodies = set(rng.permutation(8)[:5].tolist())
    pairs = []
    for k in range(int(rng.integers(1, 8))):
        one, other = rng.choice([*range(8), REST], 2, replace=False).tolist()
        pairs.append(HeldPair(f"c{k}", "force", ((one, 1.0), (other, -1.0)), 1.0))
    of_pairs, of_bodies = numbers(pairs, bodies)
    links = np.zeros((len(pairs), len(pairs)))
    inside = [{index for index, _ in pair.ends} & bodies for pair in pairs]
    for i, j in itertools.combinations(range(len(pairs)), 2):
        links[i, j] = bool(inside[i] & inside[j])
    union = scipy.sparse.csgraph.connected_components(links, directed=False)[1]
    for i, j in itertools.combinations(range(len(pairs)), 2):
        assert (of_pairs[i] == of_pairs[j]) == (union[i] == union[j])
    assert all(of_bodies[body] == number for some, number in zip(inside, of_pairs, strict=True) for body in some)
    outside = [{index for index, _ in pair.ends} - bodies for pair in pairs]
    parting = [u for u in set(union.tolist()) if len(set().union(*itertools.compress(outside, union == u))) > 1]
    assert moved_apart(pairs, bodies) == [pair.path for pair, u in zip(pairs, union, strict=True) if u in parting]
