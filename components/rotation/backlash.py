"""Play between shafts: stiff teeth with a gap between them."""

from fairlead.components.mechanics.play import opened, pressed, pushes_again, would_pull

from fairlead.component import Component, Law, Output, Parameter, Rotational, Zones, guard, zone


class Backlash(Component):
    """Play between two shafts of one speed: nothing is carried while the twist is within half a gap of zero.

    drive              twist beyond play/2 by d       torque = stiffness d (1 + damping dd/dt)
    drive_opening      damping dd/dt < -1             torque = 0
    gap                                               torque = 0
    reverse(_opening)  beyond play/2 the other way    the same, backward

    twist = a.angle - b.angle: a positive torque turns b forward. The torque begins with the deflection and teeth never
    pull, as in an `EndStop`. With `damping` of 10 s/rad it is twice that of the spring if the teeth approach at 0.1
    rad/s, and 61 times at 6 rad/s. So take a smaller `damping` for fast shafts. Teeth that meet slowly, at a speed v,
    part again with (1 - 2/3 damping v) v.

    Source: Hunt and Crossley 1975, J. Applied Mechanics 42, 440, with a linear spring. Limits: the gap is the same at
    every tooth, and teeth are not lubricated.
    """

    transmits = True  # in steady motion its ends move alike
    asked_with = {"damping": 100.0}  # or no random motion would tear the teeth apart
    a = Rotational("driving side")
    b = Rotational("driven side")
    stiffness = Parameter("N*m/rad", "Stiffness of the teeth in contact.", above=0)
    damping = Parameter("s/rad", "Share of the torque that is added per speed of approach.", default=10.0, least=0)
    play = Parameter("rad", "Angle by which b can turn while a stands still.", least=0)
    torque = Output("N*m", "Torque carried from a to b.")
    zones = Zones("gap", "drive", "reverse", "drive_opening", "reverse_opening",
                  forward=["drive", "drive_opening"], backward=["reverse", "reverse_opening"])  # fmt: skip

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

    @zone("drive_opening", "reverse_opening")
    def opening(p, a, b, direction):
        """Teeth are torn apart faster than they spring back."""
        d = direction
        size, stored, lost = opened(p, d * (a.angle - b.angle) - p.play / 2, d * (a.speed - b.speed))
        return Law(a=size, b=size, torque=size, stored=stored, dissipated=lost)

    @guard("gap", to="drive", unit="rad", mirrored="meets_backward")
    def meets_forward(p, a, b, direction):
        """The gap is used up."""
        return direction * (a.angle - b.angle) - p.play / 2

    @guard("drive", "drive_opening", to="gap", unit="rad", mirrored="parts_backward")
    def parts_forward(p, a, b, direction):
        """The teeth part."""
        return p.play / 2 - direction * (a.angle - b.angle)

    @guard("drive", to="drive_opening", unit="1", mirrored="torn_backward")
    def torn_forward(p, a, b, direction):
        """Torn apart so fast that the damping would pull."""
        return would_pull(p, direction * (a.speed - b.speed))

    @guard("drive_opening", to="drive", unit="1", mirrored="caught_backward")
    def caught_forward(p, a, b, direction):
        """Torn apart no longer so fast."""
        return pushes_again(p, direction * (a.speed - b.speed))
