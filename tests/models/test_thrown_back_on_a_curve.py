"""A body that an impact throws back while its contact slides: friction has to change over before it means anything.

Until it has, its law is read at a speed against its direction. There an exponential has no bound: the force of
hump at 1.7 m/s, 75 times the speed of its peak, would be 1e33 N, and had the stop met again and the body at rest.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.conftest import Scene

BALL, SPEED, NORMAL, BACK, WALL = 0.4937, 3.566, 3.207, 0.5, 0.2868
CURVES = {
    "hump": "{curve: hump, stiction: 0.23, peak: 0.3688, peak_velocity: 22.81 mm/s, coulomb: 0.23}",
    "high hump": "{curve: hump, stiction: 0.2, peak: 0.6, peak_velocity: 5 mm/s, coulomb: 0.1}",
    "tustin": "{curve: tustin, stiction: 0.4, coulomb: 0.23, velocity: 20 mm/s}",
    "stribeck": "{curve: stribeck, stiction: 0.4, coulomb: 0.23, velocity: 20 mm/s}",
}


def friction(curve: str, v: float) -> float:
    """mu(v) of these, written anew."""
    if curve == "hump":
        return 0.23 + (0.3688 - 0.23) * np.e / 0.02281 * v * np.exp(-v / 0.02281)
    if curve == "stribeck":
        return 0.23 + 0.17 * np.exp(-((v / 0.02) ** 2))
    return 0.23 + 0.17 * np.exp(-v / 0.02)


def slides(curve: str, way: float, speed: float) -> float:
    """Speed [m/s] after a way [m], from v dv/dx = -N mu(v)/m."""
    found = solve_ivp(lambda _x, v: -NORMAL * friction(curve, v[0]) / (BALL * v[0]), (0, way), [speed], rtol=1e-10)
    return float(found.y[0, -1])


def wall(curve: str, method: str, engine: str, *, size: float = 1.0, speed: float = SPEED) -> str:
    return f"""
    components:
      floor: {{type: Ground}}
      pad: {{type: Contact, normal_force: {NORMAL * size} N, curve: {CURVES[curve]}}}
      ball: {{type: Mass, mass: {BALL * size} kg, position: -{WALL} m, velocity: {speed} m/s}}
      stop: {{type: RigidStop, restitution: {BACK}}}
    connections: [[ball.flange, pad.b, stop.a], [floor.flange, pad.a, stop.b]]
    friction: {{method: {method}}}
    run: {{stop: 0.3 s, accuracy: 1e-7, engine: {engine}}}
    """


@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize("method", ["hold", "karnopp", "binding"])
@pytest.mark.parametrize("curve", ["hump", "tustin", "stribeck"])
def test_a_ball_comes_back_from_a_wall_with_its_share_of_the_speed(
    simulate: Scene, curve: str, method: str, engine: str
) -> None:
    result = simulate(wall(curve, method, engine))
    assert [e.zone_to for e in result.events if e.component == "stop"] == ["touching", "free"]
    comes = slides(curve, WALL, SPEED)
    lost = 0.5 * BALL * comes**2 * (1 - BACK**2)
    assert result.run["lost"]["stop"] == pytest.approx(lost, rel=1e-5)
    back = float(-result["ball.x"][-1])
    assert -result["ball.v"][-1] == pytest.approx(slides(curve, back, BACK * comes), rel=1e-5)
    assert result.run["energy"]["closure"] < 1e-6


@pytest.mark.parametrize("size", [1e-3, 1e3])
def test_at_other_sizes_as_well(simulate: Scene, size: float) -> None:
    result = simulate(wall("hump", "hold", "rodas", size=size))
    assert [e.zone_to for e in result.events if e.component == "stop"] == ["touching", "free"]
    assert result["ball.v"][-1] < -1.0


@pytest.mark.parametrize("method", ["hold", "karnopp"])
@pytest.mark.parametrize("speed", [20.0, 300.0])
def test_where_the_exponential_would_overflow_too(simulate: Scene, method: str, speed: float) -> None:
    result = simulate(wall("high hump", method, "rodas", speed=speed))
    assert [e.zone_to for e in result.events if e.component == "stop"] == ["touching", "free"]
    assert result["ball.v"][-1] < -0.4 * speed
    assert result.run["energy"]["closure"] < 1e-6


@pytest.mark.parametrize("engine", ["rodas", "ida"])
def test_two_balls_that_run_into_one_from_both_sides_part_as_they_came(simulate: Scene, engine: str) -> None:
    """The tie 47 of the random scenes: what is symmetric stays so, and each loses three quarters of its energy."""
    result = simulate(f"""
    components:
      floor: {{type: Ground}}
      pad0: {{type: Contact, normal_force: {NORMAL} N, curve: {CURVES["hump"]}}}
      pad2: {{type: Contact, normal_force: {NORMAL} N, curve: {CURVES["hump"]}}}
      ball0: {{type: Mass, mass: {BALL} kg, position: -{WALL} m, velocity: {SPEED} m/s}}
      ball1: {{type: Mass, mass: 0.9021 kg, position: 0 m, velocity: 0 m/s}}
      ball2: {{type: Mass, mass: {BALL} kg, position: {WALL} m, velocity: -{SPEED} m/s}}
      stop0: {{type: RigidStop, restitution: {BACK}}}
      stop1: {{type: RigidStop, restitution: {BACK}}}
    connections: [[ball0.flange, pad0.b, stop0.a], [ball1.flange, stop0.b, stop1.a], [ball2.flange, pad2.b, stop1.b],
                  [floor.flange, pad0.a, pad2.a]]
    run: {{stop: 0.3 s, accuracy: 1e-7, engine: {engine}}}
    """)
    assert result["ball0.v"][-1] == pytest.approx(-result["ball2.v"][-1], rel=1e-9)
    assert abs(result["ball1.v"][-1]) < 1e-9
    comes = slides("hump", WALL, SPEED)
    assert result["ball2.v"][-1] == pytest.approx(slides("hump", float(result["ball2.x"][-1]), BACK * comes), rel=1e-5)
