"""Guards that are followed, what is due in time, and multiply-adds of derivatives, alone: against plain searches."""

from __future__ import annotations

import numpy as np
import pytest

from fairlead.kernels import layout
from tests.plain_callbacks import context, plain

SEEDS = range(10)


@pytest.mark.parametrize("seed", SEEDS)
def test_of_the_guards_of_one_instance_the_first_counts_and_leads_where_its_zone_says(seed):
    """Instances have a zone of their own and machines of tables, of which a guard leads to the next or last piece."""
    rng = np.random.default_rng(seed)
    instances, slots, zones_each = 4, 3, 2
    zones, first = rng.integers(0, zones_each, 2 * instances), 2 * np.arange(instances)  # each a zone and a table
    rows, to = [], []
    for k in range(instances):
        has_zones = rng.random() < 0.7  # else its own zone is the only one
        begin = len(to)
        for _zone in range(zones_each):
            for _slot in range(slots):
                piece = rng.random() < 0.4
                to.append((-1, 1, rng.choice([-1, 1])) if piece else (int(rng.integers(zones_each)), 0, 0))
        rows += [(first[k] if has_zones else -1, begin, slots, slot) for slot in range(slots)]
    fired = np.sort(rng.permutation(instances * slots)[: rng.integers(1, 8)])
    wanted = zones.copy()
    for k in range(instances):
        mine = [i for i in fired if i // slots == k]
        if mine:
            at, begin, _, slot = rows[mine[0]]
            zone, machine, piece = to[begin + slots * (zones[at] if at >= 0 else 0) + slot]
            wanted[first[k] + machine] = zone if zone >= 0 else zones[first[k] + machine] + piece
    ctx = context(zones=zones, guard_place=np.array(rows), guard_to=np.array(to),
                  guard_machines=np.repeat(first, slots))  # fmt: skip
    assert plain()["switch"](ctx, 0.0, None, fired, len(fired)) == len(fired)
    assert ctx[layout.ZONES].tolist() == wanted.tolist()


def in_time(seed):
    """Tables with pieces that end at random instants, and samplers; some ends and samples fall together."""
    rng = np.random.default_rng(seed)
    stride = layout.STRIDE
    ends = [np.append(np.cumsum(rng.choice([0.1, 0.25, 0.3], int(rng.integers(1, 5)))), np.inf) for _ in range(3)]
    tables, places = [], []
    for k, right in enumerate(ends):
        places.append((k, len(tables), len(right)))
        for end in right:
            row = np.zeros(stride)
            row[layout.RIGHT] = end
            tables += row.tolist()
    period = rng.choice([0.05, 0.1, 0.25], 2)
    ctx = context(
        n_time=3, time_place=np.array(places), zones=np.zeros(3, np.int64), tables=np.array(tables), n_sampled=2,
        sample_period=period, sample_count=np.zeros(2, np.int64), sample_start=np.array([0.02]), set_due=np.array([0]),
        set_at=[np.zeros(1), np.zeros(1)], set_values=np.array([3.0, 4.0]), n_set=2,
    )  # fmt: skip
    return ctx, ends, period


@pytest.mark.parametrize("seed", SEEDS)
def test_every_end_of_a_piece_and_every_sample_is_due_once_and_in_its_order(seed):
    ctx, ends, period = in_time(seed)
    taken = []

    def take_samples(ctx, t, _y):
        count = ctx[layout.SAMPLE_COUNT]
        for k in range(2):
            if 0.02 + count[k] * period[k] <= t * (1 + 2e-15):
                taken.append((k, t))
                count[k] += 1

    callbacks = plain(take_samples=take_samples)
    t, instants = 0.0, []
    callbacks["at_time"](ctx, t, None)
    while (t := callbacks["next_time"](ctx, t)) < 1.0:
        instants.append(t)
        assert callbacks["at_time"](ctx, t, None) == 1
        assert ctx[layout.ZONES].tolist() == [int((right <= t * (1 + 2e-15)).sum()) for right in ends]
    samples = {(k, n): 0.02 + n * period[k] for k in range(2) for n in range(30)}
    due = sorted({*(end for right in ends for end in right if end < 1.0), *(s for s in samples.values() if s < 1.0)})
    merged = [one for k, one in enumerate(due) if k == 0 or one > due[k - 1] * (1 + 4e-15)]
    assert instants == pytest.approx(merged, rel=1e-14)
    for k in range(2):
        mine = [t for who, t in taken if who == k]
        assert mine == pytest.approx([s for (who, _), s in samples.items() if who == k and s < 1.0 - 1e-12], rel=1e-14)


def test_what_is_set_from_outside_is_taken_once_at_the_next_time_event():
    ctx, _, _ = in_time(0)
    ctx[layout.N_SAMPLED] = 0
    at_time = plain()["at_time"]
    assert at_time(ctx, 0.0, None) == 0
    assert [one[0] for one in ctx[layout.SET_AT]] == [0.0, 0.0]
    ctx[layout.SET_DUE][0] = 1
    assert at_time(ctx, 0.01, None) == 1
    assert [one[0] for one in ctx[layout.SET_AT]] == [3.0, 4.0]
    assert ctx[layout.SET_DUE][0] == 0


def test_samples_read_zones_of_signals_as_they_follow_from_what_is_given_and_leave_those_in_force():
    """A table jumps to 1; behind it are two relays, the second of which reads the first."""
    zones, seen = np.array([0, 0, 0]), []
    given = np.array([1.0])

    def ask(ctx, mode, g):
        assert mode == layout.GUARD
        g[:] = -1.0
        g[0] = given[0] - 0.5 if zones[0] == 0 else -1.0
        g[1] = zones[0] - 0.5 if zones[1] == 0 else -1.0
        g[2] = 1.0  # not of a part that only tells signals

    ctx = context(n_told=2, told_guards=np.array([0, 1]), told_fired=np.zeros(2, np.int64), guards_now=np.zeros(3),
                  zones=zones, n_machines=3, zones_kept=np.zeros(3, np.int64), guard_machines=np.array([0, 1, 2]),
                  guard_place=np.array([(k, 2 * k, 1, 0) for k in range(3)]),
                  guard_to=np.array([(1, 0, 0)] * 6))  # fmt: skip
    callbacks = plain(ask=ask, look=lambda *_: None, take_samples=lambda *_: seen.append(zones.tolist()))
    callbacks["sample_as_given"](ctx, 0.0, None)
    assert seen == [[1, 1, 0]]
    assert zones.tolist() == [0, 0, 0]
    given[0] = 0.0
    callbacks["sample_as_given"](ctx, 0.0, None)
    assert seen[1] == [0, 0, 0]


@pytest.mark.parametrize("seed", SEEDS)
def test_a_mean_of_given_motions_has_the_weights_of_both_ends_and_says_whether_it_differs(seed):
    rng = np.random.default_rng(seed)
    curve = np.polynomial.Polynomial(rng.normal(size=3))
    z, places = np.zeros(6), np.array([4, 1])
    ctx = context(n=1, z=z, given_places=places, given_mean=np.zeros(2), n_given_places=2, schedule=np.zeros(0),
                  mean=np.array([0.2, 0.9, *rng.uniform(0.1, 0.4, 2), 7.0]))  # fmt: skip

    def give_motions(_ctx, t):
        z[places] = curve(t), 5.0

    callbacks = plain(give_motions=give_motions, make_calls=lambda *_: None)
    callbacks["look"](ctx, 0.5, np.array([8.0]))
    assert z[0] == 8.0
    first, last = ctx[layout.MEAN][2:4]
    wanted = first * curve(0.2) + last * curve(0.9) + (1 - first - last) * curve(0.5)
    assert z[places] == pytest.approx([wanted, 5.0])
    assert ctx[layout.MEAN][4] == 1.0
    curve = np.polynomial.Polynomial([2.0])
    callbacks["look"](ctx, 0.5, np.zeros(1))
    assert ctx[layout.MEAN][4] == 0.0  # it stands still
    ctx[layout.MEAN][2:4], ctx[layout.MEAN][4] = 0.0, 7.0
    callbacks["look"](ctx, 0.5, np.zeros(1))
    assert ctx[layout.MEAN][4] == 7.0  # no mean is asked for


@pytest.mark.parametrize("ledger", [0, 1])
@pytest.mark.parametrize("seed", SEEDS)
def test_derivatives_are_sums_of_products_of_which_the_fixed_ones_are_made_once(seed, ledger):
    """work[to] += coef partials[by] work[from], row by row; the last of them are those of the ledger."""
    rng = np.random.default_rng(seed)
    size, fixed, moving, forces, n = 12, 6, 8, 5, 2
    adds = rng.integers(0, size, (fixed + moving, 3))
    adds[:, 0] = rng.integers(size // 2, size, fixed + moving)  # later places are sums of earlier ones
    adds[:, 2] = rng.integers(0, size // 2, fixed + moving)
    coef, partials = rng.normal(size=fixed + moving), rng.normal(size=size)
    places = np.unique(adds[fixed : fixed + forces, 0]), np.unique(adds[fixed:, 0])
    every = np.array([*places[0], *np.setdiff1d(places[1], places[0])])
    work = np.zeros(size)
    work[0] = 1.0
    asked = []
    ctx = context(
        n=n, n_work=size, work=work, partials=partials, n_fixed=fixed, fixed=adds[:fixed], fixed_coef=coef[:fixed],
        n_program=moving, n_program_forces=forces, program=adds[fixed:], program_coef=coef[fixed:], moving=every,
        n_moving=len(every), n_moving_forces=len(places[0]), moving_base=np.zeros(len(every)), jacobian_at=size - 5,
        n_jacobian=3, fixed_done=np.array([0]),
    )  # fmt: skip
    callbacks = plain(ask=lambda _ctx, mode, _out: asked.append(mode), look=lambda *_: None)
    values, ft = np.zeros(3), np.zeros(n)
    for _ in range(3):
        partials[:] = rng.normal(size=size) if ctx[layout.FIXED_DONE][0] == 0 else partials
        callbacks["jacobian" if ledger else "slopes"](ctx, 0.0, None, values, ft)
        wanted = np.zeros(size)
        wanted[0] = 1.0
        for k in range(fixed + (moving if ledger else forces)):
            to, by, source = adds[k]
            wanted[to] += coef[k] * partials[by] * wanted[source]
        some = np.isin(np.arange(size), every[len(places[0]) :]) & (not ledger)  # rows of the ledger: anything
        assert np.where(some, 0, work) == pytest.approx(np.where(some, 0, wanted))
        assert values == pytest.approx(work[size - 5 : size - 2])
        assert ft == pytest.approx(work[size - 2 :])
    assert asked.count(layout.FIXED_FLOWS) == asked.count(layout.FIXED_SIGNALS) == asked.count(layout.FIXED_LEDGER) == 1
    assert asked.count(layout.PARTIALS_FLOWS) == 3
    assert asked.count(layout.PARTIALS_LEDGER) == 3 * ledger
