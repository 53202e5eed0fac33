"""Unknowns without inertia are recorded where their law balances: what flows through a stiff source, and sums."""

import numpy as np
import pytest

import fairlead
from tests.conftest import Scene

ENGINES = ["rodas", "stepping"]
ACCURACIES = ["1e-3", "1e-5"]

SOURCE = """
    components:
      earth: {type: Earth}
      mains: {type: VoltageSource, voltage: {sine: {amplitude: 325 V, frequency: 50 Hz}}, inner: 1 mohm}
      load: {type: Resistor, resistance: 100 ohm}
    connections:
      - [mains.minus, earth.terminal, load.minus]
      - [mains.plus, load.plus]
    run: {stop: 0.1 s}
    record: {EVERYsignals: [mains.current, load.current]}
    limits: {mains.current: {below: 3.26 A}}
"""
OIL = """
    components:
      tank: {type: Tank}
      wanted: {type: SignalSource, value: {sine: {amplitude: 50e5, offset: 100e5, frequency: 5 Hz}}}
      pump: {type: PressureActuator, conductance: 1e-7 m^3/s/Pa}
      narrow: {type: Leak, conductance: 1e-11 m^3/s/Pa}
      wide: {type: Leak, conductance: 1e-7 m^3/s/Pa}
    connections:
      - [wanted.signal, pump.wanted]
      - [pump.port, wide.a]
      - [wide.b, narrow.a]
      - [narrow.b, tank.port]
    run: {stop: 1 s}
    record: {every: 10 ms, signals: [pump.flow, narrow.flow]}
"""
TENSIOMETER = """
    components:
      rope: {type: Cable, length: 16 m, element: 0.2 m, start: -4 m, tension: 1 kN, mass: 0.8 kg/m, stiffness: 500 kN}
      route:
        type: Route
        stations:
          - {type: Winch, radius: 0.4 m}
          - {name: cell, type: Tensiometer, start: 5 m, length: 0.6 m}
      drive: {type: MotionSource, velocity: 0}
      end: {type: MotionSource, position: {constant: 12 m, sine: {amplitude: 5 mm, frequency: FREQUENCY}}}
    connections:
      - [rope.path, route.path]
      - [drive.flange, route.winch.rim]
      - [end.flange, rope.outboard]
    run: {stop: 2 s, accuracy: 1e-3}
    record: {every: 5 ms, signals: ["rope.node[*].x", "rope.line[*].tension", route.cell.tension]}
"""
RECTIFIER = SOURCE.replace("load: {type", "diode: {type: Diode}\n      load: {type").replace(
    "- [mains.plus, load.plus]", "- [mains.plus, diode.plus]\n      - [diode.minus, load.plus]"
)
PULSES = SOURCE.replace("frequency: 50 Hz}", "frequency: 50 Hz}, PULSED").replace(
    "PULSED", "pulses: {to: 30 V, every: 3 ms, wide: 1 ms, count: 30, start: 0.7 ms}"
)
ORIFICES = """
    components:
      tank: {type: Tank}
      wanted: {type: SignalSource, value: {sine: {amplitude: 50e5, offset: OFFSET, frequency: 5 Hz}}}
      pump: {type: PressureActuator, conductance: 1e-7 m^3/s/Pa}
      first: {type: Orifice, area: 3 mm^2}
      second: {type: Orifice, area: 1 mm^2}
    connections:
      - [wanted.signal, pump.wanted]
      - [pump.port, first.a]
      - [first.b, second.a]
      - [second.b, tank.port]
    run: {stop: 1 s}
    record: {every: 10 ms, signals: [pump.flow, first.flow, second.flow]}
"""
DAMPERS = """
    components:
      ground: {type: Ground}
      drive: {type: MotionSource, velocity: {sine: {amplitude: 1 m/s, frequency: 2 Hz}}}
      hard: {type: Damper, damping: 1e6 N*s/m}
      soft: {type: Damper, damping: 10 N*s/m}
    connections:
      - [drive.flange, hard.a]
      - [hard.b, soft.a]
      - [soft.b, ground.flange]
    run: {stop: 1 s}
    record: {signals: [hard.tension, soft.tension]}
"""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("accuracy", ACCURACIES)
@pytest.mark.parametrize("every", ["", "every: 1 ms, "])
def test_the_current_of_a_stiff_source_is_that_of_its_load(simulate: Scene, engine, accuracy, every) -> None:
    """An accuracy of 1e-3 allows the node an error of 0.3 V, which is 300 A on 1 mohm."""
    result = simulate(SOURCE.replace("EVERY", every), **{"run.engine": engine, "run.accuracy": accuracy})
    right = 325.0 * np.sin(2.0 * np.pi * 50.0 * result.t) / 100.001
    np.testing.assert_allclose(result["mains.current"], right, atol=1e-6)
    np.testing.assert_allclose(result["load.current"], right, atol=1e-6)
    assert result.extremes("mains.current").highest == pytest.approx(325.0 / 100.001, rel=2 * float(accuracy))


def beside_blocks(text: str, blocks: int) -> str:
    """The same scene beside blocks on a belt, which `stepping` takes with switches inside its steps."""
    parts = ["      belt: {type: MotionSource, velocity: 0.1 m/s}"]
    joins = ["      - [belt.flange, " + ", ".join(f"pad{k}.a" for k in range(blocks)) + "]"]
    for k in range(blocks):
        parts.append(f"      block{k}: {{type: Mass, mass: 1 kg, velocity: {0.2 * (k % 3)} m/s}}")
        curve = "{curve: coulomb, stiction: 0.4, coulomb: 0.3}"
        parts.append(f"      pad{k}: {{type: Contact, normal_force: {10 + k} N, curve: {curve}}}")
        joins.append(f"      - [block{k}.flange, pad{k}.b]")
    text = text.replace("    connections:\n", "\n".join(parts) + "\n    connections:\n", 1)
    return text.replace("    run:", "\n".join(joins) + "\n    run:", 1)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("every", ["", "every: 1 ms, "])
@pytest.mark.parametrize("kind", ["a diode", "pulses", "pulses beside 50 blocks", "twice 2 ohm", "twice 2.0002 ohm"])
def test_so_it_is_on_both_sides_of_switches_and_whatever_else_moves(simulate: Scene, engine, every, kind) -> None:
    """All rows: before and after a switch of a diode, a jump in time, steps in which contacts switch, other units."""
    text = {
        "a diode": RECTIFIER, "pulses": PULSES, "pulses beside 50 blocks": beside_blocks(PULSES, 50),
        "twice 2 ohm": SOURCE.replace("1 mohm", "2 ohm").replace("100 ohm", "2 ohm"),
        "twice 2.0002 ohm": SOURCE.replace("1 mohm", "2.0002 ohm").replace("100 ohm", "2.0002 ohm"),
    }[kind].replace("    limits: {mains.current: {below: 3.26 A}}\n", "")  # fmt: skip
    result = simulate(text.replace("EVERY", every), **{"run.engine": engine, "run.accuracy": "1e-3"})
    size = np.abs(result["load.current"]).max()
    np.testing.assert_allclose(result["mains.current"], result["load.current"], atol=1e-6 * size)
    assert result.extremes("mains.current").highest == pytest.approx(result.extremes("load.current").highest, rel=1e-6)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("offset", ["100e5", "1e5"])
@pytest.mark.parametrize("accuracy", ACCURACIES)
def test_what_flows_through_orifices_is_one_flow_also_where_it_turns_round(
    simulate: Scene, engine, offset, accuracy
) -> None:
    """C_d A sqrt(2/rho) p/(p^2 + p_cr^2)^(1/4) in both; its slope changes many times on the way through zero."""
    result = simulate(ORIFICES.replace("OFFSET", offset), **{"run.engine": engine, "run.accuracy": accuracy})
    size = np.abs(result["second.flow"]).max()
    np.testing.assert_allclose(result["pump.flow"], result["second.flow"], atol=1e-6 * size)
    np.testing.assert_allclose(result["first.flow"], result["second.flow"], atol=1e-6 * size)


@pytest.mark.parametrize("engine", ENGINES)
def test_dampers_in_series_have_one_force(simulate: Scene, engine: str) -> None:
    result = simulate(DAMPERS, **{"run.engine": engine, "run.accuracy": "1e-3"})
    right = np.sin(2.0 * np.pi * 2.0 * result.t) / (1e-6 + 0.1)
    np.testing.assert_allclose(np.abs(result["hard.tension"]), np.abs(right), atol=1e-7)
    np.testing.assert_allclose(np.abs(result["soft.tension"]), np.abs(right), atol=1e-7)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("accuracy", ACCURACIES)
def test_so_is_the_flow_of_a_stiff_pump(simulate: Scene, engine: str, accuracy: str) -> None:
    result = simulate(OIL, **{"run.engine": engine, "run.accuracy": accuracy})
    pressure = 100e5 + 50e5 * np.sin(2.0 * np.pi * 5.0 * result.t)
    right = (pressure - 1e5) / (1e11 + 1e7 + 1e7)  # the tank is at 1 bar
    np.testing.assert_allclose(result["pump.flow"], right, rtol=1e-6)
    np.testing.assert_allclose(result["narrow.flow"], right, rtol=1e-6)


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize("frequency", ["1 Hz", "4 Hz"])
def test_a_tensiometer_tells_the_mean_of_the_elements_in_it(simulate: Scene, engine: str, frequency: str) -> None:
    """Of the line in it, which moves by 5 mm, elements by their share: the mean of the tensions over 5 to 5.6 m."""
    result = simulate(TENSIOMETER.replace("FREQUENCY", frequency), **{"run.engine": engine})
    nodes = result.elements("rope.node[*].x").values
    tensions = result.elements("rope.line[*].tension").values
    inside = np.clip(nodes, 5.0, 5.6)
    length = np.diff(inside, axis=1)
    mean = (length * tensions[:, :]).sum(axis=1) / length.sum(axis=1)
    np.testing.assert_allclose(result["route.cell.tension"], mean, atol=2.0)  # the accuracy is 1 N


def test_blocks_that_rest_are_not_shown_to_creep_by_what_rounding_says_of_their_law() -> None:
    """Exact hold has no slip; a speed of the order of 0.1 m/s is known to 1e-17 m/s.

    A thousandth of the rod weighs so little that its speed follows the damping of its neighbours within a step. Of a
    block at rest the residual is rounding, and says nothing of how stiff the law is.
    """
    result = fairlead.load("hundred_blocks", set={"blocks": "1000", "run.stop": "0.4 s"}).run(out=None)
    assert result.run["worst_creep"]["value"] < 1e-16
