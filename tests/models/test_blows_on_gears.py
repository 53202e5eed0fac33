"""Blows that pass a gear with losses: the loss follows an impulse as it follows a torque.

With what b drives a, the share 1/(2 - efficiency) of its torque arrives. Speeds follow from the balance of impulses.
"""

import pytest

GEARBOX = "{type: Gearbox, ratio: 0.5, efficiency: 0.8}"
LOSSY = "{type: LossyGear, ratio: 0.5, efficiency: 0.8}"
BOTH_WAYS = "{type: LossyGear, ratio: 0.5, efficiency: 0.8, efficiency_back: 0.6}"


def scene(gear, unit=1.0):
    """A ball of 5 kg at 2 m/s meets a load of 1 kg on a rack of 0.1 m, behind a gear with a rotor of 0.01 kg*m^2."""
    return f"""
    components:
      rotor: {{type: Inertia, moment: {0.01 * unit} kg*m^2, speed: 0 rad/s}}
      gear: {gear}
      drum: {{type: Rack, radius: 0.1 m}}
      load: {{type: Mass, mass: {unit} kg, position: 0}}
      ball: {{type: Mass, mass: {5 * unit} kg, position: -0.2 m, velocity: 2 m/s}}
      stop: {{type: RigidStop}}
    connections:
      - [rotor.shaft, gear.a]
      - [gear.b, drum.pinion]
      - [drum.rack, load.flange, stop.b]
      - [stop.a, ball.flange]
    run: {{stop: 0.11 s, accuracy: 1e-6}}
    """


@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("method", ["hold", "karnopp"])
@pytest.mark.parametrize("engine", ["rodas", "ida"])
@pytest.mark.parametrize(
    ("gear", "share"), [(GEARBOX, 1 / 1.2), (LOSSY, 0.75), (BOTH_WAYS, 0.6)], ids=["gearbox", "lossy", "both ways"]
)
def test_a_ball_drives_a_rotor_back_through_its_gear(simulate, gear, share, engine, method, unit) -> None:
    """The rotor is 4 kg at the load without a loss, 4/share with it: 5 * 2 = (5 + 1 + 4/share) v."""
    result = simulate(scene(gear, unit=unit), **{"run.engine": engine, "friction.method": method})
    v = 10 / (6 + 4 / share)
    assert result["load.v"][-1] == pytest.approx(v, rel=1e-5)
    assert result["rotor.speed"][-1] == pytest.approx(20 * v, rel=1e-5)
    lost = (0.5 * 5 * 2**2 - 0.5 * 10 * v**2) * unit
    assert result.run["energy"]["dissipated"] == pytest.approx(lost, rel=1e-5)


def test_a_gear_that_locks_itself_stands_against_a_blow(simulate) -> None:
    """Of an efficiency of half or less nothing comes through: the load stops the ball, and the rotor never turns."""
    result = simulate(scene("{type: LossyGear, ratio: 0.5, efficiency: 0.45}"))
    assert abs(result["rotor.speed"]).max() < 1e-9
    assert result["ball.v"][-1] == pytest.approx(0.0, abs=1e-9)


def test_a_motor_that_runs_on_pays_less_to_a_blow_from_ahead(simulate) -> None:
    """The load meets a wall by way of a lighter body: a drives b, and the share 0.8 of the rotor's impulse arrives."""
    text = """
    components:
      rotor: {type: Inertia, moment: 0.01 kg*m^2, speed: 40 rad/s}
      gear: {type: Gearbox, ratio: 0.5, efficiency: 0.8}
      drum: {type: Rack, radius: 0.1 m}
      load: {type: Mass, mass: 1 kg, position: 0}
      block: {type: Mass, mass: 5 kg, position: 0.2 m, velocity: 0}
      stop: {type: RigidStop}
    connections:
      - [rotor.shaft, gear.a]
      - [gear.b, drum.pinion]
      - [drum.rack, load.flange, stop.a]
      - [stop.b, block.flange]
    run: {stop: 0.15 s, accuracy: 1e-6}
    """
    v = 2 * (1 + 4 * 0.8) / (6 + 4 * 0.8)
    assert simulate(text)["block.v"][-1] == pytest.approx(v, rel=1e-5)
