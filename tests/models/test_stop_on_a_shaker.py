"""A body that rests on a stop whose other side moves as given: it leaves where that falls faster than the body does."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.optimize import brentq

G = 9.81


def shaken(amplitude, frequency, engine, accuracy, stop, unit=1.0):
    return f"""
    components:
      weight: {{type: ForceSource, force: {-G * unit} N}}
      body: {{type: Mass, mass: {unit} kg}}
      rest: {{type: RigidStop}}
      plate: {{type: MotionSource, velocity: {{sine: {{amplitude: {amplitude} m/s, frequency: {frequency} Hz}}}}}}
    connections: [[plate.flange, rest.a], [rest.b, body.flange, weight.flange]]
    initial: {{body.x: 0 m}}
    run: {{stop: {stop} s, engine: {engine}, accuracy: {accuracy}}}
    record: {{every: 1 ms, signals: ["*"]}}
    """


def flights(amplitude, frequency, stop):
    """(leaves, lands) of every flight without rebound: it leaves where a w cos w t = -g, and falls freely."""
    pace = 2 * np.pi * frequency

    def plate(t):
        return amplitude / pace * (1 - np.cos(pace * t))

    def pressed(t):
        return amplitude * pace * np.cos(pace * t) + G

    grid = np.arange(0.0, stop, 1e-5)
    found, t = [], 0.0
    while True:
        later = grid[grid > t + 1e-9]
        falls = later[:-1][(pressed(later[:-1]) > 0) & (pressed(later[1:]) <= 0)]
        if pressed(t + 1e-9) <= 0:
            leaves = t
        elif len(falls):
            leaves = brentq(pressed, falls[0], falls[0] + 1e-5)
        else:
            return found
        place, speed = plate(leaves), amplitude * np.sin(pace * leaves)

        def gap(s, place=place, speed=speed, leaves=leaves):
            return place + speed * (s - leaves) - G / 2 * (s - leaves) ** 2 - plate(s)

        later = grid[grid > leaves + 1e-3]
        meets = later[:-1][(gap(later[:-1]) > 0) & (gap(later[1:]) <= 0)]
        if not len(meets):
            return found
        t = brentq(gap, meets[0], meets[0] + 1e-5)
        found.append((leaves, t))


@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize(
    ("amplitude", "frequency", "unit"),
    [(1.0, 2, 1.0), (0.6, 3, 1e3), pytest.param(0.35, 8, 1e-3, marks=pytest.mark.slow),
     pytest.param(0.3, 15, 1.0, marks=pytest.mark.slow)],
)  # fmt: skip
@pytest.mark.parametrize("accuracy", [pytest.param("1e-3", marks=pytest.mark.slow), "1e-4", "1e-6"])
def test_it_leaves_and_lands_when_it_should(simulate, engine, amplitude, frequency, unit, accuracy):
    """Three flights, found by the roots of closed forms; with other masses too."""
    stop = 3.3 / frequency
    result = simulate(shaken(amplitude, frequency, engine, accuracy, stop, unit))
    told = [(event.t, event.zone_to) for event in result.events]
    flown = [(t, later[0]) for (t, zone), later in pairwise(told) if zone == "free" and later[0] - t > 0.01 / frequency]
    exact = [flight for flight in flights(amplitude, frequency, stop) if flight[1] < stop]
    assert len(exact) == 3
    assert np.array(flown) == pytest.approx(np.array(exact), abs=20 * float(accuracy) / frequency)
    if engine == "rodas":  # ida leaves them apart by more than the stop allows, and catches them again
        assert len(told) <= 2 * len(exact) + 8  # a stop that lets go early meets again at once
