"""The active set of `stepping`, alone: whom a contact that lets go hands its excess to, and where a jump is met."""

from __future__ import annotations

import functools
import itertools

import numpy as np
import pytest

from tests.integrate.rooms import entry, fields, memory


@functools.cache
def handed():
    from fairlead.integrate.stepping.slip_fronts import redistribute_load

    return entry(redistribute_load, ("events.guards", "stepping.contacts"))


@functools.cache
def line():
    from fairlead.integrate.stepping.slip_fronts import next_in_line

    return entry(next_in_line, ("stepping.contacts",), "ii", "i")


@functools.cache
def located():
    from fairlead.integrate.stepping.jump_at_end import locate_guard

    return entry(locate_guard, ("problem", "run", "point", "events.guards"), "di", "d")


@pytest.mark.parametrize("due", [0.1, 0.3, 0.5, 0.7, 0.9])
@pytest.mark.parametrize("bend", [-3.0, 0.01, 3.0])
def test_six_evaluations_find_a_guard_within_two_thousandths_of_a_step(due, bend):
    """A guard that grows with e^(bend t): 2e-3 of a step is left of half a step by an order of 1.44 an evaluation."""

    def guard(_t, y, g):
        g[0] = (np.exp(bend * y[0]) - np.exp(bend * due)) / bend

    at = memory({"n": 1, "n_guards": 1, "t_release": 1e308}, y=[0.0], y_end=[1.0], y_probe=[0.0], g=[0.0], g_end=[0.0],
                g_probe=[0.0], guard_machine=[-1], guard_tolerance=[1e-12])  # fmt: skip
    kept = fields(at, 1, guards=(guard, 1))
    for name, place in (("g", 0.0), ("g_end", 1.0)):
        guard(0.0, [place], at.array[name])
    assert located()(at, 1.0, 0) == pytest.approx(due, abs=2e-3)
    assert at.number["guards"] <= 6
    assert kept


@functools.cache
def jump():
    from fairlead.integrate.stepping.jump_at_end import place_jump

    return entry(place_jump, ("point", "events.guards", "stepping.contacts", "stepping.rule"), "d")


def chain(order, margins, excess):
    """Contacts in a row, of which place k is number order[k]: each with one guard, `margins` below its limit."""
    n = len(order)
    neighbours = [[] for _ in range(n)]
    for a, b in itertools.pairwise(order):
        neighbours[a].append(b)
        neighbours[b].append(a)
    g = np.zeros(n)
    g[order] = -np.asarray(margins)
    fired = [order[k] for k in excess]
    g[fired] = list(excess.values())
    return memory(
        {"n_guards": n, "n_machines": n, "n_fired": len(fired), "n_neighbours": 2 * n - 2},
        guard_machine=np.arange(n), limit_guard=np.ones(n), g_end=g, guard_tolerance=np.full(n, 1e-9),
        fired=[*fired, *[0] * (n - len(fired))], g_probe=np.zeros(n), first_guard=np.arange(n), zones=np.zeros(n),
        neighbour_starts=np.cumsum([0, *map(len, neighbours)]), neighbours=np.concatenate(neighbours),
        met=np.zeros(n),
    )  # fmt: skip


def let_go(at):
    handed()(at)
    assert not at.array["met"].any()
    return set(at.array["fired"][: int(at.number["n_fired"])].tolist())


def test_a_front_runs_as_far_as_the_excess_lasts():
    """From the end of a row all goes one way: eight tenths of the excess, less what the next can still bear."""
    margins = [0.0, 3.0, 1.0, 2.0, 2.0, 0.5]
    reached, excess = {0}, 10.0
    for k in range(1, 6):
        excess = 0.8 * excess - margins[k]
        if excess <= 0:
            break
        reached.add(k)
    assert reached == {0, 1, 2, 3}
    assert let_go(chain(np.arange(6), margins, {0: 10.0})) == reached


@pytest.mark.parametrize("seed", range(5))
def test_numbers_of_contacts_say_nothing(seed):
    rng = np.random.default_rng(seed)
    margins, excess = rng.uniform(0.1, 2.0, 12), {int(k): float(rng.uniform(2, 9)) for k in rng.choice(12, 2, False)}
    plain = let_go(chain(np.arange(12), margins, excess))
    order = rng.permutation(12)
    assert let_go(chain(order, margins, excess)) == {int(order[k]) for k in plain}
    assert let_go(chain(np.arange(12)[::-1], margins, excess)) == {11 - k for k in plain}
    assert len(plain) > 2


def test_the_next_in_a_row_is_on_the_other_side_and_an_end_has_none():
    at = chain(np.array([2, 0, 3, 1]), np.ones(4), {0: 1.0})
    assert [line()(at, z, before) for z, before in ((0, 2), (3, 0), (1, 3), (2, -1))] == [3, 1, -1, 0]


@pytest.mark.parametrize("change", [0.1, 0.3, 0.6])
def test_four_tries_find_a_jump_to_a_thousandth_of_a_step_where_the_load_changes_its_rate_by_less_than_07(change):
    """Load a t + b t^2, of which a step shows the value in its middle; its rate changes by `change` on the way."""
    from fairlead.integrate.stepping.repeated import AT_PLACE, TRIES

    gap, due, rate = 0.5, 0.8, 3.0
    curve = change * rate / (2 * (gap + due))

    def load(t):
        return rate * (t - due) + curve * (t - due) ** 2

    at = memory({"n_guards": 1, "n_machines": 1, "n_fired": 1, "gap": gap, "t": 0.0}, fired=[0],
                g=[load(-gap)], g_end=[0.0], guard_tolerance=[1e-9], is_mean=[1])  # fmt: skip
    h, told = 1.0, 1.0
    for _ in range(TRIES + 1):
        h = told
        at.array["g_end"][0] = load(h / 2)
        jump()(at, h)
        told = float(at.number["t_cut"])
    assert abs(told - h) <= AT_PLACE * h
    bend = rate + curve * (h / 2 - gap - 2 * due)  # the error of a secant through -gap and h/2
    assert told - due == pytest.approx(curve * (h / 2 - due) * (-gap - due) / bend, rel=1e-9)
