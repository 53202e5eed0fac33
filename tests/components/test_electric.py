"""Electric drives against closed forms: no-load speed, stall, time constants, limits of current and voltage."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

DC = """
    components:
      earth: {type: Earth}
      battery: {type: VoltageSource, voltage: 48 V, inner: 1e-6 ohm}
      motor: {type: DcMotor, resistance: 0.5 ohm, constant: 0.12 N*m/A, inductance: 1e-6 V*s/A}
      rotor: {type: Inertia, moment: 2e-3 kg*m^2, speed: 0 rad/s}
    connections:
      - [earth.terminal, battery.minus, motor.minus]
      - [battery.plus, motor.plus]
      - [motor.shaft, rotor.shaft]
    run: {stop: 0.5 s, accuracy: 1e-6}
    record: {signals: ["*"], every: 5 ms}
"""
U, R, K, J = 48.0, 0.5, 0.12, 2e-3


def test_a_dc_motor_runs_up_to_its_no_load_speed_with_its_time_constant(simulate):
    """w = U/K (1 - exp(-t/tau)), tau = J R/K^2, for an inductance that does not matter."""
    result = simulate(DC)
    tau = J * R / K**2
    np.testing.assert_allclose(result["rotor.speed"], U / K * -np.expm1(-result.t / tau), atol=1e-4 * U / K)
    assert result["rotor.speed"][-1] == pytest.approx(U / K * -np.expm1(-0.5 / tau), rel=1e-4)
    assert result.run["energy"]["closure"] < 1e-6
    charged = J * result["rotor.speed"][-1] ** 2 / 2
    assert result.run["energy"]["dissipated"] == pytest.approx(charged, rel=2e-3)  # half is lost, run up without load


def test_a_dc_motor_stalls_with_k_u_over_r(simulate):
    text = DC.replace(
        "    connections:",
        """      brake: {type: Brake, radius: 1 m, curve: 1, normal_force: 50 N, method: hold}
    connections:
      - [rotor.shaft, brake.shaft]""",
    )
    result = simulate(text)
    assert result["motor.torque"][-1] == pytest.approx(K * U / R, rel=1e-4)
    assert result["brake.torque"][-1] == pytest.approx(K * U / R, rel=1e-4)
    assert abs(result["rotor.speed"][-1]) < 1e-12


def test_the_current_of_a_stalled_motor_rises_with_l_over_r(simulate):
    text = DC.replace("1e-6 V*s/A", "5e-3 V*s/A").replace("2e-3 kg", "1e9 kg")
    result = simulate(text, **{"run.stop": "0.05 s"})
    np.testing.assert_allclose(result["motor.current"], U / R * -np.expm1(-result.t * R / 5e-3), atol=1e-4 * U / R)


def test_without_the_current_loop_a_dc_motor_is_its_limit_and_has_no_current_as_unknown(scene, simulate):
    off = {"motor.effects.current_loop": "off"}
    assert "motor.flowing" not in scene(DC, **off).system.unknown_names
    times = np.linspace(0.01, 0.5, 50)
    ends = [simulate(DC, **settings).at("rotor.speed", times) for settings in ({"motor.inductance": "1e-9 V*s/A"}, off)]
    np.testing.assert_allclose(*ends, atol=1e-4 * U / K)


LIMITED = """
    components:
      command:
        type: SignalSource
        value: {table: {t: [0, 0.2, 0.2001, 0.4, 0.4001, 0.6], y: [100, 100, -100, -100, 20, 20]}}
      drive: {type: DcDrive, resistance: 0.5 ohm, constant: 0.12 N*m/A, inductance: 1e-3 V*s/A, most_voltage: 48 V,
              most_current: 30 A}
      rotor: {type: Inertia, moment: 2e-3 kg*m^2, speed: 0 rad/s}
    connections: [[command.signal, drive.command], [drive.shaft, rotor.shaft]]
    run: {stop: 1.4 s, accuracy: 1e-6}
    record: {signals: [drive.*, rotor.speed]}
"""


def test_an_amplifier_keeps_to_its_current_and_its_voltage(simulate):
    result = simulate(LIMITED)
    assert np.abs(result["drive.current"]).max() == pytest.approx(30, rel=1e-6)
    assert np.abs(result["drive.voltage"]).max() <= 48 + 1e-6
    at = result.at("rotor.speed", [0.05, 0.1])
    assert at[1] - at[0] == pytest.approx(0.05 * 30 * K / J, rel=1e-6)  # constant torque while limited
    assert {event.zone_to for event in result.events} >= {"forward", "backward", "upper"}
    assert result["rotor.speed"][-1] == pytest.approx(20 / K, rel=1e-3)
    assert result.run["energy"]["closure"] < 1e-6


OVERRUN = """
    components:
      command: {{type: SignalSource, value: {command}}}
      drive: {{type: DcDrive, resistance: 1 ohm, constant: 0.1 N*m/A, inductance: 1e-3 V*s/A, most_voltage: {volts} V,
              most_current: {amperes} A}}
      rotor: {{type: Inertia, moment: {moment} kg*m^2, speed: 0 rad/s}}
      load: {{type: TorqueSource, torque: {load}}}
    connections: [[command.signal, drive.command], [drive.shaft, rotor.shaft, load.shaft]]
    run: {{stop: 3 s, accuracy: 1e-5}}
    record: {{every: 5 ms, signals: [drive.*, rotor.speed]}}
"""


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize(("sign", "command", "size"), [(1, 12, 1), (-1, 12, 1), (1, 0, 1), (1, -40, 1), (1, 12, 50)])
def test_a_load_that_overruns_an_amplifier_has_all_its_voltage_against_it_and_no_more(
    simulate, engine, sign, command, size
):
    scene = OVERRUN.format(
        command=f"{{constant: {sign * command * size}}}", volts=24 * size, amperes=10 * size, moment=1e-3,
        load=f"{{ramp: {{to: {sign * 3 * size} N*m, over: 2 s}}}}",
    )  # fmt: skip
    result = simulate(scene, **{"run.engine": engine})
    assert np.abs(result["drive.voltage"]).max() <= 24 * size * (1 + 1e-6)
    # 3 N*m take 30 A; whatever is asked for, the limiter wants less of it and has 24 V: K w = u + R i.
    assert result["drive.current"][-1] == pytest.approx(-30 * sign * size, rel=1e-3)
    assert result["rotor.speed"][-1] == pytest.approx(sign * (24 + 30) * size / 0.1, rel=1e-3)
    assert result.run["energy"]["closure"] < 1e-5


@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_an_amplifier_to_and_fro_is_that_of_its_equations(simulate, engine):
    scene = OVERRUN.format(
        command="{sine: {amplitude: 40, frequency: 1 Hz}}", volts=24, amperes=10, moment=1e-3,
        load="{sine: {amplitude: 4 N*m, frequency: 0.4 Hz}}",
    )  # fmt: skip
    result = simulate(scene, **{"run.engine": engine})

    def slopes(t, y):
        speed, current = y
        needed = current + 0.1 * speed
        asked = np.clip(40 * np.sin(2 * np.pi * t), needed + 100 * (-10 - current), needed + 100 * (10 - current))
        return [(0.1 * current + 4 * np.sin(0.8 * np.pi * t)) / 1e-3, (np.clip(asked, -24, 24) - needed) / 1e-3]

    exact = solve_ivp(slopes, (0, 3), [0, 0], "LSODA", dense_output=True, rtol=1e-9, atol=1e-9, max_step=1e-3)
    for name, right in zip(("rotor.speed", "drive.current"), exact.sol(result.t), strict=True):
        assert result[name] == pytest.approx(right, abs=1e-4 * np.abs(right).max()), name
    assert {event.zone_to for event in result.events} == {"in_range", "upper", "lower", "forward", "backward"}


PM = """
    components:
      command: {type: SignalSource, value: {table: {t: [0, 0.01, 0.5, 0.51], y: [0, 12, 12, -3]}}}
      drive: {type: PmDrive, constant: 0.4 N*m/A, most_current: 25 A, inertia: 0.02 kg*m^2, resistance: 0.3 ohm,
              inductance: 2 mV*s/A, lag: 2 ms, most_voltage: 200 V}
    connections: [[command.signal, drive.command]]
    initial: {drive.rotor.speed: 5 rad/s}
    run: {stop: 1 s, accuracy: 1e-6}
    record: {signals: [drive.*]}
"""


def test_a_pm_drive_gives_its_torque_within_its_current(simulate):
    result = simulate(PM)
    assert result.at("drive.torque", 0.4) == pytest.approx(0.4 * 25, rel=1e-6)  # 12 N m would take 30 A
    assert result["drive.torque"][-1] == pytest.approx(-3, rel=1e-6)
    gained = np.diff(result.at("drive.speed", [0.2, 0.4]))[0]
    assert gained == pytest.approx(0.2 * 10 / 0.02, rel=1e-6)
    assert result.run["energy"]["closure"] < 1e-6


def test_the_winding_within_its_voltage_is_an_ideal_loop_with_its_lag(simulate):
    """The controller cancels the pole of the winding, so the two must agree to the tolerance of the run."""
    times = np.linspace(0.005, 1.0, 200)
    ends = [simulate(PM, **{"drive.effects.winding": word, "drive.most_voltage": "2 kV"}).at("drive.current", times)
            for word in ("on", "off")]  # fmt: skip
    np.testing.assert_allclose(*ends, atol=2e-4)


def test_the_voltage_limits_the_speed_at_which_a_torque_is_to_be_had(simulate):
    """Held at its voltage the motor comes to the speed U/K, where it has no torque left."""
    text = PM.replace("[0, 0.01, 0.5, 0.51]", "[0, 0.01, 8, 9]")
    result = simulate(text, **{"drive.effects.winding": "on", "run.stop": "6 s"})
    assert result["drive.speed"][-1] == pytest.approx(200 / 0.4, rel=1e-3)
    assert any(event.zone_to == "upper" and event.component == "drive.motor" for event in result.events)
    assert result.run["energy"]["closure"] < 1e-6


def test_without_current_loop_the_current_is_the_one_asked_for(scene, simulate):
    off = {"drive.effects.current_loop": "off"}
    assert scene(PM, **off).system.unknown_names[:2] == ["drive.rotor.angle", "drive.rotor.speed"]
    assert not [name for name in scene(PM, **off).system.unknown_names if "motor" in name]
    times = np.linspace(0.02, 1.0, 50)
    ends = [simulate(PM, **settings).at("drive.speed", times) for settings in ({"drive.lag": "1 us"}, off)]
    np.testing.assert_allclose(*ends, atol=2e-3)  # a lag of 1 us in torque is 0.5 ms/s^2 * 1 us * 1000 rad/s^2 behind
