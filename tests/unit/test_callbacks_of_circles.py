"""Held contacts that close circles, alone: unions and shares against null spaces and least squares."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse.csgraph

from fairlead.kernels import layout
from fairlead.kernels.layout import AT_REST, DRIVEN, FREE
from tests.plain_callbacks import context, plain

SEEDS = range(12)


def held_network(seed, *, agree=True, still=True):
    """Bodies and contacts at random, with the speeds of a few gears; slips are C v.

    Where speeds `agree` round circles, each contact rolls on the pitch circles of its bodies; some others do not.
    """
    rng = np.random.default_rng(seed)
    bodies, contacts = int(rng.integers(3, 8)), int(rng.integers(4, 11))
    hangs = rng.choice([FREE, DRIVEN, AT_REST] if still else [FREE, DRIVEN], bodies, p=[0.7, 0.15, 0.15][: 2 + still]
                       / np.sum([0.7, 0.15, 0.15][: 2 + still]))  # fmt: skip
    radius = rng.uniform(0.5, 2.0, bodies) * rng.choice([-1.0, 1.0], bodies)
    ends = np.array([rng.choice(bodies, 2, replace=False) for _ in range(contacts)])
    pull = rng.uniform(0.5, 2.0, contacts) * rng.choice([-1.0, 1.0], contacts)
    coef = np.column_stack([pull / radius[ends[:, 0]], -pull / radius[ends[:, 1]]])
    if not agree:
        coef[rng.random(contacts) < 0.2, 1] *= 1.3
    C = np.zeros((contacts, bodies))
    for j in range(contacts):
        C[j, ends[j, 0]], C[j, ends[j, 1]] = coef[j]
    return SimpleNamespace(
        n=bodies, m=contacts, hangs=hangs, ends=ends, coef=coef, C=C, held=rng.random(contacts) < 0.6,
        sense=rng.choice([-1.0, 1.0], contacts), factor=rng.uniform(0.2, 5.0, contacts), rng=rng,
    )  # fmt: skip


def united(net, **more):
    """The context of a network after its unions were found; every contact has a guard while it slides."""
    zero = net.n + net.m  # where in z a share lies that is none
    free = np.flatnonzero(net.hangs == FREE)
    share = np.where(net.hangs == FREE, np.arange(net.n) + net.m, zero)
    pairs = [(j, *net.ends[j], *share[net.ends[j]], j, 2 * j) for j in range(net.m)]
    zones = [row for j in range(net.m) for row in ((1, -1, 0), (0, j, net.rng.choice([-1, 0, 1])))]
    ctx = context(
        n=net.n + net.m, n_circles=net.m, n_circle_nodes=net.n, n_circle_bodies=len(free), circle_at=1,
        zones=np.where(net.held, 0, 1), partials=np.full(1 + net.m + len(free), np.nan), circle_pairs=np.array(pairs),
        circle_coef=np.column_stack([net.coef, net.sense, net.factor]), circle_zones=np.array(zones),
        circle_seen=np.full(net.m, -1), circle_still=np.full(net.m, -1),
        circle_nodes=np.array([(of, 0, 0, 0) for of in net.hangs]), circle_ratio=np.full(net.n, np.nan),
        circle_bodies=np.array([(k, share[k]) for k in free]), circle_pins=np.ones(len(free)),
        guard_inertia=np.full(net.m, np.nan), tau=np.array([0.01]), **more,
    )  # fmt: skip
    plain()["regroup"](ctx, 0.0, None)
    return ctx, np.array(zones).reshape(net.m, 2, 3)


def unions_of(net):
    """By graph search: the number of the union of every body, given who holds."""
    made = np.zeros((net.n, net.n))
    for a, b in net.ends[net.held]:
        made[a, b] = 1
    return scipy.sparse.csgraph.connected_components(made, directed=False)[1]


def motions(net, bodies):
    """The null space of the slips of all that holds these bodies: one column where they move as one, none at rest."""
    rows = [j for j in np.flatnonzero(net.held) if net.ends[j, 0] in bodies]
    if not rows:
        return np.eye(len(bodies))
    return scipy.linalg.null_space(net.C[np.ix_(rows, bodies)], rcond=1e-10)


@pytest.mark.parametrize("seed", SEEDS)
def test_unions_are_found_anew_where_a_contact_that_makes_them_has_changed_and_only_there(seed):
    """As in a context that begins with the later zones; what always holds has no machine."""
    net, callbacks = held_network(seed, agree=False), plain()
    ctx, _ = united(net)
    pairs, always = ctx[layout.CIRCLE_PAIRS].reshape(net.m, -1), int(net.rng.integers(net.m))
    pairs[always, layout.CIRCLE_MACHINE] = -1
    ctx[layout.ZONES][net.rng.integers(net.m)] ^= 1
    callbacks["regroup"](ctx, 0.0, None)
    net.held = ctx[layout.ZONES] == 0
    net.held[always] = True
    number, (top, _) = unions_of(net), tops(ctx, net)
    assert len(set(zip(top.tolist(), number.tolist(), strict=True))) == len(set(number.tolist())) == len(set(top))
    assert ctx[layout.PARTIALS][1 : net.m + 1] == pytest.approx(np.where(net.held, net.factor, 0.0))
    for one in (layout.CIRCLE_STILL, layout.CIRCLE_RATIO):
        ctx[one][:] = 7
    callbacks["regroup"](ctx, 0.0, None)
    assert set(ctx[layout.CIRCLE_STILL].tolist()) | set(ctx[layout.CIRCLE_RATIO].tolist()) == {7}
    for name, more in (("add_shares", ()), ("guard_shares", (np.zeros(net.m),))):  # both ask for it
        ctx[layout.ZONES][0] ^= 1
        ctx[layout.W], ctx[layout.Z] = np.zeros(99), np.zeros(99)
        callbacks[name](ctx, 0.0, np.zeros(99), *more)
        assert ctx[layout.CIRCLE_SEEN][0] == (ctx[layout.ZONES][0] if pairs[0, layout.CIRCLE_MACHINE] >= 0 else 0)


def rank(rows):
    return np.linalg.matrix_rank(rows, tol=1e-8) if len(rows) else 0


def tops(ctx, net):
    """Of every body the one at the top, and its own speed over the speed of that."""
    above = ctx[layout.CIRCLE_NODES].reshape(-1, layout.NODE)[:, layout.NODE_ABOVE]
    found, ratios = [], []
    for k in range(net.n):
        ratio = 1.0
        while above[k] != k:
            ratio *= ctx[layout.CIRCLE_RATIO][k]
            k = above[k]
        found.append(int(k))
        ratios.append(ratio)
    return np.array(found), np.array(ratios)


@pytest.mark.parametrize("agree", [True, False])
@pytest.mark.parametrize("seed", SEEDS)
def test_bodies_that_contacts_hold_together_are_a_union_that_moves_as_the_null_space_says(seed, agree):
    net = held_network(seed, agree=agree)
    ctx, _ = united(net)
    top, ratio = tops(ctx, net)
    number = unions_of(net)
    assert len(set(zip(top.tolist(), number.tolist(), strict=True))) == len(set(number.tolist())) == len(set(top))
    hangs_on = ctx[layout.CIRCLE_NODES].reshape(-1, layout.NODE)[:, layout.NODE_UNION_HANGS_ON]
    for union in range(number.max() + 1):
        inside = np.flatnonzero(number == union)
        moves = motions(net, inside)
        if moves.shape[1] == 0:
            assert hangs_on[top[inside[0]]] == AT_REST
            continue
        assert moves.shape[1] == 1
        own = moves[:, 0] / moves[np.flatnonzero(inside == top[inside[0]])[0], 0]
        assert ratio[inside] == pytest.approx(own, rel=1e-9)
        assert hangs_on[top[inside[0]]] == net.hangs[inside].max()


@pytest.mark.parametrize("agree", [True, False])
@pytest.mark.parametrize("seed", SEEDS)
def test_a_contact_slides_in_name_only_where_no_motion_that_the_others_leave_makes_it_slip(seed, agree):
    net = held_network(seed, agree=agree)
    ctx, _ = united(net)
    known = np.vstack([net.C[net.held], np.eye(net.n)[net.hangs == AT_REST]])
    for j in range(net.m):
        stays = rank(np.vstack([known, net.C[j]])) == rank(known)
        assert ctx[layout.CIRCLE_STILL][j] == (stays and not net.held[j])
        if not net.held[j]:  # of a share that is missing a nanometre a second is told, of a slip all
            assert ctx[layout.GUARD_INERTIA][j] == pytest.approx((1e-9 if stays else 1.0) / net.factor[j])


@pytest.mark.parametrize("agree", [True, False])
@pytest.mark.parametrize("seed", SEEDS)
def test_forces_are_shared_so_that_the_sum_of_their_squares_is_least(seed, agree):
    """Accelerations by Gauss's principle, of least constraint; then the forces of least norm that give them."""
    net = held_network(seed, agree=agree)
    free, rng = np.flatnonzero(net.hangs == FREE), net.rng
    mass, push = rng.uniform(0.5, 3.0, net.n), rng.normal(size=net.n)
    size = net.n + net.m
    ctx, _ = united(net, w=np.zeros(size), z=np.zeros(size + 1))
    held = np.flatnonzero(net.held)
    C = net.C[np.ix_(held, free)]
    moves = scipy.linalg.null_space(C, rcond=1e-10) if len(held) else np.eye(len(free))
    least = moves @ np.linalg.solve(moves.T @ (mass[free, None] * moves), moves.T @ push[free])
    forces = np.linalg.pinv(C.T, rcond=1e-10) @ (mass[free] * least - push[free])

    def shares(y):
        """What `add_shares` adds to every row for forces and shares y."""
        ctx[layout.W], ctx[layout.Z] = np.zeros(size), np.append(y, 0.0)
        plain()["add_shares"](ctx, 0.0, y)
        return ctx[layout.W]

    unknown = [*held.tolist(), *(net.m + free).tolist()]
    rows = np.array([shares(np.eye(size)[k]) for k in unknown]).T[unknown]
    full = np.block([[np.diag(mass[free]), np.zeros((len(free), len(unknown)))], [np.zeros((len(unknown), len(free))),
                                                                                  -rows]])  # fmt: skip
    full[: len(free), len(free) : len(free) + len(held)] = -C.T * net.sense[held]
    full[len(free) : len(free) + len(held), : len(free)] = C
    assert np.linalg.cond(full) < 1e6
    found = np.linalg.solve(full, np.append(push[free], np.zeros(len(unknown))))
    assert found[: len(free)] == pytest.approx(least, abs=1e-9)
    assert net.sense[held] * found[len(free) : len(free) + len(held)] == pytest.approx(forces, abs=1e-9)


@pytest.mark.parametrize("seed", SEEDS)
def test_sliding_in_name_ends_as_the_share_falls_below_the_friction(seed):
    """Its guard is a speed: what is missing, over the inertia, in tau, along the friction of the zone."""
    net = held_network(seed)
    size = net.n + net.m
    ctx, zones = united(net, z=np.zeros(size + 1))
    y = net.rng.normal(size=size)
    ctx[layout.Z] = np.append(y, 0.0)
    g = np.full(net.m, np.nan)
    plain()["guard_shares"](ctx, 0.0, y, g)
    w = np.where(net.hangs == FREE, y[net.m :], 0.0)
    for j in range(net.m):
        if ctx[layout.CIRCLE_STILL][j] == 0:
            assert np.isnan(g[j])
            continue
        friction, share, way = net.sense[j] * y[j], net.C[j] @ w, zones[j, 1, 2]
        along = share * (way if way else np.sign(friction))
        assert g[j] == pytest.approx(0.01 * net.factor[j] * (abs(friction) - along))
