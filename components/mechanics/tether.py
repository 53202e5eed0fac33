"""A line that pulls and cannot push."""

from fairlead.component import Component, Law, Output, Parameter, Translational, Zones, guard, zone


class Tether(Component):
    """Tension-only line between two flanges.

    taut:   tension = stiffness * (b.x - a.x - length)
    slack:  tension = 0

    It carries no damping and no mass; a snap is limited by the masses at its ends.

    The tension is never negative. Source: docs/physics.md, 3.2. Limits: a line of one element has no waves; take a
    Cable for those.
    """

    a = Translational("inboard end")
    b = Translational("outboard end")
    stiffness = Parameter("N/m", "Tension per stretch.", above=0)
    length = Parameter("m", "Length without load.", default=0.0, least=0)
    tension = Output("N", "Tension, never negative.")
    zones = Zones("slack", "taut")

    @zone("slack")
    def slack(p, a, b):
        """Nothing is carried."""
        return Law(a=0, b=0, tension=0)

    @zone("taut")
    def taut(p, a, b):
        """The law of a spring."""
        stretch = b.x - a.x - p.length
        tension = p.stiffness * stretch
        return Law(a=-tension, b=+tension, tension=tension, stored=tension * stretch / 2)

    @guard("slack", to="taut", unit="m")
    def tightens(p, a, b):
        """The ends are further apart than the line is long."""
        return b.x - a.x - p.length

    @guard("taut", to="slack", unit="m")
    def slackens(p, a, b):
        """The ends have come closer."""
        return p.length - (b.x - a.x)
