"""A chain or toothed belt round two wheels: it does not slip, and hangs through on one side."""

from math import pi

from fairlead.components.mechanics.play import Loose, beyond, opened, pressed
from fairlead.components.rotation.rack import Rack

from fairlead.component import Composite, Count, Expansion, Law, Output, Parameter, Rotational, zone


class ChainStrands(Loose):
    """The two free strands of a chain, of which one at most is taut: a strand pulls and cannot push.

    Both carry besides what turns them round the wheels, mass v^2, which loads no bearing and gives no torque.
    """

    mass = Parameter("kg/m", "Mass of the chain per length.", least=0)
    upper = Output("N", "Tension of the strand that a pulls tight when it drives forward.")
    lower = Output("N", "Tension of the other strand.")

    @zone("gap")
    def hanging(p, a, b):
        """None is taut."""
        return Law(a=0, b=0, upper=p.mass * a.v**2, lower=p.mass * a.v**2)

    @zone("drive", "reverse")
    def taut(p, a, b, direction):
        """One is taut."""
        pull, stored, lost = pressed(p, beyond(p, a, b, direction), direction * (a.v - b.v))
        turning = p.mass * a.v**2
        upper, lower = (pull if direction > 0 else 0), (pull if direction < 0 else 0)
        return Law(a=direction * pull, b=-direction * pull, upper=upper + turning, lower=lower + turning,
                   stored=stored, dissipated=lost)  # fmt: skip

    @zone("drive_opening", "reverse_opening")
    def opening(p, a, b, direction):
        """One is stretched, and let go faster than it springs back."""
        pull, stored, lost = opened(p, beyond(p, a, b, direction), direction * (a.v - b.v))
        turning = p.mass * a.v**2
        return Law(a=pull, b=pull, upper=turning, lower=turning, stored=stored, dissipated=lost)


class ChainDrive(Composite):
    """A chain or toothed belt by which wheel a drives wheel b:  torque_b = radius_b (upper - lower).

    The ratio of the speeds is teeth_a/teeth_b. With radius = teeth pitch/(2 pi), the taut strand carries torque/radius
    + mass v^2. The other strand hangs through by `slack`, so b stays behind by it when a turns back. A strand that
    stretches at the speed v pulls 1 + damping v times as much as at rest, and never pushes.

    Source: roller chains, e.g. Shigley's Mechanical Engineering Design, flexible elements.

    Limits: the speed of the chain does not vary with every link (no polygon effect). It has no inertia, and no loss
    (put a LossyGear of ratio 1 beside it). The centres stand.
    """

    a = Rotational("driving wheel")
    b = Rotational("driven wheel")
    teeth_a = Count("Number of teeth of the driving wheel.")
    teeth_b = Count("Number of teeth of the driven wheel.")
    pitch = Parameter("m", "Distance from link to link, or from tooth to tooth.", above=0, usual=(1e-4, 1))
    stiffness = Parameter("N/m", "Stiffness of a taut strand.", default=1e6, above=0)
    damping = Parameter("s/m", "Share of its tension that is added per speed of stretch.", default=1.0, least=0)
    slack = Parameter("m", "Travel of the chain until the other strand is taut.", default=0.0, least=0)
    mass = Parameter("kg/m", "Mass of the chain per length.", default=0.0, least=0)
    upper = Output("N", "Tension of the strand that a pulls tight when it drives forward.")
    lower = Output("N", "Tension of the other strand.")

    def expand(p, scene):
        """Two rims and the strands between them."""
        children = {
            "strands": scene.make(ChainStrands, stiffness=p.stiffness, damping=p.damping, play=p.slack, mass=p.mass),
            "rim_a": scene.make(Rack, radius=p.teeth_a * p.pitch / (2 * pi)),
            "rim_b": scene.make(Rack, radius=p.teeth_b * p.pitch / (2 * pi)),
        }
        joins = [("rim_a.rack", "strands.a"), ("strands.b", "rim_b.rack")]
        shown = {"upper": "strands.upper", "lower": "strands.lower"}
        return Expansion(children, joins, {"a": "rim_a.pinion", "b": "rim_b.pinion"}, shown)
