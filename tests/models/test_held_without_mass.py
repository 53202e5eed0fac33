"""A contact that holds between a body and a node without mass: the node moves with the body, and drags its damper."""

import re

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


TOWED = {
    "force": """
    components:
      wall: {type: Ground}
      tow: {type: MotionSource, velocity: WAVE, origin: 0}
      scale: {type: ForceSensor}
      drag: {type: Damper, damping: 40 N*s/m}
    connections: [[wall.flange, drag.a], [drag.b, scale.a], [scale.b, tow.flange]]
    run: {stop: 1 s, accuracy: 1e-6}
    record: {signals: [drag.tension, scale.tension]}
    """,
    "torque": """
    components:
      case: {type: Housing}
      motor: {type: SpeedSource, speed: WAVE, origin: 0}
      scale: {type: TorqueSensor}
      drag: {type: RotationalDamper, damping: 40 N*m*s/rad}
    connections: [[case.shaft, drag.a], [drag.b, scale.b], [scale.a, motor.shaft]]
    run: {stop: 1 s, accuracy: 1e-6}
    record: {signals: [drag.torque, scale.torque]}
    """,
    "a contact that holds": """
    components:
      wall: {type: Ground}
      tow: {type: MotionSource, velocity: WAVE, origin: 0}
      grip: {type: Contact, normal_force: 1 kN, curve: 0.5, method: hold}
      drag: {type: Damper, damping: 40 N*s/m}
    connections: [[wall.flange, drag.a], [drag.b, grip.b], [grip.a, tow.flange]]
    run: {stop: 1 s, accuracy: 1e-6}
    record: {signals: [drag.tension, grip.friction]}
    """,
}


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("begun", [0.0, 0.4])
@pytest.mark.parametrize("towed", TOWED)
def test_what_a_motion_that_speeds_up_tows_has_its_speed_from_the_start_and_after_a_kink(
    simulate, towed, begun, engine
):
    """A damper of 40 N s/m behind a meter, towed at 3 m/s^2 from `begun` on: 120 N/s, and 0 N at the kink."""
    if engine == "ida":
        pytest.importorskip("sksundae.ida", reason="needs scikit-sundae: pip install 'fairlead[ida]'")
    wave = f"{{ramp: {{to: 3, over: 1 s, start: {begun}}}}}"
    result = simulate(TOWED[towed].replace("WAVE", wave), **{"run.engine": engine})
    right = 120.0 * np.maximum(result.t - begun, 0.0)
    for signal in re.search(r"signals: \[(.*)\]", TOWED[towed])[1].split(", "):
        np.testing.assert_allclose(np.abs(result[signal]), right, atol=2e-3)


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_a_meter_behind_a_motion_that_speeds_up_changes_nothing(simulate, engine):
    """A body drawn by a spring and a damper, with a meter between them and the motion, and without."""
    if engine == "ida":
        pytest.importorskip("sksundae.ida", reason="needs scikit-sundae: pip install 'fairlead[ida]'")
    scene = """
    components:
      tow: {type: MotionSource, velocity: {ramp: {to: 1 m/s, over: 1 s}}, origin: 0}
      scale: {type: ForceSensor}
      rope: {type: SpringDamper, stiffness: 10 kN/m, damping: 200 N*s/m}
      body: {type: Mass, mass: 20 kg, position: 0, velocity: 0}
    connections: [[tow.flange, scale.a], [scale.b, rope.a], [rope.b, body.flange]]
    run: {stop: 0.5 s, accuracy: 1e-6}
    record: {every: 10 ms, signals: [body.x, rope.tension]}
    """
    bare = scene.replace("scale: {type: ForceSensor}", "").replace("scale.a], [scale.b, ", "")
    result, without = simulate(scene, **{"run.engine": engine}), simulate(bare)
    np.testing.assert_allclose(result["body.x"], without["body.x"], atol=1e-6)
    np.testing.assert_allclose(result["rope.tension"], without["rope.tension"], atol=5e-3)
