"""What the rules of the rooms `stepping` and `point` get exactly: by the function they say they multiply a step with,
and by the polynomials they are exact for."""

from __future__ import annotations

import functools
from types import SimpleNamespace

import numpy as np
import pytest

from fairlead.integrate.codes import DONE
from fairlead.integrate.linear import ordering
from tests.integrate.rooms import entry, fields
from tests.integrate.test_linear import NOTHING_KEPT, memory_for, pattern_of

H = 0.25


@functools.cache
def refined():
    """call(memory, h): `refine_end` with the factors of 2M/h - J."""
    from fairlead.integrate.linear.systems import assemble_step, factorise_dense
    from fairlead.integrate.memory.foreign import compiled
    from fairlead.integrate.stepping.third_order import refine_end

    @compiled
    def refine(m, h):
        assemble_step(m.linear, 2.0 / h)
        if factorise_dense(m.linear.factors) == DONE:
            refine_end(m.problem, m.point, m.linear, m.stepping, h)

    return entry(refine, ("",), "d")


@functools.cache
def metered():
    """call(memory, h): `integrate_quadratures` with the factors of 2M/h - J."""
    from fairlead.integrate.linear.systems import factorise_step
    from fairlead.integrate.memory.foreign import compiled
    from fairlead.integrate.point.quadratures import integrate_quadratures

    @compiled
    def meter(m, h):
        if factorise_step(m.linear, 2.0 / h) == DONE:
            integrate_quadratures(m, h)

    return entry(meter, ("",), "d")


def equations(J, field, quadratures=()):
    """A memory with y' = f(t, y), J, and which unknowns are quadratures; and what must be kept."""
    n = len(J)
    every = pattern_of(np.ones((n, n), bool))
    problem = SimpleNamespace(
        initial=np.zeros(n), pattern=every, mass_pattern=pattern_of(np.eye(n, dtype=bool)),
        differential=np.ones(n, bool), quadrature=np.isin(np.arange(n), quadratures), moves=NOTHING_KEPT,
    )  # fmt: skip
    at = memory_for(problem, ordering.dense_plan(problem))
    at.array["jacobian"][:], at.array["mass"][:] = J.T.ravel(), 1.0
    at.array["mass_columns"][:] = np.arange(n)

    def called(t, y, out):
        out[:] = field(t, y)

    return at, fields(at, n, rhs=(called, n), forces=(called, n))


def factor(z, locates):
    """What a step multiplies by: right to order three, with half the error where steps end at every switch."""
    w = z / (1 - z / 2)
    return (1 + z / 2) / (1 - z / 2) - w**3 / 12 + locates * w**4 / 48


@pytest.mark.parametrize("locates", [0, 1])
@pytest.mark.parametrize("z", [-1e6, -10.0, -2.0, -0.3, 0.3, 0.9])
def test_a_step_multiplies_by_what_the_page_says_and_what_is_stiff_by_a_third_or_nothing(z, locates):
    rate = z / H
    at, _kept = equations(np.array([[rate]]), lambda _t, y: rate * y)
    at.number["locates"] = locates
    at.array["y"][:] = 3.0
    at.array["y_end"][:] = 3.0 * (1 + z / 2) / (1 - z / 2)  # the midpoint rule
    refined()(at, H)
    found = at.array["y_end"][0] / 3.0
    assert found == pytest.approx(factor(z, locates), rel=1e-9, abs=1e-12)
    if z < -1e5:
        assert found == pytest.approx(0 if locates else -1 / 3, abs=1e-4)
    if abs(z) < 0.5:
        assert abs(found - np.exp(z)) < (0.05 if locates else 0.1) * abs(z) ** 4


@pytest.mark.parametrize("locates", [0, 1])
def test_a_wave_is_multiplied_by_the_same_function_of_its_frequency(locates):
    z = 0.3j
    omega = 0.3 / H
    J = np.array([[0.0, 1.0], [-(omega**2), 0.0]])
    at, _kept = equations(J, lambda _t, y: J @ y)
    at.number["locates"] = locates
    start = np.array([1.0, 0.4])
    middle = np.linalg.solve(np.eye(2) - H / 2 * J, np.eye(2))
    at.array["y"][:], at.array["y_end"][:] = start, middle @ (np.eye(2) + H / 2 * J) @ start
    refined()(at, H)
    by = factor(z, locates)
    amplitude = (start[0] - 1j * start[1] / omega) * by  # of x = Re(amplitude e^(i omega t))
    np.testing.assert_allclose(at.array["y_end"], [amplitude.real, -omega * amplitude.imag], rtol=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_a_force_given_as_a_cubic_of_time_is_integrated_exactly(seed):
    """The midpoint rule is of order two, the formula of Lobatto of order four."""
    force = np.polynomial.Polynomial(np.random.default_rng(seed).normal(size=4))
    at, _kept = equations(np.zeros((1, 1)), lambda t, _y: force(t))
    at.number["t"] = 0.7
    at.array["y_end"][:] = H * force(0.7 + H / 2)
    refined()(at, H)
    assert at.array["y_end"][0] == pytest.approx(force.integ()(0.7 + H) - force.integ()(0.7), rel=1e-12)


@pytest.mark.parametrize("locates", [0, 1])
def test_no_step_makes_anything_grow_that_does_not(locates):
    """|factor| <= 1 in the left half plane: on its boundary, and so inside (the maximum principle)."""
    z = 1j * np.tan(np.linspace(-np.pi / 2, np.pi / 2, 2001)[1:-1]) * 2
    assert abs(factor(z, locates)).max() <= 1 + 1e-12


def test_a_load_that_changes_slowly_and_acts_through_something_stiff():
    """y' = a (y - sin t), without what decays: of order four, and half of it where steps end at switches."""
    rate = -8.0

    def exact(t):
        return (rate * rate * np.sin(t) + rate * np.cos(t)) / (1 + rate * rate)

    def missed(h, locates):
        at, _kept = equations(np.array([[rate]]), lambda t, y: rate * (y - np.sin(t)))
        at.number["locates"] = locates
        at.array["y"][:], z = exact(0.0), rate * h
        at.array["y_end"][:] = ((1 + z / 2) * exact(0.0) - z * np.sin(h / 2)) / (1 - z / 2)  # the midpoint rule
        refined()(at, h)
        return abs(at.array["y_end"][0] - exact(h))

    for locates in (0, 1):
        assert np.log2(missed(0.02, locates) / missed(0.01, locates)) == pytest.approx(4, abs=0.3)
    assert missed(0.005, 1) == pytest.approx(missed(0.005, 0) / 2, rel=0.1)


@pytest.mark.parametrize("seed", range(4))
def test_a_motion_given_as_a_cubic_of_time_is_integrated_exactly_without_more_of_f(seed):
    """The step reads it on its chord. What follows it tells what that makes of f; besides, f at the ends will do."""
    given = np.polynomial.Polynomial(np.random.default_rng(seed).normal(size=4))
    start, asked = 0.7, []
    chord = (given(start) + given(start + H)) / 2

    def field(t, _y):
        asked.append(t)
        return given(t)

    def ahead(t, _y, out):
        assert list(mean[:4]) == [start, start + H, 0.5, 0.5]
        out[:] = chord - given(t)

    at, _kept = equations(np.zeros((1, 1)), field)
    _more = fields(at, 1, ahead=(ahead, 1))
    mean = np.array([0.0, 0.0, 0.0, 0.0, 1.0])
    at.number["t"], at.number["mean_at"] = start, mean.ctypes.data
    at.array["y_end"][:] = H * chord
    refined()(at, H)
    assert at.array["y_end"][0] == pytest.approx(given.integ()(start + H) - given.integ()(start), rel=1e-12)
    assert asked == [start, start + H]
    assert not mean[2:4].any()


@pytest.mark.parametrize("theta", [0.4, 1.0])
@pytest.mark.parametrize("seed", range(4))
def test_a_rate_of_degree_five_is_metered_exactly_to_the_end_of_the_piece(seed, theta):
    """Three nodes of Gauss. The rate follows a place that moves steadily."""
    rate = np.polynomial.Polynomial(np.random.default_rng(seed).normal(size=6))
    at, _kept = equations(np.zeros((2, 2)), lambda _t, y: [1.0, rate(y[0])], quadratures=[1])
    at.array["y"][:], at.array["y_end"][:] = [0.0, 5.0], [H, 77.0]
    at.number["cut_at"] = theta
    metered()(at, H)
    assert at.array["y_piece"][1] == pytest.approx(5.0 + rate.integ()(theta * H), rel=1e-12)


@pytest.mark.parametrize("grows", [-2.0, 0.5, 1.5, 2.5])
@pytest.mark.parametrize("theta", [0.4, 1.0])
def test_the_work_of_a_bond_that_grows_within_a_step_is_metered(theta, grows):
    """A node of 2 kg on a carrier that speeds up by `a`; the bond is 1e9 exp(grows t/H) N s/m, W knows 1e9.

    The carrier pays m a, so in a piece from rest its drive gives m a^2 t^2/2, whatever the bond has become. The dense
    output shows a speed that is off by 1e-6 m/s inside the step, which is a kilonewton.
    """
    a, m = 3.0, 2.0

    def field(t, y):
        force = 1e9 * np.exp(grows * t / H) * (a * t - y[0])
        return [force / m, force * a * t]

    at, _kept = equations(np.array([[-1e9 / m, 0.0], [0.0, 0.0]]), field, quadratures=[1])
    at.array["y_end"][:], at.array["D"][:2] = [a * H, 77.0], [1e-6, 0.0]
    at.array["weight"][:] = 1e-6
    at.number["cut_at"] = theta
    metered()(at, H)
    # The rate is a square of time, which the rule gets exactly; the slope that D shows is off by 4e-6 of its size.
    assert at.array["y_piece"][1] == pytest.approx(m * a**2 * (theta * H) ** 2 / 2, rel=1e-4)


@pytest.mark.parametrize("way", [0.3, -2.0])
def test_what_follows_nothing_is_moved_once_for_its_residual(way):
    """The dense output goes `way` in a step at rest, so its residual is -way/H, and W = 2/H moves it by -way/2.

    A meter of the place shows where it was moved to: to rest, at its mean.
    """
    at, _kept = equations(np.zeros((2, 2)), lambda _t, y: [0.0, y[0]], quadratures=[1])
    at.array["y_end"][:], at.array["weight"][:], at.number["cut_at"] = [way, 77.0], 1e-9, 1.0
    metered()(at, H)
    assert at.array["y_piece"][1] == pytest.approx(H * (way / 2 - way / 2), abs=1e-12)
