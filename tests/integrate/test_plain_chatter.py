"""Machines that switch again and again, and what the log keeps of it, alone: against sums over histories at random."""

from __future__ import annotations

import math

import numpy as np
import pytest

from fairlead.integrate.events.chatter import AGAIN, CHATTER_STREAK, HOLD, MOST_HELD, STALL_LIMIT, STILL, STOP
from tests.integrate.plainly import plain_room
from tests.integrate.rooms import memory

DWELL = 1e-3


def machines(count, **numbers):
    """Machines at rest with a dwell of 1 ms, given unless numbers say otherwise; a guard each; room for events."""
    events = {f"event_{of}": np.zeros(60) for of in ("t", "machine", "before", "after", "guard", "position")}
    return memory(
        {"n": 1, "n_guards": count, "n_machines": count, "dwell": DWELL, "dwell_given": 1, "progress_floor": 1e-6,
         "step_floor_given": 1, "t_release": 1e308, "max_passes": 8, "event_capacity": 60, **numbers},
        guard_machine=np.arange(count), fired=np.zeros(count), chatters=np.zeros(count), streak=np.zeros(count),
        last_toggle=np.full(count, -1e308), blocked_until=np.full(count, -1e308), held_for=np.zeros(count),
        zones=np.zeros(count), zones_before=np.zeros(count), switches_by_machine=np.zeros(count), **events,
        boundary=np.zeros(count), zones_history=np.zeros(9 * count), patterns_met=np.zeros(9),
    )  # fmt: skip


@pytest.mark.parametrize("seed", range(10))
def test_a_machine_chatters_whose_toggles_follow_each_other_within_a_dwell_often_enough(seed):
    rng = np.random.default_rng(seed)
    gaps = DWELL * rng.choice([0.2, 0.9, 1.5, 0.0], 120, p=[0.5, 0.41, 0.06, 0.03])
    at, watch = machines(1, on_chatter=0), plain_room("events.chatter.watch_chatter", "")
    quick = wanted = 0
    for k, t in enumerate(np.cumsum(gaps)):
        at.number["t"] = t
        watch(at, 0)
        if k and gaps[k] > 0:  # a second toggle at one instant is none
            quick = quick + 1 if gaps[k] < DWELL else 0
            wanted += quick >= CHATTER_STREAK
        assert at.array["chatters"][0] == wanted
    assert wanted > 0
    assert at.number["t_release"] == 1e308  # told, and not held


@pytest.mark.parametrize(("what", "held", "stops"), [(0, False, 0), (HOLD, True, 0), (STOP, False, 1)])
def test_what_chatters_is_held_or_ends_the_run_as_asked(what, held, stops):
    at, watch = machines(3, on_chatter=what), plain_room("events.chatter.watch_chatter", "")
    for k in range(CHATTER_STREAK + 1):
        at.number["t"] = 1.0 + 1e-4 * k
        watch(at, 2)
    assert at.array["chatters"].tolist() == [0, 0, 1]
    assert (at.array["blocked_until"][2] > at.number["t"]) == held
    assert at.number["stop_asked"] == stops
    assert stops == 0 or at.number["culprit"] == 2


def test_what_gives_back_a_share_of_an_impact_bounces_and_does_not_chatter():
    at, watch = machines(1, on_chatter=STOP, rebounds=1), plain_room("events.chatter.watch_chatter", "")
    at.point("rebound", np.array([0.5]), np.float64)
    for k in range(3 * CHATTER_STREAK):
        at.number["t"] = 1e-4 * k
        watch(at, 0)
    assert at.number["stop_asked"] == at.array["chatters"][0] == 0
    at.array["rebound"][0] = 0.0
    for k in range(3):
        at.number["t"] = 1.0 + 1e-4 * k
        watch(at, 0)
    assert at.number["stop_asked"] == 0  # a long pause begins a new streak
    at.array["holder"][0], at.array["streak"][0] = -1, CHATTER_STREAK
    at.array["rebound"][0], at.number["t"] = 0.5, 1.0003
    watch(at, 0)
    assert at.number["stop_asked"] == 1  # the row that rebounds is of no machine


@pytest.mark.parametrize("longest", [1.0, 10 * DWELL])
def test_a_dwell_is_twice_as_long_as_one_just_over_up_to_a_limit(longest):
    """A dwell by the motion; `dwell` is the longest that may be."""
    at = machines(2, dwell=longest, dwell_given=0)
    at.array["slope"][:], at.array["weight"][:], at.array["differential"][:] = STILL / DWELL, 1.0, 1
    block = plain_room("events.chatter.block", "problem", "run", "point", "events")
    t, held, wanted = 5.0, [], []
    for k in range(12):
        at.number["t"] = t
        block(at, 1)
        held.append(at.array["blocked_until"][1] - t)
        wanted.append(min(DWELL * 2**k, MOST_HELD * DWELL, longest))
        t += held[-1] * (1 + 0.9 * AGAIN)  # not yet so long after it
    assert held == pytest.approx(wanted, rel=1e-9)
    assert at.number["t_release"] == pytest.approx(5.0 + DWELL)  # the first of all
    at.number["t"] = t + AGAIN * held[-1]
    block(at, 1)
    assert at.array["blocked_until"][1] - at.number["t"] == pytest.approx(DWELL)
    assert at.array["blocked_until"][0] == -1e308


def test_a_dwell_and_a_floor_are_no_longer_than_nothing_moves():
    """By the fastest of what has a rate and counts; a floor is a thousandth of that, and what the time resolves."""
    rng = np.random.default_rng(3)
    at = memory(
        {"n": 6, "dwell": 9.0, "progress_floor": 8.0, "t": 7.0}, slope=rng.normal(size=6),
        weight=rng.uniform(0.1, 1, 6), differential=[1, 1, 0, 1, 1, 1], unweighed=[0, 1, 0, 0, 0, 0],
    )  # fmt: skip
    at.array["slope"][[1, 2]] = 1e6
    counts = [0, 3, 4, 5]
    still = STILL / np.max(np.abs(at.array["slope"])[counts] / at.array["weight"][counts])
    dwell = plain_room("events.chatter.dwell_here", "run", "point")
    floor = plain_room("events.chatter.floor_here", "run", "point")
    assert dwell(at) == pytest.approx(still)
    assert floor(at) == pytest.approx(1e-3 * still)
    for name, one in (("dwell", dwell), ("floor", floor)):
        within = plain_room(f"events.chatter.is_within_{name}", "run", "point")
        assert within(at, 0.999 * one(at))
        assert not within(at, one(at))
    at.number["t"] = 1e12
    assert floor(at) == pytest.approx(1e-2)
    at.number["dwell_given"] = at.number["step_floor_given"] = 1
    assert (dwell(at), floor(at)) == (9.0, 8.0)
    at.number["dwell_given"] = at.number["step_floor_given"] = 0
    at.array["slope"][counts] = 0.0
    assert (dwell(at), floor(at)) == (9.0, 8.0)
    assert plain_room("events.chatter.still_for", "point")(at) == math.inf


@pytest.mark.parametrize("bounces", [False, True])
def test_machines_whose_switches_do_not_advance_are_held_and_said_to_chatter_unless_they_bounce(bounces):
    at = machines(3, rebounds=1, t_last_switch=-1e308)
    at.point("rebound", np.array([0.5 if bounces else 0.0]), np.float64)
    at.array["holder"][0] = 2
    watch = plain_room("events.chatter.watch_progress", "problem", "run", "point", "events")
    for k in range(STALL_LIMIT + 1):
        assert at.array["blocked_until"][2] < 0
        at.number["t"], at.number["n_fired"] = 1.0 + 1e-7 * k, 1
        at.array["fired"][0] = 2
        watch(at)
    assert at.number["stalls"] == STALL_LIMIT
    assert at.array["blocked_until"].argmax() == 2
    assert at.array["blocked_until"][2] == pytest.approx(at.number["t"] + DWELL, rel=1e-12)
    assert at.array["chatters"].tolist() == [0, 0, 0 if bounces else 1]
    at.number["n_fired"] = 0
    watch(at)
    assert at.number["stalls"] == STALL_LIMIT  # where nothing fired nothing is said
    at.number["t"], at.number["n_fired"] = 1.1, 1
    watch(at)
    assert at.number["stalls"] == 0


def test_of_a_settlement_without_end_those_are_held_that_still_switch_in_its_second_half():
    """Machine 0 goes to and fro, 1 switched early, 2 never, 3 goes to and fro and is held already."""
    at = machines(4, passes=8, t=2.0, switches=12, n_fired=3)
    history = np.array([[k % 2, int(k > 1), 0, k % 2] for k in range(9)])
    at.array["zones_history"][:] = history.ravel()
    at.array["zones"][:] = history[8]
    at.array["blocked_until"][3] = 3.0
    for k in range(8):
        for z in (0, 1):
            if history[k, z] != history[k + 1, z]:
                place = int(at.number["events"])
                for of, value in zip(("t", "machine", "before", "after", "guard", "position"),
                                     (2.0, z, history[k, z], history[k + 1, z], 7, k), strict=True):  # fmt: skip
                    at.array[f"event_{of}"][place] = value
                at.number["events"] += 1
    at.number["total_events"] = at.number["events"]
    at.array["switches_by_machine"][:] = 8, 1, 0, 0
    assert plain_room("events.chatter.hold_what_circles", "")(at)
    assert (at.array["blocked_until"] > 2.0).tolist() == [True, False, False, True]
    assert at.array["chatters"].tolist() == [1, 0, 0, 0]
    assert at.array["event_machine"][: int(at.number["events"])].tolist() == [1]  # back where it began: no switch
    assert at.array["switches_by_machine"].tolist() == [0, 1, 0, 0]
    assert (at.number["switches"], at.number["total_events"], at.number["n_fired"]) == (4, 1, 0)
    assert not plain_room("events.chatter.hold_what_circles", "")(at)  # all that circle are held


@pytest.mark.parametrize("seed", range(20))
def test_of_the_changes_of_a_machine_at_an_instant_the_last_is_kept_as_one_from_where_it_was(seed):
    rng = np.random.default_rng(seed)
    count, machine, first = 30, 1, int(rng.integers(3))
    columns = {"t": rng.choice([1.0, 2.0], count), "machine": rng.integers(0, 3, count), "guard": np.arange(count),
               "before": rng.integers(0, 3, count), "after": rng.integers(0, 3, count),
               "position": rng.integers(0, 9, count)}  # fmt: skip
    at = machines(1, t=2.0, events=count, total_events=100)
    for of, values in columns.items():
        at.array[f"event_{of}"][:count] = values
    rows = [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)]
    mine = [k for k, row in enumerate(rows) if row["t"] == 2.0 and row["machine"] == machine]
    wanted = [row for k, row in enumerate(rows) if k not in mine[:-1]]
    if mine and rows[mine[-1]]["after"] == first:
        wanted.remove(rows[mine[-1]])
    for row in wanted:
        row["before"] = first if row["t"] == 2.0 and row["machine"] == machine else row["before"]
    gone = plain_room("record.rows.keep_last_event", "point", "recorder")(at, machine, first)
    assert gone == count - len(wanted)
    assert (at.number["events"], at.number["total_events"]) == (len(wanted), 100 - gone)
    for of in columns:
        assert at.array[f"event_{of}"][: len(wanted)].tolist() == [row[of] for row in wanted]


@pytest.mark.parametrize("seed", range(20))
def test_the_log_has_every_machine_that_changed_once_and_guards_that_changed_nothing(seed):
    rng = np.random.default_rng(seed)
    guards, count = 8, 4
    at = machines(guards, n_machines=count, t=3.0, passes=5, is_part=1)
    machine = rng.integers(-1, count, guards)
    at.array["guard_machine"][:] = machine
    fired = rng.permutation(guards)[: rng.integers(0, guards)]
    at.array["fired"][: len(fired)], at.number["n_fired"] = fired, len(fired)
    at.array["zones_before"][:count], at.array["zones"][:count] = rng.integers(0, 3, count), rng.integers(0, 3, count)
    before, zones = at.array["zones_before"][:count].copy(), at.array["zones"][:count].copy()
    at.array["boundary"][:count] = rng.random(count) < 0.3
    plain_room("events.settling.log_changes", "")(at)
    rows = list(zip(*(at.array[f"event_{of}"][: int(at.number["events"])].tolist()
                      for of in ("machine", "before", "after", "guard")), strict=True))  # fmt: skip
    changed = np.flatnonzero(before != zones)
    first = {z: next((int(i) for i in fired if machine[i] == z), -1) for z in range(count)}
    idle = [(-1, 0, 0, int(i)) for i in fired if machine[i] < 0]
    idle += [(z, before[z], before[z], int(i)) for i in fired if (z := machine[i]) >= 0 and z not in changed]
    assert sorted(rows) == sorted([*idle, *((z, before[z], zones[z], first[z]) for z in changed)])
    assert at.number["switches"] == len(changed)
    assert at.array["switches_by_machine"][:count].tolist() == [int(z in changed) for z in range(count)]
    assert at.number["boundary_switched"] == any(at.array["boundary"][z] for z in changed)
    assert set(at.array["event_position"][: len(rows)].tolist()) <= {5}
