"""Sources of voltage: given in time, or by a signal."""

from fairlead.component import Component, Electrical, Input, Law, Output, Parameter, Waveform


class Sourced(Component, abstract=True):
    """Half-model: two terminals and what is lost inside."""

    plus, minus = Electrical("higher terminal"), Electrical("lower terminal")
    inner = Parameter("ohm", "Resistance inside.", default=1e-3, above=0)
    current = Output("A", "Current given at plus.")


class VoltageSource(Sourced):
    """Keeps a voltage between its terminals, less what its resistance takes:  current = (U - u)/inner.

    The current given at plus is positive. Source: a Thevenin source. Limits: it gives any current, and takes it back.
    """

    voltage = Waveform("V", "Voltage in time, without load.")

    def law(p, plus, minus, t):
        """The current follows from the voltage left."""
        return source_law(p, plus, minus, p.voltage(t))


class VoltageActuator(Sourced):
    """An amplifier: gives the voltage of a signal, less the drop over its resistance.

    current = (voltage - u)/inner,  u of plus over minus; the current given at plus is positive.

    Source: a Thevenin source. Limits: no limit of current or voltage; a DcDrive has them.
    """

    voltage = Input("V", "Voltage of plus over minus without load.", signed=True)

    def law(p, plus, minus, voltage):
        """The current follows from the voltage left."""
        return source_law(p, plus, minus, voltage)


def source_law(p, plus, minus, voltage):
    """Supplied is what the ideal source behind the resistance gives."""
    current = (voltage - plus.voltage + minus.voltage) / p.inner
    return Law(plus=-current, minus=current, current=current, supplied=voltage * current,
               dissipated=p.inner * current**2)  # fmt: skip
