"""A slider on a linkage that meets a rigid stop, rests on it and leaves it, against one equation of the shaft by scipy.

    (J + m x'^2) w' + m x' x'' w^2 = torque(t),   x' = dx/d(angle)      between
    w+ = -e w-                                                          where the slider meets the stop
    at rest there while the torque presses it on, that is until torque x' changes its sign
"""

import math
from typing import NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

MOMENT, MASS = 0.05, 2.0


class Linkage(NamedTuple):
    """Its part, the place of its slider over the angle, and where stops stand outward and inward of its start."""

    part: str
    place: object
    outer: float
    inner: float

    def slopes(self, angle):
        """First and second derivative of the place: complex steps, and a difference of them."""
        h = 1e-5
        first = self.place(angle + 1e-30j).imag / 1e-30
        second = (self.place(angle + h + 1e-30j).imag - self.place(angle - h + 1e-30j).imag) / (2 * h * 1e-30)
        return first, second


LINKAGES = {
    "crank": Linkage("type: Crank, radius: 0.1 m, rod: 0.3 m",
                     lambda a: 0.1 * np.cos(a) + np.sqrt(0.09 - (0.1 * np.sin(a)) ** 2), 0.36, 0.24),
    "cam": Linkage("type: Cam, base: 0.1 m, lift: 0.1 m", lambda a: 0.1 + 0.05 * (1 - np.cos(a)), 0.18, 0.12),
    "strut": Linkage("type: ArmStrut, frame: 0.5 m, radius: 0.3 m",
                     lambda a: np.sqrt(0.34 - 0.3 * np.cos(a)), 0.66, 0.5),
}  # fmt: skip


def scene_of(linkage, outward, e, accuracy, engine="rodas", drive="5 N*m, frequency: 1 Hz"):
    """A shaft turned by a torque that swings, the linkage, its slider and a stop on the ground."""
    place = linkage.outer if outward else linkage.inner
    ends = ("stop.a", "stop.b") if outward else ("stop.b", "stop.a")
    return f"""
        components:
          ground: {{type: Ground}}
          shaft: {{type: Inertia, moment: {MOMENT} kg*m^2, angle: 90 deg, speed: 0}}
          slider: {{type: Mass, mass: {MASS} kg}}
          link: {{{linkage.part}}}
          stop: {{type: RigidStop, length: {-place if outward else place} m, restitution: {e}}}
          drive: {{type: TorqueSource, torque: {{sine: {{amplitude: {drive}}}}}}}
        connections:
          - [drive.shaft, shaft.shaft, link.shaft]
          - [link.slider, slider.flange, {ends[0]}]
          - [ground.flange, {ends[1]}]
        run: {{stop: 1.2 s, accuracy: {accuracy}, engine: {engine}}}
    """


def oracle(linkage, outward, e, stop=1.2):
    """(times of meeting, times of leaving after rest, angle and speed at the end)."""
    place, side = (linkage.outer, 1) if outward else (linkage.inner, -1)

    def torque(t):
        return 5 * math.sin(2 * math.pi * t)

    def moves(t, y):
        first, second = linkage.slopes(y[0])
        return y[1], (torque(t) - MASS * first * second * y[1] ** 2) / (MOMENT + MASS * first**2)

    def meets(t, y):
        return side * (linkage.place(y[0]) - place)

    meets.direction, meets.terminal = 1, True
    t, y, met, left = 0.0, np.array([math.pi / 2, 0.0]), [], []
    while t < stop:
        part = solve_ivp(moves, (t, stop), y, rtol=1e-10, atol=1e-12, events=meets, method="DOP853")
        t, y = part.t[-1], part.y[:, -1].copy()
        if part.status != 1:
            break
        met.append(t)
        y[1] *= -e
        pressing = side * torque(t) * linkage.slopes(y[0])[0] > 0
        if abs(y[1]) < 1e-4:
            y[1] = 0.0
        if y[1] == 0.0 and pressing:
            y[0] = brentq(lambda a: linkage.place(a).real - place, y[0] - 1e-4, y[0] + 1e-4)
            t = min(stop, next(k for k in np.arange(0.5, 9, 0.5) if k > t))  # where the torque turns
            left += [t] if t < stop else []
    return met, left, t, y


@pytest.mark.parametrize("accuracy", ["1e-2", "1e-3", "1e-5"])
@pytest.mark.parametrize("outward", [True, False], ids=["outward", "inward"])
@pytest.mark.parametrize("name", LINKAGES)
def test_a_slider_rests_on_its_stop_until_the_torque_turns(simulate, name, outward, accuracy):
    """Without rebound: it stays where the stop is, leaves when the torque turns, and goes on as the equation says."""
    linkage = LINKAGES[name]
    result = simulate(scene_of(linkage, outward, 0, accuracy))
    met, left, _, (angle, speed) = oracle(linkage, outward, 0)
    events = [one for one in result.events if one.component == "stop"]
    begins = [one.t for one in events if one.zone_to == "touching"]
    share = float(accuracy)
    assert met
    for t in met:
        assert min(abs(t - one) for one in begins) < 0.5 * share * 1.2
    for t in left:
        assert min(abs(t - one.t) for one in events if one.zone_to == "free") < max(0.5 * share * 1.2, 2e-5)
    place = linkage.outer if outward else linkage.inner
    for t, u in zip(met, left, strict=False):
        rests = (result.t > t + 2 * share) & (result.t < u - 2 * share)
        assert np.abs(result["slider.x"][rests] - place).max(initial=0) < 1e-9
    assert result["stop.force"].min() > -1e-2
    assert result["stop.gap"].min() > -1e-5
    assert result["shaft.angle"][-1] == pytest.approx(angle, abs=max(0.5 * share, 2e-4))
    assert result["shaft.speed"][-1] == pytest.approx(speed, abs=max(5 * share, 2e-3))


@pytest.mark.parametrize("accuracy", ["1e-2", "1e-3"])
@pytest.mark.parametrize("name", LINKAGES)
def test_a_slider_that_is_thrown_back_comes_to_rest_and_leaves(simulate, name, accuracy):
    """With half its speed each time: the first blows are where the equation has them, and the run comes to its end."""
    linkage, share = LINKAGES[name], float(accuracy)
    result = simulate(scene_of(linkage, True, 0.5, accuracy))
    met, *_ = oracle(linkage, True, 0.5, stop=0.45)
    begins = [one.t for one in result.events if one.zone_to == "touching" and one.component == "stop"]
    first = min(len(met), 2)
    np.testing.assert_allclose(begins[:first], met[:first], atol=0.5 * share)
    assert result["stop.force"].min() > -1e-2
    assert result["stop.gap"].min() > -1e-5
    assert result["link.gap"].max() < 1e-5


BETWEEN = """
    components:
      ground: {{type: Ground}}
      shaft: {{type: Inertia, moment: 0.05 kg*m^2, angle: 90 deg, speed: 0}}
      slider: {{type: Mass, mass: 2 kg}}
      link: {{type: Crank, radius: 0.1 m, rod: 0.3 m}}
      stop: {{type: RigidStop, length: 20 mm}}
      block: {{type: Mass, mass: 3 kg, position: 0.36 m}}
      spring: {{type: Spring, stiffness: 500 N/m, free_length: 0.36 m}}
      drive: {{type: TorqueSource, torque: {{sine: {{amplitude: -4 N*m, frequency: 1 Hz}}}}}}
    connections:
      - [drive.shaft, shaft.shaft, link.shaft]
      - [link.slider, slider.flange, stop.a]
      - [block.flange, stop.b, spring.b]
      - [ground.flange, spring.a]
    run: {{stop: 1 s, accuracy: {accuracy}}}
"""


@pytest.mark.parametrize("accuracy", ["1e-2", "1e-3", "1e-5"])
def test_a_slider_pushes_a_free_block_and_lets_it_go(simulate, accuracy):
    """Both bodies move: while they touch they are one, and the blow keeps the momentum."""
    linkage = LINKAGES["crank"]

    def blow(y, e=0.0):
        first, _ = linkage.slopes(y[0])
        inertia = MOMENT + MASS * first**2
        impulse = (first * y[1] - y[3]) / (first**2 / inertia + 1 / 3)
        return np.array([y[0], y[1] - first * impulse / inertia, y[2], y[3] + impulse / 3])

    def forces(t, y, touching):
        first, second = linkage.slopes(y[0])
        inertia, torque = MOMENT + MASS * first**2, -4 * math.sin(2 * math.pi * t) - MASS * first * second * y[1] ** 2
        spring = -500 * (y[2] - 0.36)
        push = 0.0
        if touching:  # first w' + second w^2 = block's acceleration
            push = (first * torque / inertia + second * y[1] ** 2 - spring / 3) / (first**2 / inertia + 1 / 3)
        return np.array([y[1], (torque - first * push) / inertia, y[3], (spring + push) / 3]), push

    gap = lambda t, y: y[2] - linkage.place(y[0]).real - 0.02  # noqa: E731
    t, y, touching, turns = 0.0, np.array([math.pi / 2, 0.0, 0.36, 0.0]), False, []
    while t < 1:
        ends = (lambda t, y: forces(t, y, True)[1]) if touching else gap
        ends.terminal, ends.direction = True, -1
        part = solve_ivp(lambda t, y, held=touching: forces(t, y, held)[0], (t, 1), y, rtol=1e-10, atol=1e-12,
                         events=ends, method="DOP853")  # fmt: skip
        t, y = part.t[-1], part.y[:, -1]
        if part.status == 1:
            turns.append(t)
            touching = not touching
            y = blow(y) if touching else y
            if touching and forces(t, y, True)[1] < 0:
                touching = False
    result, share = simulate(BETWEEN.format(accuracy=accuracy)), float(accuracy)
    assert turns
    events = [one.t for one in result.events if one.component == "stop"]
    for one in turns:
        assert min(abs(one - event) for event in events) < max(0.5 * share, 1e-4)
    assert result["block.x"][-1] == pytest.approx(y[2], abs=max(share, 1e-4))
    assert result["shaft.angle"][-1] == pytest.approx(y[0], abs=max(2 * share, 1e-3))
    assert result["stop.gap"].min() > -1e-5
