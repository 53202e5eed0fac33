"""The room `events` where contacts let go: the order of release, contacts that contradict each other, open unknowns."""

from __future__ import annotations

import ctypes
import functools

import numpy as np
import pytest

from fairlead.integrate.codes import DONE
from fairlead.integrate.linear import ordering
from tests.integrate.rooms import entry, fields, memory
from tests.integrate.test_linear import memory_for
from tests.integrate.test_room_linear import algebraic


@functools.cache
def ordered():
    from fairlead.integrate.events.release import order_matters

    return entry(order_matters, ("problem", "events"), "", "b")


@functools.cache
def opened():
    from fairlead.integrate.events.release import open_level

    return entry(open_level, ("problem", "point", "linear.matrices", "events"))


@functools.cache
def closed():
    from fairlead.integrate.events.release import close_level

    return entry(close_level, ("problem", "events.loads"))


@functools.cache
def pushed():
    from fairlead.integrate.events.release import acceleration_by_forces

    return entry(acceleration_by_forces, ("problem", "point", "linear.matrices"), "", "d")


@functools.cache
def contradict():
    from fairlead.integrate.events.torn_loose import find_contradictions

    return entry(find_contradictions, ("problem", "point"), "d", "b")


@functools.cache
def fired_first():
    from fairlead.integrate.events.torn_loose import fire_first

    return entry(fire_first, ("problem", "point", "events.guards"))


@functools.cache
def near():
    from fairlead.integrate.events.left_open import change_to_near_pattern

    return entry(change_to_near_pattern, ("",), "", "b")


# The order of release


def doubted(falls, fired, zones, first=(0, 0, 0)):
    """Three contacts with a guard each: whether friction falls as it lets go, which fired, zones now and at first."""
    at = memory(
        {"n_guards": 3, "n_machines": 3, "falling": int(any(falls)), "n_fired": len(fired)}, fired=[*fired, 0, 0],
        guard_machine=[0, 1, 2], falls=falls, may_hold=[1, 1, 1], zones=zones, zones_history=first,
    )  # fmt: skip
    return at


@pytest.mark.parametrize(
    ("falls", "fired", "zones", "matters"),
    [
        ((0, 0, 0), (0, 1), (0, 0, 0), False),  # equal levels: no order decides
        ((0, 1, 0), (1,), (0, 0, 0), True),  # it is in doubt
        ((0, 1, 0), (0,), (0, 0, 0), False),  # another is
        ((0, 1, 0), (0,), (0, 1, 0), True),  # it has let go in this settlement
    ],
)
def test_the_order_matters_where_one_lets_go_whose_friction_falls(falls, fired, zones, matters):
    assert ordered()(doubted(falls, fired, zones)) == matters


def test_the_order_is_asked_for_once_a_settlement():
    at = doubted((1, 1, 1), (0, 1), (0, 0, 0))
    at.number["ordered"] = 1
    assert not ordered()(at)


@pytest.mark.parametrize("in_circle", [False, True])
def test_what_a_law_jumps_by_is_a_load_above_what_is_out_already(in_circle):
    """r = C x - out, and no more is out in the row that changed its meaning, nor in those it shares its force with."""
    n, jumps, out = 3, np.array([4.0, 0.5, -2.0]), np.array([1.0, 2.0, 3.0])
    at = memory(
        {"n": n, "n_machines": 2, "levels": 1, "level_due": 1, "n_guards": 2},
        zones=[0, 1], zones_before=[0, 0], holder=[0, 1, -1], circle=[1, 1, 0] if in_circle else [0, 0, 0],
        circle_changed=np.zeros(n), out=np.concatenate([out, np.zeros(15 * n)]), left=np.full(16, 0.25),
        born=[1, 1], fast_slip=[5.0, 6.0], guard_machine=[0, 1], x=np.zeros(n), f=np.zeros(n), y=np.zeros(n),
        v=np.zeros(n), slope=np.zeros(n), differential=[1, 1, 1], mass_starts=np.zeros(n + 1), mass_rows=[0],
    )  # fmt: skip
    kept = fields(at, n, rhs=(lambda _t, _y, f: np.copyto(f, jumps), n))
    opened()(at)
    still_out = np.where([in_circle, True, False], 0.0, out)
    np.testing.assert_array_equal(at.array["out"][: 2 * n], [*still_out, *(jumps - still_out)])
    assert at.number["levels"] == 2
    assert at.array["left"][:2].tolist() == [0.25, 1.0]  # all of the new one is out
    assert at.array["born"].tolist() == [1, 0]  # whoever changed slips since no time
    assert at.array["fast_slip"].tolist() == [5.0, 0.0]
    assert at.array["zones_before"].tolist() == [0, 1]
    assert kept


def test_a_slip_that_began_in_a_level_above_is_none_when_that_is_taken_off():
    at = memory({"n_guards": 3, "levels": 2}, born=[1, 2, 0], fast_slip=[3.0, 4.0, 0.0])
    closed()(at)
    assert at.array["born"].tolist() == [1, 0, 0]
    assert at.array["fast_slip"].tolist() == [3.0, 0.0, 0.0]
    assert at.number["levels"] == 1


def test_the_largest_acceleration_that_one_force_alone_would_give_tells_what_is_rounding():
    """Forces of 3 N and -5 N on 2 kg, which nearly cancel: 2.5 m/s^2, in weights of 0.1 m/s."""
    at = memory(
        {"n": 3, "n_jacobian": 2, "n_mass": 1}, x=[0.0, 3.0, -5.0], u=np.zeros(3), jacobian=[1.0, 1.0],
        jacobian_starts=[0, 0, 1, 2], jacobian_rows=[0, 0], is_speed=[1, 0, 0], differential=[1, 0, 0],
        mass=[2.0], mass_starts=[0, 1, 1, 1], mass_rows=[0], mass_columns=[0], diagonal_mass=[0, -1, -1],
        weight=[0.1, 1.0, 1.0], unweighed=[0, 0, 0],
    )  # fmt: skip
    assert pushed()(at) == pytest.approx(25.0)


# Held contacts that contradict each other


@pytest.mark.parametrize(
    ("slips", "left"),
    [
        ((0.2, -0.1, 0.0, 0.0), (0.2, -0.1, 0.0, 0.0)),  # two of the first circle
        ((0.2, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)),  # one alone: what it follows has jumped
        ((0.2, 1e-8, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)),  # the other is rounding
        ((0.2, -0.1, 5.0, 0.0), (0.2, -0.1, 0.0, 0.0)),  # a row of no circle
        ((1e-4, -1e-4, 0.0, 0.0), (0.0, 0.0, 0.0, 0.0)),  # all are below what counts
    ],
)
def test_contacts_of_a_circle_contradict_each_other_where_more_than_one_of_them_slips(slips, left):
    at = memory({"n": 4}, circle=[1, 1, 0, 1], v=slips, b=np.zeros(4), x=np.zeros(4))
    assert contradict()(at, 1e-3) == any(left)
    np.testing.assert_array_equal(at.array["v"], left)


def test_of_each_circle_the_first_to_reach_its_limit_lets_go_and_those_that_tie_with_it():
    """Guards at -2, -1, -1 and -3 that rise by 4, 4, 4 and 1 on the way: limits at 1/2, 1/4, 1/4 and 3."""
    g, rise = np.array([-2.0, -1.0, -1.0, -3.0, -1e-9]), np.array([4.0, 4.0, 4.0, 1.0, 0.0])
    at = memory(
        {"n": 3, "n_guards": 5}, circle=[1, 1, 2], x=np.zeros(3), bounded_row=[0, 0, 1, 2, 2], fired=np.zeros(5),
        g=g, g_probe=g + rise, guard_tolerance=np.full(5, 1e-9),
    )  # fmt: skip
    fired_first()(at)
    assert at.array["fired"][: int(at.number["n_fired"])].tolist() == [1, 2, 3]


# Patterns that leave an unknown open


class Open:
    """Two contacts (zones 0 holds, 1 slides), of which `needed` zones determine the unknown of the diagonal W."""

    def __init__(self, determined, zones, before, first=None, g=(-1.0, -1.0)):
        problem, _ = algebraic(1, np.ones((1, 1), dtype=bool), True)
        at = self.at = memory_for(problem, ordering.dense_plan(problem))
        number = at.number
        number["n_machines"], number["n_guards"], number["passes"] = 2, 2, 1
        of_machines = {"zones": zones, "zones_before": before, "zones_history": [*(first or before), *zones]}
        for name, values in of_machines.items():
            at.point(name, np.array(values), np.int64)
        of_guards = {"guard_machine": [0, 1], "may_hold": [1, 1], "fired": [0, 0]}
        for name, values in of_guards.items():
            at.point(name, np.array(values), np.int64)
        for name, values in {"guard_tolerance": [1e-9, 1e-9], "g_probe": [0.0, 0.0], "blocked_until": [0, 0]}.items():
            at.point(name, np.array(values), np.float64)
        zone = at.array["zones"]

        def jacobian(_t, _y, values):
            values[:] = 1.0 if tuple(zone) in determined else 0.0

        def guards(_t, _y, out):
            out[:] = g

        self.kept = fields(at, 1, jacobian=(jacobian, 1), guards=(guards, 2))
        whole = ctypes.c_int64
        self.kept.append(ctypes.CFUNCTYPE(None, whole, whole)(lambda _context, _at: None))
        number["call_mass"] = ctypes.cast(self.kept[-1], ctypes.c_void_p).value

        def switch(_context, _t, _y, fired, count):
            for i in np.ctypeslib.as_array((whole * count).from_address(fired)):
                zone[i] = 1

        self.kept.append(ctypes.CFUNCTYPE(None, whole, ctypes.c_double, whole, whole, whole)(switch))
        number["call_switch"] = ctypes.cast(self.kept[-1], ctypes.c_void_p).value
        at.spread()

    def changed(self):
        """(whether another pattern was put in force, zones, zones before)."""
        said = near()(self.at)
        return said, self.at.array["zones"].tolist(), self.at.array["zones_before"].tolist()


def test_a_pattern_that_leaves_nothing_open_is_kept():
    assert Open({(1, 1)}, (1, 1), (0, 0)).changed() == (False, [1, 1], [0, 0])


def test_of_two_that_let_go_only_one_does_where_both_leave_an_unknown_open():
    assert Open({(0, 1)}, (1, 1), (0, 0)).changed() == (True, [0, 1], [1, 1])


def test_one_that_let_go_before_goes_back_where_another_that_lets_go_leaves_an_unknown_open():
    """The two exchange their places: contact 0 slides since the pass before, 1 since this one."""
    assert Open({(0, 1)}, (1, 1), (1, 0), first=(0, 0)).changed() == (True, [0, 1], [1, 1])


def test_another_that_holds_lets_go_where_one_that_was_caught_holds_too_much():
    """Contact 1 was caught, and both cannot hold; 0 is nearest to its limit and lets go."""
    found = Open({(1, 0)}, (0, 0), (0, 1), first=(0, 1), g=(-0.5, -1.0)).changed()
    assert found == (True, [1, 0], [0, 0])


def test_zones_stay_as_they_are_where_no_pattern_nearby_determines_all():
    assert Open(set(), (1, 1), (0, 0)).changed() == (False, [1, 1], [0, 0])


# Consistent points


@functools.cache
def consistent():
    from fairlead.integrate.events.consistent import newton, prepare_consistent, solve_point
    from fairlead.integrate.memory.foreign import compiled

    @compiled
    def full(m, iterations):
        status = prepare_consistent(m.problem, m.point, m.linear)
        return status if status != DONE else newton(m.problem, m.point, m.linear, iterations)

    return entry(full, ("",), "i", "i"), entry(solve_point, ("",), "i", "i")


class Law:
    """One algebraic unknown x with a law f(x) = 0."""

    def __init__(self, law, slope, x):
        problem, _ = algebraic(1, np.ones((1, 1), dtype=bool), True)
        at = self.at = memory_for(problem, ordering.dense_plan(problem))
        at.number["n_algebraic"] = 1
        given = {"y": [x], "cap": [np.inf], "absolute": [1e-9], "relative": [1e-9], "y_kept": [0.0]}
        for name, values in given.items():
            at.point(name, np.array(values), np.float64)
        at.point("unweighed", np.array([0]), np.int64)
        self.kept = fields(
            at, 1, rhs=(lambda _t, y, f: f.fill(law(y[0])), 1), jacobian=(lambda _t, y, J: J.fill(slope(y[0])), 1)
        )
        whole = ctypes.c_int64
        self.kept.append(ctypes.CFUNCTYPE(None, whole, whole)(lambda _context, _at: None))
        at.number["call_mass"] = ctypes.cast(self.kept[-1], ctypes.c_void_p).value
        at.spread()

    @property
    def x(self):
        return self.at.array["y"][0]


def test_a_consistent_point_is_the_root_of_the_laws():
    """x + x^3 = 10 at x = 2, from afar."""
    law = Law(lambda x: 10.0 - x - x**3, lambda x: -1.0 - 3.0 * x * x, 4.0)
    assert consistent()[0](law.at, 12) == DONE
    assert law.x == pytest.approx(2.0, rel=1e-12)


def test_a_flow_that_stops_at_once_is_found_by_shares_of_updates_where_full_ones_go_to_and_fro():
    """x/(x^2 + c^2)^(1/4) = 0: far from zero a full update leads from x to -x."""
    c = 1e-3

    def law(x):
        return -x / (x * x + c * c) ** 0.25

    def slope(x):
        return -((x * x + c * c) ** -0.25) + 0.5 * x * x * (x * x + c * c) ** -1.25

    full, damped = (Law(law, slope, 1.0) for _ in range(2))
    assert consistent()[0](full.at, 12) != DONE
    assert consistent()[1](damped.at, 12) == DONE
    assert damped.x == pytest.approx(0.0, abs=1e-9)
