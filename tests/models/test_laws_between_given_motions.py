"""Curved laws between given motions, as on a bench for friction: no unknown's error tells how fast they change.

Closed form: a contact pressed with 100 N slides at a given speed v with 100 N mu(v), mu falling from 1.0 to 0.4 over
10 mm/s (Stribeck), rounded off over the creep. Between -1 and 1 m/s it passes 99 N at some tenths of a millimetre a
second, and 60 N at some millimetres.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

BENCH = """
    components:
      a: {{type: Ground}}
      m: {{type: MotionSource, velocity: {velocity}}}
      k: {{type: Contact, normal_force: 100 N, method: {method}, creep: 0.1 mm/s,
          curve: {{curve: stribeck, stiction: 1.0, coulomb: 0.4, velocity: 10 mm/s}}}}
    connections: [[a.flange, k.a], [m.flange, k.b]]
    limits: {{k.friction: {{below: 60 N}}}}
    run: {{stop: {stop} s}}
"""


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("method", ["tanh", "root", "binding"])
@pytest.mark.parametrize("scale", [1.0, 1e-3, 1e3])
def test_a_ramp_of_slip_shows_the_whole_curve(simulate, engine, method, scale):
    ramp = f"{{ramp: {{from: -1 m/s, to: 1 m/s, over: {scale} s}}}}"
    result = simulate(BENCH.format(velocity=ramp, method=method, stop=scale), **{"run.engine": engine})
    assert any("limit broken" in str(one) for one in result.remarks)
    # 100 N (0.4 + 0.6 exp(-(v/10 mm/s)^2)) |v| over the ramp; what is rounded off at 0.1 mm/s is far below 1e-3 of it
    power = quad(lambda v: 100 * (0.4 + 0.6 * np.exp(-((v / 0.01) ** 2))) * v, 0, 1, points=[0.01, 0.1])[0]
    assert result.run["energy"]["dissipated"] == pytest.approx(power * scale, rel=2e-3)
    assert result["k.friction"].max() > 90


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("method", ["tanh", "root"])
def test_no_extreme_is_told_beyond_the_law(simulate, engine, method):
    """A curve through the rows of a step in which friction turns round would overshoot them by half."""
    ramp = "{ramp: {from: -1 m/s, to: 1 m/s, over: 1 s}}"
    result = simulate(BENCH.format(velocity=ramp, method=method, stop=1), **{"run.engine": engine})
    lowest, _, highest, _ = result.run["extremes"]["k.friction"]
    assert highest <= 100.0
    assert lowest >= -100.0
    assert highest > 95.0


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("mass", [1e2, 1e4, 1e5, 1e6])
def test_nor_of_a_body_so_heavy_that_friction_hardly_moves_it(simulate, engine, mass):
    """It passes zero at 2 m/s^2 in steps that its speed allows, and these are long beside the change of friction."""
    text = f"""
        components:
          a: {{type: Ground}}
          m: {{type: Mass, mass: {mass} kg, velocity: -1 m/s}}
          f: {{type: ForceSource, force: {2 * mass + 40} N}}
          k: {{type: Contact, normal_force: 100 N, method: tanh, creep: 0.1 mm/s,
              curve: {{curve: stribeck, stiction: 1.0, coulomb: 0.4, velocity: 10 mm/s}}}}
        connections: [[a.flange, k.a], [m.flange, f.flange, k.b]]
        run: {{stop: 1 s}}
    """
    lowest, _, highest, _ = simulate(text, **{"run.engine": engine}).run["extremes"]["k.friction"]
    assert lowest >= -100.0 - 1e-9
    assert highest <= 100.0 + 1e-9
    if mass <= 1e4:  # a heavier one passes the whole change within a step, between its rows
        assert lowest < -90.0
        assert highest > 90.0
