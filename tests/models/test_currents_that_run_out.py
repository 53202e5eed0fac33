"""The current of a coil runs out through a diode: a node between megaohms turns by volts for a current of microamperes.

Where the diode conducts, its voltage follows the current by 0.1 ohm; where it blocks, by a megaohm. Each zone has the
voltage at its limit, and sends to the other: which is right is a matter of the last bits of the current.
"""

import numpy as np
import pytest

from tests.conftest import Scene

ACCURACIES = ["1e-3", "1e-4", "1e-6"]
INDUCTANCE, RESISTANCE, CLAMP, ON = 10e-3, 2.0, 60.0, 0.1  # H, ohm, V, ohm

COIL = """
    components:
      earth: {type: Earth}
      supply: {type: VoltageSource, voltage: 24 V}
      switch: {type: ElectricSwitch, open_resistance: 1e6}
      closes: {type: SignalSource, value: {pulses: {to: 1, every: 20 ms, wide: 10 ms, count: 2, start: 1 ms}}}
      coil: {type: Inductor, inductance: 10e-3, resistance: 2}
      clamp: {type: Diode, threshold: 60, resistance: 0.1, blocking_resistance: 1e6}
    connections:
      - [supply.minus, earth.terminal, coil.minus, clamp.plus]
      - [supply.plus, switch.plus]
      - [switch.minus, coil.plus, clamp.minus]
      - [closes.signal, switch.control]
    run: {stop: 40 ms}
    record: {signals: [coil.current, clamp.current]}
"""


@pytest.mark.parametrize("accuracy", ACCURACIES)
@pytest.mark.parametrize("engine", ["rodas", "ida"])
def test_a_coil_is_discharged_through_its_clamp(simulate: Scene, engine: str, accuracy: str) -> None:
    """L i' = -(R + r) i - U from the instant on at which the switch opens; the rest is what megaohms leak."""
    if engine == "ida":
        pytest.importorskip("sksundae")
    result = simulate(COIL, **{"run.accuracy": accuracy, "run.engine": engine})
    within = 12.0 * max(float(accuracy), 1e-5)
    for opens in (0.011, 0.031):
        begin, pace = result.at("coil.current", opens), INDUCTANCE / (RESISTANCE + ON)
        lasts = pace * np.log(1.0 + (RESISTANCE + ON) * begin / CLAMP)
        t = np.linspace(0.0, lasts, 9)
        rest = CLAMP / (RESISTANCE + ON)
        right = (begin + rest) * np.exp(-t / pace) - rest
        np.testing.assert_allclose(result.at("coil.current", opens + t), right, atol=within)
        assert abs(result.at("coil.current", opens + lasts + 1e-3)) < within
    assert result["clamp.current"].min() > -within
