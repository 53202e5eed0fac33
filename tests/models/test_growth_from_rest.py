"""A contact lets go where nothing pulls yet: friction falls with speed, and the load has just reached stiction."""

from __future__ import annotations

import numpy as np
import pytest

import fairlead

SCENE = """
schema: 1
name: from_rest
components:
  wall: {type: Ground}
  spring: {type: Spring, stiffness: 100 N/m}
  block: {type: Mass, mass: 1 kg, position: 99.9 mm, velocity: 0.2 m/s}
  belt: {type: MotionSource, velocity: 0.2 m/s}
  pad: {type: Contact, normal_force: 10 N, curve: {curve: tustin, stiction: 1.0, coulomb: 0.6, velocity: 1e-5 m/s}}
connections: [[wall.flange, spring.a], [spring.b, block.flange, pad.b], [belt.flange, pad.a]]
friction: {method: hold}
run: {stop: 0.52 ms, engine: rodas}
record: {every: 1 us}
"""
LETS_GO, RATE, GROWTH = 0.5e-3, 100 * 0.2 / 1.0, 10 * (1.0 - 0.6) / 1.0 / 1e-5  # s, m/s^3, 1/s


@pytest.mark.parametrize("accuracy", ["1e-3", "1e-6"])
def test_a_slip_that_nothing_pulls_grows_as_the_closed_form_says(tmp_path, accuracy) -> None:
    """v' = w v - r t from v = 0: v = -(r/w^2)(e^(w t) - 1 - w t), all of it far below the error weights of the run."""
    path = tmp_path / "from_rest.yaml"
    path.write_text(SCENE, encoding="utf-8")
    result = fairlead.load(path, set={"run.accuracy": accuracy}).run(out=tmp_path / "run")
    assert [event.zone_to for event in result.events] == ["backward"]
    late = result.t - LETS_GO
    exact = -RATE / GROWTH**2 * (np.expm1(GROWTH * late) - GROWTH * late)
    seen = (late > 2e-6) & (exact > -1e-7)  # up to a hundredth of the curve's speed, as long as the curve is straight
    assert seen.sum() > 10
    np.testing.assert_allclose(result["pad.slip"][seen], exact[seen], rtol=1e-2)
