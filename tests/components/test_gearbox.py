"""Gear, gearbox and drum: ratios, torques, losses, play, and the acceleration of a winch."""

import numpy as np
import pytest

GEARBOX = """
    parameters: {drive: 20 N*m}
    components:
      motor: {type: TorqueSource, torque: "{drive}"}
      rotor: {type: Inertia, moment: 0.05 kg*m^2}
      gearbox: {type: Gearbox, ratio: "{1/10}", efficiency: 0.9}
      load: {type: Inertia, moment: 8 kg*m^2}
      brake: {type: TorqueSource, torque: -100 N*m}
    connections:
      - [motor.shaft, rotor.shaft, gearbox.a]
      - [gearbox.b, load.shaft, brake.shaft]
    friction: {method: hold}
    run: {stop: 2 s, accuracy: 1e-7}
    record: {signals: [load.*, rotor.*, gearbox.*], every: 5 ms}
"""


def rate_of_change(result, name):
    """Rate of a signal that grows evenly from zero."""
    return result[name][-1] / result.t[-1]


def test_a_gear_turns_in_its_ratio_and_gives_torque_in_the_inverse(simulate):
    result = simulate(GEARBOX, **{"effects.gear_friction": "off"})
    np.testing.assert_allclose(result["load.speed"], result["rotor.speed"] / 10, rtol=1e-12)
    exact = (20 * 10 - 100) / (8 + 0.05 * 10**2)
    assert rate_of_change(result, "load.speed") == pytest.approx(exact, rel=1e-9)
    assert result.run["energy"]["closure"] < 1e-9


def test_a_lossy_gearbox_passes_its_share_of_the_torque(simulate):
    """J_b a = eta T_mesh - 100, and T_mesh = 10 (20 - J_a 10 a): both at shaft b."""
    result = simulate(GEARBOX)
    np.testing.assert_allclose(result["load.speed"], result["rotor.speed"] / 10, rtol=1e-9, atol=1e-12)
    exact = (0.9 * 20 * 10 - 100) / (8 + 0.9 * 0.05 * 10**2)
    assert rate_of_change(result, "load.speed") == pytest.approx(exact, rel=1e-5)  # 1e-3 N m of the load is rounded
    mesh = 10 * (20 - 0.05 * 10 * exact)
    assert result["gearbox.torque"][-1] == pytest.approx(mesh, rel=1e-6)
    assert result["gearbox.loss"][-1] == pytest.approx(0.1 * mesh, rel=1e-5)
    assert result.run["energy"]["closure"] < 1e-6


def test_driven_backwards_the_share_that_arrives_is_one_over_two_less_the_efficiency(simulate):
    """The load of 100 N m drives the motor, which brakes with 5: T_mesh (1 + 0.1) = 100 - J_b a at shaft b."""
    result = simulate(GEARBOX, drive="5 N*m")
    slowing = rate_of_change(result, "load.speed")
    mesh = 10 * (5 - 0.05 * 10 * slowing)
    assert mesh * 1.1 == pytest.approx(100 + 8 * slowing, rel=1e-5)
    assert slowing < 0
    assert result.run["energy"]["closure"] < 1e-6


def test_between_both_a_lossy_gearbox_sticks(simulate):
    """100 N m at b are held by any torque at a between 100/10/1.1 and 100/10/0.9."""
    for drive, moves in ((9.2, False), (10.9, False), (8.9, True), (11.3, True)):
        result = simulate(GEARBOX, drive=f"{drive} N*m")
        assert (abs(result["load.speed"][-1]) > 1e-3) == moves, drive


def test_without_play_the_teeth_are_the_limit_of_stiff_ones(simulate):
    """Off: a rigid ratio. On, without a gap: stiff teeth; they must agree as the stiffness grows."""
    off = simulate(GEARBOX, **{"effects.backlash": "off"})
    differences = []
    for stiffness in (1e5, 1e9):
        on = simulate(GEARBOX, **{"effects.backlash": "on", "gearbox.play": "0", "gearbox.stiffness": stiffness,
                                  "gearbox.damping": 100})  # fmt: skip
        times = np.linspace(0.2, 2, 10)
        differences.append(np.abs(on.at("load.speed", times) - off.at("load.speed", times)).max())
    assert differences[1] < 1e-4 * off["load.speed"][-1]
    assert differences[1] < 0.05 * differences[0]


def test_without_friction_the_efficiency_is_one(simulate):
    off = simulate(GEARBOX, **{"effects.gear_friction": "off"})
    on = simulate(GEARBOX, **{"gearbox.efficiency": "0.9999999"})
    assert on["load.speed"][-1] == pytest.approx(off["load.speed"][-1], rel=1e-5)


def test_what_is_off_in_a_gearbox_is_absent(scene):
    def parts(**effects):
        model = scene(GEARBOX, **{f"effects.{name}": word for name, word in effects.items()})
        names = {path.split(".")[1] for path in model.assembly.instances if path.startswith("gearbox.")}
        return names, [name for name in model.system.unknown_names if name.startswith("gearbox")]

    assert parts(gear_friction="off") == ({"gear"}, [])
    found, unknowns = parts()
    assert found == {"gear", "teeth", "loss", "rubbing"}
    assert unknowns == ["gearbox.teeth.carried", "gearbox.rubbing.contact.force"]
    assert parts(gear_friction="off", backlash="on") == ({"gear", "teeth"}, [])


def test_play_lets_the_load_stand_until_the_gap_is_crossed(simulate):
    """From the middle of the gap the rotor is alone for half the play: t = sqrt(play J ratio/T), and then drives."""
    text = GEARBOX.replace("torque: -100 N*m", "torque: 0 N*m")
    result = simulate(text, **{"effects.backlash": "on", "effects.gear_friction": "off", "gearbox.play": "0.02"})
    (first, *_) = [event.t for event in result.events if event.zone_to == "drive"]
    # shaft b of the gear turns a tenth of the rotor: 0.01 rad at b are 0.1 rad at a
    assert first == pytest.approx(np.sqrt(2 * 0.1 * 0.05 / 20), rel=1e-6)
    assert result.at("load.speed", first - 6e-3) == 0
    assert result.run["energy"]["closure"] < 1e-5


def test_a_winch_accelerates_with_the_torque_and_the_pull(simulate):
    """J dw/dt = torque + R T, with the sign that pay-out has: the pull of the line turns the drum forward."""
    text = """
        components:
          drum: {type: Inertia, moment: 1150 kg*m^2}
          rope: {type: Rack, radius: 0.65 m}
          brake: {type: TorqueSource, torque: -300 N*m}
          pull: {type: ForceSource, force: 1386 N}
        connections: [[drum.shaft, rope.pinion, brake.shaft], [rope.rack, pull.flange]]
        run: {stop: 4 s}
    """
    result = simulate(text)
    assert result["drum.speed"][-1] == pytest.approx(4 * (-300 + 0.65 * 1386) / 1150, rel=1e-9)
