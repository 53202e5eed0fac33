"""Stops at both ends of a turn."""

from fairlead.components.mechanics.play import pressed

from fairlead.component import Component, Law, Output, Parameter, Rotational, Zones, guard, zone


class RotationalStop(Component):
    """Keeps the angle of b over a between two stops, springs whose damping grows with their deflection.

    free     lower < turn < upper      torque = 0
    upper    turn beyond upper by d    torque = stiffness d (1 + damping dd/dt),  turns b back
    lower    the same at the other end

    The torque begins and ends with the deflection (Hunt and Crossley 1975, J. Applied Mechanics 42, 440, with a
    linear spring), as that of an EndStop.
    """

    a = Rotational("what carries the stops")
    b = Rotational("what hits them")
    lower = Parameter("rad", "Turn at the lower stop.", default=0.0)
    upper = Parameter("rad", "Turn at the upper stop.")
    stiffness = Parameter("N*m/rad", "Of a stop.", default=1e6, above=0)
    damping = Parameter("s/rad", "Share of the torque that is added per speed of approach.", default=5.0, least=0)
    turn = Output("rad", "b.angle - a.angle.")
    torque = Output("N*m", "Torque of a stop on a, positive at the upper one.")
    zones = Zones("free", "upper", "lower", forward=["upper"], backward=["lower"])

    def check(p):
        """There is a turn between the stops."""
        if p.upper <= p.lower:
            yield "upper", f"upper {p.upper:g} rad is not above lower {p.lower:g} rad", "Raise it."

    @zone("free")
    def between(p, a, b):
        """No stop is touched."""
        return Law(a=0, b=0, turn=b.angle - a.angle, torque=0)

    @zone("upper", "lower")
    def touched(p, a, b, direction):
        """Spring and damper of the stop."""
        size, stored, lost = pressed(p, beyond(p, a, b, direction), direction * (b.speed - a.speed))
        torque = direction * size
        return Law(a=-torque, b=torque, turn=b.angle - a.angle, torque=torque, stored=stored, dissipated=lost)

    @guard("free", to="upper", unit="rad", mirrored="hits_lower")
    def hits_upper(p, a, b, direction):
        """The end of the turn."""
        return beyond(p, a, b, direction)

    @guard("upper", to="free", unit="rad", mirrored="leaves_lower")
    def leaves_upper(p, a, b, direction):
        """Back between the stops."""
        return -beyond(p, a, b, direction)


def beyond(p, a, b, direction):
    """Angle by which a stop is passed [rad]: of the upper one where the direction is 1, else of the lower one."""
    middle, half = (p.upper + p.lower) / 2, (p.upper - p.lower) / 2
    return direction * (b.angle - a.angle - middle) - half
