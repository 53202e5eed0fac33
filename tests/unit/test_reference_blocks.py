"""The closed forms of single blocks against numerical integration that knows nothing of them."""

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from tests.reference.belt import StickSlipBelt
from tests.reference.carried import CarriedBlock
from tests.reference.incline import InclinedBlock
from tests.reference.stopping import GRAVITY, StoppingBlock

TIGHT = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14}


def integrate_stick_slip(belt: StickSlipBelt, cycles: int) -> list[tuple[float, float, float]]:
    """Breakaway time, capture time and capture position of each cycle, by integration with events."""

    def slip(_t: float, y: np.ndarray) -> list[float]:
        return [y[1], (belt.coulomb - belt.stiffness * y[0]) / belt.mass]

    def at_belt_speed(t: float, y: np.ndarray) -> float:
        return y[1] - belt.speed if t > 0.0 else -1.0

    at_belt_speed.terminal, at_belt_speed.direction = True, 1.0
    found, now, x = [], 0.0, 0.0
    for _ in range(cycles):
        start = now + (belt.stiction / belt.stiffness - x) / belt.speed
        state = [belt.stiction / belt.stiffness, belt.speed]
        run = solve_ivp(slip, (0.0, 10.0), state, events=at_belt_speed, **TIGHT)
        now, x = start + run.t_events[0][0], run.y_events[0][0][0]
        found.append((start, now, x))
    return found


@pytest.mark.parametrize("belt", [StickSlipBelt(), StickSlipBelt(speed=0.05, stiction=5.0, coulomb=3.0)])
def test_stick_slip_times_and_positions_agree_with_integration(belt: StickSlipBelt) -> None:
    found = np.array(integrate_stick_slip(belt, 5))
    # The integration is good to about 1e-12 a cycle.
    assert np.allclose(belt.breakaways(5), found[:, 0], rtol=0, atol=1e-10)
    assert np.allclose(belt.captures(5), found[:, 1], rtol=0, atol=1e-10)
    assert np.allclose(belt.position(belt.captures(5) + 1e-13), found[:, 2], rtol=0, atol=1e-10)


def test_stick_slip_trajectory_obeys_its_own_equation_of_motion() -> None:
    belt = StickSlipBelt(mass=0.7, stiffness=130.0)
    times = np.linspace(0.003, 6.0, 1701)
    switches = np.concatenate([belt.breakaways(9), belt.captures(9)])
    step = 1e-5
    away = np.abs(times[:, None] - switches).min(axis=1) > 2 * step
    t = times[away]
    speed = (belt.position(t + step) - belt.position(t - step)) / (2 * step)
    force = belt.mass * (belt.velocity(t + step) - belt.velocity(t - step)) / (2 * step)
    # Central differences of a sine of frequency w: error w^2 step^2/6, below 1e-8.
    assert np.allclose(speed, belt.velocity(t), atol=1e-7)
    assert np.allclose(force, belt.friction(t) - belt.stiffness * belt.position(t), atol=1e-6)


def test_stick_slip_position_and_speed_are_continuous_at_every_switch() -> None:
    belt = StickSlipBelt()
    switches = np.concatenate([belt.breakaways(50), belt.captures(50)])
    for signal in (belt.position, belt.velocity):
        # An acceleration of at most 8 m/s^2 over 2e-9 s changes a speed by 1.6e-8 m/s.
        assert np.allclose(signal(switches - 1e-9), signal(switches + 1e-9), rtol=0, atol=2e-8)


def test_stick_slip_extremes_are_those_of_the_trajectory() -> None:
    belt = StickSlipBelt()
    t = np.linspace(0.0, 5.0, 2_000_001)
    # Sampled every 2.5 us: the extremum of a parabola is missed by less than 1e-10.
    assert np.max(belt.speed - belt.velocity(t)) == pytest.approx(belt.greatest_slip_speed, rel=1e-8)
    assert np.min(belt.position(t[t > belt.first_breakaway])) == pytest.approx(belt.lowest_position, rel=1e-7)


@pytest.mark.parametrize(("speed", "period"), [(0.02, 2.3341), (0.05, 1.1632), (0.1, 0.8069)])
def test_stick_slip_period_matches_the_published_table(speed: float, period: float) -> None:
    block = StickSlipBelt(speed=speed, stiction=5.0, coulomb=3.0)  # physics 8 item 4, five figures
    assert block.period == pytest.approx(period, abs=5e-5)


def test_a_stopping_block_stops_where_integration_says() -> None:
    block = StoppingBlock(speed=1.7, friction=0.28)
    distance, _ = quad(lambda v: v / (block.friction * GRAVITY), 0.0, block.speed)
    assert block.stopping_distance == pytest.approx(distance, rel=1e-12)
    assert block.position(block.stopping_time) == pytest.approx(distance, rel=1e-12)
    assert block.position(block.stopping_time + 100.0) == block.position(block.stopping_time)
    assert block.velocity(block.stopping_time + 100.0) == pytest.approx(0.0, abs=1e-15)


def test_a_block_on_a_slope_holds_up_to_its_friction_angle() -> None:
    angle = np.arctan(0.40)
    assert InclinedBlock(angle - 1e-12).holds
    assert not InclinedBlock(angle + 1e-12).holds


def test_a_block_that_lets_go_slides_as_energy_demands() -> None:
    block = InclinedBlock(np.radians(30.0))
    time = 2.0
    distance, speed = float(block.position(time)), block.acceleration * time
    lost = block.holding_force(mass=3.0) * distance
    gained = 3.0 * GRAVITY * distance * np.sin(block.angle)
    assert gained - lost == pytest.approx(0.5 * 3.0 * speed**2, rel=1e-12)


def test_a_holding_block_carries_exactly_its_weight_component() -> None:
    block = InclinedBlock(np.radians(15.0))
    assert block.holds
    assert block.holding_force(mass=2.0) == pytest.approx(2.0 * GRAVITY * np.sin(np.radians(15.0)))
    assert block.position(10.0) == 0.0


def test_a_carried_block_reaches_the_belt_after_the_stated_time_and_mark() -> None:
    block = CarriedBlock(belt=0.8, friction=0.3)

    def slide(_t: float, y: np.ndarray) -> list[float]:
        return [y[1], block.friction * GRAVITY]

    def caught(_t: float, y: np.ndarray) -> float:
        return y[1] - block.belt

    caught.terminal = True
    run = solve_ivp(slide, (0.0, 5.0), [0.0, 0.0], events=caught, **TIGHT)
    time, position = run.t_events[0][0], run.y_events[0][0][0]
    assert block.capture_time == pytest.approx(time, rel=1e-10)
    assert block.slid_length == pytest.approx(block.belt * time - position, rel=1e-10)
    assert block.position(time + 2.0) == pytest.approx(position + 2.0 * block.belt, rel=1e-10)
    assert block.velocity(time + 2.0) == block.belt


def test_half_of_the_work_of_the_belt_becomes_heat() -> None:
    block, mass = CarriedBlock(), 4.0
    force = block.friction * mass * GRAVITY
    assert block.heat(mass) == pytest.approx(force * block.slid_length, rel=1e-12)
    assert block.heat(mass) == pytest.approx(0.5 * force * block.belt * block.capture_time, rel=1e-12)


def test_the_spring_force_overshoots_the_stick_range_by_the_speed_of_the_belt() -> None:
    belt = StickSlipBelt()
    run = solve_ivp(
        lambda _t, y: [y[1], (belt.coulomb - belt.stiffness * y[0]) / belt.mass],
        (0.0, belt.slip_time),
        [belt.stiction / belt.stiffness, belt.speed],
        dense_output=True,
        **TIGHT,
    )
    force = belt.stiffness * run.sol(np.linspace(0.0, belt.slip_time, 200_001))[0]
    assert force.min() == pytest.approx(belt.stiffness * belt.lowest_position, rel=1e-6)
    assert force.max() + force.min() == pytest.approx(2.0 * belt.coulomb, rel=1e-6)
    assert force.max() > belt.stiction
