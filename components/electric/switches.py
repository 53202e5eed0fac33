"""Parts that let a current pass or not: a switch by a signal, and a diode."""

from fairlead.components.electric.passive import TwoTerminals

from fairlead.component import Input, Law, Output, Parameter, Zones, guard, zone


class ElectricSwitch(TwoTerminals):
    """A switch (contact or transistor) that a signal closes.

    current = u/closed_resistance while `control` is above 1/2, else u/open_resistance.

    u is the voltage of plus over minus. Source: a switch of two resistances, as IdealClosingSwitch of the Modelica
    Standard Library. Limits: no bounce, no arc, no time to switch.
    """

    exempt = {"odd": "Reversed, the control opens what it closed."}
    control = Input("1", "Above 1/2 closes.", signed=True)
    closed_resistance = Parameter("ohm", "Resistance when closed.", default=1e-3, above=0)
    open_resistance = Parameter("ohm", "Resistance when open.", default=1e6, above=0)
    zones = Zones("open", "closed")

    @zone("open", "closed")
    def passing(p, plus, minus, zone):
        """A large resistance, or a small one."""
        voltage = plus.voltage - minus.voltage
        current = voltage / (p.closed_resistance if zone == "closed" else p.open_resistance)
        return Law(plus=current, minus=-current, current=current, dissipated=voltage * current)

    @guard("open", to="closed", unit="1")
    def closes(p, control):
        """Asked for."""
        return control - 0.5

    @guard("closed", to="open", unit="1")
    def opens(p, control):
        """No longer."""
        return 0.5 - control


class Diode(TwoTerminals):
    """Lets current pass only from plus to minus.

    blocking      u < threshold     current = u/blocking_resistance
    conducting    u > threshold     the same, and (u - threshold)/resistance beside

    u and the current are positive from plus to minus. Source: IdealDiode of the Modelica Standard Library. Limits:
    straight lines in place of the exponential; no charge is stored.
    """

    exempt = {"odd": "It passes one way."}
    threshold = Parameter("V", "Voltage from which it conducts.", default=0.7, least=0)
    resistance = Parameter("ohm", "Resistance when conducting.", default=1e-2, above=0)
    blocking_resistance = Parameter("ohm", "Resistance otherwise.", default=1e6, above=0)
    voltage = Output("V", "Voltage of plus over minus.")
    zones = Zones("blocking", "conducting")

    @zone("blocking", "conducting")
    def passing(p, plus, minus, zone):
        """What leaks, and what is above the threshold."""
        voltage = plus.voltage - minus.voltage
        current = voltage / p.blocking_resistance
        if zone == "conducting":
            current += (voltage - p.threshold) / p.resistance
        return Law(plus=current, minus=-current, current=current, voltage=voltage, dissipated=voltage * current)

    @guard("blocking", to="conducting", unit="V")
    def conducts(p, plus, minus):
        """Above the threshold."""
        return plus.voltage - minus.voltage - p.threshold

    @guard("conducting", to="blocking", unit="V")
    def blocks(p, plus, minus):
        """Below it."""
        return p.threshold - plus.voltage + minus.voltage
