"""Fronts of pressure in a line of sections: how high they come out (Joukowsky), and what smoothing costs."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import j0

from fairlead.errors import ModelError
from tests.components.test_hydraulics import eigenvalues

RHO, BULK, LENGTH, DIAMETER, FLOW = 870.0, 1e9, 20.0, 0.02, 1e-3
AREA = math.pi / 4 * DIAMETER**2
SOUND = math.sqrt(BULK / RHO)
STEP = RHO * SOUND * FLOW / AREA  # Pa, 29.7 bar
RISE = 13 * 4 * LENGTH / SOUND  # s; after whole periods of the first mode the opening leaves no wave
SHUT = """
    components:
      high: {{type: PressureSource, pressure: 200 bar}}
      line:
        {{type: HydraulicLine, length: 20 m, diameter: 20 mm, pressure: 200 bar, sections: {n},
         fluid: {{viscosity: 1e-9 m^2/s}}{more}}}
      draw: {{type: FlowSource, flow: {{table: [[0 s, 0], [{rise} s, 1 L/s], [2 s, 1 L/s], [{end} s, 0], [3 s, 0]]}}}}
      low: {{type: Tank}}
    connections: [[high.port, line.a], [line.b, draw.inlet], [draw.outlet, low.port]]
    run: {{stop: 2.03 s, accuracy: 1e-5}}
    record: {{every: 0.2 ms}}
"""


def overshoot(result, n):
    """Height of the front at the valve over Joukowsky's step, before the wave comes back."""
    early = (result.t > 2) & (result.t < 2 + 1.8 * LENGTH / SOUND)
    return (result[f"line.volume[{n}].pressure"][early].max() - 200e5) / STEP


def damped(smoothing):
    """The same for a half volume at the end of endless sections, by their impedance sqrt(z/y)/sqrt(1 + z y/4).

    With s in units of 2/sqrt(LC) a section has z = 2 s/(1 + 2 smoothing s) and y = 2 s. The inverse Laplace transform
    of the answer to a step is an integral along a line beside the imaginary axis.
    """
    beside, step = 0.1, 0.005
    w = np.arange(0, 2000, step)
    s = beside + 1j * w
    z, y = 2 * s / (1 + 2 * smoothing * s), 2 * s
    image = (np.sqrt(z / y) / np.sqrt(1 + z * y / 4) / s).real
    times = np.linspace(1, 8, 141)
    return max(2 / math.pi * math.exp(beside * t) * np.trapezoid(image * np.cos(w * t), dx=step) for t in times)


@pytest.mark.parametrize("n", [6, 12])
def test_a_front_in_sections_is_as_high_as_the_bessel_function_says(simulate, n):
    """A half volume at the end of a ladder answers a step with the integral of J0, whose greatest value is 1.47."""
    want = quad(j0, 0, 2.404826)[0]
    assert want == pytest.approx(1.470, abs=1e-3)
    assert overshoot(simulate(SHUT.format(rise=RISE, n=n, more="", end=2.000001)), n) == pytest.approx(want, abs=5e-3)


@pytest.mark.parametrize("smoothing", [0.3, 0.7, 1.0])
def test_smoothing_takes_the_overshoot_that_its_page_says(simulate, smoothing):
    """Against the impedance of the ladder; energy still balances, for what is damped is heat."""
    result = simulate(SHUT.format(rise=RISE, n=10, more=f", smoothing: {smoothing}", end=2.000001))
    assert overshoot(result, 10) == pytest.approx(damped(smoothing), abs=5e-3)
    assert overshoot(result, 10) == pytest.approx({0.3: 1.20, 0.7: 1.03, 1.0: 1.0}[smoothing], abs=5e-3)
    assert result.run["energy"]["closure"] < 1e-4


def test_a_valve_that_shuts_in_three_sections_needs_no_smoothing(simulate):
    end = 2 + 3 * LENGTH / 10 / SOUND
    assert overshoot(simulate(SHUT.format(rise=RISE, n=10, more="", end=end)), 10) < 1.09


def test_smoothing_damps_the_first_mode_by_what_its_page_says(scene):
    """Open at one end, closed at the other: smoothing sin(pi/(4 n))."""
    text = """
        components:
          open: {type: Tank}
          line:
            {type: HydraulicLine, length: 10 m, diameter: 20 mm, sections: 20, smoothing: 0.5,
             fluid: {viscosity: 1e-9 m^2/s}, effects: {cavitation: off}}
        connections: [[open.port, line.a]]
        run: {stop: 1 s}
    """
    values = eigenvalues(scene(text))
    first = min(values[values.imag > 1.0], key=abs)
    assert -first.real / abs(first) == pytest.approx(0.5 * math.sin(math.pi / 80), rel=2e-3)
    assert abs(first) == pytest.approx(math.pi / 2 * SOUND / 10, rel=1e-3)


def test_steady_flow_does_not_depend_on_smoothing(simulate):
    """The law of Hagen and Poiseuille."""
    text = """
        components:
          high: {type: PressureSource, pressure: 10 bar}
          line: {type: HydraulicLine, length: 4 m, diameter: 10 mm, sections: 4, smoothing: 0.7}
          low: {type: Tank}
        connections: [[high.port, line.a], [line.b, low.port]]
        run: {stop: 10 s}
    """
    resistance = 128 * RHO * 40e-6 * 4 / (math.pi * 0.01**4)
    assert simulate(text)["line.column[1].flow"][-1] == pytest.approx(9e5 / resistance, rel=1e-4)


def test_who_has_not_decided_is_told(scene):
    """And who has, or has one section, is not."""
    model = scene(SHUT.format(rise=RISE, n=10, more="", end=2.1))
    (said,) = [one for one in map(str, model.check()) if "line.sections" in one]
    assert "47 %" in said
    assert "smoothing: 0.7" in said
    for n, more in ((10, ", smoothing: 0"), (1, "")):
        model = scene(SHUT.format(rise=RISE, n=n, more=more, end=2.1))
        assert not [one for one in map(str, model.check()) if "line.sections" in one]
    with pytest.raises(ModelError, match=r"smoothing = 2 is out of range"):
        scene(SHUT.format(rise=RISE, n=10, more=", smoothing: 2", end=2.1)).check()
