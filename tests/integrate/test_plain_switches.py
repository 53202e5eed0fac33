"""Switches inside a step of `stepping`, fronts of slip, ties, forces of rigid parts, alone: against plain searches."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from fairlead.integrate.stepping.slip_fronts import LONGEST_FRONT, RUNS_ON
from fairlead.integrate.stepping.switch_inside import AT_ONCE, NOT_SEEN, NOTHING
from tests.integrate.plainly import plain_room, switching
from tests.integrate.rooms import fields, memory


def contacts(seed):
    """Machines with two guards each, some of which hold a row; guards that went from below to above zero, or not."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 7))
    return rng, count, memory(
        {"n": count, "n_machines": count, "n_guards": 2 * count, "gap": 0.05, "theta_now": 0.5, "n_switched": 0},
        guard_machine=np.repeat(np.arange(count), 2), hold_row=np.where(rng.random(count) < 0.5, np.arange(count), -1),
        holds=rng.integers(0, 2, count), zones=rng.integers(0, 2, count), zones_at_start=rng.integers(0, 2, count),
        switched=np.zeros(count), switched_after=np.zeros(count), left_at=np.full(count, NOT_SEEN),
        limit_guard=rng.integers(0, 2, 2 * count), g=-rng.uniform(0.0, 1.0, 2 * count), fired=np.zeros(2 * count),
        g_end=rng.uniform(0.0, 1.0, 2 * count), only_kinks=rng.integers(0, 2, count), latches=rng.integers(0, 2, count),
        guard_tolerance=np.zeros(2 * count),
    )  # fmt: skip


@pytest.mark.parametrize("seed", range(15))
def test_machines_leave_their_zones_where_guards_are_zero_on_the_chord(seed):
    """Of a machine the first that is told counts for the step, the earliest for the log.

    The guard of a limit is of the middle: it is read at -gap and h/2, so zero at its share of that way.
    """
    rng, count, at = contacts(seed)
    h, gap = 0.2, 0.05
    fired = rng.permutation(2 * count)[: rng.integers(1, 2 * count + 1)]
    at.array["fired"][: len(fired)], at.number["n_fired"] = fired, len(fired)
    plain_room("stepping.switch_inside.note_switches", "events.guards", "stepping")(at, h)
    g, end, limit = at.array["g"], at.array["g_end"], at.array["limit_guard"]
    share = -g / (end - g)
    place = np.where(limit == 1, np.maximum((-gap + share * (gap + h / 2)) / h, 0.0), share)
    told, after = [], {}
    for i in fired.tolist():
        z = i // 2
        holds = at.array["hold_row"][z] >= 0 and at.array["holds"][z] == 1
        if at.array["zones"][z] == at.array["zones_at_start"][z] and z not in after:
            told.append((z, place[i]))
            if not holds:
                after[z] = share[i]
    assert at.array["switched"][: int(at.number["n_switched"])].tolist() == list(after)
    assert at.array["switched_after"] == pytest.approx([after.get(z, 0.0) for z in range(count)], abs=1e-9)
    wanted = [min((s for other, s in told if other == z), default=NOT_SEEN) for z in range(count)]
    assert at.array["left_at"] == pytest.approx(wanted, abs=1e-9)
    plain_room("stepping.switch_inside.forget_switches", "stepping.contacts")(at)
    assert not at.array["switched_after"].any()
    assert set(at.array["left_at"]) == {NOT_SEEN}
    assert at.number["n_switched"] == 0


@pytest.mark.parametrize("seed", range(15))
def test_what_switched_inside_is_asked_by_kind_and_place(seed):
    rng, count, at = contacts(seed)
    switched = rng.permutation(count)[: rng.integers(0, count + 1)]
    after = rng.choice([NOTHING / 2, AT_ONCE / 2, 0.3, 0.6], count)
    at.array["switched"][: len(switched)], at.number["n_switched"] = switched, len(switched)
    at.array["switched_after"][switched] = after[switched]
    free = [z for z in switched if at.array["hold_row"][z] < 0]
    for least, most in ((AT_ONCE, 1.0), (0.0, AT_ONCE), (0.0, 0.5)):
        some = [after[z] for z in free if least <= after[z] < most]
        wanted = (min(some), max(some)) if some else (1.0, 0.0)
        assert plain_room("stepping.switch_inside.free_switches", "stepping.contacts")(at, least, most) == wanted
        latched = any(after[z] < most for z in switched if at.array["latches"][z])
        assert plain_room("stepping.switch_inside.latch_switched", "stepping.contacts")(at, most) == latched
    kinks = [after[z] for z in free if at.array["only_kinks"][z] and after[z] >= NOTHING]
    find_kink = plain_room("stepping.switch_inside.find_kink", "stepping")
    assert find_kink(at) == min(kinks, default=1.0)
    at.number["theta_now"] = 1.0  # an implicit step goes over it on purpose
    assert find_kink(at) == 1.0


@pytest.mark.parametrize("seed", range(12))
def test_the_log_of_a_step_is_in_the_order_of_its_instants(seed):
    """Who was let go by others has no guard: its load goes on from the two middles before."""
    rng, count, at = contacts(seed)
    start, end, h, gap, gap_before = 3.0, 3.2, 0.2, 0.05, 0.3
    for of in ("t", "machine", "before", "after", "guard", "position"):
        at.point(f"event_{of}", np.zeros(count), np.float64 if of == "t" else np.int64)
    for name, kind in (("zones_before", np.int64), ("in_order", np.int64), ("switches_by_machine", np.int64),
                       ("boundary", np.int64), ("streak", np.int64), ("chatters", np.int64), ("last_toggle", float)):
        at.point(name, np.zeros(count), kind)
    left = np.where(rng.random(count) < 0.7, rng.random(count), NOT_SEEN)
    at.array["left_at"][:] = left
    at.point("g_before", at.array["g"] - rng.uniform(-0.3, 1.5, 2 * count), float)
    at.point("first_guard", 2 * np.arange(count), np.int64)
    for name, value in {"t": start, "t_piece": end, "h": h, "gap": gap, "gap_before": gap_before,
                        "event_capacity": count}.items():  # fmt: skip
        at.number[name] = value
    plain_room("stepping.switch_inside.log_inside", "")(at)
    g, before, wanted = at.array["g"], at.array["g_before"], []
    for z in np.flatnonzero(at.array["zones"] != at.array["zones_at_start"]).tolist():
        s = left[z]
        if s == NOT_SEEN:
            mine = [i for i in (2 * z, 2 * z + 1) if at.array["limit_guard"][i] and g[i] > before[i]]
            # through (-gap - gap_before, before) and (-gap, g), in time after the start
            s = min([1.0, *(max(-gap - g[i] * gap_before / (g[i] - before[i]), 0.0) / h for i in mine)])
        wanted.append((start + s * (end - start), z))
    count = int(at.number["events"])
    found = list(zip(at.array["event_t"][:count].tolist(), at.array["event_machine"][:count].tolist(), strict=True))
    assert [t for t, _ in found] == sorted(t for t, _ in found)
    assert sorted(z for _, z in found) == sorted(z for _, z in wanted)
    assert {z: t for t, z in found} == pytest.approx({z: t for t, z in wanted})
    assert at.number["t"] == start


def row_of_contacts(order, ran, known, *, gap=0.1):
    """Contacts in a row by their places; those in `ran` let go in the last step, all others hold."""
    n = len(order)
    starts, neighbours = [0], []
    place = np.argsort(order)
    for z in range(n):
        beside = [order[k] for k in (place[z] - 1, place[z] + 1) if 0 <= k < n]
        neighbours += beside
        starts.append(len(neighbours))
    holds = np.ones(n)
    holds[[order[k] for k in ran]] = 0
    released = np.zeros(n)
    released[[order[k] for k in ran]] = 7
    at = memory(
        {"n": n, "n_machines": n, "n_guards": 2 * n, "n_neighbours": len(neighbours), "gap": gap, "steps": 7,
         "max_passes": 8, "t": 1.0},
        neighbour_starts=starts, neighbours=neighbours, released=released, released_by=np.where(released == 7, 1, 5),
        first_guard=2 * np.arange(n), hold_row=np.arange(n), holds=holds, fired=np.zeros(2 * n), met=np.zeros(n),
        continuous=np.where(known, 1, 0), zones=np.zeros(n), guard_machine=np.repeat(np.arange(n), 2),
        zones_history=np.zeros(9 * n), patterns_met=np.zeros(9),
    )  # fmt: skip
    fired = []
    return at, fired, switching(at, lambda _t, guards: fired.extend(guards))


@pytest.mark.parametrize("seed", range(12))
def test_a_front_is_expected_to_run_through_most_of_as_many_contacts_as_in_the_last_step(seed):
    rng = np.random.default_rng(seed)
    n, ran = 40, int(rng.integers(1, 15))
    begin = int(rng.integers(0, 5))
    order, h, gap = rng.permutation(n), rng.uniform(0.05, 0.5), 0.1
    known = np.zeros(2 * n, bool)
    known[2 * order[[begin, begin + ran - 1]] + 1] = True  # of the two ends of the front it was asked
    at, fired, kept = row_of_contacts(order, range(begin, begin + ran), known, gap=gap)
    length = plain_room("stepping.slip_fronts.length_of_front", "run", "stepping.contacts")
    last, first = order[begin + ran - 1], order[begin]
    assert length(at, last, order[begin + ran]) == ran
    assert begin == 0 or length(at, first, order[begin - 1]) == ran
    plain_room("stepping.slip_fronts.predict_fronts", "")(at, h)
    expected = int(RUNS_ON * h / (2 * gap) * ran)  # the last step was 2 gap long
    ahead = [order[k] for k in range(begin + ran, min(begin + ran + expected, n))]
    behind = [order[k] for k in range(max(begin - expected, 0), begin)]
    assert {i // 2 for i in fired} == {*ahead, *behind}
    assert all(i % 2 == 1 for i in fired)  # by the guard by which those before went
    assert all(at.array["continuous"][i] == 1 for i in fired)  # and of these it is taken for granted
    assert not at.array["met"].any()
    assert set(np.flatnonzero(at.array["released"] == 8).tolist()) == {*ahead, *behind}
    assert set(at.array["released_by"][[*ahead, *behind]].tolist()) <= {1}
    assert at.number["expecting"] == bool(fired)
    assert at.number["passes"] == len(fired[:1])
    assert kept


@pytest.mark.parametrize("stops", ["failed", "frozen", "gap", "n_neighbours", "law"])
def test_no_front_is_expected_where_nothing_tells_of_it(stops):
    known = np.ones(80, bool)
    known[2 * 5 + 1] = stops != "law"  # whether the law jumps by which the last one let go
    at, fired, kept = row_of_contacts(np.arange(40), range(6), known)
    if stops != "law":
        at.number[stops] = 0 if stops in ("gap", "n_neighbours") else 1
    plain_room("stepping.slip_fronts.predict_fronts", "")(at, 0.2)
    assert fired == []
    assert kept


def test_a_front_is_counted_no_farther_than_its_longest():
    at, _, kept = row_of_contacts(np.arange(100), range(90), np.ones(200, bool))
    assert plain_room("stepping.slip_fronts.length_of_front", "run", "stepping.contacts")(at, 89, 90) == LONGEST_FRONT
    assert kept


@pytest.mark.parametrize("seed", range(12))
def test_who_is_at_its_limit_and_rises_lets_go_with_another_whose_friction_falls(seed):
    rng = np.random.default_rng(seed)
    n, tolerance = 12, 1e-6
    here = tolerance * rng.choice([0.5, -0.5, -3.0], n)
    rises = rng.choice([2e-6, 1e-14, -1.0], n)  # in units of the tolerance 1e-6: two, hardly, not
    at = memory({"n": 1, "n_guards": n, "n_machines": n, "t_release": 1e308}, guard_machine=rng.permutation(n),
                fired=np.zeros(n), may_hold=rng.integers(0, 2, n), falls=rng.integers(0, 2, n), wrong=np.zeros(n),
                guard_tolerance=np.full(n, tolerance), g=here, g_end=here + rises, y=[0.0])  # fmt: skip
    kept = fields(at, 1, guards=(lambda _t, _y, g: np.copyto(g, here), n))
    first = rng.permutation(n)[: rng.integers(1, 4)].tolist()
    at.array["fired"][: len(first)], at.number["n_fired"] = first, len(first)
    plain_room("events.release.add_ties", "problem", "run", "point", "events")(at)
    falls = at.array["falls"][at.array["guard_machine"]] * at.array["may_hold"]
    ties = np.flatnonzero((falls == 1) & (here >= -tolerance) & (rises > 1e-6 * tolerance)).tolist()
    wanted = {*first, *ties} if falls[first].any() else set(first)
    found = at.array["fired"][: int(at.number["n_fired"])].tolist()
    assert found[: len(first)] == first
    assert sorted(found) == sorted(wanted)
    assert kept


def answers(seed, count, *, definite):
    """Answers T = A^-1 a of parts, with A of both signs or such that all its minors are above zero."""
    rng = np.random.default_rng(seed)
    A = rng.normal(size=(count, count))
    if definite:
        A = A @ A.T + 0.5 * np.eye(count) + 0.3 * (A - A.T)
    return A, memory({"n_pressing": count}, pressing_answer=np.linalg.inv(A).ravel(), pressing_wrong=np.zeros(count),
                     pressing_left=np.zeros(count * count))  # fmt: skip


@pytest.mark.parametrize("definite", [True, False])
@pytest.mark.parametrize("seed", range(15))
def test_of_many_rigid_parts_those_are_wrong_whose_own_minor_is_below_zero(seed, definite):
    """A_kk or T_kk below zero; where none is, leading minors of T that change sign."""
    A, at = answers(seed, 8, definite=definite)
    T = np.linalg.inv(A)
    rigid = plain_room("events.right_root.are_rigid_in_turn", "problem")(at)
    wrong = (A.diagonal() < 0) | (T.diagonal() < 0)
    if not wrong.any():
        minors = [1.0, *(np.linalg.det(T[:k, :k]) for k in range(1, 9))]
        wrong = np.array([after / before < 0 for before, after in itertools.pairwise(minors)])
    assert at.array["pressing_wrong"].tolist() == wrong.tolist()
    assert rigid == (not wrong.any())
    assert rigid or not definite


@pytest.mark.parametrize("seed", range(15))
def test_forces_that_are_marked_turn_and_all_have_their_nominal_size_at_least(seed):
    rng = np.random.default_rng(seed)
    y, rows = rng.choice([-4.0, -0.5, 0.0, 0.5, 4.0], 6), rng.permutation(6)[:4]
    at = memory({"n": 6, "n_pressing": 4}, y=y, absolute=np.full(6, 1e-3), relative=np.full(6, 1e-3), pressing_row=rows,
                pressing_wrong=np.zeros(4))  # fmt: skip
    bits = int(rng.integers(16))
    plain_room("events.right_root.mark", "problem")(at, bits)
    plain_room("events.right_root.turn_marked", "problem", "point")(at)
    wanted = y.copy()
    for k, row in enumerate(rows):
        turned = -1.0 if bits >> k & 1 else 1.0
        wanted[row] = turned * (-1.0 if y[row] < 0 else 1.0) * max(abs(y[row]), 1.0)
    assert at.array["y"].tolist() == wanted.tolist()
