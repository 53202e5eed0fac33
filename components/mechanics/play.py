"""Play and gaps along a line: what pushes or pulls only when it touches."""

from fairlead.component import Component, Law, Output, Parameter, Translational, Zones, guard, zone

AGAIN = 1e-3  # of the spring: what is torn apart must push by more than this to push again, or rounding would decide


def pressed(p, deep, rate):
    """Force of what is pressed in by `deep`, energy stored and power dissipated: a spring whose damping grows with it.

    Hunt and Crossley 1975, J. Applied Mechanics 42, 440, with a linear spring; of stops, teeth and strands, along a
    line as of a shaft. It pulls where `would_pull` is positive, and is `opened` there.
    """
    spring = p.stiffness * deep
    return spring * (1 + p.damping * rate), spring * deep / 2, spring * p.damping * rate**2


def opened(p, deep, rate):
    """The same of what is torn apart: no force, and what is still stored goes into the damping."""
    spring = p.stiffness * deep
    return 0, spring * deep / 2, -spring * rate


def would_pull(p, rate):
    """By how much the damping of what goes apart exceeds the spring, as a share of it."""
    return -1 - p.damping * rate


def pushes_again(p, rate):
    """By how much the spring of what is torn apart exceeds the damping, as a share of it."""
    return 1 - AGAIN + p.damping * rate


def beyond(p, a, b, direction):
    """The play is used up."""
    return direction * (a.x - b.x) - p.play / 2


def within(p, a, b, direction):
    """It is within its play again."""
    return p.play / 2 - direction * (a.x - b.x)


def torn(p, a, b, direction):
    """Torn back so fast that the damping would pull."""
    return would_pull(p, direction * (a.v - b.v))


def caught(p, a, b, direction):
    """Torn back no longer so fast."""
    return pushes_again(p, direction * (a.v - b.v))


class Loose(Component, abstract=True):
    """Half-model of what is loose between two points: nothing is carried while a is within half a play of b."""

    transmits = True  # in steady motion its ends move alike
    a = Translational("driving side")
    b = Translational("driven side")
    stiffness = Parameter("N/m", "Stiffness of the parts in contact.", above=0)
    damping = Parameter("s/m", "Share of the force that is added per speed of approach.", default=10.0, least=0)
    play = Parameter("m", "Distance that b can move while a stands still.", least=0)
    zones = Zones("gap", "drive", "reverse", "drive_opening", "reverse_opening",
                  forward=["drive", "drive_opening"], backward=["reverse", "reverse_opening"])  # fmt: skip
    meets_forward = guard("gap", to="drive", unit="m", mirrored="meets_backward")(beyond)
    parts_forward = guard("drive", "drive_opening", to="gap", unit="m", mirrored="parts_backward")(within)
    torn_forward = guard("drive", to="drive_opening", unit="1", mirrored="torn_backward")(torn)
    caught_forward = guard("drive_opening", to="drive", unit="1", mirrored="caught_backward")(caught)


class Play(Loose):
    """Play between two points of one speed, as of a pin in its hole: nothing is carried within it.

    drive              a ahead of b by play/2 + d    force = stiffness d (1 + damping dd/dt), drives b forward
    drive_opening      damping dd/dt < -1            force = 0
    gap                                              force = 0
    reverse(_opening)  a behind b                    the same, backward

    The force begins with d and never pulls. With `damping` of 10 s/m it is twice that of the spring if the points
    approach at 0.1 m/s, and zero if they part at 0.1 m/s. A Backlash is the same for shafts.

    Source: Hunt and Crossley 1975, J. Applied Mechanics 42, 440, with a linear spring.

    Limits: the parts of a joint alone give way; their masses are components of their own.
    """

    force = Output("N", "Force carried from a to b, positive forward.")

    @zone("gap")
    def loose(p, a, b):
        """Nothing touches."""
        return Law(a=0, b=0, force=0)

    @zone("drive", "reverse")
    def touching(p, a, b, direction):
        """Spring and damper of what touches."""
        force, stored, lost = pressed(p, beyond(p, a, b, direction), direction * (a.v - b.v))
        return Law(a=direction * force, b=-direction * force, force=direction * force, stored=stored, dissipated=lost)

    @zone("drive_opening", "reverse_opening")
    def opening(p, a, b, direction):
        """Torn back faster than it springs back."""
        force, stored, lost = opened(p, beyond(p, a, b, direction), direction * (a.v - b.v))
        return Law(a=force, b=force, force=force, stored=stored, dissipated=lost)


class ElasticGap(Component):
    """Two bodies that push each other apart when b is nearer to a than `length`, with linear damping that is limited.

    free       b.x - a.x > length      force = 0
    pressed    nearer by d             force = stiffness d + damping dd/dt
    closing    damping dd/dt > stiffness d            force = 2 stiffness d
    opening    -damping dd/dt > stiffness d           force = 0

    The damping is never more than the force of the spring. So the force begins at zero and never pulls. EndStop and
    Play have stops at both ends, and damping that grows with the deflection.

    Source: ElastoGap of the Modelica Standard Library (Modelica.Mechanics.Translational.Components).

    Limits: one end only, without friction across; at forces far below 1 uN its corners are within the tolerance of a
    run.
    """

    asked_with = {"stiffness": 1.0, "damping": 1.0}  # or no random motion would be fast, or slow, enough
    a = Translational("the one behind")
    b = Translational("the one in front")
    length = Parameter("m", "Distance at which they touch.", default=0.0)
    stiffness = Parameter("N/m", "Stiffness of the contact.", above=0)
    damping = Parameter("N*s/m", "Force per speed of approach, up to that of the spring.", default=0.0, least=0)
    force = Output("N", "Force that pushes them apart, never negative.")
    gap = Output("m", "b.x - a.x - length.")
    zones = Zones("free", "pressed", "closing", "opening")

    @zone("free", "pressed", "closing", "opening")
    def elastic(p, a, b, zone):
        """The spring, and what damping adds to it."""
        deep, rate = inward(p, a, b), a.v - b.v
        spring = p.stiffness * deep if zone != "free" else 0
        damper = {"pressed": p.damping * rate, "closing": spring, "opening": -spring}.get(zone, 0)
        return Law(a=spring + damper, b=-spring - damper, force=spring + damper, gap=-deep,
                   stored=spring * deep / 2, dissipated=damper * rate)  # fmt: skip

    @guard("free", to="pressed", unit="m")
    def touches(p, a, b):
        """They touch."""
        return inward(p, a, b)

    @guard("*", to="free", unit="m")
    def parts(p, a, b):
        """They part."""
        return -inward(p, a, b)

    @guard("pressed", to="closing", unit="N")
    def comes_fast(p, a, b):
        """Damping would give more than the spring."""
        return p.damping * (a.v - b.v) - p.stiffness * inward(p, a, b)

    @guard("closing", to="pressed", unit="N")
    def comes_slowly(p, a, b):
        """The spring gives more than damping."""
        return p.stiffness * inward(p, a, b) - p.damping * (a.v - b.v)

    @guard("pressed", to="opening", unit="N")
    def goes_fast(p, a, b):
        """Damping would pull more than the spring pushes."""
        return -p.damping * (a.v - b.v) - p.stiffness * inward(p, a, b)

    @guard("opening", to="pressed", unit="N")
    def goes_slowly(p, a, b):
        """The spring pushes more than damping would pull."""
        return p.stiffness * inward(p, a, b) + p.damping * (a.v - b.v)


def inward(p, a, b):
    """How much nearer they are than at their touch [m]."""
    return a.x + p.length - b.x
