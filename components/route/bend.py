"""A bend: a fixed guide that turns the line through an angle."""

from fairlead.components.friction.curve import Curve
from fairlead.components.route.station import Station

from fairlead.component import Parameter, Part


class Bend(Station):
    """Arc of radius R and angle theta; the line presses on it with tension / R per length.

    Sliding steadily, the tension grows by exp(mu theta) from the slack to the tight side (capstan).
    """

    word = "Bend"
    angle = Parameter("rad", "Angle the line turns through.", above=0)
    radius = Parameter("m", "Radius of the arc.", above=0, usual=(5e-3, 200))
    friction = Part(Curve, "Friction of the hose on the bend.")

    def extent(p):
        """Length of the arc."""
        return p.angle * p.radius

    def bend_radius(p):
        """The radius."""
        return p.radius

    def rubs(p):
        """The surface of the bend."""
        return p.friction
