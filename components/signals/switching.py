"""Signals that choose: a relay with two levels, and a switch between two signals."""

from fairlead.component import Choice, Component, Input, Law, Output, Parameter, Zones, guard, zone


class Relay(Component):
    """signal = `on` once value has risen above `upper`, and `off` once it has fallen below `lower` again.

    Both levels the same make a comparator. Where the value starts between the levels, it is off, or on with
    `begins_on: yes`.

    Source: Hysteresis of the Modelica Standard Library. Limits: it takes no time to switch.
    """

    exempt = {"odd": "A relay is not symmetric unless its levels are."}
    asked_with = {"lower": -0.5, "upper": 0.5}
    value = Input("1", "What is watched.", signed=True)
    upper = Parameter("1", "Value at which it switches on.", like="value")
    lower = Parameter(
        "1", "Value at which it switches off; that of `upper` when not given.", default=None, like="value"
    )
    on = Parameter("1", "Signal while it is on.", default=1.0)
    off = Parameter("1", "Signal while it is off.", default=0.0)
    begins_on = Choice(("no", "yes"), "Whether it is on at first, where the value starts between the levels.",
                       default="no")  # fmt: skip
    signal = Output("1", "`on` or `off`.")
    zones = Zones("off", "on")

    def check(p):
        """It lets go below where it takes hold."""
        if p.lower is not None and p.lower > p.upper:
            yield "lower", f"lower {p.lower:g} is above upper {p.upper:g}", "Lower it."

    def begins_in(p):
        """On, if it is asked to be."""
        return "on" if p.begins_on == "yes" else "off"

    @zone("off", "on")
    def told(p, zone):
        """One of the two."""
        return Law(signal=p.on if zone == "on" else p.off)

    @guard("off", to="on", unit="1")
    def switches_on(p, value):
        """Above the upper level."""
        return value - p.upper

    @guard("on", to="off", unit="1")
    def switches_off(p, value):
        """Below the lower one."""
        return (p.upper if p.lower is None else p.lower) - value


class SignalSwitch(Component):
    """signal = a while `control` is above `level`, else b.

    Source: Switch of the Modelica Standard Library. Limits: the signal jumps where a and b differ.
    """

    exempt = {"odd": "Reversed, the control chooses the other signal."}
    a = Input("1", "Passes while the control is above its level.", signed=True)
    b = Input("1", "Passes otherwise.", 0.0, signed=True)
    control = Input("1", "Chooses.", signed=True)
    level = Parameter("1", "Level of the control.", default=0.5, like="control")
    signal = Output("1", "The one that passes.", like="a")
    zones = Zones("b_passes", "a_passes")

    @zone("b_passes", "a_passes")
    def chosen(p, a, b, zone):
        """One of the two."""
        return Law(signal=a if zone == "a_passes" else b)

    @guard("b_passes", to="a_passes", unit="1")
    def switches_to_a(p, control):
        """Above the level."""
        return control - p.level

    @guard("a_passes", to="b_passes", unit="1")
    def switches_to_b(p, control):
        """Below it."""
        return p.level - control
