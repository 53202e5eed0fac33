"""What rows show of contacts that creep: in the middle of a step too, the friction that their bodies need."""

import numpy as np
import pytest

PAIR = """
    components:
      one: {{type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}}
      two: {{type: Mass, mass: 3 kg, position: 0 m, velocity: 0 m/s}}
      push: {{type: ForceSource, force: {{sine: {{amplitude: {push} N, frequency: 2 Hz}}}}}}
      pad: {{type: Contact, normal_force: 20 N, curve: 0.5}}
    connections: [[two.flange, pad.a, push.flange], [pad.b, one.flange]]
    friction: {{method: {method}, creep: 1e-5 m/s}}
    run: {{stop: 1 s, accuracy: 1e-4, engine: {engine}}}
    """


@pytest.mark.parametrize("engine", ["rodas", "stepping"])
@pytest.mark.parametrize(("method", "push", "off"), [("binding", 18, 2e-4), ("binding", 31, 2e-4), ("tanh", 18, 2e-2)])
@pytest.mark.parametrize("every", [None, "3 ms"])
def test_bodies_that_go_together_need_the_same_acceleration_of_friction_in_every_row(
    simulate, engine, method, push, off, every
):
    """One is pushed with P, so friction gives the other P/4 if they are 1 and 3 kg; their slip is some um/s."""
    record = f"record: {{every: {every}}}" if every else ""
    result = simulate(PAIR.format(engine=engine, method=method, push=push) + record)
    rows = result.t > 0.05  # what it takes from rest to creep
    right = push * np.sin(4 * np.pi * result.t[rows]) / 4
    assert np.abs(result["pad.friction"][rows]) == pytest.approx(np.abs(right), abs=off * push)
