"""A current that runs out leaves diodes in a row together: no single switch leads from one right pattern to the other.

n diodes in a row are one diode of n times the threshold and the resistances. A bridge of switches with a motor behind
it lets its current run out through two diodes.
"""

import pytest

SOURCE = "{type: VoltageSource, voltage: {sine: {amplitude: 100 V, frequency: 50 Hz}}}"
BRIDGE = """
    components:
      earth: {type: Earth}
      battery: {type: VoltageSource, voltage: 48 V, inner: 0.05 ohm}
      NAME1: {type: ElectricSwitch}
      NAME2: {type: ElectricSwitch}
      NAME3: {type: ElectricSwitch}
      NAME4: {type: ElectricSwitch}
      d1: {type: Diode}
      d2: {type: Diode}
      d3: {type: Diode}
      d4: {type: Diode}
      motor: {type: DcMotor, resistance: 0.5 ohm, constant: 0.1 N*m/A, inductance: 2e-3 H}
      rotor: {type: Inertia, moment: 2e-3 kg*m^2, speed: 0}
      brake: {type: Brake, radius: 0.1 m, normal_force: 5 N, curve: 0.3}
      forth: {type: SignalSource, value: {pulses: {to: 1, every: 0.2 s, wide: 60 ms, count: 3, start: 10 ms}}}
      back: {type: SignalSource, value: {pulses: {to: 1, every: 0.2 s, wide: 50 ms, count: 3, start: 0.1 s}}}
    connections:
      - [battery.minus, earth.terminal, NAME2.minus, NAME4.minus, d2.plus, d4.plus]
      - [battery.plus, NAME1.plus, NAME3.plus, d1.minus, d3.minus]
      - [NAME1.minus, d1.plus, NAME2.plus, d2.minus, motor.plus]
      - [NAME3.minus, d3.plus, NAME4.plus, d4.minus, motor.minus]
      - [forth.signal, NAME1.control, NAME4.control]
      - [back.signal, NAME2.control, NAME3.control]
      - [motor.shaft, rotor.shaft, brake.shaft]
    run: {stop: 0.6 s, engine: ENGINE, accuracy: ACCURACY}
    record: {signals: [rotor.speed, motor.current]}
"""


def in_a_row(n: int, *, turned: bool, engine: str, accuracy: float) -> str:
    values = f"threshold: {0.9 / n} V, resistance: {0.01 / n} ohm, blocking_resistance: {1e6 / n}"
    parts = [f"d{k}: {{type: Diode, {values}}}" for k in range(n)]
    joints = [f"[d{k}.minus, d{k + 1}.plus]" for k in range(n - 1)]
    return "\n".join([
        "components:", "  earth: {type: Earth}", f"  source: {SOURCE}",
        *(f"  {part}" for part in (parts[::-1] if turned else parts)),
        "  coil: {type: Inductor, inductance: 20e-3 H}", "  load: {type: Resistor, resistance: 5 ohm}",
        "connections:", "  - [source.minus, earth.terminal, load.minus]", "  - [source.plus, d0.plus]",
        *(f"  - {joint}" for joint in joints), f"  - [d{n - 1}.minus, coil.plus]", "  - [coil.minus, load.plus]",
        f"run: {{stop: 0.1 s, engine: {engine}, accuracy: {accuracy}}}", "record: {signals: [coil.current]}",
    ])  # fmt: skip


@pytest.mark.parametrize("accuracy", [1e-2, 1e-4])
@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
@pytest.mark.parametrize("n", [2, 5])
def test_diodes_in_a_row_are_one_diode(simulate, n, engine, accuracy):
    alone = simulate(in_a_row(1, turned=False, engine="rodas", accuracy=1e-7))
    times = [0.004, 0.0155, 0.03, 0.0437, 0.0955]
    for turned in (False, True):
        row = simulate(in_a_row(n, turned=turned, engine=engine, accuracy=accuracy))
        assert [row.at("coil.current", t) for t in times] == pytest.approx(
            [alone.at("coil.current", t) for t in times], abs=14.0 * 10.0 * accuracy
        )


@pytest.mark.parametrize("names", ["s", "zone"])
def test_the_current_of_a_motor_runs_out_through_a_bridge(simulate, names):
    """Beside `ida`, which is another engine with other steps."""
    text = BRIDGE.replace("NAME", names)
    other = simulate(text.replace("ENGINE", "ida").replace("ACCURACY", "1e-5"))
    for accuracy in (1e-2, 1e-3, 3e-4, 1e-4):
        result = simulate(text.replace("ENGINE", "rodas").replace("ACCURACY", str(accuracy)))
        assert result["rotor.speed"][-1] == pytest.approx(other["rotor.speed"][-1], rel=5.0 * accuracy)
