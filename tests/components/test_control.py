"""Controllers against their recursions, written out once more in Python, and against closed forms."""

import math

import numpy as np
import pytest

PLANT = '''
    class Lag(Component):
        """T dy/dt = K u - y."""
        u = Input("1", signed=True)
        gain = Parameter("1")
        constant = Parameter("s", above=0)
        y = State("1", start="first")
        first = Parameter("1", default=0.0)
        out = Output("1")
        def law(p, u, y):
            return Law(y=(p.gain * u - y) / p.constant, out=y)
'''
K, T = 1.15, 0.08
LOOP = f"""
    parameters: {{Ts: 10 ms}}
    components:
      reference: {{type: SignalSource, value: 0}}
      control: {{type: PiController, period: "{{Ts}}", gain: 0.6, integral_time: 0.15 s, low: -100, high: 100}}
      plant: {{type: Lag, gain: {K}, constant: {T} s, first: 1}}
    connections:
      - [reference.signal, control.reference]
      - [plant.out, control.measured]
      - [control.command, plant.u]
    run: {{stop: 10 s, accuracy: 1e-8}}
    record: {{signals: ["*"]}}
"""


def map_of(period, gain=0.6, integral_time=0.15):
    """The loop from sample to sample: plant, value measured one sample ago, integral."""
    a = math.exp(-period / T)
    b = K * (1 - a)
    return np.array([[a, -b * gain, b], [1, 0, 0], [0, -gain * period / integral_time, 1]])


def size(period):
    return np.abs(np.linalg.eigvals(map_of(period))).max()


@pytest.fixture
def plant(library):
    return (library(PLANT),)


def test_the_eigenvalues_of_the_sampled_loop_are_those_of_the_design():
    assert size(0.2) == pytest.approx(0.9956, abs=5e-5)
    assert size(0.3) == pytest.approx(1.19, abs=5e-3)


@pytest.mark.parametrize("period", [0.01, 0.1, 0.2, 0.3])
def test_a_sampled_loop_follows_its_map(simulate, plant, period):
    samples = min(30, round(10 / period))
    result = simulate(LOOP, plant, Ts=f"{period} s", **{"run.stop": f"{samples * period + period / 2} s"})
    state = np.array([1.0, 0.0, 0.0])  # the value measured before the start is zero
    for k in range(samples):
        assert result.at("plant.out", k * period, side="right") == pytest.approx(state[0], rel=1e-6, abs=1e-8)
        state = map_of(period) @ state


def test_the_loop_is_stable_up_to_the_sample_time_of_the_closed_form(simulate, plant):
    """The largest eigenvalue passes one at a period between; simulated, it decays below and grows above."""
    low, high = 0.2, 0.3
    while high - low > 1e-6:
        low, high = ((low + high) / 2, high) if size((low + high) / 2) < 1 else (low, (low + high) / 2)
    assert low == pytest.approx(0.2022, abs=5e-4)
    for period, grows in ((0.97 * low, False), (1.03 * low, True)):
        result = simulate(LOOP, plant, Ts=f"{period} s", **{"run.stop": "40 s"})
        early = np.abs(result["plant.out"][(result.t > 5) & (result.t < 10)]).max()
        late = np.abs(result["plant.out"][result.t > 35]).max()
        assert (late > early) == grows
        rate = (late / early) ** (period / 30)
        assert rate == pytest.approx(size(period), abs=2e-3)


def recursion(period, stop, reference, first, settings):
    """The controller and the lag, sample by sample: times and values of the plant there, and commands."""
    a = math.exp(-period / T)
    y, seen, integral, command, told = first, 0.0, 0.0, 0.0, []
    gain, ti, ff, low, high, slew, tt = settings
    for k in range(round(stop / period)):
        error = reference(k * period) - seen
        wanted = ff * reference(k * period) + gain * error + integral
        before, command = command, min(max(wanted, low), high)
        if slew is not None:
            command = min(max(command, before - slew * period), before + slew * period)
        integral += period * (gain / ti * error + (command - wanted) / tt)
        seen = y
        told.append((k * period, y, command))
        y = a * y + K * (1 - a) * command
    return np.array(told)


LIMITED = (
    LOOP.replace("value: 0", "value: {step: {to: 1.4, at: 0.495 s}}")
    .replace("low: -100, high: 100", "low: -1, high: 1, feed_forward: 0.2, slew: 4 1/s, tracking_time: 0.1 s")
    .replace("first: 1", "first: 0")
)


def test_limits_slew_and_back_calculation_are_those_of_the_recursion(simulate, plant):
    """1.4 is more than the plant can give (1.15), so the command stays at its limit until the reference comes back."""
    shape = "{trapezoid: {to: 1.4, start: 0.5 s, rise: 0.01 s, stay: 2 s, fall: 0.01 s}}"
    text = LIMITED.replace("{step: {to: 1.4, at: 0.495 s}}", shape)
    result = simulate(text, plant, **{"run.stop": "4.005 s"})

    def reference(t):
        return 1.4 * min(max(min((t - 0.5) / 0.01, (2.52 - t) / 0.01), 0.0), 1.0)

    told = recursion(0.01, 4.0, reference, 0.0, (0.6, 0.15, 0.2, -1.0, 1.0, 4.0, 0.1))
    commands = result.at("control.command", told[:, 0] + 0.005)
    np.testing.assert_allclose(commands, told[:, 2], atol=1e-7)
    np.testing.assert_allclose(result.at("plant.out", told[:, 0], side="right"), told[:, 1], atol=1e-7)
    assert commands.max() == 1.0
    assert np.abs(np.diff(commands)).max() <= 4 * 0.01 + 1e-12


def test_anti_windup_brings_the_command_back_sooner(simulate, plant):
    """A reference that cannot be reached for 6 s: without back-calculation the integral must be worked off first."""
    shape = "{trapezoid: {to: 1.4, start: 0.5 s, rise: 0.01 s, stay: 6 s, fall: 0.01 s}}"
    text = LIMITED.replace("{step: {to: 1.4, at: 0.495 s}}", shape)
    times = []
    for tracking in ("0.1 s", "1e6 s"):
        result = simulate(text, plant, **{"run.stop": "15 s", "control.tracking_time": tracking})
        late = (result.t > 6.5) & (np.abs(result["plant.out"]) > 0.1)
        times.append(result.t[late].max() - 6.52)
    assert times[0] < 10 * T  # some time constants of the plant after the reference is back
    assert times[1] > 2 * times[0]


@pytest.mark.slow
def test_sampling_that_is_off_is_the_limit_of_short_samples(scene, simulate, plant):
    text = LIMITED.replace("1.4", "0.8") + "    effects: {sampling: off}\n"
    grid = np.linspace(0.05, 3, 60)
    text = text.replace("smoothing", "smoothing").replace('signals: ["*"]', 'signals: ["*"], every: 1 ms')
    off = simulate(text, plant, **{"run.stop": "3 s", "control.smoothing": "0.1 ms", "run.accuracy": "1e-6"})
    errors = []
    for period in ("4 ms", "1 ms"):
        on = simulate(text, plant, Ts=period, **{"run.stop": "3 s", "effects.sampling": "on", "run.accuracy": "1e-6"})
        errors.append(np.abs(on.at("plant.out", grid) - off.at("plant.out", grid)).max())
    assert errors[1] < 5e-3
    assert errors[1] < 0.4 * errors[0]
    model = scene(text, plant)
    assert not model.system.memory["sampled"].size
    assert "control.summed" in model.system.unknown_names
    on = scene(text, plant, **{"effects.sampling": "on"}).system
    assert not [name for name in on.unknown_names if name.startswith("control")]


SHAPED = """
    components:
      target: {type: SignalSource, value: {table: {t: [0, 0.1, 0.1001, 3, 3.0001, 6], y: [0, 0, 0.5, 0.5, -0.2, -0.2]}}}
      shaper: {type: ReferenceShaper, most: 0.5 1/s}
    connections: [[target.signal, shaper.target]]
    run: {stop: 6 s}
    record: {signals: ["*"], every: 10 ms}
"""


def test_a_reference_is_shaped_to_a_trapezoid(simulate):
    result = simulate(SHAPED)
    rates = np.diff(result.at("shaper.reference", np.arange(0.005, 6, 0.01))) / 0.01
    assert np.abs(rates).max() == pytest.approx(0.5, rel=1e-9)
    assert result.at("shaper.reference", 1.2) == pytest.approx(0.5, abs=1e-9)
    assert result.at("shaper.reference", 5.0) == pytest.approx(-0.2, abs=1e-9)
    ramp = (result.t > 0.2) & (result.t < 1.0)
    np.testing.assert_allclose(np.polyfit(result.t[ramp], result["shaper.reference"][ramp], 1)[0], 0.5, rtol=1e-3)


def test_with_a_jerk_the_rate_changes_no_faster_and_the_target_is_reached_without_overshoot(simulate):
    result = simulate(SHAPED, **{"shaper.jerk": "2"})
    times = np.arange(0.005, 6, 0.01)
    values, slopes = (result.at(f"shaper.{name}", times) for name in ("reference", "slope"))
    assert np.abs(np.diff(slopes)).max() <= 2 * 0.01 + 1e-9
    assert np.abs(slopes).max() <= 0.5 + 1e-9
    assert values.max() <= 0.5 + 0.01
    assert values[int(2.9 / 0.01)] == pytest.approx(0.5, abs=1e-3)
    assert values[-1] == pytest.approx(-0.2, abs=1e-3)


INTERLOCK = """
    components:
      target: {{type: SignalSource, value: 0.3}}
      tension: {{type: SignalSource, value: {{table: {{t: [0, 1, 1.05, 1.1, 2, 2.3, 3], y: {values}}}}}}}
      lock: {lock}
    connections: [[target.signal, lock.target], [tension.signal, lock.tension]]
    run: {{stop: 3 s}}
    record: {{signals: ["*"], every: 1 ms}}
"""


def test_an_over_tension_trip_waits_for_its_patience_and_then_stays(simulate):
    """The first peak is shorter than the patience; the second begins at 2.1 s and trips a tenth of a second later."""
    lock = "{type: OverTensionTrip, limit: 500 N, patience: 0.1 s}"
    result = simulate(INTERLOCK.format(values="[0, 0, 900, 0, 0, 1500, 0]", lock=lock))
    first = result.t[result["lock.tripped"] > 0.5][0]
    assert first == pytest.approx(2.1 + 0.1, abs=0.011)
    np.testing.assert_allclose(result["lock.reference"], 0.3 * (1 - result["lock.tripped"]), atol=1e-12)
    assert result["lock.tripped"][-1] == 1


def test_a_ruck_trip_watches_compression(simulate):
    lock = "{type: RuckTrip, ruck_force: 160 N}"
    result = simulate(INTERLOCK.format(values="[500, 500, -900, 500, 0, -480, -480]", lock=lock))
    first = result.t[result["lock.tripped"] > 0.5][0]
    assert first == pytest.approx(2.1 + 0.1, abs=0.011)  # the default patience is a tenth of a second
    assert result.at("lock.reference", 2.0) == 0.3
    assert result["lock.reference"][-1] == 0


def test_a_zero_tension_hold_stops_paying_out_but_lets_haul_in(simulate):
    lock = "{type: ZeroTensionHold, low: 50 N, release: 120 N}"
    values = "[200, 200, 0, 100, 100, 300, 300]"
    result = simulate(INTERLOCK.format(values=values, lock=lock))
    held = result["lock.holding"] > 0.5
    first, last = result.t[held][0], result.t[held][-1]
    assert first == pytest.approx(1.0375, abs=0.011)  # 50 N on the way down
    assert last == pytest.approx(2.03, abs=0.011)  # 120 N on the way up; 100 N in between are not enough
    assert set(np.round(result["lock.reference"][held], 12)) == {0.0}
    hauling = simulate(INTERLOCK.format(values=values, lock=lock), **{"target.value": "-0.3"})
    assert set(np.round(hauling["lock.reference"][hauling.t > 0.02], 12)) == {-0.3}


TENSION = """
    components:
      line: {type: SpringDamper, stiffness: 20 kN/m, damping: 2 kN*s/m}
      sea:
        type: MotionSource
        velocity: {trapezoid: {to: 0.4 m/s, start: 1 s, rise: 1 s, stay: 4 s, fall: 1 s}}
        origin: 0 m
      drum: {type: Inertia, moment: 50 kg*m^2, speed: 0 rad/s}
      rope: {type: Rack, radius: 0.5 m, offset: -10 mm}
      motion: {type: MotionSensor}
      drive: {type: TorqueActuator}
      control: CONTROL
    connections:
      - [line.a, rope.rack, motion.flange]
      - [line.b, sea.flange]
      - [drum.shaft, rope.pinion, drive.shaft]
      CONNECTIONS
    run: {stop: 9 s}
    record: {signals: ["*"], every: 10 ms}
"""


def test_torque_mode_keeps_the_tension_but_for_what_the_drum_takes_to_turn(simulate):
    """Steady: T = wanted. While the line accelerates by a: T = wanted + J a/R^2."""
    text = TENSION.replace("CONTROL", "{type: TensionTorque, wanted: 200 N, drum_radius: 0.5 m}").replace(
        "CONNECTIONS", "- [drum.speed, control.speed]\n      - [control.torque, drive.torque]"
    )
    result = simulate(text)
    assert result.at("line.tension", 0.9) == pytest.approx(200, rel=1e-3)
    assert result.at("line.tension", 4.0) == pytest.approx(200, rel=1e-3)
    assert result.at("line.tension", 1.9) == pytest.approx(200 + 50 * 0.4 / 0.25, rel=2e-2)


def test_a_tension_trim_about_a_speed_loop_settles_at_the_tension_wanted(simulate):
    """The speed loop is a PI on the rate of the drum; the trim brings the tension to 300 N while the sea end moves."""
    text = TENSION.replace(
        "CONTROL",
        "{type: TensionTrim, wanted: 300 N, gain: 0.2 mm/s/N, integral_time: 1 s, most: 0.1 m/s}\n"
        "      speed: {type: PiController, gain: 4000, integral_time: 0.2 s, low: -2000, high: 2000, period: 5 ms}",
    ).replace(
        "CONNECTIONS",
        "- [sea.v, control.line_speed]\n      - [line.tension, control.tension]\n"
        "      - [control.reference, speed.reference]\n      - [motion.v, speed.measured]\n"
        "      - [speed.command, drive.torque]",
    )
    result = simulate(text, **{"run.stop": "9 s"})
    assert result.at("line.tension", 5.8) == pytest.approx(300, rel=3e-2)
    assert result["line.tension"][-1] == pytest.approx(300, rel=3e-2)
    assert result.run["energy"]["closure"] < 1e-4


def test_a_sensor_lags_or_is_perfect(scene, simulate):
    text = """
        components:
          value: {type: SignalSource, value: {ramp: {to: 1, over: 1 s}}}
          sensor: {type: SignalLag, lag: 50 ms}
        connections: [[value.signal, sensor.value]]
        run: {stop: 0.9 s, accuracy: 1e-6}
        record: {signals: ["*"], every: 10 ms}
    """
    lagging = simulate(text)
    exact = lagging.t - 0.05 * -np.expm1(-lagging.t / 0.05)
    np.testing.assert_allclose(lagging["sensor.signal"], exact, atol=1e-6)
    perfect = simulate(text, **{"effects.sensor_lag": "off"})
    np.testing.assert_allclose(perfect["sensor.signal"], perfect.t, atol=1e-12)
    quick = simulate(text, **{"sensor.lag": "1 us"})
    np.testing.assert_allclose(quick["sensor.signal"], perfect["sensor.signal"], atol=1e-5)
    assert "sensor.told" not in scene(text, **{"effects.sensor_lag": "off"}).system.unknown_names
