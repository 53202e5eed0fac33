"""A tensioner: a dancer pulley on a carriage that takes up a loop of line."""

from fairlead.components.mechanics.mass import Mass
from fairlead.components.route.dancer import Dancer
from fairlead.components.route.station import Machinery, Station

from fairlead.component import Parameter, Waveform


class Tensioner(Station):
    """The line wraps a dancer by 180 deg; the carriage at y has 2 y of line in its loop.

        mass dv/dt = force - stiffness y - damping v - 2 T      0 <= y <= stroke, with stops at both ends

    The loop counts where the device stands: an element that spans the place is longer by 2 y on its way. Steadily
    T = (force - stiffness y)/2 as long as the carriage is between its stops. The wheel itself has no inertia and no
    friction. At the start the carriage is at its inner stop, with no line in the loop.
    `route.<name>.carriage` is a flange, for a cylinder or a spring of one's own.
    """

    word = "Tensioner"
    mass = Parameter("kg", "Mass of carriage and dancer.", default=20.0, above=0)
    force = Waveform("N", "Force that draws the loop out.", default=0.0)
    stiffness = Parameter("N/m", "Stiffness of a spring that draws the loop in as it grows.", default=0.0, least=0)
    damping = Parameter("N*s/m", "Damping of the carriage.", default=100.0, least=0)
    stroke = Parameter("m", "Travel of the carriage.", default=1.0, above=0)
    stop_stiffness = Parameter("N/m", "Stiffness of the stops.", default=1e5, above=0)

    def extent(p):
        """It takes no length of the route; the loop is told apart."""
        return 0.0

    def draws(p, t):
        """The force on the carriage, which carries both sides of the loop."""
        return p.force(t)

    def loosest(p, t):
        """(force - stiffness stroke)/2, or nothing where the spring would push the line."""
        return max(p.force(t) - p.stiffness * p.stroke, 0.0) / 2

    def machinery(p, scene):
        """Carriage and dancer."""
        dancer = {name: p.given[name] for name in ("force", "stiffness", "damping", "stroke", "stop_stiffness")}
        children = {
            "carriage": scene.make(Mass, mass=p.mass, position=0.0),
            "dancer": scene.make(Dancer, **dancer),
        }
        ports = {"carriage": "carriage.flange"}
        outputs = {"y": "carriage.x", "pull": "dancer.pull"}
        return Machinery(children, (("carriage.flange", "dancer.carriage"),), ports, outputs)
