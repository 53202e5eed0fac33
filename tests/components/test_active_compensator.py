"""An active heave compensator beside an integration of its own equation, which knows no cylinder, gas part or limiter.

    m x'' = area (p - 1 bar) + command - load      p gas^n = constant      gas = gas(0) + area (x - x(0) - body)

with the command cut off at what the active cylinder can. The parts have a way between oil and gas (`neck`), which the
equation has not: its loss falls with the square of its area, and the wider it is, the nearer both are.
"""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from tests.conftest import Scene

SCENE = """
    components:
      barrel: {{type: MotionSource, position: {{sine: {{amplitude: 0.3 m, frequency: 0.2 Hz}}}}}}
      unit: {{type: HeaveCompensator, bore_diameter: 200 mm, stroke: 3 m, pressure: 40 bar, gas_volume: 0.8 m^3,
             precharge: 25 bar, neck: {neck} m, mass: 300 kg, position: 1.5 m, most: 2 kN, effects: {{active: on}}}}
      load: {{type: ForceSource, force: -122 kN}}
      asked: {{type: SignalSource, value: {{sine: {{amplitude: 3e3, frequency: 0.5 Hz}}}}}}
    connections: [[barrel.flange, unit.body], [unit.rod, load.flange], [asked.signal, unit.command]]
    run: {{stop: 3 s, accuracy: 1e-8}}
    record: {{every: 20 ms}}
"""
AREA, EXPONENT, AIR, START = np.pi * 0.1**2, 1.2, 1e5, 40e5


def body(t: float) -> float:
    return 0.3 * np.sin(2 * np.pi * 0.2 * t)


def rates(t: float, y: np.ndarray) -> list[float]:
    begins = 0.8 * (25e5 / START) ** (1 / EXPONENT)
    pressure = START * (begins / (begins + AREA * (y[0] - 1.5 - body(t)))) ** EXPONENT
    command = np.clip(3e3 * np.sin(2 * np.pi * 0.5 * t), -2e3, 2e3)
    return [y[1], (AREA * (pressure - AIR) + command - 122e3) / 300.0]


@pytest.mark.slow
def test_its_travel_comes_to_that_of_the_equation_as_the_way_between_oil_and_gas_gets_wide(simulate: Scene) -> None:
    t = np.linspace(0, 3, 151)
    exact = solve_ivp(rates, (0, 3), [1.5, 0.0], method="DOP853", rtol=1e-11, atol=1e-12, t_eval=t, max_step=0.01)
    wanted = exact.y[0] - body(t)
    assert np.ptp(wanted) > 1.0
    off = [np.abs(simulate(SCENE.format(neck=neck)).at("unit.travel", t) - wanted).max() for neck in (0.8, 1.6, 3.2)]
    assert off[2] < 0.005
    assert off[0] / off[1] == pytest.approx(4, rel=0.1)
    assert off[1] / off[2] == pytest.approx(4, rel=0.1)


def test_its_gas_and_its_force_are_those_of_the_equation_along_its_own_travel(simulate: Scene) -> None:
    result = simulate(SCENE.format(neck=3.2))
    begins = 0.8 * (25e5 / START) ** (1 / EXPONENT)
    gas = begins + AREA * (result["unit.travel"] - 1.5)
    assert result["unit.gas"] == pytest.approx(gas, rel=2e-5)
    assert result["unit.gas_pressure"] == pytest.approx(START * (begins / result["unit.gas"]) ** EXPONENT, rel=1e-6)
    assert result["unit.limit.signal"] == pytest.approx(np.clip(3e3 * np.sin(np.pi * result.t), -2e3, 2e3), abs=1e-6)
