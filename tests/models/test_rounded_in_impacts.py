"""Contacts that round friction off pass no impulse on: a run says so where one is pressed by what takes impulses."""

import pytest

from fairlead.errors import RunWarning

SIDEWAYS = """
    components:
      into: {type: Mass, mass: 1 kg, position: -1 m, velocity: 5 m/s}
      along: {type: Mass, mass: 2 kg, position: 0 m, velocity: 8 m/s}
      wall: {type: Ground}
      stop: {type: RigidStop}
      rub: {type: Contact, curve: 0.3}
      more: {type: Contact, curve: 0.3, normal_force: 1 N}
    connections:
      - [into.flange, stop.a]
      - [wall.flange, stop.b, rub.a, more.a]
      - [along.flange, rub.b, more.b]
      - [stop.force, rub.normal]
    run: {stop: 0.3 s, accuracy: 1e-6}
"""
SAID = "pressed by a force that is an impulse in an impact"


@pytest.mark.parametrize("method", ["binding", "tanh", "lugre", "reset_integrator"])
def test_a_run_names_the_contact_that_a_blow_presses(simulate, method) -> None:
    """The other contact of the same body has a normal force of its own, and is not named."""
    with pytest.warns(RunWarning, match=f"^rub is {SAID}"):
        result = simulate(SIDEWAYS, **{"friction.method": method})
    assert sum(SAID in said for said in result.remarks) == 1
    assert "(stop)" in next(said for said in result.remarks if SAID in said)


@pytest.mark.parametrize("method", ["hold", "karnopp"])
def test_what_holds_exactly_rubs_in_the_blow(simulate, method) -> None:
    """P_n = 5 N*s: mu P_n/m = 0.75 m/s less at once, and 0.15 m/s^2 all the time."""
    result = simulate(SIDEWAYS, **{"friction.method": method})
    assert not any(SAID in said for said in result.remarks)
    assert result["along.v"][-1] == pytest.approx(8 - 0.3 * 5 / 2 - 0.15 * 0.3, abs=1e-5)


def test_a_gear_that_rubs_follows_what_its_teeth_carry(simulate) -> None:
    text = """
    components:
      rotor: {type: Inertia, moment: 0.01 kg*m^2, speed: 0}
      gear: {type: Gearbox, ratio: 0.5, efficiency: 0.8}
      drum: {type: Rack, radius: 0.1 m}
      load: {type: Mass, mass: 1 kg, position: 0}
      ball: {type: Mass, mass: 5 kg, position: -0.2 m, velocity: 2 m/s}
      stop: {type: RigidStop}
    connections:
      - [rotor.shaft, gear.a]
      - [gear.b, drum.pinion]
      - [drum.rack, load.flange, stop.b]
      - [stop.a, ball.flange]
    friction: {method: binding}
    run: {stop: 0.11 s, accuracy: 1e-6}
    """
    with pytest.warns(RunWarning, match=f"^gear.rubbing.contact is {SAID}"):
        simulate(text)
    assert not any(SAID in said for said in simulate(text, **{"run.stop": "0.09 s"}).remarks)  # nothing has met yet


def test_a_gear_whose_friction_may_close_a_circle_rubs_too(simulate) -> None:
    """The load meets the ground, on which the friction of the gear stands as well: all stops, whoever takes it."""
    text = """
    components:
      rotor: {type: Inertia, moment: 1 kg*m^2, speed: 10 rad/s}
      gear: {type: Gearbox, ratio: 0.5, efficiency: 0.8}
      drum: {type: Rack, radius: 0.1 m}
      load: {type: Mass, mass: 10 kg, position: 0}
      ground: {type: Ground}
      stop: {type: RigidStop, length: -0.05 m}
    connections:
      - [rotor.shaft, gear.a]
      - [gear.b, drum.pinion]
      - [drum.rack, load.flange, stop.a]
      - [stop.b, ground.flange]
    run: {stop: 0.2 s, accuracy: 1e-6}
    """
    result = simulate(text)
    assert not result.remarks
    assert result["rotor.speed"][-1] == pytest.approx(0.0, abs=1e-9)
    assert result.run["energy"]["dissipated"] == pytest.approx(51.25, rel=1e-6)
