"""The turn from a whole to the part that moves and back, by hand: what goes along, and when it is looked for."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from fairlead.integrate import Run, parts
from fairlead.integrate.codes import SETTLE_WHOLE, TRY
from fairlead.integrate.parts import (
    BY_GUARD,
    BY_MACHINE,
    BY_UNKNOWN,
    CARRIED,
    LOOK_BASE,
    LOOK_COST,
    SLOPES,
    WORTH,
    ActiveSubsystem,
)
from fairlead.integrate.prepare import NEVER_LOOK
from fairlead.integrate.problem import EVENT
from fairlead.integrate.rodas.tableau import TABLEAUS
from tests.unit.stacks import Stack, hold

BLOCKS = 8
ROW = Stack(BLOCKS, {f"c{k}": (0, k) for k in range(1, BLOCKS + 1)}, {f"s{k}": (k, k + 1) for k in range(1, BLOCKS)})
"""Blocks side by side on the floor, a spring between neighbours."""


@pytest.fixture
def row(scene, monkeypatch):
    """row(*sliding, **settings) -> a run of the row at its start, in which these blocks slide at 0.1 m/s."""
    monkeypatch.setattr(parts, "LEAST", 1)
    monkeypatch.setattr(parts, "MARGIN", 1)

    def make(*sliding, **settings):
        run = Run(stop=1.0, **settings)
        active = ActiveSubsystem(scene(ROW.text()).system, run, TABLEAUS[run.method])
        slide(active, *sliding)
        active.whole.number["t_release"] = np.inf
        return active

    return make


def slide(active, *sliding):
    """Let these blocks slide at 0.1 m/s, and the others hold."""
    problem, y = active.whole_problem, active.whole.array["y"]
    hold(problem, [f"c{k}" for k in range(1, BLOCKS + 1) if k not in sliding])
    for k in range(1, BLOCKS + 1):
        y[problem.unknown_names.index(f"n{k}.v")] = 0.1 if k in sliding else 0.0


def look(active, steps):
    """Look after so many steps of what is in force."""
    active.memory.number["steps"] = steps
    active.restrict()


def machine(active, block):
    return active.whole_problem.machine_names.index(f"c{block}")


def cost(active):
    return LOOK_COST // active.whole_problem.n + LOOK_BASE


def filled(active, memory, chance):
    """Other numbers in everything that goes along."""
    for name in (*BY_UNKNOWN, *SLOPES, *BY_GUARD, *BY_MACHINE):
        if name not in ("zones", "y"):
            array = memory.array[name]
            array[:] = chance.integers(1, 1000, len(array))


def test_a_part_is_taken_at_the_second_look_if_nothing_switched_beside_it(row):
    """A first look shows what moves; that it was right shows the second."""
    active = row(1)
    look(active, 10)
    assert active.part is None
    look(active, 20)
    assert {active.problem.unknown_names[k] for k in range(active.problem.n)} >= {"n1.x", "n1.v"}
    assert active.problem.n < active.whole_problem.n / 2
    assert active.memory.number["is_part"] == 1
    assert active.memory.number["restrict_at"] == 20 + WORTH * cost(active)


@pytest.mark.parametrize(("switched", "taken"), [(1, True), (2, True), (4, False), (8, False)])
def test_what_switches_beside_what_moves_shows_that_too_little_was_seen(row, switched, taken):
    """With a margin of an equation the contact of the next block stays; further ones do not."""
    active = row(1)
    look(active, 10)
    active.whole.array["switches_by_machine"][machine(active, switched)] += 1
    look(active, 20)
    assert (active.part is not None) == taken


def test_a_machine_that_is_kept_from_switching_is_not_at_rest(row):
    active = row(1)
    active.whole.number["t_release"] = 0.5
    for steps in (10, 20, 30):
        look(active, steps)
        assert active.part is None


def test_looks_without_success_grow_rare(row):
    """Each wait is twice the one before, from what a cut costs."""
    active = row(*range(1, BLOCKS + 1))
    steps, waits = 10, []
    for _ in range(6):
        look(active, steps)
        waits.append(int(active.whole.number["restrict_at"]) - steps)
        steps = int(active.whole.number["restrict_at"])
    assert waits[0] == cost(active)
    assert all(later == 2 * sooner for sooner, later in itertools.pairwise(waits))


@pytest.mark.parametrize(
    ("settings", "least", "looks"), [({}, 1, True), ({"real_time": True}, 1, False), ({}, 10_000, False)]
)
def test_looks_are_for_large_problems_whose_runs_may_stop_for_them(row, monkeypatch, settings, least, looks):
    monkeypatch.setattr(parts, "LEAST", least)
    if settings:
        settings = settings | {"fixed_step": 1e-3, "engine": "stepping"}
    active = row(1, **settings)
    assert (active.whole.number["restrict_at"] != NEVER_LOOK) == looks


def test_what_a_run_knows_goes_along_to_the_part_and_comes_back(row):
    """By unknown, by guard and by machine at the places of the part; what rests is as it was, but has no slopes."""
    active = row(1)
    chance = np.random.default_rng(6)
    filled(active, active.whole, chance)
    for name in CARRIED:
        if name not in ("t_release", "steps", "t"):
            active.whole.number[name] = int(chance.integers(0, 2))
    look(active, 10)
    look(active, 20)
    part = active.part
    whole = {name: active.whole.array[name].copy() for name in (*BY_UNKNOWN, *SLOPES, *BY_GUARD, *BY_MACHINE)}
    numbers = {name: active.whole.number[name].item() for name in CARRIED}
    places = dict.fromkeys((*BY_UNKNOWN, *SLOPES), part.unknowns)
    places |= dict.fromkeys(BY_GUARD, part.guards) | dict.fromkeys(BY_MACHINE, part.machines)
    for name, at in places.items():
        np.testing.assert_array_equal(active.memory.array[name], whole[name][at], err_msg=name)
    assert {name: active.memory.number[name].item() for name in CARRIED} == numbers
    filled(active, active.memory, chance)
    active.memory.array["y"][0] += 0.25
    active.memory.number["t"] = 0.125
    mine = {name: active.memory.array[name].copy() for name in places}
    found = active.finish()
    assert found.number["t"] == 0.125
    for name, at in places.items():
        wanted = np.zeros_like(whole[name]) if name in SLOPES else whole[name]
        wanted[at] = mine[name]
        np.testing.assert_array_equal(found.array[name], wanted, err_msg=name)


def test_zone_changes_of_a_part_are_told_by_machines_and_guards_of_the_whole(row):
    """Negative numbers say that there is none, and stay."""
    active = row(5)
    look(active, 10)
    look(active, 20)
    part, memory = active.part, active.memory
    count = min(len(part.machines), 3)
    memory.array["event_machine"][:count] = np.arange(count)
    memory.array["event_guard"][:count] = [len(part.guards) - 1, -1, -2][:count]
    found = active.events(count)
    assert found.dtype == EVENT
    assert [active.whole_problem.machine_names[m] for m in found["machine"]] == active.problem.machine_names[:count]
    assert found["guard"].tolist() == [part.guards[-1], -1, -2][:count]
    assert active.whole_problem.machine_names[found["machine"][0]] != active.whole_problem.machine_names[0]


@pytest.mark.parametrize("settled", [False, True])
@pytest.mark.parametrize("served", [1, 10**6])
def test_the_whole_goes_on_where_the_boundary_changed(row, settled, served):
    """It settles there if a contact has switched. A part that did not serve long is looked for later, and is larger."""
    active = row(1)
    look(active, 10)
    look(active, 20)
    active.memory.number["boundary_switched"] = int(settled)
    active.memory.number["steps"] = steps = 20 + served
    margin, price = active._margin, cost(active)
    pause = active._pause
    active.reactivate()
    assert active.part is None
    assert active.memory is active.whole
    assert active.problem is active.whole_problem
    assert active.whole.number["phase"] == (SETTLE_WHOLE if settled else TRY)
    assert active.whole.number["steps"] == steps
    assert active.whole.number["boundary_switched"] == 0
    worth = served >= WORTH * price
    assert active._margin == (parts.MARGIN if worth else 2 * margin)
    assert active.whole.number["restrict_at"] == steps + (price if worth else pause)


def test_a_saved_run_goes_on_with_the_part_it_worked_on(row):
    """Saved on a part, moved on and turned back to the whole, restored: the part, its place and its counts again."""
    active = row(1)
    look(active, 10)
    look(active, 20)
    active.memory.array["y"][0] = 0.5
    saved = active.save()
    before, own = active.part, {name: getattr(active, name) for name in ("_pause", "_margin", "_since")}
    active.memory.array["y"][0] = 0.75
    active.memory.number["boundary_switched"] = 1
    active.reactivate()
    active.restore(saved)
    assert active.part is before
    assert active.memory.array["y"][0] == 0.5
    assert active.memory.number["is_part"] == 1
    assert {name: getattr(active, name) for name in own} == own
    assert active.finish().array["y"][before.unknowns[0]] == 0.5


def test_another_run_takes_over_where_a_saved_one_was(row):
    """The part is put to work for the other run's whole: what it becomes is given back there, and not to the first."""
    one = row(1)
    other = ActiveSubsystem(one.whole_problem.of, Run(stop=1.0), TABLEAUS[Run(stop=1.0).method])
    look(one, 10)
    look(one, 20)
    one.memory.array["y"][0] = 0.5
    other.restore(one.save())
    assert other.part.whole is other.whole_problem
    np.testing.assert_array_equal(other.part.unknowns, one.part.unknowns)
    other.memory.array["y"][0] = 0.75
    assert other.finish().array["y"][other.part.unknowns[0]] == 0.75
    assert one.finish().array["y"][one.part.unknowns[0]] == 0.5
