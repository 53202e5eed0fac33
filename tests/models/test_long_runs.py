"""How long a run is to be does not change what happens in it."""

import numpy as np
import pytest

BELT = """
    components:
      wall: {{type: Ground}}
      spring: {{type: Spring, stiffness: {stiffness} N/m}}
      block: {{type: Mass, mass: 1 kg, velocity: {speed} m/s}}
      belt: {{type: MotionSource, velocity: {speed} m/s}}
      pad: {{type: Contact, normal_force: {pressed} N, curve: {{curve: coulomb, stiction: 1.0, coulomb: 0.6}}}}
    connections: [[wall.flange, spring.a], [spring.b, block.flange, pad.b], [belt.flange, pad.a]]
    run: {{stop: {stop} s, engine: {engine}, accuracy: {accuracy}, max_steps: 1500}}
    record: {{signals: [block.*], every: {stop} s}}
"""


@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize("accuracy", [pytest.param("1e-3", marks=pytest.mark.slow), "1e-4", "1e-6"])
@pytest.mark.parametrize(("stiffness", "pressed", "speed"), [(100, 10, 0.2), (1e6, 1e5, 20)])
def test_a_block_goes_on_sticking_and_slipping(scene, engine, accuracy, stiffness, pressed, speed):
    """Carried along it takes a step of days; when it lets go its first step is one of its own motion."""
    known = {"stiffness": stiffness, "pressed": pressed, "speed": speed, "engine": engine, "accuracy": accuracy}
    seen = []
    for stop in (1e4, 1e7, 1e8, 1e9):
        result = scene(BELT.format(**known, stop=stop)).run(out=None, check=False)
        assert result.status == "budget"
        seen.append([event.t for event in result.events][:8])
        assert len(seen[-1]) == 8
    period = seen[0][7] - seen[0][1]  # of three times sticking and slipping
    assert np.array(seen) == pytest.approx(np.array(4 * [seen[0]]), abs=0.01 * period)
