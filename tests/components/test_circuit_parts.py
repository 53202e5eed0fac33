"""Electric parts of models/single_parts against the closed forms of their circuits."""

import pathlib

import numpy as np
import pytest

import fairlead

SCENES = pathlib.Path(__file__).parents[2] / "models" / "single_parts"


def run(name, **settings):
    """A scene, with other values by their dotted names."""
    result = fairlead.load(SCENES / f"{name}.yaml", set={"run.accuracy": "1e-7", **settings}).run(out=None)
    assert result.ok
    assert result.run["energy"]["closure"] < 1e-4
    return result


@pytest.mark.slow
@pytest.mark.parametrize("wire", [0.4, 3.0])
def test_a_circuit_of_second_order_rings_or_creeps(wire):
    """Battery, switch, wire and the leads of the capacitor are one resistance; below and above the critical one."""
    result = run("oscillating_circuit", **{"wire.resistance": f"{wire} ohm"})
    decay = (wire + 0.1 + 2e-3) / 2e-3
    a, b = np.roots([1, 2 * decay, 1e6]).astype(complex)
    t = np.maximum(result.t - 1e-3, 0)
    rings = 12 * (1 + np.real((b * np.exp(a * t) - a * np.exp(b * t)) / (a - b)))
    assert np.max(np.abs(result["store.voltage"] - rings)) < 5e-4  # 1 ms through the open switch: 12 uV


def test_a_diode_blocks_while_the_capacitor_drains():
    """From the last instant of a charge the voltage falls with the time constant of load and capacitor."""
    result = run("diode")
    start, end = result.at("store.voltage", 0.09), result.at("store.voltage", 0.097)
    assert end / start == pytest.approx(np.exp(-0.007 / (100 * 1e-3)), rel=1e-4)  # 1 Mohm of the diode leaks 1e-4 of it
    drop = 20 - result["store.voltage"].max()
    assert 0.7 < drop < 1.0  # threshold, and what the charging current takes
    assert result["diode.current"].min() > -1e-4


def test_an_amplifier_gives_the_voltage_of_its_signal_less_the_drop_over_its_resistance(simulate):
    """A coil on it: i = u/(R + inner) (1 - exp(-t (R + inner)/L)), and the current given is that of the coil."""
    result = simulate("""
        components:
          earth: {type: Earth}
          wanted: {type: SignalSource, value: -9}
          amplifier: {type: VoltageActuator, inner: 1 ohm}
          coil: {type: Inductor, inductance: 0.1, resistance: 2 ohm}
        connections:
          - [earth.terminal, amplifier.minus, coil.minus]
          - [amplifier.plus, coil.plus]
          - [wanted.signal, amplifier.voltage]
        run: {stop: 0.2 s, accuracy: 1e-7}
        record: {every: 1 ms, signals: [coil.current, amplifier.current]}
    """)
    assert result["coil.current"] == pytest.approx(-9 / 3 * -np.expm1(-result.t * 3 / 0.1), abs=1e-5)
    assert result["amplifier.current"] == pytest.approx(result["coil.current"], abs=1e-9)
    assert result.run["energy"]["closure"] < 1e-6
