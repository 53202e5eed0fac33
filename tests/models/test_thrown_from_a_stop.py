"""Bodies that a stop without rebound has stopped, and that bent bristles throw back from it and on to it again."""

import math

import pytest

TEXT = """
    components:
      block: {type: Mass, mass: 2 kg, position: 0, velocity: 3 m/s}
      ground: {type: Ground}
      stop: {type: RigidStop, length: -0.3 m}
      pad: {type: Contact, normal_force: 12 N, curve: 0.5}
    connections:
      - [block.flange, stop.a, pad.b]
      - [ground.flange, stop.b, pad.a]
    run: {stop: 0.2 s, accuracy: 1e-6, max_events: 2000}
    record: {signals: [block.*, pad.friction, stop.force]}
"""


@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize("method", ["lugre", "dahl", "elastoplastic", "reset_integrator", "maxwell_slip"])
def test_a_block_stopped_while_its_bristles_are_bent_leaves_the_stop(simulate, method, engine) -> None:
    """It stays within what bristles give, loses at the stop what it had, and no instant is cut to pieces."""
    result = simulate(TEXT, **{"friction.method": method, "run.engine": engine})
    met = next(event.t for event in result.events if event.component == "stop")
    assert met == pytest.approx((3 - math.sqrt(9 - 2 * 3 * 0.3)) / 3, abs=3e-4)
    assert result.run["lost"]["stop"] == pytest.approx(7.2, rel=1e-2)
    at_the_end = result["block.x"][result.t > met]
    assert at_the_end.max() < 0.3 + 1e-9
    assert at_the_end.min() > 0.3 - 1e-4
    assert sum(event.component == "stop" for event in result.events) < 50
