"""Resistors, coils and capacitors: circuits round motors and converters."""

from fairlead.component import Component, Electrical, Law, Output, Parameter, State


class TwoTerminals(Component, abstract=True):
    """Half-model: a current from plus to minus."""

    plus, minus = Electrical("one terminal"), Electrical("the other terminal")
    current = Output("A", "Current from plus to minus.")


class Resistor(TwoTerminals):
    """current = u/resistance,  u the voltage of plus over minus.

    The current flows from plus to minus, and `power` becomes heat. Source: Ohm's law. Limits: the resistance does not
    depend on temperature.
    """

    resistance = Parameter("ohm", "Resistance.", above=0)
    power = Output("W", "Power that becomes heat.")

    def law(p, plus, minus):
        """All power becomes heat."""
        voltage = plus.voltage - minus.voltage
        current = voltage / p.resistance
        return Law(plus=current, minus=-current, current=current, power=voltage * current, dissipated=voltage * current)


class Inductor(TwoTerminals):
    """inductance di/dt = u - resistance i.  A coil whose current is `initial` at the start.

    The current flows from plus to minus. Source: Faraday's law. Limits: the core does not saturate and has no losses.
    """

    inductance = Parameter("V*s/A", "Inductance.", above=0)
    resistance = Parameter("ohm", "Resistance of the wire.", default=0.0, least=0)
    initial = Parameter("A", "Current at the start.", default=0.0, physics=False)
    flowing = State("A", "Current.", start="initial")

    def law(p, plus, minus, flowing):
        """The field stores energy."""
        voltage = plus.voltage - minus.voltage
        rate = (voltage - p.resistance * flowing) / p.inductance
        return Law(plus=flowing, minus=-flowing, flowing=rate, current=flowing, stored=p.inductance * flowing**2 / 2,
                   dissipated=p.resistance * flowing**2)  # fmt: skip


class Capacitor(TwoTerminals):
    """capacity dw/dt = i,  u = w + inner i:  a capacitor with the resistance of its leads, charged to `initial`.

    The current i flows from plus to minus. Source: the law of a capacitor. Limits: constant capacity, no leakage; put a
    Resistor beside it.
    """

    capacity = Parameter("A*s/V", "Capacity.", above=0)
    inner = Parameter("ohm", "Resistance of its leads.", default=1e-3, above=0)
    initial = Parameter("V", "Voltage at the start.", default=0.0, physics=False)
    charged = State("V", "Voltage of the plates.", start="initial")
    voltage = Output("V", "Voltage of the plates.")

    def law(p, plus, minus, charged):
        """The plates store energy; the leads take some."""
        current = (plus.voltage - minus.voltage - charged) / p.inner
        return Law(plus=current, minus=-current, charged=current / p.capacity, current=current, voltage=charged,
                   stored=p.capacity * charged**2 / 2, dissipated=p.inner * current**2)  # fmt: skip
