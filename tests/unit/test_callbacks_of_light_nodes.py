"""Rows that hold nodes without inertia, and their rates, alone: against null spaces and sets on random patterns."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse.csgraph

from fairlead.kernels import layout
from tests.plain_callbacks import context, plain

SEEDS = range(12)


def parts_of(seed):
    """One to three parts: rows A v + B u = S a of speeds with and without inertia and of given accelerations.

    Some of the rows say what others say of u, as sensors and gears do.
    """
    rng = np.random.default_rng(seed)
    found = []
    for _ in range(rng.integers(1, 4)):
        rows, light, heavy, given = (int(rng.integers(*span)) for span in ((2, 7), (1, 4), (1, 4), (0, 3)))
        B = rng.integers(-2, 3, (rows, light)).astype(float)
        for i in range(1, rows):
            if rng.random() < 0.4:
                B[i] = B[rng.integers(i)] * rng.choice([-1.0, 0.5, 3.0])
        A = rng.normal(size=(rows, heavy)) * (rng.random((rows, heavy)) < 0.7)
        S = np.zeros((rows, given))
        for e in range(given):
            S[rng.integers(rows), e] = rng.normal()
        found.append((A, B, S))
    return rng, found


def laid_out(rng, parts):
    """The context of these parts, with the number of places in M, row by row."""
    spans, rows, slots, coefs, partials, supports, ratios, terms, places = [], [], [], [], [1.0], [], [], [], 0

    def split(value):
        """A slope as a coefficient and a partial derivative."""
        partials.append(rng.uniform(0.5, 2.0))
        return value / partials[-1], len(partials) - 1

    for A, B, S in parts:
        (count, light), heavy = B.shape, A.shape[1]
        first = len(supports)
        row_of = [int(np.flatnonzero(S[:, e])[0]) for e in range(S.shape[1])]
        for e, row in enumerate(row_of):
            ratio, partial = split(S[row, e])
            supports.append((row, partial))
            ratios.append(ratio)
        spans.append((len(rows), len(rows) + count, light, light + heavy, first, len(supports), len(terms)))
        for i, row in enumerate(np.hstack([B, A])):
            begin = len(slots)
            for c in np.flatnonzero(row):
                one = rng.uniform(-1, 1)  # two entries at one place, as of two ports of a gear at one node
                for value in (one, row[c] - one):
                    coef, partial = split(value)
                    slots.append((c, partial))
                    coefs.append(coef)
            rows.append((begin, len(slots), places))
            places += heavy
            terms += [(i, first + e) for e in range(S.shape[1])]
    ctx = context(
        partials=np.array([*partials, *np.full(len(terms), np.nan)]), light_at=len(partials), n_light_parts=len(parts),
        light_parts=np.array(spans), light_rows=np.array(rows), light_entries=np.array(slots).reshape(-1, 2),
        light_coef=np.array(coefs), light_places=np.arange(places), light_supports=np.array(supports).reshape(-1, 2),
        light_supports_coef=np.array(ratios), n_light_terms=len(terms),
        light_terms=np.array(terms, np.int64).reshape(-1, 2),
        light_work=np.full(200, np.nan), light_given=np.zeros(20, np.int64), z=rng.normal(size=len(supports) + 1),
    )  # fmt: skip
    return ctx, places


def asked(*_):
    """Partial derivatives are given here; no kernel is asked."""


@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_left_of_rows_are_the_relations_of_speeds_with_inertia(seed):
    """Their number and span is that of N^T A, with N^T B = 0; each has its own row once."""
    rng, parts = parts_of(seed)
    ctx, places = laid_out(rng, parts)
    values = np.zeros(places)
    plain(ask=asked)["hold_light"](ctx, values)
    at = 0
    for A, B, _S in parts:
        left = values[at : at + A.size].reshape(A.shape)
        at += A.size
        relations = scipy.linalg.null_space(B.T).T @ A
        check(left, relations, np.linalg.matrix_rank(relations) if relations.size else 0)
        for i in range(len(B)):  # row i gives a speed if the rows up to it know one more
            known = np.linalg.matrix_rank(B[: i + 1]) > (np.linalg.matrix_rank(B[:i]) if i else 0)
            if known:
                assert not left[i].any()
            else:
                taken = np.linalg.lstsq(B[:i].T, B[i])[0] if i else np.zeros(0)
                if np.linalg.matrix_rank(B[:i] if i else np.zeros((1, 1))) == i:
                    assert left[i] == pytest.approx(A[i] - taken @ A[:i], abs=1e-9)


def test_what_rounding_leaves_of_an_entry_is_none():
    """0.1 v + 0.3 u = 0 and 0.3 v + 0.9 u + w = 0:  0.3 - (0.9/0.3) 0.1 is 5e-17, and the relation is of w alone."""
    part = np.array([[0.1, 0.0], [0.3, 1.0]]), np.array([[0.3], [0.9]]), np.zeros((2, 0))
    assert part[0][1, 0] - part[1][1, 0] / part[1][0, 0] * part[0][0, 0] != 0.0
    ctx, places = laid_out(np.random.default_rng(0), [part])
    values = np.zeros(places)
    plain(ask=asked)["hold_light"](ctx, values)
    assert values[:3].tolist() == [0.0, 0.0, 0.0]
    assert values[3] == pytest.approx(1.0)


def check(found, wanted, rank):
    assert (np.linalg.matrix_rank(found, tol=1e-8) if found.size else 0) == rank
    if rank:
        basis = scipy.linalg.orth(wanted.T)
        assert np.abs(found.T - basis @ (basis.T @ found.T)).max() < 1e-8


@pytest.mark.parametrize("seed", SEEDS)
def test_a_relation_has_accelerations_of_supports_eliminated_as_its_speeds_are(seed):
    """Kernels put S a on the right of every row; what a relation has instead is what elimination leaves of it."""
    rng, parts = parts_of(seed)
    ctx, places = laid_out(rng, parts)
    callbacks = plain(ask=asked)
    values = np.zeros(places)
    callbacks["hold_light"](ctx, values)
    callbacks["weigh_supports"](ctx)
    more = ctx[layout.PARTIALS][ctx[layout.LIGHT_AT] :]
    at = place = 0
    for A, B, S in parts:
        added = more[at : at + S.size].reshape(S.shape)
        left = values[place : place + A.size].reshape(A.shape)
        at, place = at + S.size, place + A.size
        rest = S - added
        both = scipy.linalg.null_space(B.T).T @ np.hstack([A, S])
        check(np.hstack([left, rest]), both, np.linalg.matrix_rank(both) if both.size else 0)


@pytest.mark.parametrize("seed", SEEDS)
def test_what_is_added_to_rows_is_that_share_of_the_accelerations(seed):
    rng, parts = parts_of(seed)
    ctx, _ = laid_out(rng, parts)
    w, modes = np.zeros(10), []
    callbacks = plain(ask=lambda _ctx, mode, _into: modes.append(mode))
    callbacks["support_light"](ctx, w)
    assert modes == [layout.MASS]  # the slopes of the zones in force
    before = ctx[layout.PARTIALS].copy()
    callbacks["weigh_supports"](ctx)
    assert ctx[layout.PARTIALS] == pytest.approx(before)
    more, terms = ctx[layout.PARTIALS][ctx[layout.LIGHT_AT] :], ctx[layout.LIGHT_TERMS].reshape(-1, 2)
    wanted = np.zeros(10)
    np.add.at(wanted, terms[:, 0], more * ctx[layout.Z][terms[:, 1]])
    assert w == pytest.approx(wanted)


def rated_nodes(seed):
    """Nodes without inertia and what joins them: rows, or laws that tell a force softly; some in other zones."""
    rng = np.random.default_rng(seed)
    nodes, joins = int(rng.integers(2, 8)), int(rng.integers(1, 9))
    members = [rng.choice(nodes, min(nodes, int(rng.integers(1, 4))), replace=False).tolist() for _ in range(joins)]
    softly, holds = rng.random(joins) < 0.4, rng.random(joins) < 0.7
    always = rng.random(joins) < 0.3
    weights = [rng.choice([-1.0, 1.0]) * rng.uniform(0.5, 2.0, len(some)) for some in members]
    starts = np.cumsum([0, *map(len, members)])
    rows = [(-1 if always[j] else j, 5, softly[j], starts[j], starts[j + 1]) for j in range(joins)]
    terms = list(itertools.product(range(nodes), repeat=2))
    jumps = rng.random(nodes) < 0.7
    ctx = context(
        n_rated=nodes, n_rated_joins=joins, n_rated_terms=len(terms), rated_joins=np.array(rows, np.int64),
        rated_members=np.concatenate(members), rated_weights=np.concatenate(weights), rated_terms=np.array(terms),
        zones=np.where(holds, 5, 4), rated_known=np.full(nodes, -1), rated_root=np.full(nodes, -1),
        rated_mode=np.full(nodes, np.nan), partials=np.full(1 + len(terms), np.nan), rated_at=1,
        rated=np.array([(k, nodes + k, jumps[k]) for k in range(nodes)], np.int64), tau=np.array([0.01]),
        z=rng.normal(size=2 * nodes), w=rng.normal(size=2 * nodes),
    )  # fmt: skip
    every = zip(members, softly.tolist(), weights, holds | always, strict=True)
    return ctx, nodes, [(set(some), soft, dict(zip(some, by, strict=True))) for some, soft, by, joins in every if joins]


def held_by(joins, known):
    """All that follows by joins of which one member alone is not known."""
    known = set(known)
    while more := {k for members, *_ in joins for k in members - known if len(members - known) == 1}:
        known |= more
    return known


@pytest.mark.parametrize("seed", range(25))
def test_a_node_is_held_where_all_others_of_a_join_are(seed):
    ctx, nodes, joins = rated_nodes(seed)
    plain()["find_known"](ctx)
    known = ctx[layout.RATED_KNOWN]
    assert set(np.flatnonzero(known).tolist()) == held_by(joins, ())
    firm = [join for join in joins if not join[1]]
    firmly = held_by(firm, ())
    assert all(known[k] == 1 for k in firmly)
    soft = set(np.flatnonzero(known == 2).tolist())
    assert soft.isdisjoint(firmly)
    assert held_by(firm, soft) == set(np.flatnonzero(known).tolist())  # what hangs on them by rows alone is held
    assert set(known.tolist()) <= {0, 1, 2}
    assert nodes == len(known)


@pytest.mark.parametrize("seed", range(25))
def test_the_rates_of_balances_count_by_virtual_speeds_of_what_nothing_holds(seed):
    """In the row of one for all that move together, each by its speed in the null space of the joins."""
    ctx, nodes, joins = rated_nodes(seed)
    w, before = ctx[layout.W], ctx[layout.W].copy()
    plain()["add_rates"](ctx, w)
    rates, known = ctx[layout.Z][nodes:], held_by(joins, ())
    loose = [k for k in range(nodes) if k not in known]
    pairs = [(members, weight) for members, _, weight in joins if len(members) == 2 and members <= set(loose)]
    links = np.zeros((nodes, nodes))
    for members, _ in pairs:
        a, b = members
        links[a, b] = 1
    number = scipy.sparse.csgraph.connected_components(links, directed=False)[1]
    roots = ctx[layout.RATED_ROOT]
    wanted = np.zeros(2 * nodes)
    for union in {number[k] for k in loose}:
        inside = [k for k in loose if number[k] == union]
        mine = [weight for members, weight in pairs if members <= set(inside)]
        assert len({roots[k] for k in inside}) == 1
        assert roots[inside[0]] in inside
        moves = np.ones((1, 1))
        if mine:
            rows = np.array([[weight.get(k, 0.0) for k in inside] for weight in mine])
            moves = scipy.linalg.null_space(rows, rcond=1e-9)
        if moves.shape[1] == 1:  # else two joins contradict each other
            speed = moves[:, 0] / moves[inside.index(roots[inside[0]]), 0]
            wanted[roots[inside[0]]] = speed @ rates[inside]
        else:
            wanted[roots[inside[0]]] = w[roots[inside[0]]] - before[roots[inside[0]]]
    soft = ctx[layout.RATED_KNOWN] == 2
    wanted[:nodes][soft] = 1e-3 * rates[soft]
    assert w - before == pytest.approx(wanted, abs=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_off_balance_is_what_the_rate_leaves_of_it_where_a_node_may_jump(seed):
    ctx, nodes, _ = rated_nodes(seed)
    callbacks = plain()
    plainly = ctx[layout.W].copy()
    callbacks["add_rates"](ctx, ctx[layout.W])
    r = np.zeros(2 * nodes)
    callbacks["off_balance"](ctx, r)
    jumps = ctx[layout.RATED].reshape(-1, 3)[:, layout.RATED_JUMPS] == 1
    stands = (ctx[layout.RATED_KNOWN] == 0) & (ctx[layout.RATED_ROOT] == np.arange(nodes)) & jumps
    assert r[:nodes] == pytest.approx(np.where(stands, 0.01 * plainly[:nodes], 0.0), abs=1e-12)
