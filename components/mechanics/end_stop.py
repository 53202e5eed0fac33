"""Stops at both ends of a travel."""

from fairlead.components.mechanics.play import opened, pressed, pushes_again, would_pull

from fairlead.component import Component, Law, Output, Parameter, Translational, Zones, guard, zone


class EndStop(Component):
    """Keeps the travel of b over a between two stops, which are springs with damping.

    free              lower < travel < upper      force = 0
    upper             travel beyond upper by d    force = stiffness d (1 + damping dd/dt),  pushes b back
    upper_opening     damping dd/dt < -1          force = 0
    lower(_opening)   the same at the other end

    The damping grows with the deflection. So the force begins with the deflection and never pulls: a stop does not
    begin with a blow, and does not hold b on. With `damping` of 5 s/m the force is twice that of the spring if b comes
    at 0.2 m/s. A body that comes slowly, at a speed v, goes back with (1 - 2/3 damping v) v.

    Source: Hunt and Crossley 1975, J. Applied Mechanics 42, 440, with a linear spring.

    Limits: the ends are fixed to a; what rebounds at once and never gives is a RigidStop.
    """

    asked_with = {"damping": 100.0}  # or no random motion would tear b off
    a = Translational("what carries the stops")
    b = Translational("what hits them")
    lower = Parameter("m", "Travel at the lower stop.", default=0.0)
    upper = Parameter("m", "Travel at the upper stop.")
    stiffness = Parameter("N/m", "Stiffness of a stop.", default=1e8, above=0)
    damping = Parameter("s/m", "Share of the force that is added per speed of approach.", default=5.0, least=0)
    travel = Output("m", "b.x - a.x.")
    force = Output("N", "Force of a stop on a, positive at the upper one.")
    zones = Zones("free", "upper", "lower", "upper_opening", "lower_opening",
                  forward=["upper", "upper_opening"], backward=["lower", "lower_opening"])  # fmt: skip

    def check(p):
        """There is a travel between the stops."""
        if p.upper <= p.lower:
            yield "upper", f"upper {p.upper:g} m is not above lower {p.lower:g} m", "Raise it."

    @zone("free")
    def between(p, a, b):
        """No stop is touched."""
        return Law(a=0, b=0, travel=b.x - a.x, force=0)

    @zone("upper", "lower")
    def touched(p, a, b, direction):
        """Spring and damper of the stop."""
        size, stored, lost = pressed(p, beyond(p, a, b, direction), direction * (b.v - a.v))
        force = direction * size
        return Law(a=-force, b=force, travel=b.x - a.x, force=force, stored=stored, dissipated=lost)

    @zone("upper_opening", "lower_opening")
    def opening(p, a, b, direction):
        """Torn off faster than the stop springs back."""
        force, stored, lost = opened(p, beyond(p, a, b, direction), direction * (b.v - a.v))
        return Law(a=force, b=force, travel=b.x - a.x, force=force, stored=stored, dissipated=lost)

    @guard("free", to="upper", unit="m", mirrored="hits_lower")
    def hits_upper(p, a, b, direction):
        """The end of the travel."""
        return beyond(p, a, b, direction)

    @guard("upper", "upper_opening", to="free", unit="m", mirrored="leaves_lower")
    def leaves_upper(p, a, b, direction):
        """Back within the travel."""
        return -beyond(p, a, b, direction)

    @guard("upper", to="upper_opening", unit="1", mirrored="torn_off_lower")
    def torn_off_upper(p, a, b, direction):
        """Torn off so fast that the damping would pull."""
        return would_pull(p, direction * (b.v - a.v))

    @guard("upper_opening", to="upper", unit="1", mirrored="caught_lower")
    def caught_upper(p, a, b, direction):
        """Torn off no longer so fast."""
        return pushes_again(p, direction * (b.v - a.v))


def beyond(p, a, b, direction):
    """Way by which a stop is passed [m]: of the upper one where the direction is 1, else of the lower one."""
    return b.x - a.x - p.upper if direction > 0 else p.lower - (b.x - a.x)
