"""Examples as other libraries ship them, written with bundled parts alone, against own integration.

Their sources are examples of the Modelica Standard Library: Translational.PreLoad, Rotational.CoupledClutches,
Rotational.LossyGearDemo2, Translational.EddyCurrentBrake, and Blocks.PID_Controller; sizes are not always theirs.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

PRELOAD = """
    components:
      housing: {type: Ground}
      spool: {type: Mass, mass: 0.15 kg, position: 0, velocity: 0}
      plate_a: {type: Mass, mass: 10 g, position: -23.5 mm, velocity: 0}
      plate_b: {type: Mass, mass: 10 g, position: 23.5 mm, velocity: 0}
      spring: {type: SpringDamper, stiffness: 20 kN/m, damping: 20 N*s/m, free_length: 52 mm}
      spool_a: {type: ElasticGap, length: -23.5 mm, stiffness: 1 MN/m, damping: 250 N*s/m}
      spool_b: {type: ElasticGap, length: -23.5 mm, stiffness: 1 MN/m, damping: 250 N*s/m}
      house_a: {type: ElasticGap, length: -23.5 mm, stiffness: 1 MN/m, damping: 250 N*s/m}
      house_b: {type: ElasticGap, length: -23.5 mm, stiffness: 1 MN/m, damping: 250 N*s/m}
      push: {type: ForceSource, force: {sine: {amplitude: 150 N, frequency: 5 Hz}}}
      guide: {type: Damper, damping: 20 N*s/m}
    connections:
      - [housing.flange, house_a.a, house_b.b, guide.a]
      - [spring.a, plate_a.flange, house_a.b, spool_a.b]
      - [spring.b, plate_b.flange, house_b.a, spool_b.a]
      - [spool.flange, push.flange, guide.b, spool_a.a, spool_b.b]
    run: {stop: 0.2 s}
    record: {every: 1 ms, signals: [spool.x, plate_a.x, plate_b.x]}
"""


@pytest.mark.slow
def test_a_preloaded_spool_moves_where_the_force_is_above_that_of_its_spring(simulate):
    result = simulate(PRELOAD)

    def pushes(gap, rate):
        return 0.0 if gap > 0 else -1e6 * gap + max(1e6 * gap, min(-1e6 * gap, -250 * rate))

    def rates(t, y):
        s, vs, a, va, b, vb = y
        house_a, house_b = pushes(a + 0.0235, va), pushes(0.0235 - b, -vb)
        grips_a, grips_b = pushes(a - s + 0.0235, va - vs), pushes(s - b + 0.0235, vs - vb)
        spring = 2e4 * (b - a - 0.052) + 20 * (vb - va)
        pulled = 150 * np.sin(2 * np.pi * 5 * t) - 20 * vs - grips_a + grips_b
        return vs, pulled / 0.15, va, (spring + house_a + grips_a) / 0.01, vb, (-spring - house_b - grips_b) / 0.01

    start = [0, 0, -0.0235, 0, 0.0235, 0]
    found = solve_ivp(rates, (0, 0.2), start, "LSODA", rtol=1e-9, atol=1e-12, max_step=2e-5, t_eval=result.t)
    for name, k in (("spool", 0), ("plate_a", 2), ("plate_b", 4)):
        assert result[f"{name}.x"] == pytest.approx(found.y[k], abs=1e-7)
    assert np.abs(result["spool.x"]).max() == pytest.approx((150 - 100) / 2e4, rel=0.2)


CLUTCHES = """
    components:
      drive: {type: TorqueSource, torque: {sine: {amplitude: 10 N*m, frequency: 5 Hz}}}
      j1: {type: Inertia, moment: 1 kg*m^2, speed: 10 rad/s}
      c1: {type: Clutch, radius: 1 m, curve: {curve: coulomb, coulomb: 0.5, stiction: 0.55}}
      p1: {type: SignalSource, value: {sine: {amplitude: 20, frequency: 1 Hz, phase: 90 deg, offset: 20}}}
      j2: {type: Inertia, moment: 1 kg*m^2, speed: 0}
      c2: {type: Clutch, radius: 1 m, curve: {curve: coulomb, coulomb: 0.5, stiction: 0.55}}
      p2: {type: SignalSource, value: {step: {to: 20, at: 0.4 s}}}
      j3: {type: Inertia, moment: 1 kg*m^2, speed: 0}
      c3: {type: Clutch, radius: 1 m, curve: {curve: coulomb, coulomb: 0.5, stiction: 0.55}}
      p3: {type: SignalSource, value: {step: {to: 10, at: 0.9 s}}}
      j4: {type: Inertia, moment: 1 kg*m^2, speed: 0}
    connections:
      - [drive.shaft, j1.shaft, c1.a]
      - [c1.b, j2.shaft, c2.a]
      - [c2.b, j3.shaft, c3.a]
      - [c3.b, j4.shaft]
      - [p1.signal, c1.normal]
      - [p2.signal, c2.normal]
      - [p3.signal, c3.normal]
    run: {stop: 1.5 s}
    record: {every: 10 ms, signals: ["j?.speed"]}
"""


def accelerations(t, slips):
    """Of four equal inertias, and the torques of three clutches that slip one way (1, -1) or hold (0)."""
    pressed = 20 + 20 * np.cos(2 * np.pi * t), 20.0 * (t >= 0.4), 10.0 * (t >= 0.9)
    matrix, right = np.eye(7), np.zeros(7)
    for k in range(3):
        matrix[k, 4 + k], matrix[k + 1, 4 + k] = -1, 1
        if slips[k] == 0:
            matrix[4 + k, 4 + k], matrix[4 + k, k], matrix[4 + k, k + 1] = 0, -1, 1
        else:
            right[4 + k] = slips[k] * 0.5 * pressed[k]
    right[0] = 10 * np.sin(2 * np.pi * 5 * t)
    found = np.linalg.solve(matrix, right)
    return found[:4], found[4:], pressed


@pytest.mark.slow
def test_three_clutches_in_a_row_hold_and_slip_as_small_fixed_steps_say(simulate):
    result = simulate(CLUTCHES)
    h, speeds, slips, rows = 5e-5, np.array([10.0, 0, 0, 0]), [-1, 0, 0], []
    for step in range(30001):
        t = step * h
        rows.append(speeds)
        for _ in range(3):
            _, torques, pressed = accelerations(t, slips)
            over = [k for k in range(3) if slips[k] == 0 and abs(torques[k]) > 0.55 * pressed[k] + 1e-12]
            if not over:
                break
            slips[over[0]] = int(np.sign(torques[over[0]]))
        after = speeds + h * accelerations(t + h / 2, slips)[0]
        for k in range(3):
            if slips[k] != 0 and (speeds[k + 1] - speeds[k]) * slips[k] > 0 >= (after[k + 1] - after[k]) * slips[k]:
                slips[k], after[k : k + 2] = 0, after[k : k + 2].mean()
        speeds = after
    rows = np.array(rows)
    for k in range(4):
        expected = np.interp(result.t, np.arange(30001) * h, rows[:, k])
        assert result[f"j{k + 1}.speed"] == pytest.approx(expected, abs=2e-3)  # a switch is late by up to h
    assert rows[-1, 0] - rows[-1, 3] > 0.5


LOSSY = """
    components:
      drive: {type: TorqueSource, torque: {sine: {amplitude: 10 N*m, frequency: 0.5 Hz}}}
      j1: {type: Inertia, moment: 1 kg*m^2, speed: 0}
      bearing: {type: ShaftFriction, points: [[0 rad/s, 0.5 N*m], [1 rad/s, 1 N*m]]}
      frame: {type: Housing}
      gear: {type: LossyGear, ratio: 0.5, efficiency: 0.5, efficiency_back: 0.5}
      j2: {type: Inertia, moment: 1.5 kg*m^2}
      load: {type: TorqueSource, torque: -3 N*m}
    connections:
      - [drive.shaft, j1.shaft, bearing.b, gear.a]
      - [bearing.a, frame.shaft]
      - [gear.b, j2.shaft, load.shaft]
    run: {stop: 2 s}
    record: {every: 10 ms, signals: [j1.speed, j2.speed]}
"""


def test_a_lossy_gear_behind_a_bearing_follows_the_share_of_who_drives(simulate):
    """Of 2 t at an ideal gear it gives 2 t/2 where t drives, and 4 t where it is driven; between them it stands."""
    result = simulate(LOSSY)

    def acceleration(t, w, way):
        bearing, drive = min(0.5 + 0.5 * abs(w), 1.0), 10 * np.sin(np.pi * t)
        for share, sign in ((2 * 0.5, 1), (2 / 0.5, -1)):
            a = (drive - way * bearing - 3 / share) / (1 + 1.5 / 2 / share)
            if (1.5 * a / 2 + 3) / share * way * sign >= 0:
                return a
        return 0.0

    h, w, way, rows = 1e-4, 0.0, 0, []
    for step in range(20001):
        t = step * h
        rows.append(w)
        if way == 0:
            way = 1 if acceleration(t, 0, 1) > 0 else -1 if acceleration(t, 0, -1) < 0 else 0
        if way:
            after = w + h * acceleration(t + h / 2, w + h / 2 * acceleration(t, w, way), way)
            w, way = (0.0, 0) if after * way <= 0 and w != 0 else (after, way)
    expected = np.interp(result.t, np.arange(20001) * h, rows)
    assert result["j1.speed"] == pytest.approx(expected, abs=2e-3)
    assert result["j2.speed"] == pytest.approx(expected / 2, abs=1e-3)
    assert min(rows) < -1
    assert max(rows) > 1
    assert rows.count(0.0) > 100


EDDY = """
    components:
      mass: {type: Mass, mass: 2 kg, position: 0, velocity: 100 m/s}
      reads: {type: MotionSensor}
      law: {type: SignalFunction, expression: "-2*f*v*w/(v*v + w*w)", constants: {f: 100, w: 20}}
      brake: {type: ForceActuator}
      loss: {type: SignalFunction, expression: "-f*v"}
      warms: {type: HeatActuator}
      disc: {type: HeatCapacity, capacity: 150 J/K}
    connections:
      - [mass.flange, reads.flange, brake.flange]
      - [reads.v, law.v, loss.v]
      - [law.signal, brake.force, loss.f]
      - [loss.signal, warms.heat]
      - [warms.port, disc.port]
    run: {stop: 5 s}
    record: {every: 50 ms, signals: [mass.v, disc.temperature]}
"""


def test_an_eddy_current_brake_is_a_function_of_speed(simulate):
    """w^2 ln(v/v0) + (v^2 - v0^2)/2 = -2 f w t/m; what the body had is in the disc."""
    result = simulate(EDDY)
    v = result["mass.v"]
    assert 400 * np.log(v / 100) + (v**2 - 1e4) / 2 == pytest.approx(-2 * 100 * 20 * result.t / 2, abs=0.02)
    assert result["disc.temperature"] - 293.15 == pytest.approx((1e4 - v**2) / 150, abs=1e-4)


PID = """
    components:
      wanted: {type: SignalSource, value: {trapezoid: {to: 1.5, start: 0.5 s, rise: 1 s, stay: 1 s, fall: 1 s}}}
      pi: {type: Pid, gain: 100, integral_time: 0.1 s, low: -12, high: 12, effects: {sampling: off}}
      motor: {type: TorqueActuator}
      j1: {type: Inertia, moment: 1 kg*m^2, angle: 0, speed: 0}
      reads: {type: RotationSensor}
      shaft: {type: TorsionSpring, stiffness: 10 kN*m/rad, damping: 100 N*m*s/rad}
      j2: {type: Inertia, moment: 2 kg*m^2, angle: 0, speed: 0}
      load: {type: TorqueSource, torque: {step: {to: 10 N*m, at: 2 s}}}
    connections:
      - [wanted.signal, pi.reference]
      - [reads.speed, pi.measured]
      - [pi.command, motor.torque]
      - [motor.shaft, j1.shaft, reads.shaft, shaft.a]
      - [shaft.b, j2.shaft, load.shaft]
    run: {stop: 4 s}
    record: {every: 10 ms, signals: [j1.speed, j2.speed, pi.command]}
"""


def test_a_limited_controller_turns_two_inertias_as_its_equations_say(simulate):
    result = simulate(PID)

    def command(t, y):
        return 100 * (np.interp(t, [0, 0.5, 1.5, 2.5, 3.5], [0, 0, 1.5, 1.5, 0]) - y[1]) + y[4]

    def rates(t, y):
        wanted = command(t, y)
        given, twists = np.clip(wanted, -12, 12), 1e4 * (y[2] - y[0]) + 100 * (y[3] - y[1])
        gathers = (wanted - y[4]) / 0.1 + (given - wanted) / 0.05
        return y[1], given + twists, y[3], (10 * (t >= 2) - twists) / 2, gathers

    t, start, found = result.t, np.zeros(5), []
    for begin, end in ((0, 2), (2, 4)):
        part = solve_ivp(rates, (begin, end), start, "LSODA", rtol=1e-9, atol=1e-11, max_step=2e-3, dense_output=True)
        start = part.y[:, -1]
        found.append(part.sol(t[(t >= begin) & (t <= end)]))
    times = np.concatenate([t[t <= 2], t[t >= 2]])
    found = np.concatenate(found, axis=1)
    assert np.interp(times, t, result["j1.speed"]) == pytest.approx(found[1], abs=1e-3)
    assert np.interp(times, t, result["j2.speed"]) == pytest.approx(found[3], abs=1e-3)
    assert result["pi.command"].min() == -12
