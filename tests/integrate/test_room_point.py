"""The room `point` alone: the error norm, the interpolant, the next step, y'' beyond its rounding."""

from __future__ import annotations

import functools
import math

import numpy as np
import pytest

from tests.integrate.rooms import entry, memory


@functools.cache
def norm():
    from fairlead.integrate.point.controller import weighted_norm

    return entry(weighted_norm, ("point",), "i", "d")


@functools.cache
def interpolated():
    from fairlead.integrate.point.interpolant import interpolate

    return entry(interpolate, ("point",), "di")


@functools.cache
def rejected():
    from fairlead.integrate.point.controller import step_after_rejection

    return entry(step_after_rejection, ("run",), "d", "d")


@functools.cache
def first():
    from fairlead.integrate.point.controller import longest_first_step

    return entry(longest_first_step, ("run",), "dddd", "d")


@functools.cache
def ended():
    from fairlead.integrate.events.pace import end_attempts

    return entry(end_attempts, ("run",), "d")


@functools.cache
def bend():
    from fairlead.integrate.point.curvature import curvature_beyond_rounding

    return entry(curvature_beyond_rounding, ("point", "linear.matrices"), "", "d")


@pytest.mark.parametrize("seed", range(5))
def test_the_norm_is_the_largest_weighted_error_of_what_counts_and_says_whose_it_is(seed):
    rng = np.random.default_rng(seed)
    n, v, weight = 7, rng.normal(size=7), rng.uniform(0.1, 2.0, 7)
    unweighed = rng.integers(0, 2, 7)
    unweighed[rng.integers(7)] = 0
    at = memory({"n": n}, weight=weight, unweighed=unweighed)
    sizes = np.where(unweighed == 0, np.abs(v) / weight, -1.0)
    assert norm()(at, v) == sizes.max()
    assert at.number["worst"] == sizes.argmax()


@pytest.mark.parametrize("seed", range(5))
def test_the_norm_is_the_largest_quotient_to_its_last_digit_and_of_equal_ones_the_first(seed):
    rng = np.random.default_rng(seed)
    n, weight = 400, rng.uniform(0.1, 2.0, 400)
    share = 0.7 * (1.0 + 2.0**-52 * rng.integers(-3, 4, n))  # apart by some units in the last place
    v = share * weight * rng.choice([-1.0, 1.0], n)
    at = memory({"n": n}, weight=weight, unweighed=np.zeros(n, dtype=np.int64))
    sizes = np.abs(v) / weight
    assert norm()(at, v) == sizes.max()
    assert at.number["worst"] == sizes.argmax()


def test_the_norm_of_what_is_no_number_is_none_even_where_it_does_not_count():
    at = memory({"n": 2}, weight=[1.0, 1.0], unweighed=[0, 1])
    assert math.isnan(norm()(at, np.array([1.0, np.inf])))
    assert at.number["worst"] == 1


def test_the_interpolant_meets_both_ends_and_a_polynomial_of_degree_four_in_between():
    rng = np.random.default_rng(3)
    polynomial = rng.normal(size=5)

    def at_theta(theta):
        return np.polyval(polynomial, theta)

    # y - chord = theta (1 - theta) (D0 + theta D1 + theta^2 D2), by polynomial division.
    chord = np.array([at_theta(1.0) - at_theta(0.0), at_theta(0.0)])
    rest, _ = np.polydiv(np.polysub(polynomial, chord), [-1.0, 1.0, 0.0])
    at = memory({"n": 1}, y=[at_theta(0.0)], y_end=[at_theta(1.0)], D=rest[::-1].copy())
    found = np.zeros(1)
    for theta in (0.0, 0.2, 0.7, 1.0):
        interpolated()(at, theta, found)
        assert found[0] == pytest.approx(at_theta(theta), abs=1e-13)


def test_a_step_that_is_rejected_gets_shorter_within_limits_and_by_a_quarter_when_nothing_is_known():
    def factor(error):
        at = memory({"error": error, "error_exponent": 0.2})
        return rejected()(at, 1.0)

    factors = [factor(error) for error in (1.01, 3.0, 30.0, 1e9)]
    assert factors == sorted(factors, reverse=True)
    assert 0.5 < factors[0] <= 0.81
    assert factors[2] == pytest.approx(0.9 * 30.0**-0.2, rel=0.1)  # rounded to even steps
    assert factors[-1] >= 0.19
    assert factor(math.nan) == 0.25


@pytest.mark.parametrize("order", [2.0, 3.0, 5.0])
@pytest.mark.parametrize("share", [0.2, 1.2, 12.0])
def test_the_leading_error_of_a_first_step_is_one_weight(share, order):
    """Of A sin(t/T), of the size A in weights: |y'| = A/T, |y''| = A/T^2. Its length is a power of the root of two."""
    amplitude, scale = 70.0, 0.03
    h = first()(memory({"stop": 1.0}), amplitude / scale, amplitude / scale**2, share, order)
    lengthened = (amplitude * (h / scale) ** order / share) ** (1.0 / order)  # by rounding h^2 to a power of two
    assert 0.999 / 1.5 <= lengthened**2 <= 1.001 * 4.0 / 3.0
    assert math.log2(h) * 2 == pytest.approx(round(math.log2(h) * 2), abs=1e-9)


def test_a_first_step_of_what_is_straight_or_begins_at_rest_has_no_leading_error():
    assert first()(memory({"stop": 1.0}), 5.0, 1e-9, 12.0, 3.0) == math.inf
    assert first()(memory({"stop": 1.0}), 0.0, 5.0, 12.0, 3.0) == math.inf


@pytest.mark.parametrize("adaptive", [0, 1])
def test_after_an_accepted_step_the_next_is_as_long_as_the_method_says_unless_steps_are_fixed(adaptive):
    at = memory({"adaptive": adaptive, "h_next": 0.5, "error": 0.25, "retried": 3, "reinitialised": 1})
    ended()(at, 0.125)
    assert at.number["h_next"] == (0.125 if adaptive else 0.5)
    assert (at.number["retried"], at.number["reinitialised"], at.number["last_error"]) == (0, 0, 0.25)


@pytest.mark.parametrize("real", [0.0, 5.0])
def test_of_a_second_derivative_counts_what_is_beyond_its_rounding(real):
    """Of y' = J y with J = -1e6 the second derivative is known to 1e12 eps |y|."""
    stiff = 1e6
    curvature = stiff * stiff * 1e-15 + real
    at = memory(
        {"n": 1, "n_jacobian": 1, "n_mass": 1}, y=[1.0], curvature=[curvature], differential=[1], weight=[1.0],
        unweighed=[0], jacobian=[-stiff], jacobian_starts=[0, 1], jacobian_rows=[0], mass=[1.0], mass_starts=[0, 1],
        mass_rows=[0], mass_columns=[0], quadrature=[0],
    )  # fmt: skip
    assert bend()(at) == pytest.approx(real, abs=1e-2)
