"""The ledger knows what a drive gives a crank whose slider friction holds: both hold one body and share it."""

from __future__ import annotations

import numpy as np
import pytest

SCENE = """
    components:
      drive: {{type: MotionSource, velocity: {{step: {{to: {speed}, at: 0.2 s}}}}, origin: {origin}}}
      rim: {{type: Rack, radius: 0.1 m}}
      crank: {{type: Crank, radius: 20 mm, rod: 80 mm, offset: {offset}}}
      piston: {{type: Mass, mass: 1.5 kg}}
      wall: {{type: Ground}}
      guide: {{type: Contact, normal_force: 2 N, curve: 0.3}}
      spring: {{type: Spring, stiffness: 1000 N/m, free_length: 0.1 m}}
    connections:
      - [drive.flange, rim.rack]
      - [rim.pinion, crank.shaft]
      - [crank.slider, piston.flange, guide.b, spring.b]
      - [wall.flange, guide.a, spring.a]
    run: {{stop: 0.6 s, accuracy: 1e-6}}
"""
PLACES = [("51 mm", "0 mm"), ("51 mm", "2 mm"), ("30 mm", "0 mm"), ("-51 mm", "0 mm")]


@pytest.mark.parametrize("speed", ["0.8 m/s", "0.5 m/s", "-0.8 m/s"])
@pytest.mark.parametrize(("origin", "offset"), PLACES)
def test_a_drive_that_starts_at_once_gives_what_the_piston_and_its_friction_take(simulate, speed, origin, offset):
    result = simulate(SCENE.format(speed=speed, origin=origin, offset=offset))
    x, v = result["piston.x"], result["piston.v"]
    spring = 500.0 * ((x[-1] - 0.1) ** 2 - (x[0] - 0.1) ** 2)
    rubbed = 0.6 * abs(np.diff(x)).sum()  # from row to row: the way between two dead centres, on both sides of each
    needed = spring + 0.75 * v[-1] ** 2 + rubbed + result.run["lost"]["crank"]
    assert result.run["energy"]["supplied"] == pytest.approx(needed, abs=2e-4)
    assert result.run["energy"]["closure"] < 1e-6
