"""The length of the next step, rows inside a step, and corners of guards in it, alone: against closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from fairlead.integrate.point.controller import GROW_LIMIT, RESTART_ERROR, SAFETY, SHRINK_LIMIT
from tests.integrate.plainly import plain_room
from tests.integrate.rooms import fields, memory

ORDER = 5


def control(**numbers):
    return memory({"error_exponent": 1 / ORDER, "start": 0.0, "stop": 1e9, "cut_at": 1.0, **numbers})


@pytest.mark.parametrize("amplitude", [1e2, 1e4, 1e6])
@pytest.mark.parametrize("pace", [0.1, 10.0, 1e4])
def test_the_first_step_of_a_sine_has_the_error_constant_that_is_assumed(pace, amplitude):
    """y = A sin(w t + 0.6) in weights: with T = y'/y'' the step h has RESTART_ERROR A' (h/T)^5 = 1."""
    slope, curvature = amplitude * pace * math.cos(0.6), amplitude * pace**2 * math.sin(0.6)
    h = plain_room("point.controller.restart", "run")(control(), slope, curvature, 0.0)
    scale = slope / curvature
    error = RESTART_ERROR * slope * scale * (h / scale) ** ORDER
    assert (2 / 3) ** (ORDER / 2) * 0.99 <= error <= (4 / 3) ** (ORDER / 2) * 1.01  # h^2 is a power of two, next to it
    longest = plain_room("point.controller.longest_first_step", "run")
    h = longest(control(), slope, curvature, 0.01, 2)
    assert 0.66 <= slope * scale * (h / scale) ** 2 / 0.01 <= 1.34


@pytest.mark.parametrize("seed", range(20))
def test_the_first_step_is_the_same_in_another_unit_of_time(seed):
    """All of it times 2^k: y' by 2^-k, y'' by 4^-k, steps by 2^k; powers of two leave no rounding."""
    rng = np.random.default_rng(seed)
    restart = plain_room("point.controller.restart", "run")
    slope, curvature, force = 10.0 ** rng.uniform(-4, 4, 3)
    said = {"h_next": 10.0 ** rng.uniform(-3, 1), "error": rng.choice([1e-5, 0.5]), "crossed": int(rng.integers(2)),
            "cut_at": rng.choice([1e-4, 0.5])}  # fmt: skip
    k = int(rng.integers(1, 8))
    plain = restart(control(**said), slope, curvature, force)
    said["h_next"] *= 2.0**k
    other = restart(control(**said), slope / 2.0**k, curvature / 4.0**k, force / 2.0**k)
    assert other == pytest.approx(2.0**k * plain, rel=1e-12)


def test_what_does_not_bend_takes_any_step_and_what_begins_at_rest_its_own_time():
    restart = plain_room("point.controller.restart", "run")
    assert restart(control(stop=10.0), 5.0, 0.99e-5, 0.0) == math.inf  # less than 1e-3 weights in the whole run
    assert restart(control(stop=10.0), 5.0, 1.01e-5, 0.0) < 1e9
    assert restart(control(), 0.0, 4.0, 0.0) == pytest.approx(0.5)  # c h^2 is one weight
    assert restart(control(), 0.0, 4.0, 100.0) == pytest.approx(0.5)  # forces: 0.03 a h is half a weight, earlier


@pytest.mark.parametrize(("cut", "crossed", "least"), [(0.5, 1, 1 / 3), (1e-4, 1, 0.0), (1e-4, 0, 1 / 3)])
def test_a_step_that_its_error_had_set_bounds_the_first_one_after_a_switch(cut, crossed, least):
    """At most what it would have been, and a third of that at least, unless it was cut at its very start."""
    restart = plain_room("point.controller.restart", "run")
    grid = 1.5**0.5 * 1.01  # its square is a power of two, next to it
    long = restart(control(error=0.5, h_next=1.0, cut_at=cut, crossed=crossed), 1.0, 0.1, 0.0)
    assert 1.0 / grid <= long <= 1.0 * grid
    slope, curvature = 1e3, 1e5
    free = restart(control(), slope, curvature, 0.0)
    short = restart(control(error=0.5, h_next=30 * free, cut_at=cut, crossed=crossed), slope, curvature, 0.0)
    assert max(10 * free * 3 * least, free) / grid <= short <= max(10 * free * 3 * least, free) * grid
    idle = restart(control(error=1e-4, h_next=30 * free, cut_at=cut, crossed=crossed), slope, curvature, 0.0)
    assert idle == free


@pytest.mark.parametrize("error", [0.02, 0.3, 0.9])
@pytest.mark.parametrize("last", [0.0, 0.05, 0.8])
def test_an_accepted_step_is_followed_by_one_of_pi_control(error, last):
    """Gustafsson 1991: h (0.9/e^0.7 e'^0.4)^(1/q), to five binary digits; pure I control after a rejection."""
    after = plain_room("point.controller.step_after_acceptance", "run")
    wanted = SAFETY * (error**-0.7 * last**0.4 if last else 1 / error) ** (1 / ORDER)
    assert after(control(error=error, last_error=last), 0.125) == pytest.approx(0.125 * wanted, rel=2.0**-5)
    again = after(control(error=error, last_error=last, retried=1), 0.125)
    assert again == pytest.approx(0.125 * min(SAFETY * error ** (-1 / ORDER), 1.0), rel=2.0**-5)


def test_a_step_grows_and_shrinks_within_limits():
    after = plain_room("point.controller.step_after_acceptance", "run")
    assert after(control(error=0.0), 1.0) == GROW_LIMIT
    assert after(control(error=1e-9, last_error=1.0), 1.0) == GROW_LIMIT
    assert after(control(error=1e-9, retried=2), 1.0) == 1.0
    assert after(control(error=1.0, last_error=1e-7), 1.0) == pytest.approx(SAFETY * 1e-7 ** (0.4 / ORDER), rel=2.0**-5)
    assert after(control(error=1.0, last_error=1e-12), 1.0) == pytest.approx(SHRINK_LIMIT, rel=2.0**-5)


@pytest.mark.parametrize("place", [0, 1, 2])
def test_an_error_is_that_of_the_end_in_weights_of_both_ends_and_none_where_that_is_no_number(place):
    rng = np.random.default_rng(place)
    y, end, error = rng.normal(size=(3, 3))
    at = memory({"n": 3}, y=y, y_end=end, error_vector=error, absolute=[0.1] * 3, relative=[0.3, 0.0, 2.0],
                cap=[1e9, 1e9, 0.2], weight=np.zeros(3), unweighed=np.zeros(3))  # fmt: skip
    sizes = np.abs(error) / np.minimum(0.1 + np.array([0.3, 0.0, 2.0]) * np.maximum(np.abs(y), np.abs(end)),
                                       [1e9, 1e9, 0.2])  # fmt: skip
    estimate = plain_room("point.controller.estimate_error", "point")
    assert estimate(at) == pytest.approx(sizes.max())
    assert at.number["worst"] == sizes.argmax()
    at.array["y_end"][place] = rng.choice([np.inf, np.nan])
    assert math.isnan(estimate(at))
    assert at.number["worst"] == place


@pytest.mark.parametrize("full", [9, 200])
@pytest.mark.parametrize("seed", range(8))
def test_every_point_of_a_grid_is_written_once_from_pieces_of_any_length(seed, full):
    """y is a quartic of t, which steps show exactly; pieces end anywhere in them. Buffers are emptied when full."""
    rng = np.random.default_rng(seed)
    every, start = 10.0 ** rng.uniform(-2, 2), rng.uniform(-5, 5)
    curve, ends = np.polynomial.Polynomial(rng.normal(size=5)), start + every * np.cumsum(rng.exponential(1.7, 12))
    ends[3] = start + every * round((ends[3] - start) / every)  # on a point of the grid, to rounding
    ends = np.sort(ends)
    at = memory(
        {"n": 1, "n_outputs": 1, "start": start, "on_grid": 1, "grid_next": 1, "every": every, "row_capacity": full,
         "t_row": start},
        y=[0.0], y_end=[0.0], y_piece=[0.0], y_probe=[0.0], D=np.zeros(3), row_t=np.zeros(full),
        row_values=np.zeros(full), row_side=np.zeros(full), weight=[1.0],
    )  # fmt: skip
    record, found = plain_room("record.rows.record_piece", ""), []

    def empty():
        count = int(at.number["rows"])
        found.extend(zip(at.array["row_t"][:count].tolist(), at.array["row_values"][:count].tolist(), strict=True))
        at.number["rows"] = 0

    t = start
    for end in ends:
        h = (end - t) * rng.uniform(1.0, 1.6)
        at.number["t"], at.number["h"], at.number["t_piece"] = t, h, end
        at.array["y"][0], at.array["y_end"][0], at.array["y_piece"][0] = curve(t), curve(t + h), curve(end)
        s = np.array([0.25, 0.5, 0.75])
        bend = (curve(t + s * h) - (1 - s) * curve(t) - s * curve(t + h)) / (s * (1 - s))
        at.array["D"][:] = np.linalg.solve(np.vander(s, 3, increasing=True), bend)
        while not record(at):
            empty()
        t = end
    empty()
    grid = start + every * np.arange(1, 1 + int((ends[-1] - start) / every * (1 + 1e-12)))
    assert [row[0] for row in found] == pytest.approx(grid, rel=1e-12, abs=1e-12 * every)
    assert [row[1] for row in found] == pytest.approx(curve(grid), rel=1e-9, abs=1e-9 * np.abs(curve(grid)).max())


@pytest.mark.parametrize("bent", [0.0, 2.0, -3.0])
@pytest.mark.parametrize("touches", [True, False])
def test_a_corner_is_where_a_force_that_presses_is_zero_if_a_guard_has_come_to_its_limit_there(touches, bent):
    """The guard is below zero by |N| at both ends; the second force is zero later, and the third nowhere."""
    y, end, D = np.array([3.0, 1.0, 2.0]), np.array([-1.0, -9.0, 1.0]), np.array([bent, 0, 0, 0, 0, 0, 0, 0, 0])
    place = brentq(lambda s: (1 - s) * 3.0 + s * (-1.0 + (1 - s) * bent), 0, 1, xtol=1e-15)

    def guards(_t, at, g):
        g[:] = (1e-9 if touches else -1e-3) - abs(at[0]), -1.0

    at = memory({"n": 3, "n_guards": 2, "n_machines": 2, "n_pressing": 3, "t_release": 1e308}, y=y, y_end=end,
                D=D, y_probe=np.zeros(3), pressing_row=[2, 1, 0], in_corner=[1, 1], g=[-3.0, -1.0],
                g_end=[-1.0, -1.0], g_probe=np.zeros(2), guard_tolerance=[1e-9] * 2, guard_machine=[-1, -1],
                limit_guard=[0, 0])  # fmt: skip
    kept = fields(at, 3, guards=(guards, 2))
    corner = plain_room("events.corners.find_corner", "")
    assert corner(at, 1.0, 1.0) == pytest.approx(place if touches else 1.0, abs=1e-14)
    assert at.array["in_corner"].tolist() == [int(touches), 0]
    assert corner(at, 1.0, 0.9 * place) == 0.9 * place  # something else comes before
    at.array["g_end"][0] = 1.0
    assert corner(at, 1.0, 1.0) == 1.0  # it is above zero at the end: a crossing, and no corner
    assert kept


@pytest.mark.parametrize("after", [0, 1, 3])
@pytest.mark.parametrize("seed", range(10))
def test_what_rounding_makes_of_a_third_difference_is_no_error(seed, after):
    """Values on a straight line, each rounded, in steps that at most double: nothing is left, and the bound is near.

    `after` steps since a settlement: before the first of them there are slopes at a point, which are exact.
    """
    rng = np.random.default_rng(seed)
    n, far = 400, 3e6
    h = np.cumprod(rng.uniform(0.5, 2.0, after + 1)) * 1e-6
    speed = rng.uniform(-1.0, 1.0, n)
    place = far * rng.uniform(0.5, 1.0, n)
    slopes, ends = [speed, speed], [place]
    for length in h:
        ends.append(ends[-1] + length * speed)
        slopes.append((ends[-1] - ends[-2]) / length)
    gaps = [0.0, 0.0, *(0.5 * h[:-1])]
    at = memory({"n": n, "theta_now": 0.5, "gap": gaps[-1], "gap_before": gaps[-1] + gaps[-2] or 1.0, "locates": 1})
    arrays = {"y_end": ends[-1], "mean_slope": slopes[-1], "slope_before": slopes[-2], "slope_earlier": slopes[-3],
              "error_vector": np.full(n, np.nan)}  # fmt: skip
    for name, values in arrays.items():
        at.point(name, np.array(values), np.float64)
    for name, value in {"differential": 1, "controlled": 1, "quadrature": 0}.items():
        at.point(name, np.full(n, value), np.int64)
    find = plain_room("stepping.step_error.find_differences", "point", "stepping.rule")
    find(at, h[-1])
    assert np.all(at.array["error_vector"] == 0.0)
    third = h[-1] ** 3 / 6 / (gaps[-1] + 0.5 * h[-1] + at.number["gap_before"])
    bound = plain_room("stepping.step_error.find_rounding", "stepping.rule")(at, third, 0.0, h[-1]) * far
    curve = (slopes[-1] - slopes[-2]) / (gaps[-1] + 0.5 * h[-1])
    before = (slopes[-2] - slopes[-3]) / at.number["gap_before"]
    assert bound / 40 < np.abs(third * (curve - before)).max() < bound


@pytest.mark.parametrize("short", [1e-3, 1e-7])
@pytest.mark.parametrize("which", [0, 1])
def test_a_step_before_that_was_far_shorter_hides_no_error(which, short):
    """Rounding of the slope of a short step is large; what is left out is that of steps a quarter as long as this."""
    h = [1.0, 1.0, 1.0]
    h[which] = short
    find = plain_room("stepping.step_error.find_rounding", "stepping.rule")
    asked = {"gap": 0.5 * h[1], "gap_before": 0.5 * (h[0] + h[1])}
    third = 1.0 / 6.0 / (asked["gap"] + 0.5 + asked["gap_before"])
    assert find(memory(asked), third, 0.0, 1.0) <= 40 * 2.0**-52
