"""The room `stepping`: rows that are known and exchanged, what a step may have missed, how long steps stay."""

from __future__ import annotations

import functools

import numpy as np
import pytest

from fairlead.integrate.codes import DONE, KNOWN_ZONES
from fairlead.integrate.linear.condensing import columns_of
from tests.integrate.rooms import entry, fields, memory
from tests.integrate.test_linear import mechanical_network, memory_for, planned

SCALE = 1e3


@functools.cache
def evaluated():
    """call(memory, s): J and M are new: factorise s M - J, and learn the rows of the zones in force."""
    from fairlead.integrate.linear.systems import factorise_step
    from fairlead.integrate.memory.foreign import compiled
    from fairlead.integrate.stepping.row_cache import learn_rows

    @compiled
    def evaluate(m, scale):
        learn_rows(m.problem, m.linear.matrices, m.stepping)
        return factorise_step(m.linear, scale)

    return entry(evaluate, ("",), "d", "i")


@functools.cache
def exchanged():
    """call(memory) -> 1 if the rows of the zones in force were known and are in the factors now."""
    from fairlead.integrate.memory.foreign import compiled
    from fairlead.integrate.stepping.row_cache import exchange_rows

    @compiled
    def exchange(m):
        return exchange_rows(m.problem, m.linear, m.stepping, True)

    return entry(exchange, ("",), "", "b")


@functools.cache
def solution():
    from fairlead.integrate.linear.systems import solve

    return entry(solve, ("linear",), "i")


@functools.cache
def forgotten():
    from fairlead.integrate.stepping.row_cache import forget_rows

    return entry(forget_rows, ("stepping.exchange",))


@functools.cache
def wrong_by(name):
    from fairlead.integrate.stepping import response

    kinds = "didd" if name == "error_of_speed" else "did"
    return entry(getattr(response, name), ("point", "linear.matrices", "stepping.contacts"), kinds, "d")


@functools.cache
def unseen():
    from fairlead.integrate.stepping.limit_violation import unseen_slip

    return entry(unseen_slip, ("point", "linear.matrices", "events.guards", "stepping"), "d", "d")


@functools.cache
def unseen_of_rope():
    from fairlead.integrate.stepping.limit_violation import unseen_force

    return entry(unseen_force, ("",), "d", "d")


@functools.cache
def error():
    from fairlead.integrate.stepping.step_error import find_error

    return entry(find_error, ("",), "d", "d")


@functools.cache
def turned():
    from fairlead.integrate.stepping.switch_inside import find_turn

    return entry(find_turn, ("point", "linear.matrices", "stepping.contacts"), "d", "d")


@functools.cache
def state_off():
    from fairlead.integrate.stepping import other_zones

    return entry(other_zones.state_off, ("",), "ddd", "i")


@functools.cache
def kept():
    from fairlead.integrate.stepping.history import choose_next_step

    return entry(choose_next_step, ("run", "stepping.rule"), "db", "d")


class Contacts:
    """A random network of which every contact holds (zone 0) or slides (zone 1), each with one J and M a zone."""

    def __init__(self, seed, bodies=20, contacts=6, kinds=None):
        rng = np.random.default_rng(seed)
        problem, matrices = mechanical_network(rng, bodies, contacts)
        self.problem, self.rows = problem, 2 * bodies + np.arange(contacts)
        self.by_zone = [matrices(np.full(contacts, float(zone)), 1e3) for zone in (0, 1)]
        self.zones = np.zeros(contacts, np.int64)
        at = self.at = memory_for(problem, planned(problem))
        number, n = at.number, len(problem.initial)
        starts, found = {}, {}
        for name, pattern in (("slope", problem.pattern), ("mass", problem.mass_pattern)):
            own = [np.flatnonzero(pattern.rows == row) for row in self.rows]
            starts[name] = np.concatenate([[0], np.cumsum([len(one) for one in own])])
            found[name] = np.concatenate(own)
            number[f"n_own_{name}s" if name == "slope" else "n_own_masses"] = len(found[name])
        number["n_machines"], number["n_known"] = contacts, KNOWN_ZONES * contacts
        given = {
            "own_row": self.rows, "own_slope_starts": starts["slope"], "own_slopes": found["slope"],
            "own_slope_columns": columns_of(problem.pattern)[found["slope"]], "own_mass_starts": starts["mass"],
            "own_masses": found["mass"], "own_mass_columns": columns_of(problem.mass_pattern)[found["mass"]],
            "zones": self.zones, "own_kind": np.arange(contacts) if kinds is None else kinds,
            **{name: np.zeros(KNOWN_ZONES * contacts) for name in ("known", "known_of_kind", "known_constants")},
            **{name: np.zeros(contacts) for name in ("zones_linearised", "exchanged_machines", "only_kinks")},
            "known_slopes": np.zeros(KNOWN_ZONES * len(found["slope"])), "holds": np.zeros(n), "captured": np.zeros(n),
            "known_masses": np.zeros(KNOWN_ZONES * len(found["mass"])), "of_algebraic_speed": np.zeros(n),
        }  # fmt: skip
        of_reals = ("known_slopes", "known_masses", "known_constants")
        for name, values in given.items():
            at.point(name, values, np.float64 if name in of_reals else np.int64)
        self.zones = at.array["zones"]
        at.spread()

    def matrices(self):
        """J and M of the zones in force."""
        J, M = (one.copy() for one in self.by_zone[0])
        for row, zone in zip(self.rows, self.zones, strict=True):
            J[row], M[row] = (one[row] for one in self.by_zone[zone])
        return J, M

    def evaluate(self):
        """Evaluate J and M, as is done where a row is not known."""
        J, M = self.matrices()
        self.at.array["jacobian"][:] = J[self.problem.pattern.rows, columns_of(self.problem.pattern)]
        self.at.array["mass"][:] = M[self.problem.mass_pattern.rows, columns_of(self.problem.mass_pattern)]
        assert evaluated()(self.at, SCALE) == DONE

    def check(self, rng):
        """The factors are those of the zones in force."""
        J, M = self.matrices()
        W, b = SCALE * M - J, rng.standard_normal(len(J))
        x = b.copy()
        solution()(self.at, x)
        np.testing.assert_allclose(x, np.linalg.solve(W, b), rtol=1e-7, atol=1e-10)
        np.testing.assert_array_equal(
            self.at.array["jacobian"], J[self.problem.pattern.rows, columns_of(self.problem.pattern)]
        )


def solvable(network):
    """False where contacts that hold close a loop."""
    J, M = network.matrices()
    W = SCALE * M - J
    return np.linalg.cond(W / np.abs(W).max(axis=1, keepdims=True)) < 1e9


@pytest.mark.parametrize("seed", range(6))
def test_rows_that_are_exchanged_give_the_factors_of_a_fresh_evaluation(seed):
    """Up to three contacts switch at once. J and M are evaluated where a row was never met, and only there."""
    rng, network, met, unknown = np.random.default_rng(seed), Contacts(seed), set(), 0
    network.zones[:] = 1
    network.evaluate()
    met.update(enumerate(network.zones.tolist()))
    for _ in range(30):
        before = network.zones.copy()
        network.zones[rng.choice(6, rng.integers(1, 4), replace=False)] ^= 1
        if not solvable(network):
            network.zones[:] = before
            continue
        known = met.issuperset(enumerate(network.zones.tolist()))
        assert exchanged()(network.at) == known
        if known:
            holds = network.at.array["holds"][network.rows]
            changed = network.zones != before
            np.testing.assert_array_equal(holds[changed], (network.zones == 0)[changed])
        else:
            network.evaluate()
            met.update(enumerate(network.zones.tolist()))
            unknown += 1
        network.check(rng)
    assert 0 < unknown <= 6  # each evaluation met at least one of the six other zones


def test_an_exchange_redoes_the_columns_that_use_the_row_and_no_others():
    """The last contact of the order of elimination is in few columns."""
    rng, network = np.random.default_rng(1), Contacts(1, bodies=60, contacts=2)
    for zones in ((1, 1), (0, 1)):
        network.zones[:] = zones
        network.evaluate()
    network.zones[:] = (1, 1)
    assert exchanged()(network.at)
    assert 0 < network.at.number["n_redone"] < 0.5 * network.at.number["n_reduced"]
    network.check(rng)


def test_what_is_forgotten_must_be_evaluated_again():
    network = Contacts(3)
    for zones in (1, 0, 1):
        network.zones[0] = zones
        network.zones[1:] = 1
        network.evaluate()
    network.zones[0] = 0
    assert exchanged()(network.at)
    forgotten()(network.at)
    network.zones[0] = 1
    assert not exchanged()(network.at)


@pytest.mark.parametrize("linear", [0, 1])
def test_a_row_of_another_contact_of_the_kind_is_taken_where_laws_are_linear_and_marked_as_a_guess(linear):
    """Two contacts of one kind, with the same entries in the same order."""
    network = Contacts(4, bodies=2, contacts=2, kinds=np.zeros(2))
    for of_matrices in network.by_zone:
        for matrix in of_matrices:
            a, b = network.rows
            matrix[b, :a] = matrix[a, :a]
            matrix[b, b] = matrix[a, a]
            matrix[a, b] = matrix[b, a] = 0.0
    network.at.number["linear"] = linear
    for zones in ((1, 1), (0, 1)):
        network.zones[:] = zones
        network.evaluate()
    network.zones[:] = (1, 0)
    assert exchanged()(network.at) == bool(linear)
    if linear:
        assert int(network.at.number["assumed"]) & 4
        of_second = network.problem.pattern.rows == network.rows[1]
        wanted = network.by_zone[0][0][network.rows[1], columns_of(network.problem.pattern)[of_second]]
        np.testing.assert_array_equal(network.at.array["jacobian"][of_second], wanted)


H, MASS, OF_PLACE, OF_SPEED, OF_FORCE = 0.02, 3.0, 1e-5, 1e-3, 1e-2


def one_body(stiffness=0.0, inertia=MASS, weights=(OF_PLACE, OF_SPEED, OF_FORCE), **given):
    """Place, speed and the force of a contact that holds the body; v' = -k x/m + ..."""
    numbers = {"n": 3, "n_machines": 1, "n_guards": 1, "n_body_speed": 1, "n_jacobian": 2, **given.pop("numbers", {})}
    arrays = {
        "weight": weights, "held_inertia": [inertia], "body_starts": [0, 1], "body_position": [0], "body_speed": [1],
        "hold_row": [2], "jacobian_starts": [0, 1, 2, 2], "jacobian_rows": [1, 0], "jacobian": [-stiffness, 1.0],
    }  # fmt: skip
    return memory(numbers, **arrays | given)


def test_a_peak_of_force_moves_the_body_for_the_step_or_until_a_spring_takes_it_up():
    """F h^2/m; F/k where the period is short against the step; without an inertia the force itself counts."""
    peak, force = wrong_by("error_of_peak"), 7.0
    assert peak(one_body(), H, 0, force) == pytest.approx(force * H**2 / MASS / OF_PLACE)
    assert peak(one_body(stiffness=1.0), H, 0, force) == pytest.approx(force * H**2 / MASS / OF_PLACE)
    assert peak(one_body(stiffness=1e7), H, 0, force) == pytest.approx(force / 1e7 / OF_PLACE)
    assert peak(one_body(inertia=0.0), H, 0, force) == pytest.approx(force / OF_FORCE)


@pytest.mark.parametrize("per_mean", [1.0, 1.5, 2.0])
@pytest.mark.parametrize("stiffness", [0.0, 1e6])
def test_forces_of_other_zones_count_where_the_speed_and_the_place_they_lead_to_are_off(stiffness, per_mean):
    """dv = F T/(p m) with the mean F/p; a spring turns that into a way of dv sqrt(m/k), and the lesser error counts."""
    lasting, of_speed = 0.3 * H, OF_PLACE / 1e-4
    weight = of_speed if stiffness == 0.0 else max(of_speed, OF_PLACE / (MASS / stiffness) ** 0.5)
    just = weight * per_mean * MASS / lasting  # the force that is off by one weight
    for force, counts in ((0.99 * just, False), (-0.99 * just, False), (1.01 * just, True), (-1.01 * just, True)):
        at = one_body(
            stiffness, weights=(OF_PLACE, of_speed, OF_FORCE), x=[0.0, 5.0, 1.0], f=[0.0, 5.0 + force, 2.0],
            position_of=[-1, 0, -1], mass=[1.0, MASS], mass_starts=[0, 1, 2, 2], mass_rows=[0, 1],
            numbers={"n_mass": 2, "theta_now": 0.5}, differential=[1, 1, 0], holder=[-1, -1, 0],
        )  # fmt: skip
        assert state_off()(at, H, lasting, per_mean) == (1 if counts else -1)


def test_a_force_that_is_missed_leaves_a_speed_or_the_way_a_spring_allows_it():
    """F d/2m; on a spring at most F/2k sqrt(k/m) d of places, or F/2k when it lasts longer than the response."""
    speed, force, lasting = wrong_by("error_of_speed"), 7.0, 0.3 * H
    assert speed(one_body(), H, 0, force, lasting) == pytest.approx(0.5 * force * lasting / MASS / OF_SPEED)
    stiffness = 1e3  # responds in 0.055 s: longer than the force lasts
    way = 0.5 * force * lasting / np.sqrt(stiffness * MASS)
    coarse = (1.0, OF_SPEED, OF_FORCE)  # by 1 m of place the way is the lesser error, and that counts
    assert speed(one_body(stiffness, weights=coarse), H, 0, force, lasting) == pytest.approx(way)
    assert speed(one_body(1e7, weights=coarse), H, 0, force, lasting) == pytest.approx(0.5 * force / 1e7)


@pytest.mark.parametrize("share", [0.1, 0.3, 0.45, 0.55, 0.7, 0.9])
@pytest.mark.parametrize("smooth", [False, True])
def test_a_contact_that_lets_go_inside_a_step_hides_the_speed_of_the_page_on_the_error_of_a_step(share, smooth):
    """Load less limit is r (t - s h). Below s = 1/2 it lets go: (r h^2/2m) s^2; else it holds: (r h^2/2m) (1 - s)^2."""
    rate = 40.0
    early, before, middle = (rate * (t - share * H) for t in (-1.5 * H, -0.5 * H, 0.5 * H))
    lets_go = share < 0.5
    at = one_body(
        numbers={"gap": 0.5 * H, "gap_before": H}, g=[before], g_end=[middle], g_before=[early], limit_guard=[1],
        guard_machine=[0], guard_tolerance=[1e-9], rested=[2, 2, 2], holds=[0, 0, int(not lets_go)],
        mean_slope=[0.0, 0.0, rate], slope_before=[0.0, 0.0, rate], own_kind=[0], kind_is_smooth=[int(smooth)],
    )  # fmt: skip
    missed = rate * H**2 / (2 * MASS) * (share**2 if lets_go else (1 - share) ** 2)
    assert unseen()(at, H) == pytest.approx(missed / OF_SPEED / (10.0 if smooth else 1.0), rel=1e-9)
    assert at.number["worst"] == 2


@pytest.mark.parametrize("share", [0.5, 0.6, 0.8, 0.95])
@pytest.mark.parametrize("over", [-3.0, -0.01, 0.01, 2.0])
def test_a_rope_that_comes_taut_beside_a_contact_counts_as_twice_the_way_it_moves_the_body_at_most(share, over):
    """It pulls from s h on with r (t - s h), at the end by F above the limit: F T^2/6m in the time T = F/r <= h/2."""
    limit = 5.0
    pull = limit + over  # at the end
    at = one_body(
        numbers={"n_machines": 2, "n_guards": 2}, zones=[0, 1], zones_at_start=[0, 0], holds=[0, 0, 1],
        g_end=[-limit, -limit], first_guard=[0, -1], guard_machine=[0, 0], limit_guard=[1, 1], x=np.zeros(3),
        y_end=np.zeros(3), hold_row=[2, -1], body_starts=[0, 1, 1], held_inertia=[MASS, 0.0],
    )  # fmt: skip

    def forces(t, y, f):
        f[:] = (0.0, pull, 0.0)

    kept = fields(at, 3, forces=(forces, 3))
    wrong = unseen_of_rope()(at, H) * OF_PLACE
    assert kept
    if over <= 0.0:
        assert wrong == 0.0
        return
    lasting = over / (pull / (1.0 - share) / H)
    assert wrong >= 2.0 * over * lasting**2 / (6.0 * MASS)
    assert wrong == pytest.approx(over * H**2 / 12.0 / MASS, rel=1e-9)


@pytest.mark.parametrize("speed", [0.0, 2.0])
@pytest.mark.parametrize(("bend", "worst"), [(1.0, 0), (1e-4, 2)])
def test_the_unknown_to_blame_is_the_one_with_the_largest_error(bend, worst, speed):
    """Two errors of a step: of a body whose slope bends, and the one hidden behind a limit, at s = 0.7 of the step."""
    rate, share = 40.0, 0.7
    early, before, middle = (rate * (t - share * H) for t in (-1.5 * H, -0.5 * H, 0.5 * H))
    hidden = rate * H**2 / (2 * MASS) * (1 - share) ** 2 / OF_SPEED
    at = one_body(
        numbers={"gap": 0.5 * H, "gap_before": H}, g=[before], g_end=[middle], g_before=[early], limit_guard=[1],
        guard_machine=[0], guard_tolerance=[1e-9], rested=[2, 2, 2], holds=[0, 0, 1], own_kind=[0], kind_is_smooth=[0],
        slope_before=[speed, 0.0, rate], slope_earlier=[speed + bend, 0.0, 0.0], mean_slope=np.zeros(3),
        y=np.zeros(3), y_end=[speed * H, 0.0, rate * H], D=np.zeros(3), mean_before=np.zeros(3), differential=[1, 1, 0],
        controlled=[1, 0, 0], error_vector=np.zeros(3), quadrature=np.zeros(3), unweighed=np.zeros(3),
        absolute=[OF_PLACE, OF_SPEED, OF_FORCE], relative=np.zeros(3), cap=np.full(3, np.inf),
    )  # fmt: skip
    at.number["theta_now"] = 0.5
    shown = H * bend / 12 / OF_PLACE
    assert (shown > hidden) == (worst == 0)
    assert error()(at, H) == pytest.approx(max(shown, hidden), rel=1e-9)
    assert at.number["worst"] == worst


def test_a_contact_whose_load_falls_or_that_has_just_been_caught_hides_nothing():
    for rate, rested in ((-40.0, 2), (40.0, 1)):
        early, before, middle = (rate * t - 0.7 * H * abs(rate) for t in (-1.5 * H, -0.5 * H, 0.5 * H))
        at = one_body(
            numbers={"gap": 0.5 * H, "gap_before": H}, g=[before], g_end=[middle], g_before=[early],
            limit_guard=[1], guard_machine=[0], guard_tolerance=[1e-9], rested=[2, 2, rested], holds=[0, 0, 1],
            mean_slope=[0.0, 0.0, rate], slope_before=[0.0, 0.0, rate], own_kind=[0], kind_is_smooth=[0],
        )  # fmt: skip
        assert unseen()(at, H) == 0.0


@pytest.mark.parametrize("counts", [False, True])
@pytest.mark.parametrize("share", [0.2, 0.5, 0.8])
@pytest.mark.parametrize("held", [False, True])
def test_a_slip_that_turns_round_is_noticed_from_the_speed_of_the_page_on_that_is_missed(share, held, counts):
    """Friction L, load P, a = (P + L)/m before and b = (P - L)/m after it: (a - b) s h, or ends held b (1 - s) h."""
    friction, load = 5.0, 12.0
    a, b = (load + friction) / MASS, (load - friction) / MASS
    if held:
        missed, mean = b * (1 - share) * H, load - MASS * a * share  # what stops a s h by the end of the step
    else:
        missed, mean = (a - b) * share * H, friction
    weight = missed * (0.99 if counts else 1.01)
    at = one_body(
        weights=(1.0, weight, 1.0), numbers={"n_switched": 1}, switched=[0], switched_after=[share],
        y=[0.0, a * share * H, -friction], y_end=[0.0, 0.0, mean],
    )  # fmt: skip
    assert turned()(at, H) == (share if counts else 1.0)


def test_a_slip_that_its_friction_stops_has_not_turned_round():
    """At rest the load is less than the friction: the mean force is what stops it, and less than that for the rest."""
    friction, load, share = 5.0, 3.0, 0.6
    mean = -friction * share + load * (1 - share)
    at = one_body(
        weights=(1.0, 1e-9, 1.0), numbers={"n_switched": 1}, switched=[0], switched_after=[share],
        y=[0.0, 1.0, -friction], y_end=[0.0, 0.0, mean],
    )  # fmt: skip
    assert turned()(at, H) == 1.0


@functools.cache
def halved():
    from fairlead.integrate.stepping.repeated import halve_unsolved

    return entry(halve_unsolved, ("",), "di", "i")


@pytest.mark.parametrize("seed", range(5))
def test_a_fixed_step_that_was_halved_is_made_up_before_the_next_of_full_length(seed):
    """Halves of halves at random: the count is zero when the steps taken since add up to a full one."""
    from fairlead.integrate.codes import DIVERGES

    rng, at, h, done = np.random.default_rng(seed), memory({"n": 1, "adaptive": 0}), 1.0, 0.0
    for _ in range(3):
        halved()(at, h, DIVERGES)
        h = float(at.number["h_next"])
    assert h == 0.125
    while at.number["failed"] > 0:
        if h > 1e-3 and rng.random() < 0.5:
            halved()(at, h, DIVERGES)
            h = float(at.number["h_next"])
        else:
            done += h
            at.number["failed"] -= 1
    assert done == 1.0


@functools.cache
def searched():
    from fairlead.integrate.stepping.residual import search_line

    return entry(search_line, ("problem", "point", "linear", "stepping"), "dd")


def test_slip_that_a_search_leaves_in_a_row_that_was_caught_is_in_its_residual():
    """A full move stops a slip of 1 m/s, and takes another unknown, with a cubic law, far beyond where it is zero."""
    h = 0.1
    at = memory(
        {"n": 3, "n_hold_mass": 1, "n_jacobian": 3, "n_mass": 3, "theta_now": 0.5, "dense": 1},
        y=[1.0, 0.0, 0.0], y_end=[0.0, 0.0, 10.0], move=[-0.5, 0.0, 5.0], holds=[0, 1, 0], captured=[0, 1, 0],
        hold_mass_row=[1], of_algebraic_speed=np.zeros(3), differential=[1, 0, 1], controlled=np.zeros(3),
        quadrature=np.zeros(3), row_scale=[0.0, 1.0, 1.0], mass_starts=[0, 2, 2, 3], mass_rows=[0, 1, 2],
        mass_columns=[0, 0, 2], mass=np.ones(3), jacobian_starts=np.zeros(4), jacobian_rows=np.zeros(3),
        jacobian=np.zeros(3), **{name: np.zeros(3) for name in ("kick", "b", "v", "f", "u", "minus_slip")},
    )  # fmt: skip

    def forces(_t, u, f):
        f[:] = 0.0, 0.0, -100.0 * u[2] ** 3

    def drift(_t, y, r):
        r[:] = 0.0, -y[0], 0.0

    kept = fields(at, 3, forces=(forces, 3), drift=(drift, 3))
    searched()(at, h, 50.0)
    left = at.array["y_end"][0]
    assert 0.0 < left < 1.0
    assert at.array["b"][1] == pytest.approx(-left / h)
    assert kept


def taken(errors, h=0.01):
    """Lengths of the steps that follow ones with these errors, of a method of order two (error of order three)."""
    numbers = {"error_exponent": 1 / 3, "allowed": np.inf, "allowed_before": np.inf, "h_wanted": h}
    at, lengths = memory(numbers), []
    for error in errors:
        at.number["error"], at.number["h_wanted"] = error, h
        h = kept()(at, h, False)
        lengths.append(h)
    return lengths


def test_a_step_whose_error_is_too_near_what_is_allowed_is_followed_by_a_shorter_one():
    """0.9 h e^(-1/3), at least a fifth."""
    assert taken([2.0])[0] == pytest.approx(0.01 * 0.9 * 2.0 ** (-1 / 3), rel=1e-3)
    assert taken([1e6])[0] == pytest.approx(0.01 * 0.2)


def test_a_step_that_may_be_a_little_longer_is_kept_and_one_that_may_be_much_longer_is_doubled_at_most():
    allowed_a_quarter_more, a_third_more = ((0.9 / ratio) ** 3 for ratio in (1.25, 1.35))
    assert taken([allowed_a_quarter_more])[0] == 0.01
    assert taken([a_third_more])[0] == pytest.approx(0.0135, rel=1e-3)
    assert taken([1e-9])[0] == 0.02


@pytest.mark.parametrize("at_step", range(5))
def test_after_one_step_with_a_large_error_the_next_five_to_ten_are_no_longer(at_step):
    """The others would allow 1.8 times as much."""
    errors = [(0.9 / 1.2) ** 3] * at_step + [0.9**3] + [0.125] * 12
    lengths = taken(errors)
    longer = np.flatnonzero(np.array(lengths[at_step + 1 :]) > 0.0101)
    assert 5 <= longer[0] + 1 <= 10
    assert max(lengths[: at_step + 1]) <= 0.01
