"""Straight pieces of a route: free spans, guides that carry the weight, tubes."""

from fairlead.components.friction.curve import Curve
from fairlead.components.route.station import Station

from fairlead.component import Parameter, Part


class Straight(Station):
    """A span in which the line touches nothing; it only takes length."""

    word = "Straight"
    length = Parameter("m", "Length of the span.", above=0)

    def extent(p):
        """The length."""
        return p.length


class Guide(Station):
    """A straight guide the line lies on: the normal component of its weight presses, w cos(slope) per length."""

    word = "Guide"
    length = Parameter("m", "Length of the guide.", above=0)
    friction = Part(Curve, "Friction of the line on the guide.")

    def extent(p):
        """The length."""
        return p.length

    def rubs(p):
        """The surface of the guide."""
        return p.friction

    def bears_weight(p):
        """It does."""
        return True


class Tube(Station):
    """A tube round the line, straight or curved.

    Straight, the line lies on it with its weight; curved, it presses on the inner wall when in tension and on
    the outer wall when in compression. A tight tube may squeeze the line besides.
    """

    word = "Tube"
    length = Parameter("m", "Length of the tube.", above=0)
    radius = Parameter("m", "Radius of a curved tube; straight when not given.", default=None, above=0)
    friction = Part(Curve, "Friction of the line in the tube.")
    squeezes = Parameter("N/m", "Load with which the wall presses on the line all round.", default=0.0, least=0)

    def extent(p):
        """The length."""
        return p.length

    def bend_radius(p):
        """The radius, if curved."""
        return p.radius

    def rubs(p):
        """The wall."""
        return p.friction

    def all_round(p):
        """A curved tube has an outer wall too."""
        return p.radius is not None

    def bears_weight(p):
        """It does."""
        return True

    def squeeze(p):
        """What the wall presses."""
        return p.squeezes
