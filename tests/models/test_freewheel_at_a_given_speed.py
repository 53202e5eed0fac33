"""A freewheel at a shaft of given speed lets go as its torque falls through zero, however short the steps there are.

The torque that holds is a mean over a step. In the last steps before the release, of picoseconds, it is known to the
rounding of momentum only, which is more than any weight: `stepping` fell to its floor at every second accuracy.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.optimize import brentq

MOMENT, DAMPING, TOP, RATE = 2.0, 1.0, 3.0, 2 * math.pi

SCENE = """
    components:
      m: {{type: SpeedSource, speed: {{sine: {{amplitude: {top} rad/s, frequency: 1 Hz}}}}}}
      k: {{type: Inertia, moment: {moment} kg*m^2, speed: 0 rad/s}}
      f: {{type: OneWayClutch}}
      d: {{type: RotationalDamper, damping: {damping} N*m*s/rad}}
      h: {{type: Housing}}
    connections: [[m.shaft, f.a], [f.b, k.shaft, d.b], [d.a, h.shaft]]
    run: {{stop: 3 s, accuracy: {accuracy}}}
"""


def end_speed(stop=3.0):
    """It follows 3 sin until J w' + d w = 0, then decays until the next rise takes it along."""
    released = (math.pi - math.atan(MOMENT * RATE / DAMPING)) / RATE
    t, speed = released, TOP * math.sin(RATE * released)

    def free(at):
        return speed * math.exp(-DAMPING / MOMENT * (at - t))

    while True:
        rise = math.floor(t) + 1.0
        taken = brentq(lambda at: free(at) - TOP * math.sin(RATE * at), rise, rise + 0.25) if rise < stop else stop
        if taken >= stop:
            return free(stop)
        t, speed = rise + released, TOP * math.sin(RATE * released)


@pytest.mark.parametrize("accuracy", np.geomspace(1e-3, 1e-8, 11).tolist())
@pytest.mark.parametrize("size", [1.0, 1e-6, 1e6])
def test_stepping_passes_the_release_at_any_accuracy_and_size(simulate, accuracy, size):
    text = SCENE.format(top=TOP, moment=MOMENT * size, damping=DAMPING * size, accuracy=accuracy)
    result = simulate(text, **{"run.engine": "stepping"})
    assert result["k.speed"][-1] == pytest.approx(end_speed(), rel=max(10 * accuracy, 1e-8))


@pytest.mark.parametrize("engine", ["rodas", "ida"])
def test_so_do_the_others(simulate, engine):
    text = SCENE.format(top=TOP, moment=MOMENT, damping=DAMPING, accuracy=1e-6)
    assert simulate(text, **{"run.engine": engine})["k.speed"][-1] == pytest.approx(end_speed(), rel=1e-5)
