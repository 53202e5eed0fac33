"""What drives the carriage of a tensioner: a force, a spring, and stops at both ends of its way."""

from fairlead.component import Component, Law, Output, Parameter, Translational, Waveform, Zones, guard, zone


class Dancer(Component):
    """pull = force - stiffness y - damping v, between the stops.

    free    0 < y < stroke
    low     y <= 0          the stop pushes out, stop_stiffness (-y)
    high    y >= stroke     the stop pushes in, stop_stiffness (y - stroke)
    """

    carriage = Translational("the carriage, which goes out as y grows")
    force = Waveform("N", "Force that draws the loop out.", default=0.0)
    stiffness = Parameter("N/m", "Stiffness of a spring that draws the loop in.", default=0.0, least=0)
    damping = Parameter("N*s/m", "Damping of the carriage.", default=0.0, least=0)
    stroke = Parameter("m", "Travel of the carriage.", above=0)
    stop_stiffness = Parameter("N/m", "Stiffness of the stops.", default=1e5, above=0)
    pull = Output("N", "Force on the carriage, positive outward.")
    zones = Zones("free", "low", "high")

    @zone("free", "low", "high")
    def law(p, carriage, t, zone):
        """One more spring at either end."""
        past = {"free": 0, "low": carriage.x, "high": carriage.x - p.stroke}[zone]
        given = p.force(t)
        pull = given - p.stiffness * carriage.x - p.damping * carriage.v - p.stop_stiffness * past
        stored = p.stiffness * carriage.x**2 / 2 + p.stop_stiffness * past**2 / 2
        return Law(carriage=-pull, pull=pull, supplied=given * carriage.v, stored=stored,
                   dissipated=p.damping * carriage.v**2)  # fmt: skip

    @guard("free", "high", to="low", unit="m")
    def arrives_low(p, carriage):
        """At the inner stop."""
        return -carriage.x

    @guard("low", to="free", unit="m")
    def leaves_low(p, carriage):
        """Off it."""
        return carriage.x

    @guard("free", "low", to="high", unit="m")
    def arrives_high(p, carriage):
        """At the outer stop."""
        return carriage.x - p.stroke

    @guard("high", to="free", unit="m")
    def leaves_high(p, carriage):
        """Off it."""
        return p.stroke - carriage.x
