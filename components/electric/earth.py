"""The reference of all voltages."""

from fairlead.component import Component, Electrical, Law


class Earth(Component):
    """Zero volts, at any current.

    terminal.voltage = 0.  Source: Kirchhoff's laws need one. Limits: it has no resistance.
    """

    terminal = Electrical("the terminal")

    def law(p, terminal):
        """Nothing to add; the voltage is prescribed."""
        return Law(terminal=0, supplied=terminal.current * terminal.voltage)

    def prescribes():
        """Zero."""
        return {"terminal": None}
