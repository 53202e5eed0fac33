"""The closed forms of the friction laws, creep and hump, against integration and numerical search."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

from tests.reference.creep import BoundContact
from tests.reference.hump import Hump


def test_the_default_prism_has_the_slope_of_its_published_ratio() -> None:
    contact = BoundContact(stiction=5.0, creep_speed=1e-4)
    assert contact.slope == pytest.approx(1.25 * 5.0 / 1e-4, rel=1e-14)  # physics 1.4, a = 2, b = 4


def test_a_heavy_block_under_steady_load_ends_at_the_creep_speed() -> None:
    contact, mass, load = BoundContact(stiction=5.0, creep_speed=1e-2), 1.0, 3.0
    run = solve_ivp(
        lambda _t, v: (load - contact.slope * v) / mass,
        (0.0, 0.1),
        [0.0],
        method="Radau",
        rtol=1e-10,
        atol=1e-14,
    )
    assert run.y[0, -1] == pytest.approx(float(contact.creep(load)), rel=1e-8)


def test_a_preloaded_spring_leaks_as_the_integrated_equation_does() -> None:
    contact, stiffness = BoundContact(stiction=50.0, creep_speed=1e-4), 1e4
    run = solve_ivp(
        lambda _t, f: -stiffness / contact.slope * f,
        (0.0, 10.0),
        [40.0],
        method="DOP853",
        rtol=1e-12,
        atol=1e-12,
    )
    assert float(contact.leaked_load(40.0, stiffness, 10.0)) == pytest.approx(run.y[0, -1], rel=1e-10)


def test_the_published_leak_of_fifteen_percent_in_ten_seconds_is_found() -> None:
    contact = BoundContact(stiction=50.0, creep_speed=1e-4)  # physics 1.9, hazard H5
    assert 1.0 - float(contact.leaked_load(1.0, 1e4, 10.0)) == pytest.approx(0.15, abs=0.005)


@pytest.mark.parametrize("creep_speed", [1e-3, 1e-4])
def test_breakaway_comes_when_the_integrated_load_reaches_stiction(creep_speed: float) -> None:
    contact, stiffness, speed = BoundContact(creep_speed=creep_speed), 100.0, 0.05

    def load_rate(_t: float, load: np.ndarray) -> np.ndarray:
        return stiffness * (speed - load / contact.slope)

    def breaks(_t: float, load: np.ndarray) -> float:
        return load[0] - contact.stiction

    breaks.terminal = True
    run = solve_ivp(load_rate, (0.0, 5.0), [0.0], events=breaks, method="DOP853", rtol=1e-12, atol=1e-13)
    assert contact.breakaway_time(stiffness, speed) == pytest.approx(run.t_events[0][0], rel=1e-10)


@pytest.mark.parametrize(("creep_speed", "time"), [(1e-4, 1.00080), (1e-5, 1.00008)])
def test_breakaway_matches_the_published_times(creep_speed: float, time: float) -> None:
    contact = BoundContact(stiction=5.0, creep_speed=creep_speed)  # physics 8 item 2, to 1e-5 s
    assert contact.breakaway_time(100.0, 0.05) == pytest.approx(time, abs=1e-5)
    assert contact.breakaway_time_first_order(100.0, 0.05) == pytest.approx(time, abs=1e-5)


def test_the_mass_of_the_block_shifts_breakaway_by_far_less_than_the_creep_does() -> None:
    contact, mass, stiffness, speed = BoundContact(), 1.0, 100.0, 0.05

    def pulled(t: float, y: np.ndarray) -> list[float]:
        return [y[1], (stiffness * (speed * t - y[0]) - contact.slope * y[1]) / mass]

    def breaks(t: float, y: np.ndarray) -> float:
        return stiffness * (speed * t - y[0]) - contact.stiction

    breaks.terminal = True
    run = solve_ivp(pulled, (0.0, 2.0), [0.0, 0.0], events=breaks, method="Radau", rtol=1e-9, atol=1e-13)
    # The mass delays the creep by m/g0 = 16 us; the load by k (creep) (m/g0), here 1e-10 s.
    assert contact.breakaway_time(stiffness, speed) == pytest.approx(run.t_events[0][0], abs=1e-7)


def test_a_contact_pulled_slower_than_its_creep_never_breaks_away() -> None:
    contact = BoundContact()
    with pytest.raises(ValueError, match="never breaks away"):
        contact.breakaway_time(100.0, 0.5 * float(contact.creep(contact.stiction)))


HUMPS = [Hump(), Hump(at_rest=0.40), Hump(at_rest=0.35), Hump(at_rest=0.419, peak_speed=0.005)]


@pytest.mark.parametrize("hump", HUMPS, ids=["rises", "falls", "level", "almost at its peak"])
def test_a_hump_has_the_peak_its_user_asked_for(hump: Hump) -> None:
    found = minimize_scalar(
        lambda v: -float(hump.coefficient(v)),
        bounds=(0.0, 10 * hump.peak_speed),
        method="bounded",
        options={"xatol": 1e-12},
    )
    # A maximum is located by a search on values only to the square root of rounding.
    assert found.x == pytest.approx(hump.peak_speed, rel=1e-5)
    assert -found.fun == pytest.approx(hump.peak, rel=1e-12)
    assert float(hump.coefficient(0.0)) == pytest.approx(hump.at_rest, rel=1e-14)
    assert float(hump.coefficient(100.0)) == pytest.approx(hump.at_speed, rel=1e-14)


@pytest.mark.parametrize("hump", HUMPS)
def test_the_slope_of_a_hump_is_its_derivative(hump: Hump) -> None:
    v = np.linspace(0.001, 0.3, 57)
    step = 1e-6
    difference = (hump.coefficient(v + step) - hump.coefficient(v - step)) / (2 * step)
    assert np.allclose(difference, hump.slope(v), rtol=1e-5, atol=1e-7)


def test_the_steepest_fall_of_a_hump_is_found_by_search() -> None:
    hump = Hump()
    found = minimize_scalar(lambda v: float(hump.slope(v)), bounds=(0.03, 0.3), method="bounded")
    speed, slope = hump.steepest_fall()
    assert found.x == pytest.approx(speed, rel=1e-4)
    assert found.fun == pytest.approx(slope, rel=1e-9)


@pytest.mark.parametrize("damping", [10.0, 80.0])
def test_sliding_is_stable_exactly_when_the_linearised_motion_decays(damping: float) -> None:
    hump, normal, mass, stiffness = Hump(), 100.0, 1.0, 1e4
    for speed in (0.01, 0.05, 0.15):
        total = damping + normal * float(hump.slope(speed))
        growth = np.roots([mass, total, stiffness]).real.max()
        assert hump.slides_steadily(speed, normal, damping) == (growth < 0.0)


def test_a_peak_not_above_its_ends_is_refused() -> None:
    with pytest.raises(ValueError, match="above both its ends"):
        Hump(at_rest=0.5, peak=0.45)
