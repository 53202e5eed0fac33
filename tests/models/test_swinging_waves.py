"""Sines with envelopes and in bursts in a run: bodies go where an independent integration takes them."""

import itertools

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import fairlead

SCENE = """
schema: 1
name: envelopes
components:
  wall: {type: Ground}
  push:
    type: ForceSource
    force: {product: {of: {sine: {amplitude: 3 N, frequency: 2 Hz}}, times: {ramp: {to: 1, over: 2 s}}}}
  body: {type: Mass, mass: 1 kg}
  damper: {type: Damper, damping: 0.5 N*s/m}
  shaker:
    type: MotionSource
    velocity: {gate: {of: {sine: {amplitude: 0.4 m/s, frequency: 3 Hz}}, start: 0.25 s, stop: 1.35 s}}
  spring: {type: Spring, stiffness: 100 N/m}
  load: {type: Mass, mass: 0.5 kg}
connections:
  - [push.flange, body.flange, damper.a]
  - [damper.b, wall.flange]
  - [shaker.flange, spring.a]
  - [spring.b, load.flange]
run: {stop: 3 s, accuracy: 1e-8}
record: {every: 0.5 s}
"""


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    path = tmp_path_factory.mktemp("waves") / "envelopes.yaml"
    path.write_text(SCENE)
    return fairlead.load(path)


def _integrated(rates, start, borders):
    """State at the last border; every piece is integrated by itself, and `rates` is told the middle of it."""
    state = np.array(start, dtype=float)
    for left, right in itertools.pairwise(borders):
        middle = (left + right) / 2
        found = solve_ivp(lambda t, y, m=middle: rates(t, y, m), (left, right), state, rtol=1e-11, atol=1e-13)
        state = found.y[:, -1]
    return state


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_bodies_follow_a_force_that_fades_in_and_a_burst_of_motion(model, engine, tmp_path):
    result = model.run(engine=engine, out=tmp_path / engine)
    x, v = _integrated(
        lambda t, y, _: [y[1], 3 * np.sin(4 * np.pi * t) * min(t / 2, 1) - 0.5 * y[1]], [0, 0], [0, 2, 3]
    )
    assert result["body.x"][-1] == pytest.approx(x, abs=1e-8)
    assert result["body.v"][-1] == pytest.approx(v, abs=1e-8)

    def shaken(t, y, middle):
        speed = 0.4 * np.sin(6 * np.pi * t) if 0.25 < middle < 1.35 else 0.0
        return [y[1], 200 * (y[2] - y[0]), speed]

    x, v, driven = _integrated(shaken, [0, 0, 0], [0, 0.25, 1.35, 3])
    assert result["load.x"][-1] == pytest.approx(x, abs=1e-7)
    assert result["load.v"][-1] == pytest.approx(v, abs=1e-7)
    assert result["shaker.x"][-1] == pytest.approx(driven, abs=1e-12)
    assert abs(driven) > 0.02, "it moved"


def test_the_energy_of_a_burst_balances(model, tmp_path):
    """What the sources give is what bodies and the spring hold and the damper took."""
    table = model.run(engine="rodas", out=tmp_path / "run").energy.to_pandas()
    energy = dict(table.itertuples(index=False))
    assert energy["supplied"] > 0.1
    assert abs(energy["supplied"] - energy["dissipated"] - energy["stored"]) < 1e-7 * energy["supplied"]
