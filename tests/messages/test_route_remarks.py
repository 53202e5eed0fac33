"""What is remarked of a route that can run but not well: weak clamps, tight curves, drives too slow; with numbers."""

import math
import re

import pytest
from typer.testing import CliRunner

import fairlead
from fairlead.cli import app

BELTS = """
components:
  rope: {type: Cable, length: 40 m, element: 0.25 m, start: 0 m, mass: 2 kg/m, stiffness: 200 kN, tension: 300 N%s}
  route:
    type: Route
    stations:
      - {type: Bend, start: 3 m, angle: 1 rad, radius: 2 m, friction: 0.3}
      - {name: belts, type: Deployer, start: 8 m, length: 2 m, friction: 0.5, clamp: %s}
  drive: {type: MotionSource, velocity: %s}
  back: {type: ForceSource, force: -100 N}
  tow: {type: ForceSource, force: 300 N}
connections:
  - [rope.path, route.path]
  - [drive.flange, route.belts.belt]
  - [back.flange, rope.inboard]
  - [tow.flange, rope.outboard]
run: {stop: 10 s}
"""


def remark(model):
    (found,) = model.check()
    return found


@pytest.mark.slow
def test_a_clamp_that_cannot_carry_the_tow_says_what_it_holds_what_is_needed_and_what_would_do(scene):
    """Hauling: the belts give 300 N less the 100 exp(-0.3) N inboard of the bend; they hold 2 mu q length."""
    needed = 300 - 100 * math.exp(-0.3)
    found = remark(scene(BELTS % ("", "100 N/m", "-0.2 m/s")))
    assert f"route.belts: its belts hold 200 N (2 mu q length), and hauling takes {needed:.4g} N: a factor of 0.89" in (
        found.what
    )
    assert found.way_out == f"They will slip. A clamp of {1.5 * needed / 2:.3g} N/m for each belt would do."
    assert found.where.line == 10  # of the station


def test_a_clamp_with_little_to_spare_is_remarked_without_the_threat(scene):
    found = remark(scene(BELTS % ("", "140 N/m", "-0.2 m/s")))
    assert "a factor of 1.2, 1.5 is wanted" in found.what
    assert not found.way_out.startswith("They will slip")


def test_a_clamp_that_is_strong_enough_is_not_remarked(scene):
    needed = 300 - 100 * math.exp(-0.3)
    assert scene(BELTS % ("", f"{1.501 * needed / 2} N/m", "-0.2 m/s")).check() == []


def test_starting_the_line_counts(scene):
    """It takes the mass on both sides of the belts, and what the bend makes of that on the inboard side."""
    found = remark(scene(BELTS % ("", "140 N/m", "{ramp: {to: -0.2 m/s, over: 0.2 s}}")))
    a, m, mu = 1.0, 2.0, 0.3
    before = 100 - m * a * 3  # N at the bend; along it dT/dtheta = -mu T - m a R
    behind = (before + m * a * 2 / mu) * math.exp(-mu) - m * a * 2 / mu
    outboard, inboard = 300 + m * a * 30, behind - m * a * 3
    force = outboard - inboard + m * a * 2  # and the piece between the belts
    told = float(re.search(r"1 m/s\^2 at 0 s ([\d.]+) N", found.what)[1])
    assert told == pytest.approx(force, rel=1e-3)
    assert "steady motion takes up to 225.9 N" in found.what


@pytest.mark.slow
def test_a_clamp_that_a_signal_presses_is_judged_by_the_signal(scene):
    text = (BELTS % ("", "0 N/m", "-0.2 m/s")).replace("run:", "  - [press.signal, route.belts.clamp]\nrun:")
    pressed = text.replace("  drive:", "  press: {type: SignalSource, value: %s}\n  drive:")
    assert scene(pressed % 200).check() == []
    assert "its belts hold 200 N" in remark(scene(pressed % 100)).what


def test_the_deliberately_weak_clamp_is_told_and_may_run():
    found = remark(fairlead.load("weak_clamp"))
    assert "its belts hold 270 N" in found.what
    assert "They will slip." in found.way_out
    answer = CliRunner().invoke(app, ["check", "weak_clamp"])
    assert answer.exit_code == 0
    assert "warning: " in answer.output


def test_a_curve_in_which_the_tension_presses_harder_than_the_line_bears(scene):
    found = remark(scene(BELTS % (", side_wall: 40 N/m", "200 N/m", "-0.2 m/s")))
    assert "route.bend: hauled at 0.2 m/s the line is pressed with 50 N/m (tension over radius)" in found.what
    assert "more than rope bears, 40 N/m" in found.what
    assert found.where.line == 9


SHAFT = """
components:
  speed: {type: SignalSource, value: {ramp: {to: %s, over: 1 s}}}
  control: {type: PiController, gain: 1, integral_time: 1 s}
  drive: {type: PmDrive, constant: 0.5 N*m/A, most_current: 40 A, most_voltage: 50 V, inertia: 0.1 kg*m^2%s}
  gear: {type: Gearbox, ratio: 0.1}
  drum: {type: Inertia, moment: 1 kg*m^2}
  rope: {type: Rack, radius: 0.5 m}
  line: {type: MotionSensor}
  load: {type: ForceSource, force: -20 N}
connections:
  - [speed.signal, control.reference]
  - [line.v, control.measured]
  - [control.command, drive.command]
  - [drive.shaft, gear.a]
  - [gear.b, drum.shaft, rope.pinion]
  - [rope.rack, line.flange, load.flange]
friction: {method: hold}
run: {stop: 2 s}
"""


@pytest.mark.slow
def test_a_reference_faster_than_an_electric_motor_at_all_its_voltage(scene):
    """50 V / 0.5 V s = 100 rad/s, through the gear and the drum 100 * 0.1 * 0.5 = 5 m/s."""
    winding = ", resistance: 0.1 ohm, effects: {winding: on}"
    assert scene(SHAFT % (4.99, winding)).check() == []
    found = remark(scene(SHAFT % (5.01, winding)))
    assert found.what == "control: its reference goes to 5.01, and drive.motor reaches 5 without load."


def test_a_motor_without_a_winding_has_no_limit_that_is_known(scene):
    assert scene(SHAFT % (50, "")).check() == []


@pytest.mark.slow
def test_a_reference_faster_than_a_valve_lets_its_motor_run():
    """C_d A sqrt((p_s - p_t)/rho)/D through gear and drum is 1.158 m/s (physics 5.3)."""
    assert fairlead.load("winch_drive", set={"profile.value": "1.15"}).check() == []
    found = remark(fairlead.load("winch_drive", set={"profile.value": "1.16"}))
    assert "control: its reference goes to 1.16, and drive.oil reaches 1.158 without load." in found.what
    closed = {"profile.value": "1.16", "effects.compressibility": "off", "effects.leakage": "off"}
    assert "reaches 1.158 without load" in remark(fairlead.load("winch_drive", set=closed)).what


@pytest.mark.slow
def test_a_winch_that_the_tow_slows_down_below_its_reference(scene):
    """p_load = torque/D, so that the speed falls by sqrt(1 - force/stall pull)."""
    winch = """
components:
  power: {type: PowerUnit, pressure: 180 bar, tank_pressure: 2 bar}
  drive: {type: ServoMotorDrive, valve: {rated_flow: 40 l/min},
          motor: {displacement: 125 cm^3/rev, inertia: 0.025 kg*m^2}}
  gear: {type: Gearbox, ratio: "{1/30}"}
  profile: {type: SignalSource, value: -0.9}
  belt_speed: {type: SignalGain, gain: 0.65}
  control: {type: PiController, gain: 0.3, integral_time: 0.3 s}
  rope: {type: Cable, length: 40 m, element: 0.25 m, start: -10 m, mass: 2 kg/m, stiffness: 2 MN, tension: 100 N}
  route:
    type: Route
    stations:
      - {name: winch, type: Winch, radius: 0.65 m}
      - {type: Bend, start: 3 m, angle: 90 deg, radius: 2 m, friction: 0.3}
  tow: {type: ForceSource, force: TOW}
connections:
  - [rope.path, route.path]
  - [tow.flange, rope.outboard]
  - [power.supply, drive.supply]
  - [power.tank, drive.tank]
  - [drive.shaft, gear.a]
  - [gear.b, route.winch.shaft]
  - [profile.signal, control.reference]
  - [route.winch.speed, belt_speed.value]
  - [belt_speed.signal, control.measured]
  - [control.command, drive.command]
friction: {method: hold}
run: {stop: 5 s}
"""
    assert scene(winch.replace("TOW", "1 kN")).check() == []
    found = remark(scene(winch.replace("TOW", "5 kN")))
    displacement, conductance = 125e-6 / (2 * math.pi), 40e-3 / 60 / math.sqrt(35e5)
    free = conductance * math.sqrt(178e5 / 2) / displacement / 30 * 0.65
    pull = 5000 * math.exp(0.3 * math.pi / 2)
    loaded = free * math.sqrt(1 - pull / (displacement * 178e5 * 30 / 0.65))
    assert f"reaches {free:.4g} without load, {loaded:.4g} with the {pull:.4g} N of route.winch." in found.what


PAID_OUT = """
components:
  rope: {type: Cable, length: 24 m, element: 0.25 m, start: -12 m, tension: 300 N, mass: 0.8 kg/m, stiffness: 500 kN}
  route: {type: Route, stations: [{type: Winch, radius: 0.4 m},
          {type: Bend, start: 2 m, angle: 90 deg, radius: 1 m, friction: 0.3}]}
  drive: {type: MotionSource, velocity: {trapezoid: {to: SPEED, start: 0 s, rise: 1 s, stay: 8 s, fall: 1 s}}}
  load: {type: ForceSource, force: 300 N}
connections:
  - [rope.path, route.path]
  - [drive.flange, END]
  - [load.flange, rope.outboard]
friction: {method: binding}
run: {stop: 12 s}
"""


@pytest.mark.slow
def test_a_line_of_which_more_is_paid_out_than_lies_on_the_drum(scene):
    """A trapezoid of 10 s with 8 s at full speed pays out 9 s of it."""
    text = PAID_OUT.replace("END", "route.winch.rim")
    assert scene(text.replace("SPEED", f"{12 / 9 - 1e-3} m/s")).check() == []
    found = remark(scene(text.replace("SPEED", "1.5 m/s")))
    assert found.what.startswith("route.winch: 13.5 m are paid out by 10 s, and 12 m lie on the drum; the inboard end")
    assert found.way_out == "Let rope start at -13.5 m or further inboard."
    assert scene(text.replace("SPEED", "-1 m/s")).check() == []


@pytest.mark.slow
def test_a_line_that_something_else_holds_beside_a_winch(scene):
    text = PAID_OUT.replace("END", "rope.inboard").replace("start: -12 m", "start: 0.3 m").replace("SPEED", "0.1 m/s")
    found = remark(scene(text))
    assert "rope begins at 0.3 m, and what lies inboard of 0 m is on route.winch: 0.3 m are missing" in found.what
    assert found.where.line == 5  # that of the rope


def test_a_line_that_never_comes_off_its_drum(scene):
    text = PAID_OUT.replace("END", "route.winch.rim").replace("start: -12 m", "start: -30 m")
    assert scene(text.replace("SPEED", "0.7 m/s")).check() == []
    found = remark(scene(text.replace("SPEED", "0.6 m/s")))
    assert "rope lies on route.winch with all its length, from -30 to -6 m: 6 m must be paid out before" in found.what
    assert found.what.endswith("comes off, and 5.4 m are.")


WEAK = """
components:
  line: {type: Cable, length: 20 m, element: 0.5 m, start: -12 m, tension: 500 N, mass: 1 kg/m, stiffness: 500 kN}
  route:
    type: Route
    stations:
      - {name: winch, type: Winch, radius: 0.5 m, moment: 20 kg*m^2}
      - {name: bend, type: Bend, start: 2 m, angle: 45 deg, radius: 2 m, friction: 0.1}
  load: {type: ForceSource, force: 500 N}
  want: {type: SignalSource, value: {table: {t: [0, 1, 10], y: [0, -0.3, -0.3]}}}
  speed: {type: SignalGain, gain: 0.5}
  control: {type: PiController, gain: 300, integral_time: 0.3 s, low: -300, high: 300}
  drive: {type: PmDrive, constant: 1.2 N*m/A, most_current: AMPS A, inertia: 0.025 kg*m^2, resistance: 0.1 ohmWINDING}
  gear: {type: Gearbox, ratio: "{1/30}", efficiency: 0.95}
connections:
  - [line.path, route.path]
  - [want.signal, control.reference]
  - [route.winch.speed, speed.value]
  - [speed.signal, control.measured]
  - [control.command, drive.command]
  - [drive.shaft, gear.a]
  - [gear.b, route.winch.shaft]
  - [load.flange, line.outboard]
run: {stop: 3 s}
"""


@pytest.mark.parametrize("winding", ["", ", effects: {winding: on}"])
@pytest.mark.parametrize(("amps", "told"), [(2, 1), (20, 0)])
def test_a_servo_whose_largest_current_does_not_hold_the_load(scene, winding, amps, told):
    """540.9 N at 0.5 m behind a gear of 30 want 9 N m, 7.5 A: 2 A hold 2.4 N m."""
    remarks = [str(one) for one in scene(WEAK.replace("AMPS", str(amps)).replace("WINDING", winding)).check()]
    assert len([one for one in remarks if "drive.motor reaches" in one]) == told
    if told:
        assert "0 with the 540.9 N of route.winch" in remarks[0]
