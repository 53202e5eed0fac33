"""The room `events` alone: patterns that come again, ranks by which one machine goes first, guards that fire."""

from __future__ import annotations

import functools

import numpy as np
import pytest

from tests.integrate.rooms import entry, memory


@functools.cache
def met_before():
    from fairlead.integrate.events.patterns import note_pattern

    return entry(note_pattern, ("run", "events.settling"), "", "b")


@functools.cache
def numbered():
    from fairlead.integrate.events.least_index import number_machines

    return entry(number_machines, ("events",), "i")


@functools.cache
def first_kept():
    from fairlead.integrate.events.least_index import keep_first

    return entry(keep_first, ("events",))


@functools.cache
def fired_of():
    from fairlead.integrate.events.crossing import collect_fired

    return entry(collect_fired, ("events.guards",), "b", "i")


@pytest.mark.parametrize("seed", range(10))
def test_a_pattern_of_zones_that_was_in_force_in_this_stage_is_known_again(seed):
    rng = np.random.default_rng(seed)
    machines, passes, begins = 3, 30, int(rng.integers(0, 10))
    zones = np.zeros(machines, np.int64)
    at = memory({"n_machines": machines, "max_passes": passes}, zones=zones, patterns_met=np.zeros(passes + 1),
                zones_history=np.zeros((passes + 1) * machines))  # fmt: skip
    at.point("zones", zones, np.int64)
    seen = []
    for k in range(passes):
        zones[:] = rng.integers(0, 3, machines)
        at.number["passes"], at.number["stage_from"] = k, begins
        assert met_before()(at) == (tuple(zones) in seen[begins:])
        seen.append(tuple(zones))
    kept = at.array["zones_history"].reshape(-1, machines)[:passes]
    assert [tuple(zones) for zones in kept.tolist()] == seen


@pytest.mark.parametrize("seed", range(10))
def test_which_machine_goes_first_does_not_hang_on_the_order_in_which_they_are_stored(seed):
    rng = np.random.default_rng(seed)
    machines = 5
    g, tolerance = rng.normal(size=machines), rng.uniform(0.5, 2.0, machines)

    def chosen(order):
        at = memory(
            {"n_machines": machines, "n_guards": machines, "n_fired": machines}, guard_machine=np.arange(machines),
            guard_tolerance=tolerance[order], fired=np.arange(machines), rank=np.zeros(machines),
        )  # fmt: skip
        numbered()(at, g[order].copy())
        first_kept()(at)
        assert at.number["n_fired"] == 1
        return order[at.array["fired"][0]]

    assert chosen(np.arange(machines)) == chosen(rng.permutation(machines))


@pytest.mark.parametrize("never_below", [False, True])
def test_of_a_crossing_those_fire_that_come_from_below_zero_unless_one_was_never_below(never_below):
    """One that is above its tolerance and never was below says that the zones were wrong before the step."""
    from fairlead.integrate.events.crossing import CROSSING, INCONSISTENT_START

    third = [1.0, 0.5, 1.0] if never_below else [-1.0, -0.5, -0.5]
    at = memory(
        {"n_guards": 4}, g_left=[-1.0, -1.0, third[0], -1.0], g_right=[0.5, -0.5, third[1], 0.0],
        g_end=[1.0, -1.0, third[2], 1.0], g=[-1.0, -1.0, third[0], -1.0], guard_tolerance=[1e-3] * 4, fired=[0] * 4,
    )  # fmt: skip
    assert fired_of()(at, True) == (INCONSISTENT_START if never_below else CROSSING)
    fired = set(at.array["fired"][: int(at.number["n_fired"])].tolist())
    assert fired == ({2} if never_below else {0, 3})
