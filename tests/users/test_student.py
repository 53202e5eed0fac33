"""A control student's week, from bundled parts alone: position control with stiction, a drill string, clutch and brake.

What is expected is worked out here, from force balances and linear equations between two events.
"""

import functools
import math

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq


def joules(result, entry):
    """An entry of the energy ledger [J]."""
    return result.energy.to_pandas().set_index("entry")["energy"][entry]


# --- position control -------------------------------------------------------------------------------------------------

GAIN, DAMPING, STICTION, COULOMB, STEP = 400.0, 40.0, 4.0, 3.0, 0.1  # N/m, N*s/m, N, N, m

AXIS = f"""
components:
  bed: {{type: Ground}}
  slide: {{type: Mass, mass: 1 kg, position: 0 m, velocity: 0 m/s}}
  way: {{type: Contact, normal_force: 10 N, curve: {{curve: coulomb, stiction: 0.4, coulomb: 0.3}}}}
  motor: {{type: ForceActuator}}
  ruler: {{type: MotionSensor}}
  wanted: {{type: SignalSource, value: {STEP}}}
  control: {{type: Pid, gain: {GAIN}, derivative_time: "{{{DAMPING / GAIN}}} s", effects: {{sampling: off}}}}
connections:
  - [bed.flange, way.a]
  - [slide.flange, way.b, motor.flange, ruler.flange]
  - [wanted.signal, control.reference]
  - [ruler.x, control.measured]
  - [control.command, motor.force]
run: {{stop: 10 s, accuracy: 1e-5}}
record: {{signals: [slide.x, slide.v, way.slip, way.friction, control.command, control.error]}}
"""
INTEGRAL = {"control.integral_time": "0.2 s"}  # 40 * 400 > 1 * 2000: stable without friction (Routh)


def late(result, name, since=5.0):
    """A signal after the start is over."""
    return result[name][result.t >= since]


def test_without_an_integral_the_slide_stops_within_stiction_over_gain(scene):
    result = scene(AXIS).run(out=None)
    error = late(result, "control.error")
    assert 0 < abs(error[-1]) <= STICTION / GAIN
    assert np.ptp(error) == 0  # stuck, and exactly so
    assert late(result, "control.command")[-1] == pytest.approx(GAIN * error[-1])
    assert not [event for event in result.events if event.t > 5]


def comes_to_rest(result):
    """Errors with which the slide comes to rest, one after the other [m]."""
    return result.at("control.error", [event.t for event in result.events if event.zone_to == "held"])


def test_with_an_integral_the_slide_hunts(scene):
    """At rest the integral grows until the force is that of stiction; sliding takes less, so that it overshoots."""
    result = scene(AXIS, **INTEGRAL).run(out=None, stop="30 s")
    starts = [event.t for event in result.events if event.zone_from == "held" and event.t > 1]
    assert np.abs(result.at("control.command", starts)) == pytest.approx(STICTION, rel=1e-4)
    *_, before, last = comes_to_rest(result)
    assert max(starts) > 25
    assert last == pytest.approx(-before, rel=1e-2)  # a limit cycle: as far to one side as to the other
    assert abs(last) > 1e-4


def test_an_integral_does_not_hunt_where_sliding_takes_as_much_as_starting(scene):
    """Armstrong-Helouvry and Amin (1996): no limit cycle without a stiction above the friction of sliding."""
    hunting = comes_to_rest(scene(AXIS, **INTEGRAL).run(out=None, stop="30 s"))
    settling = comes_to_rest(scene(AXIS, **INTEGRAL, **{"way.curve.coulomb": STICTION / 10}).run(out=None, stop="30 s"))
    assert np.all(np.diff(np.abs(settling)) < 1e-9)  # never farther off than before
    assert abs(settling[-1]) < 0.1 * abs(hunting[-1])


def test_what_the_motor_gave_became_heat_on_the_way(scene):
    """From rest to rest: all work done is that of sliding friction along the way."""
    result = scene(AXIS).run(out=None)
    travelled = np.sum(np.abs(np.diff(result["slide.x"])))
    assert joules(result, "dissipated") == pytest.approx(COULOMB * travelled, rel=1e-3)
    assert joules(result, "supplied") == pytest.approx(COULOMB * travelled, rel=1e-3)


# --- drill string -----------------------------------------------------------------------------------------------------

STRING, LOSS, BIT = 500.0, 60.0, 400.0  # N*m/rad, N*m*s/rad, kg*m^2
BREAKAWAY, SLIDING = 9000.0, 5000.0  # N*m

DRILL = f"""
parameters: {{rate: 4 rad/s}}
components:
  table: {{type: SpeedSource, speed: "{{rate}}", origin: 0 rad}}
  string: {{type: TorsionSpring, stiffness: {STRING} N*m/rad, damping: {LOSS} N*m*s/rad}}
  bit: {{type: Inertia, moment: {BIT} kg*m^2, angle: 0 rad, speed: 0 rad/s}}
  rock: {{type: Housing}}
  cutting: {{type: ShaftFriction, breakaway: {BREAKAWAY} N*m, sliding: {SLIDING} N*m}}
connections:
  - [table.shaft, string.a]
  - [string.b, bit.shaft, cutting.b]
  - [rock.shaft, cutting.a]
run: {{stop: 80 s, accuracy: 1e-5}}
record: {{signals: [bit.speed, string.torque, cutting.slip, cutting.torque]}}
"""


def bit_speed(rate, t):
    """Speed of the bit [rad/s] at a time after it broke away, as if it could not stick again; linear, so exact."""
    matrix = np.array(
        [[0.0, -1.0], [STRING / BIT, -LOSS / BIT]]
    )  # of twist less that of sliding, and slip over the table
    begin = np.array([(BREAKAWAY - SLIDING - LOSS * rate) / STRING, -rate])
    return rate + (expm(matrix * t) @ begin)[1]


def slowest_and_fastest(rate):
    """Lowest speed of the bit after its first swing, and highest in it."""
    speeds = [bit_speed(rate, t) for t in np.linspace(0, 2 * math.pi / math.sqrt(STRING / BIT), 800)]
    top = int(np.argmax(speeds))
    return min(speeds[top:]), speeds[top]


@functools.cache
def critical():
    """Speed of the table [rad/s] below which the bit comes to rest again."""
    return brentq(lambda rate: slowest_and_fastest(rate)[0], 1.0, 60.0)


def sticks(result):
    """Times at which the bit comes to rest."""
    return [event.t for event in result.events if event.zone_to == "held"]


def test_below_the_critical_speed_the_bit_sticks_and_slips(scene):
    rate = 0.7 * critical()
    result = scene(DRILL, rate=f"{rate} rad/s").run(out=None)
    assert max(sticks(result)) > 70
    assert result.extremes("bit.speed").highest == pytest.approx(slowest_and_fastest(rate)[1], rel=1e-3)


def test_above_the_critical_speed_it_never_sticks_again(scene):
    rate = 1.3 * critical()
    result = scene(DRILL, rate=f"{rate} rad/s").run(out=None)
    broke = min(event.t for event in result.events if event.zone_from == "held")
    assert broke == pytest.approx((BREAKAWAY - LOSS * rate) / STRING / rate, rel=1e-3)  # the twist that breaks it away
    assert not [t for t in sticks(result) if t > broke]
    assert result["bit.speed"][-1] == pytest.approx(rate, rel=1e-2)
    assert result["string.torque"][-1] == pytest.approx(-SLIDING, rel=1e-2)  # the table turns the bit forward


# --- clutch and brake -------------------------------------------------------------------------------------------------

ENGINE, LOAD, SPEED = 0.2, 0.8, 200.0  # kg*m^2, kg*m^2, rad/s
GRIP = 2 * 0.1 * 0.4 * 1000.0  # faces * radius * mu * force, N*m
BRAKING = 0.15 * 0.3 * 1000.0  # N*m
TOGETHER = ENGINE * SPEED / (ENGINE + LOAD)  # rad/s; angular momentum

TRAIN = f"""
parameters: {{pressing: 0.2 s, braking: 1 s}}
components:
  engine: {{type: Inertia, moment: {ENGINE} kg*m^2, speed: {SPEED} rad/s}}
  load: {{type: Inertia, moment: {LOAD} kg*m^2, speed: 0 rad/s}}
  press: {{type: SignalSource, value: {{ramp: {{to: 1000, over: "{{pressing}}"}}}}}}
  pedal: {{type: SignalSource, value: {{step: {{to: 1000, at: "{{braking}}"}}}}}}
  clutch: {{type: Clutch, radius: 0.1 m, faces: 2, curve: {{curve: coulomb, stiction: 0.45, coulomb: 0.4}}}}
  brake: {{type: Brake, radius: 0.15 m, curve: 0.3}}
connections:
  - [engine.shaft, clutch.a]
  - [clutch.b, load.shaft, brake.shaft]
  - [press.signal, clutch.normal]
  - [pedal.signal, brake.normal]
run: {{stop: 3 s, accuracy: 1e-6}}
record: {{signals: [engine.speed, load.speed, clutch.torque, brake.torque, clutch.slip]}}
"""


def locks(result, part):
    """First time at which a contact comes to stick."""
    return min(event.t for event in result.events if event.component.startswith(part) and event.zone_to == "held")


def test_a_clutch_locks_and_a_brake_stops_the_train_when_their_torques_say(scene):
    result = scene(TRAIN).run(out=None)
    lock = 0.1 + ENGINE * LOAD / (ENGINE + LOAD) * SPEED / GRIP  # the ramp of 0.2 s counts half
    assert locks(result, "clutch") == pytest.approx(lock, rel=1e-4)
    assert result.at("engine.speed", 0.9) == pytest.approx(TOGETHER, rel=1e-4)
    assert result.at("load.speed", 0.9) == pytest.approx(TOGETHER, rel=1e-4)
    assert BRAKING * ENGINE / (ENGINE + LOAD) < GRIP  # what slows the engine, so that the clutch stays locked
    stopped = 1 + (ENGINE + LOAD) * TOGETHER / BRAKING
    assert result.at("load.speed", stopped - 0.01) == pytest.approx(BRAKING * 0.01 / (ENGINE + LOAD), rel=1e-2)
    assert result["load.speed"][-1] == pytest.approx(0, abs=1e-6)
    assert joules(result, "dissipated") == pytest.approx(ENGINE * SPEED**2 / 2, rel=1e-4)


def test_a_clutch_that_is_pressed_slowly_locks_when_the_torque_has_summed_up(scene):
    """The torque grows as GRIP t/T, so that its integral GRIP t^2/(2 T) takes the difference of the speeds."""
    over = 2.0
    result = scene(TRAIN, pressing=f"{over} s", braking="2.5 s").run(out=None)
    lock = math.sqrt(2 * over * ENGINE * LOAD / (ENGINE + LOAD) * SPEED / GRIP)
    assert locks(result, "clutch") == pytest.approx(lock, rel=1e-4)
