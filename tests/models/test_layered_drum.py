"""The force of a drum that turns at a given speed while its line goes over from one layer to the next.

Closed form: the radius goes over in a straight line over the angle c, so the line has the acceleration
a = w^2 (R_1 - R_0)/c there, and the drum the torque  R (M a - T)  of a rope of mass M with the tension T at its end.
"""

import itertools
import math

import numpy as np
import pytest

LAYER, WRAPS, FIRST = 0.085 * math.sqrt(3) / 2, 9, 0.6425
ACCURACIES = ("1e-2", "1e-3", "1e-4", "1e-5", "1e-6")


def drum(start, wound, speed, *, stop, name="", crossover="90 deg", element=0.5, drive=""):
    """A rope of 40 kg and 20 m, pulled at by 100 N, on a drum with `wound` [m] in all on it at the start."""
    drive = drive or f"{{ramp: {{to: {speed} m/s, over: 0.5 s}}}}"
    parts = f"""
      {name}rope: {{type: Cable, mass: 2 kg/m, stiffness: 200 kN, damping_ratio: 0.5, length: 20 m,
                    element: {element} m, start: {start} m, tension: 100 N}}
      {name}route:
        type: Route
        stations:
          - {{name: winch, type: Winch, radius: 0.6 m, layers: on, width: 0.8 m, line_diameter: 85 mm,
              filled: {wound + start} m, crossover: {crossover}}}
          - {{type: Straight, length: 60 m}}
      {name}wheel: {{type: Rack, radius: 1 m}}
      {name}drive: {{type: MotionSource, velocity: {drive}}}
      {name}pull: {{type: ForceSource, force: 100 N}}"""
    joins = f"""
      - [{name}rope.path, {name}route.path]
      - [{name}drive.flange, {name}wheel.rack]
      - [{name}wheel.pinion, {name}route.winch.shaft]
      - [{name}pull.flange, {name}rope.outboard]"""
    signals = [f"{name}drive.force", f"{name}route.winch.radius"]
    return parts, joins, signals, stop


def scene(*drums):
    """All of these drums, beside one another."""
    parts, joins = "".join(one[0] for one in drums), "".join(one[1] for one in drums)
    signals = list(itertools.chain.from_iterable(one[2] for one in drums))
    return f"""
    components:{parts}
    connections:{joins}
    run: {{stop: {max(one[3] for one in drums)} s}}
    record: {{signals: {signals}}}
    """.replace("'", "")


def crossing(result, name=""):
    """Radius and torque while the rope crosses over and a tenth of a second before and after, and where it does."""
    radius, torque = result[f"{name}route.winch.radius"], result[f"{name}drive.force"]
    between = (radius > FIRST + 1e-6) & (radius < FIRST + LAYER - 1e-6) & (result.t > 0.6)
    begin, end = result.t[between][[0, -1]]
    near = (result.t > begin - 0.1) & (result.t < end + 0.1)
    return radius[near], torque[near], between[near]


def judge(result, speed, name="", crossover=math.pi / 2):
    """The peak is within 5 % of the closed form, and so is the force at all times but for the waves in the rope."""
    radius, torque, between = crossing(result, name)
    wanted = radius * (np.where(between, -40.0 * speed**2 * LAYER / crossover, 0.0) - 100.0)
    peak = -(FIRST + LAYER * (speed > 0)) * (100.0 + 40.0 * speed**2 * LAYER / crossover)
    assert torque.min() == pytest.approx(peak if speed > 0 else wanted.min(), rel=0.05)
    assert np.abs(torque - wanted).max() < 0.15 * abs(peak)


PAY_OUT = drum(-18, 40, 2, stop=4)


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_the_peak_at_a_change_of_layer_is_right_at_the_default_accuracy(simulate, engine):
    """At the instants of the change one force is recorded, not one of each piece."""
    result = simulate(scene(PAY_OUT), **{"run.engine": engine})
    judge(result, 2)
    torque = result["drive.force"]
    left = np.flatnonzero(result.side == -1)
    left = left[result.t[left] > 0.6]
    np.testing.assert_allclose(torque[left + 1], torque[left], rtol=1e-3)


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize("accuracy", ACCURACIES)
def test_the_peak_at_a_change_of_layer_does_not_follow_the_accuracy(simulate, engine, accuracy):
    result = simulate(scene(PAY_OUT), **{"run.engine": engine, "run.accuracy": accuracy})
    judge(result, 2)


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_several_drums_at_speeds_and_crossovers_of_their_own_have_each_its_peak(simulate, engine):
    one = drum(-18, 40, 2, stop=4, name="b_")
    other = drum(-18, 39, 3, stop=4, name="a_", crossover="120 deg", element=0.4)
    result = simulate(scene(one, other), **{"run.engine": engine})
    judge(result, 2, "b_")
    judge(result, 3, "a_", 2 * math.pi / 3)


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
def test_a_line_that_is_hauled_in_over_a_change_of_layer_pulls_less_meanwhile(simulate, engine):
    """Elements of 5 m: no node comes to the drum while it crosses over."""
    result = simulate(scene(drum(-3, 32.5, -2, stop=4.5, element=5)), **{"run.engine": engine, "run.accuracy": "1e-4"})
    judge(result, -2)


@pytest.mark.parametrize("accuracy", ["1e-3", "1e-4", "1e-5"])
def test_a_node_that_comes_on_to_the_drum_is_no_blow(simulate, accuracy):
    """Hauled in at a given speed: after the start the torque is that of the pull, but for waves in the rope (60 %).

    At each of some thirty nodes the bond of 1e9 N s/m showed the error of a speed as 2 kN m at 1e-4, 17 at 1e-3.
    """
    result = simulate(scene(drum(-2, 40, -2, stop=6)), **{"run.accuracy": accuracy})
    later = result.t > 1.0
    pull = -100.0 * result["route.winch.radius"][later]
    assert np.abs(result["drive.force"][later] / pull - 1).max() < 0.75
    found = result.extremes("drive.force")
    assert found.highest < 0.0
    assert found.t_lowest < 0.5  # the start
