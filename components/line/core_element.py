"""One element of core: the load-bearing rope inside, which cannot push."""

from fairlead.components.line.hose_element import damped

from fairlead.component import Component, Effect, Law, Output, Parameter, Translational, Zones, guard, zone

PLAY = 1e-9  # strain beyond which a loose element is taut again, so that one at rest without stretch is in one zone


class Core(Component):
    """Tension-only element with damping.

    taut      tension = stretch EA/length + damping * rate     while both stretch and tension are positive
    closing   tension = 0     still stretched, but closing so fast that the damping would push
    loose     tension = 0

    The remaining stretch of a closing element gives its energy to the damping, not to the ends.
    """

    exempt = {"zones_reached": "An element closes stretched only faster than stretch times stiffness over damping."}
    compressible = 1.0  # loose at any length, and its ends do not pass each other
    a = Translational("inboard end")
    b = Translational("outboard end")
    axial_stiffness = Parameter("N", "EA, tension per strain.", above=0)
    length = Parameter("m", "Length without tension.", above=0)
    damping = Parameter("N*s/m", "Tension per speed of separation.", default=0.0, least=0)
    line_damping = Effect("Damping of the element; off: none.")
    tension = Output("N", "Tension, never negative.")
    strain = Output("1", "Stretch over length; at -1 its ends are at one place.", role="strain")
    slack = Output("1", "1 while slack.")
    zones = Zones("taut", "closing", "loose")

    @zone("taut")
    def taut(p, a, b):
        """Carries load."""
        stretch, rate = b.x - a.x - p.length, b.v - a.v
        elastic = p.axial_stiffness / p.length * stretch
        lossy = damped(p, rate)
        tension = elastic + lossy
        return Law(a=-tension, b=+tension, tension=tension, strain=stretch / p.length, stored=elastic * stretch / 2,
                   dissipated=lossy * rate)  # fmt: skip

    @zone("closing")
    def closing(p, a, b):
        """Carries nothing, and loses what it had stored."""
        stretch = b.x - a.x - p.length
        if p.line_damping == "off":
            return Law(a=0, b=0, tension=0, slack=1, strain=stretch / p.length)
        elastic = p.axial_stiffness / p.length * stretch
        return Law(a=0, b=0, tension=0, slack=1, strain=stretch / p.length, stored=elastic * stretch / 2,
                   dissipated=-elastic * (b.v - a.v))  # fmt: skip

    @zone("loose")
    def loose(p, a, b):
        """Carries nothing."""
        return Law(a=0, b=0, tension=0, slack=1, strain=(b.x - a.x) / p.length - 1)

    @guard("taut", "closing", to="loose", unit="N")
    def shortens(p, a, b):
        """The ends are closer than the element is long."""
        return -p.axial_stiffness / p.length * (b.x - a.x - p.length)

    @guard("taut", to="closing", unit="N")
    def would_push(p, a, b):
        """Closing so fast that the damping would push."""
        if p.line_damping == "off":
            return None
        return -(p.axial_stiffness / p.length * (b.x - a.x - p.length) + damped(p, b.v - a.v))

    @guard("closing", to="taut", unit="N")
    def catches(p, a, b):
        """Closing no longer so fast."""
        if p.line_damping == "off":
            return None
        return p.axial_stiffness * ((b.x - a.x) / p.length - 1 - PLAY) + damped(p, b.v - a.v)

    @guard("loose", to="taut", unit="N")
    def tightens(p, a, b):
        """Stretched, and the tension would be positive."""
        elastic = p.axial_stiffness * ((b.x - a.x) / p.length - 1 - PLAY)
        return (elastic, elastic + damped(p, b.v - a.v)) if p.line_damping == "on" else elastic
