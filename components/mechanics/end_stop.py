"""Stops at both ends of a travel."""

from fairlead.components.mechanics.play import pressed

from fairlead.component import Component, Law, Output, Parameter, Translational, Zones, guard, zone


class EndStop(Component):
    """Keeps the travel of b over a between two stops, springs whose damping grows with their deflection.

    free     lower < travel < upper      force = 0
    upper    travel beyond upper by d    force = stiffness d (1 + damping dd/dt),  pushes b back
    lower    the same at the other end

    The force begins and ends with the deflection, so a stop neither knocks nor holds on, and gives back what it
    stored (Hunt and Crossley 1975, J. Applied Mechanics 42, 440, with a linear spring).
    """

    a = Translational("what carries the stops")
    b = Translational("what hits them")
    lower = Parameter("m", "Travel at the lower stop.", default=0.0)
    upper = Parameter("m", "Travel at the upper stop.")
    stiffness = Parameter("N/m", "Of a stop.", default=1e8, above=0)
    damping = Parameter("s/m", "Share of the force that is added per speed of approach.", default=5.0, least=0)
    travel = Output("m", "b.x - a.x.")
    force = Output("N", "Force of a stop on a, positive at the upper one.")
    zones = Zones("free", "upper", "lower")

    def check(p):
        """There is a travel between the stops."""
        if p.upper <= p.lower:
            yield "upper", f"upper {p.upper:g} m is not above lower {p.lower:g} m", "Raise it."

    @zone("free")
    def between(p, a, b):
        """No stop is touched."""
        return Law(a=0, b=0, travel=b.x - a.x, force=0)

    @zone("upper", "lower")
    def touched(p, a, b, zone):
        """Spring and damper of the stop."""
        d, at = (1, p.upper) if zone == "upper" else (-1, p.lower)
        size, stored, lost = pressed(p, d * (b.x - a.x - at), d * (b.v - a.v))
        return Law(a=-d * size, b=d * size, travel=b.x - a.x, force=d * size, stored=stored, dissipated=lost)

    @guard("free", to="upper", unit="m")
    def hits_upper(p, a, b):
        """The end of the travel."""
        return b.x - a.x - p.upper

    @guard("free", to="lower", unit="m")
    def hits_lower(p, a, b):
        """The other end."""
        return p.lower - (b.x - a.x)

    @guard("upper", to="free", unit="m")
    def leaves_upper(p, a, b):
        """Back within the travel."""
        return p.upper - (b.x - a.x)

    @guard("lower", to="free", unit="m")
    def leaves_lower(p, a, b):
        """The same at the other end."""
        return b.x - a.x - p.lower
