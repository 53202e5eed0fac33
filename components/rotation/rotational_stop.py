"""Stops at both ends of a turn."""

from fairlead.components.mechanics.play import opened, pressed, pushes_again, would_pull

from fairlead.component import Component, Law, Output, Parameter, Rotational, Zones, guard, zone


class RotationalStop(Component):
    """Keeps the angle of b over a between two stops, which are springs with damping.

    free              lower < turn < upper      torque = 0
    upper             turn beyond upper by d    torque = stiffness d (1 + damping dd/dt),  turns b back
    upper_opening     damping dd/dt < -1        torque = 0
    lower(_opening)   the same at the other end

    The damping grows with the deflection. So the torque begins with the deflection, as in an EndStop, and never holds
    b on. With `damping` of 5 s/rad the torque is twice that of the spring if b comes at 0.2 rad/s, and 31 times at 6
    rad/s. So take a smaller `damping` for fast blows. A shaft that comes slowly, at a speed v, goes back with (1 - 2/3
    damping v) v.

    Source: Hunt and Crossley 1975, J. Applied Mechanics 42, 440, with a linear spring.

    Limits: the stops turn with a, and there is no other pair in the next turn.
    """

    a = Rotational("what carries the stops")
    b = Rotational("what hits them")
    lower = Parameter("rad", "Turn at the lower stop.", default=0.0)
    upper = Parameter("rad", "Turn at the upper stop.")
    stiffness = Parameter("N*m/rad", "Stiffness of a stop.", default=1e6, above=0)
    damping = Parameter("s/rad", "Share of the torque that is added per speed of approach.", default=5.0, least=0)
    turn = Output("rad", "b.angle - a.angle.")
    torque = Output("N*m", "Torque of a stop on a, positive at the upper one.")
    zones = Zones("free", "upper", "lower", "upper_opening", "lower_opening",
                  forward=["upper", "upper_opening"], backward=["lower", "lower_opening"])  # fmt: skip

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

    @zone("upper_opening", "lower_opening")
    def opening(p, a, b, direction):
        """Torn off faster than the stop springs back."""
        torque, stored, lost = opened(p, beyond(p, a, b, direction), direction * (b.speed - a.speed))
        return Law(a=torque, b=torque, turn=b.angle - a.angle, torque=torque, stored=stored, dissipated=lost)

    @guard("free", to="upper", unit="rad", mirrored="hits_lower")
    def hits_upper(p, a, b, direction):
        """The end of the turn."""
        return beyond(p, a, b, direction)

    @guard("upper", "upper_opening", to="free", unit="rad", mirrored="leaves_lower")
    def leaves_upper(p, a, b, direction):
        """Back between the stops."""
        return -beyond(p, a, b, direction)

    @guard("upper", to="upper_opening", unit="1", mirrored="torn_off_lower")
    def torn_off_upper(p, a, b, direction):
        """Torn off so fast that the damping would pull."""
        return would_pull(p, direction * (b.speed - a.speed))

    @guard("upper_opening", to="upper", unit="1", mirrored="caught_lower")
    def caught_upper(p, a, b, direction):
        """Torn off no longer so fast."""
        return pushes_again(p, direction * (b.speed - a.speed))


def beyond(p, a, b, direction):
    """Angle by which a stop is passed [rad]: of the upper one where the direction is 1, else of the lower one."""
    middle, half = (p.upper + p.lower) / 2, (p.upper - p.lower) / 2
    return direction * (b.angle - a.angle - middle) - half
