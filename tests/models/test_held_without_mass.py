"""A contact that holds between a body and a node without mass: the node moves with the body, and drags its damper."""

import numpy as np
import pytest

from fairlead.errors import UsageError

SCENE = """
    components:
      floor: {type: Ground}
      body: {type: Mass, mass: 2 kg, velocity: 1 m/s}
      between: {type: Contact, normal_force: 10 N, curve: 0.5, method: hold}
      drag: {type: Damper, damping: 3 N*s/m}
    connections:
      - [floor.flange, drag.a]
      - [drag.b, between.a]
      - [body.flange, between.b]
    run: {stop: 2 s, accuracy: 1e-6, engine: ENGINE}
    record: {every: 10 ms, signals: [body.v, body.x, between.slip, between.friction]}
"""


@pytest.mark.parametrize("engine", ["rodas", "auto"])
def test_what_is_held_without_mass_does_not_slip(simulate, engine):
    """2 kg behind a damper of 3 N s/m, by way of a contact that can carry 5 N."""
    result = simulate(SCENE.replace("ENGINE", engine))
    speed = np.exp(-1.5 * result.t)
    np.testing.assert_allclose(result["body.v"], speed, atol=1e-5)
    np.testing.assert_allclose(result["between.friction"], 3 * speed, atol=1e-4)
    assert np.abs(result["between.slip"]).max() < 1e-12
    assert result.run["engine"] == "rodas"


def test_stepping_says_that_it_does_not(simulate):
    with pytest.raises(UsageError, match=r"between a node with mass and one without \(between\)"):
        simulate(SCENE.replace("ENGINE", "stepping"))
