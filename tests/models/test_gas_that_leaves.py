"""An accumulator that drains over a port without a volume: the pressure there follows at once, in a curved law.

    dV/dt = Q,   p = p_0 (V_0/V)^n,   p - p_low = d_neck(Q) + d_orifice(Q)

Solved by scipy with the drops of the flow (fluid.py); the flow at each instant is found by bisection.
"""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest
from fairlead.components.hydraulics.fluid import drop_of
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from tests.conftest import Scene

NECK, ORIFICE = (0.62 * area * sqrt(2 / 870) for area in (pi * 0.03**2 / 4, 2e-6))
CRITICAL, LEFT = 1e5, 2.5

DRAINED = """
    components:
      gas: {{type: Accumulator, volume: 1 L, precharge: 3 MPa, pressure: 4 MPa, exponent: 1.2}}
      o: {{type: Orifice, area: 2 mm^2}}
      low: {{type: PressureSource, pressure: 2 MPa}}
    connections: [[gas.port, o.a], [o.b, low.port]]
    run: {{stop: 2.5 s, engine: {engine}, accuracy: {accuracy}}}
"""


def gas_volume(times: np.ndarray) -> np.ndarray:
    """Volume of the gas [m^3] at the times [s]."""

    def flow(_: float, volume: np.ndarray) -> float:
        over = 3e6 * (1e-3 / volume[0]) ** 1.2 - 2e6
        through = lambda q: drop_of(NECK, q, CRITICAL) + drop_of(ORIFICE, q, CRITICAL) - over  # noqa: E731
        return brentq(through, 0.0, 1e-3, xtol=1e-18)

    start = [1e-3 * (3 / 4) ** (1 / 1.2)]
    return solve_ivp(flow, (0.0, times[-1]), start, t_eval=times, rtol=1e-11, atol=1e-15, method="DOP853").y[0]


@pytest.mark.parametrize("accuracy", [1e-3, 1e-5])
@pytest.mark.parametrize("engine", ["rodas", "stepping", "ida"])
def test_the_volume_of_the_gas_is_that_of_the_equation(simulate: Scene, engine: str, accuracy: float) -> None:
    result = simulate(DRAINED.format(engine=engine, accuracy=accuracy))
    times = np.linspace(0.0, LEFT, 11)
    found, right = result.at("gas.gas", times), gas_volume(times)
    assert np.max(np.abs(found - right)) <= accuracy * right[-1]
