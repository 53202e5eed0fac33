"""Electrical, hydraulic and rotational ports, with classes as a user writes them in a file of his own."""

import numpy as np
import pytest

from fairlead.errors import ModelError

ELECTRICAL = """
    class Earth(Component):
        terminal = Electrical("the terminal")
        def law(p, terminal):
            return (0,)
        def prescribes():
            return {"terminal": None}

    class Supply(Component):
        plus = Electrical("the terminal that is fed")
        current = Parameter("A")
        def law(p, plus):
            return Law(plus=-p.current, supplied=p.current * plus.voltage)

    class Battery(Component):
        plus, minus = Electrical(), Electrical()
        voltage = Parameter("V")
        current = Unknown("A", "what the battery gives")
        given = Output("A")
        def law(p, plus, minus, current):
            balance = plus.voltage - minus.voltage - p.voltage
            return Law(plus=-current, minus=current, current=balance, given=current, supplied=p.voltage * current)

    class Resistor(Component):
        a, b = Electrical(), Electrical()
        resistance = Parameter("V/A", above=0)
        drop = Output("V")
        def law(p, a, b):
            drop = a.voltage - b.voltage
            current = drop / p.resistance
            return Law(a=current, b=-current, drop=drop, dissipated=drop * current)

    class Capacitor(Component):
        terminal = Electrical("the plate that is not earthed")
        capacity = Parameter("A*s/V", above=0)
        voltage = Output("V")
        def law(p, terminal):
            return Law(terminal=0, voltage=terminal.voltage, stored=p.capacity * terminal.voltage**2 / 2)
        def inertia(p):
            return {"terminal": p.capacity}
"""

CHARGING = """
    components:
      earth: {type: Earth}
      battery: {type: Battery, voltage: 12 V}
      resistor: {type: Resistor, resistance: 1e3 V/A}
      capacitor: {type: Capacitor, capacity: 2e-4 A*s/V}
    connections:
      - [earth.terminal, battery.minus]
      - [battery.plus, resistor.a]
      - [resistor.b, capacitor.terminal]
    run: {stop: 1 s, accuracy: 1e-8}
"""


def test_a_capacitor_charges_through_a_resistor(simulate, library):
    """V = V0 (1 - exp(-t/RC)); any book on circuits. Half of what the battery gives is lost in the resistor."""
    result = simulate(CHARGING, libraries=(library(ELECTRICAL),))
    time_constant = 1e3 * 2e-4
    np.testing.assert_allclose(result["capacitor.voltage"], 12 * -np.expm1(-result.t / time_constant), atol=1e-6)
    charged = 12 * 2e-4 * -np.expm1(-1 / time_constant)
    assert result.run["energy"]["supplied"] == pytest.approx(12 * charged, rel=1e-6)
    np.testing.assert_allclose(result["battery.given"][0], 12 / 1e3, rtol=1e-9)


def test_a_node_without_capacity_has_the_potential_that_balances_it(simulate, library):
    """Two resistors in series divide the voltage as their resistances; the node between is algebraic."""
    text = """
        components:
          earth: {type: Earth}
          battery: {type: Battery, voltage: 12 V}
          upper: {type: Resistor, resistance: 100 V/A}
          lower: {type: Resistor, resistance: 300 V/A}
        connections:
          - [earth.terminal, battery.minus, lower.b]
          - [battery.plus, upper.a]
          - [upper.b, lower.a]
        run: {stop: 1 ms}
    """
    result = simulate(text, libraries=(library(ELECTRICAL),))
    np.testing.assert_allclose(result["lower.drop"], 9.0, rtol=1e-12)
    np.testing.assert_allclose(result["upper.drop"], 3.0, rtol=1e-12)


def test_a_given_current_raises_the_voltage_of_a_capacitor_steadily(simulate, library):
    text = """
        components:
          supply: {type: Supply, current: 2 mA}
          capacitor: {type: Capacitor, capacity: 1e-3 A*s/V}
        connections: [[supply.plus, capacitor.terminal]]
        run: {stop: 1 s}
    """
    result = simulate(text, libraries=(library(ELECTRICAL),))
    np.testing.assert_allclose(result["capacitor.voltage"], 2.0 * result.t, rtol=1e-9, atol=1e-12)


HYDRAULIC = """
    class Reservoir(Component):
        port = Hydraulic("its outlet")
        pressure = Parameter("Pa")
        def law(p, port):
            return (0,)
        def prescribes():
            return {"port": None}
        def start(p):
            return {"port": p.pressure}

    class Volume(Component):
        port = Hydraulic("the fluid in it")
        volume = Parameter("m^3", above=0)
        modulus = Parameter("Pa", above=0)
        initial = Parameter("Pa", default=0.0)
        pressure = Output("Pa")
        def law(p, port):
            return Law(port=0, pressure=port.pressure)
        def inertia(p):
            return {"port": p.volume / p.modulus}
        def start(p):
            return {"port": p.initial}

    class Orifice(Component):
        a, b = Hydraulic(), Hydraulic()
        conductance = Parameter("m^3/s/Pa", above=0)
        flow = Output("m^3/s")
        def law(p, a, b):
            flow = p.conductance * (a.pressure - b.pressure)
            return Law(a=flow, b=-flow, flow=flow, dissipated=flow * (a.pressure - b.pressure))
"""


def test_a_compressible_volume_fills_through_a_linear_orifice(simulate, library):
    """p' = (K/V) G (p0 - p): an exponential with the time constant V/(K G)."""
    text = """
        components:
          reservoir: {type: Reservoir, pressure: 5e5 Pa}
          orifice: {type: Orifice, conductance: 2e-11 m^3/s/Pa}
          volume: {type: Volume, volume: 1e-3 m^3, modulus: 1.5e9 Pa, initial: 1e5 Pa}
        connections: [[reservoir.port, orifice.a], [orifice.b, volume.port]]
        run: {stop: 0.2 s, accuracy: 1e-8}
    """
    result = simulate(text, libraries=(library(HYDRAULIC),))
    time_constant = 1e-3 / (1.5e9 * 2e-11)
    exact = 5e5 - 4e5 * np.exp(-result.t / time_constant)
    np.testing.assert_allclose(result["volume.pressure"], exact, rtol=1e-7)
    np.testing.assert_allclose(result["orifice.flow"], 2e-11 * (5e5 - exact), atol=1e-13)


ROTATIONAL = """
    class Wall(Component):
        shaft = Rotational("the fixed shaft")
        def law(p, shaft):
            return (0,)
        def prescribes():
            return {"shaft": None}

    class TorsionSpring(Component):
        a, b = Rotational(), Rotational()
        stiffness = Parameter("N*m/rad", above=0)
        def law(p, a, b):
            torque = p.stiffness * (b.angle - a.angle)
            return Law(a=-torque, b=torque, stored=p.stiffness * (b.angle - a.angle) ** 2 / 2)
"""


def test_an_inertia_on_a_torsion_spring_swings_at_its_frequency(simulate, library):
    text = """
        components:
          wall: {type: Wall}
          spring: {type: TorsionSpring, stiffness: 8 N*m/rad}
          disc: {type: Inertia, moment: 0.5 kg*m^2, angle: 0.1 rad}
        connections: [[wall.shaft, spring.a], [spring.b, disc.shaft]]
        run: {stop: 3 s, accuracy: 1e-8}
    """
    result = simulate(text, libraries=(library(ROTATIONAL),))
    np.testing.assert_allclose(result["disc.angle"], 0.1 * np.cos(4.0 * result.t), atol=1e-7)
    np.testing.assert_allclose(result["disc.speed"], -0.4 * np.sin(4.0 * result.t), atol=1e-6)


def test_ports_of_two_domains_cannot_be_joined(scene, library):
    text = """
        components:
          disc: {type: Inertia, moment: 1 kg*m^2}
          capacitor: {type: Capacitor, capacity: 1 A*s/V}
        connections: [[disc.shaft, capacitor.terminal]]
        run: {stop: 1 s}
    """
    with pytest.raises(ModelError, match=r"capacitor\.terminal is an electrical port, disc\.shaft a rotational one"):
        scene(text, libraries=(library(ELECTRICAL),)).check()
