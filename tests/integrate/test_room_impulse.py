"""Impacts in the room `events`, on a few masses and rows by hand: the least impulse, its limits, what is lost."""

from __future__ import annotations

import functools

import numpy as np
import pytest

from fairlead.integrate.codes import DONE, RELEASED, RUBBED
from fairlead.integrate.linear import ordering
from tests.integrate.rooms import entry, fields
from tests.integrate.test_linear import memory_for
from tests.integrate.test_room_linear import algebraic

LIMITED, UNLIMITED = 1, 2
TINY = 1e-9  # error weight of a speed [m/s]


@functools.cache
def struck():
    """call(memory) -> what `resolve_impact` says, with the factors of the consistent point."""
    from fairlead.integrate.events.impulse import resolve_impact
    from fairlead.integrate.linear.systems import assemble_consistent, factorise_dense
    from fairlead.integrate.memory.foreign import compiled

    @compiled
    def strike(m):
        assemble_consistent(m.linear)
        status = factorise_dense(m.linear.factors)
        return status if status != DONE else resolve_impact(m)

    return entry(strike, ("",), "", "i")


class Impact:
    """Speeds v with a mass matrix, and rows A v = c that are to hold from now on; two meters for the energies."""

    def __init__(self, masses, A, v, surface=0.0, takes=UNLIMITED, rebound=0.0, guards=None, may_hold=()):
        rows, self.bodies = A.shape
        n = self.n = rows + self.bodies + 2
        speeds, forces, ledger = self.places()
        M, J = np.zeros((n, n)), np.zeros((n, n))
        M[np.ix_(speeds, speeds)], J[np.ix_(speeds, forces)], M[np.ix_(forces, speeds)] = masses, A.T, A
        M[ledger, ledger] = 1.0
        # Each row is in the pattern of its own force, as those that may slide are.
        problem, _ = algebraic(n, (J != 0) | np.eye(n, dtype=bool), True)
        mass, _ = algebraic(n, (M != 0) | np.eye(n, dtype=bool), True)
        problem.mass_pattern, problem.differential = mass.pattern, ~np.isin(np.arange(n), forces)
        at = self.at = memory_for(problem, ordering.dense_plan(problem))
        y = at.array["y"]
        y[speeds] = v
        for name, matrix, pattern in (("jacobian", J, problem.pattern), ("mass", M, problem.mass_pattern)):
            columns = np.repeat(np.arange(n), np.diff(pattern.starts))
            at.array[name][:] = matrix[pattern.rows, columns]
        at.array["mass_columns"][:] = np.repeat(np.arange(n), np.diff(problem.mass_pattern.starts))
        number = at.number
        number["takes_impulses"], number["rebounds"], number["stop"] = 1, int(np.any(rebound)), 1.0
        number["dissipated_at"], number["supplied_at"], number["t_release"] = *ledger, np.inf
        number["n_guards"] = 0 if guards is None else len(may_hold)
        given = {
            "rebound": np.zeros(n), "cap": np.full(n, np.inf),
            "absolute": np.full(n, TINY), "relative": np.zeros(n), "guard_tolerance": np.full(n, 1e-9),
        }  # fmt: skip
        given["rebound"][forces] = rebound
        for name, values in given.items():
            at.point(name, values, np.float64)
        at.point("guard_machine", np.full(n, -1), np.int64)
        at.point("may_hold", np.array([*may_hold, 0]), np.int64)
        at.point("blow_guard", np.zeros(len(may_hold) + 1), np.int64)
        at.array["takes_impulse"][:] = 0
        at.array["takes_impulse"][forces] = takes
        at.array["struck"][speeds] = 1
        at.array["speed_of"][:] = np.arange(n)
        at.array["unweighed"][ledger] = 1
        rigid = np.broadcast_to(np.asarray(takes) == UNLIMITED, rows)

        def slip(_t, y, out, which=rigid):
            out[:] = 0.0
            out[forces] = np.where(which, surface - A @ y[speeds], 0.0)

        def drift(t, y, out):
            slip(t, y, out, np.ones(rows, bool))

        def rest(_t, _y, out):
            out[:] = 0.0

        asked = (rest, 1) if guards is None else (lambda _t, y, out: guards(y[speeds], y[forces], out), len(may_hold))
        slopes = (lambda _t, _y, _out: None, len(problem.pattern.rows))  # as they are
        self.kept = fields(at, n, slip=(slip, n), drift=(drift, n), rhs=(rest, n), guards=asked, jacobian=slopes)
        at.spread()

    def places(self):
        """Where speeds, forces and the two meters are."""
        rows = self.n - self.bodies - 2
        return np.arange(self.bodies), self.bodies + np.arange(rows), [self.n - 2, self.n - 1]

    def strike(self):
        """(what it says, speeds after it, what was dissipated, what was supplied)."""
        said = struck()(self.at)
        speeds, _, ledger = self.places()
        return said, self.at.array["y"][speeds].copy(), *self.at.array["y"][ledger]


def scene(rng, bodies=5, rows=3):
    """A mass matrix over some decades, and rows that are independent."""
    root = rng.normal(size=(bodies, bodies))
    scale = 10.0 ** rng.uniform(-1, 1, bodies)
    masses = (root @ root.T + np.eye(bodies)) * scale * scale[:, None]
    return masses, rng.normal(size=(rows, bodies)), rng.normal(size=bodies)


def least_change(masses, A, gap):
    """The change of speed least by dV M dV with A dV = gap (Gauss), by way of the impulses."""
    by_impulse = np.linalg.solve(masses, A.T)
    return by_impulse @ np.linalg.solve(A @ by_impulse, gap)


def energy(masses, v):
    return 0.5 * v @ masses @ v


@pytest.mark.parametrize("seed", range(8))
def test_what_is_to_hold_comes_to_rest_by_the_least_impulse_and_the_loss_is_booked(seed):
    masses, A, v = scene(np.random.default_rng(seed))
    said, after, lost, supplied = Impact(masses, A, v).strike()
    change = least_change(masses, A, -A @ v)
    assert said == DONE
    np.testing.assert_allclose(after, v + change, atol=1e-10)
    assert lost == pytest.approx(energy(masses, v) - energy(masses, after), rel=1e-9)
    assert lost == pytest.approx(energy(masses, change), rel=1e-9)
    assert supplied == pytest.approx(0.0, abs=1e-12 * lost)


@pytest.mark.parametrize("seed", range(4))
def test_a_surface_that_moves_supplies_what_the_masses_gain_and_lose(seed):
    """In the frame of the surface it is the same impact."""
    rng = np.random.default_rng(seed)
    masses, A, v = scene(rng, rows=1)
    surface = 2.0
    said, after, lost, supplied = Impact(masses, A, np.zeros_like(v), surface).strike()
    assert said == DONE
    np.testing.assert_allclose(after, least_change(masses, A, np.array([surface])), atol=1e-10)
    assert lost == pytest.approx(energy(masses, after), rel=1e-9)
    assert supplied == pytest.approx(2.0 * energy(masses, after), rel=1e-9)  # half of it is lost, half is motion


@pytest.mark.parametrize("seed", range(8))
def test_no_rebound_makes_energy_and_what_one_impact_joins_goes_by_the_least_coefficient(seed):
    rng = np.random.default_rng(seed)
    masses, A, v = scene(rng)
    coefficients = rng.uniform(0.05, 1.0, len(A))
    said, after, lost, _ = Impact(masses, A, v, rebound=coefficients).strike()
    e = coefficients.min()
    assert said == DONE
    np.testing.assert_allclose(A @ after, -e * (A @ v), atol=1e-9)  # Newton's law, in every row
    np.testing.assert_allclose(after, v + (1 + e) * least_change(masses, A, -A @ v), atol=1e-9)
    change = least_change(masses, A, -A @ v)
    assert lost == pytest.approx(energy(masses, v) - energy(masses, after), rel=1e-8, abs=1e-9)
    assert lost == pytest.approx((1 - e * e) * energy(masses, change), rel=1e-8, abs=1e-9)
    assert energy(masses, after) <= energy(masses, v) * (1 + 1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_impacts_that_nothing_joins_have_their_own_coefficients(seed):
    rng = np.random.default_rng(seed)
    masses, v = np.diag(rng.uniform(0.1, 10.0, 4)), rng.normal(size=4)
    coefficients = np.array([0.0, 0.3, 0.6, 1.0])
    said, after, lost, _ = Impact(masses, np.eye(4), v, rebound=coefficients).strike()
    assert said == DONE
    np.testing.assert_allclose(after, -coefficients * v, atol=1e-10)
    assert lost == pytest.approx(0.5 * np.diag(masses) @ ((1 - coefficients**2) * v**2), rel=1e-9)


@pytest.mark.parametrize("seed", range(10))
@pytest.mark.parametrize("share", [0.9, 1.1])
def test_friction_holds_in_an_impact_up_to_its_share_of_the_normal_impulse(seed, share):
    """One body, its inertias coupled: P = -M v. Friction may be mu P_n; mu here is 1/share of what it would take."""
    rng = np.random.default_rng(seed)
    masses, _, v = scene(rng, bodies=2)
    impulse = -masses @ v
    mu = abs(impulse[0] / impulse[1]) / share

    def guards(_v, forces, out):
        out[0] = abs(forces[0]) - mu * abs(forces[1])

    struck_body = Impact(masses, np.eye(2), v, takes=[LIMITED, UNLIMITED], guards=guards, may_hold=[LIMITED])
    said, after, lost, _ = struck_body.strike()
    if share < 1.0:
        assert said == DONE
        np.testing.assert_allclose(after, 0.0, atol=1e-10)
        assert lost == pytest.approx(energy(masses, v), rel=1e-9)
    else:
        assert said == RELEASED
        assert struck_body.at.number["n_fired"] == 1
        assert struck_body.at.array["fired"][0] == 0
        np.testing.assert_array_equal(after, v)  # who lets go changes the impulse: nothing has moved yet
        assert lost == 0.0


def test_a_stop_that_would_have_to_pull_lets_go():
    """Two bodies joined by a beam: stopping one of the ends throws the other on to or off its own stop."""
    masses = np.array([[2.0, 1.0], [1.0, 2.0]])

    def guards(_v, forces, out):
        out[:] = -forces  # a stop pushes: its force is positive

    for v, pulls in (([-1.0, -1.0], []), ([-1.0, 0.6], [1]), ([0.6, -1.0], [0]), ([-1.0, 0.4], [])):
        beam = Impact(masses, np.eye(2), v, guards=guards, may_hold=[UNLIMITED, UNLIMITED])
        said = beam.strike()[0]
        assert [k for k in range(2) if (-masses @ v)[k] < 0] == pulls
        assert said == (RELEASED if pulls else DONE)
        assert beam.at.array["fired"][: int(beam.at.number["n_fired"])].tolist() == pulls


@pytest.mark.parametrize("coupled", [0.0, 0.5])
def test_friction_that_an_impulse_would_throw_back_is_refused_and_friction_beside_it_is_not(coupled):
    """The law with one coefficient would throw a slip back along the surface."""
    masses, v = np.array([[1.0, coupled], [coupled, 1.0]]), [1.0, -1.0]
    body = Impact(masses, np.eye(2), v, takes=[LIMITED, UNLIMITED], rebound=[0.0, 0.5])
    said, after, _, _ = body.strike()
    if coupled:
        assert said == RUBBED
    else:
        assert said == DONE
        np.testing.assert_allclose(after, [0.0, 0.5], atol=1e-10)


def test_a_slip_of_rounding_is_no_impact():
    body = Impact(np.eye(2), np.eye(2), [0.5 * TINY, -0.5 * TINY])
    said, after, lost, _ = body.strike()
    assert said == DONE
    np.testing.assert_array_equal(after, [0.5 * TINY, -0.5 * TINY])
    assert lost == 0.0
