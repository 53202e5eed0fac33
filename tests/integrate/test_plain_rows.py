"""Rows of `stepping` that are exchanged without an evaluation, and what is asked of jumps, alone: against numpy."""

from __future__ import annotations

import numpy as np
import pytest

from fairlead.integrate.codes import DONE
from fairlead.integrate.linear.condensing import columns_of
from fairlead.integrate.stepping.jump_at_end import JUMPS_SOMEWHERE, SMOOTH
from fairlead.integrate.stepping.jump_inside import NO_LIMIT, STAYED
from fairlead.integrate.stepping.row_cache import CONSTANT, ROW
from tests.integrate.plainly import plain_room
from tests.integrate.rooms import fields, memory
from tests.integrate.test_room_stepping import SCALE, Contacts, solvable

THETA = 0.5


class Linear(Contacts):
    """Contacts whose rows are J u + c while they slide, with a constant of the zone, and a slip while they hold."""

    def __init__(self, seed):
        super().__init__(seed)
        self.rng = np.random.default_rng(seed + 1000)
        n = len(self.problem.initial)
        self.n, self.constant = n, self.rng.normal(size=len(self.rows))
        self.slip = self.rng.normal(size=n)
        at = self.at
        at.number["theta_now"], at.number["linear"] = THETA, 1
        at.spread()
        at.array["y"][:], at.array["y_end"][:] = self.rng.normal(size=(2, n))
        at.array["kick"][:] = self.rng.normal(size=n)
        self.kept = fields(at, n, drift=(lambda _t, _y, out: np.copyto(out, self.slip), n))

    def go(self, *names):
        """The function of row_cache.py of this name, on the memory, with all that it is given."""
        name, *owners = names
        return plain_room(f"stepping.row_cache.{name}", *owners)

    def evaluate(self):
        """J and M of the zones in force, and their factors, without machine code."""
        J, M = self.matrices()
        self.at.array["jacobian"][:] = J[self.problem.pattern.rows, columns_of(self.problem.pattern)]
        self.at.array["mass"][:] = M[self.problem.mass_pattern.rows, columns_of(self.problem.mass_pattern)]
        self.go("learn_rows", "problem", "linear.matrices", "stepping")(self.at)
        assert plain_room("linear.systems.factorise_step", "linear")(self.at, SCALE) == DONE

    def at_theta(self):
        y, end = self.at.array["y"], self.at.array["y_end"]
        return np.where(self.problem.differential, y + THETA * (end - y), end)

    def residual(self, z, h):
        """What is left of row z: of one that holds the slip that is to go in h."""
        row, (J, _) = self.rows[z], self.matrices()
        if self.zones[z] == 0:
            return self.slip[row] / h + J[row] @ self.at_theta()
        return self.constant[z] - self.at.array["kick"][row] + J[row] @ self.at_theta()

    def learn(self):
        """All rows that slide, with their constants, and all that hold; every contact slides then."""
        exchange = self.go("exchange_rows", "problem", "linear", "stepping")
        for zone in (1, 0, 1):
            self.zones[:] = zone
            self.evaluate()
            assert self.go("find_exchanged", "problem", "stepping")(self.at)
            exchange(self.at, False)
        self.at.number["n_exchanged"] = len(self.rows)
        self.at.array["exchanged_machines"][:] = np.arange(len(self.rows))
        self.at.array["b"][self.rows] = [self.residual(z, 1.0) for z in range(len(self.rows))]
        self.go("learn_constants", "point", "linear.matrices", "stepping")(self.at)
        assert plain_room("linear.systems.factorise_step", "linear")(self.at, SCALE) == DONE


def test_the_constant_of_a_row_that_slides_is_what_its_residual_has_beside_j_u():
    net = Linear(0)
    net.learn()
    contacts = len(net.rows)
    assert net.at.array["known_constants"][contacts : 2 * contacts] == pytest.approx(net.constant)
    assert set(net.at.array["known"][contacts : 2 * contacts].tolist()) == {CONSTANT}
    assert set(net.at.array["known"][:contacts].tolist()) == {ROW}  # one that holds has none


@pytest.mark.parametrize("seed", range(6))
def test_an_end_moves_by_the_solution_for_the_rows_that_were_exchanged(seed):
    """W dx = what is left of these rows, zero in all others; of what has a rate the end moves by dx/theta."""
    net = Linear(seed)
    net.learn()
    h = 1.0 / (THETA * SCALE)
    exchange = net.go("exchange_rows", "problem", "linear", "stepping")
    net.zones[:3] = 0  # three hold to begin with
    assert solvable(net)
    assert exchange(net.at, True)
    before = net.zones.copy()
    for _ in range(20):
        net.zones[:] = before
        net.zones[net.rng.integers(3)] = 1  # one of them lets go, and others change
        net.zones[net.rng.choice([3, 4, 5], int(net.rng.integers(1, 3)), replace=False)] ^= 1
        if solvable(net):
            break
    changed = np.flatnonzero(net.zones != before)
    assert exchange(net.at, True)
    assert net.go("rows_are_known", "problem", "stepping.exchange")(net.at)
    left = np.zeros(net.n)
    left[net.rows[changed]] = [net.residual(z, h) for z in changed]
    J, M = net.matrices()
    move = np.linalg.solve(SCALE * M - J, left)
    end = net.at.array["y_end"].copy()
    net.go("solve_exchanged", "problem", "point", "linear", "stepping")(net.at, h)
    wanted = end + np.where(net.problem.differential, move / THETA, move)
    mine = ~net.problem.quadrature  # quadratures are added up once the step is done
    scale = np.abs(wanted - end).max()
    assert net.at.array["y_end"][mine] == pytest.approx(wanted[mine], rel=1e-7, abs=1e-7 * scale)
    assert net.at.number["solves"] >= 1
    assert net.at.number["assumed"] & CONSTANT


WHY = ("linear", "invalidated", "support_accelerates", "algebraic_speeds", "known", "captured")


@pytest.mark.parametrize("why", WHY)
def test_a_residual_is_not_known_where_anything_of_it_may_be_otherwise(why):
    net = Linear(1)
    net.learn()
    known = net.go("rows_are_known", "problem", "stepping.exchange")
    at, contacts = net.at, len(net.rows)
    at.number["n_exchanged"] = 2
    at.array["exchanged_machines"][:2] = 0, 3
    net.zones[:], at.array["holds"][net.rows] = 1, 0
    net.zones[3], at.array["holds"][net.rows[3]], at.array["captured"][net.rows[3]] = 0, 1, 1
    assert known(at)
    if why == "known":
        at.array["known"][contacts] = ROW
    elif why == "captured":
        at.array["captured"][net.rows[3]] = 0
    else:
        at.number[why] = {"linear": 0, "invalidated": CONSTANT}.get(why, 1)
        at.spread()
    assert not known(at)


def test_what_was_relied_on_wrongly_is_relied_on_no_more():
    net = Linear(2)
    net.learn()
    net.at.number["assumed"], net.at.number["linearised"] = CONSTANT, 1
    net.go("invalidate_assumed", "stepping")(net.at)
    assert net.at.number["invalidated"] == CONSTANT
    assert (net.at.number["assumed"], net.at.number["linearised"]) == (0, 0)
    assert not net.at.array["known"].any()


@pytest.mark.parametrize("speed", [0.0, 1e-3])
@pytest.mark.parametrize("of", ["holds", "captured"])
def test_a_contact_that_was_captured_by_its_row_tells_of_a_surface_that_varies_its_speed(speed, of):
    n = 3
    at = memory({"n": n, "n_hold_mass": 1, "n_mass": 2, "captured_by_row": 1, "t": 0.5}, hold_mass_row=[2],
                hold_mass_column=[0], hold_mass=[1], mass=[9.0, 2.0], y_end=[5.0, 0, 0], holds=[0, 0, 1],
                captured=[0, 0, 1], minus_slip=np.zeros(n))  # fmt: skip
    kept = fields(at, n, drift=(lambda t, _y, out: np.copyto(out, [9.0, 9.0, speed if t == 0.5 else 7.0]), n))
    watch = plain_room("stepping.row_cache.watch_surfaces", "problem", "point", "linear.matrices", "stepping.exchange")
    watch(at)
    assert at.number["support_accelerates"] == (speed > 0.0)
    assert at.number["captured_by_row"] == 0
    at.number["support_accelerates"], at.array[of][2] = 0, 0
    watch(at)
    assert at.number["support_accelerates"] == 0
    assert kept


def suspects(seed):
    """Guards that fired, some of limits whose laws may jump, and zones of before and after."""
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 7))
    at = memory(
        {"n": 2, "n_guards": 2 * count, "n_machines": count}, guard_machine=np.repeat(np.arange(count), 2),
        fired=np.zeros(2 * count), suspects=np.zeros(2 * count), zones=rng.integers(0, 2, count),
        zones_probed=np.zeros(count), zones_at_start=rng.integers(0, 2, count), may_jump=rng.integers(0, 2, 2 * count),
        jump_at=np.zeros(count), g=-rng.uniform(0.1, 1, 2 * count), g_end=rng.uniform(0.1, 1, 2 * count),
        guard_tolerance=np.zeros(2 * count), falls=rng.integers(0, 2, count), continuous=np.zeros(2 * count),
        jumped=rng.integers(0, 2, count), kind_is_smooth=np.zeros(count), own_kind=rng.integers(0, count, count),
        hold_row=rng.integers(-1, 1, count), limit_guard=rng.integers(0, 2, 2 * count),
    )  # fmt: skip
    fired = rng.permutation(2 * count)[: rng.integers(1, 2 * count)]
    at.array["fired"][: len(fired)], at.number["n_fired"] = fired, len(fired)
    return rng, count, at, fired.tolist()


@pytest.mark.parametrize("sure", [True, False])
@pytest.mark.parametrize("seed", range(20))
def test_what_switched_is_remembered_with_where_its_limit_was_and_whether_its_law_jumps(seed, sure):
    rng, count, at, fired = suspects(seed)
    array = at.array
    plain_room("stepping.jump_inside.remember_before_switch", "events.guards", "stepping.contacts")(at)
    before = array["zones"].copy()
    array["zones"][rng.random(count) < 0.5] ^= 1
    array["fired"][:] = 0  # used for others meanwhile
    plain_room("stepping.jump_inside.find_limits", "events.guards", "stepping.contacts")(at)
    share = array["g"] / (array["g"] - array["g_end"])
    wanted = np.where(array["zones"] == before, float(STAYED), NO_LIMIT)
    for i in fired:
        if wanted[i // 2] != STAYED and array["may_jump"][i] and before[i // 2] == array["zones_at_start"][i // 2]:
            wanted[i // 2] = share[i]
    assert array["jump_at"] == pytest.approx(wanted)
    falls = any(array["falls"][z] for z in range(count) if wanted[z] != STAYED)
    assert plain_room("stepping.jump_inside.any_falls", "problem", "stepping.contacts")(at) == falls
    jumped = array["jumped"].copy()
    plain_room("stepping.jump_inside.note_kinds", "events.guards", "stepping.contacts")(at, sure)
    told = [i for i in fired if wanted[i // 2] >= 0 and (sure or jumped[i // 2])]
    assert not array["jumped"].any()
    for i in range(2 * count):
        z = i // 2
        assert array["continuous"][i] == (before[z] + 1 if i in told and not jumped[z] else 0)
    for kind in range(count):
        seen = {int(jumped[i // 2]) for i in told if array["own_kind"][i // 2] == kind}
        assert array["kind_is_smooth"][kind] == (JUMPS_SOMEWHERE if 1 in seen else SMOOTH if seen else 0)


@pytest.mark.parametrize("seed", range(20))
def test_laws_are_continuous_where_that_was_seen_in_the_zone_in_force(seed):
    rng, count, at, fired = suspects(seed)
    at.array["continuous"][:] = np.where(rng.random(2 * count) < 0.8, np.repeat(at.array["zones"], 2) + 1, 3)
    may = at.array["may_jump"] == 1
    known = at.array["continuous"] == np.repeat(at.array["zones"], 2) + 1
    go = plain_room("stepping.jump_at_end.all_continuous", "events.guards", "stepping.contacts")
    assert go(at) == all(known[i] or not may[i] for i in fired)
    doubtful = plain_room("stepping.jump_inside.is_doubtful", "problem", "events.guards", "stepping")
    array, found = at.array, []
    for i in range(2 * count):
        z = i // 2
        found.append(bool(array["falls"][z] and array["hold_row"][z] >= 0 and not array["limit_guard"][i]))
        assert bool(doubtful(at, i)) == found[i]
    any_ = plain_room("stepping.jump_inside.any_doubtful", "problem", "events.guards", "stepping")
    assert bool(any_(at)) == any(found[i] for i in fired)
