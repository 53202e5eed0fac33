"""The rotational parts of models/single_parts against closed forms of their scenes, and of cousins of these."""

import pathlib
import re

import numpy as np
import pytest
from scipy.optimize import brentq

import fairlead
from fairlead.errors import ModelError

SCENES = pathlib.Path(__file__).parents[2] / "models" / "single_parts"


def run(name, **settings):
    """A scene, with other values by their dotted names."""
    result = fairlead.load(SCENES / f"{name}.yaml", set={"run.accuracy": "1e-6", **settings}).run(out=None)
    assert result.ok
    return result


def switched(result, where, to):
    """Time at which a zone was first entered [s]."""
    table = result.switches().to_pandas()
    return float(table["first"][(table["component"] == where) & (table["zone_to"] == to)].min())


def test_a_freewheel_takes_a_wheel_along_and_lets_it_run_on():
    result = run("one_way_clutch")
    together = 6 / 0.05 * (1 - np.exp(-0.05 * 2 / 0.3))
    assert result.at("wheel.speed", 2.0) == pytest.approx(together, rel=1e-5)
    alone = 0.2 * 6 / 0.3 * np.exp(-0.05 / 0.3) + 0.05 * 6 / 0.05 * (1 - np.exp(-0.05 / 0.3))
    assert result.at("freewheel.torque", 1.0) == pytest.approx(alone, rel=1e-4)
    parted = result.at("wheel.speed", 2.1)
    assert result.at("wheel.speed", 4.0) == pytest.approx(parted * np.exp(-0.05 * 1.9 / 0.2), rel=1e-4)
    assert result.at("rotor.speed", 4.0) - result.at("rotor.speed", 3.0) == pytest.approx(-30, rel=1e-4)


def test_a_freewheel_that_is_overtaken_at_the_start_keeps_the_momentum():
    result = run("one_way_clutch", **{"rotor.speed": "30 rad/s", "wheel.speed": "3 rad/s"})
    assert result["wheel.speed"][0] == result["rotor.speed"][0] == pytest.approx((0.1 * 30 + 0.2 * 3) / 0.3)


def test_dogs_go_in_at_nearly_one_speed_and_keep_the_momentum():
    result = run("dog_clutch")
    assert switched(result, "dog", "closed") == pytest.approx((20 - 0.5) / 20, abs=1e-6)
    both = (0.1 * 19.5 + 0.3 * 20) / 0.4
    assert result.at("wheel.speed", 2.0) == pytest.approx(both + 2 / 0.4 * (2 - 0.975), rel=1e-6)
    later = run("dog_clutch", **{"rotor.speed": "60 rad/s", "wheel.speed": "20 rad/s", "motor.torque": "-2 N*m"})
    assert switched(later, "dog", "closed") == pytest.approx((40 - 0.5) / 20, abs=1e-6)  # the other way round


def test_a_planetary_gear_turns_its_ring_where_the_band_gives_way():
    """Held, 1/(0.01 + 0.5/4^2) of the motor's torque accelerates the sun; the ring carries three times the sun's."""
    result = run("planetary")
    share = 0.5 / 16 / (0.01 + 0.5 / 16)
    slips = 0.1 * 0.3 * 500 / (3 * share * 10 / 2)
    assert switched(result, "band.contact", "backward") == pytest.approx(slips, rel=1e-6)
    assert result.at("carrier.speed", 1.0) == pytest.approx(result.at("sun.speed", 1.0) / 4, rel=1e-6)
    assert result.at("sun.speed", 1.0) == pytest.approx(10 / 2 / 2 / (0.01 + 0.5 / 16), rel=1e-5)


@pytest.mark.slow
def test_a_differential_gives_both_sides_one_torque():
    result = run("differential")
    torque = (20 + 0.1 * 3) / 2.1  # 20 = 0.1 (T - 3) + 2 T
    assert result.at("axle.torque", 1.0) == pytest.approx(torque, rel=1e-6)
    assert result.at("left.speed", 2.0) == pytest.approx(2 * torque, rel=1e-6)
    assert result.at("right.speed", 2.0) == pytest.approx(2 * (torque - 6), rel=1e-6)


@pytest.mark.slow
def test_a_gear_with_a_support_hands_it_what_the_shafts_leave_over():
    result = run("supported_gear", **{"run.stop": "4 s"})
    turning = 1 / (0.01 + 2 * 0.1**2)  # of the rotor, once the arm is at rest
    assert abs(result["arm.torque"][-1]) == pytest.approx(2 * 0.1 * turning * (1 - 0.1), rel=1e-4)
    fixed = run("supported_gear", **{"arm.stiffness": "1e9 N*m/rad"})
    assert fixed.at("rotor.speed", 2.0) == pytest.approx(2 * turning, rel=1e-4)


@pytest.mark.parametrize(("half_angle", "mu"), [(0.26, 0.1), (0.0, 0.2)])
def test_a_screw_raises_at_the_torque_of_the_textbook_and_locks_itself(half_angle, mu):
    result = run("lead_screw", **{"thread.half_angle": f"{half_angle} rad", "thread.curve": str(mu),
                                  "weight.force": "-490 N"})  # fmt: skip
    slope, rubs = 0.005 / (2 * np.pi * 0.01), mu / np.cos(half_angle)
    raises = 490 * 0.01 * (slope + rubs) / (1 - rubs * slope)
    assert switched(result, "thread.contact", "forward") == pytest.approx(raises, rel=1e-5)
    assert result["load.x"][-1] == pytest.approx(result.at("load.x", 3.3), abs=1e-9) != 0


@pytest.mark.slow
def test_a_steep_screw_runs_down_under_its_load():
    """m (g - a) drives the screw's inertia with the torque of letting down."""
    result = run("lead_screw", **{"thread.lead": "20 mm", "motor.torque": "0 N*m", "run.stop": "0.5 s"})
    slope, rubs, turns = 0.02 / (2 * np.pi * 0.01), 0.1 / np.cos(0.26), 2 * np.pi / 0.02
    lever = 0.01 * (slope - rubs) / (1 + rubs * slope)
    falls = 981 * lever / (1e-3 * turns + 100 * lever)
    assert result["load.x"][-1] == pytest.approx(-falls * 0.5**2 / 2, rel=1e-5)


@pytest.mark.slow
def test_a_worm_lifts_as_a_screw_does_and_keeps_the_load():
    result = run("worm")
    slope, rubs = 0.01257 / (2 * np.pi * 0.02), 0.12 / np.cos(np.pi / 9)
    lever = 0.02 * (slope + rubs) / (1 - rubs * slope)  # torque of the worm per force at the rim
    mass = 200 + 0.1 / 0.1**2
    rises = (12 - 1962 * lever) / (0.02 / (0.02 * slope) + mass * lever)
    assert result.at("load.v", 0.9) - result.at("load.v", 0.4) == pytest.approx(rises * 0.5, rel=1e-5)
    assert result["load.x"][-1] == pytest.approx(result.at("load.x", 2.5), abs=1e-9)


@pytest.mark.parametrize(
    ("wrap_a", "wrap_b", "mass"), [(np.pi, np.pi, 0.0), (2.0, 4.0, 0.0), (4.0, 2.0, 0.0), (3.0, 3.5, 2.0)]
)
def test_a_belt_slips_at_the_torque_of_the_textbook(wrap_a, wrap_b, mass):
    """2 (T - m v^2) r tanh(mu wrap/2) on the driven pulley; the belt goes on with the pulley that holds it."""
    result = run("belt_drive", **{"belt.wrap_a": f"{wrap_a} rad", "belt.wrap_b": f"{wrap_b} rad",
                                  "belt.mass": f"{mass} kg/m"})  # fmt: skip
    wrap, spare = min(wrap_a, wrap_b), 200 - mass * 2.5**2
    torque = 2 * spare * 0.1 * np.tanh(0.3 * wrap / 2)
    slips = float(result.switches().to_pandas()["first"].min())
    assert slips * 10 == pytest.approx(torque, rel=2e-4)
    pulled = mass * (2.5 - result.at("belt.slip", 1.9) * (wrap_a < wrap_b)) ** 2
    ratio = (result.at("belt.upper", 1.9) - pulled) / (result.at("belt.lower", 1.9) - pulled)
    assert ratio == pytest.approx(np.exp(0.3 * wrap), rel=1e-4)


@pytest.mark.slow
def test_a_stop_is_met_in_time_and_carries_the_torque_at_rest():
    result = run("rotational_stop", **{"run.stop": "8 s"})
    assert switched(result, "stop", "upper") == pytest.approx(np.sqrt(2 * np.pi / 3 / (0.5 / 0.02)), rel=1e-5)
    assert result["flap.angle"][-1] == pytest.approx(np.pi / 3 + 0.5 / 500, rel=1e-4)
    back = run("rotational_stop", **{"motor.torque": "-0.5 N*m", "run.stop": "20 s"})
    assert back["flap.angle"][-1] == pytest.approx(-np.pi / 18 - 0.5 / 500, rel=1e-3)


@pytest.mark.slow
def test_play_is_crossed_before_the_load_moves():
    meets = brentq(lambda t: 100 * (t / (2 * np.pi) - np.sin(2 * np.pi * t) / (4 * np.pi**2)) - np.pi / 72, 1e-3, 0.5)
    assert switched(run("backlash"), "coupling", "drive") == pytest.approx(meets, rel=1e-5)


@pytest.mark.slow
def test_a_fan_runs_up_and_coasts_down():
    result = run("shaft_load")
    assert result.at("read.speed", 5.0) == pytest.approx(np.sqrt(4 / 1e-3) * np.tanh(5 * np.sqrt(4e-3) / 0.1), rel=1e-5)
    coasting = result.at("read.speed", 6.0)
    assert result.at("read.speed", 10.0) == pytest.approx(1 / (1 / coasting + 1e-3 * 4 / 0.1), rel=1e-5)


@pytest.mark.slow
def test_sensors_of_power_tell_torque_times_speed_of_what_settles():
    result = run("power_sensors", **{"run.stop": "20 s"})
    assert result["meter.power"][-1] == pytest.approx(0.3 * 10 * 10, rel=1e-4)
    assert result["twist.angle"][-1] == pytest.approx(-3 / 100, rel=1e-4)
    assert result["scale.power"][-1] == pytest.approx(-196.2, rel=1e-4)  # it flows from the hook to the rope
    assert result["stretch.x"][-1] == pytest.approx(196.2 / 1e4, rel=1e-4)


HOIST = 0.1 / 30  # m; way of the load for a turn of the motor by one radian
WEIGHT = 784.8


def with_motor(simulate, name, table, **settings):
    """A scene of models/single_parts whose motor has another table of torques."""
    text = (SCENES / f"{name}.yaml").read_text(encoding="utf-8").split(f"name: {name}\n")[1]
    text = re.sub(r"\{table: .*\]\]\}", f"{{table: {table}}}", text, count=1)
    return simulate(text, **{"run.accuracy": "1e-6", **settings})


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
def test_a_belt_of_any_size_slips_at_the_torque_of_the_textbook(size):
    """All forces `size` times as large, and what they move: the speeds are the same."""
    forces = {"belt.tension": f"{200 * size} N", "belt.stiffness": f"{1e6 * size} N/m",
              "belt.damping": f"{100 * size} N*s/m", "rotor.moment": f"{0.1 * size} kg*m^2",
              "load.torque.ramp.to": f"{-20 * size} N*m"}  # fmt: skip
    result = run("belt_drive", **forces)
    slips = float(result.switches().to_pandas()["first"].min())
    assert slips * 10 == pytest.approx(2 * 200 * 0.1 * np.tanh(0.3 * np.pi / 2), rel=2e-4)


@pytest.mark.parametrize("efficiency", [0.45, pytest.param(0.3, marks=pytest.mark.slow)])
def test_a_gear_of_less_than_half_keeps_the_load_and_lifts_at_its_share(simulate, efficiency):
    """It lifts at W k/eta + bearing, stops after the motor, and lets down at (1/eta - 2) W k + bearing."""
    table = "[[0 s, 0], [1 s, 20 N*m], [1.01 s, 0], [2 s, 0], [4 s, -20 N*m]]"
    result = with_motor(simulate, "lossy_gear", table, **{"gear.efficiency": efficiency, "run.stop": "3.5 s"})
    lifts, lowers = WEIGHT * HOIST / efficiency + 0.1, WEIGHT * HOIST * (1 / efficiency - 2) + 0.1
    assert switched(result, "gear.rubbing.contact", "forward") == pytest.approx(lifts / 20, rel=1e-5)
    assert switched(result, "gear.rubbing.contact", "backward") == pytest.approx(2 + lowers / 10, rel=1e-5)
    assert result.run["energy"]["closure"] < 1e-6


@pytest.mark.parametrize("back", [0.6, 0.01, 0.0, pytest.param(-0.5, marks=pytest.mark.slow)])
def test_a_load_drives_a_gear_back_with_its_share_and_not_below_none(back):
    """(J + eta m k^2) w' = eta W k, where eta is not negative; and half of both losses of the corner's 1e-6 N m."""
    result = run("lossy_gear", **{"gear.efficiency": "0.8", "gear.efficiency_back": str(back), "gear.bearing": "0 N*m",
                                  "motor.torque": "0 N*m", "run.stop": "1 s"})  # fmt: skip
    drives = back * WEIGHT * HOIST + ((1 / 0.8 - 1) + (1 - back)) / 2 * 1e-6
    falls = drives / (0.05 + back * 80 * HOIST**2) * HOIST if back >= 0 else 0
    assert result["load.x"][-1] == pytest.approx(-falls / 2, rel=1e-5, abs=1e-12)


BY_SPEED = """
    components:
      motor: {type: TorqueSource, torque: 2 N*m}
      rotor: {type: Inertia, moment: 0.01 kg*m^2, speed: 0}
      gear: {type: LossyGear, ratio: -0.5, efficiency_points: [[0, 1], [100 rad/s, 0.5]],
             bearing_points: [[0, 0], [100 rad/s, 1 N*m]]}
      load: {type: TorqueSource, torque: 2 N*m}
      drum: {type: Inertia, moment: 0.01 kg*m^2}
    connections: [[motor.shaft, rotor.shaft, gear.a], [gear.b, drum.shaft, load.shaft]]
    run: {stop: 8 s, accuracy: 1e-6}
"""


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_a_gear_whose_losses_depend_on_speed_runs_at_their_balance(engine, simulate):
    """With eta = 1 - w/200 and a bearing of w/100 a motor of 2 against a load of 1 N m settles at a root of both."""
    if engine == "ida":
        pytest.importorskip("sksundae")
    result = simulate(BY_SPEED, **{"run.engine": engine})
    steady = brentq(lambda w: (2 - w / 100) * (1 - w / 200) - 1, 0, 100)
    assert result["rotor.speed"][-1] == pytest.approx(steady, rel=1e-3)  # `slow` is 1e-3 rad/s
    assert result["drum.speed"][-1] == pytest.approx(-steady / 2, rel=1e-3)


@pytest.mark.slow
def test_a_square_thread_is_a_lossy_gear_of_its_efficiencies(simulate):
    """Two formulations: the flanks of a screw, and the shares of a gear that has them both ways."""
    slope, mu = 0.02 / (2 * np.pi * 0.01), 0.1
    up, down = slope * (1 - mu * slope) / (slope + mu), (slope - mu) / (slope * (1 + mu * slope))
    table = "[[0 s, 0], [0.5 s, 10 N*m], [1 s, 0]]"
    common = {"rotor.moment": "2e-3 kg*m^2", "run.stop": "1.5 s"}
    screw = with_motor(simulate, "lead_screw", table, **common, **{
        "thread.lead": "20 mm", "thread.half_angle": 0, "load.mass": "80 kg", "weight.force": "-784.8 N"})  # fmt: skip
    gear = with_motor(simulate, "lossy_gear", table, **common, **{
        "drum.radius": f"{0.6 / (2 * np.pi)} m", "gear.bearing": "0 N*m", "gear.efficiency": up,
        "gear.efficiency_back": down})  # fmt: skip
    times = np.linspace(0, 1.5, 31)
    assert np.abs(screw["load.x"]).max() > 0.1
    assert np.allclose(screw.at("load.x", times), gear.at("load.x", times), atol=1e-5)


@pytest.mark.parametrize(
    ("was", "now", "says"),
    [
        ("[[0, 1]", "[[0, 1.2]", "a share is 1.2"),
        ("ratio", "efficiency: 0.9, ratio", "give either efficiency or efficiency_points"),
        ("1 N*m]", "-0.2 N*m]", "a torque is -0.2 N*m"),
    ],
)
def test_losses_that_cannot_be_are_refused(scene, was, now, says):
    with pytest.raises(ModelError, match=re.escape(says)):
        scene(BY_SPEED.replace(was, now, 1)).check()


def test_a_chain_is_taut_after_its_slack_and_carries_the_torque_over_its_radius():
    result = run("chain_drive", **{"chain.damping": "20 s/m", "run.stop": "1 s"})
    small, large = 19 * 0.0127 / (2 * np.pi), 57 * 0.0127 / (2 * np.pi)
    crossed = np.sqrt(2 * 0.0025 / small / (10 / 0.05))
    assert switched(result, "chain.strands", "drive") == pytest.approx(crossed, rel=1e-5)
    turns = 10 / (0.05 + 0.9 / 9)  # of the rotor, together with the wheel
    assert result.at("rotor.speed", 1.0) - result.at("rotor.speed", 0.9) == pytest.approx(0.1 * turns, rel=1e-3)
    ran = result.at("rotor.speed", 0.95) * small
    assert result.at("chain.upper", 0.95) == pytest.approx(0.9 * turns / 3 / large + 0.7 * ran**2, rel=2e-3)
    assert result.at("chain.lower", 0.95) == pytest.approx(0.7 * ran**2, rel=1e-6)


@pytest.mark.slow
def test_a_chain_is_a_gear_with_backlash(simulate):
    chain = run("chain_drive")
    large = 57 * 0.0127 / (2 * np.pi)
    table = "[[0 s, 10 N*m], [1 s, 10 N*m], [1.001 s, -10 N*m], [2 s, -10 N*m]]"
    teeth = simulate(f"""
        components:
          motor: {{type: TorqueSource, torque: {{table: {table}}}}}
          rotor: {{type: Inertia, moment: 0.05 kg*m^2, speed: 0}}
          gear: {{type: Gear, ratio: "{{1/3}}"}}
          teeth: {{type: Backlash, stiffness: {5e5 * large**2}, damping: {large}, play: {0.005 / large}}}
          wheel: {{type: Inertia, moment: 0.9 kg*m^2, speed: 0}}
        connections: [[motor.shaft, rotor.shaft, gear.a], [gear.b, teeth.a], [teeth.b, wheel.shaft]]
        run: {{stop: 2 s, accuracy: 1e-6}}
    """)
    times = np.linspace(0, 2, 41)
    assert np.allclose(chain.at("wheel.speed", times), teeth.at("wheel.speed", times), atol=1e-4)


def test_shafts_go_to_an_angle_and_with_a_speed_that_signals_tell():
    result = run("motion_by_signal")
    assert result.at("valve.angle", 0.08) == pytest.approx(follows_a_ramp(3, 0.08, 0.02), rel=1e-5)
    assert result.at("spindle.speed", 0.1) == pytest.approx(2 * (1 - np.exp(-2)), rel=1e-6)
    assert result.at("spindle.torque", 0.1) == pytest.approx(0.2 * 2 * (1 - np.exp(-2)), rel=1e-5)


def follows_a_ramp(slope, t, lag):
    """Where two lags of the same size are at t on the way after a ramp that begins at 0."""
    return slope * (t - 2 * lag + np.exp(-t / lag) * (2 * lag + t))
