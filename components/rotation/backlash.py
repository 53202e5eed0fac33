"""Play between shafts: stiff teeth with a gap between them."""

from fairlead.components.mechanics.play import pressed

from fairlead.component import Component, Law, Output, Parameter, Rotational, Zones, guard, zone


class Backlash(Component):
    """Play between two shafts of one speed: nothing is carried while the twist is within half a gap of zero.

    drive     twist beyond gap/2 by d      torque = stiffness d (1 + damping dd/dt)
    gap                                    torque = 0
    reverse   beyond gap/2 the other way   the same, backward

    twist = a.angle - b.angle: positive torque turns b forward. The torque begins and ends with the deflection, as
    in an `EndStop`.
    """

    transmits = True  # in steady motion its ends move alike
    a = Rotational("driving side")
    b = Rotational("driven side")
    stiffness = Parameter("N*m/rad", "Of the teeth in contact.", above=0)
    damping = Parameter("s/rad", "Share of the torque that is added per speed of approach.", default=10.0, least=0)
    play = Parameter("rad", "Angle by which b can turn while a stands still.", least=0)
    torque = Output("N*m", "Torque carried from a to b.")
    zones = Zones("gap", "drive", "reverse", forward=["drive"], backward=["reverse"])

    @zone("gap")
    def loose(p, a, b):
        """No teeth touch."""
        return Law(a=0, b=0, torque=0)

    @zone("drive", "reverse")
    def touching(p, a, b, direction):
        """Spring and damper of the teeth."""
        d = direction
        size, stored, lost = pressed(p, d * (a.angle - b.angle) - p.play / 2, d * (a.speed - b.speed))
        return Law(a=d * size, b=-d * size, torque=d * size, stored=stored, dissipated=lost)

    @guard("gap", to="drive", unit="rad", mirrored="meets_backward")
    def meets_forward(p, a, b, direction):
        """The gap is used up."""
        return direction * (a.angle - b.angle) - p.play / 2

    @guard("drive", to="gap", unit="rad", mirrored="parts_backward")
    def parts_forward(p, a, b, direction):
        """The teeth part."""
        return p.play / 2 - direction * (a.angle - b.angle)
