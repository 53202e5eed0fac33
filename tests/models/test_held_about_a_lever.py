"""A contact that sticks at one end of a lever while a stop touches at the other: as if both were at one body.

With the pivot on the ground  x_b = -ratio x_a.  So a mass, a spring, a force and a stop at a act at b as

    mass/ratio^2,   stiffness/ratio^2,   -force/ratio,   a stop at -ratio times the place
"""

import numpy as np
import pytest

RUN = "run: {{stop: 2 s, accuracy: {accuracy}, engine: {engine}}}\n    record: {{every: 20 ms}}"
LEVER = """
    components:
      ground: {{type: Ground}}
      load: {{type: Mass, mass: 5 kg, position: 0}}
      hand: {{type: Mass, mass: 1 kg}}
      lever: {{type: Lever, ratio: {ratio}}}
      push: {{type: ForceSource, force: {{sine: {{amplitude: 50 N, frequency: 1 Hz}}}}}}
      pad: {{type: Contact, normal_force: 20 N, curve: 0.5}}
      near: {{type: Spring, stiffness: 300 N/m}}
      far: {{type: Spring, stiffness: 300 N/m}}
      stop: {{type: RigidStop, length: -0.02 m}}
    connections:
      - [hand.flange, lever.a, push.flange, near.b, stop.b]
      - [load.flange, lever.b, far.b, pad.b]
      - [ground.flange, near.a, far.a, pad.a, stop.a, lever.pivot]
    """ + RUN  # fmt: skip
ONE = """
    components:
      ground: {{type: Ground}}
      load: {{type: Mass, mass: {mass} kg, position: 0}}
      push: {{type: ForceSource, force: {{sine: {{amplitude: {push} N, frequency: 1 Hz}}}}}}
      pad: {{type: Contact, normal_force: 20 N, curve: 0.5}}
      spring: {{type: Spring, stiffness: {stiffness} N/m}}
      stop: {{type: RigidStop, length: {place} m}}
    connections:
      - [load.flange, push.flange, spring.b, pad.b, {one}]
      - [ground.flange, spring.a, pad.a, {other}]
    """ + RUN  # fmt: skip


@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize("ratio", [-0.5, 0.5, -2.0, 1.0])
def test_a_contact_and_a_stop_at_the_two_ends_of_a_lever_hold_as_at_one_body(simulate, ratio, engine):
    """They close a circle with the lever, whose coefficients are made of its ratio."""
    held = simulate(LEVER.format(ratio=ratio, accuracy="1e-5", engine=engine))
    place = 0.02 * ratio  # of the load where the hand is at its stop
    above = ratio > 0  # then the load may not go beyond it, else not below
    one = simulate(ONE.format(
        mass=5 + 1 / ratio**2, stiffness=300 + 300 / ratio**2, push=-50 / ratio, place=-place if above else place,
        one="stop.a" if above else "stop.b", other="stop.b" if above else "stop.a", accuracy="1e-6", engine="rodas",
    ))  # fmt: skip
    assert {event.zone_to for event in one.events if event.component == "stop"} == {"touching", "free"}
    grid = np.arange(0, 2.001, 0.02)
    np.testing.assert_allclose([held.at("load.x", t) for t in grid], [one.at("load.x", t) for t in grid], atol=2e-5)
    assert held.run["energy"]["closure"] < 1e-3


def test_another_ratio_shares_otherwise(scene):
    """A model with another ratio is made anew, and agrees with one that had it from the beginning."""
    first = scene(LEVER.format(ratio=-0.5, accuracy="1e-4", engine="rodas"))
    changed = first.with_values({"lever.ratio": -2.0})
    assert "lever" in changed.rebuilt
    written = scene(LEVER.format(ratio=-2.0, accuracy="1e-4", engine="rodas")).run(out=None)
    np.testing.assert_array_equal(changed.run(out=None)["load.x"], written["load.x"])
    heavier = first.with_values({"load.mass": 6.0})
    heavier.system  # noqa: B018
    assert not heavier.rebuilt
